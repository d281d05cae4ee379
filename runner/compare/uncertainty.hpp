// How far two histories are apart, and how uncertain a number is that was found on several meshes.
#pragma once

#include <cstddef>
#include <vector>

namespace diptych::runner {

/// A quantity over time, linear between its samples; times ascend.
struct History {
  std::vector<double> time, value;
};

/// Sprague & Geers (2003): magnitude M = √(∫f²/∫g²) − 1, phase P = (1/π) arccos(∫fg/√(∫f² ∫g²)) in [0, 1], combined
/// √(M² + P²).
struct SpragueGeers {
  double magnitude = 0, phase = 0, combined = 0;
};

/// Of a history against a reference over the time that both cover; the integrals are exact for lines between samples.
/// NaN where either vanishes over that time or has a NaN in it. Throws std::invalid_argument where they share no time.
SpragueGeers sprague_geers(const History&, const History& reference);

/// What a quantity's error is taken to be as a function of the cell size h.
enum class ErrorModel {
  power,   ///< α h^p with the order p fitted
  first,   ///< α h
  second,  ///< α h²
  mixed    ///< α₁ h + α₂ h²
};

/// Discretisation uncertainty by the least-squares procedure of Eça & Hoekstra, J. Comput. Phys. 262 (2014) 104–130. A
/// band that is meant to hold the exact value in 95 of 100 cases: a judgement from experience, neither a bound nor a
/// statistic of the data at hand. It is weakest on the finest mesh: errors h and h² of equal size and sign look like
/// one power between, and the band there is up to one eighth too narrow.
struct Uncertainty {
  double extrapolated = 0;               ///< φ₀, the fitted value at h = 0
  double order = 0;                      ///< p of the power fit; NaN if least squares has no minimum at 1/20 < p < 10
  ErrorModel model = ErrorModel::power;  ///< whose fit the band is from
  bool weighted = false;                 ///< by 1/h; else every level alike
  double deviation = 0;                  ///< σ, standard deviation of the fit
  double range = 0;                      ///< Δφ = (largest − least value)/(levels − 1), the data range parameter
  double safety = 0;                     ///< F_s: 1.25 where 0.5 ≤ p ≤ 2.1 and σ < Δφ, else 3
  std::vector<double> band;              ///< U of each level, in the order given: |value − exact| ≤ U is expected

  double of(std::size_t level) const { return band.at(level); }
};

inline constexpr std::size_t levels_for_uncertainty = 4;

/// At least so many levels with cell sizes that are positive and differ; throws std::invalid_argument otherwise. A
/// value that is not finite makes every number NaN; values that are all equal make every band 0.
Uncertainty discretisation_uncertainty(const std::vector<double>& cell_size, const std::vector<double>& value);

}  // namespace diptych::runner
