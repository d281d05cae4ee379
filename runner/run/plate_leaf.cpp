#include "runner/run/plate_leaf.hpp"

#include <algorithm>
#include <cmath>

#include "analytic/plane_discrete.hpp"
#include "runner/compare/gauges.hpp"
#include "runner/compare/norms.hpp"
#include "runner/input/plate_build.hpp"
#include "runner/run/measures.hpp"
#include "runner/run/plate_measures.hpp"

namespace diptych::runner {
namespace {

using analytic::PlaneQuantity;

/// How cracks or dilatancy diffuse, and with which largest diffusivity; nothing where nothing does.
struct Diffusing {
  diffusion::Scheme* scheme = nullptr;
  double diffusivity = 0;
};
Diffusing diffusing(PlateSolid& solid) {
  if (auto* cracking = std::get_if<solid::Cracking>(&solid); cracking && cracking->evolution.diffusion)
    return {&cracking->evolution.diffusion->scheme, cracking->evolution.diffusion->mobility};
  if (auto* failing = std::get_if<solid::Failing>(&solid))
    return {&failing->spread.scheme, failing->spread.diffusivity};
  return {};
}

/// With forward Euler beside it one step satisfies the limits of both the wave and the diffusion: the paper's way.
double with_diffusion(double asked, PlateSolid solid, const diffusion::Grid& grid) {
  const auto [scheme, diffusivity] = diffusing(solid);
  if (scheme && *scheme == diffusion::Scheme::forward_euler && diffusivity > 0)
    asked = std::min(asked, diffusion::forward_euler_limit(grid, diffusivity));
  return asked;
}

}  // namespace

PlateLeaf::PlateLeaf(const Case& case_of_leaf, const Leaf& one)
    : LeafScene(case_of_leaf, one, panel(one.method), panel(one.method).plate, make_plate(case_of_leaf, one.cells),
                {grid_of(*case_of_leaf.plate, one.cells), one.particles}),
      exact_([&case_of_leaf] { return make_plane_exact(case_of_leaf); }) {}

double PlateLeaf::unit_time_step() const {
  return std::min(mesh.grid.hx, mesh.grid.hy) / elastic(scene).pressure_wave_speed();
}

double PlateLeaf::asked_time_step() const {
  return with_diffusion(leaf.courant * unit_time_step(), scene.solid, mesh.grid);
}

Read PlateLeaf::reads(bool keep_fields) const {
  const bool at_a_place = std::any_of(c.plate_probes.begin(), c.plate_probes.end(), [](const PlateProbe& probe) {
    return probe.reads.starts_with("displacement") || probe.reads.starts_with("velocity") ||
           probe.reads.starts_with("stress");
  });
  return keep_fields || at_a_place || row.half_steps ? Read::all : Read::whole;
}

std::optional<double> PlateLeaf::mass() const { return elastic(scene).density * scene.width * scene.height; }

void PlateLeaf::trace(const PlateRecord& record, const std::vector<long>&, const Stepping& stepping,
                      reports::Run& run) const {
  for (std::size_t n = 0; n < record.platen.size(); ++n) {
    run.platen.x.push_back(static_cast<double>(n + 1) * stepping.time_step + record.platen_ahead);
    run.platen.y.push_back(record.platen[n]);
  }
}

reports::Sample PlateLeaf::sample(const PlateSnapshot& own, const PlateSnapshot& at, double asked, bool keep_fields,
                                  const reports::Run& run) const {
  return measure_plane_sample(c, leaf, mesh.grid, own, at, asked, keep_fields, exact_.get(), run);
}

void PlateLeaf::measure(const PlateRecord& record, const Stepping& stepping, reports::Run& run) const {
  measure_plane_record(c, mesh.grid, record, run);
  measure_gauges(c, leaf, mesh.grid, record, stepping.time_step, run);
  measure_against_forward_euler(record, stepping, run);
}

/// The same scene with forward Euler at a step that both limits allow: largest difference of C_d over the samples, of
/// the largest.
void PlateLeaf::measure_against_forward_euler(const PlateRecord& record, const Stepping& stepping,
                                              reports::Run& run) const {
  const char* quantity = "cross.forward-euler";
  if (!asks_for(c, leaf, quantity)) return;
  Plate other = scene;
  diffusion::Scheme* scheme = diffusing(other.solid).scheme;
  if (!scheme) return;
  // It would be compared with itself: no measure, and a gate on it is INVALID.
  if (*scheme == diffusion::Scheme::forward_euler) return;
  *scheme = diffusion::Scheme::forward_euler;
  const double asked = with_diffusion(leaf.courant * unit_time_step(), other.solid, mesh.grid);
  const long parts = static_cast<long>(std::ceil(stepping.time_step / asked));
  Stepping finer = stepping;
  finer.time_step /= static_cast<double>(parts);
  finer.steps *= parts;
  for (long& after : finer.sample_after) after *= parts;
  const PlateRecord second = solver.run(other, mesh, finer);
  if (second.outcome != Outcome::completed) return;
  double largest = 0, difference = 0;
  for (std::size_t s = 0; s < record.snapshots.size(); ++s) {
    const auto &a = record.snapshots[s].concentration, &b = second.snapshots[s].concentration;
    for (std::size_t k = 0; k < a.size(); ++k) {
      largest = std::max(largest, std::abs(b[k]));
      difference = std::max(difference, std::abs(a[k] - b[k]));
    }
  }
  if (largest > 0) run.measures[quantity] = difference / largest;
}

std::vector<std::string> PlateLeaf::declared() const {
  if (leaf.variant.empty()) return c.features;
  std::vector<std::string> features;  // what a variant switches on is not written down again
  for (const auto& feature : plate_features(c)) features.push_back(feature.first);
  return features;
}

double PlateLeaf::differing(const PlateRecord& a, const PlateRecord& b, const PowersOfTwo& by, bool mirror) const {
  return runner::differing(a, b, by, mirror);
}

Plate PlateLeaf::scaled_scene(const PowersOfTwo& by) const { return scaled(scene, by); }

std::pair<Plate, PlateMesh> PlateLeaf::seen_from_behind() const { return {mirrored(scene), mesh}; }

std::vector<std::pair<std::string, Plate>> PlateLeaf::without_what_does_nothing() const {
  if (!changes_in_cells(scene.solid)) return {};
  Plate whole = scene;
  whole.solid = solid::Elastic{elastic(scene)};
  if (const auto* cone = compression_of(scene.solid)) std::get<solid::Elastic>(whole.solid).compression = *cone;
  return {{"bits.undamaged", std::move(whole)}};
}

std::optional<double> PlateLeaf::predicted_limit() const {
  const auto scheme = plane_discretisation(*c.plate, leaf, asked_time_step());
  if (!scheme) return {};
  return analytic::plane_stability_limit(medium_of(*c.plate), *scheme) / unit_time_step();
}

void describe_plate(const Case& c, const Leaf& leaf, reports::Run& run) {
  const diffusion::Grid grid = grid_of(*c.plate, leaf.cells);
  run.cell_size = grid.hx;
  const auto per_cell = leaf.particles.size() * leaf.particles.size();
  // Without particles: the corners and the middles of cells.
  run.unknowns =
      static_cast<int>(panel(leaf.method).particles ? 2 * per_cell * grid.cells() : 2 * (grid.nodes() + grid.cells()));
}

reports::Sample measure_plane_sample(const Case& c, const Leaf& leaf, const diffusion::Grid& grid,
                                     const PlateSnapshot& own, const PlateSnapshot& at, double asked, bool keep_fields,
                                     const analytic::PlaneSolution* exact, const reports::Run& run) {
  reports::Sample sample;
  sample.asked = asked;
  sample.time = own.time;
  const auto compare = [&](PlaneQuantity q, const char* name, const PointField& field) {
    if (!exact || !exact->gives(q) || field.x.empty()) return;
    const double scale = exact->scale(q);
    const Norms norms = plane_error(field, *exact, q, c.plate->exact.core());
    reports::FieldError error{name, field.time, scale, norms.l1, norms.l2, norms.linf, {}, {}, {}};
    const auto theory = plane_discretisation(*c.plate, leaf, run.time_step);
    if (theory && q != PlaneQuantity::concentration) {
      const auto predicted = [&](int norm) {
        auto value = analytic::predicted_error(*exact, *theory, q, norm, field.time);
        if (value) *value /= scale;
        return value;
      };
      error.predicted_l1 = predicted(1);
      error.predicted_l2 = predicted(2);
      error.predicted_linf = predicted(0);
    }
    sample.errors.push_back(error);
  };
  compare(PlaneQuantity::stress, "stress", own.stress);
  compare(PlaneQuantity::velocity, "velocity", own.velocity);
  compare(PlaneQuantity::displacement, "displacement", own.displacement);
  if (!own.concentration.empty())
    compare(PlaneQuantity::concentration, "concentration", nodes_as_points(grid, own.concentration, own.time));
  if (!at.crack_density.empty()) sample.plate = damage_fields(c, grid, at);
  for (const PlateProbe& probe : c.plate_probes)
    sample.probes.push_back(read_plate_probe(c, grid, probe, at, sample.plate, run.platen));
  if (keep_fields) sample.files = vtu_fields(grid, panel(leaf.method).elements, at);
  return sample;
}

void measure_plane_record(const Case& c, const diffusion::Grid& grid, const PlateRecord& record, reports::Run& run) {
  measure_fields(c, grid, record, run);
  if (record.diffusion_updates > 0)
    run.measures["diffusion.updates"] =
        static_cast<double>(record.diffusion_updates) / static_cast<double>(record.steps);
}

}  // namespace diptych::runner
