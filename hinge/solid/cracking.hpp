// A solid that cracks in tension: eqs. 23a–d, and eqs. 24 to 28 where cracks diffuse.
#pragma once

#include <optional>
#include <stdexcept>

#include "hinge/diffusion/damage_evolution.hpp"
#include "hinge/material/compression.hpp"
#include "hinge/material/tensile_damage.hpp"

namespace diptych::solid {

/// The law says how fast cracks come (eq. 23a) and how much they soften (eqs. 23b–d), the evolution where they go.
struct Cracking {
  static constexpr const char* feature = "damage";
  static constexpr const char* name = "tensile damage";

  material::TensileDamage law;
  diffusion::Evolution evolution = {};
  std::optional<material::Compression> compression = {};  ///< plane strain only

  const material::PlaneElastic& elastic() const { return law.elastic; }  ///< the whole solid
  double stiffening() const { return 1; }                                ///< damage only softens
  bool diffuses() const { return evolution.diffusion.has_value(); }
  void check() const {
    if (!(law.crack_coefficient() >= 0)) throw std::invalid_argument("the crack coefficient must be >= 0");
    material::check_cone(law.elastic, compression);
  }

  class Model;  ///< hinge/solid/cracking_model.hpp
};

}  // namespace diptych::solid
