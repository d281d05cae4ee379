// The settings of a case that are looked at, and their scenes with keys of the file changed.
#pragma once

#include <string>
#include <vector>

#include "runner/ablate/features.hpp"
#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"

namespace diptych::runner {

/// One setting of the case that is looked at, with its meshes from coarse to fine; on the last one is compared.
struct AblatedSetting {
  Leaf leaf;  ///< on the last mesh
  std::vector<int> meshes;
};

/// One setting of each method of the scene, which is the first where it is empty: that with the most meshes, the first
/// of several. `finest`: the last mesh; 0: the case's. A single mesh is joined by one of half as many cells. Throws
/// InputError where the scene is none of the case's.
std::vector<AblatedSetting> settings_of(const Case&, const std::string& scene, int finest);

/// The scene of one setting on these meshes with keys of the file changed, read anew: one case without variants, gates
/// and figures. Throws InputError where it is no scene.
Case revised(const Case&, const Leaf&, const std::vector<int>& meshes, const Revision&, const std::string& name);

}  // namespace diptych::runner
