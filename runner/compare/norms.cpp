#include "runner/compare/norms.hpp"

#include <gsl/gsl_integration.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace diptych::runner {

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

namespace {

/// The interior of a bar between `marks` and its ends. Two marks that are one but for round-off leave a sliver on whose
/// side of a front nothing can be said, so it is left out.
template <class F>
void for_each_piece(const Span& bar, std::vector<double> marks, const std::vector<analytic::Front>& fronts, F&& f) {
  marks.push_back(bar.begin);
  marks.push_back(bar.end);
  for (const analytic::Front& front : fronts) marks.push_back(front.position);
  std::sort(marks.begin(), marks.end());
  const double sliver = 1e-12 * std::max({bar.end - bar.begin, std::abs(bar.begin), std::abs(bar.end)});
  for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
    const double begin = std::max(marks[i], bar.begin), end = std::min(marks[i + 1], bar.end);
    if (end - begin >= sliver) f(begin, end);
  }
}

}  // namespace

Norms error_norms(const Field& field, const analytic::ExactSolution& exact, analytic::BarQuantity quantity,
                  const std::vector<Span>& bars) {
  constexpr std::size_t points = 4;
  const std::unique_ptr<gsl_integration_glfixed_table, void (*)(gsl_integration_glfixed_table*)> rule(
      gsl_integration_glfixed_table_alloc(points), gsl_integration_glfixed_table_free);
  const double scale = exact.scale(quantity);  // divided by before squaring, or small fields would underflow
  const auto fronts = exact.fronts(field.time);
  Norms norms;
  double covered = 0;
  bool is_nan = false;
  for (std::size_t b = 0; b < bars.size(); ++b) {
    const Field part = field.of_bar(b);
    for_each_piece(bars[b], part.edges.empty() ? part.x : part.edges, fronts, [&](double begin, double end) {
      for (std::size_t g = 0; g < points; ++g) {
        double x = 0, weight = 0;
        gsl_integration_glfixed_point(begin, end, g, &x, &weight, rule.get());
        const double error = std::abs(value_at(part, x) - exact.at(quantity, x, field.time)) / scale;
        is_nan = is_nan || std::isnan(error);  // std::max would drop it
        norms.l1 += weight * error;
        norms.l2 += weight * error * error;
        norms.linf = std::max(norms.linf, error);
      }
      covered += end - begin;
    });
  }
  if (is_nan || !(covered > 0)) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan, nan};
  }
  norms.l1 /= covered;
  norms.l2 = std::sqrt(norms.l2 / covered);
  return norms;
}

double mean_between_fronts(const analytic::ExactSolution& exact, analytic::BarQuantity quantity, const Span& bar,
                           double t) {
  double sum = 0, covered = 0;
  for_each_piece(bar, {}, exact.fronts(t), [&](double begin, double end) {
    sum += (end - begin) * exact.at(quantity, (begin + end) / 2, t);
    covered += end - begin;
  });
  return sum / covered;
}

}  // namespace diptych::runner
