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
bool takes_viscosity(const PlateSolid&);
/// Whether something changes in its cells, which particles that cross cells would leave behind.
bool changes_in_cells(const PlateSolid&);

}  // namespace diptych
