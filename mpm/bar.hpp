// The material point method on bars: particles carry the state, a background grid of 2-node cells solves eq. 18.
#pragma once

#include <vector>

#include "hinge/scene/scene.hpp"
#include "hinge/step/record.hpp"

namespace diptych::mpm {

/// When the stress is updated: first, last, or last with the nodal velocities mapped once more from the particles.
enum class Scheme { usf, usl, musl };

/// Largest stable time step of bars with free ends [s]: closed forms for particles at natural coordinates ξ of every
/// cell, the least of all bars. Convected particles sweep all of ξ: then the least over the sweep for USF and MUSL; USL
/// has no lower bound there, and the value for the positions at the start is given. That is necessary and not enough:
/// linear shape functions feed energy into waves whenever particles cross cells, at any time step
/// (bar.convection.crossing). Artificial viscosity of strength n = ν/(c h) makes a Courant number C into √(C² + n²) −
/// n.
double critical_time_step(const Scene&, int cells, const std::vector<double>& positions, Scheme);

/// Runs the scene with equal-mass particles at natural coordinates `positions` (each in [0, 1], ascending) of every one
/// of `cells` equal cells of the first bar, and of cells of that size in the others; a bar may begin anywhere in the
/// grid. Snapshots: stress per particle over its share of its cell, velocity and displacement per particle. With MUSL
/// and USL stress and displacement stand at the step's time and velocity half a step before it; with USF velocity
/// stands at the step's time, stress half a step before and displacement half a step after it. Strains are those of the
/// reference configuration, as in FEM. Throws std::invalid_argument where a bar is not a whole number of cells long, or
/// a wall at the right end is not a whole number of cells from the left end of the first bar.
Record run(const Scene&, int cells, const std::vector<double>& positions, Scheme, const Stepping&);

}  // namespace diptych::mpm
