#include "runner/run/bar_points.hpp"

#include <algorithm>
#include <string>

#include "runner/run/curves.hpp"

namespace diptych::runner {
namespace {

using analytic::BarQuantity;

/// The points of a field, all bars in a row.
reports::BarPoints points_of(const Field& field, const std::string& kind) {
  reports::BarPoints points{kind, {}, field.x, {}, {}};
  int bar = 0;
  for (std::size_t i = 0; i < field.x.size(); ++i) {
    while (static_cast<std::size_t>(bar) < field.first.size() && field.first[static_cast<std::size_t>(bar)] <= i) ++bar;
    points.bar.push_back(bar);
  }
  return points;
}

}  // namespace

std::vector<reports::BarPoints> bar_points(const Snapshot& snapshot, bool elements,
                                           const analytic::ExactSolution* exact, const std::vector<Span>& bars) {
  std::vector<reports::BarPoints> all;
  const double time = snapshot.displacement.time;
  for (const auto& [q, name] : {std::pair{BarQuantity::displacement, "displacement"},
                                {BarQuantity::velocity, "velocity"},
                                {BarQuantity::stress, "stress"}}) {
    const Field& field = field_of(snapshot, q);
    const std::string kind = !elements ? "particles" : field.edges.empty() ? "nodes" : "elements";
    if (all.empty() || all.back().kind != kind) all.push_back(points_of(field, kind));
    reports::BarPoints& points = all.back();
    points.fields[name] = field.value;
    if (!exact || !exact->gives(q)) continue;
    std::vector<double>& values = points.exact[name];
    for (std::size_t i = 0; i < points.x.size(); ++i) {
      const Span& bar = bars[static_cast<std::size_t>(points.bar[i] - 1)];
      // An end that touches another bar's belongs to its own.
      const double inside = bars.size() > 1 ? 1e-9 * (bar.end - bar.begin) : 0;
      values.push_back(exact->at(q, std::clamp(points.x[i], bar.begin + inside, bar.end - inside), time));
    }
  }
  return all;
}

}  // namespace diptych::runner
