// Tensile damage of a brittle solid, eqs. 23a–d (Taylor, Chen & Kuszmaul 1986 in the paper's form).
#pragma once

#include "hinge/material/plane.hpp"

namespace diptych::material {

/// What is whole again where the mean strain is negative. The paper degrades the solid in tension alone and does not
/// say.
enum class Closure {
  /// K; cracks close against a normal strain, not against a shear. At a given C_d the stress is then continuous and the
  /// derivative of an energy: a closed cycle of strains gives nothing and takes nothing.
  volumetric,
  /// K and G. Where ε_v changes sign under a shear strain a, the stress jumps: turned that way and back, with the shear
  /// put on in tension and taken off in compression, the solid gives 2 (G − Ḡ) a² a turn, without end.
  whole
};

/// A cracked solid where cracks are open (mean strain ≥ 0) and where they are closed.
struct CrackedStiffness {
  Stiffness open, closed;

  const Stiffness& at(const Tensor& strain) const { return strain.xx + strain.yy >= 0 ? open : closed; }
};

/// C_d of eq. 23a, of ε_v > 0 and ε̇_max > 0 [1/s].
struct CrackGrowth {
  double coefficient = 0;  ///< (5k/2) (K_IC/(ρ c))² [1/s²]
  double exponent = 7;     ///< m

  double operator()(double volumetric_strain, double strain_rate) const;
};

/// Neither modulus ever rises with C_d, so that damage takes energy and never gives any.
struct TensileDamage {
  PlaneElastic elastic;
  double fracture_toughness = 1e6;        ///< K_IC [Pa √m]
  double flaw_density = 5e22;             ///< k [1/m³]
  double exponent = 7;                    ///< m
  double beta = 1;                        ///< fraction β of damage in unloading; α = 16β/9
  double residual_stiffness = 1e-3;       ///< least part of K and of G that is left; our choice
  Closure closure = Closure::volumetric;  ///< our choice
  bool trace = false;                     ///< reads ε_v as tr ε; false: as tr ε / 3, our choice

  double alpha() const { return 16 * beta / 9; }
  /// Whether the stress at a given C_d is the derivative of an energy.
  bool has_potential() const { return closure == Closure::volumetric; }
  /// ε_v of a strain in the plane.
  double volumetric(const Tensor& strain) const {
    return (strain.xx + strain.yy) * elastic.trace_factor() / (trace ? 1 : 3);
  }
  double crack_coefficient() const;  ///< (5k/2) (K_IC/(ρ c))² of eq. 23a [1/s²]
  CrackGrowth crack_growth() const { return {crack_coefficient(), exponent}; }
  /// C_d, eq. 23a, 0 where ε_v ≤ 0; ε̇_max in 1/s, > 0.
  double crack_density(double volumetric_strain, double strain_rate) const;
  /// ν̄, eq. 23d, held at zero beyond α C_d = 1: D = 1 comes before it, and below ν̄ = −1 eq. 23b would heal the solid.
  inline double damaged_poissons_ratio(double crack_density) const;
  inline double damage(double crack_density) const;                ///< D, eq. 23b, at most 1
  inline double damaged_bulk_modulus(double crack_density) const;  ///< K̄, eq. 23c [Pa]
  /// Ḡ of K̄ and ν̄ (eqs. 23c and 23d) [Pa], at most the whole solid's: where ν > 0.395 a little damage would raise it.
  inline double damaged_shear_modulus(double crack_density) const;
  /// At C_d = 0 to the bit the whole solid's.
  inline CrackedStiffness damaged_stiffness(double crack_density) const;
};

// Of these, loops over cells are made.

inline double TensileDamage::damaged_poissons_ratio(double crack_density) const {
  const double left = 1 - alpha() * crack_density;
  return elastic.poissons_ratio * (left < 0 ? 0 : left);
}

inline double TensileDamage::damage(double crack_density) const {
  const double nu = damaged_poissons_ratio(crack_density);
  const double D = 16 * (1 - nu * nu) / (9 * (1 - 2 * nu)) * crack_density;
  return 1 < D ? 1 : D;  // this order keeps NaN
}

inline double TensileDamage::damaged_bulk_modulus(double crack_density) const {
  const double left = 1 - damage(crack_density);
  return (left < residual_stiffness ? residual_stiffness : left) * elastic.bulk_modulus();
}

inline double TensileDamage::damaged_shear_modulus(double crack_density) const {
  const double nu = damaged_poissons_ratio(crack_density), whole = elastic.shear_modulus();
  const double shear = 1.5 * (1 - damage(crack_density)) * elastic.bulk_modulus() * (1 - 2 * nu) / (1 + nu);
  const double least = residual_stiffness * whole, left = shear < least ? least : shear;
  return whole < left ? whole : left;
}

inline CrackedStiffness TensileDamage::damaged_stiffness(double crack_density) const {
  const Stiffness whole = elastic.stiffness();
  const double shear = damaged_shear_modulus(crack_density);
  const Stiffness open = stiffness_of_moduli(damaged_bulk_modulus(crack_density), shear, elastic.plane);
  const Stiffness closed =
      closure == Closure::whole ? whole : stiffness_of_moduli(elastic.bulk_modulus(), shear, elastic.plane);
  const bool none = crack_density == 0;
  const auto of = [&](const Stiffness& cracked) {
    return Stiffness{none ? whole.normal : cracked.normal, none ? whole.cross : cracked.cross,
                     none ? whole.shear : cracked.shear};
  };
  return {of(open), of(closed)};
}

}  // namespace diptych::material
