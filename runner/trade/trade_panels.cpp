#include "runner/trade/trade_panels.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "runner/draw/figure_runs.hpp"
#include "runner/panel.hpp"
#include "runner/trade/by_setting.hpp"

namespace diptych::runner {
namespace {

using reports::TradePoint;

struct End {
  const char *id, *name;
  int filled, open;  ///< gnuplot's points: filled of elements, open of particles
};
constexpr std::array<End, 3> ends{
    {{"unstable", "unstable", 9, 8}, {"timed-out", "timed out", 5, 4}, {"not-judged", "not judged", 13, 12}}};

const End& end_of(const TradePoint& point) {
  if (point.status == "unstable" || point.status == "above limit") return ends[0];
  return ends[point.status == "timed out" ? 1 : 2];
}

/// "lc rgb '#08306b'" of a line's properties.
std::string colour_in(const std::string& line) {
  const std::size_t at = line.find("lc rgb");
  return at == line.npos ? "" : line.substr(at, line.find('\'', line.find('\'', at) + 1) + 1 - at);
}

}  // namespace

const reports::TradeError* drawable_error(const TradePoint& point, const reports::Aim& aim, reports::Cost cost) {
  const reports::TradeError* found = point.completed() ? point.error_of(aim.quantity, aim.time) : nullptr;
  const bool good = found && found->error > exact_but_for_round_off && std::isfinite(found->error) &&
                    cost_of(point, cost) > 0 && std::isfinite(cost_of(point, cost));
  return good ? found : nullptr;
}

std::vector<std::vector<const TradePoint*>> settings_of(const reports::Trade& trade, const reports::Aim& aim,
                                                        reports::Cost cost) {
  return by_setting(
      trade.points, [&](const TradePoint& point) { return drawable_error(point, aim, cost) != nullptr; },
      [](const TradePoint& a, const TradePoint& b) { return a.cells < b.cells; });
}

bool is_timed(const reports::Trade& trade) {
  return std::any_of(trade.points.begin(), trade.points.end(),
                     [](const TradePoint& p) { return p.completed() && p.timed.rounds > 0; });
}

std::vector<reports::Figure::Series> series_of(const std::vector<std::vector<const TradePoint*>>& settings,
                                               const std::function<std::array<double, 2>(const TradePoint&)>& at) {
  constexpr int lines_of_a_family = 3;
  std::map<std::string, int> of_family;
  for (const auto& meshes : settings) ++of_family[kind_of_method(meshes.front()->method)];
  std::vector<reports::Figure::Series> all;
  for (const auto& meshes : settings) {
    const TradePoint& first = *meshes.front();
    const std::string kind = kind_of_method(first.method);
    std::string label = name_of_method(first.method);
    if (of_family[kind] <= lines_of_a_family && first.setting.starts_with(first.method))
      label += first.setting.substr(first.method.size());
    auto one = std::find_if(all.begin(), all.end(), [&](const auto& series) { return series.label == label; });
    if (one == all.end()) one = all.insert(all.end(), {label, kind, {}});
    for (const TradePoint* point : meshes) {
      const auto [x, y] = at(*point);
      one->curve.add(x, y);
    }
    one->curve.end_line();
  }
  return all;
}

std::array<double, 2> span_of(const std::vector<const std::vector<double>*>& all) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto* values : all)
    for (const double value : *values)
      if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  if (!(low <= high)) return {0, 1};
  const double margin = 0.06 * std::max(high - low, 0.5);
  return {low - margin, high + margin};
}

void add_strip(const reports::Trade& trade, const std::function<double(const TradePoint&)>& x,
               std::array<double, 2>& y_range, reports::Figure::Panel& panel) {
  const double edge = y_range[1], step = 0.055 * (y_range[1] - y_range[0]);
  std::vector<std::string> families;
  std::map<std::string, std::size_t> known;
  std::vector<reports::Figure::Series> strip;
  for (const TradePoint& point : trade.points) {
    if (point.completed()) continue;
    const std::string kind = kind_of_method(point.method);
    if (std::find(families.begin(), families.end(), kind) == families.end()) families.push_back(kind);
    const double place = x(point);
    if (!std::isfinite(place)) continue;
    const End& end = end_of(point);
    const std::string id = kind + ':' + end.id;
    if (known.try_emplace(id, strip.size()).second)
      strip.push_back({family_of_method(point.method) + ", " + end.name, id, {}});
    const auto row = static_cast<double>(std::find(families.begin(), families.end(), kind) - families.begin());
    reports::Curve& curve = strip[known[id]].curve;
    curve.add(place, edge + (row + 0.7) * step);
    curve.end_line();
  }
  if (strip.empty()) return;
  panel.series.insert(panel.series.end(), strip.begin(), strip.end());
  panel.marks.push_back({edge, "above: no error", false});
  y_range[1] = edge + (static_cast<double>(families.size()) + 0.4) * step;
}

std::vector<reports::PanelLook> looks_of_trade() {
  std::vector<reports::PanelLook> all = looks();
  const std::vector<reports::PanelLook> methods = all;
  for (const reports::PanelLook& look : methods)
    for (const End& end : ends)
      all.push_back(
          {look.id + ':' + end.id,
           look.name,
           true,
           {fmt::format("{} pt {} ps 0.9", colour_in(look.lines.front()), look.markers ? end.open : end.filled)},
           {},
           ""});
  return all;
}

std::string note_on_others(const reports::Trade& trade) {
  const auto others =
      std::count_if(trade.points.begin(), trade.points.end(), [](const TradePoint& p) { return !p.completed(); });
  if (others == 0) return "";
  return fmt::format(
      "{} of {} runs have no error, being unstable, above their limit, timed out or not to be judged: the strip above "
      "the error shows what they had cost, where they had cost any; the table says why",
      others, trade.points.size());
}

}  // namespace diptych::runner
