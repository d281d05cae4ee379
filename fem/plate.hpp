// Explicit finite elements in two dimensions: rectangular cells of four constant-strain triangles, lumped mass, central
// differences.
#pragma once

#include <optional>

#include "diffusion/damage_evolution.hpp"
#include "material/plate.hpp"
#include "material/scene.hpp"

namespace diptych::fem {

/// 2/ω of the stiffest mode of the free mesh, exact up to 6 × 6 cells; of a larger one the corner of so many cells is
/// looked at, which no assembly of such pieces, however it is held, exceeds (Rayleigh quotient): at most 0.3 % below
/// its own limit. For square cells at ν = 0.3 that is 0.578 h/c_d in plane strain and 0.568 in plane stress, of a
/// single cell 0.553 and 0.547; of the interior alone it would be higher, 0.588 and 0.574 [s].
double critical_time_step(const Plate&, const Cells&);

/// Runs the plate. `evolution` is needed with TensileDamage, and only then.
/// Throws std::invalid_argument for a scene that FEM cannot take.
PlateRecord run(const Plate&, const Cells&, const std::optional<diffusion::Evolution>& evolution, const Stepping&);

}  // namespace diptych::fem
