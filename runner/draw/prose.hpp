// Prose of a case file in which numbers of the case stand by their names: "E = {E} GPa".
#pragma once

#include <map>
#include <string>

#include "runner/input/case.hpp"
#include "runner/input/toml_table.hpp"

namespace diptych::runner {

/// Names that the case's prose may put in braces, each with the number that stands there. Of a plate with a material:
/// E [GPa], nu, rho [kg/m³]; of one that fails: threshold [GPa], threshold_stress, the longitudinal stress in uniaxial
/// strain that meets it [GPa], f_max, d0 [m²/s]; of one that a flyer strikes: velocity [m/s].
std::map<std::string, std::string> numbers_of(const Case&);

/// A text, with those numbers put in. An unknown name is a mistake that tells the known ones.
Rule<std::string> prose(const Case&);

}  // namespace diptych::runner
