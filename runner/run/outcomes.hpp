// What came of an impact, in single numbers.
#pragma once

#include <vector>

#include "analytic/exact.hpp"
#include "hinge/scene/scene.hpp"
#include "hinge/step/record.hpp"
#include "reports/results.hpp"
#include "runner/compare/norms.hpp"

namespace diptych::runner {

/// Contact and release of the first two bars to touch, restitution, and plastic work, each as a measure of the run
/// beside what the exact solution says (".predicted") and how far it is off (".error": of times in durations of
/// contact, of plastic work in itself). What did not happen in both has no measure, and a gate on it is INVALID.
void measure_outcomes(const Scene&, const std::vector<Span>& bars, const Record&, double time_step,
                      const analytic::ExactSolution*, reports::Run&);

}  // namespace diptych::runner
