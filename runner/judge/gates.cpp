#include "runner/judge/gates.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "analytic/discrete.hpp"
#include "reports/tables.hpp"
#include "runner/input/build.hpp"
#include "runner/input/leaf.hpp"
#include "runner/judge/agreement.hpp"
#include "runner/judge/judging.hpp"

namespace diptych::runner {
namespace {

using reports::Check;
using reports::Gate;
using reports::Run;
using reports::Verdict;

// Below this many round-offs an error is noise and has neither an order nor a constant.
constexpr double floor_of_noise = 100 * 2.3e-16;
// An error above this part of the field's scale has not begun to converge.
constexpr double saturated = 0.5;

struct Reading {
  const Run* run;
  double time;  ///< asked, or NaN for quantities of the whole run
  double value;
  std::optional<double> predicted;
  std::string what;
};

std::pair<std::string, std::string> split(const std::string& quantity) {
  const auto dot = quantity.find('.');
  return {quantity.substr(0, dot), dot == std::string::npos ? "" : quantity.substr(dot + 1)};
}

/// "stress.L2" and the like, as against quantities of the whole run.
bool is_field(const std::string& name, const std::string& norm) {
  return (name == "stress" || name == "velocity" || name == "displacement" || name == "concentration") &&
         (norm == "L1" || norm == "L2" || norm == "Linf");
}

analytic::Norm norm_of(const std::string& name) {
  return name == "L1" ? analytic::Norm::l1 : name == "L2" ? analytic::Norm::l2 : analytic::Norm::linf;
}

analytic::Quantity quantity_of(const std::string& field) {
  return field == "stress"     ? analytic::Quantity::stress
         : field == "velocity" ? analytic::Quantity::velocity
                               : analytic::Quantity::displacement;
}

Leaf leaf_of(const Case& c, const Run& run) {
  for (const Leaf& leaf : leaves(c)) {
    if (leaf.method == run.method && leaf.cells == run.cells && leaf.courant == run.courant_asked &&
        particles_label(leaf.particles) == run.particles && parameters_label(leaf) == run.parameters) {
      return leaf;
    }
  }
  throw std::logic_error("run " + run.label() + " is not one of case " + c.id);
}

bool wanted(const GateSpec& gate, double time) {
  return gate.times.empty() || std::find(gate.times.begin(), gate.times.end(), time) != gate.times.end();
}

/// Leading-order theory of a step: asked for by name, beside the run's own prediction.
std::optional<double> airy(const Case& c, const Run& run, const reports::FieldError& error, analytic::Quantity q,
                           analytic::Norm norm) {
  const Leaf leaf = leaf_of(c, run);
  const auto exact = make_exact(with_parameters(c, leaf), leaf);
  const double time = error.time * time_unit(c, c.time_unit);
  const auto scheme = discretisation(c, leaf, run.courant);
  if (!scheme) return {};
  auto predicted = analytic::airy_step_error(*exact, *scheme, q, norm, time);
  if (predicted) *predicted /= error.scale;
  return predicted;
}

void read_field(const Case& c, const GateSpec& gate, const Run& run, std::vector<Reading>& readings) {
  const auto [field, norm] = split(gate.quantity);
  for (const auto& sample : run.samples) {
    if (!wanted(gate, sample.asked)) continue;
    const std::string what = fmt::format("{}, t = {:g} {}", run.label(), sample.asked, c.time_unit);
    if (field == "probe") {
      for (const auto& probe : sample.probes) {
        if (probe.id == norm) readings.push_back({&run, sample.asked, probe.value, probe.predicted, what});
      }
      continue;
    }
    for (const auto& error : sample.errors) {
      if (error.field != field) continue;
      const bool l1 = norm == "L1", l2 = norm == "L2";
      auto predicted = l1 ? error.predicted_l1 : l2 ? error.predicted_l2 : error.predicted_linf;
      if (gate.predict == "airy-step") predicted = airy(c, run, error, quantity_of(field), norm_of(norm));
      readings.push_back({&run, sample.asked, l1 ? error.l1 : l2 ? error.l2 : error.linf, predicted, what});
    }
  }
}

/// Every number the gate speaks of; each must be there and finite.
std::vector<Reading> read(const Case& c, const GateSpec& gate, const std::vector<Run>& runs) {
  std::vector<Reading> readings;
  const auto [head, tail] = split(gate.quantity);
  for (const Run& run : runs) {
    if (!matches(gate.where, leaf_of(c, run))) continue;
    check_judgeable(run);
    const std::size_t before = readings.size();
    if (is_field(head, tail) || head == "probe") {
      read_field(c, gate, run, readings);
    } else if (run.measures.count(gate.quantity)) {
      const bool of_solid = gate.predict == "plate-impact" || gate.predict == "diffusion-front";
      const auto predicted = run.measures.find(gate.quantity + (of_solid ? ".exact" : ".predicted"));
      readings.push_back({&run, std::nan(""), run.measures.at(gate.quantity),
                          predicted == run.measures.end() ? std::nullopt : std::optional(predicted->second),
                          run.label()});
    }
    const std::size_t planned =
        is_field(head, tail) || head == "probe" ? (gate.times.empty() ? c.times.size() : gate.times.size()) : 1;
    if (readings.size() - before != planned) {
      throw Stop{Verdict::invalid, fmt::format("{} gave {} of {} values of {}", run.label(), readings.size() - before,
                                               planned, gate.quantity)};
    }
  }
  if (readings.empty()) throw Stop{Verdict::invalid, "no run matches where"};
  for (const Reading& r : readings) {
    if (!std::isfinite(r.value))
      throw Stop{Verdict::invalid, fmt::format("{}: {} is {}", r.what, gate.quantity, r.value)};
  }
  return readings;
}

void judge_maximum(const GateSpec& gate, const std::vector<Reading>& readings, Gate& result) {
  if (gate.expect) {
    result.formula = fmt::format("|{} − {:g}| ≤ {:g}", gate.quantity, *gate.expect, *gate.max);
    for (const Reading& r : readings) {
      hold(result, {r.what, r.value, *gate.expect, -*gate.max, *gate.max, r.value - *gate.expect, false});
    }
    return;
  }
  result.formula = fmt::format("|{}| ≤ {:g}", gate.quantity, *gate.max);
  for (const Reading& r : readings) hold(result, {r.what, r.value, 0.0, -*gate.max, *gate.max, r.value, false});
}

void judge_ratio(const GateSpec& gate, const std::vector<Reading>& readings, Gate& result) {
  result.formula = fmt::format("{} / predicted by {} within [{}, {}]", gate.quantity, gate.predict, (*gate.ratio)[0],
                               (*gate.ratio)[1]);
  for (const Reading& r : readings) {
    if (!r.predicted)
      throw Stop{Verdict::invalid, fmt::format("{}: {} has no prediction for {}", r.what, gate.predict, gate.quantity)};
    // A right prediction of round-off says nothing, and an error of exactly nothing is a comparison with oneself.
    if (r.value == 0 || !(std::abs(*r.predicted) > floor_of_noise)) {
      throw Stop{Verdict::invalid, fmt::format("{}: {} = {:g} against {:g} is at the floor of round-off", r.what,
                                               gate.quantity, r.value, *r.predicted)};
    }
    hold(result, {r.what, r.value, r.predicted, (*gate.ratio)[0], (*gate.ratio)[1], r.value / *r.predicted, false});
  }
}

/// The order written in the case file must be the one that theory gives, where theory has one.
void check_expectation(const Case& c, const GateSpec& gate, const Run& run) {
  const auto [field, norm] = split(gate.quantity);
  if (!is_field(field, norm) || c.plate) return;
  const Leaf leaf = leaf_of(c, run);
  const auto exact = make_exact(with_parameters(c, leaf), leaf);
  if (!exact) return;
  const auto scheme = discretisation(c, leaf, run.courant);
  if (!scheme) return;
  const auto theory = analytic::expected_order(*exact, scheme->scheme, quantity_of(field), norm_of(norm));
  if (theory && std::abs(*theory - *gate.expect) > 0.005) {
    throw Stop{Verdict::invalid, fmt::format("expect = {:g}, but theory gives {} of {} the order {:.4g}", *gate.expect,
                                             gate.quantity, run.method, *theory)};
  }
}

void judge_order(const Case& c, const GateSpec& gate, const std::vector<Reading>& readings, Gate& result) {
  const auto [low, high] = *gate.band;
  const bool over_time = gate.over_time_step;
  result.formula = fmt::format("slope of log {} over log {}, expected {:.4g}, within [{:g}, {:g}]", gate.quantity,
                               over_time ? "Δt" : "h", *gate.expect, low, high);
  std::map<std::string, std::vector<Reading>> groups;  // all but the mesh held fast
  for (const Reading& r : readings) {
    groups[fmt::format("{} {}{}{}{}", r.run->method,
                       over_time ? fmt::format("N={}", r.run->cells) : fmt::format("C={:g}", r.run->courant_asked),
                       r.run->particles.empty() ? "" : " particles " + r.run->particles,
                       r.run->parameters.empty() ? "" : " " + r.run->parameters,
                       std::isnan(r.time) ? "" : fmt::format(", t = {:g} {}", r.time, c.time_unit))]
        .push_back(r);
  }
  for (auto& [name, group] : groups) {
    const auto size = [&](const Reading& r) { return over_time ? r.run->time_step : r.run->cell_size; };
    std::sort(group.begin(), group.end(), [&](const Reading& a, const Reading& b) { return size(a) > size(b); });
    check_expectation(c, gate, *group.front().run);
    if (static_cast<int>(group.size()) < gate.levels_min) {
      throw Stop{Verdict::invalid, fmt::format("{}: {} {}, at least {} are needed", name, group.size(),
                                               over_time ? "time steps" : "meshes", gate.levels_min)};
    }
    std::vector<double> sizes, errors;
    for (const Reading& r : group) {
      if (!sizes.empty() && !(size(r) < sizes.back()))
        throw Stop{Verdict::invalid,
                   name + (over_time ? ": two time steps are the same" : ": two meshes are the same")};
      sizes.push_back(size(r));
      errors.push_back(r.value);
    }
    if (!(errors.back() > floor_of_noise)) {
      throw Stop{Verdict::invalid,
                 fmt::format("{}: the finest error {:g} is at the floor of round-off", name, errors.back())};
    }
    if (!(errors.front() < saturated)) {
      throw Stop{Verdict::invalid,
                 fmt::format("{}: the coarsest error {:g} has not begun to converge", name, errors.front())};
    }
    const reports::Fit fit = reports::fit_order(sizes, errors);
    const bool inside = fit.order >= low && fit.order <= high;
    if (inside && !(fit.standard_error <= (high - low) / 2)) {  // in the band by luck
      throw Stop{Verdict::invalid, fmt::format("{}: the errors lie on no line: slope {:.3f} ± {:.3f}", name, fit.order,
                                               fit.standard_error)};
    }
    hold(result,
         {fmt::format("{} ({} {}, ± {:.3f})", name, fit.levels, over_time ? "steps" : "meshes", fit.standard_error),
          fit.order, *gate.expect, low, high, fit.order, false});
  }
}

/// Runs above the limit must be seen to blow up.
void judge_blow_up(const Case& c, const GateSpec& gate, const std::vector<Run>& runs, Gate& result) {
  result.formula = "the run is detected as unstable";
  for (const Run& run : runs) {
    if (!matches(gate.where, leaf_of(c, run))) continue;
    if (run.status != "unstable" && run.status != "completed") {
      throw Stop{Verdict::error, run.label() + ": " + run.status + ": " + run.message};
    }
    const double seen = run.status == "unstable" ? 1 : 0;
    hold(result,
         {fmt::format("{}: {} after {} steps", run.label(), run.status, run.steps), seen, 1.0, 1, 1, seen, false});
  }
}

Verdict worst(Verdict a, Verdict b) { return std::max(a, b); }

}  // namespace

Gate judge(const Case& c, const GateSpec& gate, const std::vector<Run>& runs) {
  Gate result;
  result.case_id = c.id;
  result.id = gate.id;
  result.kind = gate.kind;
  result.quantity = gate.quantity;
  result.reason = gate.reason;
  result.line = gate.line;
  try {
    if (!gate.outcome.empty()) {
      judge_blow_up(c, gate, runs, result);
    } else if (gate.kind == "agreement" || gate.kind == "settling") {
      std::vector<const Run*> spoken_of;
      for (const Run& run : runs)
        if (matches(gate.where, leaf_of(c, run))) spoken_of.push_back(&run);
      if (gate.kind == "agreement")
        judge_agreement(c, gate, spoken_of, result);
      else
        judge_settling(c, gate, spoken_of, result);
    } else {
      const auto readings = read(c, gate, runs);
      if (gate.max) judge_maximum(gate, readings, result);
      if (gate.ratio) judge_ratio(gate, readings, result);
      if (gate.band) judge_order(c, gate, readings, result);
    }
  } catch (const Stop& stop) {
    result.verdict = stop.verdict;
    result.message = stop.message;
    return result;
  }
  if (result.checks.empty()) {
    result.message = "nothing was judged";
    return result;  // INVALID
  }
  result.verdict = Verdict::pass;
  for (const Check& check : result.checks) {
    if (check.passed) continue;
    if (result.verdict == Verdict::pass) {
      result.message = fmt::format("{}: {:.6g} is outside [{}, {}]", check.what, check.judged, check.low, check.high);
    }
    result.verdict = Verdict::fail;
  }
  return result;
}

bool of_single_numbers(const GateSpec& gate) {
  return gate.outcome.empty() && gate.kind != "agreement" && gate.kind != "settling" && (gate.max || gate.ratio);
}

bool all_made(const Case& c, const GateSpec& gate, const std::vector<Run>& runs) {
  return std::none_of(runs.begin(), runs.end(), [&](const Run& run) {
    return run.status == "cancelled" && matches(gate.where, leaf_of(c, run));
  });
}

Outcome sum_up(const std::vector<reports::Case>& cases, int declared, int left_out) {
  Outcome outcome;
  outcome.declared = declared;
  outcome.left_out = left_out;
  Verdict verdict = Verdict::pass;
  for (const auto& c : cases) {
    for (const Gate& gate : c.gates) {
      ++outcome.judged;
      if (gate.verdict == Verdict::pass) ++outcome.passed;
      verdict = worst(verdict, gate.verdict);
    }
  }
  if (outcome.judged == 0 || outcome.judged != declared) verdict = Verdict::invalid;
  outcome.verdict = reports::to_string(verdict);
  switch (verdict) {
    case Verdict::pass: outcome.exit_code = all_passed; break;
    case Verdict::fail: outcome.exit_code = some_failed; break;
    case Verdict::unstable:
    case Verdict::error: outcome.exit_code = unstable_or_error; break;
    case Verdict::invalid: outcome.exit_code = invalid; break;
  }
  return outcome;
}

}  // namespace diptych::runner
