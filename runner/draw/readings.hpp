// Readings of a plate's probes: what they are called, and what they do under refinement.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/results.hpp"
#include "runner/compare/uncertainty.hpp"
#include "runner/input/case.hpp"

namespace diptych::runner {

/// Of a plate's probe as in "radius of C_d = 0.05 at 45°", and its unit, as in "m".
std::string words_of(const PlateProbe&);
std::string unit_of(const PlateProbe&);
/// The case's probe of this id, which it has.
const PlateProbe& probe_of(const Case&, const std::string& id);

/// What the probe reads in a run at a sample time; NaN where it does not.
double reading(const reports::Run&, double time, const std::string& probe);

/// A reading on each mesh of a method, from the coarsest on.
struct Readings {
  std::vector<int> cells;
  std::vector<double> size, value;
  std::optional<Uncertainty> uncertainty;  ///< where there are meshes enough
};
/// Of the runs that the figure draws, but for their number of cells.
Readings series_of(const std::vector<reports::Run>&, const FigureSpec&, const std::string& method,
                   const std::string& variant, const std::string& probe, double time);

/// One sentence: how far the radii, areas and totals on the figure's mesh are from those on the finest that was run, at
/// most over its methods and times. Empty where there is nothing to compare.
std::string distance_from_settled(const Case&, const FigureSpec&, const std::vector<reports::Run>&);

}  // namespace diptych::runner
