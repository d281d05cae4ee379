// Up to which time step, or which other number, the settings of a case are stable, as plain data.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace diptych::reports {

/// The limit of one setting, found by bisection.
struct StabilityLimit {
  std::string label;         ///< "mpm-musl N=40 ppc=1 c1=0.5"
  std::string setting;       ///< the label less the value of the map's axis: what a curve has in common
  std::string method;        ///< "fem", "mpm-musl"
  std::string scene;         ///< "plane-stress c1=0.5": variant and parameters less the value of the axis; of one panel
  std::optional<double> at;  ///< the value of the map's axis
  std::optional<double> stable;    ///< the largest number seen not to grow; none: grows at the smallest tried
  std::optional<double> unstable;  ///< the smallest seen to grow or refused; none: stable at the largest tried
  std::optional<double> growth_below, growth_above;  ///< of amplitudes, per step, at these two
  std::optional<double> theory;                      ///< a closed form's, or eigenvalues' of the very mesh
  std::string message;                               ///< why there is no limit, or what refuses the step above

  /// Their middle.
  std::optional<double> limit() const {
    if (!stable || !unstable) return {};
    return (*stable + *unstable) / 2;
  }
  std::optional<double> ratio() const {
    if (!limit() || !theory) return {};
    return *limit() / *theory;
  }
  /// Found within this part of what theory says; true where it says nothing.
  bool agrees(double within) const { return !theory || (ratio() && std::abs(*ratio() - 1) <= within); }
};

struct StabilityMap {
  std::string case_id, title;
  std::string number;      ///< what is limited: "Courant number cΔt/h"
  std::string axis;        ///< whose values `at` are; empty: the settings have none in common
  std::string look_ahead;  ///< of each trial: "2000 steps"
  std::string followed;    ///< what was followed over it: "small random motions about rest"
  std::string unstable;    ///< what was called so
  double least = 0;        ///< the smallest number tried
  double most = 0;         ///< the largest
  std::vector<StabilityLimit> limits;
};

}  // namespace diptych::reports
