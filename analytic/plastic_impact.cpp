#include "analytic/plastic_impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "analytic/parameters.hpp"
#include "analytic/residual.hpp"

namespace diptych::analytic {
namespace {

void require_plastic(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(std::string("plastic-impact: ") + message);
}

}  // namespace

PlasticImpact::PlasticImpact(Parameters p) : p_(p) {
  require_plastic(positive(p_.youngs_modulus), "Young's modulus must be > 0");
  require_plastic(positive(p_.density), "density must be > 0");
  require_plastic(positive(p_.yield_stress), "yield stress must be > 0");
  require_plastic(positive(p_.length), "length must be > 0");
  require_plastic(std::isfinite(p_.gap) && p_.gap >= 0, "the gap must be >= 0");
  require_plastic(std::isfinite(p_.left_velocity) && std::isfinite(p_.right_velocity), "velocities must be finite");
  require_plastic(p_.left_velocity > p_.right_velocity,
                  "the left velocity must exceed the right one, or the bars never meet");
  c_ = std::sqrt(p_.youngs_modulus / p_.density);
  speed_ = (p_.left_velocity - p_.right_velocity) / 2;
  yield_speed_ = p_.yield_stress / (p_.density * c_);
  period_ = 2 * p_.length / c_;
  require_plastic(speed_ <= 1e4 * yield_speed_,
                  "the impact is more than 1e4 times as fast as the one that just yields");
  double a = speed_;
  for (; a > 0; a = a > yield_speed_ ? a - 2 * yield_speed_ : -a) arriving_.push_back(a);
  arriving_.push_back(a);
}

double PlasticImpact::contact_begin() const { return p_.gap / (2 * speed_); }

double PlasticImpact::release_time() const {
  return contact_begin() + static_cast<double>(arriving_.size() - 1) * period_;
}

/// v + σ/(ρc) on leaving the face, which is what arrives there one period later.
double PlasticImpact::leaving(double since_contact) const {
  if (since_contact < 0) return speed_;
  const double last = static_cast<double>(arriving_.size() - 1);
  return arriving_[static_cast<std::size_t>(std::min(std::floor(since_contact / period_) + 1, last))];
}

double PlasticImpact::leaving_integral(double since_contact) const {
  if (since_contact < 0) return speed_ * since_contact;
  double sum = 0, rest = since_contact;
  std::size_t k = 1;
  for (; k + 1 < arriving_.size() && rest > period_; ++k, rest -= period_) sum += arriving_[k] * period_;
  return sum + arriving_[k] * rest;
}

double PlasticImpact::at(BarQuantity quantity, double x, double t) const {
  const double length = p_.length, slack = 1e-9 * length, right_begin = length + p_.gap;
  const bool left = x <= length + std::min(slack, p_.gap / 2);
  const double depth = left ? length - x : x - right_begin;  // below the face
  if (!(depth >= -slack && depth <= length + slack) || !std::isfinite(t))
    throw std::domain_error("plastic-impact: x must lie in one of the bars and t be finite");
  // Both waves left the face: one straight to here, one by way of the free end.
  const double since = t - contact_begin(), direct = since - depth / c_, reflected = direct + 2 * depth / c_ - period_;
  const double centre = (p_.left_velocity + p_.right_velocity) / 2, towards = left ? 1 : -1;
  switch (quantity) {
    case BarQuantity::stress: return p_.density * c_ * (leaving(direct) - leaving(reflected)) / 2;
    case BarQuantity::velocity: return centre + towards * (leaving(direct) + leaving(reflected)) / 2;
    case BarQuantity::displacement: {
      const double covered = speed_ * (contact_begin() + period_ / 2);  // so that it is Vt before contact
      return centre * t + towards * (covered + (leaving_integral(direct) + leaving_integral(reflected)) / 2);
    }
  }
  throw std::invalid_argument("plastic-impact: no such quantity");
}

std::vector<Front> PlasticImpact::fronts(double t) const {
  const double since = t - contact_begin();
  if (!(since > 0) || !(t < release_time())) return {};
  const double periods = std::floor(since / period_);
  const auto k = static_cast<std::size_t>(periods);
  if (k + 1 >= arriving_.size()) return {};
  const double path = c_ * (since - periods * period_);
  const bool inward = path > p_.length;  // on its way back to the face
  const double depth = inward ? 2 * p_.length - path : path;
  if (!(depth > 0 && depth < p_.length)) return {};
  const double stress = p_.density * c_ * (arriving_[k + 1] - arriving_[k]) / 2;
  const double jump = inward ? -stress : stress;
  return {{p_.length - depth, inward ? +1 : -1, jump, path},
          {p_.length + p_.gap + depth, inward ? -1 : +1, jump, path}};
}

double PlasticImpact::scale(BarQuantity quantity) const {
  switch (quantity) {
    case BarQuantity::stress: return std::min(p_.yield_stress, p_.density * c_ * speed_);
    case BarQuantity::velocity: return speed_;
    case BarQuantity::displacement: return speed_ * p_.length / c_;
  }
  throw std::invalid_argument("plastic-impact: no such quantity");
}

double PlasticImpact::plastic_strain(double t) const {
  if (!std::isfinite(t)) throw std::domain_error("plastic-impact: t must be finite");
  double sum = 0, rest = t - contact_begin();
  for (std::size_t k = 0; k + 1 < arriving_.size() && rest > 0; ++k, rest -= period_)
    sum += std::max(0.0, arriving_[k] - yield_speed_) * std::min(rest, period_);
  return sum;
}

double PlasticImpact::plastic_work(double t) const { return 2 * p_.yield_stress * plastic_strain(t); }

namespace {

/// Knows the parameters only, not the recurrence: only where contact begins, and that nothing but a characteristic that
/// left the faces a whole number of periods later can be a front.
class PlasticSelfTest {
 public:
  PlasticSelfTest(const ExactSolution& solution, const PlasticImpact::Parameters& parameters, double t_end)
      : s_(solution), p_(parameters), t_end_(t_end) {}

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

