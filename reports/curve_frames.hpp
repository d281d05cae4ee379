// Panels of curves: what their axes show, how much of a curve is seen there, and how large they are. For reports/
// alone.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/results.hpp"
#include "reports/sheet.hpp"

namespace diptych::reports::curves {

// Sizes of the picture [px].
constexpr double width = 900, left = 88, right = 24;
constexpr double motion_height = 450;  // of panels

/// What the axes of a panel show.
struct Frame {
  double x_min = 0, x_max = 1, y_min = 0, y_max = 1;
  bool operator==(const Frame&) const = default;
};

/// What some panel has of its own: each must then show its own ticks, or its own axis labels with them.
struct Own {
  bool x_range = false, y_range = false, x_label = false, y_label = false;
  bool any_range() const { return x_range || y_range; }
  bool x_ticks() const { return x_range || x_label; }
  bool y_ticks() const { return y_range || y_label; }
};

/// How much of a curve lies inside a frame.
struct Seen {
  bool any = false;
  double steps = 0;               ///< from point to point, with the share of those cut by the frame's edge
  double across = 0, length = 0;  ///< of these steps: along x and along the curve [px]
};

Frame frame_of(const Figure&, const Figure::Panel&);
Own own_of(const Figure&);
Seen seen(const Curve&, const Frame&, double panel_width, double panel_height);
bool in_sight(const Figure::Span&, const Frame&);
bool in_sight(const Figure::Mark&, const Frame&);
bool drawable(const Figure::Series&);  ///< has a point to draw
bool broken(const Curve&);             ///< has a point that ends a line

std::size_t columns_for(const Figure&);
double gap_across(const Own&);                            ///< between two panels [px]
double panel_width(const Figure&);                        ///< [px]
double length_of(const std::vector<std::string>& lines);  ///< of the longest [px]

}  // namespace diptych::reports::curves
