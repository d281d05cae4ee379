// Explicit finite elements on a bar: 2-node elements, one Gauss point, lumped mass, central differences.
#pragma once

#include "material/record.hpp"
#include "material/scene.hpp"

namespace diptych::fem {

/// Largest stable time step h/c of lumped 2-node elements [s].
double critical_time_step(const Scene&, int cells);

/// Runs the scene on `cells` equal elements. Fields of the snapshots: stress per element and displacement per node at
/// the step's time, velocity per node half a step before it.
/// Throws std::invalid_argument for a scene that needs what this method has not: convection or a boundary layer.
Record run(const Scene&, int cells, const Stepping&);

}  // namespace diptych::fem
