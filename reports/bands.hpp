// Filled bands of a map: their values, their colours and their outlines.
#pragma once

#include <string>
#include <vector>

#include "reports/plate_results.hpp"

namespace diptych::reports {

/// Values that part the bands, ascending, and a colour "#rrggbb" for each band: one more than there are inner edges.
/// Steps are round where the range allows. A diverging range has a white band around its middle.
struct Bands {
  std::vector<double> edges;  ///< the range's ends among them
  std::vector<std::string> colours;
};
Bands bands_of(const PlateFigure::Map&);

/// Rings around the part of the plate where the map is at least `level`: anticlockwise outside, clockwise around a
/// hole, not repeating their first point. Cells that touch NaN belong to no part; at -infinity all others do.
std::vector<Line> region_above(const PlateFigure::Map&, double width, double height, double level);

/// All rings as one polygon, joined by cuts of no width, since gnuplot knows no holes.
Line joined(const std::vector<Line>& rings);

}  // namespace diptych::reports
