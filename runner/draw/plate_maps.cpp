#include "runner/draw/plate_maps.hpp"

#include <fmt/core.h>

#include <utility>

#include "runner/draw/figure_runs.hpp"

namespace diptych::runner {
namespace {

std::vector<reports::Line> lines_of(const NodalMap& map, double level) {
  std::vector<reports::Line> lines;
  for (Polyline& one : contour(map, level)) {
    if (one.closed && !one.x.empty()) {
      one.x.push_back(one.x.front());
      one.y.push_back(one.y.front());
    }
    lines.push_back({std::move(one.x), std::move(one.y)});
  }
  return lines;
}

}  // namespace

std::string in_ms(double seconds) { return fmt::format("t = {:g} ms", seconds * 1e3); }

std::string symbol_of_damage(const std::string& field) { return field == "damage" ? "D" : "C_d"; }

const reports::PlateFields* fields_at(const reports::Run* run, double time) {
  if (run)
    for (const auto& sample : run->samples)
      if (sample.asked == time && sample.plate) return &*sample.plate;
  return nullptr;
}

void add_contours(const NodalMap& map, const std::vector<double>& levels, const std::string& kind,
                  reports::PlateFigure::Panel& panel) {
  for (const double level : levels)
    panel.contours.push_back({fmt::format("{:g}", level), level, kind, lines_of(map, level)});
}

reports::PlateFigure blank_plate(const Case& c, const FigureSpec& spec) {
  reports::PlateFigure figure;
  figure.id = spec.id;
  figure.title = title_of(c, spec);
  figure.notes = plate_notes(c, spec);
  figure.x_label = "x [m]";
  figure.y_label = "y [m]";
  figure.width = c.plate->width;
  figure.height = c.plate->height;
  return figure;
}

}  // namespace diptych::runner
