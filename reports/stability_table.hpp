// Stability limits as text, CSV and JSON.
#pragma once

#include <string>

#include "reports/results.hpp"
#include "reports/stability_results.hpp"

namespace diptych::reports {

/// A line a setting. within: the part of theory by which a limit may be off; what is further off is marked.
std::string stability_text(const StabilityMap&, double within);
/// "12 limits, 8 with a theory, all within 1 % of it"
std::string stability_verdict(const StabilityMap&, double within);
std::string stability_csv(const StabilityMap&);
/// The same as one JSON object, with the provenance.
std::string stability_json(const StabilityMap&, const Provenance&);

}  // namespace diptych::reports
