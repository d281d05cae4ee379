#include "analytic/plate_impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analytic/parameters.hpp"
#include "analytic/residual.hpp"

namespace diptych::analytic {
namespace {

void require_plates(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(std::string("plate impact: ") + message);
}

void check_plates(const PlateImpact::Parameters& p) {
  require_plates(positive(p.medium.mu), "mu must be > 0");
  require_plates(std::isfinite(p.medium.lambda) && p.medium.lambda + p.medium.mu > 0, "lambda + mu must be > 0");
  require_plates(positive(p.medium.density), "density must be > 0");
  require_plates(positive(p.width) && positive(p.height), "sides must be > 0");
  require_plates(p.face > 0 && p.face < p.width, "the face must lie between the ends");
  require_plates(positive(p.velocity), "velocity must be > 0");
}

/// Path of a front that left `start` in `direction`, folded at the ends.
Front place(double start, int direction, double width, double path) {
  const double first_leg = direction > 0 ? width - start : start;
  if (path <= first_leg) return {start + direction * path, direction, 0, path};
  const double beyond = path - first_leg, leg = std::floor(beyond / width), along = beyond - leg * width;
  const bool towards_start = std::fmod(leg, 2) == 0;  // away from the end that it met first
  const bool from_right = (direction > 0) == towards_start;
  return {from_right ? width - along : along, from_right ? -1 : 1, 0, path};
}

}  // namespace

PlateImpact::PlateImpact(const Parameters& p) : p_(p), c_(0) {
  check_plates(p);
  c_ = p.medium.pressure_speed();
}

void PlateImpact::inside(double x, double t) const {
  if (!(x >= -1e-9 * p_.width && x <= (1 + 1e-9) * p_.width && t >= 0) || !std::isfinite(t))
    throw std::domain_error(name() + ": the point must lie in the strip and t be finite and >= 0");
}

/// g, at what differs from x by the path travelled.
double PlateImpact::initial_velocity(double x, double travelled) const {
  const double folded = std::fmod(std::abs(x), 2 * p_.width);
  const double to_face = std::min(folded, 2 * p_.width - folded) - p_.face;
  if (std::abs(to_face) <= 1e-13 * (p_.width + travelled)) return p_.velocity / 2;
  return to_face < 0 ? p_.velocity : 0;
}

/// ∫₀ˣ g
double PlateImpact::initial_velocity_integral(double x) const {
  const double period = 2 * p_.width, whole = std::floor(std::abs(x) / period), rest = std::abs(x) - whole * period;
  const double begun = std::min(rest, p_.face), ending = std::max(0.0, rest - (period - p_.face));
  return std::copysign(p_.velocity * (2 * p_.face * whole + begun + ending), x);
}

std::array<double, 3> PlateImpact::at(PlaneQuantity quantity, double x, double y, double t) const {
  inside(x, t);
  if (!(y >= -1e-9 * p_.height && y <= (1 + 1e-9) * p_.height))
    throw std::domain_error(name() + ": the point must lie in the strip");
  const double path = c_ * t, left_going = initial_velocity(x + path, path),
               right_going = initial_velocity(x - path, path);
  switch (quantity) {
    case PlaneQuantity::displacement:
      return {(initial_velocity_integral(x + path) - initial_velocity_integral(x - path)) / (2 * c_), 0, 0};
    case PlaneQuantity::velocity: return {(left_going + right_going) / 2, 0, 0};
    case PlaneQuantity::stress: {
      const double xx = p_.medium.density * c_ * (left_going - right_going) / 2;
      return {xx, lateral_ratio() * xx, 0};
    }
    case PlaneQuantity::concentration: break;
  }
  throw std::invalid_argument(name() + ": this quantity is not given");
}

double PlateImpact::scale(PlaneQuantity quantity) const {
  switch (quantity) {
    case PlaneQuantity::displacement: return p_.velocity * p_.face / c_;
    case PlaneQuantity::velocity: return p_.velocity;
    case PlaneQuantity::stress: return -plateau();  // |λ/(λ+2μ)| < 1
    case PlaneQuantity::concentration: break;
  }
  throw std::invalid_argument(name() + ": this quantity is not given");
}

double PlateImpact::plateau() const { return -p_.medium.density * c_ * p_.velocity / 2; }

double PlateImpact::lateral_ratio() const { return p_.medium.lambda / (p_.medium.lambda + 2 * p_.medium.mu); }

double PlateImpact::arrival(double x) const {
  inside(x, 0);
  return std::abs(x - p_.face) / c_;
}

double PlateImpact::release(double x) const {
  inside(x, 0);
  return std::min(p_.face + x, (p_.width - p_.face) + (p_.width - x)) / c_;
}

std::vector<Front> PlateImpact::fronts(double t) const {
  inside(0, t);
  std::vector<Front> both;
  for (const int direction : {-1, 1}) {
    both.push_back(place(p_.face, direction, p_.width, c_ * t));
    both.back().stress_jump = both.back().direction == direction ? plateau() : -plateau();  // free ends turn it round
  }
  if (both[0].position > both[1].position) std::swap(both[0], both[1]);
  return both;
}

// --- self-test
// ---------------------------------------------------------------------------------------------------------

namespace {

class ImpactSelfTest {
 public:
  ImpactSelfTest(const PlaneSolution& solution, const PlateImpact::Parameters& p, double t_end)
      : s_(solution), p_(p), t_end_(t_end) {}

