// Where the panels, the legend and the colour bars of a plate's figure stand on the page. For reports/ alone.
#pragma once

#include <string>
#include <vector>

#include "reports/bands.hpp"
#include "reports/plate_results.hpp"
#include "reports/sheet.hpp"

namespace diptych::reports::plates {

using Contour = PlateFigure::Contour;
using Panel = PlateFigure::Panel;
using Map = PlateFigure::Map;

// Sizes of the picture [px].
constexpr double left = 74, right = 22, column_gap = 28, bar_tip = 9;

/// How contours of a kind look: the lines differ too, for print without colour. Colours as in the other figures.
struct Look {
  std::string kind, name, line;
};
std::vector<Look> looks_of(const PlateFigure&);

/// The place in `looks` of a kind of contours; their number for an unknown one.
std::size_t look_of(const std::vector<Look>& looks, const std::string& kind);

/// One colour bar: all maps with its range, label and kind of colours.
struct Scale {
  Map map;  ///< the first of them
  Bands bands;
  bool below = false, above = false;  ///< some value lies beyond the range
};

struct Bar {
  std::size_t scale = 0;
  double x = 0, y = 0, w = 0;  ///< [px]
};

struct Layout {
  Heading heading;
  std::size_t columns = 1, rows = 1;
  double width = 0, height = 0, panel_width = 0, panel_height = 0, pixels = 1;  ///< pixels: of one unit of length
  double legend = 0, top = 0, row_step = 0, strip = 0;                          ///< strip: for the panels' labels
  std::vector<Look> looks;
  std::vector<std::size_t> kinds;  ///< of the looks, those in the legend
  std::vector<Scale> scales;
  std::vector<std::size_t> scale_of;  ///< of each panel; the number of scales without a map
  std::vector<Bar> bars;
  std::vector<std::vector<std::string>> labels;  ///< lines of each panel's label

  double x_of(std::size_t panel) const {
    return left + static_cast<double>(panel % columns) * (panel_width + column_gap);
  }
  double y_of(std::size_t panel) const { return top + static_cast<double>(panel / columns) * row_step; }
};

Layout layout_of(const PlateFigure&);

bool drawn(const Contour&);  ///< has a point to draw
bool has_gap(const Map&);    ///< has a node without a value

}  // namespace diptych::reports::plates
