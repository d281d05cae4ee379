#include "reports/figure.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <ostream>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/gnuplot.hpp"

namespace diptych::reports {
namespace {

namespace fs = std::filesystem;

// ---- sizes of the picture [px]

constexpr double width = 900, left = 88, right = 24, column_gap = 36, row_gap = 14;
constexpr double legend_line = 20, x_axis = 46;
constexpr double marker_spacing = 7.5;                         // closer markers melt into a band
constexpr double motion_height = 450, motion_spacing = 22;     // of panels and of markers along a path
constexpr double ticks_across = 62, ticks_down = 34;           // gaps between panels with tick labels of their own
constexpr double axis_across = 90, axis_down = 62;             // and with axis labels of their own
constexpr double y_label_offset = 72;                          // from a panel's left side
constexpr double sample = 34, sample_gap = 7, entry_gap = 26;  // of the legend
constexpr double tag_line = 18, tag_bar = 3, tag_gap = 8;      // of the labels above a panel: rows, bars, least gap
constexpr double small_label = 14;                             // height of a label beside a mark
constexpr std::size_t span_styles = 110, mark_style = 109;     // gnuplot's line styles

/// How a series looks. Colours after Okabe & Ito; shapes differ too, for print without colour.
struct Look {
  std::string line;  ///< gnuplot's line properties
  bool markers = false;
};
Look look(const std::vector<PanelLook>& looks, const std::string& kind, std::size_t nth) {
  if (kind == "exact") return {"lw 4.5 lc rgb '#c6c6c6'", false};
  for (const PanelLook& one : looks) {
    const bool thin = kind == one.id + "-thin";
    const auto& lines = thin ? one.thin : one.lines;
    if ((thin || kind == one.id) && !lines.empty()) return {lines[nth % lines.size()], one.markers};
  }
  return {"lw 1.2 lc rgb '#000000'", false};
}

/// How the nth kind of span looks. A tint tells colours apart and not shades of grey, so that bands that overlap add up
/// to a darker one; without colour, kinds differ by the dashes of their edges and of the bars that carry their labels.
struct SpanLook {
  const char *tint, *edge;
};
SpanLook span_look(std::size_t nth) {
  constexpr std::array<SpanLook, 4> looks{{{"#56b4e9", "lw 1.1 lc rgb '#1f5f8b'"},
                                           {"#e69f00", "lw 1.1 lc rgb '#8a5a00' dt (9,4)"},
                                           {"#009e73", "lw 1.1 lc rgb '#00604a' dt (2,3)"},
                                           {"#999999", "lw 1.1 lc rgb '#4d4d4d' dt (9,4,2,4)"}}};
  return looks[nth % looks.size()];
}

/// Kinds of spans in the order of their first mention.
std::vector<std::string> span_kinds(const Figure& figure) {
  std::vector<std::string> kinds;
  for (const Figure::Panel& panel : figure.panels)
    for (const Figure::Span& span : panel.spans)
      if (std::find(kinds.begin(), kinds.end(), span.kind) == kinds.end()) kinds.push_back(span.kind);
  return kinds;
}

/// One entry of the legend: all series of this label, in every panel.
struct Entry {
  std::string label, kind;
  Look appearance;
  std::size_t interval = 1;  ///< a marker at every so many points; in a motion diagram the most of all panels
  bool motion = false;
  double x = 0;          ///< of its sample in the legend [px]
  std::size_t line = 0;  ///< of the legend, the first of this entry's
  std::vector<std::string> lines = {};
  std::string text() const;
};

struct Box {
  double x = 0, y = 0, w = 0, h = 0;  ///< from the panel's upper left corner [px]
};

/// What the axes of a panel show.
struct Frame {
  double x_min = 0, x_max = 1, y_min = 0, y_max = 1;
  bool operator==(const Frame&) const = default;
};

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

/// What some panel has of its own: each must then show its own ticks, or its own axis labels with them.
struct Own {
  bool x_range = false, y_range = false, x_label = false, y_label = false;
  bool any_range() const { return x_range || y_range; }
  bool x_ticks() const { return x_range || x_label; }
  bool y_ticks() const { return y_range || y_label; }
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

double length_of(const std::vector<std::string>& lines) {
  std::size_t longest = 0;
  for (const std::string& line : lines) longest = std::max(longest, characters(line));
  return static_cast<double>(longest) * label_char;
}

bool drawable(const Figure::Series& series) {
  for (std::size_t i = 0; i < series.curve.x.size(); ++i)
    if (std::isfinite(series.curve.x[i]) && std::isfinite(series.curve.y[i])) return true;
  return false;
}

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

/// How much of a curve lies inside a frame.
struct Seen {
  bool any = false;
  double steps = 0;               ///< from point to point, with the share of those cut by the frame's edge
  double across = 0, length = 0;  ///< of these steps: along x and along the curve [px]
};

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

bool crowded(const Figure::Panel& panel) { return !panel.spans.empty() || !panel.marks.empty(); }
bool crowded(const Figure& figure) {
  return std::any_of(figure.panels.begin(), figure.panels.end(),
                     [](const Figure::Panel& panel) { return crowded(panel); });
}

std::size_t columns_for(const Figure& figure) {
  const std::size_t count = figure.panels.size();
  return count > 4 || (figure.motion && count > 1) ? 2 : 1;
}

double gap_across(const Own& own) { return own.y_label ? axis_across : own.y_ticks() ? ticks_across : column_gap; }
double gap_down(const Own& own) { return own.x_label ? axis_down : own.x_ticks() ? ticks_down : row_gap; }

double panel_width(const Figure& figure) {
  const auto count = static_cast<double>(columns_for(figure));
  return (width - left - right - (count - 1) * gap_across(own_of(figure))) / count;
}

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
                                     layout.panel_width - (figure.motion || crowded(figure) ? 0 : 24), label_char));
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
  if (figure.motion || crowded(figure)) {
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

bool broken(const Curve& curve) {
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) return true;
  return false;
}

/// How many points to go from marker to marker, so that they do not melt into a band.
std::size_t interval_of(const Figure& figure, const Figure::Panel& panel, const Curve& curve) {
  const double across = panel_width(figure);
  auto steps = static_cast<double>(curve.x.size());
  double room = across, tolerance = 0;
  if (figure.motion || panel.x_range || panel.y_range || broken(curve)) {
    const Seen part = seen(curve, frame_of(figure, panel), across, motion_height);
    steps = part.steps;
    room = figure.motion ? part.length : part.across;
    tolerance = 0.1;  // a bar shortened by its strain does not lose half its markers
  }
  if (!(room > 0)) return 1;
  const double asked = std::ceil(steps * (figure.motion ? motion_spacing : marker_spacing) / room - tolerance);
  auto interval = static_cast<std::size_t>(std::clamp(asked, 1.0, 1.0 + static_cast<double>(curve.x.size())));
  // Odd, so that markers do not always land on the same one of two particles in a cell.
  if (!figure.motion && interval > 1 && interval % 2 == 0) ++interval;
  return interval;
}

/// Legend entries in the order of first mention. Lines lie under markers because the series come in that order.
std::vector<Entry> entries_of(const Figure& figure) {
  std::vector<Entry> entries;
  for (const Figure::Panel& panel : figure.panels)
    for (const Figure::Series& series : panel.series) {
      auto entry = std::find_if(entries.begin(), entries.end(),
                                [&](const Entry& e) { return e.label == series.label && e.kind == series.kind; });
      if (entry == entries.end()) {
        const auto nth =
            std::count_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.kind == series.kind; });
        entries.push_back({series.label, series.kind, look(figure.looks, series.kind, static_cast<std::size_t>(nth))});
        entry = std::prev(entries.end());
        entry->motion = figure.motion;
      }
      if (entry->appearance.markers)
        entry->interval = std::max(entry->interval, interval_of(figure, panel, series.curve));
    }
  double x = left;
  std::size_t line = 0;
  for (Entry& entry : entries) {
    entry.lines = lines_of(entry.text(), width - right - left - sample - sample_gap, label_char);
    const double needed = sample + sample_gap + length_of(entry.lines);
    if (x > left && x + needed > width - right) x = left, ++line;
    entry.x = x;
    entry.line = line;
    line += std::max<std::size_t>(entry.lines.size(), 1) - 1;
    x += needed + entry_gap;
  }
  return entries;
}

