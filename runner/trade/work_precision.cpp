#include "runner/trade/work_precision.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "runner/draw/figure_runs.hpp"
#include "runner/panel.hpp"

namespace diptych::runner {
namespace {

using reports::Cost;
using reports::TradeError;
using reports::TradePoint;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

constexpr double exact_but_for_round_off = 1e-12;

/// A completed point's error, where its logarithm and that of its cost can be drawn.
const TradeError* drawable_error(const TradePoint& point, const reports::Aim& aim, Cost cost) {
  const TradeError* found = point.completed() ? point.error_of(aim.quantity, aim.time) : nullptr;
  const bool good = found && found->error > exact_but_for_round_off && std::isfinite(found->error) &&
                    cost_of(point, cost) > 0 && std::isfinite(cost_of(point, cost));
  return good ? found : nullptr;
}

void add_point(reports::Curve& curve, double cost, double error) {
  curve.x.push_back(std::log10(cost));
  curve.y.push_back(std::log10(error));
}

void end_line(reports::Curve& curve) {
  curve.x.push_back(none);
  curve.y.push_back(none);
}

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

/// The meshes that can be drawn of each setting, from the coarsest on.
std::vector<std::vector<const TradePoint*>> settings_of(const reports::Trade& trade, const reports::Aim& aim,
                                                        Cost cost) {
  std::vector<std::vector<const TradePoint*>> settings;
  for (const TradePoint& point : trade.points) {
    if (!drawable_error(point, aim, cost)) continue;
    const auto same = [&](const auto& meshes) { return meshes.front()->setting == point.setting; };
    const auto known = std::find_if(settings.begin(), settings.end(), same);
    if (known == settings.end())
      settings.push_back({&point});
    else
      known->push_back(&point);
  }
  for (auto& meshes : settings)
    std::sort(meshes.begin(), meshes.end(), [](const auto* a, const auto* b) { return a->cells < b->cells; });
  return settings;
}

reports::Figure::Panel panel_over(const reports::Trade& trade, const reports::Aim& aim, Cost cost) {
  reports::Figure::Panel panel;
  panel.series.push_back(front_line(trade, aim, cost));
  std::map<std::string, reports::Curve> measured, predicted;  // of all settings of a method
  std::vector<std::string> methods;
  for (const std::vector<const TradePoint*>& meshes : settings_of(trade, aim, cost)) {
    const std::string& method = meshes.front()->method;
    if (std::find(methods.begin(), methods.end(), method) == methods.end()) methods.push_back(method);
    for (const TradePoint* point : meshes) {
      const TradeError& found = *point->error_of(aim.quantity, aim.time);
      add_point(measured[method], cost_of(*point, cost), found.error);
      if (found.predicted && *found.predicted > 0)
        add_point(predicted[method], cost_of(*point, cost), *found.predicted);
    }
    end_line(measured[method]);
    end_line(predicted[method]);
  }
  for (const std::string& method : methods)
    panel.series.push_back({name_of_method(method), kind_of_method(method), measured[method]});
  std::map<std::pair<std::string, std::string>, reports::Curve> by_family;
  for (auto& [method, curve] : predicted) {
    reports::Curve& all = by_family[{family_of_method(method), kind_of_method(method)}];
    all.x.insert(all.x.end(), curve.x.begin(), curve.x.end());
    all.y.insert(all.y.end(), curve.y.begin(), curve.y.end());
  }
  for (auto& [family, curve] : by_family)
    if (std::any_of(curve.x.begin(), curve.x.end(), [](double x) { return std::isfinite(x); }))
      panel.series.push_back({family.first + ", predicted", family.second + "-thin", curve});
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

/// The range of what is drawn, a margin around it.
std::array<double, 2> span_of(const std::vector<const std::vector<double>*>& all) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto* values : all)
    for (const double value : *values)
      if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  if (!(low <= high)) return {0, 1};
  const double margin = 0.06 * std::max(high - low, 0.5);
  return {low - margin, high + margin};
}

}  // namespace

reports::Figure work_precision(const reports::Trade& trade, const reports::Aim& aim, const std::string& id) {
  reports::Figure figure;
  figure.id = id;
  figure.title = fmt::format("{}: what an error of {} costs", trade.title, aim.quantity);
  figure.notes.push_back(
      fmt::format("{} at t = {:g} {}; each line joins the meshes of one setting, the table names them", trade.case_id,
                  aim.time, trade.time_unit));
  const auto left_out =
      std::count_if(trade.points.begin(), trade.points.end(), [](const TradePoint& p) { return !p.completed(); });
  if (left_out > 0)
    figure.notes.push_back(
        fmt::format("{} settings of {} are not drawn, being unstable, above their limit or not to be judged: the table "
                    "names them",
                    left_out, trade.points.size()));
  if (const std::string exact = exact_ones(trade, aim); !exact.empty())
    figure.notes.push_back("exact but for round-off, and not drawn: " + exact);
  figure.looks = looks();
  figure.x_powers = figure.y_powers = true;
  figure.y_label = "error of " + aim.quantity;
  figure.panels.push_back(panel_over(trade, aim, Cost::work));
  figure.panels.back().label = "work: updates of elements or particles, and of nodes";
  figure.x_label = figure.panels.back().x_label = "updates";
  const bool timed =
      std::any_of(trade.points.begin(), trade.points.end(), [](const TradePoint& p) { return p.timed.rounds > 0; });
  if (timed) {
    figure.panels.push_back(panel_over(trade, aim, Cost::seconds));
    figure.panels.back().label = "time on one thread, without books";
    figure.panels.back().x_label = "seconds";
  }
  std::vector<const std::vector<double>*> errors;
  for (reports::Figure::Panel& panel : figure.panels) {
    std::vector<const std::vector<double>*> costs;
    for (const auto& series : panel.series) {
      costs.push_back(&series.curve.x);
      errors.push_back(&series.curve.y);
    }
    panel.x_range = span_of(costs);
  }
  const auto range = span_of(errors);
  figure.y_min = range[0];
  figure.y_max = range[1];
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
