#include "analytic/bar_wave.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "analytic/parameters.hpp"

namespace diptych::analytic {
namespace {

void require_wave(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(std::string("bar-wave: ") + message);
}

double slope_sum(const Traction& f, bool absolute) {
  double sum = 0;
  for (const auto& kink : f.kinks) sum += absolute ? std::abs(kink.slope) : kink.slope;
  return sum;
}

/// sup |f|: a piecewise linear history that ends flat has it on one side of a kink.
double largest(const Traction& f) {
  double sup = 0;
  for (const auto& kink : f.kinks) {
    double before = f.value(kink.time);
    for (const auto& other : f.kinks)
      if (other.time == kink.time) before -= other.jump;
    sup = std::max({sup, std::abs(before), std::abs(f.value(kink.time))});
  }
  return sup;
}

void check_end_of_wave(const BarEnd& end) {
  require_wave(!end.fixed || end.traction.kinks.empty(), "a fixed end carries no traction");
  for (const auto& kink : end.traction.kinks) {
    require_wave(std::isfinite(kink.time) && kink.time >= 0, "a traction must change at finite times >= 0");
    require_wave(std::isfinite(kink.jump) && std::isfinite(kink.slope), "a traction must be finite");
  }
  require_wave(std::abs(slope_sum(end.traction, false)) <= 1e-12 * slope_sum(end.traction, true),
               "the slopes of a traction must add up to zero, or it grows without bound");
}

/// Stress is reflected with its sign by a held end, against its sign by a free or loaded one.
double reflection(const BarEnd& end) { return end.fixed ? +1 : -1; }

/// A bar with one loaded end: the waves that end has sent out, by how often they came back to it.
struct Loaded {
  const Traction& traction;
  int inward;         ///< direction of a wave that leaves this end
  double reflection;  ///< of the other end
};

std::vector<Loaded> loaded_ends(const BarWave::Parameters& p) {
  std::vector<Loaded> ends;
  if (!p.left.traction.kinks.empty()) ends.push_back({p.left.traction, +1, reflection(p.right)});
  if (!p.right.traction.kinks.empty()) ends.push_back({p.right.traction, -1, reflection(p.left)});
  return ends;
}

}  // namespace

double Traction::value(double t) const {
  double f = 0;
  for (const auto& kink : kinks)
    if (t >= kink.time) f += kink.jump + kink.slope * (t - kink.time);
  return f;
}

double Traction::integral(double t) const {
  double f = 0;
  for (const auto& kink : kinks)
    if (t >= kink.time) f += (kink.jump + kink.slope * (t - kink.time) / 2) * (t - kink.time);
  return f;
}

Traction Traction::step(double amplitude, double start) { return {{{start, amplitude, 0}}}; }

Traction Traction::ramp(double amplitude, double rise, double start) {
  require_wave(positive(rise), "a ramp needs a rise time > 0");
  return {{{start, 0, amplitude / rise}, {start + rise, 0, -amplitude / rise}}};
}

Traction Traction::impulse(double amplitude, double duration, double start) {
  require_wave(positive(duration), "an impulse needs a duration > 0");
  return {{{start, amplitude, 0}, {start + duration, -amplitude, 0}}};
}

BarWave::BarWave(Parameters p) : p_(std::move(p)) {
  require_wave(positive(p_.youngs_modulus), "Young's modulus must be > 0");
  require_wave(positive(p_.density), "density must be > 0");
  require_wave(positive(p_.length), "length must be > 0");
  require_wave(!(p_.left.fixed && p_.right.fixed), "one end must be free to carry a traction");
  check_end_of_wave(p_.left);
  check_end_of_wave(p_.right);
  require_wave(positive(scale(BarQuantity::stress)), "one end must carry a traction that is not zero");
}

double BarWave::wave_speed() const { return std::sqrt(p_.youngs_modulus / p_.density); }

double BarWave::at(BarQuantity quantity, double x, double t) const {
  const double length = p_.length, c = wave_speed();
  if (!(x >= -1e-9 * length && x <= (1 + 1e-9) * length) || !std::isfinite(t))
    throw std::domain_error("bar-wave: x must lie in the bar and t be finite");
  double sum = 0;
  for (const auto& end : loaded_ends(p_)) {
    // A wave along +x of stress σ carries the velocity −σ/(ρc), one along −x the velocity +σ/(ρc).
    const auto add = [&](double path, int direction, double sign) {
      const double retarded = t - path / c;
      if (quantity == BarQuantity::stress) sum += sign * end.traction.value(retarded);
      const double minus = -direction * sign / (p_.density * c);
      if (quantity == BarQuantity::velocity) sum += minus * end.traction.value(retarded);
      if (quantity == BarQuantity::displacement) sum += minus * end.traction.integral(retarded);
    };
    const double from_end = end.inward > 0 ? x : length - x;
    double sign = 1;
    for (int n = 0; 2 * n * length <= c * t; ++n, sign *= -end.reflection) {
      add(2 * n * length + from_end, end.inward, sign);
      add(2 * (n + 1) * length - from_end, -end.inward, end.reflection * sign);
    }
  }
  return sum;
}

std::vector<Front> BarWave::fronts(double t) const {
  const double length = p_.length, c = wave_speed();
  std::vector<Front> fronts;
  for (const auto& end : loaded_ends(p_)) {
    for (const auto& kink : end.traction.kinks) {
      const double path = c * (t - kink.time);
      if (kink.jump == 0 || !(path > 0)) continue;
      const double round_trips = std::floor(path / (2 * length));
      const double rest = path - 2 * length * round_trips;
      const bool returning = rest > length;
      const double from_end = returning ? 2 * length - rest : rest;
      if (!(from_end > 0 && from_end < length)) continue;
      const double sign = std::fmod(round_trips, 2) == 0 ? 1 : -end.reflection;  // (−r)ⁿ, r = ±1
      fronts.push_back({end.inward > 0 ? from_end : length - from_end, returning ? -end.inward : end.inward,
                        (returning ? end.reflection : 1) * sign * kink.jump, path});
    }
  }
  std::stable_sort(fronts.begin(), fronts.end(),
                   [](const Front& a, const Front& b) { return a.position < b.position; });
  return fronts;
}

double BarWave::scale(BarQuantity quantity) const {
  const double stress = std::max(largest(p_.left.traction), largest(p_.right.traction));
  switch (quantity) {
    case BarQuantity::stress: return stress;
    case BarQuantity::velocity: return stress / (p_.density * wave_speed());
    case BarQuantity::displacement: return stress * p_.length / p_.youngs_modulus;
  }
  throw std::invalid_argument("bar-wave: no such quantity");
}

BarProblem problem(const BarWave::Parameters& p) {
  const auto posed = [](const BarEnd& end) {
    return BarProblem::End{end.fixed, [traction = end.traction](double t) { return traction.value(t); }};
  };
  std::vector<BarProblem::Kink> kinks;
  for (const bool right : {false, true})
    for (const auto& kink : (right ? p.right : p.left).traction.kinks) kinks.push_back({right, kink.time, kink.jump});
  return {p.youngs_modulus, p.density,
          p.length,         posed(p.left),
          posed(p.right),   [](double) { return 0.0; },
          std::move(kinks), BarWave(p).scale(BarQuantity::stress),
          p.length};
}

double BarWave::residual(double t_end) const {
  double settled = 0;
  for (const BarEnd* end : {&p_.left, &p_.right})
    for (const Traction::Kink& kink : end->traction.kinks) settled = std::max(settled, kink.time);
  return self_test(*this, std::max(t_end, settled + 5 * p_.length / wave_speed())).worst();
}

Residual self_test(const BarWave& bar, double t_end) { return self_test(bar, problem(bar.parameters()), t_end); }

}  // namespace diptych::analytic
