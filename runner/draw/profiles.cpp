// Profiles of a field along the bars, a panel for each time.
#include <fmt/core.h>

#include "runner/draw/bar_figures.hpp"
#include "runner/draw/figure_kind.hpp"
#include "runner/draw/figure_runs.hpp"
#include "runner/input/build.hpp"
#include "runner/input/case_tables.hpp"

namespace diptych::runner {
namespace {

struct Profiles {
  std::string field = "stress";
  std::vector<std::string> captions;  ///< one for each time: what to see
};

void read_profiles(Table& t, const Case& c, FigureSpec& figure) {
  Profiles options;
  options.field = t.get("field", one_of(fields), options.field);
  options.captions = t.get("captions", list_of(text()));
  const std::size_t instants = figure.times.empty() ? c.times.size() : figure.times.size();
  if (!options.captions.empty() && instants > 0 && options.captions.size() != instants)
    t.place("captions")
        .refuse(fmt::format("{} captions", options.captions.size()),
                fmt::format("one for each of the {} times", instants));
  figure.recorded.curves = true;
  figure.options = options;
}

std::string unit_of(const Case& c, const std::string& field) {
  if (c.units == "paper") return "paper's units";
  return field == "stress" ? "Pa" : field == "velocity" ? "m/s" : "m";
}

std::string symbol_of(const std::string& field) { return field == "stress" ? "σ" : field == "velocity" ? "v" : "u"; }

void draw_profiles(const Case& c, const FigureSpec& spec, reports::Case& result) {
  const auto& [field, captions] = options_of<Profiles>(spec);
  const std::vector<reports::Run>& runs = result.runs;
  reports::Figure figure = bar_figure(c, spec, bar_notes(c, spec));
  const bool moves = c.convected || c.bars.size() > 1;
  figure.y_min = figure.y_max = 0;
  figure.x_label = fmt::format("{}x [{}]", moves ? "position " : "", length_unit(c));
  figure.y_label = fmt::format("{} {} [{}]", field, symbol_of(field), unit_of(c, field));
  const ExactSpec& exact = c.exact;
  if (moves && exact.solution == "expressions" && exact.displacement.empty() &&
      !(field == "stress" ? exact.stress : exact.velocity).empty())
    figure.notes.push_back(
        "The exact solution is not drawn: [exact] gives no displacement, which says where its points have moved to.");
  figure.x_max = begins_of(c, spec.cells).back() + c.bars.back().length;
  const auto& times = spec.times.empty() ? c.times : spec.times;
  for (std::size_t i = 0; i < times.size(); ++i) {
    reports::Figure::Panel panel;
    panel.label = fmt::format("t = {:g} {}", times[i], c.time_unit);
    if (i < captions.size()) panel.label += ": " + captions[i];
    for (const std::string& method : spec.methods) {
      const reports::Run* run = find_run(runs, spec, method);
      if (!run) {
        figure.notes.push_back(method + " is missing: its run did not complete");
        continue;
      }
      for (const auto& sample : run->samples) {
        if (sample.asked != times[i]) continue;
        if (panel.series.empty() && sample.exact_curves.count(field)) {
          panel.series.push_back({"exact", "exact", sample.exact_curves.at(field)});
        }
        panel.series.push_back({name_of_method(method), kind_of_method(method), sample.curves.at(field)});
      }
    }
    for (const auto& series : panel.series) widen(figure, series.curve);
    figure.panels.push_back(std::move(panel));
  }
  if (moves) fit_x(figure);
  const double height = figure.y_max - figure.y_min, margin = height > 0 ? 0.05 * height : 1;
  figure.y_min -= margin;
  figure.y_max += margin;
  take_range(spec, figure);
  result.figures.push_back(std::move(figure));
}

}  // namespace

FigureKind profiles_kind() {
  return {.id = "profiles",
          .scenes = FigureKind::Scenes::bars,
          .keys = {"field", "captions", "times", "range", "cells"},
          .read = read_profiles,
          .add = draw_profiles};
}

}  // namespace diptych::runner
