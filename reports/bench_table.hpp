// How quick the solvers' loops are: text for a terminal, JSON lines for programs.
#pragma once

#include <string>
#include <vector>

#include "reports/bench_results.hpp"
#include "reports/results.hpp"

namespace diptych::reports {

std::string bench_text(const std::vector<BenchRow>&);
/// A line a row, then one of what made them.
std::string bench_json(const std::vector<BenchRow>&, const Provenance&);

}  // namespace diptych::reports
