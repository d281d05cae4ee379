#include "analytic/discrete.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "analytic/bar_wave.hpp"
#include "analytic/standing_mode.hpp"

namespace diptych::analytic {
namespace {

using std::numbers::pi;

// A scheme without dissipation obeys u_t + c u_x + β u_xxx = 0, β = c h² (1 + 3a − C²)/24, to leading order. Its answer
// to a step is ∫_ξ^∞ Ai, ξ = (x − ct)/w, w = (3βt)^(1/3) (Hedstrom, SIAM J. Numer. Anal. 12, 1975; Chin & Hedstrom,
// Math. Comp. 32, 1978). By Parseval the squares of the error and of its integral over x are, in units of w and w³,
// (4/π)∫₀^∞ sin²(κ³/6) κ⁻² dκ = 3^(1/6) Γ(2/3)/π and (4/π)∫₀^∞ sin²(κ³/6) κ⁻⁴ dκ = 1/9; that integral has its largest
// value, −Ai′(0) = 1/(3^(1/3) Γ(1/3)), on the front.
constexpr double airy_step_square = 0.5176388075856136;
constexpr double airy_kink_square = 1.0 / 9;
constexpr double airy_kink_sup = 0.25881940379280680;

void check_discretisation(const Discretisation& d) {
  const auto require = [](bool condition, const char* message) {
    if (!condition) throw std::invalid_argument(std::string("discretisation: ") + message);
  };
  require(std::isfinite(d.cell) && d.cell > 0, "cell size must be > 0");
  require(std::isfinite(d.courant) && d.courant > 0, "Courant number must be > 0");
  if (d.scheme == Scheme::fem) return;
  require(!d.positions.empty(), "a cell needs at least one particle");
  require(std::all_of(d.positions.begin(), d.positions.end(), [](double xi) { return xi >= 0 && xi <= 1; }),
          "positions must lie in [0, 1]");
}

double square(double x) { return x * x; }

/// The filter alone, for where the Courant number is what is sought.
double filter(const Discretisation& d) {
  if (d.scheme == Scheme::fem) return 0;
  double sum = 0;
  for (const double xi : d.positions) sum += 4 * xi * (1 - xi);
  return sum / static_cast<double>(d.positions.size());
}

/// USL's waves are overdamped beyond this: both eigenvalues are real.
bool overdamped(double courant, double a, double s) { return (square(courant) + a) * square(s) >= 1; }

bool jumps_only(const BarWave& bar) {
  for (const auto* end : {&bar.parameters().left, &bar.parameters().right})
    for (const auto& kink : end->traction.kinks)
      if (kink.slope != 0) return false;
  return true;
}

/// Mean square of the error of a bar under steps, mode by mode. Reflected at its ends the bar is part of an unbounded
/// lattice. There a force whose first kick is half a step's yields û = (1 − cos(nω_hΔt))/(2s²), s = sin(kh/2), as the
/// recurrence u″ + ω_h² u = const has it, and the exact solution, sampled at nodes while its fronts are at nodes, the
/// same with ω for ω_h; fronts between nodes give what linear interpolation between nodes does. A finite bar has the
/// values kh of its modes. Stress is û times 2s, and constant in a cell, which the exact one is not if a front is in
/// it. Particles see nodal values interpolated, of whose square 1 − a s² is left in the mean; so do lines drawn between
/// samples, and 1 − 2s²/3 is left for one sample a cell. USL damps the cosine, but for terms of O(kh)². USF has whole
/// kicks and n half-way between integers, and so cos(nω_hΔt)/cos(ω_hΔt/2).
std::optional<double> step_error_square(const BarWave& bar, const Discretisation& d, BarQuantity quantity, double t) {
  const auto& p = bar.parameters();
  const double count = std::round(p.length / d.cell), step = d.courant * d.cell / bar.wave_speed(), a = filter(d);
  if (!(count >= 1) || std::abs(count * d.cell - p.length) > 1e-6 * d.cell) return std::nullopt;
  const bool held = p.left.fixed || p.right.fixed, stress = quantity == BarQuantity::stress;
  const double per_cell = d.scheme == Scheme::fem ? 1 : static_cast<double>(d.positions.size());
  double sum = 0;
  for (double m = 1; m <= count; ++m) {
    const double theta = (held ? m - 0.5 : m) * pi / count, s = std::sin(theta / 2);
    const auto [phase, damping] = step_factor(d, theta);
    const bool wave = d.scheme != Scheme::mpm_usl || !overdamped(d.courant, a, s);  // overdamped, none is left
    const double kick = d.scheme == Scheme::mpm_usf ? std::cos(phase / 2) : 1;
    double error = 0;
    const auto add = [&](const Traction& traction, double shape) {
      for (const auto& kink : traction.kinks) {
        if (t <= kink.time) continue;
        const double steps = (t - kink.time) / step, node = std::floor(d.courant * steps);
        const double beyond = d.courant * steps - node;
        const double exact = (1 - beyond) * std::cos(node * theta) + beyond * std::cos((node + 1) * theta);
        const double numerical = wave ? std::exp(-damping * steps) * std::cos(phase * steps) / kick : 0;
        error += shape * kink.jump * (numerical - exact);
      }
    };
    add(p.left.traction, -1);  // tension pulls this end back
    add(p.right.traction, held || std::fmod(m, 2) == 0 ? 1 : -1);
    const double alone = !held && m == count ? 0.5 : 1;  // kh = π is its own mirror image
    const double filtered = (1 - a * s * s) * (1 - 2 * square(s / per_cell) / 3);
    const double weight = stress ? 1 : square(d.cell / p.youngs_modulus / (2 * s)) * filtered;
    sum += alone * square(error) / (2 * s * s) * weight;
  }
  sum /= count;
  if (stress) {
    for (const auto& front : bar.fronts(t)) {
      const double within = front.position / d.cell - std::floor(front.position / d.cell);
      sum += square(front.stress_jump) * within * (1 - within);
    }
  }
  return sum / count;
}

/// The fronts, where each stands by itself: as many as have entered, none within `apart` widths of another or within
/// `clear` of an end or of where it entered.
std::optional<std::vector<Front>> separate_fronts(const BarWave& bar, const Discretisation& d, double t) {
  constexpr double apart = 10, clear = 6;
  const auto& p = bar.parameters();
  std::size_t entered = 0;
  for (const auto* end : {&p.left, &p.right})
    for (const auto& kink : end->traction.kinks)
      if (kink.jump != 0 && kink.time <= t) ++entered;
  auto fronts = bar.fronts(t);
  if (fronts.size() != entered) return std::nullopt;
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    const double w = front_width(d, fronts[i].travelled), x = fronts[i].position;
    if (w < d.cell) return std::nullopt;  // a front within a cell is not governed by a differential equation
    if (std::min({x, p.length - x, fronts[i].travelled}) < clear * w) return std::nullopt;
    if (i > 0 && x - fronts[i - 1].position < apart * std::max(w, front_width(d, fronts[i - 1].travelled)))
      return std::nullopt;
  }
  return fronts;
}

std::optional<double> bar_wave_error(const BarWave& bar, const Discretisation& d, BarQuantity quantity, Norm norm,
                                     double t) {
  if (quantity == BarQuantity::velocity || !jumps_only(bar)) return std::nullopt;
  if (norm == Norm::l2) {
    const auto mean_square = step_error_square(bar, d, quantity, t);
    return mean_square ? std::optional(std::sqrt(*mean_square)) : std::nullopt;
  }
  return airy_step_error(bar, d, quantity, norm, t);
}

double standing_mode_error(const StandingMode& mode, const Discretisation& d, BarQuantity quantity, Norm norm,
                           double t) {
  const double omega = mode.wave_speed() * mode.wave_number();
  const double steps = t * mode.wave_speed() / (d.courant * d.cell);
  const auto [phase, damping] = step_factor(d, mode.wave_number() * d.cell);
  const double decay = std::exp(-damping * steps), numerical = phase * steps, exact = omega * t;
  const double error = quantity == BarQuantity::velocity ? decay * std::cos(numerical) - std::cos(exact)
                                                         : decay * std::sin(numerical) - std::sin(exact);
  // means of |φ|^p over whole quarter waves
  const double shape = norm == Norm::l1 ? 2 / pi : norm == Norm::l2 ? 1 / std::numbers::sqrt2 : 1;
  return std::abs(error) * mode.scale(quantity) * shape;
}

}  // namespace