// ---- the script

std::string ordinal(std::size_t n) {
  const bool teen = n % 100 > 10 && n % 100 < 14;
  const char* ending = teen ? "th" : n % 10 == 1 ? "st" : n % 10 == 2 ? "nd" : n % 10 == 3 ? "rd" : "th";
  return fmt::format("{}{}", n, ending);
}

std::string Entry::text() const {
  if (interval <= 1) return label;
  return motion ? label + " (markers at some points)" : label + " (marker at every " + ordinal(interval) + " point)";
}

const char* style_of(const Entry& entry) {
  if (!entry.appearance.markers) return "lines";
  return entry.interval > 1 || entry.motion ? "linespoints" : "points";
}

/// Margins that put a plot between these pixels, counted from the upper left corner.
std::string at_pixels(double x0, double x1, double y0, double y1, double height) {
  return fmt::format(
      "set lmargin at screen {:.6f}; set rmargin at screen {:.6f}\n"
      "set tmargin at screen {:.6f}; set bmargin at screen {:.6f}\n",
      x0 / width, x1 / width, 1 - y0 / height, 1 - y1 / height);
}

void write_head(std::ostream& gp, const Figure& figure, const Heading& heading, const Layout& layout,
                const std::vector<Entry>& entries) {
  begin_page(gp, figure.id, width, layout.height);
  gp << "# Change the looks here.\n";
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& entry = entries[i];
    std::string style = entry.appearance.line;
    // Markers joined by a line: a thin one, which leaves what lies beneath in sight.
    if (entry.appearance.markers) {
      const char *joined = entry.kind.ends_with("-thin") ? " lw 0.5" : " lw 0.9", *alone = " lw 1.3";
      style += entry.motion || entry.interval > 1 ? joined : alone;
      if (!entry.motion && entry.interval > 1) style += fmt::format(" pi {}", entry.interval);
    }
    gp << "set style line " << i + 1 << ' ' << style << "  # " << quoted(entry.label) << '\n';
  }
  const std::vector<std::string> kinds = span_kinds(figure);
  for (std::size_t i = 0; i < kinds.size(); ++i)
    gp << "set style line " << span_styles + i << ' ' << span_look(i).edge << "  # edges of spans of kind "
       << quoted(kinds[i]) << '\n';
  if (std::any_of(figure.panels.begin(), figure.panels.end(), [](const auto& panel) { return !panel.marks.empty(); }))
    gp << "set style line " << mark_style << " lw 0.9 lc rgb '#333333' dt (10,3,2,3)  # marks\n";
  gp << "set style line 100 lw 0.7 lc rgb '#e4e4e4'  # grid\n"
     << "set style line 101 lw 0.9 lc rgb '#707070'  # axes\n\n"
     << (layout.own.any_range() ? "set clip two  # a line may cross a panel without a point in it\n\n" : "")
     << "set multiplot\n\n"
     << "# Title, notes, legend and axis labels: an empty plot across the page.\n"
     << at_pixels(left, width - right, layout.legend, layout.top, layout.height)
     << "unset border; unset tics; unset key\n";
  const auto text = [&](const std::string& words, double x, double y, const std::string& style) {
    gp << "set label " << quoted(words)
       << fmt::format(" at screen {:.6f},{:.6f} {}\n", x / width, 1 - y / layout.height, style);
  };
  double y = margin;
  for (const std::string& line : heading.title) {
    text(line, left, y + 8, "left font ',16' textcolor rgb '#111111'");
    y += title_line;
  }
  for (const std::string& line : heading.notes) {
    text(line, left, y + 5, "left font ',11' textcolor rgb '#666666'");
    y += note_line;
  }
  if (!layout.own.y_label)
    text(figure.y_label, 16, (layout.top + layout.height - x_axis) / 2,
         "center rotate by 90 font ',12' textcolor rgb '#222222'");
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& entry = entries[i];
    const double middle = layout.legend + legend_line * (static_cast<double>(entry.line) + 0.5);
    const std::string at = fmt::format("{:.6f}", 1 - middle / layout.height), style = fmt::format("ls {}", i + 1);
    if (style_of(entry) != std::string_view("points"))
      gp << fmt::format("set arrow from screen {:.6f},{} to screen {:.6f},{} nohead {}\n", entry.x / width, at,
                        (entry.x + sample) / width, at, style);
    if (entry.appearance.markers)
      gp << fmt::format("set label '' at screen {:.6f},{} point {}\n", (entry.x + sample / 2) / width, at, style);
    for (std::size_t k = 0; k < entry.lines.size(); ++k)
      text(entry.lines[k], entry.x + sample + sample_gap, middle + legend_line * static_cast<double>(k),
           "left font ',12' textcolor rgb '#222222'");
  }
  gp << "plot [0:1] [0:1] NaN notitle\nunset label; unset arrow\n\n";
}

