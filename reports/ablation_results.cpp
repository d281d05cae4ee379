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

/// What an aid leaves of an uncertainty, as a part of it; NaN where it is not known, or so large that nothing is. Where
/// no exact solution tells whether it leads nearer, an aid that moves the result by more than was uncertain only moves
/// it.
double left_by(const AblatedQuantity& one) {
  constexpr double known_at_all = 0.5;  // of the scale
  if (!(one.uncertainty <= known_at_all)) return std::nan("");
  const double left = std::max(one.uncertainty_changed, AblatedQuantity::round_off) /
                      std::max(one.uncertainty, AblatedQuantity::round_off);
  const bool exact = one.field && !std::isnan(one.changed);
  return !exact && one.times() > 1 ? std::max(left, one.times()) : left;
}

/// An aid is noticed where it takes a tenth off the uncertainties, in the median over all quantities and times: one
/// that happens to vanish decides nothing.
Ruling ruling_of_aid(const Ablation& ablation) {
  Ruling ruling;
  ruling.need = Need::not_known;
  std::vector<double> all;
  bool changes = false, any = false;
  for (const AblatedQuantity& one : ablation.quantities) {
    any = any || !std::isnan(one.change);
    changes = changes || one.change > AblatedQuantity::round_off;
    const double left = left_by(one);
    if (std::isnan(one.uncertainty_changed) || std::isnan(left)) continue;
    if (left < 1) ++ruling.exceeded;
    if (all.empty() || left < *std::min_element(all.begin(), all.end())) ruling.most = &one;
    all.push_back(left);
  }
  ruling.quantities = static_cast<int>(all.size());
  if (any && !changes) ruling.need = Need::no_difference;
  if (all.empty() || !changes) return ruling;
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
