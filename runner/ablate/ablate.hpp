// What each feature of a case is worth: the case with it and without, beside how uncertain its numbers are.
#pragma once

#include <string>

#include "reports/ablation_results.hpp"
#include "runner/input/case.hpp"
#include "runner/run/run_leaf.hpp"

namespace diptych::runner {

/// How the study is made.
struct AblationPlan {
  std::string scene;    ///< of the case, as runs are labelled: variant and swept parameters; empty: the first
  int cells = 0;        ///< of the mesh on which is compared; 0: the finest within the budget
  double budget = 5e8;  ///< updates of unknowns, about so many, of all runs together
  int rounds = 0;       ///< in which the compared runs are timed
};

/// Takes each declared feature off in turn, and adds in turn what the scene lacks and its result might notice.
reports::AblationStudy ablate(const Case&, const AblationPlan&, const Running&);

}  // namespace diptych::runner