double particle_filter(const Discretisation& d) {
  check_discretisation(d);
  return filter(d);
}

StepFactor step_factor(const Discretisation& d, double theta) {
  check_discretisation(d);
  if (!(theta >= 0 && theta <= pi * (1 + 1e-12))) throw std::invalid_argument("step_factor: kh must lie in [0, pi]");
  const double a = filter(d), s = std::sin(theta / 2), cs = d.courant * s;
  if (d.scheme != Scheme::mpm_usl) {
    const double half = cs * std::sqrt(std::max(0.0, 1 - a * s * s));  // sin(ω_h Δt/2)
    if (half <= 1) return {2 * std::asin(half), 0};
    return {pi, -2 * std::acosh(half)};
  }
  // λ = 1 − 2C²s² ± 2Cs √((C² + a)s² − 1)
  const double middle = 1 - 2 * cs * cs;
  if (!overdamped(d.courant, a, s))
    return {std::atan2(2 * cs * std::sqrt(1 - (square(d.courant) + a) * s * s), middle),
            -std::log1p(-4 * a * square(cs * s)) / 2};
  const double spread = 2 * cs * std::sqrt((square(d.courant) + a) * s * s - 1);
  const double lambda = middle < 0 ? middle - spread : middle + spread;  // the one that lasts
  return {lambda < 0 ? pi : 0, -std::log(std::abs(lambda))};
}

