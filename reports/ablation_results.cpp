#include "reports/ablation_results.hpp"

#include <algorithm>

namespace diptych::reports {

Ruling ruling_of(const Ablation& ablation) {
  if (!ablation.completed()) return {};
  Ruling ruling{Need::not_known, nullptr};
  bool any = false, changes = false, open = false;
  for (const AblatedQuantity& one : ablation.quantities) {
    if (std::isnan(one.change)) continue;
    any = true;
    const double times = one.times();
    changes = changes || one.change > AblatedQuantity::round_off;
    open = open || std::isnan(times);
    if (!std::isnan(times) && (!ruling.most || times > ruling.most->times())) ruling.most = &one;
  }
  if (!any) return ruling;
  if (!changes)
    ruling.need = Need::no_difference;
  else if (ruling.most && ruling.most->times() > 1)
    ruling.need = Need::required;
  else if (!open)
    ruling.need = Need::not_required;
  return ruling;
}

}  // namespace diptych::reports
