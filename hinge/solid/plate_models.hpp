// The models of all solids: for what is compiled once for each of them. What only names solids includes
// plate_solid.hpp, so that a law can be changed without all of it being built again.
#pragma once

#include <utility>
#include <variant>

#include "hinge/solid/cone.hpp"
#include "hinge/solid/cracking_model.hpp"
#include "hinge/solid/elastic_model.hpp"
#include "hinge/solid/failing_model.hpp"
#include "hinge/solid/plate_solid.hpp"

namespace diptych::solid {

/// Calls f<Model>() with the model of whatever the solid is.
template <class F>
decltype(auto) with_model(const PlateSolid& solid, F&& f) {
  return std::visit([&](const auto& one) -> decltype(auto) { return with_model(one, f); }, solid);
}

}  // namespace diptych::solid
