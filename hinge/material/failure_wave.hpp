// The failure wave of shocked glass (paper, section 4; its reference [11]): a reconstruction, R1.
//
// Certain, from the abstract of [11] (Chen, Feng, Xin & Shen, IJNME 56, 2003): shear-induced dilatancy measures the
// damage one to one, and the deviatoric strain energy of the elastically compressed material becomes volumetric
// potential energy of the comminuted, dilated one. Ours: how much (f ≤ f_max), that the total at fixed strain is kept
// to the last bit of it, the threshold, and that the deviator shrinks along itself. In uniaxial strain the longitudinal
// stress then does not change to first order in f while the lateral one rises, which is what gauges in glass show.
#pragma once

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

  inline Stiffness whole() const;  ///< in plane strain, whatever `elastic` says: no question in loops
  inline double pressure(const Tensor& strain) const;  ///< p_e
  /// W, the shear energy of the whole solid [J/m³]; dev ε has a zz component.
  inline double shear_energy(const Tensor& strain) const;
  /// √(3/2 s_e:s_e) of the whole solid [Pa]: a measure of the strain, so that what has failed does not stop itself.
  inline double equivalent_stress(const Tensor& strain) const;
  /// V_d at which f = f_max; 0 where nothing is compressed. The root would be beyond −2 p_e/K there: what has swelled
  /// freely, V_d = −p_e/K, would be let swell to twice as much, and so on without end.
  inline double ceiling(const Tensor& strain) const;
  /// The ceiling where damage may spread, and 0 where the shear is below the threshold, ahead of the shock; NaN of NaN.
  inline double open_ceiling(const Tensor& strain) const;
  /// f, the part of the shear energy that has been converted.
  inline double converted(const Tensor& strain, double dilatancy) const;
  /// Tension positive; with no dilatancy to the bit the whole solid's.
  inline Tensor stress(const Tensor& strain, double dilatancy) const;
  /// Largest dσ_xx/dε_xx at fixed V_d in uniaxial strain, over the whole solid's: the limit of the time step falls by
  /// its square root. With r = V_d/ε and a = 3K/(4G), f = a (2r + r²) and
  ///   dσ_xx/dε_xx = K + (4/3) G [√(1 − f) + a (r + r²)/√(1 − f)],
  /// which rises with f. f is taken no further than 0.9: the tangent is infinite at f = 1, which only a layer that
  /// vanishes comes near.
  double stiffening() const;
  /// p²/(2K) + (1 − f) W [J/m³].
  inline double stored(const Tensor& strain, double dilatancy) const;
};

}  // namespace diptych::material
