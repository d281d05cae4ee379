// The runs that `run` chooses from: each is compiled on its own.
#pragma once

#include <vector>

#include "hinge/scene/plate.hpp"
#include "hinge/scene/scene.hpp"
#include "mpm/plate.hpp"

namespace diptych::mpm {

/// What a run is made of; all of it outlives the run.
struct Setup {
  const Plate& plate;
  const Cells& cells;
  const std::vector<double>& positions;
  Scheme scheme;
  const Stepping& stepping;
};

/// Particles that keep their places, in a plate of this solid. In plate_solid.cpp.in.
template <class Solid>
PlateRecord run_standing(const Setup&, const Solid&);

/// Particles that move through the grid: of solids in whose cells nothing changes. In plate_moving.cpp.
PlateRecord run_moving(const Setup&);

}  // namespace diptych::mpm
