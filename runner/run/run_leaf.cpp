#include "runner/run/run_leaf.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>

#include "runner/run/built.hpp"
#include "runner/run/measures.hpp"

namespace diptych::runner {
namespace {

/// Compares the run with others of its scene that must be the same to the bit.
template <class S, class M, class R>
void measure_bits(const LeafScene<S, M, R>& it, const Stepping& stepping, const R& record, reports::Run& run) {
  const auto asked = [&](const std::string& quantity) { return asks_for(it.c, it.leaf, quantity); };
  const auto compare = [&](const std::string& quantity, const S& scene, const M& mesh, const Stepping& with,
                           const PowersOfTwo& by, bool mirror) {
    const R second = it.solver.run(scene, mesh, with);
    if (second.outcome == Outcome::cancelled) {
      run.status = "cancelled";  // stopped, not different
    } else {
      run.measures[quantity] = it.differing(record, second, by, mirror);
    }
  };
  if (asked("bits.repeat")) compare("bits.repeat", it.scene, it.mesh, stepping, {}, false);
  if (asked("bits.threads")) {
    constexpr int other_threads = 3;  // which divides no usual number of cells
    Stepping threaded = stepping;
    threaded.threads = stepping.threads == other_threads ? 1 : other_threads;
    compare("bits.threads", it.scene, it.mesh, threaded, {}, false);
  }
  if (asked("bits.mirror")) {
    const auto [scene, mesh] = it.seen_from_behind();
    compare("bits.mirror", scene, mesh, stepping, {}, true);
  }
  if (asked("bits.power-of-two")) {
    Stepping longer = stepping;
    longer.time_step *= powers_of_two.time();
    compare("bits.power-of-two", it.scaled_scene(powers_of_two), it.mesh, longer, powers_of_two, false);
  }
  for (const auto& [quantity, plainer] : it.without_what_does_nothing())
    if (asked(quantity)) compare(quantity, plainer, it.mesh, stepping, {}, false);
}

/// The Courant number, found by bisection, at which the scene stays bounded for the number of steps that a gate asks
/// for.
template <class S, class M, class R>
void measure_limit(const LeafScene<S, M, R>& it, const std::atomic<bool>* cancelled, reports::Run& run) {
  for (const GateSpec& gate : it.c.gates) {
    if (gate.quantity != "critical_courant" || !matches(gate.where, it.leaf)) continue;
    const auto predicted = it.predicted_limit();
    if (!predicted) return;  // nowhere to begin, and a gate on it is INVALID
    const double unit = it.unit_time_step();
    const auto stable = [&](double courant) {
      Stepping trial;
      trial.time_step = courant * unit;
      trial.limit = *predicted * unit;
      trial.books = Books::off;
      trial.gains = 1;  // what is asked is whether it grows without end
      trial.steps = gate.steps;
      trial.cancelled = cancelled;
      return it.solve(trial).outcome == Outcome::completed;
    };
    run.measures["critical_courant"] = bisect_limit(stable, *predicted);
    if (cancelled && *cancelled) run.status = "cancelled";
    run.measures["critical_courant.predicted"] = *predicted;
    return;
  }
}

template <class S, class M, class R>
reports::Run measured(const LeafScene<S, M, R>& it, const TimeStep& step, const Running& running) {
  const Case& c = it.c;
  reports::Run run = describe(c, it.leaf);
  const std::vector<double> instants = it.instants();
  const Plan plan =
      plan_steps(instants, step, what_to_meet(c), it.reads(running.keep_fields), books_of(c, it.leaf, running.books));
  Stepping stepping = plan.stepping;
  stepping.cancelled = running.cancelled;
  stepping.threads = running.threads_a_run;
  run.time_step = stepping.time_step;
  run.time_step_limit = step.limit;
  run.courant = stepping.time_step / step.unit;
  const std::vector<long>& samples = plan.stepping.sample_after;
  const std::vector<long> more = it.more_samples(stepping);
  stepping.sample_after.clear();
  std::set_union(samples.begin(), samples.end(), more.begin(), more.end(), std::back_inserter(stepping.sample_after));
  const auto begin = std::chrono::steady_clock::now();
  R record = it.solve(stepping);
  run.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  take_outcome(record, run);
  const auto mass = it.mass();
  if (mass) measure_ledger(*mass, record.sums, record.ledger, run);
  if (record.outcome != Outcome::completed) return run;

  it.trace(record, more, stepping, run);
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const auto own = std::find_if(record.snapshots.begin(), record.snapshots.end(),
                                  [&](const auto& snapshot) { return snapshot.step == plan.nearest[i]; });
    if (own == record.snapshots.end()) continue;
    const auto at = at_instant(record.snapshots, own->step, stepping.time_step, instants[i]);
    run.samples.push_back(it.sample(*own, at, c.times[i], running.keep_fields, run));
  }
  stepping.sample_after = plan.own_steps();
  std::erase_if(record.snapshots, [&](const auto& snapshot) {
    return !std::binary_search(stepping.sample_after.begin(), stepping.sample_after.end(), snapshot.step);
  });
  it.measure(record, stepping, run);
  if (mass) {
    measure_bits(it, stepping, record, run);
    measure_limit(it, running.cancelled, run);
  }
  std::vector<std::string> declared = it.declared();
  for (const std::string& feature : it.row.shows_not) std::erase(declared, feature);
  if constexpr (requires { it.scene.viscosity; })  // of no coefficients is none, which a sweep may come to
    if (it.scene.viscosity && !it.scene.viscosity->gives_stress()) std::erase(declared, std::string("viscosity"));
  run.invalid = why_invalid(c, record.features, declared, run);
  if (run.invalid.empty()) run.invalid = it.doubt();
  return run;
}

}  // namespace

reports::Run describe(const Case& c, const Leaf& leaf) {
  const Panel& row = panel(leaf.method);
  reports::Run run;
  run.case_id = c.id;
  run.method = leaf.method;
  run.work_unit = row.work;
  run.cells = leaf.cells;
  run.courant_asked = leaf.courant;
  run.particles = particles_label(leaf.particles);
  run.parameters = parameters_label(leaf);
  if (!c.changed.empty()) run.parameters = c.changed + (run.parameters.empty() ? "" : " ") + run.parameters;
  run.status = "cancelled";
  switch (kind_of(c)) {
    case SceneKind::bars: describe_bars(c, leaf, run); break;
    case SceneKind::plate: describe_plate(c, leaf, run); break;
    case SceneKind::diffusion: describe_diffusion(c, leaf, run); break;
  }
  return run;
}

Outlook outlook(const Case& c, const Leaf& leaf) {
  return built(c, leaf, [](const auto& it) {
    return Outlook{{it.asked_time_step(), it.limit(), it.unit_time_step()}, it.instants().back()};
  });
}

double updates_ahead(const Case& whole, const Leaf& leaf) {
  const auto c = case_of(whole, leaf);
  return outlook(*c, leaf).updates(describe(*c, leaf).unknowns);
}

reports::Run run_leaf(const Case& c, const Leaf& leaf, const TimeStep& step, const Running& running) {
  return built(c, leaf, [&](const auto& it) { return measured(it, step, running); });
}

reports::Run run_leaf(const Case& whole, const Leaf& leaf, const Running& running) {
  const auto c = case_of(whole, leaf);
  return built(*c, leaf, [&](const auto& it) {
    return measured(it, {it.asked_time_step(), it.limit(), it.unit_time_step()}, running);
  });
}

}  // namespace diptych::runner
