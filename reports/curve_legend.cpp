#include "reports/curve_legend.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "reports/curve_frames.hpp"

namespace diptych::reports::curves {
namespace {

constexpr double marker_spacing = 7.5, motion_spacing = 22;  // [px]; closer markers melt into a band
constexpr double entry_gap = 26;                             // [px]

Look look(const std::vector<PanelLook>& looks, const std::string& kind, std::size_t nth) {
  if (kind == "exact") return {"lw 4.5 lc rgb '#c6c6c6'", false};
  for (const PanelLook& one : looks) {
    const bool thin = kind == one.id + "-thin";
    const auto& lines = thin ? one.thin : one.lines;
    if ((thin || kind == one.id) && !lines.empty()) return {lines[nth % lines.size()], one.markers};
  }
  return {"lw 1.2 lc rgb '#000000'", false};
}

std::string ordinal(std::size_t n) {
  const bool teen = n % 100 > 10 && n % 100 < 14;
  const char* ending = teen ? "th" : n % 10 == 1 ? "st" : n % 10 == 2 ? "nd" : n % 10 == 3 ? "rd" : "th";
  return fmt::format("{}{}", n, ending);
}

}  // namespace

SpanLook span_look(std::size_t nth) {
  constexpr std::array<SpanLook, 4> looks{{{"#56b4e9", "lw 1.1 lc rgb '#1f5f8b'"},
                                           {"#e69f00", "lw 1.1 lc rgb '#8a5a00' dt (9,4)"},
                                           {"#009e73", "lw 1.1 lc rgb '#00604a' dt (2,3)"},
                                           {"#999999", "lw 1.1 lc rgb '#4d4d4d' dt (9,4,2,4)"}}};
  return looks[nth % looks.size()];
}

std::vector<std::string> span_kinds(const Figure& figure) {
  std::vector<std::string> kinds;
  for (const Figure::Panel& panel : figure.panels)
    for (const Figure::Span& span : panel.spans)
      if (std::find(kinds.begin(), kinds.end(), span.kind) == kinds.end()) kinds.push_back(span.kind);
  return kinds;
}

std::string Entry::text() const {
  if (interval <= 1) return label;
  return motion ? label + " (markers at some points)" : label + " (marker at every " + ordinal(interval) + " point)";
}

const char* style_of(const Entry& entry) {
  if (entry.joined) return "linespoints";
  if (!entry.appearance.markers) return "lines";
  return entry.interval > 1 || entry.motion ? "linespoints" : "points";
}

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
      const bool theory = series.kind == "exact" || series.kind.ends_with("-thin");
      entry->joined = (figure.x_powers || figure.y_powers) && !theory;
      if (entry->appearance.markers && !entry->joined)
        entry->interval = std::max(entry->interval, interval_of(figure, panel, series.curve));
    }
  double x = left;
  std::size_t line = 0;
  for (Entry& entry : entries) {
    entry.lines = lines_of(entry.text(), width - right - left - legend_sample - legend_gap, label_char);
    const double needed = legend_sample + legend_gap + length_of(entry.lines);
    if (x > left && x + needed > width - right) x = left, ++line;
    entry.x = x;
    entry.line = line;
    line += std::max<std::size_t>(entry.lines.size(), 1) - 1;
    x += needed + entry_gap;
  }
  return entries;
}

}  // namespace diptych::reports::curves