/// Frames the parts that other panels magnify.
void write_magnified(std::ostream& gp, const Layout& layout, std::size_t index) {
  const Frame& outer = layout.frames[index];
  for (const Frame& inner : layout.frames) {
    const bool inside = inner.x_min >= outer.x_min && inner.x_max <= outer.x_max && inner.y_min >= outer.y_min &&
                        inner.y_max <= outer.y_max;
    if (inside && inner != outer)
      gp << fmt::format("set object rectangle from {},{} to {},{} front fillstyle empty border rgb '#111111' lw 1.1\n",
                        inner.x_min, inner.y_min, inner.x_max, inner.y_max);
  }
}

/// Spans and marks with their labels; x0 and y0: the panel's upper left corner [px].
void write_spans_and_marks(std::ostream& gp, const Figure& figure, std::size_t index, const Layout& layout, double x0,
                           double y0) {
  const Figure::Panel& panel = figure.panels[index];
  const Frame& frame = layout.frames[index];
  const std::vector<std::string> kinds = span_kinds(figure);
  const auto nth = [&](const Figure::Span& span) {
    return static_cast<std::size_t>(std::find(kinds.begin(), kinds.end(), span.kind) - kinds.begin());
  };
  const auto screen_y = [&](double y) { return 1 - (y0 + y) / layout.height; };
  const auto words = [&](const std::string& text, double x, double y, const char* side) {
    gp << "set label " << quoted(text)
       << fmt::format(" at screen {:.6f},{:.6f} {} front font ',11' textcolor rgb '#222222'\n", (x0 + x) / width,
                      screen_y(y), side);
  };
  for (const Figure::Span& span : panel.spans) {
    if (!in_sight(span, frame)) continue;
    const double from = std::max(span.from, frame.x_min), to = std::min(span.to, frame.x_max);
    gp << fmt::format(
        "set object rectangle from {},graph 0 to {},graph 1 behind fillcolor rgb '{}' "
        "fillstyle transparent solid 0.18 noborder\n",
        from, to, span_look(nth(span)).tint);
    for (const double edge : {span.from, span.to})
      if (edge >= frame.x_min && edge <= frame.x_max)
        gp << fmt::format("set arrow from {0},graph 0 to {0},graph 1 nohead back ls {1}\n", edge,
                          span_styles + nth(span));
  }
  for (std::size_t i = 0; i < panel.marks.size(); ++i) {
    const Figure::Mark& mark = panel.marks[i];
    if (!in_sight(mark, frame)) continue;
    const std::string at = fmt::format("{}", mark.at);
    gp << (mark.vertical ? "set arrow from " + at + ",graph 0 to " + at + ",graph 1"
                         : "set arrow from graph 0,first " + at + " to graph 1,first " + at)
       << " nohead front ls " << mark_style << '\n';
    const Box& box = layout.mark_labels[index][i];
    if (box.w > 0) words(mark.label, box.x, box.y + box.h / 2, "left");
  }
  for (const Tag& tag : layout.tags[index]) {
    const double bottom = -2 - tag_line * static_cast<double>(tag.row);
    const double top = bottom - tag_line * static_cast<double>(tag.lines.size());
    for (std::size_t i = 0; i < tag.lines.size(); ++i)
      words(tag.lines[i], tag.text, top + tag_line * (static_cast<double>(i) + 0.5) - tag_bar / 2,
            tag.to_left ? "right" : "left");
    if (tag.mark != nullptr)
      gp << fmt::format("set arrow from {0},graph 1 to {0},screen {1:.6f} nohead front ls {2}\n", tag.mark->at,
                        screen_y(top + 2), mark_style);
    else  // a bar over the span, with ends of 5 px
      gp << fmt::format(
          "set arrow from {0},screen {2:.6f} to {1},screen {2:.6f} heads size screen {3:.6f},90 front ls {4}\n",
          std::max(tag.span->from, frame.x_min), std::min(tag.span->to, frame.x_max), screen_y(bottom - tag_bar / 2),
          2.5 / width, span_styles + nth(*tag.span));
  }
}

