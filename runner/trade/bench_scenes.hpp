// Scenes whose steps are timed: whatever they are to show goes on in every cell and from the first step to the last.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runner/panel.hpp"

namespace diptych::runner {

struct BenchScene {
  std::string id;
  std::string says;                          ///< what goes on
  std::function<Plate(const Cells&)> plate;  ///< of so many cells
  std::function<Scene()> bars = {};          ///< instead of it, where plates have no such thing
  bool of_particles = false;                 ///< makes no difference to a mesh
};

const std::vector<BenchScene>& bench_scenes();

}  // namespace diptych::runner
