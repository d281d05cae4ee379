// Runs that cases have in common are made once.
#pragma once

#include <optional>
#include <string>

#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"
#include "runner/run/run_leaf.hpp"

namespace diptych::runner {

/// All that a run of a plate can see of its case, in words: the scene as cases/gates.lock keeps it but for the axes, of
/// which the leaf is one point; what gates and tables have kept or run beside it. Runs of equal words have equal
/// results but for the case's id. Nothing where runs are not shared: of bars, which are cheap and whose figures keep
/// what they draw, of variants, and of cases whose file's keys were changed.
std::optional<std::string> words_of_run(const Case& of_leaf, const Leaf&, const Running&);

}  // namespace diptych::runner
