#include "reports/plate_figure.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <utility>

#include "reports/bands.hpp"
#include "reports/gnuplot.hpp"

namespace diptych::reports {
namespace {

using Contour = PlateFigure::Contour;
using Panel = PlateFigure::Panel;
using Map = PlateFigure::Map;

// ---- sizes of the picture [px]

constexpr double page = 900, least_page = 640, left = 74, right = 22, column_gap = 28, row_gap = 16, x_axis = 48;
constexpr double tallest = 430, legend_line = 24, sample = 40, sample_gap = 7, entry_gap = 28;
constexpr double bar_height = 13, bar_strip = 58, widest_bar = 440, bar_tip = 9;
constexpr double contour_char = 6.3, contour_line = 15, clearance = 3;  // of labels on the contours

/// How contours of a kind look: the lines differ too, for print without colour. Colours as in the other figures.
struct Look {
  std::string kind, name, line;
};
std::vector<Look> looks_of(const PlateFigure& figure) {
  std::vector<Look> looks;
  for (const PanelLook& one : figure.looks)
    if (!one.contour.empty()) looks.push_back({one.id, one.name + " contour", one.contour});
  looks.push_back({"difference", "contour of the difference", "lw 1.4 lc rgb '#333333' dt (2,4)"});
  return looks;
}

std::size_t look_of(const std::vector<Look>& looks, const std::string& kind) {
  return static_cast<std::size_t>(
      std::find_if(looks.begin(), looks.end(), [&](const Look& look) { return look.kind == kind; }) - looks.begin());
}

struct Box {
  double x = 0, y = 0, w = 0, h = 0;  ///< upper left corner and size [px]
  bool apart(const Box& other, double gap) const {
    return x + w + gap <= other.x || other.x + other.w + gap <= x || y + h + gap <= other.y ||
           other.y + other.h + gap <= y;
  }
};

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
  double width = page, height = 0, panel_width = 0, panel_height = 0, pixels = 1;  ///< pixels: of one unit of length
  double legend = 0, top = 0, row_step = 0, strip = 0;                             ///< strip: for the panels' labels
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

bool drawn(const Line& line) {
  for (std::size_t i = 0; i < line.x.size(); ++i)
    if (std::isfinite(line.x[i]) && std::isfinite(line.y[i])) return true;
  return false;
}

bool drawn(const Contour& contour) {
  return std::any_of(contour.lines.begin(), contour.lines.end(), [](const Line& line) { return drawn(line); });
}

bool has_gap(const Map& map) {
  return std::any_of(map.nodes.begin(), map.nodes.end(), [](double v) { return std::isnan(v); });
}

/// Label of the panel, and which contours it cannot show: a level that is not reached must not look like a lost one.
std::string label_of(const Panel& panel, const std::vector<PanelLook>& looks) {
  std::string missing;
  std::vector<std::string> named;
  for (const Contour& contour : panel.contours) {
    if (drawn(contour)) continue;
    std::string name = contour.label.empty() ? fmt::format("{}", contour.level) : contour.label;
    const bool by_other = std::any_of(panel.contours.begin(), panel.contours.end(), [&](const Contour& other) {
      return drawn(other) && other.level == contour.level && other.kind != contour.kind;
    });
    for (const PanelLook& look : looks)
      if (by_other && look.id == contour.kind) name = look.name + " " + name;
    if (std::find(named.begin(), named.end(), name) != named.end()) continue;
    missing += (missing.empty() ? "" : ", ") + name;
    named.push_back(name);
  }
  std::string label = panel.label;
  if (!missing.empty()) label += " [not reached: " + missing + "]";
  if (panel.map && has_gap(*panel.map)) label += " [grey: no value]";
  return label;
}

std::size_t scale_for(std::vector<Scale>& scales, const Map& map) {
  const auto same = [&](const Scale& s) {
    return s.map.min == map.min && s.map.max == map.max && s.map.label == map.label && s.map.diverging == map.diverging;
  };
  auto found = std::find_if(scales.begin(), scales.end(), same);
  if (found == scales.end()) {
    scales.push_back({map, bands_of(map)});
    found = std::prev(scales.end());
  }
  for (const double value : map.nodes) {
    found->below = found->below || value < map.min;
    found->above = found->above || value > map.max;
  }
  return static_cast<std::size_t>(found - scales.begin());
}

/// The one scale of a column's maps; none if they differ or if there is no map.
std::optional<std::size_t> scale_of_column(const Layout& layout, std::size_t column) {
  std::optional<std::size_t> scale;
  for (std::size_t i = column; i < layout.scale_of.size(); i += layout.columns) {
    if (layout.scale_of[i] == layout.scales.size()) continue;
    if (scale && *scale != layout.scale_of[i]) return {};
    scale = layout.scale_of[i];
  }
  return scale;
}

void place_bars(Layout& layout, std::size_t panels) {
  const auto add = [&](std::size_t scale, double x0, double x1, double y) {
    const double w = std::min(widest_bar, x1 - x0) - 2 * bar_tip;
    layout.bars.push_back({scale, (x0 + x1 - w) / 2, y, w});
  };
  double last_bottom = layout.top + static_cast<double>(layout.rows - 1) * layout.row_step + layout.panel_height;
  std::size_t column = 0;
  while (column < layout.columns) {
    const auto scale = scale_of_column(layout, column);
    if (scale) {
      std::size_t end = column + 1;  // columns side by side share the bar
      while (end < layout.columns && scale_of_column(layout, end) == scale) ++end;
      add(*scale, layout.x_of(column), layout.x_of(end - 1) + layout.panel_width, last_bottom + x_axis + 20);
      column = end;
      continue;
    }
    for (std::size_t i = column; i < panels; i += layout.columns)
      if (layout.scale_of[i] != layout.scales.size()) {
        const bool lowest = i + layout.columns >= panels;
        add(layout.scale_of[i], layout.x_of(i), layout.x_of(i) + layout.panel_width,
            layout.y_of(i) + layout.panel_height + (lowest ? x_axis + 20 : 26));
      }
    ++column;
  }
}

Layout layout_of(const PlateFigure& figure) {
  Layout layout;
  const std::size_t count = figure.panels.size();
  layout.columns = std::min(static_cast<std::size_t>(figure.columns), count);
  layout.rows = (count + layout.columns - 1) / layout.columns;
  const auto columns = static_cast<double>(layout.columns);
  layout.pixels =
      std::min((page - left - right - (columns - 1) * column_gap) / columns / figure.width, tallest / figure.height);
  layout.panel_width = layout.pixels * figure.width;
  layout.panel_height = layout.pixels * figure.height;
  layout.width = std::max(least_page, left + columns * layout.panel_width + (columns - 1) * column_gap + right);
  layout.heading = heading_of(figure.title, figure.notes, layout.width - left - right);
  layout.legend = margin + layout.heading.height() + 6;
  layout.looks = looks_of(figure);
  for (std::size_t k = 0; k < layout.looks.size(); ++k)
    if (std::any_of(figure.panels.begin(), figure.panels.end(), [&](const Panel& panel) {
          return std::any_of(panel.contours.begin(), panel.contours.end(),
                             [&](const Contour& contour) { return contour.kind == layout.looks[k].kind; });
        }))
      layout.kinds.push_back(k);
  std::size_t most = 1;
  for (const Panel& panel : figure.panels) {
    layout.labels.push_back(lines_of(label_of(panel, figure.looks), layout.panel_width, label_char));
    most = std::max(most, layout.labels.back().size());
    layout.scale_of.push_back(panel.map ? scale_for(layout.scales, *panel.map) : std::string::npos);
  }
  for (std::size_t& scale : layout.scale_of) scale = std::min(scale, layout.scales.size());
  layout.strip = label_line * static_cast<double>(most) + 6;
  layout.top = layout.legend + (layout.kinds.empty() ? 0 : legend_line) + layout.strip;
  bool own_bars = false, bars_below = false;
  for (std::size_t column = 0; column < layout.columns; ++column) {
    const bool some = [&] {
      for (std::size_t i = column; i < count; i += layout.columns)
        if (layout.scale_of[i] != layout.scales.size()) return true;
      return false;
    }();
    bars_below = bars_below || some;
    own_bars = own_bars || (some && !scale_of_column(layout, column));
  }
  layout.row_step = layout.panel_height + layout.strip + row_gap + (own_bars ? bar_strip : 0);
  place_bars(layout, count);
  layout.height = layout.top + static_cast<double>(layout.rows - 1) * layout.row_step + layout.panel_height + x_axis +
                  (bars_below ? bar_strip + 6 : 0);
  return layout;
}

// ---- labels on the contours

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

struct PlacedLabel {
  std::string text;
  Box box;
};

/// Finds places in one panel for small labels that cover no other and, where they can, no line.
class Labels {
 public:
  Labels(const PlateFigure& figure, const Panel& panel, const Layout& layout)
      : width_(layout.panel_width), height_(layout.panel_height) {
    for (const Contour& contour : panel.contours) lines_.push_back(in_pixels(contour, figure, layout.pixels));
  }