  ImpactResidual run() {
    interior();
    front_conditions();
    ends();
    initial_state();
    totals();
    return r_;
  }

 private:
  using Values = std::array<double, 3>;
  Values stress(double x, double y, double t) const { return s_.at(PlaneQuantity::stress, x, y, t); }
  Values velocity(double x, double y, double t) const { return s_.at(PlaneQuantity::velocity, x, y, t); }
  Values displacement(double x, double y, double t) const { return s_.at(PlaneQuantity::displacement, x, y, t); }

  /// Where the fronts are: in the strip unfolded, of period 2 width, they and their images move at c both ways.
  std::vector<double> places(double t) const {
    std::vector<double> at;
    for (const double path : {c_ * t, -c_ * t}) {
      const double unfolded = p_.face + path, turn = 2 * p_.width;
      const double on = unfolded - turn * std::floor(unfolded / turn);
      at.push_back(on <= p_.width ? on : turn - on);
    }
    std::sort(at.begin(), at.end());
    return at;
  }

  void interior() {
    const double d = 1e-3 * p_.width, tau = d / c_, reach = 4 * d, modulus = p_.medium.lambda + 2 * p_.medium.mu;
    for (int i = 1; i <= 4000; ++i) {
      const double x = p_.width * std::fmod(i * 0.8191725133961645, 1);  // an additive sequence: even coverage
      const double y = p_.height * std::fmod(i * 0.6710436067037893, 1);
      const double t = t_end_ * std::fmod(i * 0.5497004779019703, 1);
      const auto front = places(t);
      if (std::min({x, p_.width - x, c_ * t, std::abs(x - front[0]), std::abs(x - front[1])}) < reach) continue;
      const auto in_space = [&](const auto& f) { return derivative([&](double z) { return f(z, t); }, x, d); };
      const auto in_time = [&](const auto& f) { return derivative([&](double z) { return f(x, z); }, t, tau); };
      const auto ux = [&](double z, double when) { return displacement(z, y, when)[0]; };
      const auto vx = [&](double z, double when) { return velocity(z, y, when)[0]; };
      const auto xx = [&](double z, double when) { return stress(z, y, when)[0]; };
      const auto [s_xx, s_yy, s_xy] = stress(x, y, t);
      const auto u = displacement(x, y, t), v = velocity(x, y, t), below = displacement(x, 0, t);
      const double strain = in_space(ux);
      note(r_.motion, (p_.medium.density * in_time(vx) - in_space(xx)) * p_.width / stress_);
      note(r_.motion, (s_xx - modulus * strain) / stress_);
      note(r_.motion, (s_yy - p_.medium.lambda * strain) / stress_);
      note(r_.motion, s_xy / stress_);
      note(r_.motion, (v[0] - in_time(ux)) / p_.velocity);
      note(r_.motion, v[1] / p_.velocity);
      note(r_.motion, u[1] / length_);
      note(r_.motion, (u[0] - below[0]) / length_);
      ++r_.points;
    }
    if (r_.points == 0) r_.motion = infinity;
  }

