// Artificial viscosity: a stress that resists the rate of strain, so that a front spreads over some cells and does not
// ring.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace diptych::material {

/// The two forms in use. By eq. 22 they act in compression alone; codes that damp expansion as well are had by
/// `always`, for which linear theory is exact.
struct Viscosity {
  enum class Form {
    york,             ///< eq. 21 as York, Sulsky & Schreyer (IJNME 48, 2000, eq. 24) have it
    linear_quadratic  ///< ρ(c₁ c h |D| + c₂ h² D²) of other codes (Bardenhagen & Kober, CMES 5, 2004, eq. 45)
  };
  Form form = Form::york;
  double c1 = 1, c2 = 1;                ///< ≥ 0
  double bulk = 0.75;                   ///< λ of eq. 21, a pure number there
  double length = std::numbers::sqrt2;  ///< g of eq. 21 in cells
  bool always = false;                  ///< also in expansion

  /// False where its coefficients give no stress, whatever the rate of strain.
  bool gives_stress() const { return (c1 != 0 || c2 != 0) && (form != Form::york || (bulk != 0 && length != 0)); }
  bool acts(double D) const { return D < 0 || (always && D > 0); }  // eq. 22

  /// Whether the largest |D| of all points where it acts must be known first.
  bool needs_largest() const { return form == Form::york && c2 != 0; }

  /// q [Pa], tension positive: of the sign of D. D: velocity gradient [1/s]; largest: see above [1/s]; density [kg/m³];
  /// speed: the wave speed c_max [m/s] (york: the largest of all materials, else the point's own); h: cell [m].
  /// Both printed forms of eq. 21 are no stress; ρ λ c_max g D is, and it alone gives York's own figure 6.
  double stress(double D, double largest, double density, double speed, double h) const {
    if (!acts(D)) return 0;
    if (form == Form::linear_quadratic) return density * h * D * (c1 * speed + c2 * h * std::abs(D));
    const double relative = largest > 0 ? std::abs(D) / largest : 0;
    return density * bulk * speed * length * h * D * (c1 + c2 * relative);
  }

  /// Largest ν/(c h), ν = q/(ρ D): what limits the time step. jump: largest difference of velocities to expect [m/s].
  double strength(double speed, double jump) const {
    return form == Form::york ? bulk * length * (c1 + c2) : c1 + c2 * jump / speed;
  }
};

/// The viscosity that a run has to build up: null where none is written, and where what is written gives no stress, so
/// that a zero costs what nothing costs.
inline const Viscosity* acting(const std::optional<Viscosity>& written) {
  return written && written->gives_stress() ? &*written : nullptr;
}

}  // namespace diptych::material
