#include "analytic/diffusion_exact.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_expint.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "analytic/parameters.hpp"
#include "analytic/residual.hpp"

namespace diptych::analytic {
namespace {

using std::numbers::pi;

void require_diffusion(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(std::string("diffusion: ") + message);
}

bool not_zero(double x) { return std::isfinite(x) && x != 0; }

void inside(bool condition, const DiffusionSolution& solution) {
  if (!condition) throw std::domain_error(solution.name() + ": the point lies outside the solution's domain");
}

void inside_rectangle(double x, double y, double t, double width, double height, const DiffusionSolution& s) {
  inside(x >= -1e-9 * width && x <= (1 + 1e-9) * width && y >= -1e-9 * height && y <= (1 + 1e-9) * height && t >= 0 &&
             std::isfinite(t),
         s);
}

/// E₁(x), x > 0; 0 where it is smaller than any number.
double exponential_integral(double x) {
  if (std::isinf(x)) return 0;
  gsl_sf_result result{};
  const int status = gsl_sf_expint_E1_e(x, &result);
  if (status == GSL_EUNDRFLW) return 0;
  return status == GSL_SUCCESS ? result.val : std::nan("");
}

/// Central differences of sixth order.
template <class F>
double first(const F& f, double x, double d) {
  return (45 * (f(x + d) - f(x - d)) - 9 * (f(x + 2 * d) - f(x - 2 * d)) + (f(x + 3 * d) - f(x - 3 * d))) / (60 * d);
}
template <class F>
double second(const F& f, double x, double d) {
  return (270 * (f(x + d) + f(x - d)) - 27 * (f(x + 2 * d) + f(x - 2 * d)) + 2 * (f(x + 3 * d) + f(x - 3 * d)) -
          490 * f(x)) /
         (180 * d * d);
}
/// One-sided, of fourth order; d may be negative.
template <class F>
double first_from(const F& f, double x, double d) {
  return (-25 * f(x) + 48 * f(x + d) - 36 * f(x + 2 * d) + 16 * f(x + 3 * d) - 3 * f(x + 4 * d)) / (12 * d);
}

/// ∫₀¹ f by Gauss–Legendre with three points in each of n parts.
template <class F>
double integral(const F& f, int n) {
  const double off = std::sqrt(0.15);
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    for (const auto& [at, weight] : {std::pair{0.5 - off, 5.0 / 18}, {0.5, 8.0 / 18}, {0.5 + off, 5.0 / 18}})
      sum += weight * f((i + at) / n);
  }
  return sum / n;
}

class DiffusionSelfTest {
 public:
  DiffusionSelfTest(const DiffusionSolution& s, const DiffusionProblem& p, double t_begin, double t_end)
      : s_(s), p_(p), begin_(t_begin), end_(t_end) {}

  DiffusionResidual run() {
    balance();
    walls();
    if (p_.amount) amounts();
    return r_;
  }

 private:
  double at(double x, double y, double t) const { return s_.concentration(x, y, t); }
  /// Early times are looked at as closely as late ones.
  double time(double part) const { return begin_ * std::pow(end_ / begin_, part); }

  void balance() {
    for (int i = 1; i <= 2000; ++i) {
      const double x = p_.width * std::fmod(i * 0.8191725133961645, 1);
      const double y = p_.height * std::fmod(i * 0.6710436067037893, 1);
      const double t = time(std::fmod(i * 0.5497004779019703, 1)), r = std::hypot(x, y);
      if (r < p_.core) continue;
      const double d = 1e-2 * std::min(p_.smooth_length, p_.core > 0 ? r : infinity), tau = 1e-2 * t;
      const double margin = 3 * d;
      if (x < margin || y < margin || x > p_.width - margin || y > p_.height - margin) continue;
      const auto in_x = [&](double z) { return at(z, y, t); };
      const auto in_y = [&](double z) { return at(x, z, t); };
      const auto in_t = [&](double z) { return at(x, y, z); };
      const auto along_ray = [&](double z) { return at(x / r * z, y / r * z, t); };
      const double D = p_.diffusivity(x, y);
      double spread = 0;
      if (p_.radial) {
        spread = D * second(along_ray, r, d);
      } else {
        spread = D * (second(in_x, x, d) + second(in_y, y, d)) +
                 first([&](double z) { return p_.diffusivity(z, y); }, x, d) * first(in_x, x, d) +
                 first([&](double z) { return p_.diffusivity(x, z); }, y, d) * first(in_y, y, d);
      }
      const double source = p_.source ? p_.source(x, y, t) : 0;
      const double unit = p_.scale * std::max(D, 1e-3 * p_.diffusivity(0, 0)) / (p_.smooth_length * p_.smooth_length);
      note(r_.balance, (first(in_t, t, tau) - spread - source) / unit);
      ++r_.points;
    }
    if (r_.points == 0) r_.balance = infinity;
  }

