#include "reports/trade_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <sstream>
#include <vector>

#include "reports/csv.hpp"
#include "reports/json.hpp"
#include "reports/text.hpp"

namespace diptych::reports {
namespace {

const char* unit_of_cost(Cost cost) {
  return cost == Cost::work ? "updates" : cost == Cost::seconds ? "seconds" : "bytes";
}

/// The changed keys, " viscosity.form=york", that all labels name.
std::vector<std::string> in_all_labels(const Trade& trade) {
  std::vector<std::string> common;
  std::istringstream words(trade.points.empty() ? "" : trade.points.front().label);
  for (std::string word; words >> word;) {
    const std::string key = word.substr(0, word.find('='));
    if (key == word || key.find('.') == key.npos) continue;
    const auto has = [&](const TradePoint& point) { return (point.label + ' ').find(' ' + word + ' ') != word.npos; };
    if (std::all_of(trade.points.begin(), trade.points.end(), has)) common.push_back(' ' + word);
  }
  return common;
}

}  // namespace

std::string time_words(const Timed& timed, const char* unit) {
  if (timed.rounds == 0) return "-";
  const std::string spread = timed.rounds > 1 ? fmt::format(" ± {:.0f} %", 100 * timed.spread) : "";
  return fmt::format("{:.3g}{}{}", timed.seconds, unit, spread);
}

std::string trade_text(const Trade& trade, const Aim& aim, Cost cost) {
  std::string out = fmt::format("{}: error of {} at t = {:g} {} against cost\n", trade.case_id, aim.quantity, aim.time,
                                trade.time_unit);
  const std::vector<bool> front = on_front(trade, aim, cost);
  std::vector<std::size_t> order(trade.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // What was not begun cost nothing, and stands last.
  const auto paid = [&](const TradePoint& point) {
    const double price = cost_of(point, cost);
    return price > 0 ? price : std::numeric_limits<double>::infinity();
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return paid(trade.points[a]) < paid(trade.points[b]); });
  const std::vector<std::string> common = in_all_labels(trade);
  const auto label_of = [&](const TradePoint& point) {
    std::string label = point.label + ' ';
    for (const std::string& word : common) label.erase(label.find(word + ' '), word.size());
    return label.substr(0, label.size() - 1);
  };
  if (!common.empty()) out += "  all with";
  for (const std::string& word : common) out += word;
  if (!common.empty()) out += '\n';
  std::size_t widest = 3;
  for (const TradePoint& point : trade.points) widest = std::max(widest, characters(label_of(point)));
  const auto line = [&](const std::string& name, const std::string& error, const std::string& predicted,
                        const std::string& updates, const std::string& bytes, const std::string& seconds,
                        const std::string& mark) {
    return fmt::format("  {}  {:>20} {:>10} {:>10} {:>9} {}{}\n", to_left(name, widest), error, predicted, updates,
                       bytes, to_right(seconds, 14), mark.empty() ? "" : "  " + mark);
  };
  out += line("run", "error", "predicted", "updates", "bytes", "seconds", "");
  for (const std::size_t i : order) {
    const TradePoint& point = trade.points[i];
    const TradeError* found = point.completed() ? point.error_of(aim.quantity, aim.time) : nullptr;
    const std::string error = !found            ? (point.completed() ? "none" : point.status)
                              : found->band > 0 ? fmt::format("{:.3e} (U {:.0e})", found->error, found->band)
                                                : fmt::format("{:.3e}", found->error);
    out += line(label_of(point), error, found && found->predicted ? fmt::format("{:.3e}", *found->predicted) : "-",
                fmt::format("{:.3g}", point.work()), fmt::format("{:.3g}", static_cast<double>(point.bytes)),
                time_words(point.timed), front[i] ? "front" : "");
    if (!point.completed() && !point.message.empty()) out += fmt::format("      {}\n", point.message);
  }
  return out + fmt::format(
                   "updates: of elements or particles, and of nodes, those of the diffusion too; seconds: median of "
                   "the rounds\n± half their interquartile range, no books; front: nothing is as near for fewer {}\n",
                   unit_of_cost(cost));
}

std::string trade_csv(const Trade& trade) {
  std::string out = csv_note("case", trade.case_id) + csv_note("title", trade.title) +
                    csv_note("band", "± of the error where its reference is extrapolated; 0: the reference is exact") +
                    csv_note("seconds",
                             "median over the rounds, no books; spread: half the interquartile range, part of the "
                             "median; empty where it was not timed; of what timed out, until it was stopped") +
                    csv_line({"run",
                              "setting",
                              "scene",
                              "method",
                              "cells",
                              "cell_size",
                              "status",
                              "message",
                              "unknowns",
                              "steps",
                              "element_steps",
                              "particle_steps",
                              "node_steps",
                              "diffusion_updates",
                              "bytes",
                              "threads",
                              "rounds",
                              "seconds",
                              "spread",
                              "quantity",
                              "time_" + trade.time_unit,
                              "error",
                              "band",
                              "predicted"});
  for (const TradePoint& point : trade.points) {
    const bool timed = point.timed.rounds > 0;
    const std::vector<std::string> head{point.label,
                                        point.setting,
                                        point.scene,
                                        point.method,
                                        std::to_string(point.cells),
                                        csv_number(point.cell_size),
                                        point.status,
                                        point.message,
                                        std::to_string(point.unknowns),
                                        std::to_string(point.steps),
                                        std::to_string(point.element_steps),
                                        std::to_string(point.particle_steps),
                                        std::to_string(point.node_steps),
                                        std::to_string(point.diffusion_updates),
                                        std::to_string(point.bytes),
                                        std::to_string(point.threads),
                                        std::to_string(point.timed.rounds),
                                        timed ? csv_number(point.timed.seconds) : "",
                                        timed ? csv_number(point.timed.spread) : ""};
    for (const TradeError& one : point.errors) {
      std::vector<std::string> cells = head;
      cells.insert(cells.end(), {one.quantity, csv_number(one.time), csv_number(one.error), csv_number(one.band),
                                 one.predicted ? csv_number(*one.predicted) : ""});
      out += csv_line(cells);
    }
    if (!point.errors.empty()) continue;
    std::vector<std::string> cells = head;
    cells.insert(cells.end(), {"", "", "", "", ""});
    out += csv_line(cells);
  }
  return out;
}

std::string trade_json(const Trade& trade, const Provenance& made_by) {
  Json all{{"type", "trade"}, {"case", trade.case_id}, {"title", trade.title}, {"time_unit", trade.time_unit}};
  Numbers of_all(all);
  all["points"] = Json::array();
  for (const TradePoint& point : trade.points) {
    Json one{{"run", point.label},
             {"setting", point.setting},
             {"scene", point.scene},
             {"method", point.method},
             {"cells", point.cells},
             {"status", point.status},
             {"message", point.message},
             {"unknowns", point.unknowns},
             {"steps", point.steps},
             {"element_steps", point.element_steps},
             {"particle_steps", point.particle_steps},
             {"node_steps", point.node_steps},
             {"diffusion_updates", point.diffusion_updates},
             {"bytes", point.bytes},
             {"threads", point.threads},
             {"rounds", point.timed.rounds}};
    Numbers numbers(one);
    numbers.put("cell_size", point.cell_size);
    if (point.timed.rounds > 0) {
      numbers.put("seconds", point.timed.seconds);
      numbers.put("spread", point.timed.spread);
    }
    one["errors"] = Json::array();
    for (const TradeError& error : point.errors) {
      Json item{{"quantity", error.quantity}};
      Numbers values(item);
      values.put("time", error.time);
      values.put("error", error.error);
      values.put("band", error.band);
      values.put("predicted", error.predicted);
      numbers.also(values.finish());
      one["errors"].push_back(std::move(item));
    }
    of_all.also(numbers.finish());
    all["points"].push_back(std::move(one));
  }
  of_all.finish();
  all["env"] = env_of(made_by);
  return json_line(all);
}

}  // namespace diptych::reports