/// One element of a plot command: a series, or only its marked points.
struct Element {
  const Figure::Series* series = nullptr;
  const char* style = "lines";
  std::size_t look = 0;      ///< number of the line style
  std::size_t interval = 0;  ///< a point is written every so many from the start of each line; 0: the whole curve
  int layer = 0;             ///< in a motion diagram
  std::size_t first = 0;     ///< the first point written of each line
};

std::vector<Element> elements_of(const Figure& figure, const Figure::Panel& panel, const std::vector<Entry>& entries) {
  std::vector<Element> elements;
  for (const Figure::Series& series : panel.series) {
    if (!drawable(series)) continue;
    const auto entry = std::find_if(entries.begin(), entries.end(),
                                    [&](const Entry& e) { return e.label == series.label && e.kind == series.kind; });
    const auto look = static_cast<std::size_t>(entry - entries.begin()) + 1;
    const char* style = style_of(*entry);
    if (figure.motion && entry->appearance.markers) {
      // Markers of several methods take turns, or the last would hide the others where they agree.
      const auto marked = [](const Entry& e) { return e.appearance.markers; };
      const auto turns = static_cast<std::size_t>(std::count_if(entries.begin(), entries.end(), marked));
      const auto turn = static_cast<std::size_t>(std::count_if(entries.begin(), entry, marked));
      const std::size_t interval = interval_of(figure, panel, series.curve);
      elements.push_back({&series, "lines", look, 0, 1});
      elements.push_back({&series, "points", look, interval, 3, interval * turn / turns});
    } else if (style == std::string_view("linespoints") && broken(series.curve)) {
      // gnuplot counts from marker to marker through the breaks: a line would begin anywhere between two.
      elements.push_back({&series, "lines", look});
      elements.push_back({&series, "points", look, entry->interval});
    } else {
      elements.push_back({&series, style, look, 0, series.kind == "exact" ? 0 : 2});
    }
  }
  // Paths of methods that agree lie on each other: markers above, the lines between them below all but the exact one.
  if (figure.motion)
    std::stable_sort(elements.begin(), elements.end(),
                     [](const Element& a, const Element& b) { return a.layer < b.layer; });
  return elements;
}

