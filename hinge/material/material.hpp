// What a bar's material point does, as pointwise functions of (state, strain increment).
//
// A law knows no particle and no element. Its State is what one point carries; both solvers keep an
// array of State in cell order, so a point's history is read and written in one stream. The law is
// chosen once, outside every loop, with std::visit.
#pragma once

#include <cmath>
#include <limits>
#include <variant>
#include <vector>

namespace diptych::material {

/// What a point answers to a strain increment.
struct Response {
  double stress;      ///< after the increment [Pa]
  double stored;      ///< recoverable energy per volume after the increment [J/m³]
  double dissipated;  ///< energy per volume turned to heat by this increment, ≥ 0 [J/m³]
  double wave_speed;  ///< of a further small increment in the same direction [m/s]
};

/// Linear elasticity in uniaxial stress: σ = E ε.
struct Elastic {
  double youngs_modulus;  ///< E [Pa], > 0
  double density;         ///< ρ [kg/m³], > 0

  struct State {
    double stress = 0;  ///< σ [Pa], tension positive
  };

  static constexpr const char* model = "elastic";    ///< what case files call it
  static constexpr const char* feature = "elastic";  ///< what a run with it reports
  static constexpr bool yields = false;
  double elastic_wave_speed() const { return std::sqrt(youngs_modulus / density); }
  double stored(const State& state) const { return state.stress * state.stress / (2 * youngs_modulus); }

  Response update(State& state, double strain_increment) const {
    state.stress += youngs_modulus * strain_increment;
    return {state.stress, stored(state), 0, elastic_wave_speed()};
  }
};

/// Bilinear plasticity with isotropic hardening in uniaxial stress (paper, Figs. 8–11): the stress rises with E up to
/// the yield stress and with the tangent modulus E_t beyond it; E_t = 0 is perfect plasticity. The return is exact:
/// the plastic strain increment is (|σ_trial| − σ_y) / (E + H) with the plastic modulus H = E E_t / (E − E_t).
struct Hardening {
  double youngs_modulus;   ///< E [Pa], > 0
  double density;          ///< ρ [kg/m³], > 0
  double tangent_modulus;  ///< E_t [Pa], 0 ≤ E_t < E
  double yield_stress;     ///< initial yield stress [Pa], > 0

  struct State {
    double stress = 0;    ///< σ [Pa], tension positive
    double hardened = 0;  ///< rise of the yield stress since the start [Pa], ≥ 0
  };

  static constexpr const char* model = "hardening";
  static constexpr const char* feature = "plasticity";
  static constexpr bool yields = true;
  double elastic_wave_speed() const { return std::sqrt(youngs_modulus / density); }
  double plastic_modulus() const { return youngs_modulus * tangent_modulus / (youngs_modulus - tangent_modulus); }
  double stored(const State& state) const { return state.stress * state.stress / (2 * youngs_modulus); }

  Response update(State& state, double strain_increment) const {
    const double trial = state.stress + youngs_modulus * strain_increment;
    const double yield = yield_stress + state.hardened;
    const double excess = std::abs(trial) - yield;
    if (excess <= 0) {
      state.stress = trial;
      return {trial, stored(state), 0, elastic_wave_speed()};
    }
    const double plastic = excess / (youngs_modulus + plastic_modulus());  // |Δε_p|
    const double rise = plastic_modulus() * plastic;
    state.hardened += rise;
    state.stress = std::copysign(yield + rise, trial);
    // The flow stress rises linearly over the increment, so its mean times |Δε_p| is the exact plastic work.
    const double work = (yield + rise / 2) * plastic;
    return {state.stress, stored(state), work, std::sqrt(tangent_modulus / density)};
  }
};

using Material = std::variant<Elastic, Hardening>;

inline const char* model(const Material& m) {
  return std::visit([](const auto& law) { return law.model; }, m);
}
inline const char* feature(const Material& m) {
  return std::visit([](const auto& law) { return law.feature; }, m);
}
inline double youngs_modulus(const Material& m) {
  return std::visit([](const auto& law) { return law.youngs_modulus; }, m);
}
inline double density(const Material& m) {
  return std::visit([](const auto& law) { return law.density; }, m);
}
inline double wave_speed(const Material& m) {
  return std::visit([](const auto& law) { return law.elastic_wave_speed(); }, m);
}

/// The laws of several bodies as one type, so that none is asked for inside a loop: elastic ones beside others become
/// hardening ones that never yield, which answer with the same bits.
inline std::variant<std::vector<Elastic>, std::vector<Hardening>> laws(const std::vector<Material>& materials) {
  std::vector<Elastic> elastic;
  std::vector<Hardening> hardening;
  for (const Material& m : materials) {
    if (const auto* law = std::get_if<Elastic>(&m)) {
      elastic.push_back(*law);
      hardening.push_back({law->youngs_modulus, law->density, 0, std::numeric_limits<double>::infinity()});
    } else {
      hardening.push_back(std::get<Hardening>(m));
    }
  }
  if (elastic.size() == materials.size()) return elastic;
  return hardening;
}

}  // namespace diptych::material