  const std::vector<std::vector<Line>>& lines() const { return lines_; }
  const std::vector<PlacedLabel>& placed() const { return placed_; }

  void begin(const std::string& text) {
    best_ = {text, {0, 0, static_cast<double>(characters(text)) * contour_char + 6, contour_line}};
    least_ = std::numeric_limits<double>::infinity();
  }
  /// A centre where the label may stand, relative to (x, y) by halves of its own size. Lines of the contour `own` may
  /// pass below it, all others cost by their covered length.
  void offer(double x, double y, double halves_across, double halves_down, double cost, std::size_t own) {
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
  void end() {
    if (std::isfinite(least_)) placed_.push_back(best_);
  }

 private:
  double width_, height_;
  std::vector<std::vector<Line>> lines_;  ///< of each contour [px]
  std::vector<PlacedLabel> placed_;
  PlacedLabel best_;
  double least_ = 0;
};

/// Labels on their lines where no other line passes; beside a line that is too short; on another line at worst.
void place_on_contours(Labels& labels, const Panel& panel) {
  for (std::size_t c = 0; c < panel.contours.size(); ++c) {
    const std::string& text = panel.contours[c].label;
    const std::vector<Line>& lines = labels.lines()[c];
    const bool again = std::any_of(labels.placed().begin(), labels.placed().end(),
                                   [&](const PlacedLabel& label) { return label.text == text; });
    if (text.empty() || again || lines.empty()) continue;
    const Line& line = *std::max_element(lines.begin(), lines.end(),
                                         [](const Line& a, const Line& b) { return length_of(a) < length_of(b); });
    labels.begin(text);
    for (const double share : {0.5, 0.45, 0.55, 0.4, 0.6, 0.35, 0.65, 0.3, 0.7, 0.25, 0.75, 0.2, 0.8, 0.15, 0.85}) {
      const auto [x, y] = point_at(line, share);
      const double off = 10 * std::abs(share - 0.5);
      labels.offer(x, y, 0, 0, off, c);
      for (const double side : {1.0, -1.0})
        for (const double up : {-1.0, 1.0}) labels.offer(x, y, side, up, 25 + off, c);
    }
    labels.end();
  }
}

/// Where a map is largest and least; its sign must be legible without colour.
struct Extreme {
  double x = 0, y = 0, value = 0;  ///< [plate's units]
};
std::vector<Extreme> extremes_of(const PlateFigure& figure, const Map& map, const Bands& bands) {
  std::vector<Extreme> found;
  const double low = bands.edges[bands.edges.size() / 2 - 1], high = bands.edges[bands.edges.size() / 2];
  for (const double sign : {1.0, -1.0}) {
    std::optional<std::size_t> best;
    for (std::size_t n = 0; n < map.nodes.size(); ++n)
      if (std::isfinite(map.nodes[n]) && (!best || sign * map.nodes[n] > sign * map.nodes[*best])) best = n;
    if (!best || (map.nodes[*best] >= low && map.nodes[*best] <= high)) continue;  // within the white band
    if (sign < 0 && map.nodes[*best] > high) continue;
    if (sign > 0 && map.nodes[*best] < low) continue;
    const std::size_t across = static_cast<std::size_t>(map.nx) + 1;
    found.push_back({figure.width * static_cast<double>(*best % across) / map.nx,
                     figure.height * static_cast<double>(*best / across) / map.ny, map.nodes[*best]});
  }
  return found;
}

// ---- the script

struct Script {
  std::ostream& gp;
  double width, height;  ///< of the page [px]

