#include "runner/run/bar_leaf.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "analytic/discrete.hpp"
#include "analytic/viscous_front.hpp"
#include "runner/compare/norms.hpp"
#include "runner/run/bar_points.hpp"
#include "runner/run/curves.hpp"
#include "runner/run/doubt.hpp"
#include "runner/run/measures.hpp"
#include "runner/run/outcomes.hpp"
#include "runner/run/probe.hpp"

namespace diptych::runner {
namespace {

using analytic::BarQuantity;

constexpr std::array<std::pair<BarQuantity, const char*>, 3> bar_quantities{
    {{BarQuantity::stress, "stress"},
     {BarQuantity::velocity, "velocity"},
     {BarQuantity::displacement, "displacement"}}};

double differing_numbers(const Record& a, const Record& b, const PowersOfTwo& by, bool mirror) {
  double count = a.snapshots.size() == b.snapshots.size() && a.outcome == b.outcome ? 0 : 1;
  bool moved = false;
  const auto compare = [&](const Field& first, const Field& second, double factor, double sign) {
    const std::size_t n = first.value.size();
    if (second.value.size() != n) ++count;
    for (std::size_t i = 0; i < std::min(n, second.value.size()); ++i) {
      const double other = mirror ? sign * second.value[n - 1 - i] : second.value[i];
      if (!(first.value[i] * factor == other)) ++count;
      moved = moved || first.value[i] != 0;
    }
  };
  for (std::size_t s = 0; s < std::min(a.snapshots.size(), b.snapshots.size()); ++s) {
    compare(a.snapshots[s].stress, b.snapshots[s].stress, by.stress, 1);
    compare(a.snapshots[s].velocity, b.snapshots[s].velocity, by.velocity(), -1);
    compare(a.snapshots[s].displacement, b.snapshots[s].displacement, by.displacement(), -1);
  }
  return moved ? count : std::nan("");  // zeros are equal to anything's zeros
}

/// What a record says of one bar.
Record bar_of(const Record& record, std::size_t bar) {
  Record part;
  part.outcome = record.outcome;
  for (const Snapshot& s : record.snapshots)
    part.snapshots.push_back({s.step, s.stress.of_bar(bar), s.velocity.of_bar(bar), s.displacement.of_bar(bar)});
  return part;
}

/// In the checkerboard that blows up first a point is compressed every other step, so viscosity of compression alone is
/// half as strong on it: q = ρν(D − |D|)/2 with one |D| for all points.
double blow_up_strength(const Case& c) { return viscosity_strength(c) / (c.viscosity->form.always ? 1 : 2); }

}  // namespace

BarLeaf::BarLeaf(const Case& case_of_leaf, const Leaf& one)
    : LeafScene(case_of_leaf, one, panel(one.method), panel(one.method).bars, make_scene(case_of_leaf, one.cells),
                {one.cells, one.particles}),
      exact_([&case_of_leaf, &one] { return make_exact(case_of_leaf, one); }) {}

double BarLeaf::unit_time_step() const { return scene.bars[0].length / mesh.cells / largest_wave_speed(scene); }

std::vector<double> BarLeaf::instants() const {
  std::vector<double> times;
  for (const double time : c.times) times.push_back(instant(c, leaf, time));
  return times;
}

std::vector<long> BarLeaf::more_samples(const Stepping& stepping) const {
  return drawn(c, leaf, &Recorded::paths) ? steps_of_motion(c, leaf, stepping) : std::vector<long>{};
}

std::optional<double> BarLeaf::mass() const {
  double mass = 0;
  for (const BarSpec& bar : c.bars) mass += material::density(bar.material) * bar.length;
  return mass;
}

void BarLeaf::trace(const Record& record, const std::vector<long>& more, const Stepping&, reports::Run& run) const {
  if (!more.empty()) trace_paths(taken_after(more, record.snapshots), scene, exact_.get(), run);
}

reports::Sample BarLeaf::sample(const Snapshot& own, const Snapshot& at, double asked, bool keep_fields,
                                const reports::Run& run) const {
  const double unit = time_unit(c, c.time_unit), origin = instant(c, leaf, 0);
  const double time = static_cast<double>(own.step) * run.time_step;
  const bool moves = c.convected || c.bars.size() > 1;
  const std::vector<Span> bars = spans_of(c, leaf.cells);
  reports::Sample sample;
  sample.asked = asked;
  sample.time = (time - origin) / unit;
  const auto theory = discretisation(c, leaf, run.courant);
  const analytic::ExactSolution* exact = exact_.get();
  for (const auto& [q, name] : bar_quantities) {
    const Field& field = field_of(own, q);
    if (drawn(c, leaf, &Recorded::curves)) {
      sample.curves[name] = polyline(at, q, leaf, moves);
      if (exact && exact->gives(q) && (!moves || exact->gives(BarQuantity::displacement))) {
        sample.exact_curves[name] = exact_line(*exact, q, bars, at.displacement.time, moves);
      }
    }
    if (!exact || !exact->gives(q)) continue;
    const double scale = exact->scale(q);
    const Norms norms = error_norms(field, *exact, q, bars);
    reports::FieldError error{name, (field.time - origin) / unit, scale, norms.l1, norms.l2, norms.linf, {}, {}, {}};
    const auto predicted = [&](analytic::Norm norm) {
      const double cell = c.first().length / leaf.cells;
      const double nu = c.viscosity ? viscosity_strength(c) * material::wave_speed(c.first().material) * cell : 0;
      std::optional<double> value;
      if (c.viscosity && nu > 0)
        value = analytic::viscous_step_error(*exact, nu, q, norm, field.time);
      else if (!c.viscosity && theory)
        value = analytic::predicted_error(*exact, *theory, q, norm, field.time);
      if (value) *value /= scale;
      return value;
    };
    error.predicted_l1 = predicted(analytic::Norm::l1);
    error.predicted_l2 = predicted(analytic::Norm::l2);
    error.predicted_linf = predicted(analytic::Norm::linf);
    sample.errors.push_back(error);
  }
  for (const Probe& probe : c.probes) sample.probes.push_back(read_probe(c, leaf, probe, at));
  if (keep_fields) sample.bar_points = bar_points(at, row.elements, exact, bars);
  return sample;
}

void BarLeaf::measure(const Record& record, const Stepping& stepping, reports::Run& run) const {
  measure_outcomes(scene, spans_of(c, leaf.cells), record, stepping.time_step, exact_.get(), run);
  measure_early_contact(record, run);
  measure_alone(record, stepping, run);
  measure_against_fem(record, stepping, run);
}

/// How much before their ends meet bars feel each other through the grid.
void BarLeaf::measure_early_contact(const Record& record, reports::Run& run) const {
  const double ends_meet = contact_time(c, leaf.cells), predicted = ends_meet - contact_time(c, leaf);
  if (record.touches.empty() || !std::isfinite(ends_meet) || !row.grid_contact) return;
  run.measures["contact.early"] = ends_meet - record.touches.front().from;
  run.measures["contact.early.predicted"] = predicted;
}

/// Bars that never meet must move as each of them does by itself.
void BarLeaf::measure_alone(const Record& record, const Stepping& stepping, reports::Run& run) const {
  if (!asks_for(c, leaf, "bits.alone") || scene.bars.size() < 2) return;
  double count = 0;
  for (std::size_t b = 0; b < scene.bars.size(); ++b) {
    const Record second = solver.run(alone(scene, b), {cells_of(scene, b, mesh.cells), mesh.particles}, stepping);
    if (second.outcome == Outcome::cancelled) run.status = "cancelled";
    count += differing_numbers(bar_of(record, b), second, {}, false);
  }
  run.measures["bits.alone"] = count;
}

/// MUSL with one centred particle a cell sees the grid through the average of a cell's two nodes, which makes it FEM
/// with elements twice as long at the same time step: C² s² (1 − s²) = (C/2)² sin² kh. Both cells of a pair then hold
/// the stress of the element. Measures the largest difference, as a part of the largest stress.
void BarLeaf::measure_against_fem(const Record& record, const Stepping& stepping, reports::Run& run) const {
  const char* quantity = "cross.fem-on-half-the-cells";
  const bool same_method =
      row.bar_theory == analytic::Scheme::mpm_musl && mesh.particles == std::vector{0.5} && mesh.cells % 2 == 0;
  if (!asks_for(c, leaf, quantity) || !same_method) return;
  const Record fem = panel(analytic::Scheme::fem).bars.run(scene, {mesh.cells / 2, {}}, stepping);
  if (fem.outcome != Outcome::completed) return;  // no measure, and a gate on it is INVALID
  double largest = 0, difference = 0;
  for (std::size_t s = 0; s < record.snapshots.size(); ++s) {
    const auto &particles = record.snapshots[s].stress.value, &elements = fem.snapshots[s].stress.value;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      largest = std::max(largest, std::abs(elements[p / 2]));
      difference = std::max(difference, std::abs(particles[p] - elements[p / 2]));
    }
  }
  if (largest > 0) run.measures[quantity] = difference / largest;
}

