// Runs that cases have in common are made once, and those that a store has are not made again.
#pragma once

#include <string>

#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"
#include "runner/run/run_leaf.hpp"

namespace diptych::runner {

/// All that a run can see of its case, in words: the scene as cases/gates.lock keeps it but for the axes, of which the
/// leaf is one point; what gates, figures and tables have kept or run beside it. Runs of equal words have equal results
/// but for the case's id and the seconds they took.
std::string words_of_run(const Case& of_leaf, const Leaf&, const Running&);

}  // namespace diptych::runner
