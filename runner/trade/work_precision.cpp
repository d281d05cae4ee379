#include "runner/trade/work_precision.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "runner/draw/figure_runs.hpp"
#include "runner/trade/trade_panels.hpp"

namespace diptych::runner {
namespace {

using reports::Cost;
using reports::TradeError;
using reports::TradePoint;

void add_point(reports::Curve& curve, double cost, double error) { curve.add(std::log10(cost), std::log10(error)); }

reports::Figure::Series front_line(const reports::Trade& trade, const reports::Aim& aim, Cost cost) {
  reports::Trade drawn = trade;
  std::erase_if(drawn.points, [&](const TradePoint& point) { return !drawable_error(point, aim, cost); });
  const std::vector<bool> front = on_front(drawn, aim, cost);
  std::map<double, double> points;
  for (std::size_t i = 0; i < front.size(); ++i)
    if (front[i]) points[cost_of(drawn.points[i], cost)] = drawn.points[i].error_of(aim.quantity, aim.time)->error;
  reports::Figure::Series line{"front: nothing drawn is as near for less", "exact", {}};
  for (const auto& [paid, error] : points) add_point(line.curve, paid, error);
  return line;
}

/// What theory predicts of the meshes of all settings of a family of methods, a line each.
std::vector<reports::Figure::Series> predictions(const std::vector<std::vector<const TradePoint*>>& settings,
                                                 const reports::Aim& aim, Cost cost) {
  std::map<std::string, reports::Figure::Series> by_family;
  for (const auto& meshes : settings) {
    const std::string& method = meshes.front()->method;
    reports::Curve line;
    for (const TradePoint* point : meshes)
      if (const auto predicted = point->error_of(aim.quantity, aim.time)->predicted; predicted && *predicted > 0)
        add_point(line, cost_of(*point, cost), *predicted);
    if (line.x.empty()) continue;
    const std::string kind = kind_of_method(method);
    auto& all = by_family.try_emplace(kind, family_of_method(method) + ", predicted", kind + "-thin").first->second;
    all.curve.x.insert(all.curve.x.end(), line.x.begin(), line.x.end());
    all.curve.y.insert(all.curve.y.end(), line.y.begin(), line.y.end());
    all.curve.end_line();
  }
  std::vector<reports::Figure::Series> all;
  for (auto& [kind, series] : by_family) all.push_back(std::move(series));
  return all;
}

reports::Figure::Panel panel_over(const reports::Trade& trade, const reports::Aim& aim, Cost cost) {
  const auto settings = settings_of(trade, aim, cost);
  reports::Figure::Panel panel;
  panel.series.push_back(front_line(trade, aim, cost));
  for (auto& series : series_of(settings, [&](const TradePoint& point) {
         return std::array{std::log10(cost_of(point, cost)), std::log10(drawable_error(point, aim, cost)->error)};
       }))
    panel.series.push_back(std::move(series));
  for (auto& series : predictions(settings, aim, cost)) panel.series.push_back(std::move(series));
  return panel;
}

/// Settings with a mesh that is exact, with the cheapest of these meshes.
std::string exact_ones(const reports::Trade& trade, const reports::Aim& aim) {
  std::map<std::string, const TradePoint*> cheapest;
  for (const TradePoint& point : trade.points) {
    const TradeError* found = point.completed() ? point.error_of(aim.quantity, aim.time) : nullptr;
    if (!found || !(found->error <= exact_but_for_round_off)) continue;
    const TradePoint*& one = cheapest[point.setting];
    if (!one || point.work() < one->work()) one = &point;
  }
  std::string words;
  for (const auto& [setting, point] : cheapest)
    words += fmt::format("{}{} (from {:.2g} updates)", words.empty() ? "" : ", ", setting, point->work());
  return words;
}

}  // namespace

reports::Figure work_precision(const reports::Trade& trade, const reports::Aim& aim, const std::string& id) {
  reports::Figure figure;
  figure.id = id;
  figure.title = fmt::format("{}: what an error of {} costs", trade.title, aim.quantity);
  figure.notes.push_back(
      fmt::format("{} at t = {:g} {}; each line joins the meshes of one setting, the table names them", trade.case_id,
                  aim.time, trade.time_unit));
  if (const std::string others = note_on_others(trade); !others.empty()) figure.notes.push_back(others);
  if (const std::string exact = exact_ones(trade, aim); !exact.empty())
    figure.notes.push_back("exact but for round-off, and not drawn: " + exact);
  figure.looks = looks_of_trade();
  figure.x_powers = figure.y_powers = true;
  figure.y_label = "error of " + aim.quantity;
  figure.panels.push_back(panel_over(trade, aim, Cost::work));
  figure.panels.back().label = "work: updates of elements or particles, and of nodes";
  figure.x_label = figure.panels.back().x_label = "updates";
  if (is_timed(trade)) {
    figure.panels.push_back(panel_over(trade, aim, Cost::seconds));
    figure.panels.back().label = "time, without books";
    figure.panels.back().x_label = "seconds";
  }
  std::vector<const std::vector<double>*> errors;
  for (const reports::Figure::Panel& panel : figure.panels)
    for (const auto& series : panel.series) errors.push_back(&series.curve.y);
  const auto range = span_of(errors);
  figure.y_min = range[0];
  figure.y_max = range[1];
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    reports::Figure::Panel& panel = figure.panels[i];
    std::array<double, 2> with_strip = range;
    add_strip(
        trade,
        [&](const TradePoint& point) {
          const double paid = cost_of(point, i == 0 ? Cost::work : Cost::seconds);
          return paid > 0 && std::isfinite(paid) ? std::log10(paid) : std::nan("");
        },
        with_strip, panel);
    figure.y_max = std::max(figure.y_max, with_strip[1]);
    std::vector<const std::vector<double>*> costs;
    for (const auto& series : panel.series) costs.push_back(&series.curve.x);
    panel.x_range = span_of(costs);
  }
  for (reports::Figure::Panel& panel : figure.panels)
    for (const double percent : {10.0, 3.0, 1.0, 0.3, 0.1})
      if (const double at = std::log10(percent / 100); at > range[0] && at < range[1])
        panel.marks.push_back({at, fmt::format("{:g} %", percent), false});
  double band = 0;
  for (const TradePoint& point : trade.points)
    if (const TradeError* found = point.error_of(aim.quantity, aim.time)) band = std::max(band, found->band);
  if (band > 0) {
    figure.notes.push_back(
        "U: how uncertain the value is to which the finer meshes extrapolate, after Eça and Hoekstra (2014); what is "
        "nearer than U is not known to be nearer");
    for (reports::Figure::Panel& panel : figure.panels)
      if (const double at = std::log10(band); at > range[0] && at < range[1])
        panel.marks.push_back({at, fmt::format("U = {:.2g} %", 100 * band), false});
  }
  return figure;
}

}  // namespace diptych::runner