double stability_limit(const Discretisation& d) {
  check_discretisation(d);
  if (d.scheme == Scheme::fem) return 1;
  double mean = 0, variance = 0;
  for (const double xi : d.positions) mean += xi;
  mean /= static_cast<double>(d.positions.size());
  for (const double xi : d.positions) variance += square(xi - mean);
  variance /= static_cast<double>(d.positions.size());
  const double a = filter(d), spread = mean * (1 - mean);
  // An end cell is least held when alone. With D the difference of its mapped nodal velocities and g = var/spread,
  //   USL: σ′ = σ + (EΔt/h)(D − Δtσ/(ρh spread)), D′ = D − Δtσg/(ρh spread); USF and MUSL: leapfrog in D and σ with
  // (ωΔt)² = C²g/spread. The limits are det = 1 or trace + det = −1 of these, which is 4 − C²(2 − g)/spread = 0 for
  // USL and (ωΔt)² = 4 for USF and MUSL.
  if (d.scheme == Scheme::mpm_usl) {
    const double g = spread > 0 ? variance / spread : 0;
    return std::min(1 / std::sqrt(1 + a), 2 * std::sqrt(spread / (2 - g)));
  }
  const double q = a > 0.5 ? 1 / (2 * a) : 1;
  const double end_cell = variance > 0 ? 2 * spread / std::sqrt(variance) : std::numeric_limits<double>::infinity();
  return std::min(1 / std::sqrt(q * (1 - a * q)), end_cell);
}

double front_width(const Discretisation& d, double travelled) {
  check_discretisation(d);
  if (!(travelled >= 0)) throw std::invalid_argument("front_width: a front has travelled a distance >= 0");
  return std::cbrt(std::abs(1 + 3 * filter(d) - square(d.courant)) * travelled * square(d.cell) / 8);
}

std::optional<double> airy_step_error(const ExactSolution& solution, const Discretisation& d, BarQuantity quantity,
                                      Norm norm, double t) {
  const auto* bar = dynamic_cast<const BarWave*>(&solution);
  const bool stress = quantity == BarQuantity::stress;
  if (!bar || !jumps_only(*bar) || d.scheme == Scheme::mpm_usl || quantity == BarQuantity::velocity)
    return std::nullopt;
  if (norm == Norm::l1 || (norm == Norm::linf && stress)) return std::nullopt;
  const auto fronts = separate_fronts(*bar, d, t);
  if (!fronts) return std::nullopt;
  const auto& p = bar->parameters();
  double square_sum = 0, sup = 0;
  for (const auto& front : *fronts) {
    const double w = front_width(d, front.travelled), strain = std::abs(front.stress_jump) / p.youngs_modulus;
    square_sum +=
        stress ? airy_step_square * w * square(front.stress_jump) : airy_kink_square * w * w * w * square(strain);
    sup = std::max(sup, airy_kink_sup * strain * w);
  }
  return norm == Norm::l2 ? std::sqrt(square_sum / p.length) : sup;
}

std::optional<double> predicted_error(const ExactSolution& solution, const Discretisation& d, BarQuantity quantity,
                                      Norm norm, double t) {
  check_discretisation(d);
  if (!std::isfinite(t)) throw std::invalid_argument("predicted_error: time must be finite");
  if (const auto* bar = dynamic_cast<const BarWave*>(&solution)) return bar_wave_error(*bar, d, quantity, norm, t);
  if (const auto* mode = dynamic_cast<const StandingMode*>(&solution))
    return standing_mode_error(*mode, d, quantity, norm, t);
  return std::nullopt;
}

std::optional<double> expected_order(const ExactSolution& solution, Scheme scheme, BarQuantity quantity, Norm norm) {
  if (dynamic_cast<const StandingMode*>(&solution)) return 2;
  const auto* bar = dynamic_cast<const BarWave*>(&solution);
  if (!bar || !jumps_only(*bar)) return std::nullopt;
  const auto one_of = [norm](double l1, double l2, double linf) {
    return norm == Norm::l1 ? l1 : norm == Norm::l2 ? l2 : linf;
  };
  // w ~ h^(2/3), and the tail behind a front decays as |ξ|^(−3/4): it ends where group velocities do, after O(1), or
  // under the fourth-order dissipation of USL after O(h^(1/2)) (Brenner, Thomée & Wahlbin, Lecture Notes in
  // Mathematics 434, 1975).
  if (quantity == BarQuantity::stress) return one_of(scheme == Scheme::mpm_usl ? 5.0 / 8 : 1.0 / 2, 1.0 / 3, 0);
  if (quantity == BarQuantity::displacement) return one_of(4.0 / 3, 1, 2.0 / 3);
  return std::nullopt;
}

}  // namespace diptych::analytic
