// Explicit finite elements in two dimensions: rectangular cells of four constant-strain triangles, lumped mass, central
// differences.
#pragma once

#include <optional>

#include "hinge/diffusion/damage_evolution.hpp"
#include "hinge/diffusion/dilatancy.hpp"
#include "hinge/scene/plate.hpp"
#include "hinge/scene/scene.hpp"

namespace diptych::fem {

/// 2/ω of the stiffest mode of the free mesh, exact up to 6 × 6 cells; of a larger one the corner of so many cells is
/// looked at, which no assembly of such pieces, however it is held, exceeds (Rayleigh quotient): at most 0.3 % below
/// its own limit. For square cells at ν = 0.3 that is 0.578 h/c_d in plane strain and 0.568 in plane stress, of a
/// single cell 0.553 and 0.547; of the interior alone it would be higher, 0.588 and 0.574 [s].
///
/// Of a failure wave the limit is that of the stiffest tangent that its law has in uniaxial strain, see
/// FailureWave::stiffening. With artificial viscosity, which lags half a step, it is what viscous_time_step leaves.
double critical_time_step(const Plate&, const Cells&);

/// Runs the plate. `evolution` is needed with TensileDamage, and only then; `spread` with FailureWave, and only then:
/// it is taken as it is, so that where there is an impact its face is for the caller to name. The two sides of an
/// impact are bonded from the start, whatever the gap. Throws std::invalid_argument for a scene that FEM cannot take.
PlateRecord run(const Plate&, const Cells&, const std::optional<diffusion::Evolution>& evolution, const Stepping&,
                const std::optional<diffusion::Spread>& spread = std::nullopt);

}  // namespace diptych::fem
