// What a failure wave does at a point: the reconstruction R1 in principal axes, from the energies.
#pragma once

namespace diptych::analytic {

/// Plane strain; stresses are positive in tension, the pressure in compression.
struct FailurePoint {
  double pressure;          ///< p, of the failed solid [Pa]
  double xx, yy, zz, xy;    ///< stress of the failed solid [Pa]
  double converted;         ///< f, the part of the shear energy that has become energy of pressure
  double stored;            ///< energy [J/m³]
  double ceiling;           ///< V_d at which f = f_max; 0 where p_e ≤ 0
  double whole_equivalent;  ///< √(3/2 s:s) of the solid before it failed [Pa]
};

/// Strain ε (tension positive) and dilatancy V_d of an isotropic solid of bulk modulus K and shear modulus G. Before it
/// fails it holds, in principal axes, p_e = −K tr ε and a deviator of energy W = (G/3) Σ (ε_i − ε_j)². Kept in its
/// place while its volume wants to grow by V_d it is pressed to p = p_e + K V_d; what p²/2K has grown by, W pays: f W.
/// The deviator keeps its axes and its ratios, so that what is left of it, s:s = 4G (1 − f) W, gives its size. Once f =
/// f_max (0: it never pays), more dilatancy is not paid for; where the pressure's energy has become less, in tension,
/// f = 0: nothing is taken back. What is not compressed, p_e ≤ 0, has the ceiling 0. Everything in long double. Throws
/// std::invalid_argument unless K and G are positive, the strain finite, V_d finite and ≥ 0 and 0 ≤ f_max ≤ 1.
FailurePoint failure_point(double K, double G, double exx, double eyy, double exy, double V_d, double f_max);

/// Uniaxial compression by ε, of which V_d/ε and every ratio below are independent; f in [0, 1], else
/// std::domain_error. To first order in f the longitudinal stress stays and the lateral one rises by Gε f: what gauges
/// in glass show.
class UniaxialFailure {
 public:
  UniaxialFailure(double K, double G);  ///< [Pa]; throws std::invalid_argument unless positive, and unless σ_y > 0

  double pressure(double f) const;            ///< p/p_e = √(1 + f 4G/3K)
  double longitudinal(double f) const;        ///< σ_x/σ_x,e
  double lateral(double f) const;             ///< σ_y/σ_y,e
  double dilatancy(double f) const;           ///< V_d/ε = p/p_e − 1
  double longitudinal_slope(double f) const;  ///< dσ_x/df per ε [Pa]; 0 at f = 0, −∞ at 1
  double lateral_slope(double f) const;       ///< dσ_y/df per ε [Pa]; G at f = 0, ∞ at 1
  double elastic_ratio() const;               ///< σ_y,e/σ_x,e = (K − 2G/3)/(K + 4G/3)

 private:
  double K_, G_;
};

}  // namespace diptych::analytic
