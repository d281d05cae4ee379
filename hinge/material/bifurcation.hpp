// Localisation: where the acoustic tensor of the damaged solid's tangent becomes singular (the paper's section 4).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hinge/material/plane.hpp"
#include "hinge/material/tensile_damage.hpp"

namespace diptych::material {

struct Bifurcation {
  double least_ratio = 1;  ///< least det Q(n) / det Q_whole(n) over directions n in the plane; ≤ 0: localisation
  double angle = 0;        ///< of that n from x, in [0, π); 0 where every direction is alike
};

/// ∂C̄/∂C_d [Pa] of the open cracks' `damaged_stiffness`, by the chain rule through eqs. 23b–d. Zero for a part that the
/// model holds fixed: K̄ and Ḡ at their residuals, Ḡ at the whole solid's, ν̄ at zero.
inline Stiffness damaged_stiffness_rate(const TensileDamage& damage, double crack_density) {
  const double nu = damage.damaged_poissons_ratio(crack_density), D = damage.damage(crack_density);
  const double a = 1 + nu, b = 1 - 2 * nu, whole = damage.elastic.bulk_modulus();
  const double nu_rate = damage.alpha() * crack_density >= 1 ? 0 : -damage.elastic.poissons_ratio * damage.alpha();
  // D = (16/9) f(ν̄) C_d with f = (1 − ν̄²)/(1 − 2ν̄), f' = 2 (1 − ν̄ + ν̄²)/(1 − 2ν̄)².
  const double D_rate = 16.0 / 9 * ((1 - nu * nu) / b + crack_density * nu_rate * 2 * (1 - nu + nu * nu) / (b * b));
  const double bulk_rate = 1 - D <= damage.residual_stiffness ? 0 : -D_rate * whole;
  // Ḡ = 3 (1 − D) K (1 − 2ν̄) / (2 (1 + ν̄)), between its bounds.
  const double K = damage.damaged_bulk_modulus(crack_density), G = damage.damaged_shear_modulus(crack_density);
  const double free = 1.5 * (1 - D) * whole * b / a;
  const double G_rate = G == free ? -1.5 * D_rate * whole * b / a - 4.5 * (1 - D) * whole * nu_rate / (a * a) : 0;
  if (damage.elastic.plane == Plane::strain) return {bulk_rate + 4 * G_rate / 3, bulk_rate - 2 * G_rate / 3, G_rate};
  // By the quotient rule of stiffness_of_moduli.
  const double sum = 3 * K + 4 * G, sum_rate = 3 * bulk_rate + 4 * G_rate;
  const double normal = 4 * G * (3 * K + G), normal_rate = 4 * (3 * G * bulk_rate + (3 * K + 2 * G) * G_rate);
  const double cross = 2 * G * (3 * K - 2 * G), cross_rate = 2 * (3 * G * bulk_rate + (3 * K - 4 * G) * G_rate);
  return {(normal_rate - normal / sum * sum_rate) / sum, (cross_rate - cross / sum * sum_rate) / sum, G_rate};
}

/// With the tangent C_tan = C̄ + S ⊗ ∂C_d/∂ε, S = ∂C̄/∂C_d : ε, at a crack density and its rate ∂C_d/∂ε_v: 0 where it
/// does not follow the strain (unloading, or C_d from diffusion). Where the mean strain is negative cracks are closed
/// and do not grow.
///
/// Exact, without a scan over n: ∂C_d/∂ε is g 1, so Q(n) = Q̄(n) + g (S n) ⊗ n, and since Q̄⁻¹ n = n/M̄,
/// det Q(n) = μ̄ (M̄ + g n·S n). Over n it is least on a principal direction of S, which is one of the strain.
inline Bifurcation bifurcation(const TensileDamage& damage, const Tensor& strain, double crack_density,
                               double dcrack_dvolumetric) {
  const Stiffness whole = damage.elastic.stiffness();
  const auto [cracked, closed] = damage.damaged_stiffness(crack_density);
  if (strain.xx + strain.yy < 0) return {closed.shear * closed.normal / (whole.shear * whole.normal), 0};
  const Tensor unit{1, 0, 0};
  const Tensor gS = damaged_stiffness_rate(damage, crack_density).stress(strain) *
                    (dcrack_dvolumetric * damage.volumetric(unit));  // ε_v is linear in ε_xx + ε_yy
  const double half_difference = (gS.xx - gS.yy) / 2;
  const double radius = std::sqrt(half_difference * half_difference + gS.xy * gS.xy);
  const double least = (gS.xx + gS.yy) / 2 - radius;
  Bifurcation result{cracked.shear * (cracked.normal + least) / (whole.shear * whole.normal), 0};
  if (radius > 0) {
    result.angle = std::atan2(-gS.xy, -half_difference) / 2;  // of the lesser principal value
    if (result.angle < 0) result.angle += std::numbers::pi;
    if (result.angle >= std::numbers::pi) result.angle = 0;  // −0 but for round-off
  }
  return result;
}

}  // namespace diptych::material
