// The commands trade and pick.
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <thread>

#include "reports/figure.hpp"
#include "reports/files.hpp"
#include "reports/trade_table.hpp"
#include "runner/app/catalogue.hpp"
#include "runner/app/commands.hpp"
#include "runner/app/keeping.hpp"
#include "runner/app/provenance.hpp"
#include "runner/app/showing.hpp"
#include "runner/input/messages.hpp"
#include "runner/judge/gates.hpp"
#include "runner/trade/efficacy.hpp"
#include "runner/trade/over.hpp"
#include "runner/trade/pick.hpp"
#include "runner/trade/trade.hpp"
#include "runner/trade/work_precision.hpp"

namespace diptych::runner {
namespace {

/// The one case that is meant, and what --over makes of it.
struct Asked {
  std::vector<Case> cases;
  Timing timing;
};

Asked asked_of_trade(const Options& options) {
  const Case c = select_one_case(options.selectors);
  Asked asked;
  asked.timing.rounds = options.rounds;
  std::vector<std::string> of_case;
  for (const std::string& text : options.over) {
    if (!text.starts_with("threads=")) {
      of_case.push_back(text);
      continue;
    }
    if (options.rounds == 0)
      throw InputError("--over threads: found with --rounds 0; allowed: with rounds, nothing but the time differs");
    asked.timing.threads = whole_numbers_in("threads", text.substr(text.find('=') + 1), false);
    if (*std::max_element(asked.timing.threads.begin(), asked.timing.threads.end()) > 1024)
      throw InputError("--over threads: allowed: 1 to 1024");
  }
  asked.cases = with_values(c, of_case);
  return asked;
}

/// What is paid in, by --by.
reports::Cost cost_asked(const Options& options) {
  if (options.by.empty()) return options.rounds > 0 ? reports::Cost::seconds : reports::Cost::work;
  const Names known{"seconds", "updates", "bytes"};
  require_one_of("--by", options.by, known);
  if (options.by == "seconds" && options.rounds == 0)
    throw InputError("--by seconds: found with --rounds 0; allowed: with rounds to time the runs in");
  return options.by == "seconds" ? reports::Cost::seconds
         : options.by == "bytes" ? reports::Cost::bytes
                                 : reports::Cost::work;
}

Running running_of(const Options& options, const std::atomic<bool>& cancelled, Keeping* keeping) {
  Running running{threads_of(options), &cancelled};
  running.progress = progress();
  running.limit_seconds = options.limit;
  running.keeping = keeping;
  return running;
}

/// What is asked for by --scene: a variant, values of swept parameters and changed keys, which make another scene of
/// the case.
std::string scene_asked(const Options& options, const reports::Trade& trade) {
  Names scenes;
  for (const reports::TradePoint& point : trade.points)
    if (!contains(scenes, point.scene)) scenes.push_back(point.scene);
  if (options.scene.empty()) {
    if (scenes.size() > 1)
      tell("{}: of its scenes the first, {}; with --scene one of {}\n", trade.case_id, words(scenes.front()),
           joined(scenes));
    return scenes.front();
  }
  require_one_of("--scene", options.scene, scenes);
  return options.scene;
}

/// What is asked for by --quantity and --time, among what has errors.
reports::Aim aim_of(const Options& options, const reports::Trade& trade) {
  const std::vector<reports::Aim> aims = trade.aims();
  if (aims.empty())
    throw InputError(
        fmt::format("{}: no run that completed has an error: neither is an exact solution known nor has a "
                    "probe, a gauge or an outcome four meshes that settle",
                    trade.case_id));
  Names quantities;
  for (const reports::Aim& aim : aims)
    if (!contains(quantities, aim.quantity)) quantities.push_back(aim.quantity);
  const std::string preferred = contains(quantities, std::string("stress.L2")) ? "stress.L2" : quantities.front();
  const std::string quantity = options.quantity.empty() ? preferred : options.quantity;
  require_one_of("--quantity", quantity, quantities);
  std::vector<double> times;
  for (const reports::Aim& aim : aims)
    if (aim.quantity == quantity) times.push_back(aim.time);
  const double time = options.time.value_or(*std::max_element(times.begin(), times.end()));
  if (std::find(times.begin(), times.end(), time) == times.end())
    throw InputError(fmt::format("--time: found {}; allowed: {}", words(time), joined(times)));
  return {quantity, time};
}

/// What else the table could be of.
std::string others_of(const reports::Trade& trade) {
  Names quantities;
  std::set<double> times;
  for (const reports::Aim& aim : trade.aims()) {
    if (!contains(quantities, aim.quantity)) quantities.push_back(aim.quantity);
    times.insert(aim.time);
  }
  return fmt::format("--quantity: {}\n--time: {} {}\n", listed(quantities),
                     listed(std::vector(times.begin(), times.end())), trade.time_unit);
}

/// "1%", "0.01", "512M": a number and what follows it.
std::optional<double> number_with(const std::string& text, const std::vector<std::pair<std::string, double>>& endings) {
  double value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string rest(end, text.data() + text.size());
  for (const auto& [ending, factor] : endings)
    if (problem == std::errc() && rest == ending && std::isfinite(value) && value > 0) return value * factor;
  return {};
}

/// `shown`: what of it is drawn.
void write_trade(const reports::Trade& trade, const reports::Trade& shown, const reports::Aim& aim,
                 const Options& options) {
  const auto folder = options.out / "trade";
  reports::write_file(folder / (trade.case_id + ".csv"), reports::trade_csv(trade));
  reports::write_file(folder / (trade.case_id + ".json"), reports::trade_json(trade, provenance()));
  print("{}\n", (folder / (trade.case_id + ".{csv,json}")).string());
  reports::Case drawn;
  drawn.figures.push_back(work_precision(shown, aim, trade.case_id + ".cost"));
  drawn.figures.push_back(efficacy(shown, aim, trade.case_id + ".efficacy"));
  draw_figures({drawn}, folder, {});
}

bool stopped(const reports::Trade& trade) {
  return std::any_of(trade.points.begin(), trade.points.end(),
                     [](const reports::TradePoint& point) { return point.status == "cancelled"; });
}

}  // namespace

int trade_command(const Options& options, const std::atomic<bool>& cancelled) {
  const reports::Cost cost = cost_asked(options);
  const Asked asked = asked_of_trade(options);
  prepare(options.out);
  const auto keeping = keeping_of(options);
  const reports::Trade trade = measure_trade(asked.cases, running_of(options, cancelled, keeping.get()), asked.timing);
  tell_kept(keeping.get());
  if (cancelled && trade.aims().empty()) return unstable_or_error;  // nothing to show yet
  const reports::Trade shown = of_scene(trade, scene_asked(options, trade));
  const reports::Aim aim = aim_of(options, shown);
  print("{}\n{}\n", reports::trade_text(shown, aim, cost), others_of(shown));
  write_trade(trade, shown, aim, options);
  return stopped(trade) || cancelled ? unstable_or_error : all_passed;
}

int pick_command(const Options& options, const std::atomic<bool>& cancelled) {
  const auto error = number_with(options.error, {{"%", 0.01}, {" %", 0.01}, {"", 1}});
  if (!error) throw InputError(fmt::format("--error: found {}; allowed: 1% or 0.01, > 0", words(options.error)));
  Target target;
  target.error = *error;
  target.seconds = options.seconds;
  if (target.seconds && options.rounds == 0)
    throw InputError("--seconds: found with --rounds 0; allowed: with rounds to time the runs in");
  target.cost = cost_asked(options);
  target.rounds = options.rounds;
  if (!options.memory.empty()) {
    target.bytes = number_with(options.memory, {{"", 1}, {"k", 1e3}, {"M", 1e6}, {"G", 1e9}, {"T", 1e12}});
    if (!target.bytes)
      throw InputError(fmt::format("--memory: found {}; allowed: bytes, or 100k, 512M, 1G", words(options.memory)));
  }
  const Asked asked = asked_of_trade(options);
  const auto keeping = keeping_of(options);
  const Running running = running_of(options, cancelled, keeping.get());
  reports::Trade trade = measure_trade(asked.cases, running, asked.timing);
  if (stopped(trade) || cancelled) return unstable_or_error;
  trade = of_scene(trade, scene_asked(options, trade));
  target.aim = aim_of(options, trade);
  const Pick found = pick(trade, target);
  print("{}", words_of(trade, target, found));
  // Each proposal that is retracted tells more for the next one.
  constexpr int most = 3;
  bool confirmed = false;
  for (int k = 0; k < most && !confirmed; ++k) {
    const auto proposal = propose(trade, target, pick(trade, target));
    if (!proposal) break;
    const Trial trial = tried(asked.cases, target, *proposal, running);
    print("{}", trial.words);
    confirmed = trial.confirmed;
    if (!trial.point.completed()) break;  // it would be proposed again
    trade.points.push_back(trial.point);
  }
  return found.best || confirmed ? all_passed : some_failed;
}

}  // namespace diptych::runner
