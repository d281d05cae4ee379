#include "reports/trade_results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::reports {

Trade of_scene(Trade trade, const std::string& scene) {
  std::erase_if(trade.points, [&](const TradePoint& point) { return point.scene != scene; });
  return trade;
}

double cost_of(const TradePoint& point, Cost cost) {
  switch (cost) {
    case Cost::work: return point.work();
    case Cost::bytes: return static_cast<double>(point.bytes);
    case Cost::seconds: break;
  }
  return point.timed.rounds > 0 ? point.timed.seconds : std::numeric_limits<double>::infinity();
}

std::vector<bool> on_front(const Trade& trade, const Aim& aim, Cost cost) {
  const auto error = [&](const TradePoint& point) {
    const TradeError* found = point.completed() ? point.error_of(aim.quantity, aim.time) : nullptr;
    if (!found) return std::nan("");
    // What is smaller is exact, or as near as its reference is known: nothing is nearer. NaN stays.
    constexpr double round_off = 1e-12;
    const double floor = std::max(round_off, found->band);
    return found->error < floor ? floor : found->error;
  };
  std::vector<bool> front;
  for (const TradePoint& one : trade.points) {
    const double own = error(one), price = cost_of(one, cost);
    front.push_back(std::isfinite(own) && std::isfinite(price) &&
                    std::none_of(trade.points.begin(), trade.points.end(), [&](const TradePoint& other) {
                      const double theirs = error(other), paid = cost_of(other, cost);
                      return theirs <= own && paid <= price && (theirs < own || paid < price);
                    }));
  }
  return front;
}

}  // namespace diptych::reports
