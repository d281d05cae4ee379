#include "reports/ablation_results.hpp"

#include <algorithm>
#include <set>

namespace diptych::reports {

double weight_of(const AblatedQuantity& one, bool added) {
  if (one.change <= AblatedQuantity::round_off) return 0;
  const bool errors = one.field && !std::isnan(one.stands) && !std::isnan(one.changed);
  if (!added && errors && one.changed <= one.stands) return 0;
  return one.times();
}

namespace {

/// An aid is noticed where it takes a tenth off the uncertainties, in the median over all quantities and times.
Ruling ruling_of_aid(const Ablation& ablation) {
  Ruling ruling;
  ruling.need = Need::not_known;
  std::vector<double> all;
  for (const AblatedQuantity& one : ablation.quantities) {
    const double left = std::max(one.uncertainty_changed, AblatedQuantity::round_off) /
                        std::max(one.uncertainty, AblatedQuantity::round_off);
    if (std::isnan(one.uncertainty) || std::isnan(one.uncertainty_changed)) continue;
    ++ruling.quantities;
    if (left < 1) ++ruling.exceeded;
    if (all.empty() || left < *std::min_element(all.begin(), all.end())) ruling.most = &one;
    all.push_back(left);
  }
  if (all.empty()) return ruling;
  // The median: one that happens to vanish decides nothing.
  std::sort(all.begin(), all.end());
  ruling.left = std::sqrt(all[(all.size() - 1) / 2] * all[all.size() / 2]);
  constexpr double worth_saying = 0.9;
  ruling.need = ruling.left < worth_saying ? Need::required : Need::not_required;
  return ruling;
}

}  // namespace

Ruling ruling_of(const Ablation& ablation) {
  if (ablation.status == "idle") return {Need::no_difference};
  if (!ablation.completed()) return {};
  if (ablation.aid) return ruling_of_aid(ablation);
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
