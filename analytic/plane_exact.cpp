#include "analytic/plane_exact.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "analytic/parameters.hpp"
#include "analytic/residual.hpp"

namespace diptych::analytic {
namespace {

class PlaneSelfTest {
 public:
  PlaneSelfTest(const PlaneSolution& solution, const PlaneProblem& problem, double t_end)
      : s_(solution), p_(problem), t_end_(t_end) {}

  PlaneResidual run() {
    interior();
    sides();
    initial_state();
    return r_;
  }

 private:
  using BarQuantity = PlaneQuantity;

  double value(BarQuantity q, std::size_t component, double x, double y, double t) const {
    return s_.at(q, x, y, t)[component];
  }
  double in_x(BarQuantity q, std::size_t c, double x, double y, double t) const {
    return derivative([&](double z) { return value(q, c, z, y, t); }, x, d_);
  }
  double in_y(BarQuantity q, std::size_t c, double x, double y, double t) const {
    return derivative([&](double z) { return value(q, c, x, z, t); }, y, d_);
  }
  double in_time(BarQuantity q, std::size_t c, double x, double y, double t) const {
    return derivative([&](double z) { return value(q, c, x, y, z); }, t, tau_);
  }

  void interior() {
    const double lambda = p_.medium.lambda, mu = p_.medium.mu, rho = p_.medium.density;
    for (int i = 1; i <= 2000; ++i) {
      const double x = p_.width * std::fmod(i * 0.8191725133961645, 1);  // an additive sequence: even coverage
      const double y = p_.height * std::fmod(i * 0.6710436067037893, 1);
      const double t = t_end_ * std::fmod(i * 0.5497004779019703, 1);
      if (x < 3 * d_ || x > p_.width - 3 * d_ || y < 3 * d_ || y > p_.height - 3 * d_ || t < 3 * tau_) continue;
      const double per_force = p_.smooth_length / stress_scale_;
      note(r_.momentum, (rho * in_time(BarQuantity::velocity, 0, x, y, t) - in_x(BarQuantity::stress, 0, x, y, t) -
                         in_y(BarQuantity::stress, 2, x, y, t)) *
                            per_force);
      note(r_.momentum, (rho * in_time(BarQuantity::velocity, 1, x, y, t) - in_x(BarQuantity::stress, 2, x, y, t) -
                         in_y(BarQuantity::stress, 1, x, y, t)) *
                            per_force);
      const double xx = in_x(BarQuantity::displacement, 0, x, y, t), yy = in_y(BarQuantity::displacement, 1, x, y, t);
      const double shear = in_y(BarQuantity::displacement, 0, x, y, t) + in_x(BarQuantity::displacement, 1, x, y, t);
      const auto stress = s_.at(BarQuantity::stress, x, y, t);
      note(r_.constitutive, (stress[0] - lambda * (xx + yy) - 2 * mu * xx) / stress_scale_);
      note(r_.constitutive, (stress[1] - lambda * (xx + yy) - 2 * mu * yy) / stress_scale_);
      note(r_.constitutive, (stress[2] - mu * shear) / stress_scale_);
      for (const std::size_t c : {0UL, 1UL}) {
        note(r_.compatibility,
             (value(BarQuantity::velocity, c, x, y, t) - in_time(BarQuantity::displacement, c, x, y, t)) /
                 velocity_scale_);
      }
      ++r_.points;
    }
    if (r_.points == 0) r_.momentum = r_.constitutive = r_.compatibility = infinity;
  }

