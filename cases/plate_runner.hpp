// One run of a plate, measured.
#pragma once

#include "cases/case.hpp"
#include "cases/leaf.hpp"
#include "cases/runner.hpp"
#include "reports/results.hpp"

namespace diptych::cases {

/// What a run of the case will be, before it is run.
reports::Run describe_plate(const Case&, const Leaf&);
reports::Run run_plate(const Case&, const Leaf&, const Running&);
/// The time step that the leaf asks for and the largest stable one [s], as Courant numbers c_d Δt/h of the smaller side
/// of a cell; of diffusion alone, as d Δt/h² with the largest diffusivity.
struct TimeStep {
  double asked, limit;  ///< [s]
  double unit;          ///< Δt of Courant number 1 [s]
};
TimeStep step_of(const Case&, const Leaf&);
/// Why the case's exact solution is not to be trusted, or nothing.
std::string doubt_plane_exact(const Case&);

}  // namespace diptych::cases
