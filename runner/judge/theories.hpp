// The theories that gates measure against.
#pragma once

#include <string>

#include "runner/input/case.hpp"
#include "runner/input/toml_table.hpp"

namespace diptych::runner {

/// What a `constant` gate of this case may be measured against.
Names theories(const Case&);
/// Notes where a theory of a `constant` gate says nothing of its quantity, of the case's exact solution or of a method.
void check_theory(const Place& predict, const std::string& theory, const GateSpec&, const Case&);
/// What only theory of the scheme predicts needs a panel of which there is one: notes each method that has none.
void check_scheme_theory(const Place& predict, const std::string& theory, const GateSpec&, const Case&);

}  // namespace diptych::runner