  /// `normal`: the component across the side, which is its direction too.
  void side(const PlaneProblem::Side& held, std::size_t normal, double x, double y, double t) {
    const auto u = s_.at(BarQuantity::displacement, x, y, t), v = s_.at(BarQuantity::velocity, x, y, t);
    const auto stress = s_.at(BarQuantity::stress, x, y, t);
    switch (held.support) {
      case PlaneProblem::Support::free:
        note(r_.boundary, stress[normal] / stress_scale_);
        note(r_.boundary, stress[2] / stress_scale_);
        return;
      case PlaneProblem::Support::roller:
        note(r_.boundary, u[normal] / p_.displacement_scale);
        note(r_.boundary, v[normal] / velocity_scale_);
        note(r_.boundary, stress[2] / stress_scale_);
        return;
      case PlaneProblem::Support::driven:
        const auto given = held.velocity(x, y, t);
        for (const std::size_t c : {0UL, 1UL}) note(r_.boundary, (v[c] - given[c]) / velocity_scale_);
        return;
    }
  }

  void sides() {
    for (int i = 1; i <= 300; ++i) {
      const double along = std::fmod(i * 0.7548776662466927, 1), t = t_end_ * std::fmod(i * 0.5698402909980532, 1);
      side(p_.left, 0, 0, p_.height * along, t);
      side(p_.right, 0, p_.width, p_.height * along, t);
      side(p_.bottom, 1, p_.width * along, 0, t);
      side(p_.top, 1, p_.width * along, p_.height, t);
    }
  }

  void initial_state() {
    for (int i = 1; i <= 200; ++i) {
      const double x = p_.width * std::fmod(i * 0.7548776662466927, 1);
      const double y = p_.height * std::fmod(i * 0.5698402909980532, 1);
      const auto u = s_.at(BarQuantity::displacement, x, y, 0), v = s_.at(BarQuantity::velocity, x, y, 0);
      const auto u0 = p_.initial_displacement ? p_.initial_displacement(x, y) : std::array<double, 2>{};
      const auto v0 = p_.initial_velocity ? p_.initial_velocity(x, y) : std::array<double, 2>{};
      for (const std::size_t c : {0UL, 1UL}) {
        note(r_.initial, (u[c] - u0[c]) / p_.displacement_scale);
        note(r_.initial, (v[c] - v0[c]) / velocity_scale_);
      }
    }
  }

  const PlaneSolution& s_;
  const PlaneProblem& p_;
  const double t_end_;
  const double d_ = 5e-3 * p_.smooth_length, tau_ = d_ / p_.medium.pressure_speed();
  const double stress_scale_ = (p_.medium.lambda + 2 * p_.medium.mu) * p_.displacement_scale / p_.smooth_length;
  const double velocity_scale_ = p_.medium.pressure_speed() * p_.displacement_scale / p_.smooth_length;
  PlaneResidual r_;
};

}  // namespace

double PlaneMedium::pressure_speed() const { return std::sqrt((lambda + 2 * mu) / density); }
double PlaneMedium::shear_speed() const { return std::sqrt(mu / density); }

PlaneMedium plane_medium(double E, double nu, double density, bool plane_stress) {
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  if (!positive(E)) throw std::invalid_argument("plane medium: Young's modulus must be > 0");
  if (!(nu > -1 && nu < 0.5)) throw std::invalid_argument("plane medium: Poisson's ratio must lie in (-1, 1/2)");
  if (!positive(density)) throw std::invalid_argument("plane medium: density must be > 0");
  const double mu = E / (2 * (1 + nu));
  // 2λμ/(λ + 2μ) of the λ of plane strain
  return {plane_stress ? E * nu / (1 - nu * nu) : E * nu / ((1 + nu) * (1 - 2 * nu)), mu, density};
}

double PlaneResidual::worst() const {
  if (points == 0) return infinity;
  double worst = 0;
  for (const double r : {momentum, constitutive, compatibility, boundary, initial}) note(worst, r);
  return worst;
}

PlaneResidual self_test(const PlaneSolution& solution, const PlaneProblem& problem, double t_end) {
  if (!(t_end > 0) || !std::isfinite(t_end)) throw std::invalid_argument("self_test: t_end must be > 0 and finite");
  return PlaneSelfTest(solution, problem, t_end).run();
}

}  // namespace diptych::analytic
