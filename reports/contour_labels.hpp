// Small labels on the contours of a panel. For reports/ alone.
#pragma once

#include <string>
#include <vector>

#include "reports/plate_results.hpp"
#include "reports/sheet.hpp"

namespace diptych::reports {

struct PlacedLabel {
  std::string text;
  Box box;  ///< from the panel's upper left corner
};

/// Finds places in one panel for small labels that cover no other and, where they can, no line.
class ContourLabels {
 public:
  /// `pixels` are those of one unit of length of the plate, which the panel shows whole.
  ContourLabels(const PlateFigure&, const PlateFigure::Panel&, double pixels);

  /// Labels on their lines where no other line passes; beside a line that is too short; on another line at worst.
  void place_on_contours();
  /// A label around a point, which has no line of its own.
  void place_around(const std::string& text, double x, double y);
  const std::vector<PlacedLabel>& placed() const { return placed_; }

 private:
  void begin(const std::string& text);
  /// A centre where the label may stand, relative to (x, y) by halves of its own size. Lines of the contour `own` may
  /// pass below it, all others cost by their covered length.
  void offer(double x, double y, double halves_across, double halves_down, double cost, std::size_t own);
  void end();

  const PlateFigure::Panel& panel_;
  double width_, height_;
  std::vector<std::vector<Line>> lines_;  ///< of each contour [px]
  std::vector<PlacedLabel> placed_;
  PlacedLabel best_;
  double least_ = 0;
};

}  // namespace diptych::reports
