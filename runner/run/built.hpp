// The only place that asks a run for its kind of scene.
#pragma once

#include <utility>

#include "runner/run/bar_leaf.hpp"
#include "runner/run/diffusion_leaf.hpp"
#include "runner/run/plate_leaf.hpp"

namespace diptych::runner {

/// What `act` says of the leaf's scene. The case is the one that the leaf has: see case_of.
template <class Act>
auto built(const Case& c, const Leaf& leaf, Act&& act) {
  switch (kind_of(c)) {
    case SceneKind::plate: return act(PlateLeaf(c, leaf));
    case SceneKind::diffusion: return act(DiffusionLeaf(c, leaf));
    case SceneKind::bars: break;
  }
  return act(BarLeaf(c, leaf));
}

}  // namespace diptych::runner