/// What gnuplot is to read: the rows of NaN break a line.
std::vector<std::pair<double, double>> points_of(const Element& element) {
  const Curve& curve = element.series->curve;
  std::vector<std::pair<double, double>> points;
  std::size_t since_start = 0;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const bool gap = !std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i]);
    if (element.interval == 0 || (!gap && since_start % element.interval == element.first))
      points.emplace_back(curve.x[i], curve.y[i]);
    since_start = gap ? 0 : since_start + 1;
  }
  return points;
}

void write_panel(std::ostream& gp, const Figure& figure, std::size_t index, const Layout& layout,
                 const std::vector<Entry>& entries) {
  const Figure::Panel& panel = figure.panels[index];
  const std::size_t row = index / layout.columns, column = index % layout.columns;
  const double x0 = left + static_cast<double>(column) * (layout.panel_width + gap_across(layout.own));
  const double y0 = layout.top + static_cast<double>(row) * (layout.panel_height + layout.row_gap);
  const bool lowest = index + layout.columns >= figure.panels.size();
  const Frame& frame = layout.frames[index];

  gp << "# Panel " << index + 1 << '\n'
     << at_pixels(x0, x0 + layout.panel_width, y0, y0 + layout.panel_height, layout.height);
  if (index == 0)
    gp << "set border 3 back ls 101\n"
       << "set grid back ls 100\n"
       << "set xtics nomirror out scale 0.5 offset 0,0.4 font ',11' textcolor rgb '#333333'\n"
       << "set ytics nomirror out scale 0.5 font ',11' textcolor rgb '#333333'\n";
  if (index == 0 || layout.own.any_range())
    gp << fmt::format("set xrange [{}:{}]; set yrange [{}:{}]\n", frame.x_min, frame.x_max, frame.y_min, frame.y_max);
  gp << "set format x " << (lowest || layout.own.x_ticks() ? "'%g'" : "''") << "; set format y "
     << (column == 0 || layout.own.y_ticks() ? "'%g'" : "''") << '\n';
  if (layout.own.y_label) {
    const std::vector<std::string> lines =
        lines_of(panel.y_label.empty() ? figure.y_label : panel.y_label, layout.panel_height, label_char);
    for (std::size_t i = 0; i < lines.size(); ++i)
      gp << "set label " << quoted(lines[i])
         << fmt::format(" at screen {:.6f},{:.6f} center rotate by 90 font ',12' textcolor rgb '#222222'\n",
                        (x0 - y_label_offset +
                         label_line * (static_cast<double>(i) - static_cast<double>(lines.size() - 1) / 2)) /
                            width,
                        1 - (y0 + layout.panel_height / 2) / layout.height);
  }
  if (lowest || layout.own.x_label)
    gp << "set label " << quoted(panel.x_label.empty() ? figure.x_label : panel.x_label)
       << fmt::format(" at screen {:.6f},{:.6f} center font ',12' textcolor rgb '#222222'\n",
                      (x0 + layout.panel_width / 2) / width, 1 - (y0 + layout.panel_height + 34) / layout.height);
  if (figure.motion) write_magnified(gp, layout, index);
  if (crowded(panel)) write_spans_and_marks(gp, figure, index, layout, x0, y0);
  const Box& place = layout.places[index];
  const bool to_right = place.x > layout.panel_width / 2 - place.w / 2 + 1;
  for (std::size_t i = 0; i < layout.labels[index].size(); ++i)
    gp << "set label " << quoted(layout.labels[index][i])
       << fmt::format(" at screen {:.6f},{:.6f} {} front font ',12' textcolor rgb '#111111'\n",
                      (x0 + (to_right ? place.x + place.w : place.x)) / width,
                      1 - (y0 + place.y + label_line * (static_cast<double>(i) + 0.5)) / layout.height,
                      to_right ? "right" : "left");

  const std::vector<Element> elements = elements_of(figure, panel, entries);
  gp << "plot ";
  if (elements.empty()) gp << "NaN notitle";
  for (std::size_t i = 0; i < elements.size(); ++i)
    gp << (i == 0 ? "" : ", ") << "'-' with " << elements[i].style << " ls " << elements[i].look;
  gp << '\n';
  for (const Element& element : elements) send_points(gp, points_of(element));
  gp << "unset label" << (figure.motion || crowded(panel) ? "; unset object" : "")
     << (crowded(panel) ? "; unset arrow" : "") << "\n\n";
}

