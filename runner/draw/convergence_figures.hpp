// What a plate's readings do under refinement, as figures and in words.
#pragma once

#include <string>
#include <vector>

#include "reports/results.hpp"
#include "runner/input/case.hpp"

namespace diptych::runner {

/// Of a plate's probe as in "radius of C_d = 0.05 at 45°", and its unit, as in "m".
std::string words_of(const PlateProbe&);
std::string unit_of(const PlateProbe&);

/// The figure's probes over the cell size, a panel each, at its one time: both methods with their uncertainties
/// (uncertainty.hpp) and what they extrapolate to.
reports::Figure convergence_figure(const Case&, const FigureSpec&, const std::vector<reports::Run>&);

/// One sentence: how far the radii, areas and totals on the figure's mesh are from those on the finest that was run, at
/// most over its methods and times. Empty where there is nothing to compare.
std::string distance_from_settled(const Case&, const FigureSpec&, const std::vector<reports::Run>&);

/// The load of rupture over the cell size, read from a sweep: with a tracked rate and a fixed one.
reports::Figure rupture_figure(const Case&, const FigureSpec&, const std::vector<reports::Run>&);

}  // namespace diptych::runner
