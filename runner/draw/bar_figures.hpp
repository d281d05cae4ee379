// What figures of bars have in common.
#pragma once

#include <string>
#include <vector>

#include "reports/results.hpp"
#include "runner/input/case.hpp"

namespace diptych::runner {

std::string length_unit(const Case&);  ///< "m"; "paper's units"
/// Parameters under the title: of the runs, of the bars, and which of them the paper leaves open. The bars' speeds are
/// of times that count from contact, unless these are `of_the_scene`, all methods' together.
std::vector<std::string> bar_notes(const Case&, const FigureSpec&, bool of_the_scene = false);
/// A figure with its names and notes, and no panel.
reports::Figure bar_figure(const Case&, const FigureSpec&, std::vector<std::string> notes);
/// Makes the axis hold every x of its curves, with 2 % of room on either side.
void fit_x(reports::Figure&);

}  // namespace diptych::runner
