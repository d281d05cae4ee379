#include "cases/norms.hpp"

#include <gsl/gsl_integration.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace diptych::cases {

double value_at(const Field& field, double x) {
  if (!field.edges.empty()) {
    const auto above = std::upper_bound(field.edges.begin() + 1, field.edges.end() - 1, x);
    return field.value[static_cast<std::size_t>(above - field.edges.begin()) - 1];
  }
  if (field.x.size() == 1) return field.value[0];
  const auto above = std::upper_bound(field.x.begin() + 1, field.x.end() - 1, x);
  const auto i = static_cast<std::size_t>(above - field.x.begin());
  const double s = (x - field.x[i - 1]) / (field.x[i] - field.x[i - 1]);
  return (1 - s) * field.value[i - 1] + s * field.value[i];
}

Norms error_norms(const Field& field, const analytic::ExactSolution& exact, analytic::Quantity quantity,
                  double length) {
  std::vector<double> breaks = field.edges.empty() ? field.x : field.edges;
  breaks.push_back(0);
  breaks.push_back(length);
  for (const analytic::Front& front : exact.fronts(field.time)) breaks.push_back(front.position);
  std::sort(breaks.begin(), breaks.end());

  constexpr std::size_t points = 4;
  const std::unique_ptr<gsl_integration_glfixed_table, void (*)(gsl_integration_glfixed_table*)> rule(
      gsl_integration_glfixed_table_alloc(points), gsl_integration_glfixed_table_free);
  const double scale = exact.scale(quantity);  // divided by before squaring, or small fields would underflow
  Norms norms;
  double covered = 0;
  bool is_nan = false;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double begin = breaks[i], end = breaks[i + 1];
    // A front that stands on an edge but for round-off leaves a sliver on whose side of the front nothing can be said.
    if (begin < 0 || end > length || end - begin < 1e-12 * length) continue;
    for (std::size_t g = 0; g < points; ++g) {
      double x = 0, weight = 0;
      gsl_integration_glfixed_point(begin, end, g, &x, &weight, rule.get());
      const double error = std::abs(value_at(field, x) - exact.at(quantity, x, field.time)) / scale;
      is_nan = is_nan || std::isnan(error);  // std::max would drop it
      norms.l1 += weight * error;
      norms.l2 += weight * error * error;
      norms.linf = std::max(norms.linf, error);
    }
    covered += end - begin;
  }
  if (is_nan || !(covered > 0)) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan, nan};
  }
  norms.l1 /= covered;
  norms.l2 = std::sqrt(norms.l2 / covered);
  return norms;
}

}  // namespace diptych::cases
