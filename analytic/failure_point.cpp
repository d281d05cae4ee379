#include "analytic/failure_point.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "analytic/parameters.hpp"

namespace diptych::analytic {
namespace {

using real = long double;

void require_point(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(std::string("failure point: ") + message);
}

/// Energies of the solid before it fails [J/m³] and its pressure.
struct Whole {
  real K, pressure, shear_energy;

  /// What the pressure's energy has grown by.
  real raised(real dilatancy) const {
    const real p = pressure + K * dilatancy;
    return (p - pressure) * (p + pressure) / (2 * K);
  }
};

struct Ceiling {
  Whole whole;
  real paid;  ///< f_max W

  static double missing(double dilatancy, void* self) {
    const auto& c = *static_cast<const Ceiling*>(self);
    return static_cast<double>((c.whole.raised(dilatancy) - c.paid) / c.paid);
  }
};

/// The V_d at which the pressure's energy has grown by f_max W, of what is compressed.
double ceiling(const Whole& whole, real f_max) {
  Ceiling c{whole, f_max * whole.shear_energy};
  if (!(whole.pressure > 0 && c.paid > 0)) return 0;
  // the least that can be gained by V_d is K V_d²/2
  const double high = static_cast<double>(std::sqrt(2 * c.paid / whole.K)) * (1 + 1e-15);
  gsl_function f{Ceiling::missing, &c};
  const std::unique_ptr<gsl_root_fsolver, void (*)(gsl_root_fsolver*)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), gsl_root_fsolver_free);
  double root = std::nan("");
  if (solver && gsl_root_fsolver_set(solver.get(), &f, 0, high) == GSL_SUCCESS) {
    for (int i = 0; i < 200; ++i) {
      if (gsl_root_fsolver_iterate(solver.get()) != GSL_SUCCESS) break;
      root = gsl_root_fsolver_root(solver.get());
      if (gsl_root_test_interval(gsl_root_fsolver_x_lower(solver.get()), gsl_root_fsolver_x_upper(solver.get()), 0,
                                 1e-15) == GSL_SUCCESS)
        break;
    }
  }
  return root;
}

}  // namespace

FailurePoint failure_point(double K, double G, double exx, double eyy, double exy, double V_d, double f_max) {
  require_point(positive(K) && positive(G), "K and G must be > 0");
  require_point(std::isfinite(exx) && std::isfinite(eyy) && std::isfinite(exy), "the strain must be finite");
  require_point(std::isfinite(V_d) && V_d >= 0, "the dilatancy must be finite and >= 0");
  require_point(f_max >= 0 && f_max <= 1, "f_max must lie between 0 and 1");

  const real middle = (real{exx} + eyy) / 2, across = (real{exx} - eyy) / 2, radius = std::hypot(across, real{exy});
  const std::array<real, 3> e{middle + radius, middle - radius, 0};
  const real trace = e[0] + e[1];
  const auto square = [](real x) { return x * x; };
  const real W = real{G} / 3 * (square(e[0] - e[1]) + square(e[1] - e[2]) + square(e[2] - e[0]));
  const Whole whole{K, -K * trace, W};

  const real raised = whole.raised(V_d);
  real f = 0;
  if (raised > 0) f = raised >= f_max * W ? real{f_max} : raised / W;
  const real left = (1 - f) * W, p = whole.pressure + K * V_d;

  // The deviator's principal values go as those of the strain's; their squares add up to 4G (1 − f) W.
  std::array<real, 3> s{};
  real length = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    s[i] = e[i] - trace / 3;
    length += s[i] * s[i];
  }
  const real size = length > 0 ? std::sqrt(4 * G * left / length) : 0;
  for (real& value : s) value *= size;
  const real mean = (s[0] + s[1]) / 2, half = (s[0] - s[1]) / 2;
  const real cosine = radius > 0 ? across / radius : 1, sine = radius > 0 ? exy / radius : 0;  // of twice the angle

  const auto plain = [](real x) { return static_cast<double>(x); };
  return {plain(p),
          plain(mean + half * cosine - p),
          plain(mean - half * cosine - p),
          plain(s[2] - p),
          plain(half * sine),
          plain(f),
          plain(p * p / (2 * K) + left),
          ceiling(whole, f_max),
          plain(std::sqrt(6 * G * W))};
}

UniaxialFailure::UniaxialFailure(double K, double G) : K_(K), G_(G) {
  require_point(positive(K) && positive(G), "K and G must be > 0");
  require_point(K > 2 * G / 3, "K must be > 2G/3 for the lateral stress to be compressive");
}

double UniaxialFailure::pressure(double f) const {
  if (!(f >= 0 && f <= 1)) throw std::domain_error("uniaxial failure: f must lie between 0 and 1");
  return std::sqrt(1 + f * 4 * G_ / (3 * K_));
}

double UniaxialFailure::longitudinal(double f) const {
  return (K_ * pressure(f) + 4 * G_ / 3 * std::sqrt(1 - f)) / (K_ + 4 * G_ / 3);
}

double UniaxialFailure::lateral(double f) const {
  return (K_ * pressure(f) - 2 * G_ / 3 * std::sqrt(1 - f)) / (K_ - 2 * G_ / 3);
}

double UniaxialFailure::dilatancy(double f) const { return pressure(f) - 1; }

double UniaxialFailure::longitudinal_slope(double f) const {
  return 2 * G_ / 3 * (1 / pressure(f) - 1 / std::sqrt(1 - f));
}

double UniaxialFailure::lateral_slope(double f) const { return G_ / 3 * (2 / pressure(f) + 1 / std::sqrt(1 - f)); }

double UniaxialFailure::elastic_ratio() const { return (K_ - 2 * G_ / 3) / (K_ + 4 * G_ / 3); }

}  // namespace diptych::analytic
