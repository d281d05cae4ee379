#include "reports/figure.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <gnuplot-iostream.h>
#pragma GCC diagnostic pop

#include "reports/files.hpp"

extern char** environ;

namespace diptych::reports {
namespace {

namespace fs = std::filesystem;

// ---- sizes of the picture [px]

constexpr double width = 900, left = 88, right = 24, column_gap = 36, row_gap = 14;
constexpr double margin = 14, title_line = 24, note_line = 15, legend_line = 20, x_axis = 46;
constexpr double label_line = 16, label_char = 7.0, note_char = 6.2, title_char = 9.4;  // generous for a sans face
constexpr double marker_spacing = 7.5;                         // closer markers melt into a band
constexpr double motion_height = 450, motion_spacing = 22;     // of panels and of markers along a path
constexpr double ticks_across = 62, ticks_down = 34;           // gaps between panels with tick labels of their own
constexpr double axis_across = 90, axis_down = 62;             // and with axis labels of their own
constexpr double y_label_offset = 72;                          // from a panel's left side
constexpr double sample = 34, sample_gap = 7, entry_gap = 26;  // of the legend

/// How a series looks. Colours after Okabe & Ito; shapes differ too, for print without colour.
struct Look {
  std::string line;  ///< gnuplot's line properties
  bool markers = false;
};
Look look(const std::string& kind, std::size_t nth) {
  if (kind == "exact") return {"lw 4.5 lc rgb '#c6c6c6'", false};
  if (kind == "fem") {
    constexpr std::array<const char*, 3> lines{"lw 1.4 lc rgb '#08306b'", "lw 1.4 lc rgb '#0072b2' dt (8,3)",
                                               "lw 1.4 lc rgb '#56b4e9' dt (2,3)"};
    return {lines[nth % lines.size()], false};
  }
  if (kind == "mpm") {
    constexpr std::array<const char*, 3> lines{"lc rgb '#d55e00' pt 6 ps 0.55", "lc rgb '#009e73' pt 4 ps 0.5",
                                               "lc rgb '#cc79a7' pt 8 ps 0.65"};
    return {lines[nth % lines.size()], true};
  }
  return {"lw 1.2 lc rgb '#000000'", false};
}

/// One entry of the legend: all series of this label, in every panel.
struct Entry {
  std::string label, kind;
  Look appearance;
  std::size_t interval = 1;  ///< a marker at every so many points; in a motion diagram the most of all panels
  bool motion = false;
  double x = 0;          ///< of its sample in the legend [px]
  std::size_t line = 0;  ///< of the legend
  std::string text() const;
};

struct Box {
  double x = 0, y = 0, w = 0, h = 0;  ///< from the panel's upper left corner [px]
};

/// Title and notes, broken into lines.
struct Heading {
  std::vector<std::string> title, notes;
  double height() const {
    return title_line * static_cast<double>(title.size()) + note_line * static_cast<double>(notes.size());
  }
};

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

struct Layout {
  std::size_t columns = 1, rows = 1;
  double panel_width = 0, panel_height = 0, row_gap = 0, legend = 0, top = 0, height = 0;
  Own own;
  std::vector<Frame> frames;                     ///< y_max with room for the labels where data leave none
  std::vector<std::vector<std::string>> labels;  ///< lines of each panel's label
  std::vector<Box> places;
};

std::size_t characters(std::string_view text) {  // UTF-8 code points
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// Breaks at spaces into lines of at most so many pixels, where words allow.
std::vector<std::string> lines_of(const std::string& text, double pixels, double per_character) {
  const auto limit = static_cast<std::size_t>(pixels / per_character);
  std::vector<std::string> lines;
  std::string line;
  std::size_t used = 0;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n\r\t", at), text.size());
    const std::string word = text.substr(at, end - at);
    const std::size_t length = characters(word);
    if (used > 0 && used + 1 + length > limit) {
      lines.push_back(std::exchange(line, ""));
      used = 0;
    }
    if (used > 0 && length > 0) line += ' ', ++used;
    line += word;
    used += length;
    at = end + 1;
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

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

/// Label of the panel, and which series it cannot show: a lost one must not look like a hidden one.
std::string label_of(const Figure& figure, const Figure::Panel& panel) {
  const bool magnified = panel.x_range || panel.y_range;
  std::string missing, outside;
  for (const Figure::Series& series : panel.series) {
    if (!drawable(series))
      missing += (missing.empty() ? "" : ", ") + series.label;
    else if (magnified && !seen(series.curve, frame_of(figure, panel), 1, 1).any)
      outside += (outside.empty() ? "" : ", ") + series.label;
  }
  std::string label = panel.label;
  if (!missing.empty()) label += " [no finite values: " + missing + "]";
  if (!outside.empty()) label += " [outside the axes: " + outside + "]";
  return label;
}

/// Whether any curve of the panel passes through the box.
bool crossed(const Figure::Panel& panel, const Frame& frame, const Layout& layout, const Box& box) {
  constexpr double clearance = 5;
  const double x_scale = layout.panel_width / (frame.x_max - frame.x_min);
  const double y_scale = layout.panel_height / (frame.y_max - frame.y_min);
  for (const Figure::Series& series : panel.series) {
    double last_x = 0, last_y = 0;
    bool has_last = false;
    for (std::size_t i = 0; i < series.curve.x.size(); ++i) {
      const double x = (series.curve.x[i] - frame.x_min) * x_scale;
      const double y = (frame.y_max - series.curve.y[i]) * y_scale;
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
  }
  return false;
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
  std::size_t most = 1;
  for (const Figure::Panel& panel : figure.panels) {
    layout.frames.push_back(frame_of(figure, panel));
    layout.labels.push_back(
        lines_of(label_of(figure, panel), layout.panel_width - (figure.motion ? 0 : 24), label_char));
    most = std::max(most, layout.labels.back().size());
  }
  const double strip = label_line * static_cast<double>(most) + 8;
  const auto in_strip = [&](double x, double y) {
    layout.places.clear();
    for (const auto& lines : layout.labels)
      layout.places.push_back({x, y, length_of(lines), label_line * static_cast<double>(lines.size())});
  };
  if (figure.motion) {
    // Paths go everywhere and time must not seem to go on: labels stand above the panels.
    layout.top += strip;
    layout.row_gap += strip;
    in_strip(0, 2 - strip);
  } else if (!place_labels(figure, layout)) {
    // Data fill some panel: lift the axis of all, so that labels have a strip of their own above y_max.
    for (Frame& frame : layout.frames) frame.y_max += (frame.y_max - frame.y_min) * strip / layout.panel_height;
    layout.panel_height += strip;
    in_strip(10, 4);
  }
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
        entries.push_back({series.label, series.kind, look(series.kind, static_cast<std::size_t>(nth))});
        entry = std::prev(entries.end());
        entry->motion = figure.motion;
      }
      if (entry->appearance.markers)
        entry->interval = std::max(entry->interval, interval_of(figure, panel, series.curve));
    }
  double x = left;
  std::size_t line = 0;
  for (Entry& entry : entries) {
    const double needed = sample + sample_gap + static_cast<double>(characters(entry.text())) * label_char;
    if (x > left && x + needed > width - right) x = left, ++line;
    entry.x = x;
    entry.line = line;
    x += needed + entry_gap;
  }
  return entries;
}

// ---- the script

/// A string in gnuplot's single quotes, in which nothing is expanded.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += '\'';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + "'";
}

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

std::string end_mark(const Figure& figure) { return "# end of " + figure.id + "\n"; }

void write_head(Gnuplot& gp, const Figure& figure, const Heading& heading, const Layout& layout,
                const std::vector<Entry>& entries) {
  gp << "# " << figure.id << ": stand-alone, data included; 'gnuplot " << figure.id << ".gp' writes " << figure.id
     << ".svg beside it.\n"
     << "set encoding utf8\n"
     << fmt::format("set terminal svg noenhanced rounded size {:.0f},{:.0f}", width, layout.height)
     << " font 'sans-serif,12' background rgb '#ffffff'\n"
     << "if (!exists('output_file')) {\n"
     << "  slash = 0\n"
     << "  if (exists('ARG0')) { do for [i=1:strlen(ARG0)] { if (ARG0[i:i] eq '/') { slash = i } } }\n"
     << "  output_file = (slash > 0 ? ARG0[1:slash] : '') . '" << figure.id << ".svg'\n"
     << "}\n"
     << "set output output_file\n\n"
     << "# Change the looks here.\n";
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& entry = entries[i];
    std::string style = entry.appearance.line;
    // Markers joined by a line: a thin one, which leaves what lies beneath in sight.
    if (entry.appearance.markers)
      style += entry.motion ? " lw 0.9" : entry.interval > 1 ? fmt::format(" lw 0.9 pi {}", entry.interval) : " lw 1.3";
    gp << "set style line " << i + 1 << ' ' << style << "  # " << quoted(entry.label) << '\n';
  }
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
    text(entry.text(), entry.x + sample + sample_gap, middle, "left font ',12' textcolor rgb '#222222'");
  }
  gp << "plot [0:1] [0:1] NaN notitle\nunset label; unset arrow\n\n";
}

