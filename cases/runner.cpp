#include "cases/runner.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include "analytic/bar_wave.hpp"
#include "analytic/discrete.hpp"
#include "analytic/standing_mode.hpp"
#include "cases/build.hpp"
#include "cases/case_file.hpp"
#include "cases/norms.hpp"
#include "cases/probe.hpp"
#include "fem/bar.hpp"
#include "mpm/bar.hpp"

namespace diptych::cases {
namespace {

using analytic::Quantity;

// A run's number of steps is rounded up, never to nearest: at the limit one step fewer is unstable. The slack lets a
// Courant number that fits the time exactly but for round-off take the steps it asks for.
constexpr double round_off = 1e-12;

constexpr std::array<std::pair<Quantity, const char*>, 3> quantities{
    {{Quantity::stress, "stress"}, {Quantity::velocity, "velocity"}, {Quantity::displacement, "displacement"}}};

const Field& field_of(const Snapshot& s, Quantity q) {
  return q == Quantity::stress ? s.stress : q == Quantity::velocity ? s.velocity : s.displacement;
}

mpm::Scheme scheme_of(const std::string& method) {
  return method == "mpm-usf" ? mpm::Scheme::usf : method == "mpm-usl" ? mpm::Scheme::usl : mpm::Scheme::musl;
}

double critical_time_step(const Scene& scene, const Leaf& leaf) {
  if (leaf.method == "fem") return fem::critical_time_step(scene, leaf.cells);
  return mpm::critical_time_step(scene, leaf.cells, leaf.particles, scheme_of(leaf.method));
}

Record solve(const Scene& scene, const Leaf& leaf, const Stepping& stepping) {
  if (leaf.method == "fem") return fem::run(scene, leaf.cells, stepping);
  return mpm::run(scene, leaf.cells, leaf.particles, scheme_of(leaf.method), stepping);
}

/// Time of one Courant number of one [s].
double cell_time(const Scene& scene, const Leaf& leaf) {
  return scene.length / leaf.cells / material::wave_speed(scene.material);
}

Stepping plan(const Case& c, const Scene& scene, const Leaf& leaf) {
  const double unit = time_unit(c, c.time_unit), end = c.times.back() * unit;
  Stepping stepping;
  stepping.steps =
      std::max(1L, static_cast<long>(std::ceil(end / (leaf.courant * cell_time(scene, leaf)) * (1 - round_off))));
  stepping.time_step = end / static_cast<double>(stepping.steps);
  for (const double time : c.times) {
    stepping.sample_after.push_back(std::max(1L, std::lround(time * unit / stepping.time_step)));
  }
  stepping.books = c.ledger ? Books::sums : Books::off;
  return stepping;
}

bool asks_for(const Case& c, const Leaf& leaf, const std::string& quantity) {
  return std::any_of(c.gates.begin(), c.gates.end(),
                     [&](const GateSpec& gate) { return gate.quantity == quantity && matches(gate.where, leaf); });
}

void measure_ledger(const Case& c, const LedgerSums& sums, reports::Run& run) {
  run.finite = run.finite && sums.finite;
  if (!sums.finite || !(sums.held > 0)) return;  // where nothing moved there is no measure, and a gate on it is INVALID
  const double mass = material::density(c.material) * c.length;
  const auto relative = [](double value, double scale) { return scale > 0 ? value / scale : value; };
  run.measures["energy.drift"] = relative(sums.lost, sums.held);
  run.measures["energy.lost"] = relative(sums.last.lost, sums.held);
  run.measures["momentum.drift"] = relative(sums.momentum, std::sqrt(2 * mass * sums.kinetic));
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
  if (asks_for(c, leaf, "bits.power-of-two")) {
    const PowersOfTwo by;
    Stepping longer = stepping;
    longer.time_step *= by.time();
    compare("bits.power-of-two", scaled(scene, by), leaf, longer, by, false);
  }
  if (asks_for(c, leaf, "bits.mirror")) {
    Leaf behind = leaf;
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

/// Largest Courant number, to one part in a thousand, at which the scene stays bounded for the given number of steps.
/// The bracket opens around the predicted limit until one end is stable and the other is not, and closes without
/// looking at the prediction again. NaN where no such bracket is found.
double bisect_limit(const Scene& scene, const Leaf& leaf, double predicted, long steps,
                    const std::atomic<bool>* cancelled) {
  const auto stable = [&](double courant) {
    Stepping trial;
    trial.time_step = courant * cell_time(scene, leaf);
    trial.steps = steps;
    trial.cancelled = cancelled;
    return solve(scene, leaf, trial).outcome == Outcome::completed;
  };
  double low = predicted / 2, high = predicted * 2;
  for (int wider = 0; wider < 6 && !stable(low); ++wider) low /= 2;
  for (int wider = 0; wider < 6 && stable(high); ++wider) high *= 2;
  if (!stable(low) || stable(high)) return std::nan("");
  while (high - low > 1e-3 * high) {
    const double middle = (low + high) / 2;
    (stable(middle) ? low : high) = middle;
  }
  return (low + high) / 2;
}

void measure_limit(const Case& c, const Leaf& leaf, const Scene& scene, const std::atomic<bool>* cancelled,
                   reports::Run& run) {
  for (const GateSpec& gate : c.gates) {
    if (gate.quantity != "critical_courant" || !matches(gate.where, leaf)) continue;
    const double predicted = analytic::stability_limit(discretisation(c, leaf, leaf.courant));
    run.measures["critical_courant"] = bisect_limit(scene, leaf, predicted, gate.steps, cancelled);
    if (cancelled && *cancelled) run.status = "cancelled";
    run.measures["critical_courant.predicted"] = predicted;
    return;
  }
}

/// As the method knows the field: an element's stress over the element, a particle's at the particle.
reports::Curve polyline(const Field& field, const Leaf& leaf) {
  if (field.edges.empty() || leaf.method != "fem") return {field.x, field.value};
  reports::Curve curve;
  for (std::size_t i = 0; i < field.value.size(); ++i) {
    curve.x.insert(curve.x.end(), {field.edges[i], field.edges[i + 1]});
    curve.y.insert(curve.y.end(), {field.value[i], field.value[i]});
  }
  return curve;
}

/// The exact field on a line fine enough to draw, broken at its fronts. On a front nothing is read: two that pass each
/// other just now would draw a spike of no width.
reports::Curve exact_line(const analytic::ExactSolution& exact, Quantity q, double length, double time) {
  const double side = 1e-6 * length;
  const auto fronts = exact.fronts(time);
  std::vector<double> xs;
  for (int i = 0; i <= 400; ++i) xs.push_back(length * i / 400);
  for (const analytic::Front& front : fronts) {
    for (const double x : {front.position - side, front.position + side}) {
      if (x >= 0 && x <= length) xs.push_back(x);
    }
  }
  std::erase_if(xs, [&](double x) {
    return std::any_of(fronts.begin(), fronts.end(),
                       [&](const analytic::Front& front) { return std::abs(x - front.position) < 0.9 * side; });
  });
  std::sort(xs.begin(), xs.end());
  reports::Curve curve;
  for (const double x : xs) {
    curve.x.push_back(x);
    curve.y.push_back(exact.at(q, x, time));
  }
  return curve;
}

bool drawn(const Case& c, const Leaf& leaf) {
  return std::any_of(c.figures.begin(), c.figures.end(), [&](const FigureSpec& f) {
    const bool method = std::find(f.methods.begin(), f.methods.end(), leaf.method) != f.methods.end();
    return method && f.cells == leaf.cells && f.courant == leaf.courant &&
           (leaf.method == "fem" || f.particles == leaf.particles);
  });
}

reports::Sample measure_sample(const Case& c, const Leaf& leaf, const Snapshot& snapshot, double asked, double time,
                               const analytic::ExactSolution* exact, const reports::Run& run) {
  const double unit = time_unit(c, c.time_unit);
  reports::Sample sample;
  sample.asked = asked;
  sample.time = time / unit;
  const auto theory = discretisation(c, leaf, run.courant);
  for (const auto& [q, name] : quantities) {
    const Field& field = field_of(snapshot, q);
    if (drawn(c, leaf)) {
      sample.curves[name] = polyline(field, leaf);
      if (exact && exact->gives(q)) sample.exact_curves[name] = exact_line(*exact, q, c.length, field.time);
    }
    if (!exact || !exact->gives(q)) continue;
    const double scale = exact->scale(q);
    const Norms norms = error_norms(field, *exact, q, c.length);
    reports::FieldError error{name, field.time / unit, scale, norms.l1, norms.l2, norms.linf, {}, {}, {}};
    const auto predicted = [&](analytic::Norm norm) {
      auto value = analytic::predicted_error(*exact, theory, q, norm, field.time);
      if (value) *value /= scale;
      return value;
    };
    error.predicted_l1 = predicted(analytic::Norm::l1);
    error.predicted_l2 = predicted(analytic::Norm::l2);
    error.predicted_linf = predicted(analytic::Norm::linf);
    sample.errors.push_back(error);
  }
  for (const Probe& probe : c.probes) sample.probes.push_back(read_probe(c, leaf, probe, snapshot));
  return sample;
}

std::string status_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::completed: return "completed";
    case Outcome::unstable: return "unstable";
    case Outcome::left_grid: return "left-grid";
    case Outcome::cancelled: return "cancelled";
  }
  return "error";
}

/// Why a completed run cannot be judged, or nothing.
std::string why_invalid(const Case& c, const Record& record, const reports::Run& run) {
  if (record.outcome != Outcome::completed) return {};
  if (!run.finite) return "a number is not finite";
  if (record.features != c.features) {
    return fmt::format("active features [{}] are not the declared [{}]", fmt::join(record.features, ", "),
                       fmt::join(c.features, ", "));
  }
  if (run.samples.size() != c.times.size()) {
    return fmt::format("{} of {} sample times were reached", run.samples.size(), c.times.size());
  }
  for (const auto& sample : run.samples) {
    for (const auto& e : sample.errors) {
      if (!(std::isfinite(e.l1) && std::isfinite(e.l2) && std::isfinite(e.linf))) return "an error norm is not finite";
      const double slack = 1 + 1e-9;
      if (e.l1 > e.l2 * slack || e.l2 > e.linf * slack) {
        return fmt::format("L1 ≤ L2 ≤ L∞ is violated: {} {} {}", e.l1, e.l2, e.linf);
      }
    }
  }
  return {};
}

/// Why the exact solution is not to be trusted, or nothing. One's own expressions are taken at their word.
std::string doubt_exact(const Case& c) {
  constexpr double allowed = 1e-4;  // room for the round-off of steep ramps; a wrong solution stands at 1
  const auto exact = make_exact(c);
  // Long enough to see every front and its reflections, however short the runs are.
  double end = c.times.back() * time_unit(c, c.time_unit);
  for (const LoadSpec& load : c.loads) {
    double settled = 5 * time_unit(c, "L/c");
    for (const Measured& part : {load.start, load.rise, load.duration}) settled += part.value * time_unit(c, part.unit);
    end = std::max(end, settled);
  }
  double worst = 0;
  if (const auto* bar = dynamic_cast<const analytic::BarWave*>(exact.get()))
    worst = analytic::self_test(*bar, end).worst();
  if (const auto* mode = dynamic_cast<const analytic::StandingMode*>(exact.get())) {
    worst = analytic::self_test(*mode, end).worst();
  }
  if (worst <= allowed) return {};
  return fmt::format("the exact solution fails its own test: residual {:.3g}, allowed {:g}", worst, allowed);
}

reports::Run describe(const Case& c, const Leaf& leaf) {
  reports::Run run;
  run.case_id = c.id;
  run.method = leaf.method;
  run.cells = leaf.cells;
  run.courant_asked = leaf.courant;
  run.particles = particles_label(leaf.particles);
  run.cell_size = c.length / leaf.cells;
  run.unknowns = leaf.method == "fem" ? leaf.cells + 1 - (c.left == Support::fixed) - (c.right == Support::fixed)
                                      : leaf.cells * static_cast<int>(leaf.particles.size());
  run.status = "cancelled";
  return run;
}

}  // namespace

reports::Run run_leaf(const Case& c, const Leaf& leaf, const Running& running) {
  reports::Run run = describe(c, leaf);
  const Scene scene = make_scene(c, leaf.cells);
  const auto exact = make_exact(c);
  Stepping stepping = plan(c, scene, leaf);
  stepping.cancelled = running.cancelled;
  if (running.keep_ledger && c.ledger) stepping.books = Books::lines;
  run.time_step = stepping.time_step;
  run.time_step_limit = critical_time_step(scene, leaf);
  run.courant = stepping.time_step / cell_time(scene, leaf);
  if (std::adjacent_find(stepping.sample_after.begin(), stepping.sample_after.end()) != stepping.sample_after.end()) {
    run.invalid = "two sample times fall on one step";
    run.status = "completed";
    return run;
  }

  const auto begin = std::chrono::steady_clock::now();
  const Record record = solve(scene, leaf, stepping);
  run.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  run.status = status_of(record.outcome);
  run.message = record.message;
  run.steps = record.steps;
  run.element_steps = record.work.element_steps;
  run.particle_steps = record.work.particle_steps;
  run.node_steps = record.work.node_steps;
  run.bytes = record.work.bytes;
  run.features = record.features;
  if (record.outcome != Outcome::completed) return run;

  for (std::size_t i = 0; i < record.snapshots.size(); ++i) {
    const double time = static_cast<double>(record.snapshots[i].step) * stepping.time_step;
    run.samples.push_back(measure_sample(c, leaf, record.snapshots[i], c.times[i], time, exact.get(), run));
  }
  measure_ledger(c, record.sums, run);
  for (const LedgerLine& line : record.ledger) {
    run.ledger.push_back(
        {line.time, line.kinetic, line.strain, line.dissipated, line.work, line.lost, line.momentum, line.impulse});
  }
  measure_bits(c, leaf, scene, stepping, record, run);
  measure_against_fem(c, leaf, scene, stepping, record, run);
  measure_limit(c, leaf, scene, running.cancelled, run);
  run.invalid = why_invalid(c, record, run);
  return run;
}

void refuse_unstable(const Case& c) {
  if (c.allow_unstable) return;
  for (const Leaf& leaf : leaves(c)) {
    const Scene scene = make_scene(c, leaf.cells);
    const double asked = leaf.courant * cell_time(scene, leaf), limit = critical_time_step(scene, leaf);
    if (asked <= limit * (1 + round_off)) continue;
    throw InputError(fmt::format(
        "{}: axes.courant: {} for {} with {} cells is a time step of {:.6g}, above the limit {:.6g} (Courant {:.6g}); "
        "allowed are values up to the limit, an [[axes]] of its own for each limit, or [run] allow_unstable = true to "
        "see it blow up",
        c.path.string(), leaf.courant, leaf.method, leaf.cells, asked, limit, limit / cell_time(scene, leaf)));
  }
}

std::vector<reports::Case> run_cases(const std::vector<Case>& cases, const Running& running) {
  struct Task {
    std::size_t which;
    std::size_t slot;
    Leaf leaf;
  };
  std::vector<Task> tasks;
  std::vector<reports::Case> results;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    refuse_unstable(c);
    reports::Case result;
    result.id = c.id;
    result.title = c.title;
    result.why = c.why;
    result.claim = c.claim;
    result.path = c.path.string();
    result.time_unit = c.time_unit;
    result.units = c.units;
    for (const Leaf& leaf : leaves(c)) {
      tasks.push_back({i, result.runs.size(), leaf});
      result.runs.push_back(describe(c, leaf));
    }
    results.push_back(std::move(result));
  }

  std::mutex telling;
  std::size_t done = 0;
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(running.threads));
  // Each run is serial and writes its own slot, so neither the number of threads nor their order can touch a bit.
  tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t t) {
    if (running.cancelled && *running.cancelled) return;
    const Task& task = tasks[t];
    reports::Run& run = results[task.which].runs[task.slot];
    try {
      run = run_leaf(cases[task.which], task.leaf, running);
    } catch (const std::exception& problem) {
      run.status = "error";
      run.message = problem.what();
    }
    const std::lock_guard<std::mutex> lock(telling);
    if (running.progress) running.progress(++done, tasks.size());
  });
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::string doubt = doubt_exact(cases[i]);
    if (doubt.empty()) continue;
    for (reports::Run& run : results[i].runs) run.invalid = doubt;
  }
  return results;
}

}  // namespace diptych::cases