  void front_conditions() {
    const double eps = 1e-4 * p_.width, y = p_.height / 2;
    for (int i = 1; i <= 500; ++i) {
      const double t = t_end_ * std::fmod(i * 0.6180339887498949, 1);
      const auto now = places(t), later = places(t + 1e-3 * eps / c_);
      if (std::min({now[0], p_.width - now[1], now[1] - now[0]}) < 4 * eps) continue;
      for (std::size_t k = 0; k < 2; ++k) {
        const double speed = later[k] > now[k] ? c_ : -c_;
        const double sigma = stress(now[k] + eps, y, t)[0] - stress(now[k] - eps, y, t)[0];
        const double v = velocity(now[k] + eps, y, t)[0] - velocity(now[k] - eps, y, t)[0];
        note(r_.jump, (sigma + p_.medium.density * speed * v) / stress_);
        note(r_.jump, (std::abs(sigma) - stress_) / stress_);
        ++r_.fronts;
      }
    }
    if (r_.fronts == 0) r_.jump = infinity;
  }

  void ends() {
    int looked_at = 0;
    for (int i = 1; i <= 500; ++i) {
      const double t = t_end_ * std::fmod(i * 0.6180339887498949, 1),
                   y = p_.height * std::fmod(i * 0.7548776662466927, 1);
      const auto front = places(t);
      if (std::min(front[0], p_.width - front[1]) < 1e-9 * (p_.width + c_ * t)) continue;
      for (const double x : {0.0, p_.width}) note(r_.boundary, stress(x, y, t)[0] / stress_);
      ++looked_at;
    }
    if (looked_at == 0) r_.boundary = infinity;
  }

  void initial_state() {
    for (int i = 0; i <= 200; ++i) {
      const double x = p_.width * i / 200, y = p_.height * std::fmod(i * 0.7548776662466927, 1);
      if (std::abs(x - p_.face) < 1e-9 * p_.width) continue;
      for (const double u : displacement(x, y, 0)) note(r_.initial, u / length_);
      for (const double s : stress(x, y, 0)) note(r_.initial, s / stress_);
      note(r_.initial, (velocity(x, y, 0)[0] - (x < p_.face ? p_.velocity : 0)) / p_.velocity);
    }
  }

  /// Between fronts the fields are constant, so that a point stands for each part.
  void totals() {
    const double rho = p_.medium.density, modulus = p_.medium.lambda + 2 * p_.medium.mu, y = p_.height / 3;
    const double had = rho * p_.face * p_.velocity;
    for (int i = 1; i <= 500; ++i) {
      const double t = t_end_ * std::fmod(i * 0.6180339887498949, 1);
      auto edges = places(t);
      edges.push_back(p_.width);
      double from = 0, momentum = 0, energy = 0;
      for (const double to : edges) {
        const double width = to - from, x = from + 0.3819660112501051 * width;
        const double v = velocity(x, y, t)[0], s = stress(x, y, t)[0];
        if (width > 1e-9 * (p_.width + c_ * t)) {
          momentum += rho * v * width;
          energy += (rho * v * v + s * s / modulus) / 2 * width;
        }
        from = to;
      }
      note(r_.momentum, (momentum - had) / had);
      note(r_.energy, (energy - had * p_.velocity / 2) / (had * p_.velocity / 2));
    }
  }

  const PlaneSolution& s_;
  const PlateImpact::Parameters& p_;
  const double t_end_, c_ = p_.medium.pressure_speed();
  const double stress_ = p_.medium.density * c_ * p_.velocity / 2, length_ = p_.velocity * p_.face / c_;
  ImpactResidual r_;
};

}  // namespace

double ImpactResidual::worst() const {
  if (points == 0) return infinity;
  double worst = 0;
  for (const double r : {motion, jump, boundary, initial, momentum, energy}) note(worst, r);
  return worst;
}

ImpactResidual self_test(const PlaneSolution& solution, const PlateImpact::Parameters& p, double t_end) {
  check_plates(p);
  require_plates(positive(t_end), "the self-test's t_end must be > 0 and finite");
  return ImpactSelfTest(solution, p, t_end).run();
}

double PlateImpact::residual(const PlaneWindow& window) const { return self_test(*this, p_, window.to).worst(); }

}  // namespace diptych::analytic
