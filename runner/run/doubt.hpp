// Whether an exact solution is to be trusted: its own test, by residual.
#pragma once

#include <string>

#include "analytic/exact.hpp"
#include "runner/input/case.hpp"

namespace diptych::runner {

/// Why an exact solution whose own test finds this residual is not to be trusted, or nothing. NaN is not.
std::string doubt(double residual);

/// The same of the exact solution that is one for all runs of a case, or of one of a plate's variants.
std::string doubt_exact(const Case&);

/// The same of a run's own solution, where bars meet at a time of the run's own, tested up to time `end` [s].
std::string doubt_own(const Case&, const analytic::ExactSolution*, double end);

}  // namespace diptych::runner
