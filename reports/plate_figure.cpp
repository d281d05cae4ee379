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
#include "reports/contour_labels.hpp"
#include "reports/csv.hpp"
#include "reports/gnuplot.hpp"
#include "reports/plate_layout.hpp"
#include "reports/sheet.hpp"

namespace diptych::reports {
namespace {

using namespace plates;

// Sizes of the picture [px].
constexpr double sample = 40, sample_gap = 7, entry_gap = 28;  // of the legend
constexpr double bar_height = 13;

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

void write_bar(const Sheet& sheet, const Scale& scale, std::size_t index, const Bar& bar) {
  std::ostream& gp = sheet.gp;
  const std::vector<double>& edges = scale.bands.edges;
  const auto place = [&](double value) {
    return bar.x + (value - edges.front()) / (edges.back() - edges.front()) * bar.w;
  };
  const double y1 = bar.y + bar_height, middle = bar.y + bar_height / 2;
  const auto box = [&](double x0, double x1, const std::string& style) {
    gp << "set object rectangle from " << sheet.at(x0, y1) << " to " << sheet.at(x1, bar.y) << ' ' << style << '\n';
  };
  for (std::size_t k = 0; k + 1 < edges.size(); ++k)
    box(place(edges[k]), place(edges[k + 1]), "fc " + colour_of(index, k) + " fs solid noborder");
  const auto tip = [&](double x, double to, std::size_t band) {
    gp << "set object polygon from " << sheet.at(x, bar.y) << " to " << sheet.at(to, middle) << " to "
       << sheet.at(x, y1) << " to " << sheet.at(x, bar.y) << " fc " << colour_of(index, band)
       << " fs solid border lc rgb '#707070' lw 0.7\n";
  };
  if (scale.below) tip(bar.x - 1, bar.x - 1 - bar_tip, 0);
  if (scale.above) tip(bar.x + bar.w + 1, bar.x + bar.w + 1 + bar_tip, edges.size() - 2);
  box(bar.x, bar.x + bar.w, "fs empty border lc rgb '#707070' lw 0.7");
  sheet.text(scale.map.label, bar.x + bar.w / 2, bar.y - 10, "center font ',12' textcolor rgb '#222222'");

  // Ticks at edges, every so many, counted from the middle of a diverging bar and else from its start.
  const bool two_sided = scale.map.diverging;
  const std::size_t steps = two_sided ? edges.size() / 2 : edges.size() - 1;
  const double step_px = bar.w / static_cast<double>(two_sided ? 2 * steps : steps);
  std::size_t every = 1;
  while (every < steps && (static_cast<double>(every) * step_px < 40 || steps % every != 0)) ++every;
  const auto tick = [&](double value) {
    const double x = place(value);
    const double shown = std::abs(value) < 1e-9 * (edges.back() - edges.front()) ? 0 : value;
    gp << "set arrow from " << sheet.at(x, y1) << " to " << sheet.at(x, y1 + 4) << " nohead lw 0.8 lc rgb '#707070'\n";
    sheet.text(minus(fmt::format("{:.4g}", shown)), x, y1 + 12, "center font ',11' textcolor rgb '#333333'");
  };
  const double low = edges.front(), range = edges.back() - edges.front();
  const std::size_t all = two_sided ? 2 * steps : steps;
  for (std::size_t k = 0; k <= all; k += every) tick(low + range * static_cast<double>(k) / static_cast<double>(all));
}

void write_head(const Sheet& sheet, const PlateFigure& figure, const Layout& layout) {
  std::ostream& gp = sheet.gp;
  begin_page(gp, figure.id, layout.width, layout.height, true);
  gp << "# Change the looks here.\n";
  for (const std::size_t k : layout.kinds)
    gp << "set style line " << k + 1 << ' ' << layout.looks[k].line << "  # " << quoted(layout.looks[k].name) << '\n';
  gp << "set style line 99 lw 4.2 lc rgb '#ffffff'  # under the contours\n"
     << "set style line 101 lw 0.9 lc rgb '#707070'  # axes\n";
  for (std::size_t s = 0; s < layout.scales.size(); ++s) {
    gp << "bands" << s + 1 << " = '";
    for (std::size_t k = 0; k < layout.scales[s].bands.colours.size(); ++k)
      gp << (k == 0 ? "" : " ") << layout.scales[s].bands.colours[k];
    gp << "'\n";
  }
  gp << "\nset multiplot\n\n# Title, notes, legend and colour bars: an empty plot across the page.\n";
  sheet.margins(left, layout.width - right, layout.legend, layout.top);
  gp << "unset border; unset tics; unset key\n";
  sheet.heading(layout.heading, left);
  double x = left;
  const double middle = layout.legend + 8;
  for (const std::size_t k : layout.kinds) {
    gp << "set arrow from " << sheet.at(x, middle) << " to " << sheet.at(x + sample, middle) << " nohead ls " << k + 1
       << '\n';
    sheet.text(layout.looks[k].name, x + sample + sample_gap, middle, "left font ',12' textcolor rgb '#222222'");
    x += sample + sample_gap + static_cast<double>(characters(layout.looks[k].name)) * label_char + entry_gap;
  }
  sheet.text(figure.y_label, 18,
             layout.top + (static_cast<double>(layout.rows - 1) * layout.row_step + layout.panel_height) / 2,
             "center rotate by 90 font ',12' textcolor rgb '#222222'");
  for (const Bar& bar : layout.bars) write_bar(sheet, layout.scales[bar.scale], bar.scale, bar);
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

void write_panel(const Sheet& sheet, const PlateFigure& figure, std::size_t index, const Layout& layout) {
  std::ostream& gp = sheet.gp;
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

  sheet.margins(x0, x0 + layout.panel_width, y0, y0 + layout.panel_height);
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
    sheet.text(figure.x_label, x0 + layout.panel_width / 2, y0 + layout.panel_height + 34,
               "center font ',12' textcolor rgb '#222222'");
  for (std::size_t i = 0; i < layout.labels[index].size(); ++i)
    sheet.text(layout.labels[index][i], x0,
               y0 - 6 - label_line * (static_cast<double>(layout.labels[index].size() - i) - 0.5),
               "left font ',12' textcolor rgb '#111111'");
  ContourLabels labels(figure, panel, layout.pixels);
  labels.place_on_contours();
  if (panel.map && panel.map->diverging)
    for (const Extreme& extreme : extremes_of(figure, *panel.map, layout.scales[layout.scale_of[index]].bands)) {
      const double x = extreme.x * layout.pixels, y = (figure.height - extreme.y) * layout.pixels;
      const bool most = extreme.value > panel.map->min / 2 + panel.map->max / 2;
      labels.place_around((most ? "max " : "min ") + minus(fmt::format("{:+.2g}", extreme.value)), x, y);
      gp << "set label '' at " << sheet.at(x0 + x, y0 + y) << " front point pt 7 ps 0.55 lc rgb '#111111'\n";
    }
  for (const PlacedLabel& label : labels.placed()) {
    const double x = x0 + label.box.x, y = y0 + label.box.y;
    gp << "set object rectangle from " << sheet.at(x, y + label.box.h) << " to " << sheet.at(x + label.box.w, y)
       << " front fc rgb '#ffffff' fs solid noborder\n";
    sheet.text(label.text, x + label.box.w / 2, y + label.box.h / 2, "center front font ',11' textcolor rgb '#111111'");
  }
  gp << "plot ";
  if (elements.empty()) gp << "NaN notitle";
  for (std::size_t i = 0; i < elements.size(); ++i) gp << (i == 0 ? "" : ", \\\n     ") << elements[i];
  gp << "\nunset label; unset object\n\n";
}

// ---- the data

std::string csv_of_plate(const PlateFigure& figure) {
  std::string out = csv_heading(figure.id, figure.title, figure.notes);
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

void check_plate_figure(const PlateFigure& figure) {
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
  check_plate_figure(figure);
  const auto write = [&](std::ostream& gp) {
    const Layout layout = layout_of(figure);
    const Sheet sheet{gp, layout.width, layout.height, true};
    write_head(sheet, figure, layout);
    for (std::size_t i = 0; i < figure.panels.size(); ++i) write_panel(sheet, figure, i, layout);
    gp << "unset multiplot\nset output\n";
  };
  return draw_files(figure.id, csv_of_plate(figure), write, directory, message);
}

}  // namespace diptych::reports
