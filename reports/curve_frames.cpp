#include "reports/curve_frames.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace diptych::reports::curves {
namespace {

constexpr double column_gap = 36;
constexpr double ticks_across = 62;  // gap between panels with tick labels of their own
constexpr double axis_across = 90;   // and with axis labels of their own

}  // namespace

Frame frame_of(const Figure& figure, const Figure::Panel& panel) {
  const auto x = panel.x_range.value_or(std::array{figure.x_min, figure.x_max});
  const auto y = panel.y_range.value_or(std::array{figure.y_min, figure.y_max});
  return {x[0], x[1], y[0], y[1]};
}

Own own_of(const Figure& figure) {
  Own own;
  for (const Figure::Panel& panel : figure.panels) {
    own.x_range |= panel.x_range.has_value();
    own.y_range |= panel.y_range.has_value();
    own.x_label |= !panel.x_label.empty();
    own.y_label |= !panel.y_label.empty();
  }
  return own;
}

Seen seen(const Curve& curve, const Frame& frame, double panel_width, double panel_height) {
  Seen total;
  const double x_scale = panel_width / (frame.x_max - frame.x_min);
  const double y_scale = panel_height / (frame.y_max - frame.y_min);
  const auto finite = [&](std::size_t i) { return std::isfinite(curve.x[i]) && std::isfinite(curve.y[i]); };
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (!finite(i)) continue;
    const std::size_t from = i > 0 && finite(i - 1) ? i - 1 : i;
    const double dx = curve.x[i] - curve.x[from], dy = curve.y[i] - curve.y[from];
    double enter = 0, leave = 1;  // shares of the step; Liang and Barsky (1984)
    const auto clip = [&](double start, double step, double low, double high) {
      if (step == 0) {
        if (start < low || start > high) leave = -1;
        return;
      }
      const double to_low = (low - start) / step, to_high = (high - start) / step;
      enter = std::max(enter, std::min(to_low, to_high));
      leave = std::min(leave, std::max(to_low, to_high));
    };
    clip(curve.x[from], dx, frame.x_min, frame.x_max);
    clip(curve.y[from], dy, frame.y_min, frame.y_max);
    if (leave < enter) continue;
    total.any = true;
    if (from == i) continue;
    total.steps += leave - enter;
    total.across += (leave - enter) * std::abs(dx) * x_scale;
    total.length += (leave - enter) * std::hypot(dx * x_scale, dy * y_scale);
  }
  return total;
}

bool in_sight(const Figure::Span& span, const Frame& frame) {
  return span.to >= frame.x_min && span.from <= frame.x_max;
}
bool in_sight(const Figure::Mark& mark, const Frame& frame) {
  return mark.vertical ? mark.at >= frame.x_min && mark.at <= frame.x_max
                       : mark.at >= frame.y_min && mark.at <= frame.y_max;
}

bool drawable(const Figure::Series& series) {
  for (std::size_t i = 0; i < series.curve.x.size(); ++i)
    if (std::isfinite(series.curve.x[i]) && std::isfinite(series.curve.y[i])) return true;
  return false;
}

bool broken(const Curve& curve) {
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) return true;
  return false;
}

std::size_t columns_for(const Figure& figure) {
  const std::size_t count = figure.panels.size();
  return count > 4 || (figure.motion && count > 1) ? 2 : 1;
}

double gap_across(const Own& own) { return own.y_label ? axis_across : own.y_ticks() ? ticks_across : column_gap; }
double panel_width(const Figure& figure) {
  const auto count = static_cast<double>(columns_for(figure));
  return (width - left - right - (count - 1) * gap_across(own_of(figure))) / count;
}

double length_of(const std::vector<std::string>& lines) {
  std::size_t longest = 0;
  for (const std::string& line : lines) longest = std::max(longest, characters(line));
  return static_cast<double>(longest) * label_char;
}

}  // namespace diptych::reports::curves
