// A plate strikes one of the same material: uniaxial strain, d'Alembert's solution between two free faces.
#pragma once

#include <vector>

#include "analytic/exact.hpp"
#include "analytic/plane_exact.hpp"

namespace diptych::analytic {

/// The strip 0 ≤ x ≤ width, its ends free, on rollers above and below. At t = 0 what is left of x = face, the flyer,
/// moves to the right at v, what is right of it, the target, rests; they are one from then on, also in tension. With g
/// the initial velocity, continued evenly beyond the ends, and c = c_d,
///   v_x = (g(x+ct) + g(x−ct))/2,   σ_xx = ρc (g(x+ct) − g(x−ct))/2,   σ_yy = λ/(λ+2μ) σ_xx,   u_x = ∫ v_x dt.
class PlateImpact final : public PlaneSolution {
 public:
  struct Parameters {
    PlaneMedium medium;
    double width, height;  ///< [m], > 0
    double face;           ///< [m], > 0 and < width
    double velocity;       ///< v [m/s], > 0
  };
  /// Throws std::invalid_argument where a parameter is out of range.
  explicit PlateImpact(const Parameters&);

  std::string name() const override { return "plate-impact"; }
  bool gives(PlaneQuantity quantity) const override { return quantity != PlaneQuantity::concentration; }
  /// On a front the mean of both sides.
  std::array<double, 3> at(PlaneQuantity, double x, double y, double t) const override;
  /// Stress |plateau|, velocity v, displacement v·face/c_d (what comes from the flyer's motion as a whole grows on).
  double scale(PlaneQuantity) const override;

  double plateau() const;        ///< σ_xx behind the first front, −½ρ c_d v [Pa]
  double lateral_ratio() const;  ///< σ_yy/σ_xx = λ/(λ+2μ); in plane strain ν/(1−ν)
  /// Of the first front, |x − face|/c_d [s]. This and release throw std::domain_error outside the strip.
  double arrival(double x) const;
  /// When the plateau ends at x, with what the nearer free end has sent back [s]: from the flyer's (face + x)/c_d or
  /// from the target's (2 width − face − x)/c_d, the lesser. At an end that is its arrival: it has no plateau.
  double release(double x) const;
  /// The two fronts, ascending in position.
  std::vector<Front> fronts(double t) const;
  double residual(const PlaneWindow&) const override;
  const Parameters& parameters() const { return p_; }

 private:
  void inside(double x, double t) const;
  double initial_velocity(double x, double travelled) const;
  double initial_velocity_integral(double x) const;

  Parameters p_;
  double c_;
};

/// Largest violations found by a self-test, each divided by the natural scale of its terms, so that 1 is a wrong
/// solution and round-off a right one. A check that found nothing to look at reports infinity, not zero; NaN stays NaN.
struct ImpactResidual {
  double motion = 0;  ///< ρ ∂v/∂t − ∂σ/∂x, σ against Hooke's law and v − ∂u/∂t, away from fronts; and nothing along y
  double jump = 0;      ///< [σ] + ρ U [v] across fronts of velocity U, and |[σ]| − ½ρ c_d v
  double boundary = 0;  ///< σ_xx at both ends
  double initial = 0;   ///< u, v and σ at t = 0
  double momentum = 0;  ///< of the whole strip: it keeps what the flyer had
  double energy = 0;    ///< likewise
  int points = 0;       ///< points looked at away from fronts
  int fronts = 0;       ///< fronts looked at

  double worst() const;  ///< the largest of the six; NaN if one is NaN, infinity if no point was looked at
};

/// Checks any solution against what these parameters pose, over 0 < t ≤ t_end. Throws std::invalid_argument unless
/// t_end is positive and finite.
ImpactResidual self_test(const PlaneSolution&, const PlateImpact::Parameters&, double t_end);

}  // namespace diptych::analytic
