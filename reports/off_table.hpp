// What features cost where they are off: text for a terminal, JSON lines for programs.
#pragma once

#include <string>
#include <vector>

#include "reports/off_results.hpp"
#include "reports/results.hpp"

namespace diptych::reports {

std::string off_text(const std::vector<OffRow>&);
/// A line a row, then one of what made them.
std::string off_json(const std::vector<OffRow>&, const Provenance&);

}  // namespace diptych::reports
