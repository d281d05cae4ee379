// Probes over the cell size, a panel each, at one time: both methods with their uncertainties (uncertainty.hpp) and
// what they extrapolate to.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "runner/draw/figure_kind.hpp"
#include "runner/draw/figure_runs.hpp"
#include "runner/draw/readings.hpp"
#include "runner/input/case_tables.hpp"

namespace diptych::runner {
namespace {

struct Convergence {
  std::vector<std::string> probes;  ///< a panel each
  std::string variant;
};

void read_convergence(Table& t, const Case& c, FigureSpec& figure) {
  Names probes;
  for (const PlateProbe& probe : c.plate_probes) probes.push_back(probe.id);
  figure.options = Convergence{t.need("probes", set_of(one_of(probes))), t.get("variant", one_of(variants_of(c)))};
  if (figure.times.size() != 1) t.place("times").refuse(listed(figure.times), "one time of sample.times.at");
}

constexpr double pen_up = std::numeric_limits<double>::quiet_NaN();

/// Whether the contours are circles, from the radii on the finest mesh of each method.
std::string roundness(const Case& c, const FigureSpec& spec, const std::vector<reports::Run>& runs, double time) {
  const auto& [probes, variant] = options_of<Convergence>(spec);
  std::string text;
  for (const std::string& method : spec.methods) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    std::string radii, angles;
    for (const std::string& id : probes) {
      const PlateProbe& probe = probe_of(c, id);
      if (probe.reads != "radius") continue;
      const Readings series = series_of(runs, spec, method, variant, id, time);
      if (series.value.empty()) return {};
      least = std::min(least, series.value.back());
      most = std::max(most, series.value.back());
      radii += fmt::format("{}{:.4f}", radii.empty() ? "" : ", ", series.value.back());
      angles += fmt::format("{}{:g}°", angles.empty() ? "" : ", ", probe.angle);
    }
    if (radii.empty()) return {};
    text += fmt::format("{}{} m ({}), {:.1f} % out of round",
                        text.empty() ? "Radii on the finest mesh at " + angles + ": " : "; ", radii,
                        name_of_method(method), 100 * (most / least - 1));
  }
  return text;
}

void draw_convergence(const Case& c, const FigureSpec& spec, reports::Case& result) {
  const auto& [probes, variant] = options_of<Convergence>(spec);
  const std::vector<reports::Run>& runs = result.runs;
  const double time = spec.times.front();
  reports::Figure figure;
  figure.id = spec.id;
  figure.title = title_of(c, spec);
  figure.notes = plate_notes(c, spec);
  figure.x_label = "cell size h [m]";
  double coarsest = 0;
  for (const std::string& id : probes) {
    const PlateProbe& probe = probe_of(c, id);
    reports::Figure::Panel panel;
    const std::string unit = unit_of(probe);
    panel.label = words_of(probe) + (unit.empty() ? "" : " [" + unit + "]");
    panel.y_label = unit.empty() ? "1" : unit;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const auto hold = [&](double value) {
      low = std::min(low, value);
      high = std::max(high, value);
    };
    for (const std::string& method : spec.methods) {
      const Readings series = series_of(runs, spec, method, variant, id, time);
      if (series.value.empty()) continue;
      const std::string kind = kind_of_method(method), name = name_of_method(method);
      const double finest = series.size.back();
      reports::Curve values, band;
      for (std::size_t k = 0; k < series.size.size(); ++k) {
        const double h = series.size[k], value = series.value[k];
        if (h > 8.5 * finest) continue;  // what is coarser is off by more than the rest of the panel
        coarsest = std::max(coarsest, h);
        values.add(h, value);
        hold(value);
        if (!series.uncertainty) continue;
        const double u = series.uncertainty->of(k);
        band.x.insert(band.x.end(), {h, h, pen_up});
        band.y.insert(band.y.end(), {value - u, value + u, pen_up});
        if (h < 2.5 * finest) hold(value > 0 ? std::max(value - u, 0.0) : value - u), hold(value + u);
      }
      panel.series.push_back({name, kind, std::move(values)});
      if (!series.uncertainty) continue;
      panel.series.push_back({name + ", ± U", kind + "-thin", std::move(band)});
      const double limit = series.uncertainty->extrapolated;
      if (!std::isfinite(limit)) continue;
      panel.marks.push_back({limit, fmt::format("{} → {:.4g}", family_of_method(method), limit), false});
      hold(limit);
    }
    const double margin = high > low ? 0.08 * (high - low) : 1;
    if (high >= low) panel.y_range = {low - margin, high + margin};
    figure.panels.push_back(std::move(panel));
  }
  figure.x_min = 0;
  if (coarsest > 0) figure.x_max = 1.08 * coarsest;
  figure.notes.push_back(
      "U: uncertainty from all meshes after Eça and Hoekstra (2014), meant to hold the exact value in 95 of 100 cases; "
      "→: what each method extrapolates to at h = 0");
  if (const std::string round = roundness(c, spec, runs, time); !round.empty()) figure.notes.push_back(round);
  result.figures.push_back(std::move(figure));
}

}  // namespace

FigureKind convergence_kind() {
  return {.id = "convergence",
          .scenes = FigureKind::Scenes::plates,
          .keys = {"probes", "variant", "times"},
          .draws = FigureKind::Draws::what_there_is,
          .read = read_convergence,
          .add = draw_convergence};
}

}  // namespace diptych::runner
