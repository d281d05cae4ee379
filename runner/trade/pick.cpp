#include "runner/trade/pick.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "reports/trade_table.hpp"
#include "runner/input/leaf.hpp"
#include "runner/trade/timing.hpp"
#include "runner/trade/trade.hpp"

namespace diptych::runner {
namespace {

using reports::Cost;
using reports::Trade;
using reports::TradeError;
using reports::TradePoint;

/// Error and its band; infinite where the point cannot be compared.
double sure_error(const TradePoint& point, const Target& target) {
  const TradeError* found = point.completed() ? point.error_of(target.aim.quantity, target.aim.time) : nullptr;
  const double sum = found ? found->error + found->band : std::nan("");
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

bool within_limits(const TradePoint& point, const Target& target) {
  if (target.seconds && !(point.timed.rounds > 0 && point.timed.seconds <= *target.seconds)) return false;
  return !target.bytes || static_cast<double>(point.bytes) <= *target.bytes;
}

/// The finer mesh of the point's setting that is further off than `error`, where there is one: what is near on the
/// coarser one is so by chance, as where errors change their sign.
const TradePoint* finer_but_further(const Trade& trade, const TradePoint& point, const Target& target, double error) {
  const TradePoint* found = nullptr;
  for (const TradePoint& other : trade.points) {
    const double theirs = sure_error(other, target);
    if (other.setting != point.setting || other.cells <= point.cells || !std::isfinite(theirs) || theirs <= error)
      continue;
    if (!found || other.cells < found->cells) found = &other;
  }
  return found;
}

/// The cheapest within the limits whose error, and that of finer meshes of its setting, is at most so large.
template <class Also>
std::optional<std::size_t> cheapest(const Trade& trade, const Target& target, double error, Also&& also) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < trade.points.size(); ++i) {
    const TradePoint& point = trade.points[i];
    if (!(sure_error(point, target) <= error) || !within_limits(point, target) || !also(point) ||
        finer_but_further(trade, point, target, error))
      continue;
    if (!best || cost_of(point, target.cost) < cost_of(trade.points[*best], target.cost)) best = i;
  }
  return best;
}

std::string cost_words(const TradePoint& point) {
  std::string text = fmt::format("{:.3g} updates, {:.3g} bytes", point.work(), static_cast<double>(point.bytes));
  if (point.timed.rounds > 0) text += ", " + reports::time_words(point.timed, " s");
  return text;
}

std::string error_words(const TradePoint& point, const Target& target) {
  const TradeError& found = *point.error_of(target.aim.quantity, target.aim.time);
  return found.band > 0 ? fmt::format("{:.3g} % ± {:.2g} %", 100 * found.error, 100 * found.band)
                        : fmt::format("{:.3g} %", 100 * found.error);
}

double price(const Trade& trade, const Target& target, std::size_t i) { return cost_of(trade.points[i], target.cost); }

}  // namespace

Pick pick(const Trade& trade, const Target& target) {
  const auto any = [](const TradePoint&) { return true; };
  Pick found;
  found.best = cheapest(trade, target, target.error, any);
  if (found.best) {
    const std::string& setting = trade.points[*found.best].setting;
    found.runner_up =
        cheapest(trade, target, target.error, [&](const TradePoint& point) { return point.setting != setting; });
    found.halved = cheapest(trade, target, target.error / 2, any);
    return found;
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < trade.points.size(); ++i) {
    const double error = sure_error(trade.points[i], target);
    if (error <= target.error) continue;  // near by chance
    if (!(error < least) || !within_limits(trade.points[i], target)) continue;
    least = error;
    found.nearest = i;
  }
  return found;
}

std::optional<Proposal> propose(const Trade& trade, const Target& target, const Pick& found) {
  const auto from = found.best ? found.best : found.nearest;
  if (!from || trade.points[*from].error_of(target.aim.quantity, target.aim.time)->band > 0) return {};
  // The setting's meshes, from the coarsest on.
  std::vector<const TradePoint*> meshes;
  for (const TradePoint& point : trade.points)
    if (point.setting == trade.points[*from].setting && std::isfinite(sure_error(point, target)))
      meshes.push_back(&point);
  std::sort(meshes.begin(), meshes.end(), [](const auto* a, const auto* b) { return a->cells < b->cells; });
  const auto first =
      std::min_element(meshes.begin(), meshes.end(), [](const auto* a, const auto* b) { return a->leaf < b->leaf; });
  const auto at =
      static_cast<std::size_t>(std::find(meshes.begin(), meshes.end(), &trade.points[*from]) - meshes.begin());
  if (at == 0 || at >= meshes.size()) return {};
  const TradePoint &coarse = *meshes[at - 1], &fine = *meshes[at];
  const double before = sure_error(coarse, target), after = sure_error(fine, target);
  if (!(after < before && after > 0)) return {};
  const double order = std::log(before / after) / std::log(static_cast<double>(fine.cells) / coarse.cells);
  const auto expected = [&](double cells) { return after * std::pow(fine.cells / cells, order); };
  const int cells = static_cast<int>(std::ceil(fine.cells * std::pow(after / target.error, 1 / order)));
  if (found.best ? cells <= coarse.cells || cells >= fine.cells : cells <= fine.cells || cells > 4 * fine.cells)
    return {};
  return Proposal{fine.setting, fine.which, (*first)->leaf, fine.threads, cells, expected(cells)};
}

