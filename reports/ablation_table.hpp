// What becomes of a scene when something is taken off it or added, as text, CSV and JSON.
#pragma once

#include <string>

#include "reports/ablation_results.hpp"
#include "reports/results.hpp"

namespace diptych::reports {

/// A table for each thing tried, of all quantities at the time at which each changes most by its uncertainty; and below
/// a line for each with what follows. At most 120 characters wide.
std::string ablation_text(const AblationStudy&);

/// A line for each quantity and time; of what has none, a line that says why.
std::string ablation_csv(const AblationStudy&);

std::string ablation_json(const AblationStudy&, const Provenance&);

}  // namespace diptych::reports
