// Exact solutions in the plane as objects: parameters with units and validation, evaluation at (x, y, t) and a
// self-test by residual. Small strain, unit thickness, the rectangle 0 ≤ x ≤ width, 0 ≤ y ≤ height.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>

namespace diptych::analytic {

enum class PlaneQuantity { displacement, velocity, stress, concentration };

/// How many components a quantity has: displacement and velocity x, y; stress xx, yy, xy; concentration one.
constexpr std::size_t components(PlaneQuantity quantity) {
  return quantity == PlaneQuantity::concentration ? 1 : quantity == PlaneQuantity::stress ? 3 : 2;
}

/// Where and when a solution is compared with a run.
struct PlaneWindow {
  double width, height;  ///< 0 ≤ x ≤ width, 0 ≤ y ≤ height [m]
  double core;           ///< radius around the origin that is left out [m]
  double from, to;       ///< first and last time [s], > 0
};

class PlaneSolution {
 public:
  virtual ~PlaneSolution() = default;
  virtual std::string name() const = 0;
  /// Whether this solution speaks of the quantity at all.
  virtual bool gives(PlaneQuantity) const = 0;
  /// Components of a quantity at (x, y) in the rectangle and time t ≥ 0; those that it has not are 0. Throws
  /// std::domain_error where the point lies outside or x, y or t is not finite, std::invalid_argument where the
  /// solution does not give the quantity.
  virtual std::array<double, 3> at(PlaneQuantity, double x, double y, double t) const = 0;
  /// Natural size of a quantity, > 0, by which errors are divided. Throws std::invalid_argument where it is not given.
  virtual double scale(PlaneQuantity) const = 0;
  /// The largest violation of the problem that this solution claims to solve, found by its own test: 1 is a wrong
  /// solution, round-off a right one, and what is not finite is not to be trusted. There is no default: a solution
  /// without a test of its own judges nothing.
  virtual double residual(const PlaneWindow&) const = 0;
};

/// Isotropic linear elasticity in the plane, σ = λ (tr ε) 1 + 2μ ε with the trace in the plane.
struct PlaneMedium {
  double lambda, mu, density;  ///< [Pa], [Pa], [kg/m³]; λ of the plane: in plane stress 2λμ/(λ + 2μ)

  double pressure_speed() const;  ///< c_d = √((λ + 2μ)/ρ) [m/s]
  double shear_speed() const;     ///< c_s = √(μ/ρ) [m/s]
};

/// From E > 0 [Pa], −1 < ν < ½ and ρ > 0 [kg/m³]. Throws std::invalid_argument otherwise.
PlaneMedium plane_medium(double youngs_modulus, double poissons_ratio, double density, bool plane_stress);

/// What is asked of a solution, said without one, so that a wrong solution can be told from a right one.
struct PlaneProblem {
  enum class Support {
    free,    ///< no traction
    roller,  ///< no motion across the side, no shear
    driven   ///< moves as it is told
  };
  struct Side {
    Support support = Support::free;
    std::function<std::array<double, 2>(double x, double y, double t)> velocity;  ///< of a driven side [m/s]
  };
  PlaneMedium medium;
  double width, height;  ///< [m]
  Side left, right, bottom, top;
  std::function<std::array<double, 2>(double x, double y)> initial_displacement;  ///< [m]; empty: none
  std::function<std::array<double, 2>(double x, double y)> initial_velocity;      ///< [m/s]; empty: none
  double displacement_scale;                                                      ///< [m], > 0
  double smooth_length;  ///< over which the fields change by their own size [m], > 0
};

/// Largest violations found by a self-test, each divided by the natural scale of its terms, so that 1 is a wrong
/// solution and round-off a right one. A check that found nothing to look at reports infinity, not zero; NaN stays NaN.
struct PlaneResidual {
  double momentum = 0;       ///< ρ ∂v/∂t − ∇·σ
  double constitutive = 0;   ///< σ − λ (tr ε) 1 − 2μ ε
  double compatibility = 0;  ///< v − ∂u/∂t
  double boundary = 0;       ///< supports, tractions and given motion on the four sides
  double initial = 0;        ///< u and v at t = 0
  int points = 0;            ///< points looked at inside

  double worst() const;  ///< the largest of the five; NaN if one is NaN, infinity if no point was looked at
};

/// Checks a solution that gives displacement, velocity and stress against equations of motion, Hooke's law, sides and
/// initial state over 0 < t ≤ t_end [s], by finite differences of sixth order. Throws std::invalid_argument unless
/// t_end is positive and finite.
PlaneResidual self_test(const PlaneSolution&, const PlaneProblem&, double t_end);

}  // namespace diptych::analytic
