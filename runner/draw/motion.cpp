// Motion of the bars: positions across, time upwards.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "runner/draw/bar_figures.hpp"
#include "runner/draw/figure_kind.hpp"
#include "runner/draw/figure_runs.hpp"
#include "runner/input/build.hpp"

namespace diptych::runner {
namespace {

/// A part that a second panel magnifies.
struct Zoom {
  std::array<double, 2> x, t;  ///< [case units], [time unit of the case]
};

struct Motion {
  std::optional<Zoom> zoom;
  double magnify = 1;  ///< displacements are drawn so many times as large
};

void read_motion(Table& t, const Case&, FigureSpec& figure) {
  Motion options;
  options.magnify = t.get("magnify", positive(), options.magnify);
  t.maybe_table("zoom", [&](Table& z) { options.zoom = Zoom{z.need("x", interval()), z.need("t", interval())}; });
  figure.recorded.paths = true;
  if (options.zoom) figure.recorded.closely = options.zoom->t;
  figure.options = options;
}

/// Part of paths that lies between two times, with one point more on either side.
reports::Curve part_between(const reports::Curve& paths, double from, double to) {
  reports::Curve part;
  const auto inside = [&](std::size_t i) { return i < paths.y.size() && paths.y[i] >= from && paths.y[i] <= to; };
  for (std::size_t i = 0; i < paths.x.size(); ++i) {
    if (!std::isnan(paths.y[i]) && !inside(i) && !inside(i + 1) && !(i > 0 && inside(i - 1))) continue;
    if (std::isnan(paths.y[i]) && (part.x.empty() || std::isnan(part.x.back()))) continue;
    part.add(paths.x[i], paths.y[i]);
  }
  return part;
}

void draw_motion(const Case& c, const FigureSpec& spec, reports::Case& result) {
  const auto& [zoom, scale] = options_of<Motion>(spec);
  const std::vector<reports::Run>& runs = result.runs;
  reports::Figure figure = bar_figure(c, spec, bar_notes(c, spec, true));
  const double unit = time_unit(c, c.time_unit), origin = instant(c, spec.cells, 0);
  figure.motion = true;
  figure.x_label = fmt::format("position x [{}]", length_unit(c));
  figure.y_label = fmt::format("time t [{}]{}", c.time_unit, c.from_contact ? " from contact" : "");
  const auto in_units = [&](reports::Curve curve, const std::vector<double>& origins) {
    for (double& t : curve.y) t = (t - origin) / unit;
    for (std::size_t i = 0; i < curve.x.size(); ++i) curve.x[i] = origins[i] + scale * (curve.x[i] - origins[i]);
    return curve;
  };
  if (scale != 1) figure.notes.push_back(fmt::format("Displacements are drawn {:g} times as large.", scale));
  reports::Figure::Panel whole;
  for (const std::string& method : spec.methods) {
    const reports::Run* run = find_run(runs, spec, method);
    if (!run) {
      figure.notes.push_back(method + " is missing: its run did not complete");
      continue;
    }
    if (whole.series.empty() && !run->exact_paths.x.empty())
      whole.series.push_back({"exact", "exact", in_units(run->exact_paths, run->path_origins)});
    whole.series.push_back({name_of_method(method), kind_of_method(method), in_units(run->paths, run->path_origins)});
  }
  figure.panels = {whole};
  fit_x(figure);
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const auto& series : whole.series) {
    for (const double t : series.curve.y) {
      if (!std::isfinite(t)) continue;
      first = std::min(first, t);
      last = std::max(last, t);
    }
  }
  if (first <= last) {
    figure.y_min = first;
    figure.y_max = last;
  }
  if (zoom) {
    whole.label = "(a) the whole run";
    reports::Figure::Panel near;
    near.label = "(b) contact, magnified";
    near.x_range = zoom->x;
    near.y_range = zoom->t;
    for (const auto& series : whole.series)
      near.series.push_back({series.label, series.kind, part_between(series.curve, zoom->t[0], zoom->t[1])});
    figure.panels = {std::move(whole), std::move(near)};
  }
  result.figures.push_back(std::move(figure));
}

}  // namespace

FigureKind motion_kind() {
  return {.id = "motion",
          .scenes = FigureKind::Scenes::bars,
          .keys = {"zoom", "magnify", "cells"},
          .read = read_motion,
          .add = draw_motion};
}

}  // namespace diptych::runner