void write_script(std::ostream& gp, const Figure& figure) {
  const Heading heading = heading_of(figure.title, figure.notes, width - left - right);
  const std::vector<Entry> entries = entries_of(figure);
  const Layout layout =
      layout_of(figure, heading,
                entries.empty() ? 0 : entries.back().line + std::max<std::size_t>(entries.back().lines.size(), 1));
  gp << std::setprecision(16);  // 17 significant digits: enough to read the same double back
  write_head(gp, figure, heading, layout, entries);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) write_panel(gp, figure, i, layout, entries);
  gp << "unset multiplot\nset output\n";
}

// ---- the data

std::string csv_of(const Figure& figure) {
  std::string out = csv_note("figure", figure.id) + csv_note("title", figure.title);
  for (const std::string& note : figure.notes) out += csv_note("note", note);
  out += csv_note("x", figure.x_label) + csv_note("y", figure.y_label);
  bool breaks = false;
  for (const Figure::Panel& panel : figure.panels) {
    if (!panel.x_label.empty()) out += csv_note("x of panel '" + panel.label + "'", panel.x_label);
    if (!panel.y_label.empty()) out += csv_note("y of panel '" + panel.label + "'", panel.y_label);
    for (const Figure::Span& span : panel.spans)
      out += csv_note("span of panel '" + panel.label + "'",
                      fmt::format("x from {} to {}{}{}: {}", span.from, span.to, span.kind.empty() ? "" : ", ",
                                  span.kind, span.label));
    for (const Figure::Mark& mark : panel.marks)
      out += csv_note("mark of panel '" + panel.label + "'",
                      fmt::format("{} = {}: {}", mark.vertical ? 'x' : 'y', mark.at, mark.label));
    for (const Figure::Series& series : panel.series) breaks = breaks || broken(series.curve);
  }
  if (breaks) out += "# nan: a line ends here; the next row begins a new one\n";
  out += "panel,series,x,y\n";
  for (const Figure::Panel& panel : figure.panels)
    for (const Figure::Series& series : panel.series) {
      const std::string start = csv_field(panel.label) + "," + csv_field(series.label) + ",";
      for (std::size_t i = 0; i < series.curve.x.size(); ++i)
        out += start + csv_number(series.curve.x[i]) + "," + csv_number(series.curve.y[i]) + "\n";
    }
  return out;
}

