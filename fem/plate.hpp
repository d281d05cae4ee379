// Explicit finite elements in two dimensions: rectangular cells of four constant-strain triangles, lumped mass, central
// differences.
#pragma once

#include "hinge/scene/plate.hpp"
#include "hinge/scene/scene.hpp"

namespace diptych::fem {

/// 2/ω of the stiffest mode of the free mesh, exact up to 6 × 6 cells; of a larger one the corner of so many cells is
/// looked at, which no assembly of such pieces, however it is held, exceeds (Rayleigh quotient): at most 0.3 % below
/// its own limit. For square cells at ν = 0.3 that is 0.578 h/c_d in plane strain and 0.568 in plane stress, of a
/// single cell 0.553 and 0.547; of the interior alone it would be higher, 0.588 and 0.574 [s].
///
/// Of a law that stiffens the limit is that of its stiffest tangent, see FailureWave::stiffening. With artificial
/// viscosity, which lags half a step, it is what viscous_time_step leaves.
double critical_time_step(const Plate&, const Cells&);

/// Runs the plate. The two sides of an impact are bonded from the start, whatever the gap. Throws std::invalid_argument
/// for a plate that `check` refuses or whose initial displacement bends a platen. The mesh goes with the material and
/// has no particles: `convected` and `pic` mean nothing here.
PlateRecord run(const Plate&, const Cells&, const Stepping&);

}  // namespace diptych::fem
