#include "analytic/impact_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "analytic/parameters.hpp"

namespace diptych::analytic {
namespace {

using Method = PlaneDiscretisation::Method;
using std::numbers::pi;

void require_lattice(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(std::string("impact lattice: ") + message);
}

void check_lattice(const PlaneMedium& medium, const PlaneDiscretisation& d) {
  require_lattice(positive(medium.mu) && std::isfinite(medium.lambda) && medium.lambda + medium.mu > 0,
                  "mu and lambda + mu must be > 0");
  require_lattice(positive(medium.density), "density must be > 0");
  require_lattice(positive(d.hx) && positive(d.hy), "cell sizes must be > 0");
  require_lattice(positive(d.time_step), "time step must be > 0");
  if (d.method == Method::fem) return;
  require_lattice(!d.positions.empty(), "a cell needs particles");
  auto positions = d.positions;
  std::sort(positions.begin(), positions.end());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    require_lattice(positions[i] >= 0 && positions[i] <= 1, "positions must lie in [0, 1]");
    require_lattice(std::abs(positions[i] + positions[positions.size() - 1 - i] - 1) <= 1e-12,
                    "particles must lie symmetrically in their cells");
  }
}

/// a of MPM, the mean of 4ξ(1−ξ).
double filter(const std::vector<double>& positions) {
  double sum = 0;
  for (const double xi : positions) sum += 4 * xi * (1 - xi);
  return sum / static_cast<double>(positions.size());
}

double modulus(const PlaneMedium& medium) { return medium.lambda + 2 * medium.mu; }

double courant(const PlaneMedium& medium, const PlaneDiscretisation& d) {
  return medium.pressure_speed() * d.time_step / d.hx;
}

}  // namespace

ImpactLattice::ImpactLattice(const Parameters& p) : p_(p), courant_(0) {
  check_lattice(p.medium, p.scheme);
  require_lattice(p.cells >= 2 && p.cells <= 1000000, "cells must be 2 to a million");
  require_lattice(p.face >= 1 && p.face < p.cells, "the face must be a column of nodes between the ends");
  require_lattice(positive(p.velocity), "velocity must be > 0");
  courant_ = courant(p.medium, p.scheme);
  const int turn = 4 * p.cells;
  for (int m = 0; m < turn; ++m) {  // the four quarters alike to the bit
    const int rest = m % (2 * p.cells), quarter = std::min(rest, 2 * p.cells - rest);
    sine_.push_back((m < 2 * p.cells ? 1 : -1) * std::sin(pi * quarter / (2 * p.cells)));
  }
  p.scheme.method == Method::fem ? add_fem() : add_mpm();
}

/// sin²(Ω/2) as a wave without damping: by the distance from whichever of 0 and π is nearer, which keeps its digits.
ImpactLattice::Wave ImpactLattice::leapfrog(int k, double weight, double half_square) {
  require_lattice(half_square <= 1 + 1e-12, "the time step lies above the stability limit");
  const double below = std::min(half_square, 1.0);
  return below <= 0.5 ? Wave{k, weight, 2 * std::asin(std::sqrt(below)), 1, 0}
                      : Wave{k, weight, 2 * std::asin(std::sqrt(1 - below)), -1, 0};
}

/// sin(mπ/2N)
double ImpactLattice::sine(long m) const { return sine_[static_cast<std::size_t>(m % (4L * p_.cells))]; }

// Nodes left of the face j at v and that on it at v/2 have v̂ = (v/N) sin(jθ) cos(θ/2)/s, middles left of it at v
// (v/N) sin(jθ)/s; none the wave with θ = π. Of a displacement û stress takes −2s û (λ+2μ)/h.

void ImpactLattice::add_mpm() {
  const double a = filter(p_.scheme.positions);
  const double size = -2 * modulus(p_.medium) / p_.scheme.hx * p_.scheme.time_step * p_.velocity / p_.cells;
  for (int k = 1; k < p_.cells; ++k) {
    const double s = sine(k), cosine = sine(k + p_.cells), weight = size * sine(2L * k * p_.face) * cosine;
    const double kept = cosine * cosine + (1 - a) * s * s, Q = 4 * courant_ * courant_ * s * s;  // kept: 1 − a s²
    if (p_.scheme.method != Method::usl) {
      waves_.push_back(leapfrog(k, weight, Q * kept / 4));
      continue;
    }
    require_lattice(Q * (1 + a * s * s) <= 4 * (1 + 1e-12), "the time step lies above the stability limit");
    const double product = 1 - a * s * s * Q, middle = 1 - Q / 2, under = Q * (kept - Q / 4);
    if (under > 0) {
      const double base = std::copysign(std::sqrt(product), middle);
      waves_.push_back({k, weight, std::atan2(std::sqrt(under), std::abs(middle)), base, 0});
    } else {
      const double large = middle + std::copysign(std::sqrt(-under), middle);
      waves_.push_back({k, weight, std::numeric_limits<double>::quiet_NaN(), large, product / large / large});
    }
  }
}

