// What no panel can take of a plate: said once, for both.
#pragma once

#include "hinge/scene/plate.hpp"

namespace diptych {

/// Of a place along a grid of cells of this size: its coordinate in cells, exact on the middles and edges of cells but
/// for round-off.
double in_cells(double place, double cell);

/// Column of nodes at which flyer and target meet; of a plate that has been checked.
std::size_t impact_column(const Plate&, const Cells&);

/// Throws std::invalid_argument for a plate that no panel can take on these cells: no cells, a solid that contradicts
/// itself, viscosity beside what it is not for, an impact beside an initial state or whose face is no column of nodes,
/// a gauge outside, a driven side without a velocity, loads that do nothing, and a platen without nodes of its own.
void check(const Plate&, const Cells&);

}  // namespace diptych
