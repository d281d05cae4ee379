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
  double damaged_poissons_ratio(double crack_density) const;
  double damage(double crack_density) const;                ///< D, eq. 23b, at most 1
  double damaged_bulk_modulus(double crack_density) const;  ///< K̄, eq. 23c [Pa]
  /// Ḡ of K̄ and ν̄ (eqs. 23c and 23d) [Pa], at most the whole solid's: where ν > 0.395 a little damage would raise it.
  double damaged_shear_modulus(double crack_density) const;
  /// At C_d = 0 to the bit the whole solid's.
  CrackedStiffness damaged_stiffness(double crack_density) const;
};

}  // namespace diptych::material
