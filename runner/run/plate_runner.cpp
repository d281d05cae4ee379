#include "runner/run/plate_runner.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>

#include "analytic/diffusion_exact.hpp"
#include "analytic/diffusion_front.hpp"
#include "analytic/plane_discrete.hpp"
#include "analytic/plane_modes.hpp"
#include "analytic/plate_impact.hpp"
#include "fem/plate.hpp"
#include "hinge/diffusion/concentration.hpp"
#include "hinge/diffusion/dilatancy.hpp"
#include "mpm/plate.hpp"
#include "runner/compare/gauges.hpp"
#include "runner/input/messages.hpp"
#include "runner/input/plate_build.hpp"
#include "runner/run/measures.hpp"
#include "runner/run/plate_measures.hpp"

namespace diptych::runner {
namespace {

using analytic::PlaneQuantity;

bool mechanical(const Case& c) { return c.plate->material.has_value(); }

PlateSnapshot of_nodes(std::span<const double> values, long step, double time_step) {
  PlateSnapshot snapshot;
  snapshot.step = step;
  snapshot.time = static_cast<double>(step) * time_step;
  snapshot.concentration.assign(values.begin(), values.end());
  return snapshot;
}

/// Diffusion alone, on the nodes of the cells.
PlateRecord run_diffusion(const Case& c, const Leaf& leaf, const Stepping& stepping) {
  const PureDiffusion& spec = *c.plate->diffusion;
  const DiffusionScene scene = make_diffusion(c);
  const diffusion::Grid grid = grid_of(*c.plate, leaf.cells);
  const auto x = [&](int i) { return c.plate->width * i / grid.nx; };
  const auto y = [&](int j) { return c.plate->height * j / grid.ny; };
  diffusion::Concentration field(grid, spec.scheme, spec.reading);
  std::vector<double> diffusivity, area, source(grid.nodes());
  for (std::size_t k = 0; k < source.size(); ++k) area.push_back(node_area(grid, k));
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i)
      diffusivity.push_back(scene.diffusivity((x(i) + x(i + 1)) / 2, (y(j) + y(j + 1)) / 2));
  const auto at_nodes = [&](std::span<double> values, auto&& value) {
    for (int j = 0, k = 0; j <= grid.ny; ++j)
      for (int i = 0; i <= grid.nx; ++i, ++k) values[static_cast<std::size_t>(k)] = value(x(i), y(j));
  };
  if (scene.initial) at_nodes(field.values(), scene.initial);
  PlateRecord record;
  const double start = field.total();
  const bool fed_by_something = scene.rate || spec.corner_rate != 0;
  double fed = 0;
  auto next = stepping.sample_after.begin();
  const auto sample_after = [&](long steps) {
    if (next == stepping.sample_after.end() || *next != steps) return;
    ++next;
    record.snapshots.push_back(of_nodes(field.values(), steps, stepping.time_step));
    if (finite(record.snapshots.back())) return;
    record.outcome = Outcome::unstable;
    record.message = "a sampled value is not finite, at step " + std::to_string(steps);
  };
  sample_after(0);
  for (long n = 0; n < stepping.steps && record.outcome == Outcome::completed; ++n) {
    if (stepping.cancelled && *stepping.cancelled) {
      record.outcome = Outcome::cancelled;
      break;
    }
    const double middle = (static_cast<double>(n) + 0.5) * stepping.time_step;
    if (scene.rate) at_nodes(source, [&](double px, double py) { return scene.rate(px, py, middle); });
    if (spec.corner_rate != 0) source[0] = spec.corner_rate / (grid.hx * grid.hy / 4);  // of the corner's quarter
    for (std::size_t k = 0; fed_by_something && k < source.size(); ++k) fed += source[k] * area[k] * stepping.time_step;
    field.step(diffusivity, source, stepping.time_step);
    record.steps = n + 1;
    sample_after(n + 1);
  }
  record.time = static_cast<double>(record.steps) * stepping.time_step;
  record.fed = fed + start;
  record.features = {"diffusion"};
  record.work.node_steps = field.node_updates();
  record.work.bytes = field.bytes();
  return record;
}

/// Dilatancy alone: held on the left side from the start, with the same ceiling everywhere.
PlateRecord run_dilatancy(const Case& c, const Leaf& leaf, const Stepping& stepping) {
  diffusion::Spread spread = *c.plate->diffusion->spread;
  spread.face = 0;
  const diffusion::Grid grid = grid_of(*c.plate, leaf.cells);
  diffusion::Dilatancy field(spread, grid);
  const std::vector<double> ceiling(grid.cells(), 1);
  PlateRecord record;
  auto next = stepping.sample_after.begin();
  const auto sample_after = [&](long steps) {
    if (next == stepping.sample_after.end() || *next != steps) return;
    ++next;
    record.snapshots.push_back(of_nodes(field.of_nodes(), steps, stepping.time_step));
  };
  sample_after(0);
  for (long n = 0; n < stepping.steps; ++n) {
    if (stepping.cancelled && *stepping.cancelled) {
      record.outcome = Outcome::cancelled;
      break;
    }
    field.advance(ceiling, stepping.time_step);
    record.steps = n + 1;
    sample_after(n + 1);
  }
  record.time = static_cast<double>(record.steps) * stepping.time_step;
  record.fed = field.fed();
  record.features = {"diffusion"};
  record.work.node_steps = field.node_updates();
  record.work.bytes = field.bytes();
  return record;
}

PlateRecord solve(const Case& c, const Plate& plate, const Leaf& leaf, const Stepping& stepping) {
  const Cells cells = cells_of(*c.plate, leaf.cells);
  const auto spread = spread_of(c, leaf.cells);
  if (leaf.method == "fem") return fem::run(plate, cells, c.plate->evolution, stepping, spread);
  return mpm::run(plate, cells, leaf.particles, scheme_of(leaf.method), c.plate->evolution, stepping, spread);
}

/// own: errors are those of each field at its own time, next to the instant; at: what is read and drawn is the
/// instant's.
reports::Sample measure_sample(const Case& c, const Leaf& leaf, const PlateSnapshot& own, const PlateSnapshot& at,
                               double asked, const analytic::PlaneSolution* exact, const Running& running,
                               const reports::Run& run) {
  reports::Sample sample;
  sample.asked = asked;
  sample.time = own.time;
  const auto compare = [&](PlaneQuantity q, const char* name, const PointField& field) {
    if (!exact || !exact->gives(q) || field.x.empty()) return;
    const double scale = exact->scale(q);
    const Norms norms = plane_error(field, *exact, q, c.plate->exact.core);
    reports::FieldError error{name, field.time, scale, norms.l1, norms.l2, norms.linf, {}, {}, {}};
    if (mechanical(c) && q != PlaneQuantity::concentration) {
      const auto theory = plane_discretisation(*c.plate, leaf, run.time_step);
      const auto predicted = [&](int norm) {
        auto value = analytic::predicted_error(*exact, theory, q, norm, field.time);
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
    compare(PlaneQuantity::concentration, "concentration",
            nodes_as_points(grid_of(*c.plate, leaf.cells), own.concentration, own.time));
  if (!at.crack_density.empty()) sample.plate = damage_fields(c, leaf, at);
  for (const PlateProbe& probe : c.plate_probes)
    sample.probes.push_back(read_plate_probe(c, leaf, probe, at, sample.plate, run.platen));
  if (running.keep_fields) sample.files = vtu_fields(c, leaf, at);
  return sample;
}

/// Compares the run with others of its scene that must be the same to the bit.
void measure_bits(const Case& c, const Leaf& leaf, const Plate& plate, const Stepping& stepping,
                  const PlateRecord& record, reports::Run& run) {
  const auto compare = [&](const char* quantity, const Case& other, const Plate& scene, const Stepping& with,
                           const PlateScale& by, bool mirror) {
    const PlateRecord second = solve(other, scene, leaf, with);
    if (second.outcome == Outcome::cancelled) {
      run.status = "cancelled";
    } else {
      run.measures[quantity] = differing(record, second, by, mirror);
    }
  };
  const auto asked = [&](const char* quantity) { return asks_for(c, leaf, quantity); };
  if (asked("bits.repeat")) compare("bits.repeat", c, plate, stepping, {}, false);
  if (asked("bits.threads")) {
    Stepping threaded = stepping;
    threaded.threads = 3;
    compare("bits.threads", c, plate, threaded, {}, false);
  }
  if (asked("bits.mirror")) compare("bits.mirror", c, mirrored(plate), stepping, {}, true);
  if (asked("bits.power-of-two")) {
    const PlateScale by{2, 4, 16, 32};
    Stepping longer = stepping;
    longer.time_step *= by.time();
    compare("bits.power-of-two", c, scaled(plate, by), longer, by, false);
  }
  if (asked("bits.undamaged") && c.plate->evolution) {
    Case elastic = c;
    elastic.plate->material = std::get<material::TensileDamage>(*c.plate->material).elastic;
    elastic.plate->evolution.reset();
    compare("bits.undamaged", elastic, make_plate(elastic, leaf.cells), stepping, {}, false);
  }
  if (asked("bits.undamaged") && c.plate->spread) {
    Case elastic = c;
    elastic.plate->material = std::get<material::FailureWave>(*c.plate->material).elastic;
    elastic.plate->spread.reset();
    compare("bits.undamaged", elastic, make_plate(elastic, leaf.cells), stepping, {}, false);
  }
}

/// The same scene with forward Euler at a step that both limits allow: largest difference of C_d over the samples, of
/// the largest.
void measure_against_forward_euler(const Case& c, const Leaf& leaf, const Plate& plate, const Stepping& stepping,
                                   const PlateRecord& record, reports::Run& run) {
  const char* quantity = "cross.forward-euler";
  if (!asks_for(c, leaf, quantity)) return;
  // It would be compared with itself: no measure, and a gate on it is INVALID.
  Case other = c;
  diffusion::Scheme& scheme = c.plate->spread ? other.plate->spread->scheme : other.plate->evolution->diffusion->scheme;
  if (scheme == diffusion::Scheme::forward_euler) return;
  scheme = diffusion::Scheme::forward_euler;
  const long parts = static_cast<long>(std::ceil(stepping.time_step / plate_step(other, leaf).asked));
  Stepping finer = stepping;
  finer.time_step /= static_cast<double>(parts);
  finer.steps *= parts;
  for (long& after : finer.sample_after) after *= parts;
  const PlateRecord second = solve(other, plate, leaf, finer);
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

void measure_limit(const Case& c, const Leaf& leaf, const Plate& plate, const TimeStep& step,
                   const std::atomic<bool>* cancelled, reports::Run& run) {
  for (const GateSpec& gate : c.gates) {
    if (gate.quantity != "critical_courant" || !matches(gate.where, leaf)) continue;
    const double predicted =
        analytic::plane_stability_limit(medium_of(*c.plate), plane_discretisation(*c.plate, leaf, step.asked)) /
        step.unit;
    const auto stable = [&](double courant) {
      Stepping trial;
      trial.time_step = courant * step.unit;
      trial.limit = predicted * step.unit;
      trial.books = Books::off;
      trial.gains = 1;  // what is asked is whether it grows without end
      trial.steps = gate.steps;
      trial.cancelled = cancelled;
      return solve(c, plate, leaf, trial).outcome == Outcome::completed;
    };
    run.measures["critical_courant"] = bisect_limit(stable, predicted);
    if (cancelled && *cancelled) run.status = "cancelled";
    run.measures["critical_courant.predicted"] = predicted;
    return;
  }
}

}  // namespace

TimeStep plate_step(const Case& c, const Leaf& leaf) {
  const PlateSpec& spec = *c.plate;
  const diffusion::Grid grid = grid_of(spec, leaf.cells);
  const double h = std::min(grid.hx, grid.hy);
  if (!mechanical(c)) {
    const DiffusionScene scene = make_diffusion(c);
    double largest = 0;
    const auto checked = [&](double d) {
      if (d >= 0) return d;
      throw InputError(fmt::format("{}: diffusion.diffusivity: found {:g} at the middle of some cell; allowed: >= 0",
                                   c.path.string(), d));
    };
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i)
        largest = std::max(largest, checked(scene.diffusivity((i + 0.5) * grid.hx, (j + 0.5) * grid.hy)));
    const bool explicit_ = spec.diffusion->scheme == diffusion::Scheme::forward_euler;
    const double unit = largest > 0 ? h * h / largest : c.times.back();
    return {leaf.courant * unit,
            explicit_ ? diffusion::forward_euler_limit(grid, largest) : std::numeric_limits<double>::infinity(), unit};
  }
  const Plate plate = make_plate(c, leaf.cells);
  const double unit = h / elastic(plate).pressure_wave_speed();
  const Cells cells = cells_of(spec, leaf.cells);
  const double limit = leaf.method == "fem"
                           ? fem::critical_time_step(plate, cells)
                           : mpm::critical_time_step(plate, cells, leaf.particles, scheme_of(leaf.method));
  double asked = leaf.courant * unit;
  // The paper's way: one step that satisfies the limits of both the wave and the diffusion.
  if (spec.evolution && spec.evolution->diffusion &&
      spec.evolution->diffusion->scheme == diffusion::Scheme::forward_euler)
    asked = std::min(asked, diffusion::forward_euler_limit(grid, spec.evolution->diffusion->mobility));
  if (spec.spread && spec.spread->scheme == diffusion::Scheme::forward_euler && spec.spread->diffusivity > 0)
    asked = std::min(asked, diffusion::forward_euler_limit(grid, spec.spread->diffusivity));
  return {asked, limit, unit};
}

reports::Run describe_plate(const Case& c, const Leaf& leaf) {
  reports::Run run;
  run.case_id = c.id;
  run.method = leaf.method;
  run.cells = leaf.cells;
  run.courant_asked = leaf.courant;
  run.particles = particles_label(leaf.particles);
  run.parameters = parameters_label(leaf);
  const diffusion::Grid grid = grid_of(*c.plate, leaf.cells);
  run.cell_size = grid.hx;
  const auto per_cell = leaf.particles.size() * leaf.particles.size();
  run.unknowns = static_cast<int>(leaf.method == "fem"         ? 2 * (grid.nodes() + grid.cells())
                                  : leaf.method == "diffusion" ? grid.nodes()
                                                               : 2 * per_cell * grid.cells());
  run.status = "cancelled";
  return run;
}

reports::Run run_plate(const Case& whole, const Leaf& leaf, const TimeStep& step, const Running& running) {
  const Case c = with_parameters(whole, leaf);
  reports::Run run = describe_plate(c, leaf);
  const auto exact = make_plane_exact(c);
  const bool at_a_place = std::any_of(c.plate_probes.begin(), c.plate_probes.end(), [](const PlateProbe& probe) {
    return probe.reads.starts_with("displacement") || probe.reads.starts_with("velocity") ||
           probe.reads.starts_with("stress");
  });
  const bool halves = running.keep_fields || at_a_place || leaf.method == "mpm-usf";  // whose damage stands there, too
  const Plan plan =
      plan_steps(c.times, step, what_to_meet(c), halves ? Read::all : Read::whole, books_of(c, leaf, running.books));
  Stepping stepping = plan.stepping;
  stepping.cancelled = running.cancelled;
  run.time_step = stepping.time_step;
  run.time_step_limit = step.limit;
  run.courant = stepping.time_step / step.unit;
  const Plate plate = mechanical(c) ? make_plate(c, leaf.cells) : Plate{};
  const auto begin = std::chrono::steady_clock::now();
  PlateRecord record = mechanical(c)                ? solve(c, plate, leaf, stepping)
                       : c.plate->diffusion->spread ? run_dilatancy(c, leaf, stepping)
                                                    : run_diffusion(c, leaf, stepping);
  run.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  take_outcome(record, run);
  if (mechanical(c)) {
    const double mass = elastic(plate).density * plate.width * plate.height;
    measure_ledger(mass, record.sums, record.ledger, run);
  }
  if (record.outcome != Outcome::completed) return run;

  for (std::size_t n = 0; n < record.platen.size(); ++n) {
    run.platen.x.push_back(static_cast<double>(n + 1) * stepping.time_step + record.platen_ahead);
    run.platen.y.push_back(record.platen[n]);
  }
  const std::vector<PlateSnapshot> own = taken_after(plan.nearest, record.snapshots);
  for (std::size_t i = 0; i < own.size(); ++i) {
    const PlateSnapshot at = at_instant(record.snapshots, own[i].step, stepping.time_step, c.times[i]);
    run.samples.push_back(measure_sample(c, leaf, own[i], at, c.times[i], exact.get(), running, run));
  }
  stepping.sample_after = plan.own_steps();
  record.snapshots = taken_after(stepping.sample_after, record.snapshots);
  measure_fields(c, leaf, record, run);
  if (record.diffusion_updates > 0)
    run.measures["diffusion.updates"] =
        static_cast<double>(record.diffusion_updates) / static_cast<double>(record.steps);
  measure_gauges(c, leaf, record, stepping.time_step, run);
  if (mechanical(c)) {
    measure_bits(c, leaf, plate, stepping, record, run);
    if ((c.plate->evolution && c.plate->evolution->diffusion) || c.plate->spread)
      measure_against_forward_euler(c, leaf, plate, stepping, record, run);
    measure_limit(c, leaf, plate, step, running.cancelled, run);
  }
  std::vector<std::string> declared = c.features;
  if (!leaf.variant.empty()) {  // what a variant switches on is not written down again
    declared.clear();
    for (const auto& feature : plate_features(c)) declared.push_back(feature.first);
  }
  if (leaf.method == "fem") {  // its mesh goes with the plate, and it has no particles to map velocities to
    std::erase(declared, "convection");
    std::erase(declared, "pic");
  }
  run.invalid = why_invalid(c, record.features, declared, run);
  return run;
}

std::string doubt_plane_exact(const Case& c) {
  const auto exact = make_plane_exact(c);
  const PlateSpec& plate = *c.plate;
  return exact ? doubt(exact->residual({plate.width, plate.height, plate.exact.core, c.times.front(), c.times.back()}))
               : "";
}

}  // namespace diptych::runner
