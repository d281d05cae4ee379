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
/// of each combination. Without any it is the case itself with its gates. What of the change makes another scene, and
/// not another way to solve it, is Case::changed_scene.
std::vector<Case> with_values(const Case&, const std::vector<std::string>& over);

/// "1,2", or "8:64:4" by equal ratios or evenly spaced: whole numbers from 1. Throws InputError, of --over `key`.
std::vector<int> whole_numbers_in(const std::string& key, const std::string& text, bool by_ratio);

/// Whether a key of a case's file belongs to how its scene is solved and not to the scene: cases that differ in such
/// keys alone may be compared.
bool is_numerical(const std::string& key);
inline constexpr const char* numerical_keys =
    "viscosity, diffusion.scheme and .drift, transfer and thickness of a load, plate.cell_aspect, model.pic";

}  // namespace diptych::runner