  void walls() {
    const double unit = p_.scale / p_.smooth_length;
    for (int i = 1; i <= 200; ++i) {
      const double along = std::fmod(i * 0.7548776662466927, 1), t = time(std::fmod(i * 0.5698402909980532, 1));
      const double x = p_.width * along, y = p_.height * along;
      if (p_.radial) continue;  // rays do not end on walls
      const auto d = [&](double r) { return 1e-2 * std::min(p_.smooth_length, p_.core > 0 ? r : infinity); };
      const auto across_x = [&](double z) { return at(z, y, t); };
      const auto across_y = [&](double z) { return at(x, z, t); };
      if (y > p_.core) note(r_.boundary, first_from(across_x, 0, d(y)) / unit);
      if (x > p_.core) note(r_.boundary, first_from(across_y, 0, d(x)) / unit);
      if (p_.right_wall) note(r_.boundary, first_from(across_x, p_.width, -d(p_.width)) / unit);
      if (p_.top_wall) note(r_.boundary, first_from(across_y, p_.height, -d(p_.height)) / unit);
    }
  }

  void amounts() {
    for (const double part : {0.0, 0.3, 0.7, 1.0}) {
      const double t = time(part), expected = p_.amount(t);
      double found = 0, unit = p_.scale * p_.width;
      if (p_.radial) {
        found = p_.width * integral([&](double z) { return at(z * p_.width, 0, t); }, 400);
      } else {
        unit *= p_.height;
        const auto column = [&](double x) {
          return integral([&](double z) { return at(x, z * p_.height, t); }, 120) * p_.height;
        };
        // towards the corner the points lie closer, for what may be singular there
        found = p_.width * integral([&](double z) { return 3 * z * z * column(z * z * z * p_.width); }, 120);
      }
      note(r_.amount, (found - expected) / std::max(unit * 1e-6, std::abs(expected)));
    }
  }

  const DiffusionSolution& s_;
  const DiffusionProblem& p_;
  const double begin_, end_;
  DiffusionResidual r_;
};

}  // namespace

std::array<double, 3> DiffusionSolution::at(PlaneQuantity quantity, double x, double y, double t) const {
  if (!gives(quantity)) throw std::invalid_argument(name() + ": this quantity is not given");
  return {concentration(x, y, t), 0, 0};
}

double DiffusionSolution::scale(PlaneQuantity quantity) const {
  if (!gives(quantity)) throw std::invalid_argument(name() + ": this quantity is not given");
  return size();
}

// --- a quarter plane
// ---------------------------------------------------------------------------------------------------

InstantSource::InstantSource(const Parameters& p) : p_(p) {
  require_diffusion(not_zero(p.amount), "amount must be finite and not zero");
  require_diffusion(positive(p.diffusivity), "diffusivity must be > 0");
  require_diffusion(positive(p.time), "time must be > 0");
  require_diffusion(std::isfinite(p.start) && p.start >= 0, "start must be >= 0");
}

double InstantSource::concentration(double x, double y, double t) const {
  const double spread = 4 * p_.diffusivity * (t + p_.start);
  inside(x >= 0 && y >= 0 && std::isfinite(x) && std::isfinite(y) && t >= 0 && std::isfinite(t) && spread > 0, *this);
  return 4 * p_.amount / (pi * spread) * std::exp(-(x * x + y * y) / spread);
}

double InstantSource::size() const { return std::abs(p_.amount) / (pi * p_.diffusivity * (p_.time + p_.start)); }

CornerSource::CornerSource(const Parameters& p) : p_(p) {
  require_diffusion(not_zero(p.rate), "rate must be finite and not zero");
  require_diffusion(positive(p.diffusivity), "diffusivity must be > 0");
}

double CornerSource::concentration(double x, double y, double t) const {
  inside(x >= 0 && y >= 0 && std::isfinite(x) && std::isfinite(y) && t >= 0 && std::isfinite(t), *this);
  if (t == 0) return 0;
  const double z = (x * x + y * y) / (4 * p_.diffusivity * t);
  if (z == 0) return std::copysign(infinity, p_.rate);
  return p_.rate / (pi * p_.diffusivity) * exponential_integral(z);
}

double CornerSource::size() const { return std::abs(p_.rate) / (pi * p_.diffusivity); }

RadialPulse::RadialPulse(const Parameters& p) : p_(p) {
  require_diffusion(not_zero(p.amount), "amount must be finite and not zero");
  require_diffusion(positive(p.diffusivity), "diffusivity must be > 0");
  require_diffusion(positive(p.time), "time must be > 0");
  require_diffusion(std::isfinite(p.start) && p.start >= 0, "start must be >= 0");
}

double RadialPulse::concentration(double x, double y, double t) const {
  const double spread = 4 * p_.diffusivity * (t + p_.start);
  inside(x >= 0 && y >= 0 && std::isfinite(x) && std::isfinite(y) && t >= 0 && std::isfinite(t) && spread > 0, *this);
  return 2 * p_.amount / std::sqrt(pi * spread) * std::exp(-(x * x + y * y) / spread);
}

double RadialPulse::size() const { return std::abs(p_.amount) / std::sqrt(pi * p_.diffusivity * (p_.time + p_.start)); }

