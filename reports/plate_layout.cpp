#include "reports/plate_layout.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace diptych::reports::plates {
namespace {

constexpr double page = 900, least_page = 640, row_gap = 16, x_axis = 48, tallest = 430, legend_line = 24;
constexpr double bar_strip = 58, widest_bar = 440;

bool has_point(const Line& line) {
  for (std::size_t i = 0; i < line.x.size(); ++i)
    if (std::isfinite(line.x[i]) && std::isfinite(line.y[i])) return true;
  return false;
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

}  // namespace

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

bool drawn(const Contour& contour) {
  return std::any_of(contour.lines.begin(), contour.lines.end(), [](const Line& line) { return has_point(line); });
}

bool has_gap(const Map& map) {
  return std::any_of(map.nodes.begin(), map.nodes.end(), [](double v) { return std::isnan(v); });
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

}  // namespace diptych::reports::plates
