#include "runner/run/runner.hpp"

#include <fmt/core.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>

#include "analytic/bar_impact.hpp"
#include "analytic/bar_wave.hpp"
#include "analytic/discrete.hpp"
#include "analytic/plastic_impact.hpp"
#include "analytic/standing_mode.hpp"
#include "analytic/viscous_front.hpp"
#include "fem/bar.hpp"
#include "mpm/bar.hpp"
#include "runner/compare/norms.hpp"
#include "runner/input/build.hpp"
#include "runner/input/case_file.hpp"
#include "runner/run/curves.hpp"
#include "runner/run/measures.hpp"
#include "runner/run/outcomes.hpp"
#include "runner/run/plate_runner.hpp"
#include "runner/run/probe.hpp"

namespace diptych::runner {
namespace {

using analytic::Quantity;

constexpr std::array<std::pair<Quantity, const char*>, 3> quantities{
    {{Quantity::stress, "stress"}, {Quantity::velocity, "velocity"}, {Quantity::displacement, "displacement"}}};

double critical_time_step(const Scene& scene, const Leaf& leaf) {
  if (leaf.method == "fem") return fem::critical_time_step(scene, leaf.cells);
  return mpm::critical_time_step(scene, leaf.cells, leaf.particles, scheme_of(leaf.method));
}

Record solve(const Scene& scene, const Leaf& leaf, const Stepping& stepping) {
  if (leaf.method == "fem") return fem::run(scene, leaf.cells, stepping);
  return mpm::run(scene, leaf.cells, leaf.particles, scheme_of(leaf.method), stepping);
}

/// Time of one Courant number of one, of the fastest bar [s].
double cell_time(const Scene& scene, const Leaf& leaf) {
  return scene.bars[0].length / leaf.cells / largest_wave_speed(scene);
}

/// Numbers that differ between two records after scaling; a different number of samples counts as one more. NaN where
/// there are only zeros.
double differing(const Record& a, const Record& b, const PowersOfTwo& by, bool mirror) {
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

void measure_bits(const Case& c, const Leaf& leaf, const Scene& scene, const Stepping& stepping, const Record& record,
                  reports::Run& run) {
  const PowersOfTwo one{1, 1, 1, 1};
  const auto compare = [&](const char* quantity, const Scene& other, const Leaf& on, const Stepping& with,
                           const PowersOfTwo& by, bool mirror) {
    const Record second = solve(other, on, with);
    if (second.outcome == Outcome::cancelled) {
      run.status = "cancelled";  // stopped, not different
    } else {
      run.measures[quantity] = differing(record, second, by, mirror);
    }
  };
  if (asks_for(c, leaf, "bits.repeat")) compare("bits.repeat", scene, leaf, stepping, one, false);
  if (asks_for(c, leaf, "bits.inviscid") && scene.viscosity) {
    Scene without = scene;
    without.viscosity.reset();
    compare("bits.inviscid", without, leaf, stepping, one, false);
  }
  if (asks_for(c, leaf, "bits.alone") && scene.bars.size() > 1) {
    double count = 0;
    for (std::size_t b = 0; b < scene.bars.size(); ++b) {
      const Scene single = alone(scene, b);
      const Leaf on{leaf.method, cells_of(scene, b, leaf.cells), leaf.courant, leaf.particles};
      const Record second = solve(single, on, stepping);
      if (second.outcome == Outcome::cancelled) run.status = "cancelled";
      count += differing(bar_of(record, b), second, one, false);
    }
    run.measures["bits.alone"] = count;
  }
  if (asks_for(c, leaf, "bits.power-of-two")) {
    const PowersOfTwo by;
    Stepping longer = stepping;
    longer.time_step *= by.time();
    compare("bits.power-of-two", scaled(scene, by), leaf, longer, by, false);
  }
  if (asks_for(c, leaf, "bits.mirror")) {
    Leaf behind = leaf;
    behind.cells = cells_of(scene, scene.bars.size() - 1, leaf.cells);  // its last bar is the first one now
    std::reverse(behind.particles.begin(), behind.particles.end());
    for (double& xi : behind.particles) xi = 1 - xi;
    compare("bits.mirror", mirrored(scene), behind, stepping, one, true);
  }
}

/// MUSL with one centred particle a cell sees the grid through the average of a cell's two nodes, which makes it FEM
/// with elements twice as long at the same time step: C² s² (1 − s²) = (C/2)² sin² kh. Both cells of a pair then hold
/// the stress of the element. Measures the largest difference, as a part of the largest stress.
void measure_against_fem(const Case& c, const Leaf& leaf, const Scene& scene, const Stepping& stepping,
                         const Record& record, reports::Run& run) {
  const char* quantity = "cross.fem-on-half-the-cells";
  const bool same_method = leaf.method == "mpm-musl" && leaf.particles == std::vector{0.5} && leaf.cells % 2 == 0;
  if (!asks_for(c, leaf, quantity) || !same_method) return;
  const Record fem = solve(scene, {"fem", leaf.cells / 2, leaf.courant / 2, {}}, stepping);
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

/// By bisection, at which the scene stays bounded for the given number of steps.
double find_limit(const Scene& scene, const Leaf& leaf, double predicted, long steps,
                  const std::atomic<bool>* cancelled) {
  const auto stable = [&](double courant) {
    Stepping trial;
    trial.time_step = courant * cell_time(scene, leaf);
    trial.limit = predicted * cell_time(scene, leaf);
    trial.books = Books::off;
    trial.gains = 1;  // what is asked is whether it grows without end
    trial.steps = steps;
    trial.cancelled = cancelled;
    return solve(scene, leaf, trial).outcome == Outcome::completed;
  };
  return bisect_limit(stable, predicted);
}

/// In the checkerboard that blows up first a point is compressed every other step, so viscosity of compression alone is
/// half as strong on it: q = ρν(D − |D|)/2 with one |D| for all points.
double blow_up_strength(const Case& c) { return viscosity_strength(c) / (c.viscosity->form.always ? 1 : 2); }

void measure_limit(const Case& c, const Leaf& leaf, const Scene& scene, const std::atomic<bool>* cancelled,
                   reports::Run& run) {
  for (const GateSpec& gate : c.gates) {
    if (gate.quantity != "critical_courant" || !matches(gate.where, leaf)) continue;
    double predicted = analytic::stability_limit(discretisation(c, leaf, leaf.courant));
    if (c.viscosity) predicted = analytic::viscous_stability_limit(predicted, blow_up_strength(c));
    run.measures["critical_courant"] = find_limit(scene, leaf, predicted, gate.steps, cancelled);
    if (cancelled && *cancelled) run.status = "cancelled";
    run.measures["critical_courant.predicted"] = predicted;
    return;
  }
}

/// own: errors are those of each field at its own time, next to the instant; at: what is read and drawn is the
/// instant's.
reports::Sample measure_sample(const Case& c, const Leaf& leaf, const Snapshot& own, const Snapshot& at, double asked,
                               double time, const analytic::ExactSolution* exact, const reports::Run& run) {
  const double unit = time_unit(c, c.time_unit), origin = instant(c, leaf, 0);
  const bool moves = c.convected || c.bars.size() > 1;
  const std::vector<Span> bars = spans_of(c, leaf.cells);
  reports::Sample sample;
  sample.asked = asked;
  sample.time = (time - origin) / unit;
  const auto theory = discretisation(c, leaf, run.courant);
  for (const auto& [q, name] : quantities) {
    const Field& field = field_of(own, q);
    if (drawn(c, leaf, "profiles")) {
      sample.curves[name] = polyline(at, q, leaf, moves);
      if (exact && exact->gives(q)) {
        sample.exact_curves[name] = exact_line(*exact, q, bars, at.displacement.time, moves);
      }
    }
    if (!exact || !exact->gives(q)) continue;
    const double scale = exact->scale(q);
    const Norms norms = error_norms(field, *exact, q, bars);
    reports::FieldError error{name, (field.time - origin) / unit, scale, norms.l1, norms.l2, norms.linf, {}, {}, {}};
    const auto predicted = [&](analytic::Norm norm) {
      const double nu =
          c.viscosity ? viscosity_strength(c) * material::wave_speed(c.first().material) * theory.cell : 0;
      auto value = c.viscosity ? analytic::viscous_step_error(*exact, nu, q, norm, field.time)
                               : analytic::predicted_error(*exact, theory, q, norm, field.time);
      if (value) *value /= scale;
      return value;
    };
    error.predicted_l1 = predicted(analytic::Norm::l1);
    error.predicted_l2 = predicted(analytic::Norm::l2);
    error.predicted_linf = predicted(analytic::Norm::linf);
    sample.errors.push_back(error);
  }
  for (const Probe& probe : c.probes) sample.probes.push_back(read_probe(c, leaf, probe, at));
  return sample;
}

/// How much before their ends meet bars feel each other through the grid.
void measure_early_contact(const Case& c, const Leaf& leaf, const Record& record, reports::Run& run) {
  const double ends_meet = contact_time(c, fem_on(leaf.cells)), predicted = ends_meet - contact_time(c, leaf);
  if (record.touches.empty() || !std::isfinite(ends_meet) || leaf.method == "fem") return;
  run.measures["contact.early"] = ends_meet - record.touches.front().from;
  run.measures["contact.early.predicted"] = predicted;
}

bool differs_by_run(const Case& c) {
  const analytic::BarSolution* row = solution_of(c);
  return row && row->of_impact;
}

/// Why an exact solution that is one for all runs is not to be trusted, or nothing.
std::string doubt_exact(const Case& c) {
  if (c.plate) return doubt_plane_exact(c);
  if (differs_by_run(c)) return {};
  const auto exact = make_exact(c, {});
  return exact ? doubt(exact->residual(instant(c, fem_on(1), c.times.back()))) : "";
}

reports::Run describe(const Case& c, const Leaf& leaf) {
  if (c.plate) return describe_plate(with_parameters(c, leaf), leaf);
  reports::Run run;
  run.case_id = c.id;
  run.method = leaf.method;
  run.cells = leaf.cells;
  run.courant_asked = leaf.courant;
  run.particles = particles_label(leaf.particles);
  run.parameters = parameters_label(leaf);
  run.cell_size = c.first().length / leaf.cells;
  run.unknowns = leaf.method == "fem" ? 0 - (c.left == Support::fixed) - (c.right == Support::fixed) : 0;
  for (const BarSpec& bar : c.bars) {
    const int cells = static_cast<int>(std::lround(bar.length / run.cell_size));
    run.unknowns += leaf.method == "fem" ? cells + 1 : cells * static_cast<int>(leaf.particles.size());
  }
  run.status = "cancelled";
  return run;
}

}  // namespace

namespace {

TimeStep bar_step(const Case& c, const Leaf& leaf) {
  const Scene scene = make_scene(c, leaf.cells);
  const double unit = cell_time(scene, leaf);
  return {leaf.courant * unit, critical_time_step(scene, leaf), unit};
}

}  // namespace

TimeStep step_of(const Case& whole, const Leaf& leaf) {
  const Case c = with_parameters(whole, leaf);
  return c.plate ? plate_step(c, leaf) : bar_step(c, leaf);
}

reports::Run run_leaf(const Case& whole, const Leaf& leaf, const Running& running) {
  return run_leaf(whole, leaf, step_of(whole, leaf), running);
}

reports::Run run_leaf(const Case& whole, const Leaf& leaf, const TimeStep& step, const Running& running) {
  if (whole.plate) return run_plate(whole, leaf, step, running);
  const Case c = with_parameters(whole, leaf);
  reports::Run run = describe(c, leaf);
  const Scene scene = make_scene(c, leaf.cells);
  const auto exact = make_exact(c, leaf);
  std::vector<double> instants;
  for (const double time : c.times) instants.push_back(instant(c, leaf, time));
  const Plan plan = plan_steps(instants, step, what_to_meet(c), Read::all, books_of(c, leaf, running.books));
  Stepping stepping = plan.stepping;
  stepping.cancelled = running.cancelled;
  run.time_step = stepping.time_step;
  run.time_step_limit = step.limit;
  run.courant = stepping.time_step / step.unit;
  const std::vector<long> motion = drawn(c, leaf, "motion") ? steps_of_motion(c, leaf, stepping) : std::vector<long>{};
  const std::vector<long>& samples = plan.stepping.sample_after;
  stepping.sample_after.clear();
  std::set_union(samples.begin(), samples.end(), motion.begin(), motion.end(),
                 std::back_inserter(stepping.sample_after));
  const auto begin = std::chrono::steady_clock::now();
  Record record = solve(scene, leaf, stepping);
  run.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  take_outcome(record, run);
  double mass = 0;
  for (const BarSpec& bar : c.bars) mass += material::density(bar.material) * bar.length;
  measure_ledger(mass, record.sums, record.ledger, run);
  if (record.outcome != Outcome::completed) return run;

  if (!motion.empty()) trace(taken_after(motion, record.snapshots), scene, exact.get(), run);
  const std::vector<Snapshot> own = taken_after(plan.nearest, record.snapshots);
  for (std::size_t i = 0; i < own.size(); ++i) {
    const double time = static_cast<double>(own[i].step) * stepping.time_step;
    const Snapshot at = at_instant(record.snapshots, own[i].step, stepping.time_step, instants[i]);
    run.samples.push_back(measure_sample(c, leaf, own[i], at, c.times[i], time, exact.get(), run));
  }
  stepping.sample_after = plan.own_steps();
  record.snapshots = taken_after(stepping.sample_after, record.snapshots);
  measure_outcomes(scene, spans_of(c, leaf.cells), record, stepping.time_step, exact.get(), run);
  measure_early_contact(c, leaf, record, run);
  measure_bits(c, leaf, scene, stepping, record, run);
  measure_against_fem(c, leaf, scene, stepping, record, run);
  measure_limit(c, leaf, scene, running.cancelled, run);
  std::vector<std::string> declared = c.features;
  if (run.method == "fem") std::erase(declared, "convection");  // its mesh goes with the bar
  run.invalid = why_invalid(c, record.features, declared, run);
  if (run.invalid.empty() && differs_by_run(c)) run.invalid = doubt(exact->residual(instant(c, leaf, c.times.back())));
  return run;
}

namespace {

void refuse_unstable(const Case& c, const Leaf& leaf, const TimeStep& step) {
  if (c.allow_unstable) return;
  constexpr double most = 1e12;
  if (c.plate && !(c.times.back() / step.asked <= most))
    throw InputError(fmt::format("{}: axes.courant: {} needs {:g} steps; allowed: at most {:g} steps", c.path.string(),
                                 leaf.courant, c.times.back() / step.asked, most));
  if (step.asked <= step.limit * (1 + round_off)) return;
  throw InputError(fmt::format(
      "{}: axes.courant: {} for {} with {} cells is a time step of {:.6g}, above the limit {:.6g} (Courant {:.6g}); "
      "allowed are values up to the limit, an [[axes]] of its own for each limit, or [run] allow_unstable = true to "
      "see it blow up",
      c.path.string(), leaf.courant, leaf.method, leaf.cells, step.asked, step.limit, step.limit / step.unit));
}

double duration(const Case& c, const Leaf& leaf) {
  return c.plate ? c.times.back() : instant(with_parameters(c, leaf), leaf, c.times.back());
}

struct Task {
  std::size_t which, slot;  ///< case, and run of it
  Leaf leaf;
  TimeStep step{};
  double work = 0;           ///< about as many updates of unknowns
  std::string refused = {};  ///< why it may not be run
};

}  // namespace

std::vector<reports::Case> run_cases(const std::vector<Case>& cases, const Running& running) {
  std::vector<Task> tasks;
  std::vector<reports::Case> results;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    reports::Case result;
    result.id = c.id;
    result.title = c.title;
    result.why = c.why;
    result.claim = c.claim;
    result.path = c.path.string();
    result.time_unit = c.time_unit;
    result.units = c.units;
    const auto judged = [&](const Leaf& leaf) {
      return std::any_of(c.gates.begin(), c.gates.end(), [&](const GateSpec& g) { return matches(g.where, leaf); });
    };
    for (const Leaf& leaf : leaves(c)) {
      if (running.judged_only && !judged(leaf)) continue;
      tasks.push_back({i, result.runs.size(), leaf});
      result.runs.push_back(describe(c, leaf));
    }
    results.push_back(std::move(result));
  }

  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(running.threads));
  const auto stopped = [&] { return running.cancelled && *running.cancelled; };
  // One by one and in order, so that what comes first is begun first.
  const auto for_each = [&](std::size_t count, auto&& act) {
    std::atomic<std::size_t> next{0};
    tbb::parallel_for(0, running.threads, [&](int) {
      for (std::size_t k = next++; k < count && !stopped(); k = next++) act(k);
    });
  };
  std::vector<std::string> doubts(cases.size());
  for_each(cases.size(), [&](std::size_t i) {
    if (!results[i].runs.empty()) doubts[i] = doubt_exact(cases[i]);
  });
  for_each(tasks.size(), [&](std::size_t t) {
    Task& task = tasks[t];
    const Case& c = cases[task.which];
    try {
      task.step = step_of(c, task.leaf);
      refuse_unstable(c, task.leaf, task.step);
    } catch (const InputError& problem) {
      task.refused = problem.what();
    }
    task.work = results[task.which].runs[task.slot].unknowns * duration(c, task.leaf) / task.step.asked;
  });
  for (const Task& task : tasks)
    if (!task.refused.empty()) throw InputError(task.refused);
  std::stable_sort(tasks.begin(), tasks.end(), [&](const Task& a, const Task& b) {
    return running.cheapest_first ? a.work < b.work : a.work > b.work;
  });

  std::mutex telling;
  std::size_t done = 0;
  // Each run is serial and writes its own slot, so neither the number of threads nor their order can touch a bit.
  for_each(tasks.size(), [&](std::size_t t) {
    const Task& task = tasks[t];
    reports::Run& run = results[task.which].runs[task.slot];
    const auto wanted = [&] {
      const std::lock_guard<std::mutex> lock(telling);
      return !running.wanted || running.wanted(task.which, task.leaf);
    };
    if (!wanted()) {
      run.status = "left out";
    } else {
      try {
        run = run_leaf(cases[task.which], task.leaf, task.step, running);
      } catch (const std::exception& problem) {
        run.status = "error";
        run.message = problem.what();
      }
    }
    if (!doubts[task.which].empty()) run.invalid = doubts[task.which];
    const std::lock_guard<std::mutex> lock(telling);
    if (running.finished && run.status != "left out") running.finished(task.which, run);
    if (running.progress) running.progress(++done, tasks.size());
  });
  return results;
}

}  // namespace diptych::runner
