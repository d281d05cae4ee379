// What is read off the plate: fields at an instant, and gauges at every step.
#pragma once

#include "fem/plate_mesh.hpp"
#include "fem/plate_stress.hpp"
#include "hinge/scene/plate.hpp"

namespace diptych::fem {

/// Displacement and velocity of the nodes and stress of the triangles after step n.
PlateSnapshot sample_mesh(const Mesh&, const CellStress&, long n, double dt);

/// Mean stress of a cell, of pairs of triangles that change places in a mirror [Pa].
material::Tensor mean_stress(const Mesh&, const CellStress&, CellAt);

}  // namespace diptych::fem
