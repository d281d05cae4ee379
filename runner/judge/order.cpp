// Gates of kind "order": how an error falls from mesh to mesh, or from time step to time step.
#include "runner/judge/order.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "analytic/discrete.hpp"
#include "reports/tables.hpp"
#include "runner/compare/quantities.hpp"
#include "runner/input/build.hpp"
#include "runner/input/case_checks.hpp"
#include "runner/input/toml_table.hpp"
#include "runner/judge/judging.hpp"
#include "runner/judge/readings.hpp"

namespace diptych::runner {
namespace {

using Sort = Quantity::Sort;

// An error above this part of the field's scale has not begun to converge.
constexpr double saturated = 0.5;

Names quantities_of_order(const Case& c) { return quantity_names(c, {Sort::error_norm, Sort::outcome_error}); }

void check_order(Table& t, const OrderCriterion& slope, const GateSpec& gate, const Case& c) {
  const char* varies = slope.over_time_step ? "courant" : "cells";
  std::map<std::string, int> meshes;  // of each series that differs in nothing else
  for (const Leaf& run : runs_of(gate, c))
    ++meshes[run.method +
             (slope.over_time_step ? ", cells = " + words(run.cells) : ", courant = " + words(run.courant)) +
             (run.particles.empty() ? "" : ", particles = " + words(run.particles)) +
             (parameters_label(run).empty() ? "" : ", " + parameters_label(run))];
  for (const auto& [series, count] : meshes) {
    if (count >= slope.levels_min) continue;
    t.place("levels_min")
        .refuse(fmt::format("{} values of {} for {}", count, varies, series),
                fmt::format("at least levels_min = {}", slope.levels_min));
    return;  // the other series differ in the same way
  }
}

void read_order(Table& t, const Case& c, GateSpec& gate) {
  OrderCriterion slope;
  const auto expect = t.must("expect", any_number());
  const auto band = t.must("band", interval());
  constexpr double widest = 1;  // orders differ by a half or by one
  if (band && (*band)[1] - (*band)[0] > widest)
    t.place("band").refuse(words(std::vector{(*band)[0], (*band)[1]}), "a band at most " + words(widest) + " wide");
  slope.over_time_step = t.get("over", one_of({"cells", "courant"})) == "courant";
  slope.levels_min = t.get("levels_min", whole(3, 100), slope.levels_min);
  slope.expect = expect.value_or(0);
  slope.band = band.value_or(slope.band);
  if (band && expect && (*expect < (*band)[0] || *expect > (*band)[1]))
    t.place("expect").refuse(words(*expect),
                             "an order within the band, " + words((*band)[0]) + " to " + words((*band)[1]));
  check_order(t, slope, gate, c);
  gate.keeps_time_steps = true;
  gate.criterion = std::make_shared<OrderCriterion>(slope);
}

/// Bands of slopes alone do not tell a right discontinuous solution from a wrong one.
void check_orders(const Place& place, const Case& c) {
  const bool seen = std::any_of(c.gates.begin(), c.gates.end(), [](const GateSpec& gate) {
    return !gate.criterion || gate.criterion->sees_wrong_solutions();
  });
  if (!seen)
    place.say(
        "found order gates alone, which a wrong solution can pass; allowed: with a gate of kind exact, constant "
        "or invariant beside them");
}

/// The order written in the case file must be the one that theory gives, where theory has one.
void check_expectation(const Case& c, const GateSpec& gate, double expect, const JudgedRun& judged) {
  const Quantity* quantity = find_quantity(gate.quantity, c);
  if (!quantity || quantity->sort != Sort::error_norm || c.plate) return;
  const ErrorNorm norm(gate.quantity);
  const auto exact = make_exact(with_parameters(c, judged.leaf), judged.leaf);
  if (!exact) return;
  const auto scheme = discretisation(c, judged.leaf, judged.run->courant);
  if (!scheme) return;
  const auto theory = analytic::expected_order(*exact, scheme->scheme, norm.of(), norm.as());
  if (theory && std::abs(*theory - expect) > 0.005)
    not_judged(fmt::format("expect = {:g}, but theory gives {} of {} the order {:.4g}", expect, gate.quantity,
                           judged.run->method, *theory));
}

}  // namespace

void OrderCriterion::judge(const Case& c, const GateSpec& gate, const std::vector<JudgedRun>& runs,
                           reports::Gate& result) const {
  const auto readings = read(c, gate, runs);
  const auto [low, high] = band;
  const bool over_time = over_time_step;
  result.formula = fmt::format("slope of log {} over log {}, expected {:.4g}, within [{:g}, {:g}]", gate.quantity,
                               over_time ? "Δt" : "h", expect, low, high);
  std::map<std::string, std::vector<Reading>> groups;  // all but the mesh held fast
  for (const Reading& r : readings) {
    groups[fmt::format("{} {}{}{}{}", r.run().method,
                       over_time ? fmt::format("N={}", r.run().cells) : fmt::format("C={:g}", r.run().courant_asked),
                       r.run().particles.empty() ? "" : " particles " + r.run().particles,
                       r.run().parameters.empty() ? "" : " " + r.run().parameters,
                       std::isnan(r.time) ? "" : fmt::format(", t = {:g} {}", r.time, c.time_unit))]
        .push_back(r);
  }
  for (auto& [name, group] : groups) {
    const auto size = [&](const Reading& r) { return over_time ? r.run().time_step : r.run().cell_size; };
    std::sort(group.begin(), group.end(), [&](const Reading& a, const Reading& b) { return size(a) > size(b); });
    check_expectation(c, gate, expect, *group.front().of);
    if (static_cast<int>(group.size()) < levels_min) {
      not_judged(fmt::format("{}: {} {}, at least {} are needed", name, group.size(),
                             over_time ? "time steps" : "meshes", levels_min));
    }
    std::vector<double> sizes, errors;
    for (const Reading& r : group) {
      if (!sizes.empty() && !(size(r) < sizes.back()))
        not_judged(name + (over_time ? ": two time steps are the same" : ": two meshes are the same"));
      sizes.push_back(size(r));
      errors.push_back(r.value);
    }
    if (!(errors.back() > floor_of_noise)) {
      not_judged(fmt::format("{}: the finest error {:g} is at the floor of round-off", name, errors.back()));
    }
    if (!(errors.front() < saturated)) {
      not_judged(fmt::format("{}: the coarsest error {:g} has not begun to converge", name, errors.front()));
    }
    const reports::Fit fit = reports::fit_order(sizes, errors);
    const bool inside = fit.order >= low && fit.order <= high;
    if (inside && !(fit.standard_error <= (high - low) / 2)) {  // in the band by luck
      not_judged(
          fmt::format("{}: the errors lie on no line: slope {:.3f} ± {:.3f}", name, fit.order, fit.standard_error));
    }
    hold(result,
         {fmt::format("{} ({} {}, ± {:.3f})", name, fit.levels, over_time ? "steps" : "meshes", fit.standard_error),
          fit.order, expect, low, high, fit.order, false});
  }
}

GateKind order_gate() {
  return {.id = "order",
          .says = "how an error falls with the size of cells, or of time steps, lies in a band",
          .keys = {{"times"}, {"expect"}, {"band"}, {"over"}, {"levels_min"}},
          .quantities = quantities_of_order,
          .read = read_order,
          .check_all = check_orders};
}

}  // namespace diptych::runner
