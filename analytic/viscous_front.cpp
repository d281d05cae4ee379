#include "analytic/viscous_front.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "analytic/bar_wave.hpp"
#include "analytic/parameters.hpp"

namespace diptych::analytic {
namespace {

using std::numbers::pi;

void require_viscous(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(message);
}

/// √(2νt). Viscosity of u_tt = c² u_xx + ν u_xxt diffuses a wave of one direction with ν/2, and ½ erfc(x/√(4·ν/2·t)) is
/// how a step diffuses.
double spread(double viscosity, double t) {
  require_viscous(positive(viscosity), "viscous front: viscosity must be > 0");
  require_viscous(positive(t), "viscous front: time must be > 0");
  return std::sqrt(2 * viscosity * t);
}

constexpr double to_a_tenth = 0.9061938024368232;                                   // ½ erfc of this is 1/10
const double square_of_both_sides = (2 - std::numbers::sqrt2) / std::sqrt(pi) / 2;  // 2 ∫₀^∞ (½ erfc)²

bool steps_only(const BarWave& bar) {
  for (const auto* end : {&bar.parameters().left, &bar.parameters().right})
    for (const auto& kink : end->traction.kinks)
      if (kink.slope != 0) return false;
  return true;
}

/// The fronts, where all are smoothed and each stands by itself.
std::optional<std::vector<Front>> smoothed_fronts(const BarWave& bar, double viscosity, double t) {
  const auto& p = bar.parameters();
  std::size_t entered = 0;
  for (const auto* end : {&p.left, &p.right})
    for (const auto& kink : end->traction.kinks)
      if (kink.jump != 0 && kink.time <= t) ++entered;
  auto fronts = bar.fronts(t);
  if (fronts.empty() || fronts.size() != entered) return std::nullopt;
  // A front meets the other end first, and if that is held its own, which is not, one length later.
  const double until_free_end = (p.left.fixed || p.right.fixed ? 2 : 1) * p.length;
  double last = 0, last_room = 0;
  for (const auto& front : fronts) {
    if (!(front.stress_jump < 0) || !(front.travelled < until_free_end)) return std::nullopt;
    const double room = 4 * spread(viscosity, front.travelled / bar.wave_speed()), x = front.position;
    if (std::min({x, p.length - x, front.travelled}) < room) return std::nullopt;
    if (&front != &fronts.front() && x - last < 2 * std::max(room, last_room)) return std::nullopt;
    last = x, last_room = room;
  }
  return fronts;
}

}  // namespace

// A wave exp(ikx), s = sin(kh/2), C the Courant number. With v and σ/(ρc), the strain rate of a cell being 2is v/h, a
// step of FEM is
//   v′ = v + 2iCs σ − 4c₁Cs² v    (q/(ρc) = 2is c₁ v)
//   σ′ = σ + 2iCs v′
// with trace 2 − 4C²s² − 4c₁Cs² and determinant 1 − 4c₁Cs². Both eigenvalues lie in the unit circle as long as
// 1 + trace + determinant ≥ 0, that is C²s² + 2c₁Cs² ≤ 1 (then the determinant is above −1 too), and s ≤ 1 = 1/C₀.
//
// USF and MUSL put s² (1 − a s²) for s², as force and velocity pass through particles, whose greatest value is 1/C₀²;
// so does a lone end cell, with its own number. Hence C² + 2c₁C ≤ C₀².
//
// USL strains its cells with the grid's velocity w′ = v + 2iCs(σ + 2is c₁ w), of which particles keep
// v′ = α v + (1 − α) w′, α = a s². With b = 4c₁Cs² and p = 4C²s² the eigenvalues λ of (v, σ, w) are the roots of
//   λ³ + (b + p − 2) λ² + (1 − b(1 + α) − pα) λ + bα.
// Of Jury's conditions for λ³ + a₂λ² + a₁λ + a₀, 1 + a₂ + a₁ + a₀ = p(1 − α) ≥ 0 always holds;
// 1 − a₂ + a₁ − a₀ ≥ 0 is (1 + α)(p + 2b) ≤ 4, worst at s = 1: (1 + a)(C² + 2c₁C) ≤ 1 = (1 + a) C₀²; and
// 1 − a₀² ≥ |a₁ − a₀a₂| follows from it, as bα ≤ 2α/(1 + α) does. USL's end cell is this with 4Cs·Cs put for C²/S,
// 1 − α for g, of the names in stability_limit of discrete.cpp: (2 − g)(C² + 2c₁C)/S ≤ 4 = (2 − g) C₀²/S.
double viscous_stability_limit(double inviscid_limit, double c1) {
  require_viscous(positive(inviscid_limit), "viscous_stability_limit: the inviscid limit must be > 0");
  require_viscous(std::isfinite(c1) && c1 >= 0, "viscous_stability_limit: c1 must be >= 0");
  return inviscid_limit * inviscid_limit / (std::hypot(c1, inviscid_limit) + c1);  // no cancellation for large c₁
}

double viscous_front(double ahead, double viscosity, double t) { return std::erfc(ahead / spread(viscosity, t)) / 2; }

double viscous_front_width(double viscosity, double t) { return 2 * to_a_tenth * spread(viscosity, t); }

double viscous_front_l1(double viscosity, double t) { return spread(viscosity, t) / std::sqrt(pi); }

double viscous_front_l2(double viscosity, double t) { return std::sqrt(square_of_both_sides * spread(viscosity, t)); }

std::optional<double> viscous_step_error(const ExactSolution& solution, double viscosity, BarQuantity quantity,
                                         Norm norm, double t) {
  require_viscous(positive(viscosity), "viscous_step_error: viscosity must be > 0");
  require_viscous(std::isfinite(t), "viscous_step_error: time must be finite");
  const auto* bar = dynamic_cast<const BarWave*>(&solution);
  if (!bar || !steps_only(*bar) || quantity == BarQuantity::displacement || norm == Norm::linf) return std::nullopt;
  const auto fronts = smoothed_fronts(*bar, viscosity, t);
  if (!fronts) return std::nullopt;
  const double unit = quantity == BarQuantity::stress ? 1 : 1 / (bar->parameters().density * bar->wave_speed());
  double sum = 0;
  for (const auto& front : *fronts) {
    const double jump = std::abs(front.stress_jump) * unit, since = front.travelled / bar->wave_speed();
    sum += norm == Norm::l1 ? jump * viscous_front_l1(viscosity, since)
                            : std::pow(jump * viscous_front_l2(viscosity, since), 2);
  }
  const double mean = sum / bar->parameters().length;
  return norm == Norm::l1 ? mean : std::sqrt(mean);
}

}  // namespace diptych::analytic
