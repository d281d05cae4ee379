#include "runner/stability/stability_figure.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "runner/draw/figure_runs.hpp"
#include "runner/panel.hpp"
#include "runner/trade/by_setting.hpp"

namespace diptych::runner {
namespace {

using reports::StabilityLimit;

/// What an axis is called, and of which number of its values the figure is: near ½ Poisson's ratio counts by what is
/// left to it, which is what the moduli go with.
struct Across {
  std::string label;
  double (*of)(double) = [](double value) { return value; };
  bool powers = true;  ///< of ten, where values span many
};
Across across_of(const std::string& axis) {
  if (axis == "position")
    return {"place of a cell's one particle, along each side", [](double xi) { return xi; }, false};
  if (axis == "particles") return {"particles of a cell along each side"};
  if (axis == "cells") return {"cells"};
  if (axis == "nu" || axis.ends_with(".nu")) return {"1 − 2ν", [](double nu) { return 1 - 2 * nu; }};
  return {axis};
}

bool spans_powers(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  constexpr double wide = 30;
  return *least > 0 && *most > wide * *least;
}

}  // namespace

std::optional<reports::Figure> stability_figure(const reports::StabilityMap& map) {
  const auto curves = by_setting(
      map.limits, [](const StabilityLimit& one) { return one.at && (one.limit() || one.theory); },
      [](const StabilityLimit& a, const StabilityLimit& b) { return *a.at < *b.at; });
  std::vector<double> across, up;
  const auto [label, number_of, powers] = across_of(map.axis);
  for (const auto& curve : curves)
    for (const StabilityLimit* one : curve) {
      across.push_back(number_of(*one->at));
      if (one->limit()) up.push_back(*one->limit());
    }
  if (up.empty() || std::set<double>(across.begin(), across.end()).size() < 2) return {};
  reports::Figure figure;
  figure.id = map.case_id + ".stability";
  figure.title = fmt::format("{}: stability limits", map.title);
  figure.notes.push_back(
      fmt::format("{}; largest {} that is stable, look-ahead {}, by bisection to 0.1 %. Followed: {}", map.case_id,
                  map.number, map.look_ahead, map.followed));
  figure.looks = looks();
  figure.x_label = label;
  figure.y_label = map.number;
  figure.x_powers = powers && spans_powers(across);
  figure.y_powers = spans_powers(up);
  const auto x_of = [&](double number) { return figure.x_powers ? std::log10(number) : number; };
  const auto y_of = [&](double value) { return figure.y_powers ? std::log10(value) : value; };
  std::size_t missing = 0;
  for (const auto& curve : curves) {
    const std::string& scene = curve.front()->scene;
    const auto same = [&](const reports::Figure::Panel& panel) { return panel.label == scene; };
    auto panel = std::find_if(figure.panels.begin(), figure.panels.end(), same);
    if (panel == figure.panels.end()) {
      figure.panels.push_back({scene, {{"theory", "exact", {}}}});
      panel = figure.panels.end() - 1;
    }
    std::string name = curve.front()->setting;  // the panel says the rest
    if (!scene.empty() && name.ends_with(' ' + scene)) name.resize(name.size() - scene.size() - 1);
    reports::Figure::Series series{name, kind_of_method(curve.front()->method), {}};
    reports::Curve& theory = panel->series.front().curve;
    for (const StabilityLimit* one : curve) {
      const double x = x_of(number_of(*one->at));
      missing += !one->limit();
      if (const auto limit = one->limit()) series.curve.add(x, y_of(*limit));
      if (one->theory) theory.add(x, y_of(*one->theory));
    }
    if (!theory.x.empty()) theory.end_line();
    panel->series.push_back(std::move(series));
  }
  for (reports::Figure::Panel& panel : figure.panels) {
    if (panel.series.front().curve.x.empty()) panel.series.erase(panel.series.begin());
    if (panel.label.empty() && figure.panels.size() > 1) panel.label = "as the case stands";
  }
  if (missing > 0)
    figure.notes.push_back(
        fmt::format("{} settings have no limit within {:g} to {:g} and are not drawn", missing, map.least, map.most));
  const auto [left, right] = std::minmax_element(across.begin(), across.end());
  const auto [low, high] = std::minmax_element(up.begin(), up.end());
  const double x_low = x_of(*left), x_high = x_of(*right), margin = 0.04 * (x_high - x_low);
  figure.x_min = x_low - margin;
  figure.x_max = x_high + margin;
  figure.y_min = figure.y_powers ? y_of(*low) - 0.1 : 0;
  figure.y_max = figure.y_powers ? y_of(*high) + 0.1 : 1.15 * *high;
  return figure;
}

}  // namespace diptych::runner
