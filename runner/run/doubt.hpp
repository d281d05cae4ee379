// Whether an exact solution is to be trusted: its own test, by residual.
#pragma once

#include <string>

#include "analytic/exact.hpp"
#include "runner/input/case.hpp"

namespace diptych::runner {

/// Why the exact solution that is one for all runs of a case is not to be trusted, or nothing. One's own expressions
/// are taken at their word.
std::string doubt_exact(const Case&);

/// The same of a run's own solution, tested up to time `end` [s].
std::string doubt_own(const analytic::ExactSolution*, double end);

}  // namespace diptych::runner
