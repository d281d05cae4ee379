// Isotropic linear elasticity in the plane, small strain.
#pragma once

#include <cmath>

namespace diptych::material {

enum class Plane { strain, stress };

/// A symmetric tensor's components in the plane. xy is the tensor's own: of a strain half the engineering shear γ.
struct Tensor {
  double xx = 0, yy = 0, xy = 0;

  Tensor operator+(const Tensor& o) const { return {xx + o.xx, yy + o.yy, xy + o.xy}; }
  Tensor operator-(const Tensor& o) const { return {xx - o.xx, yy - o.yy, xy - o.xy}; }
  Tensor operator*(double f) const { return {xx * f, yy * f, xy * f}; }
  /// The double contraction a:b [product of the units].
  double contract(const Tensor& o) const { return xx * o.xx + yy * o.yy + 2 * (xy * o.xy); }
};

/// Stiffness in the plane [Pa]: σ_xx = normal ε_xx + cross ε_yy, σ_yy = cross ε_xx + normal ε_yy, σ_xy = 2 shear ε_xy.
struct Stiffness {
  double normal = 0, cross = 0, shear = 0;

  Tensor stress(const Tensor& strain) const {
    return {normal * strain.xx + cross * strain.yy, cross * strain.xx + normal * strain.yy, 2 * shear * strain.xy};
  }
};

/// From Young's modulus E [Pa] and Poisson's ratio ν.
inline Stiffness stiffness(double E, double nu, Plane plane) {
  const double shear = E / (2 * (1 + nu));
  if (plane == Plane::stress) return {E / (1 - nu * nu), nu * E / (1 - nu * nu), shear};
  const double lame = E * nu / ((1 + nu) * (1 - 2 * nu));
  return {lame + 2 * shear, lame, shear};
}

/// From the bulk modulus K and the shear modulus G of the solid [Pa]; in plane stress ε_zz is that of no σ_zz.
inline Stiffness stiffness_of_moduli(double K, double G, Plane plane) {
  if (plane == Plane::strain) return {K + 4 * G / 3, K - 2 * G / 3, G};
  const double sum = 3 * K + 4 * G;
  return {4 * G * (3 * K + G) / sum, 2 * G * (3 * K - 2 * G) / sum, G};
}

/// Linear elasticity in the plane.
struct PlaneElastic {
  double youngs_modulus = 0;  ///< E [Pa], > 0
  double poissons_ratio = 0;  ///< ν, −1 < ν < ½
  double density = 0;         ///< ρ [kg/m³], > 0
  Plane plane = Plane::strain;

  Stiffness stiffness() const { return material::stiffness(youngs_modulus, poissons_ratio, plane); }
  double bulk_modulus() const { return youngs_modulus / (3 * (1 - 2 * poissons_ratio)); }  ///< K [Pa]
  double shear_modulus() const { return youngs_modulus / (2 * (1 + poissons_ratio)); }     ///< G [Pa]
  double pressure_wave_speed() const { return std::sqrt(stiffness().normal / density); }   ///< c_d [m/s]
  double shear_wave_speed() const { return std::sqrt(stiffness().shear / density); }       ///< c_s [m/s]
  /// c = √(E/ρ) of eqs. 23a and 26 [m/s].
  double uniaxial_wave_speed() const { return std::sqrt(youngs_modulus / density); }
  /// tr ε of the three-dimensional strain, of (ε_xx + ε_yy).
  double trace_factor() const { return plane == Plane::strain ? 1 : (1 - 2 * poissons_ratio) / (1 - poissons_ratio); }
  /// ε_v of a strain in the plane, the mean normal strain.
  double volumetric(const Tensor& strain) const { return (strain.xx + strain.yy) * trace_factor() / 3; }
};

}  // namespace diptych::material