/// Frames the parts that other panels magnify.
void write_magnified(Gnuplot& gp, const Layout& layout, std::size_t index) {
  const Frame& outer = layout.frames[index];
  for (const Frame& inner : layout.frames) {
    const bool inside = inner.x_min >= outer.x_min && inner.x_max <= outer.x_max && inner.y_min >= outer.y_min &&
                        inner.y_max <= outer.y_max;
    if (inside && inner != outer)
      gp << fmt::format("set object rectangle from {},{} to {},{} front fillstyle empty border rgb '#111111' lw 1.1\n",
                        inner.x_min, inner.y_min, inner.x_max, inner.y_max);
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

void write_panel(Gnuplot& gp, const Figure& figure, std::size_t index, const Layout& layout,
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
  for (const Element& element : elements) gp.send1d(points_of(element));
  gp << "unset label" << (figure.motion ? "; unset object" : "") << "\n\n";
}

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// A name beside the final files that is removed on the way out.
struct Scratch {
  explicit Scratch(fs::path where) : path(std::move(where)) {}
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
  fs::path path;
};

std::string script_of(const Figure& figure, const fs::path& directory) {
  Heading heading{lines_of(figure.title, width - left - right, title_char), {}};
  for (const std::string& note : figure.notes)
    for (std::string& line : lines_of(note, width - left - right, note_char)) heading.notes.push_back(std::move(line));
  const std::vector<Entry> entries = entries_of(figure);
  const Layout layout = layout_of(figure, heading, entries.empty() ? 0 : entries.back().line + 1);

  // gnuplot-iostream writes only to a file of its own and reports no failure: read back what arrived.
  const Scratch file(directory / fmt::format(".{}.gp.{}.tmp", figure.id, ::getpid()));
  bool good = false;
  errno = 0;
  try {
    Gnuplot gp(">" + file.path.string());
    gp << std::setprecision(16);  // 17 significant digits: enough to read the same double back
    write_head(gp, figure, heading, layout, entries);
    for (std::size_t i = 0; i < figure.panels.size(); ++i) write_panel(gp, figure, i, layout, entries);
    gp << "unset multiplot\nset output\n" << end_mark(figure) << std::flush;
    good = gp.good();
  } catch (const std::ios_base::failure&) {
    good = false;
  }
  const int error = errno;
  std::string script = contents(file.path);
  if (!good || !script.ends_with(end_mark(figure)))
    throw std::runtime_error((directory / (figure.id + ".gp")).string() +
                             ": cannot write: " + (error != 0 ? std::strerror(error) : "it came out incomplete"));
  return script;
}

// ---- the data

std::string csv_field(const std::string& text) {  // RFC 4180
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string csv_of(const Figure& figure) {
  const auto meta = [](const std::string& key, std::string value) {
    std::replace_if(
        value.begin(), value.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return "# " + key + ": " + value + "\n";
  };
  const auto number = [](double v) { return std::isnan(v) ? std::string("nan") : fmt::format("{}", v); };
  std::string out = meta("figure", figure.id) + meta("title", figure.title);
  for (const std::string& note : figure.notes) out += meta("note", note);
  out += meta("x", figure.x_label) + meta("y", figure.y_label);
  bool breaks = false;
  for (const Figure::Panel& panel : figure.panels) {
    if (!panel.x_label.empty()) out += meta("x of panel '" + panel.label + "'", panel.x_label);
    if (!panel.y_label.empty()) out += meta("y of panel '" + panel.label + "'", panel.y_label);
    for (const Figure::Series& series : panel.series) breaks = breaks || broken(series.curve);
  }
  if (breaks) out += "# nan: a line ends here; the next row begins a new one\n";
  out += "panel,series,x,y\n";
  for (const Figure::Panel& panel : figure.panels)
    for (const Figure::Series& series : panel.series) {
      const std::string start = csv_field(panel.label) + "," + csv_field(series.label) + ",";
      for (std::size_t i = 0; i < series.curve.x.size(); ++i)
        out += start + number(series.curve.x[i]) + "," + number(series.curve.y[i]) + "\n";
    }
  return out;
}

// ---- running gnuplot

struct Outcome {
  bool found = true;
  int status = 0;  ///< as from waitpid
  std::string words;
};

/// Runs gnuplot in `directory`, without a shell; its output and complaints are collected.
Outcome run_gnuplot(const fs::path& directory, const std::string& script, const std::string& output) {
  Outcome outcome;
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));

  // Names hold no quotes: draw() has checked the id. -d: no start-up file of the user's may change the picture.
  std::array<std::string, 5> words{"gnuplot", "-d", "-e", "output_file='" + output + "'", script};
  std::array<char*, words.size() + 1> arguments{};
  for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 2);
  posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (error != 0) {
    ::close(ends[0]);
    outcome.found = false;
    outcome.words = std::string("gnuplot: ") + std::strerror(error);
    return outcome;
  }
  std::array<char, 4096> buffer{};
  for (ssize_t got = 0; (got = ::read(ends[0], buffer.data(), buffer.size())) != 0;) {
    if (got > 0) outcome.words.append(buffer.data(), static_cast<std::size_t>(got));
    if (got < 0 && errno != EINTR) break;
  }
  ::close(ends[0]);
  while (::waitpid(child, &outcome.status, 0) < 0 && errno == EINTR) {
  }
  return outcome;
}

/// What is wrong with the run or its picture; empty if nothing.
std::string complaint(const Outcome& outcome, const fs::path& svg) {
  std::string wrong;
  if (WIFSIGNALED(outcome.status))
    wrong = fmt::format("gnuplot was killed by signal {}", WTERMSIG(outcome.status));
  else if (WEXITSTATUS(outcome.status) != 0)
    wrong = fmt::format("gnuplot exited with status {}", WEXITSTATUS(outcome.status));
  else {
    const std::string picture = contents(svg);
    const std::size_t last = picture.find_last_not_of(" \n\r\t");
    const bool complete = last != std::string::npos && picture.substr(0, last + 1).ends_with("</svg>") &&
                          picture.find("<svg") != std::string::npos;
    if (picture.empty())
      wrong = "gnuplot wrote no picture";
    else if (!complete)
      wrong = "gnuplot's picture is incomplete";
  }
  return wrong.empty() || outcome.words.empty() ? wrong : wrong + ": " + outcome.words;
}

void check(const Figure& figure) {
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument("figure '" + figure.id + "': " + why);
  };
  constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  if (figure.id.empty() || figure.id.front() == '.' || figure.id.front() == '-' ||
      figure.id.find_first_not_of(allowed) != std::string::npos)
    refuse("an id names files: letters, digits, '_', '-' and '.', starting with a letter, digit or '_'");
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
  write_file(directory / (figure.id + ".csv"), csv_of(figure));  // also creates the directory
  write_file(directory / (figure.id + ".gp"), script_of(figure, directory));
  const fs::path svg = directory / (figure.id + ".svg");
  std::error_code ignored;
  fs::remove(svg, ignored);

  const Scratch unfinished(directory / fmt::format(".{}.svg.{}.tmp", figure.id, ::getpid()));
  const Outcome outcome = run_gnuplot(directory, figure.id + ".gp", unfinished.path.filename().string());
  if (!outcome.found) {
    message = outcome.words;
    return Drawn::gnuplot_missing;
  }
  message = complaint(outcome, unfinished.path);
  if (!message.empty()) return Drawn::gnuplot_failed;
  fs::rename(unfinished.path, svg);
  return Drawn::yes;
}

}  // namespace diptych::reports
