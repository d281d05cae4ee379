// Exact solutions as objects: parameters with units and validation, evaluation at (x, t), front positions and a
// self-test by residual. Nothing here knows a solver or a material: an oracle that calls what it judges is no oracle.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace diptych::analytic {

enum class BarQuantity { stress, velocity, displacement };

/// A discontinuity of stress on its way through the bar.
struct Front {
  double position;     ///< [m]
  int direction;       ///< +1 to the right, −1 to the left
  double stress_jump;  ///< stress just behind the front minus stress just ahead of it [Pa]
  double travelled;    ///< length of its path since it entered the bar, reflections included [m]
};

/// Largest violations found by a self-test, each divided by the natural scale of its terms, so that 1 is a wrong
/// solution and round-off a right one. A check that found nothing to look at reports infinity, not zero; NaN stays NaN.
struct Residual {
  double momentum = 0;       ///< ρ ∂v/∂t − ∂σ/∂x away from fronts
  double compatibility = 0;  ///< σ − E ∂u/∂x and v − ∂u/∂t away from fronts
  double jump = 0;      ///< [σ] + ρ U [v] across fronts of velocity U; every front in its place, its jump as listed
  double boundary = 0;  ///< supports and tractions at both ends
  double initial = 0;   ///< u, σ and v at t = 0
  int points = 0;       ///< points looked at away from fronts
  int fronts = 0;       ///< fronts looked at

  double worst() const;  ///< the largest of the five; NaN if one is NaN, infinity if no point was looked at
};

class ExactSolution {
 public:
  virtual ~ExactSolution() = default;
  virtual std::string name() const = 0;
  /// Value at reference coordinate x in [0, L] and time t ≥ 0; on a front the mean of both sides is not promised.
  /// Throws std::domain_error where x lies outside the bar or x or t is not finite.
  virtual double at(BarQuantity, double x, double t) const = 0;
  /// Discontinuities of stress at time t, ascending in position; empty for a smooth solution.
  virtual std::vector<Front> fronts(double t) const = 0;
  /// Natural size of a quantity, > 0, by which errors are divided.
  virtual double scale(BarQuantity) const = 0;
  /// Whether this solution speaks of the quantity at all.
  virtual bool gives(BarQuantity) const { return true; }
  /// The largest violation of the problem that this solution claims to solve, found by its own test over 0 < t ≤ t_end
  /// and longer where that is too short to see all of it: 1 is a wrong solution, round-off a right one, and what is
  /// not finite is not to be trusted. There is no default: a solution without a test of its own judges nothing.
  virtual double residual(double t_end) const = 0;

  /// Bars `left` and `left` + 1 touch over [from, to] [s].
  struct Contact {
    std::size_t left;
    double from, to;
  };
  /// By start, then from left to right; nothing where the solution knows no contact of bars.
  virtual std::optional<std::vector<Contact>> contact_times() const { return {}; }
  /// ∫∫ σ dε_p of all bars up to t [J/m²]; nothing where the solution knows no plastic flow.
  virtual std::optional<double> work_of_flow(double) const { return {}; }
  /// By how much the material next to a struck face is ahead of the face itself [m].
  virtual double strain_of_face(double) const { return 0; }
};

/// What is asked of a solution, said without one, so that a wrong solution can be told from a right one.
struct BarProblem {
  struct End {
    bool fixed;
    std::function<double(double)> traction;  ///< stress at this end at time t [Pa]; not called where fixed
  };
  struct Kink {
    bool right;   ///< enters the bar at the right end, else at the left
    double time;  ///< when [s]
    double jump;  ///< of stress [Pa]; 0 where only a slope changes
  };
  double youngs_modulus, density, length;  ///< [Pa], [kg/m³], [m]
  End left, right;
  std::function<double(double)> initial_velocity;  ///< v(x, 0) [m/s]; u and σ start from zero
  std::vector<Kink> kinks;                         ///< where the fields are not smooth
  double stress_scale;                             ///< [Pa], > 0
  double smooth_length;                            ///< over which smooth parts change by their own size [m], > 0
};

/// Checks a solution against equations of motion, jump conditions, end conditions and initial state over
/// 0 < t ≤ t_end. Throws std::invalid_argument unless t_end is positive and finite.
Residual self_test(const ExactSolution&, const BarProblem&, double t_end);

}  // namespace diptych::analytic
