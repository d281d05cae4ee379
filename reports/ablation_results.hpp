// What becomes of a scene when something is taken off it or added to it, as plain data.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "reports/trade_results.hpp"

namespace diptych::reports {

/// A number or a field of a scene, as the scene stands and as changed.
struct AblatedQuantity {
  std::string quantity;           ///< "probe.tip", "contact.duration"; of a field "stress"
  double time = std::nan("");     ///< the sample time [the case's unit of time]; NaN: of the whole run
  bool field = false;             ///< then `stands` and `changed` are its L2 errors, where an exact solution is known
  double stands = std::nan("");   ///< NaN: there is none
  double changed = std::nan("");  ///< NaN: there is none
  double scale = 1;               ///< what the next two are parts of, > 0
  double change = std::nan("");   ///< ≥ 0; of a field the L2 norm of the difference; NaN: one of the two is missing
  double uncertainty = std::nan("");          ///< of the scene as it stands, on this mesh; NaN: not known
  double uncertainty_changed = std::nan("");  ///< of the changed scene, likewise, where it was run on all meshes
  std::string known_by;                       ///< "exact", "4 meshes", "2 meshes": what says how uncertain it is

  /// The change in units of the uncertainty; NaN where one is not known. Below round-off nothing is certain.
  double times() const { return change <= round_off ? 0 : change / std::max(uncertainty, round_off); }
  static constexpr double round_off = 1e-12;
};

/// One feature taken off, or one thing added that the scene lacks, in one setting of the case.
struct Ablation {
  std::string part;            ///< "viscosity"
  std::string says;            ///< what was changed: "[viscosity] taken out"
  bool aid = false;            ///< of the numbers, not of the scene: it is worth what it takes off the uncertainty
  bool added = false;          ///< to the scene, which lacks it; else taken off
  std::string run;             ///< label of the run as the scene stands
  std::string status;          ///< "completed"; or why there is nothing to compare: "unstable", "refused", "kept", ...
  std::string message;         ///< more of that
  TradePoint stands, changed;  ///< what both runs cost
  std::vector<AblatedQuantity> quantities;

  bool completed() const { return status == "completed"; }
};

/// How much a quantity speaks for a part; NaN where it is not known. Above 1 it does: the change is that many times the
/// uncertainty. Where an exact solution knows the errors of both runs, a part that is taken off and leaves the scene no
/// farther from it speaks 0.
double weight_of(const AblatedQuantity&, bool added);

/// What an ablation says of its part.
enum class Need {
  required,       ///< some quantity speaks for it
  not_required,   ///< none does, and all uncertainties are known
  no_difference,  ///< nothing changes by more than round-off
  not_known,      ///< something changes and it is not known how uncertain it is, or there is nothing to compare
  not_run         ///< the changed scene did not complete, or there is none
};

struct Ruling {
  Need need = Need::not_run;
  /// That speaks most for it; of several the first that changes most by times(). Of an aid whose uncertainty falls
  /// most.
  const AblatedQuantity* most = nullptr;
  double weight = 0;                 ///< of that
  int quantities = 0, exceeded = 0;  ///< that could be compared; of these, those that speak for it
  double left = std::nan("");        ///< of an aid: what is left of the uncertainties, the median
};
Ruling ruling_of(const Ablation&);

/// All that was tried on a case.
struct AblationStudy {
  std::string case_id, title, time_unit;
  std::vector<std::string> notes;  ///< which mesh of how many, and why
  std::vector<Ablation> tried;     ///< what was taken off, then what was added
};

}  // namespace diptych::reports
