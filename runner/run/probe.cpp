#include "runner/run/probe.hpp"

#include <algorithm>

#include "analytic/boundary_layer.hpp"
#include "runner/compare/norms.hpp"
#include "runner/input/build.hpp"

namespace diptych::runner {
namespace {

double end_share(const Case& c, const Leaf& leaf, const LoadSpec& load) {
  if (load.transfer == Transfer::node) return 1;
  std::vector<double> distances;
  for (const double xi : leaf.particles) distances.push_back(load.end == End::left ? xi : 1 - xi);
  std::sort(distances.begin(), distances.end());
  const double cell = c.first().length / leaf.cells;
  return analytic::end_stress_share(distances, length_of(c, load.layer_thickness, leaf.cells) / cell);
}

}  // namespace

reports::ProbeValue read_probe(const Case& c, const Leaf& leaf, const Probe& probe, const Snapshot& snapshot) {
  const Field& field = probe.field == "stress"     ? snapshot.stress
                       : probe.field == "velocity" ? snapshot.velocity
                                                   : snapshot.displacement;
  const double x = length_of(c, probe.at, leaf.cells), cell = c.first().length / leaf.cells;
  const std::vector<Span> bars = spans_of(c, leaf.cells);
  std::size_t bar = bars.size() - 1;  // where two touch, the right one
  while (bar > 0 && x < bars[bar].begin) --bar;
  reports::ProbeValue value{probe.id, value_at(field.of_bar(bar), x), {}};
  for (const LoadSpec& load : c.loads) {
    const bool in_end_cell = load.end == End::left ? x < cell : x > bars.back().end - cell;
    const bool ramp = load.history == "ramp", step = load.history == "step";
    const double steady =
        load.start.value * time_unit(c, load.start.unit) + (ramp ? load.rise.value * time_unit(c, load.rise.unit) : 0);
    if (probe.field == "stress" && in_end_cell && (step || ramp) && field.time > steady) {
      value.predicted = load.traction * end_share(c, leaf, load);
    }
  }
  return value;
}

}  // namespace diptych::runner