  double place(bool left, double depth) const { return left ? p_.length - depth : p_.length + p_.gap + depth; }

  /// What the characteristic has travelled since it last left the face; negative before contact.
  double path(double t) const {
    const double since = c_ * (t - begin_);
    return since < 0 ? since : std::fmod(since, 2 * p_.length);
  }

  double depth_of(double path) const { return path > p_.length ? 2 * p_.length - path : path; }

  void interior() {
    const double d = 1e-3 * p_.length, tau = d / c_, reach = 4 * d;
    for (int i = 1; i <= 4000; ++i) {
      const double depth = p_.length * std::fmod(i * 0.7548776662466927, 1);  // an additive sequence: even coverage
      const double t = t_end_ * std::fmod(i * 0.5698402909980532, 1), on = path(t);
      if (std::min({depth, p_.length - depth, c_ * t}) < reach || std::abs(std::abs(depth_of(on)) - depth) < reach)
        continue;
      const double x = place(i % 2 == 0, depth);
      const auto slope = [](double ahead, double behind, double step) { return (ahead - behind) / (2 * step); };
      const double in_time = slope(velocity(x, t + tau), velocity(x, t - tau), tau);
      const double in_space = slope(stress(x + d, t), stress(x - d, t), d);
      const double strain = slope(displacement(x + d, t), displacement(x - d, t), d);
      const double rate = slope(displacement(x, t + tau), displacement(x, t - tau), tau);
      note(r_.momentum, (p_.density * in_time - in_space) * p_.length / stress_scale_);
      note(r_.compatibility, (stress(x, t) - p_.youngs_modulus * strain) / stress_scale_);
      note(r_.compatibility, (velocity(x, t) - rate) / speed_);
      ++r_.points;
    }
    if (r_.points == 0) r_.momentum = r_.compatibility = infinity;
  }

  void front_conditions() {
    const double eps = 1e-4 * p_.length;
    bool expected = false;
    for (int i = 1; i <= 500; ++i) {
      const double t = t_end_ * std::fmod(i * 0.6180339887498949, 1), on = path(t), depth = depth_of(on);
      auto listed = s_.fronts(t);
      if (on > 4 * eps && std::min(depth, p_.length - depth) > 4 * eps) {
        expected = true;
        for (const bool left : {true, false}) one_front(listed, left, on, t, eps);
      }
      for (const auto& f : listed)  // what is left is on no characteristic, unless near an end, where none was sought
        if (on < -4 * eps || (on > 4 * eps && std::min(depth, p_.length - depth) > 4 * eps) || std::isnan(f.position))
          r_.jump = infinity;
    }
    if (expected && r_.fronts == 0) r_.jump = infinity;
  }

