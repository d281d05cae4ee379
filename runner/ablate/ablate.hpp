// What each feature of a case is worth: the case with it and without, beside how uncertain its numbers are.
#pragma once

#include <string>
#include <vector>

#include "reports/ablation_results.hpp"
#include "runner/ablate/features.hpp"
#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"
#include "runner/run/run_leaf.hpp"

namespace diptych::runner {

/// How the study is made.
struct AblationPlan {
  std::string scene;    ///< of the case, as runs are labelled: variant and swept parameters; empty: the first
  int cells = 0;        ///< of the mesh on which is compared; 0: the finest within the budget
  double budget = 5e8;  ///< updates of unknowns, predicted, of all runs together
  int rounds = 0;       ///< in which the compared runs are timed
};

/// One setting of the case that is looked at, with its meshes from coarse to fine; on the last one is compared.
struct AblatedSetting {
  Leaf leaf;  ///< on the last mesh
  std::vector<int> meshes;
};

/// One setting of each method of the scene: that with the most meshes, the first of several. A single mesh is joined by
/// one of half as many cells. Throws InputError where the scene is none of the case's.
std::vector<AblatedSetting> settings_of(const Case&, const AblationPlan&);

/// The scene of one setting on these meshes with keys of the file changed, read anew: one case without variants, gates
/// and figures. Throws InputError where it is no scene.
Case revised(const Case&, const Leaf&, const std::vector<int>& meshes, const Revision&, const std::string& name);

/// Takes each declared feature off in turn, and adds in turn what the scene lacks and its result might notice.
reports::AblationStudy ablate(const Case&, const AblationPlan&, const Running&);

}  // namespace diptych::runner
