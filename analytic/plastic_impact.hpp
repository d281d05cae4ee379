// Two equal bars of an elastic, perfectly plastic material collide.
#pragma once

#include <vector>

#include "analytic/exact.hpp"

namespace diptych::analytic {

/// Left bar 0 ≤ x ≤ L, right bar L + gap ≤ x ≤ 2L + gap, both stress-free and in rigid motion until they meet. Seen by
/// an observer who moves with the centre of mass, each strikes a rigid wall with V, half the closing speed.
///
/// The limit c_p → 0 of linear hardening, c_p the speed of plastic fronts: these then stand where they start, in the
/// struck faces, and whatever travels is elastic, at ±c. With v towards the wall, v − σ/(ρc) arrives at a face as a,
/// unchanged for 2L/c at a time, and the face answers
///   0 < a ≤ Y/(ρc)   v = 0, σ = −ρca        elastic contact; −a comes back from the free end
///   a > Y/(ρc)       σ = −Y, v = a − Y/(ρc)  the face flows; a − 2Y/(ρc) comes back
///   a ≤ 0            σ = 0, v = a            the wall would have to pull: release
/// until release. Then the whole bar is free of stress and moves as a rigid one: nothing is left ringing. In closed
/// form, with V̂ = ρcV/Y and n = ⌈V̂/2⌉: release 2nL/c after contact began, rebound V̂ − 2(n−1) if that is ≤ 1, else
/// 2n − V̂, in units of Y/(ρc).
///
/// While it flows, the face stands still at the wall but the material next to it does not: what arrives piles up as a
/// delta of plastic strain in the face, at the rate v. Stress, velocity and displacement at x = L and x = L + gap are
/// those next to the face, so the displacement there is ahead of the face's by plastic_strain(t). Strains are small.
class PlasticImpact final : public ExactSolution {
 public:
  struct Parameters {
    double youngs_modulus;                 ///< E [Pa], > 0
    double density;                        ///< ρ [kg/m³], > 0
    double yield_stress;                   ///< Y [Pa], > 0
    double length;                         ///< L, of each bar [m], > 0
    double gap;                            ///< between them at t = 0 [m], ≥ 0
    double left_velocity, right_velocity;  ///< [m/s], left > right
  };
  /// Throws std::invalid_argument where a parameter is out of range, or where V̂ > 1e4, for which small strains are no
  /// longer worth a solution.
  explicit PlasticImpact(Parameters);

  std::string name() const override { return "plastic-impact"; }
  /// x is the coordinate at t = 0, when displacements are zero. Throws std::domain_error in the gap and outside, and
  /// where t is not finite. Where the gap is 0, x = L is the face of the left bar.
  double at(BarQuantity, double x, double t) const override;
  /// One in each bar while they touch, none else. travelled counts from its latest start at the face.
  std::vector<Front> fronts(double t) const override;
  /// Stress: the largest |σ|, Y or ρcV if that is less; velocity: V; displacement: VL/c.
  double scale(BarQuantity) const override;

  double residual(double t_end) const override;
  std::optional<std::vector<Contact>> contact_times() const override {
    return std::vector<Contact>{{0, contact_begin(), release_time()}};
  }
  std::optional<double> work_of_flow(double t) const override { return plastic_work(t); }
  double strain_of_face(double t) const override { return plastic_strain(t); }

  double wave_speed() const { return c_; }
  double contact_begin() const;  ///< gap/(2V) [s]
  /// When the bars part [s]. As the force ceases, or not, 2L/c earlier where V̂ is an even number, round-off then
  /// decides between two times, with fields that differ by as little.
  double release_time() const;
  /// Speed with which each bar leaves the centre of mass, 0 ≤ r ≤ min(V, Y/(ρc)) [m/s].
  double rebound_velocity() const { return -arriving_.back(); }
  double plastic_strain(double t) const;  ///< ∫|ε_p|dx over one bar: the delta in its face [m]
  double plastic_work(double t) const;    ///< of both bars, 2Y times plastic_strain, per cross-section [J/m²]
  const Parameters& parameters() const { return p_; }

 private:
  double leaving(double since_contact) const;
  double leaving_integral(double since_contact) const;

  Parameters p_;
  double c_, speed_, yield_speed_, period_;  ///< c, V, Y/(ρc), 2L/c
  std::vector<double> arriving_;             ///< a, every 2L/c from the beginning of contact; the last is at release
};

/// Checks any solution against what these parameters pose, over 0 < t ≤ t_end: equations of motion in both bars, jumps
/// on the characteristics that leave the faces at multiples of 2L/c after contact began, free outer ends, equal forces
/// on both faces, and there (under `boundary`) one of: no force before contact; then rest with 0 ≥ σ ≥ −Y, flow towards
/// the wall with σ = −Y, or parting with σ = 0. These determine the solution. Throws std::invalid_argument unless t_end
/// is positive and finite.
Residual self_test(const ExactSolution&, const PlasticImpact::Parameters&, double t_end);

Residual self_test(const PlasticImpact&, double t_end);

}  // namespace diptych::analytic
