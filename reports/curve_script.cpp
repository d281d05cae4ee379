#include "reports/curve_script.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <ostream>
#include <string_view>
#include <utility>

#include "reports/curve_layout.hpp"
#include "reports/curve_legend.hpp"
#include "reports/gnuplot.hpp"

namespace diptych::reports::curves {
namespace {

constexpr double y_label_offset = 72;                       // from a panel's left side [px]
constexpr std::size_t span_styles = 110, mark_style = 109;  // gnuplot's line styles

void write_head(const Sheet& sheet, const Figure& figure, const Heading& heading, const Layout& layout,
                const std::vector<Entry>& entries) {
  std::ostream& gp = sheet.gp;
  begin_page(gp, figure.id, width, layout.height);
  gp << "# Change the looks here.\n";
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& entry = entries[i];
    std::string style = entry.appearance.line;
    // Markers joined by a line: a thin one, which leaves what lies beneath in sight.
    if (entry.joined && !entry.appearance.markers)
      style += " pt 7 ps 0.5";
    else if (entry.joined)
      style += " lw 0.9";
    else if (entry.appearance.markers) {
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
     << "# Title, notes, legend and axis labels: an empty plot across the page.\n";
  sheet.margins(left, width - right, layout.legend, layout.top);
  gp << "unset border; unset tics; unset key\n";
  sheet.heading(heading, left);
  if (!layout.own.y_label)
    sheet.text(figure.y_label, 16, (layout.top + layout.height - x_axis) / 2,
               "center rotate by 90 font ',12' textcolor rgb '#222222'");
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& entry = entries[i];
    const double middle = layout.legend + legend_line * (static_cast<double>(entry.line) + 0.5);
    const std::string at = fmt::format("{:.6f}", 1 - middle / layout.height), style = fmt::format("ls {}", i + 1);
    if (style_of(entry) != std::string_view("points"))
      gp << fmt::format("set arrow from screen {:.6f},{} to screen {:.6f},{} nohead {}\n", entry.x / width, at,
                        (entry.x + legend_sample) / width, at, style);
    if (entry.appearance.markers || entry.joined)
      gp << fmt::format("set label '' at screen {:.6f},{} point {}\n", (entry.x + legend_sample / 2) / width, at,
                        style);
    for (std::size_t k = 0; k < entry.lines.size(); ++k)
      sheet.text(entry.lines[k], entry.x + legend_sample + legend_gap, middle + legend_line * static_cast<double>(k),
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
void write_spans_and_marks(const Sheet& sheet, const Figure& figure, std::size_t index, const Layout& layout, double x0,
                           double y0) {
  std::ostream& gp = sheet.gp;
  const Figure::Panel& panel = figure.panels[index];
  const Frame& frame = layout.frames[index];
  const std::vector<std::string> kinds = span_kinds(figure);
  const auto nth = [&](const Figure::Span& span) {
    return static_cast<std::size_t>(std::find(kinds.begin(), kinds.end(), span.kind) - kinds.begin());
  };
  const auto screen_y = [&](double y) { return 1 - (y0 + y) / layout.height; };
  const auto words = [&](const std::string& text, double x, double y, const char* side) {
    sheet.text(text, x0 + x, y0 + y, std::string(side) + " front font ',11' textcolor rgb '#222222'");
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

/// Ticks at powers of ten, and at twice and five times them where there are few; positions are their logarithms.
void write_powers(std::ostream& gp, char axis, double low, double high) {
  const auto raised = [](int exponent) {
    static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = exponent < 0 ? "⁻" : "";
    for (const char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
    return text;
  };
  const bool few = high - low < 2.5;
  const int step = std::max(1, static_cast<int>((high - low) / 8));
  std::string ticks;
  for (int k = static_cast<int>(std::floor(low)); k <= high; ++k)
    for (const int times : {1, 2, 5}) {
      const double at = k + std::log10(times);
      if (at < low || at > high || (times > 1 && !few) || (times == 1 && k % step != 0)) continue;
      ticks += fmt::format("{}'{}10{}' {}", ticks.empty() ? "" : ", ", times > 1 ? std::to_string(times) + "·" : "",
                           raised(k), at);
    }
  gp << "set " << axis << "tics (" << ticks << ")\n";
}

void write_panel(const Sheet& sheet, const Figure& figure, std::size_t index, const Layout& layout,
                 const std::vector<Entry>& entries) {
  const Figure::Panel& panel = figure.panels[index];
  const std::size_t row = index / layout.columns, column = index % layout.columns;
  const double x0 = left + static_cast<double>(column) * (layout.panel_width + gap_across(layout.own));
  const double y0 = layout.top + static_cast<double>(row) * (layout.panel_height + layout.row_gap);
  const bool lowest = index + layout.columns >= figure.panels.size();
  const Frame& frame = layout.frames[index];

  std::ostream& gp = sheet.gp;
  gp << "# Panel " << index + 1 << '\n';
  sheet.margins(x0, x0 + layout.panel_width, y0, y0 + layout.panel_height);
  if (index == 0)
    gp << "set border 3 back ls 101\n"
       << "set grid back ls 100\n"
       << "set xtics nomirror out scale 0.5 offset 0,0.4 font ',11' textcolor rgb '#333333'\n"
       << "set ytics nomirror out scale 0.5 font ',11' textcolor rgb '#333333'\n";
  if (index == 0 || layout.own.any_range())
    gp << fmt::format("set xrange [{}:{}]; set yrange [{}:{}]\n", frame.x_min, frame.x_max, frame.y_min, frame.y_max);
  gp << "set format x " << (lowest || layout.own.x_ticks() ? "'%g'" : "''") << "; set format y "
     << (column == 0 || layout.own.y_ticks() ? "'%g'" : "''") << '\n';
  if (figure.x_powers) write_powers(gp, 'x', frame.x_min, frame.x_max);
  if (figure.y_powers) write_powers(gp, 'y', frame.y_min, frame.y_max);
  if (layout.own.y_label) {
    const std::vector<std::string> lines =
        lines_of(panel.y_label.empty() ? figure.y_label : panel.y_label, layout.panel_height, label_char);
    for (std::size_t i = 0; i < lines.size(); ++i)
      sheet.text(
          lines[i],
          x0 - y_label_offset + label_line * (static_cast<double>(i) - static_cast<double>(lines.size() - 1) / 2),
          y0 + layout.panel_height / 2, "center rotate by 90 font ',12' textcolor rgb '#222222'");
  }
  if (lowest || layout.own.x_label)
    sheet.text(panel.x_label.empty() ? figure.x_label : panel.x_label, x0 + layout.panel_width / 2,
               y0 + layout.panel_height + 34, "center font ',12' textcolor rgb '#222222'");
  if (figure.motion) write_magnified(gp, layout, index);
  if (crowded(panel)) write_spans_and_marks(sheet, figure, index, layout, x0, y0);
  const Box& place = layout.places[index];
  const bool to_right = place.x > layout.panel_width / 2 - place.w / 2 + 1;
  for (std::size_t i = 0; i < layout.labels[index].size(); ++i)
    sheet.text(layout.labels[index][i], x0 + (to_right ? place.x + place.w : place.x),
               y0 + place.y + label_line * (static_cast<double>(i) + 0.5),
               std::string(to_right ? "right" : "left") + " front font ',12' textcolor rgb '#111111'");

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

}  // namespace

void write_script(std::ostream& gp, const Figure& figure) {
  const Heading heading = heading_of(figure.title, figure.notes, width - left - right);
  const std::vector<Entry> entries = entries_of(figure);
  const Layout layout =
      layout_of(figure, heading,
                entries.empty() ? 0 : entries.back().line + std::max<std::size_t>(entries.back().lines.size(), 1));
  gp << std::setprecision(16);  // 17 significant digits: enough to read the same double back
  const Sheet sheet{gp, width, layout.height};
  write_head(sheet, figure, heading, layout, entries);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) write_panel(sheet, figure, i, layout, entries);
  gp << "unset multiplot\nset output\n";
}

}  // namespace diptych::reports::curves
