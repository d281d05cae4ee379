// Pressure-dependent perfect plasticity in compression (the paper's section 4, before eq. 23a).
#pragma once

#include <cmath>
#include <optional>
#include <stdexcept>

#include "hinge/material/plane.hpp"

namespace diptych::material {

/// Deviatoric plastic strain of a point, its zz component being −(xx + yy).
using PlasticStrain = Tensor;

/// A cone in stress space, active where the mean stress is compressive: √(3 J₂) ≤ strength + slope · p with the
/// pressure p = −tr σ/3 > 0. Flow is deviatoric (it leaves the pressure alone) and perfect. Plane strain only: plane
/// stress would need an iteration for ε_zz. The paper gives no numbers; off unless a scene asks for it.
struct Compression {
  double strength = 0;  ///< of pure shear at p = 0, as √(3 J₂) [Pa], ≥ 0
  double slope = 0;     ///< ≥ 0

  /// Stress [Pa] at a total strain; brings the plastic strain up to it. Radial return, exact for a cone at fixed p: the
  /// deviator of the trial stress shrinks onto the cone. Where p ≤ 0 the answer is elastic and the plastic strain
  /// stays. `dissipated` is σ : Δε_p of this call, ≥ 0 [J/m³]. With no plastic strain and inside the cone the stress is
  /// the elastic one to the bit.
  Tensor stress(const Stiffness& whole, const Tensor& strain, PlasticStrain& state, double& dissipated) const {
    const double twice_shear = 2 * whole.shear;
    const double volume = strain.xx + strain.yy;
    const double pressure = -(whole.cross + twice_shear / 3) * volume;
    const Tensor trial = whole.stress(strain) - state * twice_shear;
    dissipated = 0;
    if (pressure <= 0) return trial;
    const Tensor deviator{trial.xx + pressure, trial.yy + pressure, trial.xy};
    const double zz = -(deviator.xx + deviator.yy);
    const double equivalent = std::sqrt(1.5 * (deviator.contract(deviator) + zz * zz));  // √(3 J₂)
    const double limit = strength + slope * pressure;
    if (equivalent <= limit) return trial;
    const double kept = limit / equivalent;
    state = state + deviator * ((1 - kept) / twice_shear);
    dissipated = equivalent * equivalent * kept * (1 - kept) / (1.5 * twice_shear);  // s : s = 2/3 (√(3 J₂))²
    return {kept * deviator.xx - pressure, kept * deviator.yy - pressure, kept * deviator.xy};
  }
  Tensor stress(const PlaneElastic& elastic, const Tensor& strain, PlasticStrain& state) const {
    double dissipated = 0;
    return stress(elastic.stiffness(), strain, state, dissipated);
  }
  /// Recoverable energy [J/m³]: ½ K (tr ε)² + G (dev ε − ε_p) : (dev ε − ε_p), in three dimensions.
  static double stored(const Stiffness& whole, const Tensor& strain, const PlasticStrain& state) {
    const double volume = strain.xx + strain.yy, bulk = whole.cross + 2 * whole.shear / 3;
    const Tensor deviator{strain.xx - volume / 3 - state.xx, strain.yy - volume / 3 - state.yy, strain.xy - state.xy};
    const double zz = -(deviator.xx + deviator.yy);
    return bulk * volume * volume / 2 + whole.shear * (deviator.contract(deviator) + zz * zz);
  }
};

/// Throws std::invalid_argument where the plastic flow across the plane is not known.
inline void check_cone(const PlaneElastic& elastic, const std::optional<Compression>& compression) {
  if (compression && elastic.plane == Plane::stress)
    throw std::invalid_argument("plasticity in compression is for plane strain only");
}

}  // namespace diptych::material
