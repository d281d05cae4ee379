#include "runner/trade/trade.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "reports/field_norms.hpp"
#include "runner/compare/uncertainty.hpp"
#include "runner/input/leaf.hpp"
#include "runner/run/runner.hpp"
#include "runner/trade/timing.hpp"

namespace diptych::runner {
namespace {

/// The label without " N=200".
std::string setting_of(const reports::Run& run) {
  std::string label = run.label();
  const std::string cells = fmt::format(" N={}", run.cells);
  const std::size_t at = label.find(cells);
  return at == std::string::npos ? label : label.erase(at, cells.size());
}

std::vector<reports::TradeError> field_errors(const reports::Run& run) {
  std::vector<reports::TradeError> errors;
  for (const reports::Sample& sample : run.samples)
    for (const reports::FieldError& field : sample.errors)
      for (const reports::Norm& norm : reports::norms)
        errors.push_back({field.field + "." + norm.name, sample.asked, field.*norm.measured, 0, field.*norm.predicted});
  return errors;
}

/// What the meshes of one family say of a probe at a time.
struct Family {
  std::vector<std::size_t> points;
  std::vector<double> size, value;
};

/// Errors of probes against what the family with the least uncertainty extrapolates to. Nothing where no family has
/// meshes enough, or none whose uncertainty is less than a quarter of the value.
void add_probe_errors(const std::vector<reports::Run>& runs, reports::Trade& trade) {
  std::map<std::tuple<std::string, std::string, double>, std::map<std::string, Family>> probes;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!trade.points[i].completed()) continue;
    for (const reports::Sample& sample : runs[i].samples)
      for (const reports::ProbeValue& probe : sample.probes) {
        Family& family = probes[{runs[i].parameters, probe.id, sample.asked}][trade.points[i].setting];
        family.points.push_back(i);
        family.size.push_back(runs[i].cell_size);
        family.value.push_back(probe.value);
      }
  }
  for (const auto& [what, families] : probes) {
    double reference = 0, band = std::numeric_limits<double>::infinity();
    for (const auto& [setting, family] : families) {
      if (family.size.size() < levels_for_uncertainty) continue;
      const Uncertainty u = discretisation_uncertainty(family.size, family.value);
      const auto finest =
          static_cast<std::size_t>(std::min_element(family.size.begin(), family.size.end()) - family.size.begin());
      if (u.of(finest) > 0 && u.of(finest) < band) {
        band = u.of(finest);
        reference = u.extrapolated;
      }
    }
    const double size = std::abs(reference);
    if (!(band < size / 4)) continue;
    for (const auto& [setting, family] : families)
      for (std::size_t k = 0; k < family.points.size(); ++k)
        trade.points[family.points[k]].errors.push_back({"probe." + std::get<1>(what),
                                                         std::get<2>(what),
                                                         std::abs(family.value[k] - reference) / size,
                                                         band / size,
                                                         {}});
  }
}

}  // namespace

reports::TradePoint point_of(const reports::Run& run) {
  reports::TradePoint point;
  point.label = run.label();
  point.setting = setting_of(run);
  point.method = run.method;
  point.scene = run.parameters;
  point.cells = run.cells;
  point.cell_size = run.cell_size;
  point.status = run.status;
  point.message = run.message;
  if (run.status == "completed" && !run.invalid.empty()) {
    point.status = "invalid";
    point.message = run.invalid;
  } else if (run.status == "completed" && run.time_step > run.time_step_limit * (1 + round_off)) {
    // That it has not blown up yet does not make it stable.
    point.status = "above limit";
    point.message =
        fmt::format("completed at {:.4g} times its limit of the time step", run.time_step / run.time_step_limit);
  }
  point.unknowns = run.unknowns;
  point.steps = run.steps;
  point.element_steps = run.element_steps;
  point.particle_steps = run.particle_steps;
  point.node_steps = run.node_steps;
  point.bytes = run.bytes;
  if (point.completed()) point.errors = field_errors(run);
  return point;
}

Case bare(Case c) {
  c.gates.clear();
  c.figures.clear();
  c.ledger = false;
  c.allow_unstable = true;
  return c;
}

reports::Trade trade_of(const Case& c, const std::vector<reports::Run>& runs) {
  reports::Trade trade;
  trade.case_id = c.id;
  trade.title = c.title;
  trade.time_unit = c.time_unit;
  for (const reports::Run& run : runs) {
    trade.points.push_back(point_of(run));
    trade.points.back().leaf = trade.points.size() - 1;
  }
  add_probe_errors(runs, trade);
  return trade;
}

reports::Trade measure_trade(const Case& whole, const Running& running, int rounds) {
  const Case c = bare(whole);
  const std::vector<reports::Case> results = run_cases({c}, running);
  reports::Trade trade = trade_of(c, results.front().runs);
  if (rounds <= 0) return trade;
  const std::vector<Leaf> all = leaves(c);
  std::vector<Leaf> timed;
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!trade.points[i].completed()) continue;
    timed.push_back(all[i]);
    which.push_back(i);
  }
  const std::vector<reports::Timed> times = time_runs(c, timed, rounds, running.cancelled, running.progress);
  for (std::size_t k = 0; k < which.size(); ++k) trade.points[which[k]].timed = times[k];
  return trade;
}

}  // namespace diptych::runner
