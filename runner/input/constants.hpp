// What expressions of a case may name.
#pragma once

#include <map>
#include <string>

#include "runner/input/case.hpp"

namespace diptych::runner {

/// Besides x, y and t the case's [parameters] and pi; of bars L, E, rho and c = sqrt(E/rho), those of the first; of a
/// plate Lx and Ly, with a material E, nu, rho, c, c_d and c_s.
std::map<std::string, double> expression_constants(const Case&);

}  // namespace diptych::runner
