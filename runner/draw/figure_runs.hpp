// What figures of bars and of plates have in common: which run they draw, and how it is called.
#pragma once

#include <string>
#include <vector>

#include "reports/results.hpp"
#include "runner/input/case.hpp"

namespace diptych::runner {

/// The completed run that the figure draws of a method and, of a plate, of a variant; null where there is none.
const reports::Run* find_run(const std::vector<reports::Run>&, const FigureSpec&, const std::string& method,
                             const std::string& variant = "");
std::string name_of_method(const std::string& method);    ///< "FEM", "MPM, MUSL"
std::string kind_of_method(const std::string& method);    ///< "fem" or "mpm", as figures tell them apart
std::string family_of_method(const std::string& method);  ///< "FEM" or "MPM"
std::string title_of(const Case&, const FigureSpec&);     ///< "Fig. 4. ..." for "fig4"
std::string table_cell(double value, int digits = 3);     ///< a dash for what is no finite number
void widen(reports::Figure&, const reports::Curve&);      ///< the range of y, to hold what is finite of the curve
void take_range(const FigureSpec&, reports::Figure&);     ///< of y, where the case file gives it
/// Lines under a plate figure's title: the scene, what the diffusion is read as, and what the paper leaves open.
std::vector<std::string> plate_notes(const Case&, const FigureSpec&);

}  // namespace diptych::runner
