#include "reports/contour_labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace diptych::reports {
namespace {

using Contour = PlateFigure::Contour;

constexpr double contour_char = 6.3, contour_line = 15, clearance = 3;

/// A contour in a panel's pixels, from its upper left corner, in pieces without breaks.
std::vector<Line> in_pixels(const Contour& contour, const PlateFigure& figure, double pixels) {
  std::vector<Line> pieces;
  for (const Line& line : contour.lines) {
    bool open = false;
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      const bool good = std::isfinite(line.x[i]) && std::isfinite(line.y[i]);
      if (good && !open) pieces.emplace_back();
      open = good;
      if (!good) continue;
      pieces.back().x.push_back(line.x[i] * pixels);
      pieces.back().y.push_back((figure.height - line.y[i]) * pixels);
    }
  }
  return pieces;
}

/// Length of a line's part inside a box [px].
double length_in(const Line& line, const Box& box) {
  double sum = 0;
  for (std::size_t i = 1; i < line.x.size(); ++i) {
    const double dx = line.x[i] - line.x[i - 1], dy = line.y[i] - line.y[i - 1], length = std::hypot(dx, dy);
    const int parts = static_cast<int>(std::clamp(length / 1.5, 1.0, 1000.0));
    for (int k = 0; k < parts; ++k) {
      const double share = (k + 0.5) / parts, x = line.x[i - 1] + share * dx, y = line.y[i - 1] + share * dy;
      if (x > box.x && x < box.x + box.w && y > box.y && y < box.y + box.h) sum += length / parts;
    }
  }
  return sum;
}

double length_of(const Line& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.x.size(); ++i)
    sum += std::hypot(line.x[i] - line.x[i - 1], line.y[i] - line.y[i - 1]);
  return sum;
}

std::array<double, 2> point_at(const Line& line, double share) {
  double left_over = share * length_of(line);
  for (std::size_t i = 1; i < line.x.size(); ++i) {
    const double dx = line.x[i] - line.x[i - 1], dy = line.y[i] - line.y[i - 1], length = std::hypot(dx, dy);
    if (left_over <= length && length > 0)
      return {line.x[i - 1] + left_over / length * dx, line.y[i - 1] + left_over / length * dy};
    left_over -= length;
  }
  return {line.x.back(), line.y.back()};
}

}  // namespace

ContourLabels::ContourLabels(const PlateFigure& figure, const PlateFigure::Panel& panel, double pixels)
    : panel_(panel), width_(pixels * figure.width), height_(pixels * figure.height) {
  for (const Contour& contour : panel.contours) lines_.push_back(in_pixels(contour, figure, pixels));
}

void ContourLabels::begin(const std::string& text) {
  best_ = {text, {0, 0, static_cast<double>(characters(text)) * contour_char + 6, contour_line}};
  least_ = std::numeric_limits<double>::infinity();
}

void ContourLabels::offer(double x, double y, double halves_across, double halves_down, double cost, std::size_t own) {
  Box box = best_.box;
  box.x = x + (halves_across - 1) * box.w / 2 + 5 * halves_across;
  box.y = y + (halves_down - 1) * box.h / 2;
  if (box.x < clearance || box.y < clearance || box.x + box.w > width_ - clearance ||
      box.y + box.h > height_ - clearance)
    return;
  for (const PlacedLabel& other : placed_)
    if (!box.apart(other.box, clearance)) return;
  for (std::size_t c = 0; c < lines_.size(); ++c)
    for (const Line& line : lines_[c]) {
      const double hidden = length_in(line, box);
      if (c != own) cost += 4 * hidden;
      if (c == own && hidden > 0.45 * length_of(line)) cost += 10 * hidden;
    }
  if (cost < least_) least_ = cost, best_.box = box;
}

void ContourLabels::end() {
  if (std::isfinite(least_)) placed_.push_back(best_);
}

void ContourLabels::place_on_contours() {
  for (std::size_t c = 0; c < panel_.contours.size(); ++c) {
    const std::string& text = panel_.contours[c].label;
    const std::vector<Line>& lines = lines_[c];
    const bool again =
        std::any_of(placed_.begin(), placed_.end(), [&](const PlacedLabel& label) { return label.text == text; });
    if (text.empty() || again || lines.empty()) continue;
    const Line& line = *std::max_element(lines.begin(), lines.end(),
                                         [](const Line& a, const Line& b) { return length_of(a) < length_of(b); });
    begin(text);
    for (const double share : {0.5, 0.45, 0.55, 0.4, 0.6, 0.35, 0.65, 0.3, 0.7, 0.25, 0.75, 0.2, 0.8, 0.15, 0.85}) {
      const auto [x, y] = point_at(line, share);
      const double off = 10 * std::abs(share - 0.5);
      offer(x, y, 0, 0, off, c);
      for (const double side : {1.0, -1.0})
        for (const double up : {-1.0, 1.0}) offer(x, y, side, up, 25 + off, c);
    }
    end();
  }
}

void ContourLabels::place_around(const std::string& text, double x, double y) {
  begin(text);
  for (const double up : {-1.4, 1.4, 0.0, -3.4, 3.4, -5.4, 5.4})
    for (const double side : {1.0, -1.0}) offer(x, y, side, up, 40 * std::abs(up) + (side < 0 ? 1 : 0), lines_.size());
  end();
}

}  // namespace diptych::reports
