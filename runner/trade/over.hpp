// --over: more values of a case's axes than its file has.
#pragma once

#include <string>
#include <vector>

#include "runner/input/case.hpp"

namespace diptych::runner {

/// Adds the values of "courant=0.1:0.95:8" (from, to, how many: evenly spaced, cells by equal ratios), "cells=20,40",
/// "particles=1,2" (so many in each direction of a cell, evenly spaced), "position=0.1,0.3" (a cell's one particle,
/// from 0 to 1 along each of its sides), "method=fem,mpm-musl" or of a parameter of the case to the axes of each of its
/// blocks. Runs above a limit are then allowed: they are points of their own. Throws InputError where a key or a value
/// is not one, with what is allowed and the nearest.
void add_values(Case&, const std::vector<std::string>& over);

/// The same, where a key may also be one of the case's file, as list --declarations writes it: "material.nu=0.3,0.49",
/// "diffusion.scheme=rkl2,implicit". Such a key makes a case of each value, which reads its file anew; several make one
/// of each combination. Without any it is the case itself with its gates.
std::vector<Case> with_values(const Case&, const std::vector<std::string>& over);

}  // namespace diptych::runner
