// Where the panels of curves stand on the page, and where the labels of panels, spans and marks do: where no curve
// crosses them. For reports/ alone.
#pragma once

#include <string>
#include <vector>

#include "reports/curve_frames.hpp"

namespace diptych::reports::curves {

// Sizes of the picture [px].
constexpr double legend_line = 20, x_axis = 46;
constexpr double tag_line = 18, tag_bar = 3;  // of the labels above a panel: rows and bars

/// Label of a span or of a vertical mark, in rows of its own above the panel [px from the panel's left side].
struct Tag {
  std::vector<std::string> lines = {};
  double from = 0, to = 0;   ///< the span, as far as it is seen, or the mark
  double text = 0;           ///< where the words begin, or end if they stand to the left
  bool to_left = false;      ///< of a mark or of a span's end, at the right side of the panel
  double low = 0, high = 0;  ///< the place it needs
  std::size_t row = 0;       ///< its lowest, counted from the panel upwards
  const Figure::Span* span = nullptr;
  const Figure::Mark* mark = nullptr;
};

struct Layout {
  std::size_t columns = 1, rows = 1;
  double panel_width = 0, panel_height = 0, row_gap = 0, legend = 0, top = 0, height = 0;
  Own own;
  std::vector<Frame> frames;                     ///< y_max with room for the labels where data leave none
  std::vector<std::vector<std::string>> labels;  ///< lines of each panel's label
  std::vector<Box> places;
  std::vector<std::vector<Tag>> tags;         ///< of each panel
  std::vector<std::vector<Box>> mark_labels;  ///< of each panel's marks; empty for those with a tag or without label
};

Layout layout_of(const Figure&, const Heading&, std::size_t legend_lines);

bool crowded(const Figure::Panel&);  ///< with spans or marks: its label stands above it

}  // namespace diptych::reports::curves