std::string BarLeaf::doubt() const { return doubt_own(c, exact_.get(), instants().back()); }

double BarLeaf::differing(const Record& a, const Record& b, const PowersOfTwo& by, bool mirror) const {
  return differing_numbers(a, b, by, mirror);
}

Scene BarLeaf::scaled_scene(const PowersOfTwo& by) const { return scaled(scene, by); }

std::pair<Scene, BarMesh> BarLeaf::seen_from_behind() const {
  BarMesh behind = mesh;
  behind.cells = cells_of(scene, scene.bars.size() - 1, mesh.cells);  // its last bar is the first one now
  std::reverse(behind.particles.begin(), behind.particles.end());
  for (double& xi : behind.particles) xi = 1 - xi;
  return {mirrored(scene), behind};
}

std::vector<std::pair<std::string, Scene>> BarLeaf::without_what_does_nothing() const {
  if (!scene.viscosity) return {};
  Scene without = scene;
  without.viscosity.reset();
  return {{"bits.inviscid", std::move(without)}};
}

std::optional<double> BarLeaf::predicted_limit() const {
  const auto scheme = discretisation(c, leaf, leaf.courant);
  if (!scheme) return {};
  const double predicted = analytic::stability_limit(*scheme);
  return c.viscosity ? analytic::viscous_stability_limit(predicted, blow_up_strength(c)) : predicted;
}

void describe_bars(const Case& c, const Leaf& leaf, reports::Run& run) {
  const bool particles = panel(leaf.method).particles;
  run.cell_size = c.first().length / leaf.cells;
  run.unknowns = particles ? 0 : 0 - (c.left == Support::fixed) - (c.right == Support::fixed);
  for (const BarSpec& bar : c.bars) {
    const int cells = static_cast<int>(std::lround(bar.length / run.cell_size));
    run.unknowns += particles ? cells * static_cast<int>(leaf.particles.size()) : cells + 1;
  }
}

}  // namespace diptych::runner
