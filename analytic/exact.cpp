#include "analytic/exact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analytic/parameters.hpp"
#include "analytic/residual.hpp"

namespace diptych::analytic {
namespace {

struct Place {
  double position;
  int direction;
};

/// Where a kink is at time t. Its path is folded at the ends; images are how the solution was built, so not used here.
Place place(const BarProblem::Kink& kink, double length, double speed, double t) {
  const double path = std::max(0.0, speed * (t - kink.time));
  const double leg = std::floor(path / length);
  const bool returning = std::fmod(leg, 2) == 1;
  const double along = path - leg * length;
  const double from_entry = returning ? length - along : along;
  return {kink.right ? length - from_entry : from_entry, kink.right == returning ? +1 : -1};
}

class BarSelfTest {
 public:
  BarSelfTest(const ExactSolution& solution, const BarProblem& problem, double t_end)
      : s_(solution), p_(problem), t_end_(t_end), c_(std::sqrt(p_.youngs_modulus / p_.density)) {}

  Residual run() {
    interior();
    front_conditions();
    ends();
    initial_state();
    return r_;
  }

 private:
  double stress(double x, double t) const { return s_.at(BarQuantity::stress, x, t); }
  double velocity(double x, double t) const { return s_.at(BarQuantity::velocity, x, t); }
  double displacement(double x, double t) const { return s_.at(BarQuantity::displacement, x, t); }

  /// Kinks within `reach` of x at time t. One about to enter within reach / c counts as standing at its end.
  int kinks_near(double x, double t, double reach) const {
    return static_cast<int>(std::count_if(p_.kinks.begin(), p_.kinks.end(), [&](const BarProblem::Kink& kink) {
      return c_ * (t - kink.time) > -reach && std::abs(place(kink, p_.length, c_, t).position - x) < reach;
    }));
  }

  void interior() {
    const double d = 2e-3 * std::min(p_.smooth_length, p_.length), reach = 4 * d;
    for (int i = 1; i <= 4000; ++i) {
      const double x = p_.length * std::fmod(i * 0.7548776662466927, 1);  // an additive sequence: even coverage
      const double t = t_end_ * std::fmod(i * 0.5698402909980532, 1);
      if (x < reach || x > p_.length - reach || c_ * t < reach || kinks_near(x, t, reach) > 0) continue;
      const double tau = d / c_;
      const auto in_space = [&](auto field) { return derivative([&](double y) { return field(y, t); }, x, d); };
      const auto in_time = [&](auto field) { return derivative([&](double y) { return field(x, y); }, t, tau); };
      const auto sigma = [this](double y, double z) { return stress(y, z); };
      const auto v = [this](double y, double z) { return velocity(y, z); };
      const auto u = [this](double y, double z) { return displacement(y, z); };
      note(r_.momentum, (p_.density * in_time(v) - in_space(sigma)) * p_.smooth_length / p_.stress_scale);
      note(r_.compatibility, (stress(x, t) - p_.youngs_modulus * in_space(u)) / p_.stress_scale);
      note(r_.compatibility, (velocity(x, t) - in_time(u)) / velocity_scale_);
      ++r_.points;
    }
    if (r_.points == 0) r_.momentum = r_.compatibility = infinity;
  }

  void front_conditions() {
    const double eps = 1e-4 * p_.length;
    bool expected = false;
    for (int i = 1; i <= 500; ++i) {
      const double t = t_end_ * std::fmod(i * 0.6180339887498949, 1);
      auto fronts = s_.fronts(t);
      for (const auto& kink : p_.kinks) {
        if (kink.jump == 0 || c_ * (t - kink.time) < 4 * eps) continue;
        const auto [x, direction] = place(kink, p_.length, c_, t);
        if (x < 4 * eps || x > p_.length - 4 * eps) continue;
        expected = true;
        const double round_off = 1e-12 * (p_.length + c_ * t);
        const auto found = std::find_if(fronts.begin(), fronts.end(), [&, at = x, to = direction](const Front& f) {
          return std::abs(f.position - at) <= round_off && f.direction == to &&
                 std::abs(f.travelled - c_ * (t - kink.time)) <= round_off;
        });
        if (found == fronts.end()) {
          r_.jump = infinity;
          continue;
        }
        if (kinks_near(x, t, 5 * eps) == 1) one_front(*found, t, eps);
        fronts.erase(found);
      }
      for (const auto& f : fronts)  // what is left belongs to no kink, unless near an end, where none was sought
        if (f.position > 5 * eps && f.position < p_.length - 5 * eps && f.travelled > 5 * eps) r_.jump = infinity;
    }
    if (expected && r_.fronts == 0) r_.jump = infinity;
  }

  void one_front(const Front& f, double t, double eps) {
    const auto limit = [&](auto field, int side) {  // extrapolated: the fields beside a front are linear
      return 2 * field(f.position + side * eps, t) - field(f.position + 2 * side * eps, t);
    };
    const auto jump_of = [&](auto field) { return limit(field, -f.direction) - limit(field, f.direction); };
    const double sigma = jump_of([this](double x, double z) { return stress(x, z); });
    const double v = jump_of([this](double x, double z) { return velocity(x, z); });
    note(r_.jump, (sigma + p_.density * f.direction * c_ * v) / p_.stress_scale);
    note(r_.jump, (sigma - f.stress_jump) / p_.stress_scale);
    ++r_.fronts;
  }

  void ends() {
    int looked_at = 0;
    for (int i = 1; i <= 500; ++i) {
      const double t = t_end_ * std::fmod(i * 0.6180339887498949, 1);
      for (const bool right : {false, true}) {
        const double x = right ? p_.length : 0;
        const auto& end = right ? p_.right : p_.left;
        if (kinks_near(x, t, 1e-9 * (p_.length + c_ * t)) > 0) continue;
        if (end.fixed) {
          note(r_.boundary, displacement(x, t) / displacement_scale_);
          note(r_.boundary, velocity(x, t) / velocity_scale_);
        } else {
          note(r_.boundary, (stress(x, t) - end.traction(t)) / p_.stress_scale);
        }
        ++looked_at;
      }
    }
    if (looked_at == 0) r_.boundary = infinity;
  }

  void initial_state() {
    for (int i = 1; i < 200; ++i) {
      const double x = p_.length * i / 200;
      note(r_.initial, displacement(x, 0) / displacement_scale_);
      note(r_.initial, stress(x, 0) / p_.stress_scale);
      note(r_.initial, (velocity(x, 0) - p_.initial_velocity(x)) / velocity_scale_);
    }
  }

  const ExactSolution& s_;
  const BarProblem& p_;
  const double t_end_, c_;
  const double velocity_scale_ = p_.stress_scale / (p_.density * c_);
  const double displacement_scale_ = p_.stress_scale * p_.smooth_length / p_.youngs_modulus;
  Residual r_;
};

}  // namespace

double Residual::worst() const {
  if (points == 0) return infinity;
  double worst = 0;
  for (const double r : {momentum, compatibility, jump, boundary, initial}) note(worst, r);
  return worst;
}

Residual self_test(const ExactSolution& solution, const BarProblem& problem, double t_end) {
  if (!(t_end > 0) || !std::isfinite(t_end)) throw std::invalid_argument("self_test: t_end must be > 0 and finite");
  return BarSelfTest(solution, problem, t_end).run();
}

}  // namespace diptych::analytic
