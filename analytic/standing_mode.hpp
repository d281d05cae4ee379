// A standing mode of an elastic bar, set off by its velocity.
#pragma once

#include "analytic/exact.hpp"

namespace diptych::analytic {

/// u = A φ(kx) sin(ckt) with φ = sin for a fixed left end and cos for a free one; v(x,0) = A c k φ(kx), σ(x,0) = 0.
/// k L = (m − ½)π for fixed–free and free–fixed bars, mπ for fixed–fixed and free–free ones.
class StandingMode final : public ExactSolution {
 public:
  struct Parameters {
    double youngs_modulus, density, length;  ///< [Pa], [kg/m³], [m], all > 0
    bool left_fixed, right_fixed;
    int mode;          ///< m ≥ 1
    double amplitude;  ///< A [m], ≠ 0
  };
  explicit StandingMode(Parameters);  ///< throws std::invalid_argument where a parameter is out of range

  std::string name() const override { return "standing-mode"; }
  double at(BarQuantity, double x, double t) const override;
  std::vector<Front> fronts(double) const override { return {}; }
  double scale(BarQuantity) const override;  ///< the amplitude of the quantity
  double residual(double t_end) const override;
  double wave_number() const;
  double wave_speed() const;
  const Parameters& parameters() const { return p_; }

 private:
  Parameters p_;
};

/// The equations these parameters pose, for the self-test of any solution of them.
BarProblem problem(const StandingMode::Parameters&);

Residual self_test(const StandingMode&, double t_end);

}  // namespace diptych::analytic
