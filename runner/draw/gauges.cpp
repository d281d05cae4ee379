// Histories of stress at gauges, compression positive: a panel for each gauge and variant, the elastic solution under
// both methods, published fronts as time windows.
#include "runner/compare/gauges.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "runner/draw/figure_kind.hpp"
#include "runner/draw/figure_runs.hpp"
#include "runner/draw/struck_plate.hpp"
#include "runner/input/case_tables.hpp"

namespace diptych::runner {
namespace {

/// A published range of speeds of failure fronts, with the delay after which they set off: a time window at each gauge.
struct SpeedBand {
  std::string label;
  std::array<double, 2> speed{1, 1};  ///< [m/s]
  std::array<double, 2> delay{0, 0};  ///< [s]
};

struct Gauges {
  std::vector<std::string> gauges, variants;  ///< a panel for each of both
  std::vector<std::string> components;        ///< "longitudinal", "lateral"
  std::vector<SpeedBand> bands;
  std::optional<std::array<double, 2>> time_range;  ///< [s]
};

void read_gauges(Table& t, const Case& c, FigureSpec& figure) {
  Gauges options;
  Names gauges;
  for (const GaugeSpec& gauge : c.gauges) gauges.push_back(gauge.id);
  options.gauges = t.get("gauges", set_of(one_of(gauges)), gauges);
  options.variants = t.get("variants", set_of(one_of(variants_of(c))), {""});
  options.components = t.need("components", set_of(one_of({"longitudinal", "lateral"})));
  options.time_range = t.maybe("time_range", interval());
  t.each("bands", [&](Table& b) {
    SpeedBand band;
    band.label = b.need("label", text());
    const auto speed = b.need("speed", one_or_set_of(positive()));  // one speed, or from the least to the largest
    if (!speed.empty()) band.speed = {speed.front(), speed.back()};
    if (speed.size() > 2 || !ascending(speed)) b.place("speed").refuse(words(speed), "one speed, or [least, most]");
    band.delay = b.get("delay", interval(not_negative()), {0, 0});
    options.bands.push_back(band);
  });
  for (const PlateVariant& variant : c.variants)  // what draws histories of gauges needs them
    if (contains(options.variants, variant.id) && !variant.plate.flyer)
      t.place("variants").refuse(words(variant.id) + ", a variant without a flyer", "variants with [flyer]");
  need_gauges(t, c, figure);
  figure.options = options;
}

const reports::GaugeHistory* history_at(const reports::Run* run, const std::string& id) {
  if (run)
    for (const auto& gauge : run->gauges)
      if (gauge.id == id) return &gauge;
  return nullptr;
}

reports::Curve in_figure_units(const std::vector<double>& time, const std::vector<double>& stress) {
  reports::Curve curve;
  for (std::size_t n = 0; n < time.size(); ++n) curve.add(time[n] * 1e6, -stress[n] / 1e9);
  return curve;
}

/// The elastic solution until it is released: a step at the arrival.
reports::Curve elastic_curve(const ImpactTheory& theory, double stress, double end) {
  const double until = std::min(theory.release, end);
  if (!(until > theory.arrival)) return {{0, until * 1e6}, {0, 0}};
  return {{0, theory.arrival * 1e6, theory.arrival * 1e6, until * 1e6}, {0, 0, stress / 1e9, stress / 1e9}};
}

void draw_gauges(const Case& c, const FigureSpec& spec, reports::Case& result) {
  const auto& options = options_of<Gauges>(spec);
  const std::vector<reports::Run>& runs = result.runs;
  reports::Figure figure;
  figure.id = spec.id;
  figure.title = title_of(c, spec);
  figure.notes = struck_notes(c, spec, plate_of(c, options.variants.front(), spec.cells));
  const bool longitudinal = options.components.front() == "longitudinal", both = options.components.size() > 1;
  figure.x_label = "time from impact t [µs]";
  figure.y_label = both ? "−σ_x, −σ_y [GPa]" : longitudinal ? "−σ_x [GPa]" : "−σ_y [GPa]";
  figure.x_max = c.times.back() * 1e6;
  figure.y_min = figure.y_max = 0;
  if (options.time_range) {
    figure.x_min = (*options.time_range)[0] * 1e6;
    figure.x_max = (*options.time_range)[1] * 1e6;
  }
  for (const std::string& variant : options.variants) {
    const PlateSpec plate = plate_of(c, variant, spec.cells);
    for (const GaugeSpec& gauge : c.gauges) {
      if (std::find(options.gauges.begin(), options.gauges.end(), gauge.id) == options.gauges.end()) continue;
      const ImpactTheory theory = impact_theory(plate, gauge.from_face);
      const double elastic_lateral = theory.lateral_ratio * theory.plateau;
      reports::Figure::Panel panel;
      panel.label = fmt::format("{:g} mm from the impact face", gauge.from_face * 1e3);
      if (options.variants.size() > 1) panel.label += ": " + viscosity_words(plate);
      for (const std::string& component : options.components) {
        const double stress = component == "lateral" ? elastic_lateral : theory.plateau;
        panel.series.push_back({both ? "" : "elastic, exact", "exact", elastic_curve(theory, stress, c.times.back())});
        if (both) panel.series.back().label = component == "lateral" ? "−σ_y elastic" : "−σ_x elastic";
      }
      for (const std::string& method : spec.methods) {
        const reports::Run* run = find_run(runs, spec, method, variant);
        const auto* history = history_at(run, gauge.id);
        if (!history) {
          figure.notes.push_back(method + " is missing: its run did not complete");
          continue;
        }
        for (const std::string& component : options.components) {
          const bool thin = both && component == "lateral";
          panel.series.push_back({name_of_method(method) + (both ? (thin ? ", −σ_y" : ", −σ_x") : ""),
                                  kind_of_method(method) + (thin ? "-thin" : ""),
                                  in_figure_units(history->time, component == "lateral" ? history->yy : history->xx)});
        }
        const double over = measure(run, "gauge." + gauge.id + ".overshoot");
        if (options.variants.size() > 1)
          panel.label += fmt::format("; {} overshoot {:.1f} %, 10–90 % in {:.0f} ns", family_of_method(method),
                                     over < 0 ? 0.0 : over * 100, measure(run, "gauge." + gauge.id + ".rise") * 1e9);
      }
      for (const SpeedBand& band : options.bands)
        panel.spans.push_back({(gauge.from_face / band.speed[1] + band.delay[0]) * 1e6,
                               (gauge.from_face / band.speed[0] + band.delay[1]) * 1e6, band.label, "published"});
      if (std::isfinite(theory.failed_lateral) && (both || !longitudinal)) {
        panel.marks.push_back({theory.failed_lateral / 1e9, "−σ_y at f_max", false});
        if (std::isfinite(theory.failure) && theory.failure * 1e6 < figure.x_max)
          panel.marks.push_back({theory.failure * 1e6, "half-way, by diffusion alone", true});
      }
      for (const auto& series : panel.series) widen(figure, series.curve);
      for (const auto& mark : panel.marks)
        if (!mark.vertical) figure.y_max = std::max(figure.y_max, mark.at);
      figure.panels.push_back(std::move(panel));
    }
  }
  const double margin = 0.06 * (figure.y_max - figure.y_min);
  figure.y_min -= margin;
  figure.y_max += margin;
  take_range(spec, figure);
  result.figures.push_back(std::move(figure));
}

}  // namespace

FigureKind gauges_kind() {
  return {.id = "gauges",
          .scenes = FigureKind::Scenes::plates,
          .keys = {"gauges", "variants", "components", "time_range", "bands", "range", "cells"},
          .draws = FigureKind::Draws::what_there_is,
          .read = read_gauges,
          .add = draw_gauges};
}

}  // namespace diptych::runner
