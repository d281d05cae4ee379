#include "runner/draw/figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "runner/draw/convergence_figures.hpp"
#include "runner/draw/figure_runs.hpp"
#include "runner/draw/gauge_figures.hpp"
#include "runner/draw/plate_figures.hpp"
#include "runner/input/build.hpp"
#include "runner/input/leaf.hpp"

namespace diptych::runner {
namespace {

std::string unit_of(const Case& c, const std::string& field) {
  if (c.units == "paper") return "paper's units";
  return field == "stress" ? "Pa" : field == "velocity" ? "m/s" : "m";
}

std::string symbol_of(const std::string& field) { return field == "stress" ? "σ" : field == "velocity" ? "v" : "u"; }

std::string length_unit(const Case& c) { return c.units == "paper" ? "paper's units" : "m"; }

bool same(const BarSpec& a, const BarSpec& b) { return words_of(a) == words_of(b); }

/// Parameters under the title: of the runs, of the bars, and which of them the paper leaves open.
std::vector<std::string> notes_of(const Case& c, const FigureSpec& spec) {
  const bool mpm = std::any_of(spec.methods.begin(), spec.methods.end(),
                               [](const std::string& method) { return panel(method).particles; });
  const std::string particles =
      mpm ? fmt::format("particles at ξ = {} of each cell; ", particles_label(spec.particles)) : "";
  std::vector<std::string> notes;
  std::string courant = "Courant number";
  if (spec.courants.empty()) courant += fmt::format(" {:g}", spec.courant);
  for (const auto& [method, number] : spec.courants)
    courant += fmt::format("{} {:g} ({})", courant.ends_with("r") ? "" : ",", number, name_of_method(method));
  const bool several = c.bars.size() > 1;
  const std::string bars =
      !several ? words_of(c.first())
      : std::all_of(c.bars.begin(), c.bars.end(), [&](const BarSpec& b) { return same(b, c.first()); })
          ? "each bar " + words_of(c.first())
          : "";
  notes.push_back(fmt::format("{} cells{}; {}; {}{} displacements{}{}", spec.cells, several ? " in the first bar" : "",
                              courant, particles, c.convected ? "finite" : "infinitesimal", bars.empty() ? "" : "; ",
                              bars));
  if (bars.empty()) {
    for (std::size_t b = 0; b < c.bars.size(); ++b)
      notes.push_back(fmt::format("bar {}: {}", b + 1, words_of(c.bars[b])));
  }
  std::string velocities;
  for (std::size_t b = 0; b < c.bars.size(); ++b) {
    if (!c.bars[b].velocity.empty())
      velocities += fmt::format("{}{:g}", velocities.empty() ? "" : ", ", velocity_of(c, b));
  }
  if (!velocities.empty())
    notes.push_back(fmt::format(
        "Velocities at the start {}.{}", velocities,
        !mpm || !c.from_contact || spec.kind == "motion"
            ? ""
            : " Each method's times count from its own contact: MPM's bars touch as soon as they share a node."));
  if (c.viscosity) {
    notes.push_back("Artificial viscosity " + words_of(viscosity_of(c)));
  }
  if (!c.paper_figures.empty() && !spec.choices.empty()) notes.push_back("Reconstructed parameters: " + spec.choices);
  if (!c.paper_figures.empty() && spec.choices.empty())
    notes.push_back("The times are our choice, to show what the paper describes.");
  return notes;
}

/// Part of paths that lies between two times, with one point more on either side.
reports::Curve between(const reports::Curve& paths, double from, double to) {
  reports::Curve part;
  const auto inside = [&](std::size_t i) { return i < paths.y.size() && paths.y[i] >= from && paths.y[i] <= to; };
  for (std::size_t i = 0; i < paths.x.size(); ++i) {
    if (!std::isnan(paths.y[i]) && !inside(i) && !inside(i + 1) && !(i > 0 && inside(i - 1))) continue;
    if (std::isnan(paths.y[i]) && (part.x.empty() || std::isnan(part.x.back()))) continue;
    part.x.push_back(paths.x[i]);
    part.y.push_back(paths.y[i]);
  }
  return part;
}

void add_motion(const Case& c, const FigureSpec& spec, const std::vector<reports::Run>& runs, reports::Figure& figure) {
  const double unit = time_unit(c, c.time_unit), origin = instant(c, spec.cells, 0);
  figure.motion = true;
  figure.x_label = fmt::format("position x [{}]", length_unit(c));
  figure.y_label = fmt::format("time t [{}]{}", c.time_unit, c.from_contact ? " from contact" : "");
  const auto in_units = [&](reports::Curve curve, const std::vector<double>& origins) {
    for (double& t : curve.y) t = (t - origin) / unit;
    for (std::size_t i = 0; i < curve.x.size(); ++i) curve.x[i] = origins[i] + spec.magnify * (curve.x[i] - origins[i]);
    return curve;
  };
  if (spec.magnify != 1)
    figure.notes.push_back(fmt::format("Displacements are drawn {:g} times as large.", spec.magnify));
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
  bool any = false;
  for (const auto& series : whole.series) {
    for (std::size_t i = 0; i < series.curve.x.size(); ++i) {
      const double x = series.curve.x[i], t = series.curve.y[i];
      if (!std::isfinite(x) || !std::isfinite(t)) continue;
      figure.x_min = any ? std::min(figure.x_min, x) : x;
      figure.x_max = any ? std::max(figure.x_max, x) : x;
      figure.y_min = any ? std::min(figure.y_min, t) : t;
      figure.y_max = any ? std::max(figure.y_max, t) : t;
      any = true;
    }
  }
  const double room = 0.02 * (figure.x_max - figure.x_min);
  figure.x_min -= room;
  figure.x_max += room;
  if (spec.zoom) {
    whole.label = "(a) the whole run";
    reports::Figure::Panel near;
    near.label = "(b) contact, magnified";
    near.x_range = spec.zoom->x;
    near.y_range = spec.zoom->t;
    for (const auto& series : whole.series)
      near.series.push_back({series.label, series.kind, between(series.curve, spec.zoom->t[0], spec.zoom->t[1])});
    figure.panels = {std::move(whole), std::move(near)};
  } else {
    figure.panels = {std::move(whole)};
  }
}

void add_profiles(const Case& c, const FigureSpec& spec, const std::vector<reports::Run>& runs,
                  reports::Figure& figure) {
  const bool moves = c.convected || c.bars.size() > 1;
  figure.y_min = figure.y_max = 0;
  figure.x_label = fmt::format("{}x [{}]", moves ? "position " : "", length_unit(c));
  figure.y_label = fmt::format("{} {} [{}]", spec.field, symbol_of(spec.field), unit_of(c, spec.field));
  figure.x_max = begins_of(c, spec.cells).back() + c.bars.back().length;
  const auto& times = spec.times.empty() ? c.times : spec.times;
  for (std::size_t i = 0; i < times.size(); ++i) {
    reports::Figure::Panel panel;
    panel.label = fmt::format("t = {:g} {}", times[i], c.time_unit);
    if (i < spec.captions.size()) panel.label += ": " + spec.captions[i];
    for (const std::string& method : spec.methods) {
      const reports::Run* run = find_run(runs, spec, method);
      if (!run) {
        figure.notes.push_back(method + " is missing: its run did not complete");
        continue;
      }
      for (const auto& sample : run->samples) {
        if (sample.asked != times[i]) continue;
        if (panel.series.empty() && sample.exact_curves.count(spec.field)) {
          panel.series.push_back({"exact", "exact", sample.exact_curves.at(spec.field)});
        }
        panel.series.push_back({name_of_method(method), kind_of_method(method), sample.curves.at(spec.field)});
      }
    }
    for (const auto& series : panel.series) widen(figure, series.curve);
    figure.panels.push_back(std::move(panel));
  }
  if (moves) {
    bool any = false;
    for (const auto& panel : figure.panels) {
      for (const auto& series : panel.series) {
        for (const double x : series.curve.x) {
          if (!std::isfinite(x)) continue;
          figure.x_min = any ? std::min(figure.x_min, x) : x;
          figure.x_max = any ? std::max(figure.x_max, x) : x;
          any = true;
        }
      }
    }
    const double room = 0.02 * (figure.x_max - figure.x_min);
    figure.x_min -= room;
    figure.x_max += room;
  }
  const double height = figure.y_max - figure.y_min, margin = height > 0 ? 0.05 * height : 1;
  figure.y_min -= margin;
  figure.y_max += margin;
  if (spec.range) {
    figure.y_min = (*spec.range)[0];
    figure.y_max = (*spec.range)[1];
  }
}

}  // namespace

void add_figures(const Case& whole, reports::Case& result) {
  const std::vector<reports::Run>& runs = result.runs;
  for (const FigureSpec& spec : whole.figures) {
    Case c = whole;
    for (const auto& [name, value] : spec.parameters) c.parameters[name] = value;
    if (c.plate) {
      if (spec.kind == "problem") result.problem_figures.push_back(problem_figure(c, spec));
      if (spec.kind == "contours") result.plate_figures.push_back(contour_figure(c, spec, runs));
      if (spec.kind == "history") result.figures.push_back(history_figure(c, spec, runs));
      if (spec.kind == "convergence") result.figures.push_back(convergence_figure(c, spec, runs));
      if (spec.kind == "rupture") result.figures.push_back(rupture_figure(whole, spec, runs));
      if (spec.kind == "gauges") result.figures.push_back(gauge_figure(c, spec, runs));
      if (spec.kind == "failure") add_failure_page(c, spec, result);
      if (spec.kind == "agreement") add_agreement(c, spec, result);
      if (spec.kind == "choices") add_choices(c, spec, runs, result);
      continue;
    }
    reports::Figure figure;
    figure.id = spec.id;
    figure.title = title_of(c, spec);
    figure.notes = notes_of(c, spec);
    if (spec.kind == "motion") {
      add_motion(c, spec, runs, figure);
    } else {
      add_profiles(c, spec, runs, figure);
    }
    result.figures.push_back(std::move(figure));
  }
  for (auto& figure : result.figures) figure.looks = looks();
  for (auto& figure : result.plate_figures) figure.looks = looks();
}

}  // namespace diptych::runner
