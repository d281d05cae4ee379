// One run of a plate, measured.
#pragma once

#include "cases/case.hpp"
#include "cases/leaf.hpp"
#include "cases/runner.hpp"
#include "reports/results.hpp"

namespace diptych::cases {

/// What a run of the case will be, before it is run.
reports::Run describe_plate(const Case&, const Leaf&);
reports::Run run_plate(const Case&, const Leaf&, const TimeStep&, const Running&);
TimeStep plate_step(const Case&, const Leaf&);
/// Why the case's exact solution is not to be trusted, or nothing.
std::string doubt_plane_exact(const Case&);

}  // namespace diptych::cases
