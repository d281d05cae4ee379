// How quick the solvers' loops are, as plain data.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/trade_results.hpp"

namespace diptych::reports {

/// One solver on one scene of one size.
struct BenchRow {
  std::string scene;       ///< "damage"
  std::string method;      ///< "fem"
  std::size_t points = 0;  ///< elements or particles
  int cells_x = 0, cells_y = 0;
  int threads = 1;
  Timed step;            ///< of one step, less what every run takes
  double bytes = 0;      ///< of the solver's arrays
  double diffusion = 0;  ///< nodes that the diffusion brings up to date in a step
  double bandwidth = 0;  ///< of a sweep in place over as many bytes with as many threads, read and written [B/s]
  std::string trouble;   ///< why there are no numbers; empty: there are

  double rate() const { return static_cast<double>(points) / step.seconds; }  ///< points a second
  /// Time to read and write all of its arrays once over the time of a step: 1 is the floor of memory for a step that
  /// goes over them once, and what goes over them more often, or computes more, has less.
  double of_floor() const { return 2 * bytes / bandwidth / step.seconds; }
};

}  // namespace diptych::reports