  std::string at(double x, double y) const { return fmt::format("screen {:.6f},{:.6f}", x / width, 1 - y / height); }
  void text(const std::string& words, double x, double y, const std::string& style) const {
    gp << "set label " << marked(words) << " at " << at(x, y) << ' ' << style << '\n';
  }
  void margins(double x0, double x1, double y0, double y1) const {
    gp << fmt::format(
        "set lmargin at screen {:.6f}; set rmargin at screen {:.6f}\n"
        "set tmargin at screen {:.6f}; set bmargin at screen {:.6f}\n",
        x0 / width, x1 / width, 1 - y0 / height, 1 - y1 / height);
  }
};

std::string minus(std::string number) {  // typographic
  if (number.starts_with('-')) number.replace(0, 1, "−");
  return number;
}

/// A step of 1, 2 or 5 times a power of ten, so that so many pixels show at least `gap` of them.
double tick_step(double range, double pixels, double gap) {
  const double least = range * gap / pixels, power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

std::string colour_of(std::size_t scale, std::size_t band) {
  return fmt::format("rgb word(bands{}, {})", scale + 1, band + 1);
}

void write_bar(const Script& page_of, const Scale& scale, std::size_t index, const Bar& bar) {
  std::ostream& gp = page_of.gp;
  const std::vector<double>& edges = scale.bands.edges;
  const auto place = [&](double value) {
    return bar.x + (value - edges.front()) / (edges.back() - edges.front()) * bar.w;
  };
  const double y1 = bar.y + bar_height, middle = bar.y + bar_height / 2;
  const auto box = [&](double x0, double x1, const std::string& style) {
    gp << "set object rectangle from " << page_of.at(x0, y1) << " to " << page_of.at(x1, bar.y) << ' ' << style << '\n';
  };
  for (std::size_t k = 0; k + 1 < edges.size(); ++k)
    box(place(edges[k]), place(edges[k + 1]), "fc " + colour_of(index, k) + " fs solid noborder");
  const auto tip = [&](double x, double to, std::size_t band) {
    gp << "set object polygon from " << page_of.at(x, bar.y) << " to " << page_of.at(to, middle) << " to "
       << page_of.at(x, y1) << " to " << page_of.at(x, bar.y) << " fc " << colour_of(index, band)
       << " fs solid border lc rgb '#707070' lw 0.7\n";
  };
  if (scale.below) tip(bar.x - 1, bar.x - 1 - bar_tip, 0);
  if (scale.above) tip(bar.x + bar.w + 1, bar.x + bar.w + 1 + bar_tip, edges.size() - 2);
  box(bar.x, bar.x + bar.w, "fs empty border lc rgb '#707070' lw 0.7");
  page_of.text(scale.map.label, bar.x + bar.w / 2, bar.y - 10, "center font ',12' textcolor rgb '#222222'");

  // Ticks at edges, every so many, counted from the middle of a diverging bar and else from its start.
  const bool two_sided = scale.map.diverging;
  const std::size_t steps = two_sided ? edges.size() / 2 : edges.size() - 1;
  const double step_px = bar.w / static_cast<double>(two_sided ? 2 * steps : steps);
  std::size_t every = 1;
  while (every < steps && (static_cast<double>(every) * step_px < 40 || steps % every != 0)) ++every;
  const auto tick = [&](double value) {
    const double x = place(value);
    const double shown = std::abs(value) < 1e-9 * (edges.back() - edges.front()) ? 0 : value;
    gp << "set arrow from " << page_of.at(x, y1) << " to " << page_of.at(x, y1 + 4)
       << " nohead lw 0.8 lc rgb '#707070'\n";
    page_of.text(minus(fmt::format("{:.4g}", shown)), x, y1 + 12, "center font ',11' textcolor rgb '#333333'");
  };
  const double low = edges.front(), range = edges.back() - edges.front();
  const std::size_t all = two_sided ? 2 * steps : steps;
  for (std::size_t k = 0; k <= all; k += every) tick(low + range * static_cast<double>(k) / static_cast<double>(all));
}

void write_head(const Script& script, const PlateFigure& figure, const Layout& layout) {
  std::ostream& gp = script.gp;
  begin_page(gp, figure.id, layout.width, layout.height, true);
  gp << "# Change the looks here.\n";
  for (const std::size_t k : layout.kinds)
    gp << "set style line " << k + 1 << ' ' << layout.looks[k].line << "  # " << layout.looks[k].name << '\n';
  gp << "set style line 99 lw 4.2 lc rgb '#ffffff'  # under the contours\n"
     << "set style line 101 lw 0.9 lc rgb '#707070'  # axes\n";
  for (std::size_t s = 0; s < layout.scales.size(); ++s) {
    gp << "bands" << s + 1 << " = '";
    for (std::size_t k = 0; k < layout.scales[s].bands.colours.size(); ++k)
      gp << (k == 0 ? "" : " ") << layout.scales[s].bands.colours[k];
    gp << "'\n";
  }
  gp << "\nset multiplot\n\n# Title, notes, legend and colour bars: an empty plot across the page.\n";
  script.margins(left, layout.width - right, layout.legend, layout.top);
  gp << "unset border; unset tics; unset key\n";
  double y = margin;
  for (const std::string& line : layout.heading.title) {
    script.text(line, left, y + 8, "left font ',16' textcolor rgb '#111111'");
    y += title_line;
  }
  for (const std::string& line : layout.heading.notes) {
    script.text(line, left, y + 5, "left font ',11' textcolor rgb '#666666'");
    y += note_line;
  }
  double x = left;
  const double middle = layout.legend + 8;
  for (const std::size_t k : layout.kinds) {
    gp << "set arrow from " << script.at(x, middle) << " to " << script.at(x + sample, middle) << " nohead ls " << k + 1
       << '\n';
    script.text(layout.looks[k].name, x + sample + sample_gap, middle, "left font ',12' textcolor rgb '#222222'");
    x += sample + sample_gap + static_cast<double>(characters(layout.looks[k].name)) * label_char + entry_gap;
  }
  script.text(figure.y_label, 18,
              layout.top + (static_cast<double>(layout.rows - 1) * layout.row_step + layout.panel_height) / 2,
              "center rotate by 90 font ',12' textcolor rgb '#222222'");
  for (const Bar& bar : layout.bars) write_bar(script, layout.scales[bar.scale], bar.scale, bar);
  gp << "plot [0:1] [0:1] NaN notitle\nunset label; unset arrow; unset object\n\n";
}

/// The bands as polygons that lie on each other, the lowest first. Returns the numbers of those that are not empty.
std::vector<std::size_t> write_bands(std::ostream& gp, const PlateFigure& figure, const Map& map, const Scale& scale,
                                     const std::string& block) {
  std::vector<std::size_t> bands;
  gp << block << " << EOD\n";
  for (std::size_t k = 0; k < scale.bands.colours.size(); ++k) {
    const double level = k == 0 ? -std::numeric_limits<double>::infinity() : scale.bands.edges[k];
    const std::vector<Line> rings = region_above(map, figure.width, figure.height, level);
    if (rings.empty()) continue;
    if (!bands.empty()) gp << "\n\n";
    const Line polygon = joined(rings);
    for (std::size_t i = 0; i < polygon.x.size(); ++i) gp << fmt::format("{:.6g} {:.6g}\n", polygon.x[i], polygon.y[i]);
    bands.push_back(k);
  }
  gp << "EOD\n";
  return bands;
}

void write_lines(std::ostream& gp, const Contour& contour, const std::string& block) {
  gp << block << " << EOD\n";
  for (const Line& line : contour.lines) {
    for (std::size_t i = 0; i < line.x.size(); ++i)
      if (std::isfinite(line.x[i]) && std::isfinite(line.y[i]))
        gp << fmt::format("{} {}\n", line.x[i], line.y[i]);
      else
        gp << "\n";  // a break
    gp << "\n";
  }
  gp << "EOD\n";
}

void write_panel(const Script& script, const PlateFigure& figure, std::size_t index, const Layout& layout) {
  std::ostream& gp = script.gp;
  const Panel& panel = figure.panels[index];
  const double x0 = layout.x_of(index), y0 = layout.y_of(index);
  const bool lowest = index + layout.columns >= figure.panels.size();
  std::vector<std::string> elements;

  gp << "# Panel " << index + 1 << '\n';
  if (panel.map) {
    if (has_gap(*panel.map))
      gp << fmt::format("set object rectangle from 0,0 to {},{} behind fc rgb '#c8c8c8' fs solid noborder\n",
                        figure.width, figure.height);
    const std::string block = fmt::format("$map{}", index + 1);
    const std::size_t scale = layout.scale_of[index];
    const std::vector<std::size_t> bands = write_bands(gp, figure, *panel.map, layout.scales[scale], block);
    for (std::size_t k = 0; k < bands.size(); ++k)
      elements.push_back(fmt::format("{} index {} with filledcurves closed fc {} fs solid noborder", block, k,
                                     colour_of(scale, bands[k])));
  }
  for (std::size_t c = 0; c < panel.contours.size(); ++c)
    if (drawn(panel.contours[c])) {
      const std::string block = fmt::format("$contour{}_{}", index + 1, c + 1);
      write_lines(gp, panel.contours[c], block);
      if (panel.map) elements.push_back(block + " with lines ls 99");
    }
  for (std::size_t c = 0; c < panel.contours.size(); ++c)
    if (drawn(panel.contours[c]))
      elements.push_back(fmt::format("$contour{}_{} with lines ls {}", index + 1, c + 1,
                                     look_of(layout.looks, panel.contours[c].kind) + 1));

  script.margins(x0, x0 + layout.panel_width, y0, y0 + layout.panel_height);
  if (index == 0)
    gp << "set border 15 front ls 101\n"
       << fmt::format("set xrange [0:{}]; set yrange [0:{}]\n", figure.width, figure.height)
       << fmt::format("set xtics {} nomirror out scale 0.5 offset 0,0.4 font ',11' textcolor rgb '#333333'\n",
                      tick_step(figure.width, layout.panel_width, 44))
       << fmt::format("set ytics {} nomirror out scale 0.5 font ',11' textcolor rgb '#333333'\n",
                      tick_step(figure.height, layout.panel_height, 44));
  gp << "set format x " << (lowest ? "'%g'" : "''") << "; set format y "
     << (index % layout.columns == 0 ? "'%g'" : "''") << '\n';
  if (lowest)
    script.text(figure.x_label, x0 + layout.panel_width / 2, y0 + layout.panel_height + 34,
                "center font ',12' textcolor rgb '#222222'");
  for (std::size_t i = 0; i < layout.labels[index].size(); ++i)
    script.text(layout.labels[index][i], x0,
                y0 - 6 - label_line * (static_cast<double>(layout.labels[index].size() - i) - 0.5),
                "left font ',12' textcolor rgb '#111111'");
  Labels labels(figure, panel, layout);
  place_on_contours(labels, panel);
  if (panel.map && panel.map->diverging)
    for (const Extreme& extreme : extremes_of(figure, *panel.map, layout.scales[layout.scale_of[index]].bands)) {
      const double x = extreme.x * layout.pixels, y = (figure.height - extreme.y) * layout.pixels;
      const bool most = extreme.value > panel.map->min / 2 + panel.map->max / 2;
      labels.begin((most ? "max " : "min ") + minus(fmt::format("{:+.2g}", extreme.value)));
      for (const double up : {-1.4, 1.4, 0.0, -3.4, 3.4, -5.4, 5.4})
        for (const double side : {1.0, -1.0})
          labels.offer(x, y, side, up, 40 * std::abs(up) + (side < 0 ? 1 : 0), panel.contours.size());
      labels.end();
      gp << "set label '' at " << script.at(x0 + x, y0 + y) << " front point pt 7 ps 0.55 lc rgb '#111111'\n";
    }
  for (const PlacedLabel& label : labels.placed()) {
    const double x = x0 + label.box.x, y = y0 + label.box.y;
    gp << "set object rectangle from " << script.at(x, y + label.box.h) << " to " << script.at(x + label.box.w, y)
       << " front fc rgb '#ffffff' fs solid noborder\n";
    script.text(label.text, x + label.box.w / 2, y + label.box.h / 2,
                "center front font ',11' textcolor rgb '#111111'");
  }
  gp << "plot ";
  if (elements.empty()) gp << "NaN notitle";
  for (std::size_t i = 0; i < elements.size(); ++i) gp << (i == 0 ? "" : ", \\\n     ") << elements[i];
  gp << "\nunset label; unset object\n\n";
}

// ---- the data

std::string csv_of(const PlateFigure& figure) {
  std::string out = csv_note("figure", figure.id) + csv_note("title", figure.title);
  for (const std::string& note : figure.notes) out += csv_note("note", note);
  out += csv_note("x", figure.x_label) + csv_note("y", figure.y_label);
  out += "# part: map, a value at each node; or the kind of a contour, its level, and a number for each of its lines\n";
  out += "panel,part,label,line,x,y,value\n";
  for (const Panel& panel : figure.panels) {
    const std::string name = csv_field(panel.label) + ",";
    if (panel.map) {
      const Map& map = *panel.map;
      std::size_t n = 0;
      for (int j = 0; j <= map.ny; ++j)
        for (int i = 0; i <= map.nx; ++i)
          out += name + "map," + csv_field(map.label) + ",," + csv_number(figure.width * i / map.nx) + "," +
                 csv_number(figure.height * j / map.ny) + "," + csv_number(map.nodes[n++]) + "\n";
    }
    for (const Contour& contour : panel.contours)
      for (std::size_t l = 0; l < contour.lines.size(); ++l) {
        const std::string start =
            name + contour.kind + "," + csv_field(contour.label) + "," + fmt::format("{}", l + 1) + ",";
        const Line& line = contour.lines[l];
        for (std::size_t i = 0; i < line.x.size(); ++i)
          out += start + csv_number(line.x[i]) + "," + csv_number(line.y[i]) + "," + csv_number(contour.level) + "\n";
      }
  }
  return out;
}

void check(const PlateFigure& figure) {
  check_id(figure.id);
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument("figure '" + figure.id + "': " + why);
  };
  const auto positive = [](double v) { return std::isfinite(v) && v > 0; };
  if (!positive(figure.width) || !positive(figure.height))
    refuse(fmt::format("{} by {} is no plate", figure.width, figure.height));
  if (figure.panels.empty()) refuse("no panels");
  if (figure.columns < 1) refuse("no columns");
  const std::vector<Look> looks = looks_of(figure);
  for (const Panel& panel : figure.panels) {
    const std::string where = "panel '" + panel.label + "': ";
    for (const Contour& contour : panel.contours) {
      if (look_of(looks, contour.kind) == looks.size())
        refuse(where + "no kind of contour is called '" + contour.kind + "'");
      for (const Line& line : contour.lines)
        if (line.x.size() != line.y.size())
          refuse(fmt::format("{}contour '{}': {} x but {} y", where, contour.label, line.x.size(), line.y.size()));
    }
    if (!panel.map) continue;
    const Map& map = *panel.map;
    if (!std::isfinite(map.min) || !std::isfinite(map.max) || !(map.min < map.max))
      refuse(fmt::format("{}{} to {} is no range of colours", where, map.min, map.max));
    if (map.nx < 1 || map.ny < 1) refuse(fmt::format("{}a map of {} by {} cells", where, map.nx, map.ny));
    const auto needed = (static_cast<std::size_t>(map.nx) + 1) * (static_cast<std::size_t>(map.ny) + 1);
    if (map.nodes.size() != needed)
      refuse(fmt::format("{}{} values on {} by {} cells", where, map.nodes.size(), map.nx, map.ny));
  }
}

}  // namespace

Drawn draw(const PlateFigure& figure, const std::filesystem::path& directory, std::string& message) {
  message.clear();
  check(figure);
  const auto write = [&](std::ostream& gp) {
    const Layout layout = layout_of(figure);
    const Script script{gp, layout.width, layout.height};
    write_head(script, figure, layout);
    for (std::size_t i = 0; i < figure.panels.size(); ++i) write_panel(script, figure, i, layout);
    gp << "unset multiplot\nset output\n";
  };
  return draw_files(figure.id, csv_of(figure), write, directory, message);
}

}  // namespace diptych::reports
