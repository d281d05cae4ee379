// [[gate]] of a case file.
#pragma once

#include "runner/input/case.hpp"
#include "runner/input/toml_table.hpp"

namespace diptych::runner {

/// One gate: the keys that all kinds have are read here, the others by its kind.
GateSpec read_gate(Table&, const Case&);
/// What only all gates of the case tell.
void check_gates(const Place&, const Case&);

}  // namespace diptych::runner