std::string words_of(const Trade& trade, const Target& target, const Pick& found) {
  std::string text = fmt::format("{}: {} at t = {:g} {} within {:g} %", trade.case_id, target.aim.quantity,
                                 target.aim.time, trade.time_unit, 100 * target.error);
  if (target.seconds) text += fmt::format(", {:g} s", *target.seconds);
  if (target.bytes) text += fmt::format(", {:g} bytes", *target.bytes);
  text += '\n';
  if (!found.best) {
    text += "  none of the measured settings does";
    if (found.nearest)
      text += fmt::format("; the nearest is {}: {}, {}", trade.points[*found.nearest].label,
                          error_words(trade.points[*found.nearest], target), cost_words(trade.points[*found.nearest]));
    return text + '\n';
  }
  const TradePoint& best = trade.points[*found.best];
  text += fmt::format("  {}: {} ({:.2f} of what is allowed), {}\n", best.label, error_words(best, target),
                      sure_error(best, target) / target.error, cost_words(best));
  const auto times = [&](std::size_t i) { return price(trade, target, i) / price(trade, target, *found.best); };
  if (found.runner_up)
    text += fmt::format("  runner-up: {}: {}, {:.2g} times the cost\n", trade.points[*found.runner_up].label,
                        error_words(trade.points[*found.runner_up], target), times(*found.runner_up));
  else
    text += "  runner-up: no other setting does\n";
  if (found.halved == found.best)
    text += "  half the error: it has that already\n";
  else if (found.halved)
    text += fmt::format("  half the error: {}, {:.2g} times the cost\n", trade.points[*found.halved].label,
                        times(*found.halved));
  else
    text += "  half the error: none of the measured settings has it\n";
  for (std::size_t i = 0; i < trade.points.size(); ++i) {
    const TradePoint& point = trade.points[i];
    if (!(sure_error(point, target) <= target.error) || !within_limits(point, target) ||
        !(price(trade, target, i) < price(trade, target, *found.best)))
      continue;
    const TradePoint& finer = *finer_but_further(trade, point, target, target.error);
    text += fmt::format("  passed over: {}: {}, {:.2g} times the cost, but near by chance: {} has {}\n", point.label,
                        error_words(point, target), times(i), finer.label, error_words(finer, target));
  }
  return text;
}

Trial tried(const std::vector<Case>& cases, const Target& target, const Proposal& proposal, const Running& running) {
  const Case c = bare(cases.at(proposal.which));
  Leaf leaf = leaves(c).at(proposal.like);
  leaf.cells = proposal.cells;
  Trial trial;
  try {
    trial.point = measured_point(c, leaf, running);
  } catch (const std::exception& problem) {  // as where a flyer's face would lie between two columns of nodes
    trial.point.status = "error";
    trial.words = fmt::format("  by its meshes {} with {} cells would have {:.3g} %, but it cannot be run: {}\n",
                              proposal.setting, proposal.cells, 100 * proposal.error, problem.what());
    return trial;
  }
  trial.point.which = proposal.which;
  trial.point.threads = proposal.threads;
  if (trial.point.threads > 1)
    for (std::string* name : {&trial.point.label, &trial.point.setting})
      *name += fmt::format(" threads={}", trial.point.threads);
  trial.words = fmt::format("  by its meshes {} would have {:.3g} %: ", trial.point.label, 100 * proposal.error);
  trial.point.leaf = proposal.like;  // of the same setting
  const TradeError* found =
      trial.point.completed() ? trial.point.error_of(target.aim.quantity, target.aim.time) : nullptr;
  if (found && target.rounds > 0)
    trial.point.timed = time_runs({{&c, leaf, proposal.threads}}, target.rounds, running.cancelled, {}).front();
  trial.confirmed = found && found->error <= target.error && within_limits(trial.point, target);
  trial.words += trial.confirmed ? "confirmed, " : "retracted, ";
  if (found)
    trial.words += fmt::format("it has {:.3g} %; {}\n", 100 * found->error, cost_words(trial.point));
  else
    trial.words += fmt::format("its run is {}\n", trial.point.status);
  return trial;
}

}  // namespace diptych::runner
