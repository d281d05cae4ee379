#include "reports/curve_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace diptych::reports::curves {
namespace {

constexpr double row_gap = 14, ticks_down = 34, axis_down = 62;  // between panels; with tick labels; with axis labels
constexpr double tag_gap = 8;                                    // least gap between labels above a panel
constexpr double small_label = 14;                               // height of a label beside a mark

/// Label of the panel, and which series it cannot show: a lost one must not look like a hidden one.
std::string label_of(const Figure& figure, const Figure::Panel& panel) {
  const bool magnified = panel.x_range || panel.y_range;
  std::string missing, outside;
  const auto add = [](std::string& list, const std::string& name) { list += (list.empty() ? "" : ", ") + name; };
  for (const Figure::Series& series : panel.series) {
    if (!drawable(series))
      add(missing, series.label);
    else if (magnified && !seen(series.curve, frame_of(figure, panel), 1, 1).any)
      add(outside, series.label);
  }
  const Frame frame = frame_of(figure, panel);
  for (const Figure::Span& span : panel.spans)
    if (!in_sight(span, frame)) add(outside, span.label.empty() ? span.kind : span.label);
  for (const Figure::Mark& mark : panel.marks)
    if (!in_sight(mark, frame)) add(outside, mark.label.empty() ? "a mark" : mark.label);
  std::string label = panel.label;
  if (!missing.empty()) label += " [no finite values: " + missing + "]";
  if (!outside.empty()) label += " [outside the axes: " + outside + "]";
  return label;
}

/// Whether the curve passes through the box.
bool passes(const Curve& curve, const Frame& frame, const Layout& layout, const Box& box) {
  constexpr double clearance = 5;
  const double x_scale = layout.panel_width / (frame.x_max - frame.x_min);
  const double y_scale = layout.panel_height / (frame.y_max - frame.y_min);
  double last_x = 0, last_y = 0;
  bool has_last = false;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const double x = (curve.x[i] - frame.x_min) * x_scale;
    const double y = (frame.y_max - curve.y[i]) * y_scale;
    const bool good = std::isfinite(x) && std::isfinite(y);
    if (good) {
      const double reach = has_last ? std::max(std::abs(x - last_x), std::abs(y - last_y)) : 0;
      const int pieces = static_cast<int>(std::clamp(reach / 3, 1.0, 1000.0));
      for (int k = has_last ? 0 : pieces; k <= pieces; ++k) {
        const double share = static_cast<double>(k) / pieces;
        const double px = has_last ? last_x + share * (x - last_x) : x;
        const double py = has_last ? last_y + share * (y - last_y) : y;
        if (px > box.x - clearance && px < box.x + box.w + clearance && py > box.y - clearance &&
            py < box.y + box.h + clearance)
          return true;
      }
    }
    has_last = good;
    last_x = x;
    last_y = y;
  }
  return false;
}

/// Whether any curve of the panel passes through the box.
bool crossed(const Figure::Panel& panel, const Frame& frame, const Layout& layout, const Box& box) {
  return std::any_of(panel.series.begin(), panel.series.end(),
                     [&](const Figure::Series& series) { return passes(series.curve, frame, layout, box); });
}

/// Finds for each panel's label a place that no curve crosses; false where a panel has none.
bool place_labels(const Figure& figure, Layout& layout) {
  layout.places.clear();
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const double w = length_of(layout.labels[i]), h = label_line * static_cast<double>(layout.labels[i].size());
    const double far_x = layout.panel_width - w - 10, far_y = layout.panel_height - h - 6;
    bool found = false;
    for (const double y : {6.0, far_y})
      for (const double x : {10.0, far_x, far_x / 2}) {
        const Box box{x, y, w, h};
        if (found || crossed(figure.panels[i], layout.frames[i], layout, box)) continue;
        layout.places.push_back(box);
        found = true;
      }
    if (!found) return false;
  }
  return true;
}

