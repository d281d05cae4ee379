// What diffuses into a half line from a face that is held: the similarity solutions behind a failure front.
#pragma once

#include <string>

#include "analytic/plane_exact.hpp"

namespace diptych::analytic {

enum class FrontProfile {
  constant,  ///< d = d₀
  falling,   ///< d = d₀(1 − u)
  rising     ///< d = d₀ u
};

/// ∂u/∂t = ∂/∂x (d ∂u/∂x) for x > 0, u = 0 at t = 0, u = 1 at x = 0 from then on: a function of η = x/√(d₀t).
///
/// Constant d = d₀: u = erfc(η/2). Falling d = d₀(1 − u), which vanishes at the face: with w = 1 − u and the flux
/// q = w w′ it is w′ = q/w, q′ = −(η/2) q/w, w(0) = 0, w(∞) = 1; w ~ √(2q₀η) at the face, so u is steep there and not
/// smooth, but smooth in √η, along which it is integrated. Stretching w by β², η by β and q by β³ makes one solution of
/// another, so it is found from q₀ = 1 and stretched to w(∞) = 1: no shooting. As q q″(w) = −w/2 is Crocco's form of
/// Blasius's f‴ + ½ f f″ = 0, it is u = 1 − f′(z) at η = f(z), and q₀ = f″(0). To 1e-12.
///
/// Rising d = d₀ u, Boussinesq's: u is zero from an edge η_f on, and u = η_f² U(η/η_f) with (U U′)′ + (ξ/2) U′ = 0,
/// integrated from U = s/2 − s²/8 + s³/144 next to the edge, s = 1 − ξ, to U(0) = 1/η_f²: η_f = 1.616125.
///
/// Every level goes as √t; but for rising d none is an edge: u = 1e-3 at η = 4.654 (constant) and 4.291 (falling).
class DiffusionFront {
 public:
  struct Parameters {
    double diffusivity;  ///< d₀ [m²/s], > 0
    FrontProfile profile;
  };
  /// Throws std::invalid_argument where a parameter is out of range.
  explicit DiffusionFront(const Parameters&);

  double value(double x, double t) const;  ///< u; throws std::domain_error unless x, t ≥ 0 and finite
  double level(double u) const;            ///< η at which u is met, 1e-9 ≤ u ≤ 1, else std::domain_error
  double face_flux() const;  ///< −d ∂u/∂x at the face in units of √(d₀/t): 1/√π, falling 0.332057…, rising
                             ///< 0.443748…; ∫u dη is twice that
  double reach(double t, double u) const;    ///< x up to which u is exceeded at time t [m]
  double arrival(double x, double u) const;  ///< t at which u is met at x [s]
  const Parameters& parameters() const { return p_; }

 private:
  Parameters p_;
};

/// The same along x in a plate, times the face's value. As good as u is small at the plate's far side: see reach.
class FaceFront final : public PlaneSolution {
 public:
  struct Parameters {
    double width, height;  ///< [m], > 0
    double diffusivity;    ///< d₀ [m²/s], > 0
    FrontProfile profile;  ///< of u = C/value
    double value;          ///< of C at x = 0, ≠ 0
  };
  explicit FaceFront(const Parameters&);

  std::string name() const override { return "face-front"; }
  bool gives(PlaneQuantity quantity) const override { return quantity == PlaneQuantity::concentration; }
  std::array<double, 3> at(PlaneQuantity, double x, double y, double t) const override;
  double scale(PlaneQuantity) const override;                                  ///< |value|
  double reach(double t, double part) const { return front_.reach(t, part); }  ///< beyond it |C| < part |value| [m]
  /// Of a profile with an edge without the balance, whose differences reach across it: its moment and its face tell.
  double residual(const PlaneWindow&) const override;
  const DiffusionFront& front() const { return front_; }
  const Parameters& parameters() const { return p_; }

 private:
  Parameters p_;
  DiffusionFront front_;
};

/// Largest violations found, each divided by the natural scale of its terms; a check that found nothing to look at
/// reports infinity, NaN stays NaN.
struct FrontResidual {
  double balance = 0;  ///< ∂C/∂t − ∂/∂x (d ∂C/∂x), and ∂C/∂y
  double face = 0;     ///< C at x = 0 against its value, and C at t = 0
  double moment =
      0;  ///< ∫C x dx against d₀ t value, with falling and rising d half of it: what the equation makes of it
  int points = 0;
  double worst() const;
};

/// Checks any solution against what these parameters pose, over t_begin ≤ t ≤ t_end, t_begin > 0 [s]. Of the far side
/// it knows nothing: the front must not have reached it.
FrontResidual self_test(const PlaneSolution&, const FaceFront::Parameters&, double t_begin, double t_end);

}  // namespace diptych::analytic
