// What figures and pages of a plate that a flyer strikes have in common.
#pragma once

#include <string>
#include <vector>

#include "reports/results.hpp"
#include "runner/input/case.hpp"
#include "runner/input/toml_table.hpp"

namespace diptych::runner {

/// Notes a case without gauges, whose histories the figure's kind needs.
void need_gauges(Table&, const Case&, const FigureSpec&);
/// The plate of a variant on a mesh.
PlateSpec plate_of(const Case&, const std::string& variant, int cells);
std::string viscosity_words(const PlateSpec&);
/// Lines under the title: the scene, the model, the mesh, and what the paper leaves open.
std::vector<std::string> struck_notes(const Case&, const FigureSpec&, const PlateSpec&);
/// Of the run; NaN where there is no run or it has not measured this.
double measure(const reports::Run*, const std::string& name);

}  // namespace diptych::runner
