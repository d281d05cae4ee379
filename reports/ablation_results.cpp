#include "reports/ablation_results.hpp"

#include <algorithm>
#include <set>

namespace diptych::reports {

double weight_of(const AblatedQuantity& one, bool added) {
  if (one.change <= AblatedQuantity::round_off) return 0;
  if (one.field && !std::isnan(one.stands) && !std::isnan(one.changed)) {
    if (!added) return one.changed > one.stands ? one.times() : 0;
    constexpr double worth_saying = 0.9;
    return one.changed < worth_saying * one.stands ? one.stands / one.changed : 0;
  }
  return one.times();
}

Ruling ruling_of(const Ablation& ablation) {
  if (!ablation.completed()) return {};
  Ruling ruling;
  ruling.need = Need::not_known;
  bool changes = false, open = false;
  std::set<std::string> compared, exceeded;
  for (const AblatedQuantity& one : ablation.quantities) {
    if (std::isnan(one.change)) continue;
    compared.insert(one.quantity);
    changes = changes || one.change > AblatedQuantity::round_off;
    const double weight = weight_of(one, ablation.added);
    open = open || std::isnan(weight);
    if (std::isnan(weight)) continue;
    if (weight > 1) exceeded.insert(one.quantity);
    const bool more =
        !ruling.most || weight > ruling.weight || (weight == ruling.weight && one.times() > ruling.most->times());
    if (!more) continue;
    ruling.most = &one;
    ruling.weight = weight;
  }
  ruling.quantities = static_cast<int>(compared.size());
  ruling.exceeded = static_cast<int>(exceeded.size());
  if (compared.empty()) return ruling;
  if (!changes)
    ruling.need = Need::no_difference;
  else if (!exceeded.empty())
    ruling.need = Need::required;
  else if (!open)
    ruling.need = Need::not_required;
  return ruling;
}

}  // namespace diptych::reports
