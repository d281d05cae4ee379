// Corners of a plate, whose node belongs to two sides.
#pragma once

#include "runner/input/case.hpp"
#include "runner/input/toml_table.hpp"

namespace diptych::runner {

/// Refuses a driven side beside a fixed one or a roller that holds their corner in the direction in which it is driven,
/// at the start, at a sample time or half way to it, in a run or a variant: one node cannot do both.
void check_corners(const Place& supports, const Case&);

}  // namespace diptych::runner
