// The material point method in two dimensions: 4-node cells (eq. 7), lumped mass, USF, USL and MUSL.
#pragma once

#include <vector>

#include "hinge/scene/plate.hpp"
#include "hinge/scene/scene.hpp"
#include "mpm/bar.hpp"

namespace diptych::mpm {

/// Largest stable step of a plate whose particles stand in every cell at positions × positions (natural coordinates in
/// [0, 1]) [s]: the least of the interior's limit and of that of the plate itself, free and as it is held, or where it
/// has more than eight cells along a side, of a part of it. A part of PIC lowers it. Convected particles: USF and MUSL
/// get the interior's least over all arrangements, that of particles on the nodes; USL has none above zero, and the
/// value for the positions at the start is given. As on the bar that is necessary and not enough: crossing feeds energy
/// in, and a free side that has just entered a cell has nodes with next to no mass. Of a law that stiffens the limit is
/// that of its stiffest tangent, see FailureWave::stiffening. Artificial viscosity lowers it as a stiffer solid would,
/// see viscous_time_step: all three schemes leave the unit circle at −1 where K + 2C/Δt is too stiff; that USL leaves
/// it nowhere before is seen in runs, not shown.
double critical_time_step(const Plate&, const Cells&, const std::vector<double>& positions, Scheme);

/// Runs the plate. At most 8 × 8 particles a cell. Time levels are the bar's: with MUSL and USL strain, stress and
/// displacement stand at the step's time and velocity half a step before it; with USF velocity stands at the step's
/// time, strain and stress half a step before and displacement half a step after it. Snapshots give the particles in
/// the order of their cells, each cell's row by row. The books' momentum and impulse are the components along (1,
/// 1)/√2; their `scheme` is what mapping takes: USL's, that of particles that move, PIC's, and what a driven side does
/// to particles that do not follow it exactly. A corner of two driven sides goes with the first of them in the order of
/// Side; a platen's end node with a fixed or driven side beside it.
///
/// Artificial viscosity: eq. 21 with D the trace of each particle's velocity gradient, of the velocities that strain
/// it, c_max = c_d and cells of √(hx hy). What it takes has the books' viscous line.
///
/// Impact: in front of a gap each body has nodes of its own at the face, and before step 0 the flyer flies on in whole
/// steps, without loads, until it is as near as it gets. Then the two columns of nodes share one velocity, as bodies in
/// one grid do: no slip, and they do not part again. The grid is not reset: it has gone with the material.
///
/// With convected particles a gauge reads the ones that started in its cells.
///
/// Throws std::invalid_argument for a plate that `check` refuses and for what MPM alone cannot take: a part of PIC
/// beyond [0, 1]; convected with what changes in cells, an impact, viscosity, tractions, or a driven side or platen; an
/// impact with a driven side or platen below or above, with a gap that takes more than 1e7 steps or in front of a flyer
/// that is held.
PlateRecord run(const Plate&, const Cells&, const std::vector<double>& positions, Scheme, const Stepping&);

}  // namespace diptych::mpm
