// Tensile damage of a brittle solid, eqs. 23a–d (Taylor, Chen & Kuszmaul 1986 in the paper's form).
#pragma once

#include <algorithm>
#include <cmath>

#include "material/plane.hpp"

namespace diptych::material {

/// In tension (mean strain ≥ 0) the stiffness is that of the cracked solid; in compression cracks are closed and it is
/// the whole one's.
struct TensileDamage {
  PlaneElastic elastic;
  double fracture_toughness = 1e6;   ///< K_IC [Pa √m]
  double flaw_density = 5e22;        ///< k [1/m³]
  double exponent = 7;               ///< m
  double beta = 1;                   ///< fraction β of damage in unloading; α = 16β/9
  double residual_stiffness = 1e-3;  ///< least (1 − D) that enters the stiffness; our choice
  bool trace = false;                ///< reads ε_v as tr ε; false: as tr ε / 3, our choice

  double alpha() const { return 16 * beta / 9; }
  /// ε_v of a strain in the plane.
  double volumetric(const Tensor& strain) const {
    return (strain.xx + strain.yy) * elastic.trace_factor() / (trace ? 1 : 3);
  }
  /// (5k/2) (K_IC/(ρ c))² of eq. 23a [1/s²]: C_d = crack_coefficient · ε_v^m / ε̇².
  double crack_coefficient() const {
    const double ratio = fracture_toughness / (elastic.density * elastic.uniaxial_wave_speed());
    return 2.5 * flaw_density * ratio * ratio;
  }
  /// C_d, eq. 23a; ε̇_max in 1/s, > 0.
  double crack_density(double volumetric_strain, double strain_rate) const {
    if (volumetric_strain <= 0) return 0;
    return crack_coefficient() * std::pow(volumetric_strain, exponent) / (strain_rate * strain_rate);
  }
  /// ν̄, eq. 23d, held at zero beyond α C_d = 1: D = 1 comes before it, and below ν̄ = −1 eq. 23b would heal the solid.
  double damaged_poissons_ratio(double crack_density) const {
    return elastic.poissons_ratio * std::max(1 - alpha() * crack_density, 0.0);
  }
  /// D, eq. 23b, at most 1.
  double damage(double crack_density) const {
    const double nu = damaged_poissons_ratio(crack_density);
    return std::min(16 * (1 - nu * nu) / (9 * (1 - 2 * nu)) * crack_density, 1.0);  // this order keeps NaN
  }
  /// Of the cracked solid in tension, from K̄ (eq. 23c) and ν̄ (eq. 23d); at C_d = 0 to the bit the whole solid's.
  Stiffness damaged_stiffness(double crack_density) const {
    if (crack_density == 0) return elastic.stiffness();
    const double nu = damaged_poissons_ratio(crack_density);
    const double bulk = std::max(1 - damage(crack_density), residual_stiffness) * elastic.bulk_modulus();
    return material::stiffness(3 * bulk * (1 - 2 * nu), nu, elastic.plane);
  }
};

}  // namespace diptych::material