void ImpactLattice::add_fem() {
  const PlaneDiscretisation& d = p_.scheme;
  const double mass = p_.medium.density * d.hx, corner = 2 * mass / 3, middle = mass / 3;
  const double kappa = modulus(p_.medium) / d.hx, g = p_.medium.mu * d.hx / (d.hy * d.hy);
  const double size = -2 * kappa * d.time_step * p_.velocity / p_.cells;
  for (int k = 1; k < p_.cells; ++k) {
    const double s = sine(k), cosine = sine(k + p_.cells), sj = sine(2L * k * p_.face);
    // M^−½ K M^−½
    const double first = 2 * (kappa * (1 + s * s) + g * cosine * cosine) / corner, second = 2 * (kappa + g) / middle;
    const double between = -2 * cosine * (kappa + g) / std::sqrt(corner * middle);
    const double optical = (first + second + std::hypot(first - second, 2 * between)) / 2;
    const double acoustic = 8 * kappa * (kappa + g) * s * s / (corner * middle) / optical;  // determinant/optical
    const double turn = std::atan2(2 * between, first - second) / 2, c = std::cos(turn), r = std::sin(turn);
    // M^½ v̂ along either, and of that the corners' part
    const double vc = std::sqrt(corner) * sj * cosine, vm = std::sqrt(middle) * sj, part = size / std::sqrt(corner);
    const double step = d.time_step * d.time_step / 4;
    waves_.push_back(leapfrog(k, part * -r * (-r * vc + c * vm), acoustic * step));
    waves_.push_back(leapfrog(k, part * c * (c * vc + r * vm), optical * step));
  }
}

double ImpactLattice::grown(const Wave& w, long n) const {
  const double steps = static_cast<double>(n);
  if (p_.scheme.method == Method::usf) {
    if (w.base > 0) return std::sin((steps - 0.5) * w.angle) / (2 * std::sin(w.angle / 2));
    return (n % 2 == 1 ? 1 : -1) * std::cos((steps - 0.5) * w.angle) / (2 * std::cos(w.angle / 2));
  }
  double before = w.base < 0 && n % 2 == 0 ? -1 : 1;  // base to the power of n − 1
  if (std::abs(w.base) != 1) before *= std::pow(std::abs(w.base), steps - 1);
  if (std::isnan(w.angle)) {  // two real factors
    const double q = w.small_share;
    if (q == 1) return before * steps;
    return before *
           (q > 0 ? std::expm1(steps * std::log(q)) / std::expm1(std::log(q)) : (1 - std::pow(q, steps)) / (1 - q));
  }
  return before * (w.angle == 0 ? steps : std::sin(steps * w.angle) / std::sin(w.angle));
}

std::vector<double> ImpactLattice::at(double x, long first, long last) const {
  const double h = p_.scheme.hx, width = p_.cells * h;
  if (!(x >= -1e-9 * width && x <= (1 + 1e-9) * width) || first < 1)
    throw std::domain_error("impact lattice: gauges lie in the strip, and steps count from 1");
  const double cell = std::clamp(x / h - 0.5, 0.0, p_.cells - 1.0);
  const int left = std::min(static_cast<int>(cell), p_.cells - 2);
  const double share = cell - left;
  std::vector<double> values(static_cast<std::size_t>(std::max(0L, last - first + 1)));
  for (const Wave& w : waves_) {
    const double weight = w.weight * ((1 - share) * sine((2L * left + 1) * w.k) + share * sine((2L * left + 3) * w.k));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += weight * grown(w, first + static_cast<long>(i));
  }
  return values;
}

double ImpactLattice::gauge(double x, long n) const { return at(x, n, n).front(); }

std::vector<double> ImpactLattice::history(double x, long steps) const { return at(x, 1, steps); }

double ImpactLattice::cell_stress(int cell, long n) const {
  if (cell < 0 || cell >= p_.cells) throw std::domain_error("impact lattice: no such cell");
  return gauge((cell + 0.5) * p_.scheme.hx, n);
}

double ImpactLattice::stress_time(long n) const {
  return (static_cast<double>(n) - (p_.scheme.method == Method::usf ? 0.5 : 0)) * p_.scheme.time_step;
}

double ImpactLattice::phase(int k) const {
  if (k < 1 || k >= p_.cells) throw std::domain_error("impact lattice: waves count from 1 to N - 1");
  const auto index = static_cast<std::size_t>(k - 1);
  const Wave& w = waves_[p_.scheme.method == Method::fem ? 2 * index : index];
  const double angle = std::isnan(w.angle) ? 0 : w.angle;
  return w.base < 0 ? pi - angle : angle;
}

double impact_dispersion(const PlaneMedium& medium, const PlaneDiscretisation& d) {
  check_lattice(medium, d);
  require_lattice(d.method != Method::usl, "no width is known of USL's fronts, which it damps");
  const double gamma = medium.mu * d.hx * d.hx / (modulus(medium) * d.hy * d.hy), C = courant(medium, d);
  const double a = d.method == Method::fem ? -(1 + 3 * gamma) / (9 * (1 + gamma)) : filter(d.positions);
  return 1 + 3 * a - C * C;
}

double front_width(const PlaneMedium& medium, const PlaneDiscretisation& d, double travelled) {
  require_lattice(travelled >= 0, "a front has travelled a distance >= 0");
  return std::cbrt(std::abs(impact_dispersion(medium, d)) * travelled * d.hx * d.hx / 8);
}

}  // namespace diptych::analytic
