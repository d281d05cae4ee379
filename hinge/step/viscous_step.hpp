// What a lagged artificial viscosity leaves of the time step of a plate.
#pragma once

#include <cmath>
#include <variant>

#include "hinge/material/plane.hpp"
#include "hinge/scene/plate.hpp"

namespace diptych::material {

/// The solid with `more` [Pa] added to what the trace of the strain in the plane gives to σ_xx and σ_yy, its shear
/// modulus kept: in plane strain the bulk modulus rises by it.
inline PlaneElastic stiffened(PlaneElastic solid, double more) {
  const Stiffness s = solid.stiffness();
  const double cross = s.cross + more;
  solid.poissons_ratio = cross / ((solid.plane == Plane::strain ? 2 : 1) * cross + 2 * s.shear);
  solid.youngs_modulus = 2 * s.shear * (1 + solid.poissons_ratio);
  return solid;
}

/// Largest stable time step Δt [s] where a stress ρν tr D of the velocities half a step before is added, ρν ≥ 0 [Pa s].
/// `limit` gives 2/ω of the stiffest mode of a solid without viscosity [s].
///
/// M (v⁺ − v⁻)/Δt = −K u − C v⁻ is stable if and only if M − Δt² K/4 − Δt C/2 ≥ 0, so as if the stiffness were
/// K + 2C/Δt, and C is K of a solid of which no more is left than a bulk modulus ρν. Δt²/limit² rises with Δt: found
/// between 0, where it is 0, and the limit without viscosity by regula falsi (Illinois), to 1e-12 and on the stable
/// side. NaN gives NaN.
template <class Limit>
double viscous_time_step(const PlaneElastic& solid, double density_times_viscosity, Limit limit) {
  const double whole = limit(solid);
  if (density_times_viscosity == 0) return whole;
  constexpr double tolerance = 1e-12;
  const auto excess = [&](double dt) {
    const double of_limit = dt / limit(stiffened(solid, 2 * density_times_viscosity / dt));
    return of_limit * of_limit - 1;
  };
  double low = 0, high = whole, at_low = -1, at_high = excess(high);
  int side = 0;  // the end that moved last
  for (int i = 0; i < 100 && !(at_high <= 0) && high - low > tolerance * high; ++i) {
    const double dt = low - at_low * ((high - low) / (at_high - at_low)), at = excess(dt);
    if (at < 0) {
      low = dt;
      at_low = at;
      if (side < 0) at_high /= 2;
      side = -1;
    } else {
      high = dt;
      at_high = at;
      if (side > 0) at_low /= 2;
      side = 1;
    }
  }
  return high * (1 - tolerance);
}

/// Largest time step of a plate whose cells have this area [m²], with what its law stiffens and viscosity
/// leaves. `limit` as above. ν = c √(h_x h_y) times the viscosity's strength.
template <class Limit>
double plate_time_step(const Plate& plate, double cell_area, Limit limit) {
  PlaneElastic solid = elastic(plate);
  double density_times_viscosity = 0;
  if (plate.viscosity) {
    const double speed = solid.pressure_wave_speed();
    density_times_viscosity = solid.density * speed * std::sqrt(cell_area) * plate.viscosity->strength(speed, 0);
  }
  solid.youngs_modulus *= std::visit([](const auto& s) { return s.stiffening(); }, plate.solid);
  return viscous_time_step(solid, density_times_viscosity, limit);
}

}  // namespace diptych::material
