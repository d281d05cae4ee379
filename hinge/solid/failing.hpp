// A solid that a failure wave runs through: the law of its dilatancy, and how this spreads.
#pragma once

#include <stdexcept>

#include "hinge/diffusion/dilatancy.hpp"
#include "hinge/material/failure_wave.hpp"

namespace diptych::solid {

/// Plane strain, and no plasticity in compression beside it. The spread is taken as it is: where there is an impact,
/// its face is for the caller to name.
struct Failing {
  static constexpr const char* feature = "failure-wave";
  static constexpr const char* name = "a failure wave";

  material::FailureWave law;
  diffusion::Spread spread = {};

  const material::PlaneElastic& elastic() const { return law.elastic; }  ///< the whole solid
  double stiffening() const { return law.stiffening(); }
  static bool diffuses() { return true; }
  void check() const {
    const auto refuse = [](bool wrong, const char* why) {
      if (wrong) throw std::invalid_argument(why);
    };
    refuse(law.elastic.plane == material::Plane::stress, "a failure wave is for plane strain only");
    refuse(!(law.threshold >= 0), "the threshold of a failure wave must be >= 0");
    refuse(!(law.most_converted >= 0 && law.most_converted <= 1),
           "the part of the shear energy that a failure wave converts lies between 0 and 1");
  }

  class Model;  ///< hinge/solid/failing_model.hpp
};

}  // namespace diptych::solid
