// From what a run samples to lines that can be drawn.
#pragma once

#include <string>
#include <vector>

#include "analytic/exact.hpp"
#include "hinge/step/record.hpp"
#include "reports/results.hpp"
#include "runner/compare/norms.hpp"
#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"

namespace diptych::runner {

const Field& field_of(const Snapshot&, analytic::BarQuantity);

/// Whether some figure draws the run and needs it to keep this.
bool drawn(const Case&, const Leaf&, bool Recorded::*what);

/// As the method knows the field: an element's stress over the element, a particle's at the particle. Bars that move
/// are drawn where they are; between two bars the line breaks.
reports::Curve polyline(const Snapshot&, analytic::BarQuantity, const Leaf&, bool moves);

/// The exact field on a line fine enough to draw, broken at its fronts and between bars. On a front nothing is read:
/// two that pass each other just now would draw a spike of no width.
reports::Curve exact_line(const analytic::ExactSolution&, analytic::BarQuantity, const std::vector<Span>& bars,
                          double time, bool moves);

/// The steps at which motion figures want to know where the bars are: evenly over the run, and over what they magnify.
std::vector<long> steps_of_motion(const Case&, const Leaf&, const Stepping&);

/// The paths of both ends of every bar and of three points between: `paths` and `exact_paths` of the run.
void trace_paths(const std::vector<Snapshot>&, const Scene&, const analytic::ExactSolution* exact, reports::Run&);

}  // namespace diptych::runner
