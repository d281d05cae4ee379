// Explicit finite elements on bars: 2-node elements, one Gauss point, lumped mass, central differences.
#pragma once

#include "hinge/scene/scene.hpp"
#include "hinge/step/record.hpp"

namespace diptych::fem {

/// Largest stable time step of lumped 2-node elements [s]: the least h/c of the bars, and with artificial viscosity of
/// strength n = ν/(c h) that of C = √(1 + n²) − n.
double critical_time_step(const Scene&, int cells);

/// Runs the scene with `cells` equal elements in the first bar and elements as near to that size as possible in the
/// others. Fields of the snapshots: stress per element and displacement per node at the step's time, velocity per node
/// half a step before it. Strains are those of the reference configuration, so bars may fly any distance.
/// Throws std::invalid_argument for a boundary layer, which this method has not.
Record run(const Scene&, int cells, const Stepping&);

}  // namespace diptych::fem
