// Values read at one point of the bar.
#pragma once

#include "hinge/step/record.hpp"
#include "reports/results.hpp"
#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"

namespace diptych::runner {

/// The field's value at the probe. A stress probe in the end cell of a loaded end also gets the stress that theory
/// predicts there once the end is at rest or in uniform motion: the traction times the part of it that reaches the end
/// node (all of it for a nodal traction).
reports::ProbeValue read_probe(const Case&, const Leaf&, const Probe&, const Snapshot&);

}  // namespace diptych::runner
