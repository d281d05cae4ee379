// How small motions of a scene about rest grow with the steps, and up to which step theory says that they do not.
#pragma once

#include <atomic>
#include <optional>

#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"
#include "runner/stability/growth.hpp"

namespace diptych::runner {

// The case of both is the one that the leaf has: see case_of.

/// How small motions about rest grow at a Courant number (alone diffusing: at a diffusion number d Δt/h²). Throws
/// std::invalid_argument where the panel refuses the step.
Growth growth_about_rest(const Case&, const Leaf&, double number, long steps,
                         const std::atomic<bool>* cancelled = nullptr);

/// What theory says of the limit about rest, or nothing. Bars of 16 cells or more, of MPM with a free end where
/// particles leave its node the lesser part of their cell's mass; lagged viscosity after √(c1² + C0²) − c1. Plates:
/// with free sides the eigenvalues of this very mesh up to 100 cells, beyond that the lesser of 6 × 6 cells' and the
/// unbounded lattice's; on rollers all round, with 16 cells or more each way and particles that lie symmetrically in
/// them, the lattice's. Diffusion: forward Euler with one diffusivity.
std::optional<double> limit_about_rest(const Case&, const Leaf&);

}  // namespace diptych::runner
