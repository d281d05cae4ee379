// What a bar's material point does, as pointwise functions of (state, strain increment).
//
// A law knows no particle and no element. Its State is what one point carries; both solvers keep an
// array of State in cell order, so a point's history is read and written in one stream. The law is
// chosen once, outside every loop, with std::visit.
//
// How they answer, their `update`, stands in bar_update.hpp, which only loops include: it can be changed without all
// that names a law being built again. A new law is a struct that is a BarLaw and its name in Material, both here, and
// its row in runner/input/bar_file.cpp, which reads it.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>
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

/// A parameter beside E and ρ, as pages name it: {"E_t =", 2500}.
struct Parameter {
  const char* words;
  double value;
};

/// Factors from one system of units to another.
struct Factors {
  double modulus, stress, density;
};

/// A curve of first loading with slope E up to the yield stress and E_t beyond it, unloading with slope E and hardening
/// isotropically. Infinite: a straight line.
struct Bilinear {
  double yield_stress = std::numeric_limits<double>::infinity();  ///< [Pa], > 0
  double tangent_modulus = 0;                                     ///< E_t [Pa], ≥ 0
};

struct Elastic;

/// What every law has. One whose curve of first loading is straight or bilinear has also `Bilinear bilinear() const`,
/// which the exact solutions of impacts need; they refuse the others.
template <class L>
concept BarLaw = requires(const L law, typename L::State state, const Elastic elastic, double strain_increment,
                          const Factors by) {
  { L::model } -> std::convertible_to<const char*>;    // its name in case files
  { L::feature } -> std::convertible_to<const char*>;  // what a run with it reports
  { L::yields } -> std::convertible_to<bool>;          // whether it dissipates; else its stress is linear in the strain
  { state.stress } -> std::same_as<double&>;           // [Pa], tension positive; initial stresses are put there
  { law.youngs_modulus } -> std::convertible_to<double>;
  { law.density } -> std::convertible_to<double>;
  { law.elastic_wave_speed() } -> std::same_as<double>;
  { law.stored(state) } -> std::same_as<double>;
  { law.update(state, strain_increment) } -> std::same_as<Response>;
  { law.parameters() } -> std::same_as<std::vector<Parameter>>;
  { law.scaled(by) } -> std::same_as<L>;
  { L::of_elastic(elastic) } -> std::same_as<L>;  // an elastic bar under this law, with the same bits
};

/// Linear elasticity in uniaxial stress: σ = E ε.
struct Elastic {
  double youngs_modulus;  ///< E [Pa], > 0
  double density;         ///< ρ [kg/m³], > 0

  struct State {
    double stress = 0;  ///< σ [Pa], tension positive
  };

  static constexpr const char* model = "elastic";
  static constexpr const char* feature = "elastic";
  static constexpr bool yields = false;
  static Elastic of_elastic(const Elastic& elastic) { return elastic; }
  std::vector<Parameter> parameters() const { return {}; }
  Elastic scaled(const Factors& by) const { return {youngs_modulus * by.modulus, density * by.density}; }
  Bilinear bilinear() const { return {}; }
  double elastic_wave_speed() const { return std::sqrt(youngs_modulus / density); }
  double stored(const State& state) const { return state.stress * state.stress / (2 * youngs_modulus); }

  inline Response update(State&, double strain_increment) const;
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
  static Hardening of_elastic(const Elastic& elastic) {
    return {elastic.youngs_modulus, elastic.density, 0, std::numeric_limits<double>::infinity()};
  }
  std::vector<Parameter> parameters() const { return {{"E_t =", tangent_modulus}, {"yield stress", yield_stress}}; }
  Hardening scaled(const Factors& by) const {
    return {youngs_modulus * by.modulus, density * by.density, tangent_modulus * by.modulus, yield_stress * by.stress};
  }
  Bilinear bilinear() const { return {yield_stress, tangent_modulus}; }
  double elastic_wave_speed() const { return std::sqrt(youngs_modulus / density); }
  double plastic_modulus() const { return youngs_modulus * tangent_modulus / (youngs_modulus - tangent_modulus); }
  double stored(const State& state) const { return state.stress * state.stress / (2 * youngs_modulus); }

  inline Response update(State&, double strain_increment) const;
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

inline bool yields(const Material& m) {
  return std::visit([](const auto& law) { return law.yields; }, m);
}
inline std::vector<Parameter> parameters(const Material& m) {
  return std::visit([](const auto& law) { return law.parameters(); }, m);
}
inline Material scaled(const Material& m, const Factors& by) {
  return std::visit([&](const auto& law) { return Material(law.scaled(by)); }, m);
}
/// Nothing where the law's curve of first loading is no such curve.
template <class... Law>
std::optional<Bilinear> bilinear(const std::variant<Law...>& m) {
  return std::visit(
      [](const auto& law) -> std::optional<Bilinear> {
        if constexpr (requires { law.bilinear(); }) return law.bilinear();
        return std::nullopt;
      },
      m);
}

/// Calls f.template operator()<Law>() for each law there is, in the order of Material.
template <class F>
void for_each_law(F&& f) {
  [&]<class... Law>(std::type_identity<std::variant<Law...>>) {
    (f.template operator()<Law>(), ...);
  }(std::type_identity<Material>{});
}

/// The laws of several bodies as one type, so that none is asked for inside a loop: elastic ones beside others become
/// ones of the others' law that never yield, which answer with the same bits. Throws std::invalid_argument where there
/// are two laws beside the elastic one.
template <class... Law>
std::variant<std::vector<Law>...> laws(const std::vector<std::variant<Law...>>& materials) {
  static_assert((BarLaw<Law> && ...));
  std::variant<Law...> common = Elastic{};
  for (const auto& m : materials) {
    if (std::holds_alternative<Elastic>(m)) continue;
    if (!std::holds_alternative<Elastic>(common) && common.index() != m.index())
      throw std::invalid_argument("bars of two laws that are not elastic; allowed: one such law, beside elastic bars");
    common = m;
  }
  return std::visit(
      [&]<class Common>(const Common&) -> std::variant<std::vector<Law>...> {
        std::vector<Common> all;
        for (const auto& m : materials) {
          const auto* law = std::get_if<Common>(&m);
          all.push_back(law ? *law : Common::of_elastic(std::get<Elastic>(m)));
        }
        return all;
      },
      common);
}

}  // namespace diptych::material