/// Finds a place along the line of each horizontal mark, which nothing crosses; or no curve; or else at the right end.
std::vector<Box> place_mark_labels(const Figure::Panel& panel, const Frame& frame, const Layout& layout) {
  constexpr double off = 3, edge = 6, step = 10;
  Figure::Panel lines;  // of other marks and the edges of spans
  const auto add_line = [&](Curve line) { lines.series.push_back({"", "", std::move(line)}); };
  const auto upright = [&](double x) { add_line({{x, x}, {frame.y_min, frame.y_max}}); };
  std::vector<Box> boxes;
  for (const Figure::Mark& mark : panel.marks) {
    boxes.push_back({});
    if (mark.vertical || mark.label.empty() || !in_sight(mark, frame)) continue;
    lines.series.clear();
    for (const Figure::Mark& other : panel.marks)
      if (other.vertical)
        upright(other.at);
      else if (&other != &mark)
        add_line({{frame.x_min, frame.x_max}, {other.at, other.at}});
    for (const Figure::Span& span : panel.spans) upright(span.from), upright(span.to);

    const double w = static_cast<double>(characters(mark.label)) * note_char;
    const double line = (frame.y_max - mark.at) / (frame.y_max - frame.y_min) * layout.panel_height;
    const double above = line - off - small_label, below = line + off, far = layout.panel_width - w - edge;
    const auto free = [&](const Box& box, bool of_lines) {
      const auto apart = [&](const Box& other) {
        return box.x > other.x + other.w + off || other.x > box.x + box.w + off || box.y > other.y + other.h ||
               other.y > box.y + box.h;
      };
      return box.y >= 0 && box.y + box.h <= layout.panel_height && std::all_of(boxes.begin(), boxes.end(), apart) &&
             !crossed(panel, frame, layout, box) && !(of_lines && crossed(lines, frame, layout, box));
    };
    const auto find = [&](bool of_lines) -> Box {
      for (double x = far; x >= edge; x -= step)
        for (const double y : {above, below})
          if (const Box box{x, y, w, small_label}; free(box, of_lines)) return box;
      return {};
    };
    Box best = find(true);
    if (!(best.w > 0)) best = find(false);
    boxes.back() = best.w > 0 ? best : Box{far, above < 0 ? below : above, w, small_label};
  }
  return boxes;
}

/// Labels of spans and vertical marks, each in the lowest row that has room for it. Marks come first, so that their
/// lines go on up to their labels without crossing another.
std::vector<Tag> tags_of(const Figure::Panel& panel, const Frame& frame, double across) {
  std::vector<Tag> marks, spans, placed;
  const auto add = [&](std::vector<Tag>& tags, Tag tag, double from, double to, const std::string& label) {
    const auto pixels = [&](double x) {
      return (std::clamp(x, frame.x_min, frame.x_max) - frame.x_min) / (frame.x_max - frame.x_min) * across;
    };
    tag.lines = lines_of(label, across - tag_gap, note_char);
    if (tag.lines.empty()) return;
    std::size_t longest = 0;
    for (const std::string& line : tag.lines) longest = std::max(longest, characters(line));
    const double w = static_cast<double>(longest) * note_char, off = tag.mark != nullptr ? 4 : 0;
    tag.from = pixels(from);
    tag.to = pixels(to);
    tag.to_left = tag.from + off + w > across && tag.to - off - w >= 0;
    tag.text = tag.to_left ? tag.to - off : std::max(0.0, std::min(tag.from + off, across - w));
    tag.low = std::min(tag.from, tag.to_left ? tag.text - w : tag.text);
    tag.high = std::max(tag.to, tag.to_left ? tag.text : tag.text + w);
    tags.push_back(std::move(tag));
  };
  for (const Figure::Mark& mark : panel.marks)
    if (mark.vertical && in_sight(mark, frame)) add(marks, {.mark = &mark}, mark.at, mark.at, mark.label);
  for (const Figure::Span& span : panel.spans)
    if (in_sight(span, frame)) add(spans, {.span = &span}, span.from, span.to, span.label);

  // What lies under a label must have been placed before it: from the right, or from the left where words end at a
  // mark.
  std::stable_sort(marks.begin(), marks.end(), [](const Tag& a, const Tag& b) {
    return a.to_left != b.to_left ? a.to_left : a.to_left ? a.from < b.from : a.from > b.from;
  });
  for (std::vector<Tag>* tags : {&marks, &spans})
    for (Tag& tag : *tags) {
      const auto clear = [&](const Tag& other) {
        const bool apart = tag.low >= other.high + tag_gap || other.low >= tag.high + tag_gap;
        const bool other_rows = tag.row >= other.row + other.lines.size() || other.row >= tag.row + tag.lines.size();
        const bool line_crosses =
            other.mark != nullptr && other.row > tag.row && other.from > tag.low - 2 && other.from < tag.high + 2;
        return (apart || other_rows) && !line_crosses;
      };
      while (!std::all_of(placed.begin(), placed.end(), clear)) ++tag.row;
      placed.push_back(std::move(tag));
    }
  return placed;
}

