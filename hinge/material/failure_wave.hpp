// The failure wave of shocked glass (paper, section 4; its reference [11]): a reconstruction, R1.
//
// Certain, from the abstract of [11] (Chen, Feng, Xin & Shen, IJNME 56, 2003): shear-induced dilatancy measures the
// damage one to one, and the deviatoric strain energy of the elastically compressed material becomes volumetric
// potential energy of the comminuted, dilated one. Ours: how much (f ≤ f_max), that the total at fixed strain is kept
// to the last bit of it, the threshold, and that the deviator shrinks along itself. In uniaxial strain the longitudinal
// stress then does not change to first order in f while the lateral one rises, which is what gauges in glass show.
#pragma once

#include <cmath>

#include "hinge/material/plane.hpp"

namespace diptych::material {

/// Plane strain. V_d: volume strain that damage has brought about, ≥ 0. Of the whole solid at the strain at hand
/// (compression positive) p_e = −K tr ε, s_e = −2G dev ε, W = s_e:s_e/(4G); the damaged one has
///   p = K (−tr ε + V_d),   s = √(1 − f) s_e,   f = V_d (2 p_e + K V_d)/(2W) within [0, f_max],
/// so that p²/(2K) + (1 − f) W = p_e²/(2K) + W wherever f is not clipped.
struct FailureWave {
  PlaneElastic elastic;
  double threshold = 0;       ///< equivalent stress of the whole solid above which damage may spread [Pa]
  double most_converted = 1;  ///< f_max, 0 to 1

  /// Its stress is not the derivative of its energy: where strain changes after damage the law gives or takes. Largest
  /// part of the energy put in that a run may see given; the most that was seen is stated with the gates on it.
  static constexpr double gives_back = 0.25;

  double pressure(const Tensor& strain) const { return -elastic.bulk_modulus() * (strain.xx + strain.yy); }  ///< p_e
  /// W, the shear energy of the whole solid [J/m³]; dev ε has a zz component.
  double shear_energy(const Tensor& strain) const {
    const double third = (strain.xx + strain.yy) / 3, x = strain.xx - third, y = strain.yy - third;
    return elastic.stiffness().shear * (x * x + y * y + third * third + 2 * (strain.xy * strain.xy));
  }
  /// √(3/2 s_e:s_e) of the whole solid [Pa]: a measure of the strain, so that what has failed does not stop itself.
  double equivalent_stress(const Tensor& strain) const {
    return std::sqrt(6 * elastic.stiffness().shear * shear_energy(strain));
  }
  /// V_d at which f = f_max; 0 where nothing is compressed. The root would be beyond −2 p_e/K there: what has swelled
  /// freely, V_d = −p_e/K, would be let swell to twice as much, and so on without end.
  double ceiling(const Tensor& strain) const {
    const double K = elastic.bulk_modulus(), p = pressure(strain), W = shear_energy(strain);
    if (p <= 0) return 0 * W;  // NaN stays it
    return (std::sqrt(p * p + 2 * K * most_converted * W) - p) / K;
  }
  /// The ceiling where damage may spread, and 0 where the shear is below the threshold, ahead of the shock; NaN of NaN.
  double open_ceiling(const Tensor& strain) const {
    return equivalent_stress(strain) <= threshold ? 0 : ceiling(strain);
  }
  /// f, the part of the shear energy that has been converted.
  double converted(const Tensor& strain, double dilatancy) const {
    if (dilatancy == 0) return 0;
    const double raised = dilatancy * (2 * pressure(strain) + elastic.bulk_modulus() * dilatancy);
    const double f = raised / (2 * shear_energy(strain));
    return f > most_converted ? most_converted : f < 0 ? 0 : f;  // this order keeps NaN
  }
  /// Tension positive; with no dilatancy to the bit the whole solid's.
  Tensor stress(const Tensor& strain, double dilatancy) const {
    if (dilatancy == 0) return elastic.stiffness().stress(strain);
    const double kept = 2 * elastic.stiffness().shear * std::sqrt(1 - converted(strain, dilatancy));
    const double third = (strain.xx + strain.yy) / 3;
    const double mean = elastic.bulk_modulus() * (3 * third - dilatancy);
    return {mean + kept * (strain.xx - third), mean + kept * (strain.yy - third), kept * strain.xy};
  }
  /// Largest dσ_xx/dε_xx at fixed V_d in uniaxial strain, over the whole solid's: the limit of the time step falls by
  /// its square root. With r = V_d/ε and a = 3K/(4G), f = a (2r + r²) and
  ///   dσ_xx/dε_xx = K + (4/3) G [√(1 − f) + a (r + r²)/√(1 − f)],
  /// which rises with f. f is taken no further than 0.9: the tangent is infinite at f = 1, which only a layer that
  /// vanishes comes near.
  double stiffening() const {
    const double a = 0.75 * elastic.bulk_modulus() / elastic.stiffness().shear;
    const double f = most_converted > 0.9 ? 0.9 : most_converted;  // this order keeps NaN
    const double r = std::sqrt(1 + f / a) - 1, kept = std::sqrt(1 - f);
    return (a + (kept + a * (r + r * r) / kept)) / (a + 1);
  }
  /// p²/(2K) + (1 − f) W [J/m³].
  double stored(const Tensor& strain, double dilatancy) const {
    const double K = elastic.bulk_modulus(), p = pressure(strain) + K * dilatancy;
    return p * p / (2 * K) + (1 - converted(strain, dilatancy)) * shear_energy(strain);
  }
};

}  // namespace diptych::material