// --- a rectangle
// -------------------------------------------------------------------------------------------------------

CosineMode::CosineMode(const Parameters& p) : p_(p) {
  require_diffusion(positive(p.width) && positive(p.height), "sides must be > 0");
  require_diffusion(p.m >= 0 && p.n >= 0, "m and n must be >= 0");
  require_diffusion(std::isfinite(p.mean), "mean must be finite");
  require_diffusion(not_zero(p.amplitude), "amplitude must be finite and not zero");
  require_diffusion(positive(p.diffusivity), "diffusivity must be > 0");
}

double CosineMode::decay_rate() const {
  const double kx = p_.m * pi / p_.width, ky = p_.n * pi / p_.height;
  return p_.diffusivity * (kx * kx + ky * ky);
}

double CosineMode::concentration(double x, double y, double t) const {
  inside_rectangle(x, y, t, p_.width, p_.height, *this);
  return p_.mean + p_.amplitude * std::cos(p_.m * pi * x / p_.width) * std::cos(p_.n * pi * y / p_.height) *
                       std::exp(-decay_rate() * t);
}

double CosineMode::size() const { return std::abs(p_.amplitude); }

ManufacturedVariable::ManufacturedVariable(const Parameters& p) : p_(p) {
  require_diffusion(positive(p.width) && positive(p.height), "sides must be > 0");
  require_diffusion(not_zero(p.amplitude), "amplitude must be finite and not zero");
  require_diffusion(positive(p.decay_time), "decay time must be > 0");
  require_diffusion(positive(p.mobility), "mobility must be > 0");
  require_diffusion(positive(p.rupture_strain), "rupture strain must be > 0");
  require_diffusion(p.strain >= 0 && p.strain <= p.rupture_strain, "strain must lie between 0 and the rupture strain");
}

double ManufacturedVariable::strain(double x, double y) const {
  inside_rectangle(x, y, 0, p_.width, p_.height, *this);
  return p_.strain * (1 + std::cos(pi * x / p_.width) * std::cos(pi * y / p_.height)) / 2;
}

double ManufacturedVariable::diffusivity(double x, double y) const {
  return p_.mobility * (1 - strain(x, y) / p_.rupture_strain);
}

double ManufacturedVariable::concentration(double x, double y, double t) const {
  inside_rectangle(x, y, t, p_.width, p_.height, *this);
  return 1 + p_.amplitude * std::cos(pi * x / p_.width) * std::cos(pi * y / p_.height) * std::exp(-t / p_.decay_time);
}

double ManufacturedVariable::source(double x, double y, double t) const {
  inside_rectangle(x, y, t, p_.width, p_.height, *this);
  // With φ = cos cos, C = 1 + B φ and d = d₀ − d₁ φ: Q = −B φ/τ − d B ∇²φ + d₁ B |∇φ|².
  const double kx = pi / p_.width, ky = pi / p_.height;
  const double cx = std::cos(kx * x), cy = std::cos(ky * y), sx = std::sin(kx * x), sy = std::sin(ky * y);
  const double b = p_.amplitude * std::exp(-t / p_.decay_time);
  const double slope = p_.mobility * p_.strain / (2 * p_.rupture_strain);
  const double laplacian = -(kx * kx + ky * ky) * cx * cy;
  const double gradient = kx * kx * sx * sx * cy * cy + ky * ky * cx * cx * sy * sy;
  return b * (-cx * cy / p_.decay_time - diffusivity(x, y) * laplacian + slope * gradient);
}

double ManufacturedVariable::size() const { return std::abs(p_.amplitude); }

double ftcs_factor(double r, double sx2, double sy2) { return 1 - 4 * r * (sx2 + sy2); }

// --- self-test
// ---------------------------------------------------------------------------------------------------------

double DiffusionResidual::worst() const {
  if (points == 0) return infinity;
  double worst = 0;
  for (const double r : {balance, boundary, amount}) note(worst, r);
  return worst;
}

DiffusionResidual self_test(const DiffusionSolution& solution, const DiffusionProblem& problem, double t_begin,
                            double t_end) {
  if (!(t_begin > 0 && t_end >= t_begin) || !std::isfinite(t_end))
    throw std::invalid_argument("self_test: times must be > 0, finite and in order");
  return DiffusionSelfTest(solution, problem, t_begin, t_end).run();
}

double DiffusionSolution::residual(const PlaneWindow& window) const {
  DiffusionProblem problem{};
  problem.width = window.width;
  problem.height = window.height;
  problem.right_wall = problem.top_wall = walled();
  problem.radial = radial();
  problem.core = window.core;
  problem.diffusivity = [this](double x, double y) { return diffusivity(x, y); };
  problem.source = [this](double x, double y, double t) { return source(x, y, t); };
  problem.scale = size();
  problem.smooth_length = std::max(window.core, 0.05 * window.width);
  return self_test(*this, problem, window.from, window.to).worst();
}

}  // namespace diptych::analytic
