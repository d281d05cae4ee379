// Scenes that several tests use.
#pragma once

#include <cmath>

#include "hinge/scene/scene.hpp"
#include "tests/steps.hpp"

namespace diptych::tests {

/// The paper's bar: L = 1, E = 1e4, ρ = 1, c = 100, fixed on the left, a tensile step of 1 on the right.
inline Scene step_scene(double traction = 1) {
  Scene scene;
  scene.bars[0].length = 1;
  scene.bars[0].material = material::Elastic{1e4, 1};
  scene.left = Support::fixed;
  Load load;
  load.end = End::right;
  load.mean_traction = [traction](double, double) { return traction; };
  scene.loads.push_back(load);
  return scene;
}

/// Steps at a Courant number on `cells` cells, sampled at the end.
inline Stepping steps_at(double courant, int cells, long steps) { return steps_of(courant * 0.01 / cells, steps); }

}  // namespace diptych::tests