  void one_front(std::vector<Front>& listed, bool left, double on, double t, double eps) {
    const double depth = depth_of(on), round_off = 1e-12 * (p_.length + p_.gap + c_ * t);
    const int direction = left == (on > p_.length) ? +1 : -1;
    const double x = place(left, depth), ahead = x + direction * eps, behind = x - direction * eps;
    const double sigma = stress(behind, t) - stress(ahead, t), v = velocity(behind, t) - velocity(ahead, t);
    note(r_.jump, (sigma + p_.density * direction * c_ * v) / stress_scale_);
    const auto found = std::find_if(listed.begin(), listed.end(), [&](const Front& f) {
      return std::abs(f.position - x) <= round_off && f.direction == direction &&
             std::abs(f.travelled - on) <= round_off;
    });
    if (found != listed.end()) {
      note(r_.jump, (sigma - found->stress_jump) / stress_scale_);
      listed.erase(found);
      ++r_.fronts;
    } else {
      note(r_.jump, sigma / stress_scale_);  // not listed, so there must be none
    }
  }

  void ends() {
    int looked_at = 0;
    for (int i = 1; i <= 500; ++i) {
      const double t = t_end_ * std::fmod(i * 0.6180339887498949, 1), on = path(t), edge = 1e-9 * (p_.length + c_ * t);
      if (std::abs(on) < edge || std::abs(on - p_.length) < edge || on > 2 * p_.length - edge) continue;
      note(r_.boundary, stress(place(true, p_.length), t) / stress_scale_);
      note(r_.boundary, stress(place(false, p_.length), t) / stress_scale_);
      // with no gap both faces are at x = L: a little way into the right bar, where no front is, its field is the same
      const double step = p_.gap > 0 ? 0 : edge / 2;
      const double left = stress(place(true, 0), t), right = stress(place(false, step), t);
      note(r_.boundary, (left - right) / stress_scale_);
      const double sigma = left / stress_scale_, limit = p_.yield_stress / stress_scale_;
      const double closing = (velocity(place(true, 0), t) - velocity(place(false, step), t)) / 2 / speed_;
      if (on < 0) {
        note(r_.boundary, sigma);
      } else {
        const auto larger = [](double a, double b) { return a >= b ? a : b; };
        const double rest = larger(std::abs(closing), larger(sigma, -limit - sigma));
        const double flow = larger(std::abs(sigma + limit), -closing);
        const double parting = larger(std::abs(sigma), closing);
        note(r_.boundary, std::isnan(sigma + closing) ? sigma + closing : std::min({rest, flow, parting}));
      }
      ++looked_at;
    }
    if (looked_at == 0) r_.boundary = infinity;
  }

  void initial_state() {
    for (int i = 1; i < 200; ++i) {
      for (const bool left : {true, false}) {
        const double x = place(left, p_.length * i / 200);
        note(r_.initial, displacement(x, 0) * c_ / (speed_ * p_.length));
        note(r_.initial, stress(x, 0) / stress_scale_);
        note(r_.initial, (velocity(x, 0) - (left ? p_.left_velocity : p_.right_velocity)) / speed_);
      }
    }
  }

  const ExactSolution& s_;
  const PlasticImpact::Parameters& p_;
  const double t_end_, c_ = std::sqrt(p_.youngs_modulus / p_.density);
  const double speed_ = (p_.left_velocity - p_.right_velocity) / 2;
  const double begin_ = p_.gap / (p_.left_velocity - p_.right_velocity);
  const double stress_scale_ = std::min(p_.yield_stress, p_.density* c_* speed_);
  Residual r_;
};

}  // namespace

Residual self_test(const ExactSolution& solution, const PlasticImpact::Parameters& parameters, double t_end) {
  if (!(t_end > 0) || !std::isfinite(t_end)) throw std::invalid_argument("self_test: t_end must be > 0 and finite");
  return PlasticSelfTest(solution, parameters, t_end).run();
}

double PlasticImpact::residual(double t_end) const { return self_test(*this, t_end).worst(); }

Residual self_test(const PlasticImpact& impact, double t_end) { return self_test(impact, impact.parameters(), t_end); }

}  // namespace diptych::analytic
