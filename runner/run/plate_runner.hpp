// One run of a plate, measured.
#pragma once

#include "reports/results.hpp"
#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"
#include "runner/run/runner.hpp"

namespace diptych::runner {

/// What a run of the case will be, before it is run.
reports::Run describe_plate(const Case&, const Leaf&);
reports::Run run_plate(const Case&, const Leaf&, const TimeStep&, const Running&);
TimeStep plate_step(const Case&, const Leaf&);
/// Why the case's exact solution is not to be trusted, or nothing.
std::string doubt_plane_exact(const Case&);

}  // namespace diptych::runner
