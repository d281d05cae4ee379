// d'Alembert's solution by images for an elastic bar set off from rest by tractions on its ends.
#pragma once

#include <optional>
#include <vector>

#include "analytic/exact.hpp"

namespace diptych::analytic {

/// A traction history f(t) = Σ jump_k H(t − t_k) + slope_k ⟨t − t_k⟩: steps, ramps and rectangular impulses.
/// Positive is tension at either end. The factories throw std::invalid_argument for a duration that is not positive.
struct Traction {
  struct Kink {
    double time;   ///< t_k ≥ 0 [s]
    double jump;   ///< [Pa]
    double slope;  ///< change of slope [Pa/s]
  };
  std::vector<Kink> kinks;

  double value(double t) const;     ///< f(t), right-continuous [Pa]
  double integral(double t) const;  ///< ∫₀ᵗ f dt [Pa s]

  static Traction step(double amplitude, double start = 0);
  static Traction ramp(double amplitude, double rise, double start = 0);  ///< linear over `rise`, then constant
  static Traction impulse(double amplitude, double duration, double start = 0);
};

/// What happens at an end: held, or loaded by a traction (a free end has no kinks).
struct BarEnd {
  bool fixed = false;
  Traction traction;
};

/// Waves in a bar 0 ≤ x ≤ L at rest for t < 0. The traction g of an end travels in as σ = g(t − d/c); a fixed end
/// sends stress back with its sign (velocity reversed), a free end reverses it. Summed over all images with
/// path length d ≤ c t.
class BarWave final : public ExactSolution {
 public:
  struct Parameters {
    double youngs_modulus;  ///< E [Pa], > 0
    double density;         ///< ρ [kg/m³], > 0
    double length;          ///< L [m], > 0
    BarEnd left, right;
  };
  /// Throws std::invalid_argument where a parameter is out of range, a fixed end carries a traction, no end does, or
  /// a traction grows without bound (its slopes do not add up to zero).
  explicit BarWave(Parameters);

  std::string name() const override { return "bar-wave"; }
  double at(BarQuantity, double x, double t) const override;
  std::vector<Front> fronts(double t) const override;
  /// Stress: the largest |f| of either end; velocity: that over ρc; displacement: that times L/E.
  double scale(BarQuantity) const override;
  /// Until every front has been reflected at both ends.
  double residual(double t_end) const override;
  double wave_speed() const;
  const Parameters& parameters() const { return p_; }

 private:
  Parameters p_;
};

/// The equations these parameters pose, for the self-test of any solution of them.
BarProblem problem(const BarWave::Parameters&);

Residual self_test(const BarWave&, double t_end);

}  // namespace diptych::analytic