void check(const Figure& figure) {
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument("figure '" + figure.id + "': " + why);
  };
  check_id(figure.id);
  if (figure.panels.empty()) refuse("no panels");
  const auto range = [&](double low, double high, const std::string& axis) {
    if (!std::isfinite(low) || !std::isfinite(high) || !(low < high))
      refuse(fmt::format("{} from {} to {} is no range", axis, low, high));
  };
  range(figure.x_min, figure.x_max, "x");
  range(figure.y_min, figure.y_max, "y");
  for (const Figure::Panel& panel : figure.panels) {
    if (panel.x_range) range((*panel.x_range)[0], (*panel.x_range)[1], "panel '" + panel.label + "', x");
    if (panel.y_range) range((*panel.y_range)[0], (*panel.y_range)[1], "panel '" + panel.label + "', y");
    for (const Figure::Span& span : panel.spans)
      if (!std::isfinite(span.from) || !std::isfinite(span.to) || !(span.from <= span.to))
        refuse(fmt::format("panel '{}', span '{}': from {} to {} is no range", panel.label, span.label, span.from,
                           span.to));
    for (const Figure::Mark& mark : panel.marks)
      if (!std::isfinite(mark.at))
        refuse(fmt::format("panel '{}', mark '{}': {} is no place", panel.label, mark.label, mark.at));
    for (const Figure::Series& series : panel.series)
      if (series.curve.x.size() != series.curve.y.size())
        refuse(fmt::format("panel '{}', series '{}': {} x but {} y", panel.label, series.label, series.curve.x.size(),
                           series.curve.y.size()));
  }
}

}  // namespace

Drawn draw(const Figure& figure, const fs::path& directory, std::string& message) {
  message.clear();
  check(figure);
  return draw_files(
      figure.id, csv_of(figure), [&](std::ostream& gp) { write_script(gp, figure); }, directory, message);
}

}  // namespace diptych::reports
