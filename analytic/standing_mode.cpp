#include "analytic/standing_mode.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "analytic/parameters.hpp"

namespace diptych::analytic {
namespace {

void require_standing(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(std::string("standing-mode: ") + message);
}

}  // namespace

StandingMode::StandingMode(Parameters p) : p_(p) {
  require_standing(positive(p_.youngs_modulus), "Young's modulus must be > 0");
  require_standing(positive(p_.density), "density must be > 0");
  require_standing(positive(p_.length), "length must be > 0");
  require_standing(p_.mode >= 1, "mode must be >= 1");
  require_standing(std::isfinite(p_.amplitude) && p_.amplitude != 0, "amplitude must be finite and not zero");
}

double StandingMode::wave_speed() const { return std::sqrt(p_.youngs_modulus / p_.density); }

double StandingMode::wave_number() const {
  const double half_waves = p_.left_fixed == p_.right_fixed ? p_.mode : p_.mode - 0.5;
  return half_waves * std::numbers::pi / p_.length;
}

double StandingMode::at(BarQuantity quantity, double x, double t) const {
  if (!(x >= -1e-9 * p_.length && x <= (1 + 1e-9) * p_.length) || !std::isfinite(t))
    throw std::domain_error("standing-mode: x must lie in the bar and t be finite");
  const double k = wave_number(), omega = wave_speed() * k;
  const double shape = p_.left_fixed ? std::sin(k * x) : std::cos(k * x);
  const double slope = p_.left_fixed ? std::cos(k * x) : -std::sin(k * x);  // dφ/d(kx)
  switch (quantity) {
    case BarQuantity::stress: return p_.youngs_modulus * p_.amplitude * k * slope * std::sin(omega * t);
    case BarQuantity::velocity: return p_.amplitude * omega * shape * std::cos(omega * t);
    case BarQuantity::displacement: return p_.amplitude * shape * std::sin(omega * t);
  }
  throw std::invalid_argument("standing-mode: no such quantity");
}

double StandingMode::scale(BarQuantity quantity) const {
  const double amplitude = std::abs(p_.amplitude), k = wave_number();
  switch (quantity) {
    case BarQuantity::stress: return p_.youngs_modulus * amplitude * k;
    case BarQuantity::velocity: return amplitude * wave_speed() * k;
    case BarQuantity::displacement: return amplitude;
  }
  throw std::invalid_argument("standing-mode: no such quantity");
}

BarProblem problem(const StandingMode::Parameters& p) {
  const StandingMode mode(p);
  const double k = mode.wave_number(), peak = p.amplitude * mode.wave_speed() * k;
  const auto free = [](double) { return 0.0; };
  const auto velocity = [=](double x) { return peak * (p.left_fixed ? std::sin(k * x) : std::cos(k * x)); };
  return {p.youngs_modulus,
          p.density,
          p.length,
          {p.left_fixed, free},
          {p.right_fixed, free},
          velocity,
          {},
          mode.scale(BarQuantity::stress),
          1 / k};
}

double StandingMode::residual(double t_end) const { return self_test(*this, t_end).worst(); }

Residual self_test(const StandingMode& mode, double t_end) {
  return self_test(mode, problem(mode.parameters()), t_end);
}

}  // namespace diptych::analytic
