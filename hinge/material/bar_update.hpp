// How the laws of bars answer to an increment of strain, for the loops that they are built into.
#pragma once

#include <cmath>

#include "hinge/material/material.hpp"

namespace diptych::material {

inline Response Elastic::update(State& state, double strain_increment) const {
  state.stress += youngs_modulus * strain_increment;
  return {state.stress, stored(state), 0, elastic_wave_speed()};
}

inline Response Hardening::update(State& state, double strain_increment) const {
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

}  // namespace diptych::material