bool any_crowded(const Figure& figure) {
  return std::any_of(figure.panels.begin(), figure.panels.end(),
                     [](const Figure::Panel& panel) { return crowded(panel); });
}

double gap_down(const Own& own) { return own.x_label ? axis_down : own.x_ticks() ? ticks_down : row_gap; }

}  // namespace

bool crowded(const Figure::Panel& panel) { return !panel.spans.empty() || !panel.marks.empty(); }

Layout layout_of(const Figure& figure, const Heading& heading, std::size_t legend_lines) {
  Layout layout;
  const std::size_t count = figure.panels.size();
  layout.own = own_of(figure);
  layout.columns = columns_for(figure);
  layout.rows = (count + layout.columns - 1) / layout.columns;
  const auto rows = static_cast<double>(layout.rows);
  layout.panel_width = panel_width(figure);
  layout.panel_height = figure.motion         ? motion_height
                        : count == 1          ? 360
                        : count == 2          ? 230
                        : layout.columns == 2 ? 165
                                              : 175;
  layout.row_gap = gap_down(layout.own);
  layout.legend = margin + heading.height() + 6;
  layout.top = layout.legend + legend_line * static_cast<double>(legend_lines) + 8;
  std::size_t most = 1, tag_rows = 0;
  for (const Figure::Panel& panel : figure.panels) {
    layout.frames.push_back(frame_of(figure, panel));
    layout.labels.push_back(lines_of(label_of(figure, panel),
                                     layout.panel_width - (figure.motion || any_crowded(figure) ? 0 : 24), label_char));
    most = std::max(most, layout.labels.back().size());
    layout.tags.push_back(tags_of(panel, layout.frames.back(), layout.panel_width));
    for (const Tag& tag : layout.tags.back()) tag_rows = std::max(tag_rows, tag.row + tag.lines.size());
  }
  const double tags = tag_rows > 0 ? tag_line * static_cast<double>(tag_rows) + 4 : 0;
  layout.top += tags;
  layout.row_gap += tags;
  const double strip = label_line * static_cast<double>(most) + 8;
  const auto in_strip = [&](double x, double y) {
    layout.places.clear();
    for (const auto& lines : layout.labels)
      layout.places.push_back({x, y, length_of(lines), label_line * static_cast<double>(lines.size())});
  };
  if (figure.motion || any_crowded(figure)) {
    // Paths go everywhere and time must not seem to go on, edges and marks cross the panel: labels stand above it.
    layout.top += strip;
    layout.row_gap += strip;
    in_strip(0, 2 - strip - tags);
  } else if (!place_labels(figure, layout)) {
    // Data fill some panel: lift the axis of all, so that labels have a strip of their own above y_max.
    for (Frame& frame : layout.frames) frame.y_max += (frame.y_max - frame.y_min) * strip / layout.panel_height;
    layout.panel_height += strip;
    in_strip(10, 4);
  }
  for (std::size_t i = 0; i < count; ++i)
    layout.mark_labels.push_back(place_mark_labels(figure.panels[i], layout.frames[i], layout));
  layout.height = layout.top + rows * layout.panel_height + (rows - 1) * layout.row_gap + x_axis;
  return layout;
}

}  // namespace diptych::reports::curves
