// The order of convergence, fitted.
#pragma once

#include <vector>

namespace diptych::reports {

/// Least-squares slope of log(error) against log(h) and its standard error; the sign is kept.
struct Fit {
  double order = 0;
  double standard_error = 0;  ///< NaN with two points, which leave nothing to judge the slope by
  int levels = 0;             ///< points fitted
};
/// Needs at least two distinct h and positive finite errors; throws std::invalid_argument otherwise.
Fit fit_order(const std::vector<double>& cell_sizes, const std::vector<double>& errors);

}  // namespace diptych::reports
