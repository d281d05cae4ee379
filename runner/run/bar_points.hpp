// All fields of bars at an instant, with the exact ones beside them.
#pragma once

#include <vector>

#include "analytic/exact.hpp"
#include "hinge/step/record.hpp"
#include "reports/bar_fields.hpp"
#include "runner/input/span.hpp"

namespace diptych::runner {

/// At each kind of points that the method has, in the order displacement, velocity, stress: nodes and elements (whose
/// stress is that of their middle), or particles. `exact` may be null; on a front it promises no mean of both sides.
std::vector<reports::BarPoints> bar_points(const Snapshot&, bool elements, const analytic::ExactSolution* exact,
                                           const std::vector<Span>& bars);

}  // namespace diptych::runner
