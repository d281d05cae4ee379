// What figures of fields on a plate have in common: their names, when they are drawn, and their contours.
#pragma once

#include <string>
#include <vector>

#include "reports/results.hpp"
#include "runner/compare/contours.hpp"
#include "runner/input/case.hpp"

namespace diptych::runner {

std::string in_ms(double seconds);                 ///< "t = 0.4 ms"
std::string symbol_of_damage(const std::string&);  ///< of the field "damage", D; of "crack-density", C_d
/// The fields that the run has at a sample time; null where there is no run or no such time.
const reports::PlateFields* fields_at(const reports::Run*, double time);
/// Contours of the field at these levels, drawn as those of a kind of method are.
void add_contours(const NodalMap&, const std::vector<double>& levels, const std::string& kind,
                  reports::PlateFigure::Panel&);
/// A figure on the plate with its names and notes, and no panel.
reports::PlateFigure blank_plate(const Case&, const FigureSpec&);

}  // namespace diptych::runner
