#include "runner/trade/trade.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "runner/compare/quantities.hpp"
#include "runner/input/messages.hpp"
#include "runner/run/runner.hpp"
#include "runner/trade/errors.hpp"
#include "runner/trade/over.hpp"
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

/// What makes the scene: what was changed of the case's physics, the variant and the values of swept parameters.
std::string scene_of(const Case& c, const Leaf& leaf) {
  Leaf of_scene = leaf;
  for (const PlateVariant& variant : c.variants)
    if (variant.id == leaf.variant && std::all_of(variant.changes.begin(), variant.changes.end(),
                                                  [](const Change& change) { return is_numerical(change.key); }))
      of_scene.variant.clear();  // the same scene, solved in another way
  const std::string leafs = parameters_label(of_scene);
  return c.changed_scene + (c.changed_scene.empty() || leafs.empty() ? "" : " ") + leafs;
}

/// Books tell what yielding has spent.
bool needs_books(Case c) {
  c.ledger = true;
  for (const std::string& name : quantity_names(c, {Quantity::Sort::outcome})) {
    const Quantity& row = *find_quantity(name, c);
    if (row.of_books && std::none_of(row.needs.begin(), row.needs.end(), [&](auto need) { return need(name, c); }))
      return true;
  }
  return false;
}

/// Seconds that runs take at least, guessed from the quickest before them.
class Pace {
 public:
  explicit Pace(double limit) : limit_(limit) {}

  /// About how long it would take; nothing where no run of its method was long enough to tell.
  std::optional<double> guess(const Case& whole, const Leaf& leaf) const {
    const auto known = of_update_.find(leaf.method);
    if (known == of_update_.end()) return {};
    return known->second * updates_ahead(whole, leaf);
  }
  void learn(const reports::Run& run) {
    const double updates = static_cast<double>(run.unknowns) * static_cast<double>(run.steps);
    // What a short run takes is its beginning.
    if (!(run.wall_seconds > limit_ / 20 && updates > 0)) return;
    const double pace = run.wall_seconds / updates;
    const auto [known, is_new] = of_update_.try_emplace(run.method, pace);
    if (!is_new) known->second = std::min(known->second, pace);  // a run may have had to wait
  }

 private:
  double limit_;
  std::map<std::string, double> of_update_;  // of an unknown and step [s]
};

/// The runs of all cases; what is not begun for its length has status "left out".
std::vector<reports::Case> all_runs_of(const std::vector<Case>& cases, Running running) {
  running.books = Books::sums;  // where a case keeps any
  if (!running.limit_seconds) return run_cases(cases, running);
  const double limit = *running.limit_seconds;
  Pace pace(limit);
  running.cheapest_first = true;
  running.wanted = [&](std::size_t which, const Leaf& leaf) {
    const auto guess = pace.guess(cases[which], leaf);
    return !guess || *guess <= 2 * limit;
  };
  running.finished = [&](std::size_t, const reports::Run& run) { pace.learn(run); };
  std::vector<reports::Case> results = run_cases(cases, running);
  for (std::size_t which = 0; which < cases.size(); ++which) {
    const std::vector<Leaf> all = leaves(cases[which]);
    for (std::size_t i = 0; i < all.size(); ++i) {
      reports::Run& run = results[which].runs[i];
      if (run.status != "left out") continue;
      run.status = "timed out";
      run.message = fmt::format("not begun: at the pace of those before, it would take {:.2g} s",
                                pace.guess(cases[which], all[i]).value_or(limit));
    }
  }
  return results;
}

/// A point for each number of threads.
void spread_over_threads(const std::vector<Case>& cases, const std::vector<int>& threads, reports::Trade& trade) {
  if (threads == std::vector{1}) return;
  for (const Case& c : cases)
    if (kind_of(c) != SceneKind::plate)
      throw InputError(
          "--over threads: found for a case without a solid plate; allowed: of plates, whose steps take threads");
  std::vector<reports::TradePoint> points;
  for (const reports::TradePoint& point : trade.points) {
    if (!point.completed()) {
      points.push_back(point);
      continue;
    }
    for (const int count : threads) {
      points.push_back(point);
      points.back().threads = count;
      for (std::string* name : {&points.back().label, &points.back().setting})
        *name += fmt::format(" threads={}", count);
    }
  }
  trade.points = std::move(points);
}

}  // namespace

reports::TradePoint point_of(const reports::Run& run) {
  reports::TradePoint point;
  point.label = run.label();
  point.setting = setting_of(run);
  point.method = run.method;
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
  if (const auto found = run.measures.find("diffusion.updates"); found != run.measures.end())
    point.diffusion_updates = std::lround(found->second * static_cast<double>(run.steps));
  point.bytes = run.bytes;
  if (point.status == "timed out" && run.wall_seconds > 0) point.timed = {1, run.wall_seconds, 0};
  return point;
}

reports::TradePoint point_of(const Case& c, const Leaf& leaf, const reports::Run& run) {
  reports::TradePoint point = point_of(run);
  point.scene = scene_of(c, leaf);
  if (point.completed()) point.errors = known_errors(c, run);
  return point;
}

reports::TradePoint measured_point(const Case& whole, const Leaf& leaf, const Running& running) {
  const auto c = case_of(whole, leaf);
  return point_of(*c, leaf, run_leaf(*c, leaf, step_of(*c, leaf), running));
}

Case bare(Case c) {
  c.gates.clear();
  c.figures.clear();
  c.ledger = c.ledger && needs_books(c);
  c.allow_unstable = true;
  return c;
}

reports::Trade measure_trade(const std::vector<Case>& family, const Running& running, const Timing& timing) {
  std::vector<Case> cases;
  for (const Case& c : family) cases.push_back(bare(c));
  const std::vector<reports::Case> results = all_runs_of(cases, running);
  reports::Trade trade;
  trade.case_id = cases.front().id;
  trade.title = cases.front().title;
  trade.time_unit = cases.front().time_unit;
  std::vector<std::vector<Leaf>> of_cases;
  std::vector<std::vector<RunNumber>> read;
  for (std::size_t which = 0; which < cases.size(); ++which) {
    of_cases.push_back(leaves(cases[which]));
    for (std::size_t i = 0; i < of_cases[which].size(); ++i) {
      const reports::Run& run = results[which].runs[i];
      const auto own = case_of(cases[which], of_cases[which][i]);
      trade.points.push_back(point_of(*own, of_cases[which][i], run));
      trade.points.back().which = which;
      trade.points.back().leaf = i;
      read.push_back(trade.points.back().completed() ? readings(*own, run) : std::vector<RunNumber>{});
    }
  }
  add_extrapolated(read, trade);
  spread_over_threads(cases, timing.threads, trade);
  if (timing.rounds <= 0) return trade;
  std::vector<TimedRun> timed;
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < trade.points.size(); ++i) {
    const reports::TradePoint& point = trade.points[i];
    if (!point.completed()) continue;
    timed.push_back({&cases[point.which], of_cases[point.which][point.leaf], point.threads});
    points.push_back(i);
  }
  const std::vector<reports::Timed> times = time_runs(timed, timing.rounds, running.cancelled, running.progress);
  for (std::size_t k = 0; k < points.size(); ++k) trade.points[points[k]].timed = times[k];
  return trade;
}

}  // namespace diptych::runner
