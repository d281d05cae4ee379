#include "reports/order_fit.hpp"

#include <fmt/core.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "reports/csv.hpp"

namespace diptych::reports {

Fit fit_order(const std::vector<double>& cell_sizes, const std::vector<double>& errors) {
  if (cell_sizes.size() != errors.size())
    throw std::invalid_argument(
        fmt::format("order fit: {} cell sizes but {} errors", cell_sizes.size(), errors.size()));
  const auto good = [](double value) { return std::isfinite(value) && value > 0; };
  for (std::size_t i = 0; i < errors.size(); ++i)
    if (!good(cell_sizes[i]) || !good(errors[i]))
      throw std::invalid_argument(fmt::format("order fit: h = {}, error = {}: both must be positive and finite",
                                              csv_number(cell_sizes[i]), csv_number(errors[i])));
  if (errors.empty() || std::all_of(cell_sizes.begin(), cell_sizes.end(), [&](double h) { return h == cell_sizes[0]; }))
    throw std::invalid_argument("order fit: needs at least two distinct cell sizes");

  std::vector<double> x, y;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    x.push_back(std::log(cell_sizes[i]));
    y.push_back(std::log(errors[i]));
  }
  double intercept = 0, slope = 0, cov00 = 0, cov01 = 0, cov11 = 0, squares = 0;
  const int status =
      gsl_fit_linear(x.data(), 1, y.data(), 1, x.size(), &intercept, &slope, &cov00, &cov01, &cov11, &squares);
  if (status != GSL_SUCCESS || !std::isfinite(slope))
    throw std::invalid_argument(fmt::format("order fit: {}", gsl_strerror(status)));
  // Two points leave no residual: GSL then divides zero by zero degrees of freedom.
  const double spread = x.size() > 2 ? std::sqrt(cov11) : std::numeric_limits<double>::quiet_NaN();
  return {slope, spread, static_cast<int>(x.size())};
}

}  // namespace diptych::reports
