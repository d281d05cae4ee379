// The solid of a plate that does not change.
#pragma once

#include <optional>

#include "hinge/material/compression.hpp"
#include "hinge/material/plane.hpp"

namespace diptych::solid {

struct Elastic {
  static constexpr const char* feature = "elastic";
  static constexpr const char* name = "an elastic solid";

  material::PlaneElastic law;
  std::optional<material::Compression> compression = {};  ///< plane strain only

  const material::PlaneElastic& elastic() const { return law; }  ///< the whole solid
  double stiffening() const { return 1; }
  void check() const { material::check_cone(law, compression); }

  class Model;  ///< hinge/solid/elastic_model.hpp
};

}  // namespace diptych::solid
