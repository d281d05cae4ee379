// Contours of a field on the nodes of a rectangular grid, and how far two of them are apart.
#pragma once

#include <string>
#include <vector>

#include "reports/results.hpp"

namespace diptych::runner {

/// Values on the (nx + 1)(ny + 1) nodes of rectangular cells from the origin, row by row from the bottom, each row from
/// the left; bilinear between. Every function below throws std::invalid_argument where the sizes do not fit.
struct NodalMap {
  int nx = 1, ny = 1;     ///< cells across and up, ≥ 1
  double hx = 1, hy = 1;  ///< of a cell [m], > 0
  std::vector<double> value;
};

/// C_d, or D for "damage", on the nodes of a plate's cells.
NodalMap map_of(const reports::PlateFields&, const std::string& field);

/// Straight pieces from point to point [m]; `closed`: and from the last one to the first.
struct Polyline {
  std::vector<double> x, y;
  bool closed = false;
};

/// Marching squares: crossings of cell edges by linear interpolation, joined within cells, what is above (> level) on
/// the left hand; a saddle by the mean of its four corners. Lines that end on the border first. A value that is not
/// finite anywhere in the map gives no contour at all.
std::vector<Polyline> contour(const NodalMap&, double level);

/// Area where the field exceeds the level [m²], exact for the field that is linear on the four triangles between a
/// cell's sides and its centre (the mean of its corners); second order in the cell size. NaN where a value is.
double area_above(const NodalMap&, double level);

/// ∫ value dA by the trapezium rule, which is the sum over the nodes' control volumes [value · m²].
double integral(const NodalMap&);

/// Distance from the origin along a ray, its angle from x in degrees, to where the bilinear field first no longer
/// exceeds the level [m]. NaN where it does not at the origin, where the ray leaves the plate before that, and where it
/// meets a value that is not finite.
double radius_along(const NodalMap&, double level, double angle_degrees);

/// Largest distance of a point of either set of lines from the other set [m], to 1e-9 of their extent. NaN where either
/// is empty or has a NaN.
double hausdorff(const std::vector<Polyline>&, const std::vector<Polyline>&);

/// Mean distance of the points of either set of lines from the other set, each set by its own length, then the mean of
/// the two [m]; two Gauss points a piece. NaN likewise.
double mean_distance(const std::vector<Polyline>&, const std::vector<Polyline>&);

/// a − b on the same grid.
NodalMap difference(const NodalMap& a, const NodalMap& b);

}  // namespace diptych::runner
