#include "runner/run/curves.hpp"

#include <algorithm>
#include <cmath>

#include "runner/input/build.hpp"

namespace diptych::runner {

using analytic::BarQuantity;

const Field& field_of(const Snapshot& s, BarQuantity q) {
  return q == BarQuantity::stress ? s.stress : q == BarQuantity::velocity ? s.velocity : s.displacement;
}

reports::Curve polyline(const Snapshot& snapshot, BarQuantity q, const Leaf& leaf, bool moves) {
  reports::Curve curve;
  for (std::size_t b = 0; b < snapshot.stress.first.size(); ++b) {
    const Field field = field_of(snapshot, q).of_bar(b), displacement = snapshot.displacement.of_bar(b);
    const bool steps = !field.edges.empty() && panel(leaf.method).elements;
    const auto place = [&](std::size_t i, const std::vector<double>& x) {
      return moves ? x[i] + displacement.value[i] : x[i];  // particles and FEM's nodes each carry one displacement
    };
    if (b > 0) curve.end_line();
    for (std::size_t i = 0; i < field.value.size(); ++i) {
      if (steps) {
        curve.x.insert(curve.x.end(), {place(i, field.edges), place(i + 1, field.edges)});
        curve.y.insert(curve.y.end(), {field.value[i], field.value[i]});
      } else {
        curve.add(place(i, field.x), field.value[i]);
      }
    }
  }
  return curve;
}

reports::Curve exact_line(const analytic::ExactSolution& exact, BarQuantity q, const std::vector<Span>& bars,
                          double time, bool moves) {
  const auto fronts = exact.fronts(time);
  reports::Curve curve;
  for (const Span& bar : bars) {
    const double length = bar.end - bar.begin, side = 1e-6 * length;
    std::vector<double> xs;
    for (int i = 1; i < 400; ++i) xs.push_back(bar.begin + length * i / 400);
    const bool alone = bars.size() == 1;  // ends that touch others belong to either bar
    xs.insert(xs.end(), {alone ? bar.begin : bar.begin + side / 10, alone ? bar.end : bar.end - side / 10});
    for (const analytic::Front& front : fronts) {
      for (const double x : {front.position - side, front.position + side}) {
        if (x >= bar.begin && x <= bar.end) xs.push_back(x);
      }
    }
    std::erase_if(xs, [&](double x) {
      return std::any_of(fronts.begin(), fronts.end(),
                         [&](const analytic::Front& front) { return std::abs(x - front.position) < 0.9 * side; });
    });
    std::sort(xs.begin(), xs.end());
    if (!curve.x.empty()) curve.end_line();
    for (const double x : xs) {
      curve.add(moves ? x + exact.at(BarQuantity::displacement, x, time) : x, exact.at(q, x, time));
    }
  }
  return curve;
}

bool drawn(const Case& c, const Leaf& leaf, bool Recorded::*what) {
  return std::any_of(c.figures.begin(), c.figures.end(), [&](const FigureSpec& f) {
    const bool method = std::find(f.methods.begin(), f.methods.end(), leaf.method) != f.methods.end();
    return method && f.recorded.*what && f.cells == leaf.cells && f.courant_of(leaf.method) == leaf.courant &&
           f.parameters == leaf.parameters && (!panel(leaf.method).particles || f.particles == leaf.particles);
  });
}

std::vector<long> steps_of_motion(const Case& c, const Leaf& leaf, const Stepping& stepping) {
  std::vector<long> steps;
  const auto add = [&](double from, double to) {
    for (int i = 0; i <= 120; ++i) {
      const long step = std::lround((from + (to - from) * i / 120) / stepping.time_step);
      if (step >= 1 && step <= stepping.steps) steps.push_back(step);
    }
  };
  for (const FigureSpec& f : c.figures) {
    if (!f.recorded.paths) continue;
    add(0, static_cast<double>(stepping.steps) * stepping.time_step);
    if (const auto& t = f.recorded.closely) add(instant(c, leaf.cells, (*t)[0]), instant(c, leaf.cells, (*t)[1]));
  }
  std::sort(steps.begin(), steps.end());
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  return steps;
}

void trace_paths(const std::vector<Snapshot>& snapshots, const Scene& scene, const analytic::ExactSolution* exact,
                 reports::Run& run) {
  constexpr int parts = 4;
  for (std::size_t b = 0; b < scene.bars.size(); ++b) {
    for (int k = 0; k <= parts; ++k) {
      if (!run.paths.x.empty()) {
        run.paths.end_line();
        run.path_origins.push_back(std::nan(""));
      }
      if (!run.exact_paths.x.empty()) run.exact_paths.end_line();
      for (const Snapshot& s : snapshots) {
        const Field u = s.displacement.of_bar(b);
        const std::size_t i = (u.x.size() - 1) * static_cast<std::size_t>(k) / parts;
        run.paths.add(u.x[i] + u.value[i], u.time);
        run.path_origins.push_back(u.x[i]);
        if (!exact || !exact->gives(BarQuantity::displacement)) continue;
        const double length = scene.bars[b].length, inside = 1e-9 * length;
        const double x = std::clamp(u.x[i], scene.bars[b].begin + inside, scene.bars[b].end() - inside);
        double place = x + exact->at(BarQuantity::displacement, x, u.time);
        // A struck face without hardening stands still while what is next to it flows into it.
        if (k == (b == 0 ? parts : 0)) place += (b == 0 ? -1 : 1) * exact->strain_of_face(u.time);
        run.exact_paths.add(place, u.time);
      }
    }
  }
}

}  // namespace diptych::runner
