#include "runner/trade/efficacy.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "runner/trade/trade_panels.hpp"

namespace diptych::runner {

reports::Figure efficacy(const reports::Trade& trade, const reports::Aim& aim, const std::string& id) {
  using reports::Cost;
  using reports::TradePoint;
  const bool timed = is_timed(trade);
  const Cost cost = timed ? Cost::seconds : Cost::work;
  const std::string unit = timed ? "seconds" : "updates";
  reports::Figure figure;
  figure.id = id;
  figure.title = fmt::format("{}: how much accuracy of {} its cost buys", trade.title, aim.quantity);
  figure.notes.push_back(fmt::format(
      "{} at t = {:g} {}; each line joins the meshes of one setting; higher is better: a digit is an error, "
      "or a cost, ten times smaller",
      trade.case_id, aim.time, trade.time_unit));
  figure.notes.push_back(
      "efficacy over size, two of the axes of the time-accuracy-size spectrum: Chang, Fabien, Knepley & Mills (2018)");
  if (const std::string others = note_on_others(trade); !others.empty()) figure.notes.push_back(others);
  figure.looks = looks_of_trade();
  figure.x_powers = true;
  figure.x_label = "unknowns that move";
  figure.y_label = fmt::format("digits of efficacy, −log10(error × {})", unit);
  reports::Figure::Panel panel;
  const auto size = [](const TradePoint& point) {
    return point.unknowns > 0 ? std::log10(point.unknowns) : std::numeric_limits<double>::quiet_NaN();
  };
  panel.series = series_of(settings_of(trade, aim, cost), [&](const TradePoint& point) {
    const double error = drawable_error(point, aim, cost)->error;
    return std::array{size(point), -std::log10(error * cost_of(point, cost))};
  });
  std::vector<const std::vector<double>*> sizes, digits;
  for (const auto& series : panel.series) digits.push_back(&series.curve.y);
  std::array<double, 2> range = span_of(digits);
  add_strip(trade, size, range, panel);
  for (const auto& series : panel.series) sizes.push_back(&series.curve.x);
  panel.x_range = span_of(sizes);
  figure.y_min = range[0];
  figure.y_max = range[1];
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace diptych::runner
