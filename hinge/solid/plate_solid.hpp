// What a plate can be made of. Whoever adds a law adds it here; the panels are built anew for each entry.
#pragma once

#include <utility>
#include <variant>

#include "hinge/material/compression.hpp"
#include "hinge/material/plane.hpp"
#include "hinge/solid/cracking.hpp"
#include "hinge/solid/elastic.hpp"
#include "hinge/solid/failing.hpp"

namespace diptych {

// CMake reads the names off this line.
using PlateSolid = std::variant<solid::Elastic, solid::Cracking, solid::Failing>;

/// The whole solid.
inline const material::PlaneElastic& elastic(const PlateSolid& solid) {
  return std::visit([](const auto& s) -> const material::PlaneElastic& { return s.elastic(); }, solid);
}

namespace solid {

/// Calls f<Model>() with the model of a solid: its own, or that with the cone.
template <class Solid, class F>
decltype(auto) with_model(const Solid& solid, F&& f) {
  static_assert(PlaneModel<typename Solid::Model>);
  if constexpr (requires { solid.compression; }) {
    static_assert(PlaneModel<WithCone<typename Solid::Model>>);
    if (solid.compression) return std::forward<F>(f).template operator()<WithCone<typename Solid::Model>>();
  }
  return std::forward<F>(f).template operator()<typename Solid::Model>();
}

/// Calls f<Model>() with the model of whatever the solid is.
template <class F>
decltype(auto) with_model(const PlateSolid& solid, F&& f) {
  return std::visit([&](const auto& one) -> decltype(auto) { return with_model(one, f); }, solid);
}

}  // namespace solid

inline const char* feature_of(const PlateSolid& solid) {
  return std::visit([](const auto& s) { return s.feature; }, solid);
}
/// Null without plasticity in compression.
inline const material::Compression* compression_of(const PlateSolid& solid) {
  return std::visit(
      [](const auto& s) -> const material::Compression* {
        if constexpr (requires { s.compression; })
          if (s.compression) return &*s.compression;
        return nullptr;
      },
      solid);
}
/// Whether what changes in its cells diffuses.
inline bool diffuses(const PlateSolid& solid) {
  return std::visit(
      [](const auto& s) {
        if constexpr (requires { s.diffuses(); }) return s.diffuses();
        return false;
      },
      solid);
}
/// Whether artificial viscosity may stand beside it.
inline bool takes_viscosity(const PlateSolid& solid) {
  return solid::with_model(solid, []<class Model>() { return Model::takes_viscosity; });
}
/// Whether something changes in its cells, which particles that cross cells would leave behind.
inline bool changes_in_cells(const PlateSolid& solid) {
  return solid::with_model(solid, []<class Model>() { return Model::staggered; });
}

}  // namespace diptych
