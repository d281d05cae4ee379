#include "runner/draw/convergence_figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "runner/compare/uncertainty.hpp"
#include "runner/draw/figure_runs.hpp"
#include "runner/input/leaf.hpp"
#include "runner/input/messages.hpp"
#include "runner/input/plate_build.hpp"

namespace diptych::runner {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double reading(const reports::Run& run, double time, const std::string& id) {
  for (const auto& sample : run.samples)
    for (const auto& probe : sample.probes)
      if (sample.asked == time && probe.id == id) return probe.value;
  return none;
}

/// A reading on each mesh of a method, from the coarsest on.
struct Series {
  std::vector<int> cells;
  std::vector<double> size, value;
  std::optional<Uncertainty> uncertainty;  ///< where there are meshes enough
};

Series series_of(const std::vector<reports::Run>& runs, const FigureSpec& spec, const std::string& method,
                 const std::string& probe, double time) {
  std::map<int, const reports::Run*> meshes;
  for (const reports::Run& run : runs) {
    FigureSpec one = spec;
    one.cells = run.cells;
    if (const reports::Run* found = find_run(runs, one, method, spec.variant)) meshes[run.cells] = found;
  }
  Series series;
  for (const auto& [cells, run] : meshes) {
    const double value = reading(*run, time, probe);
    if (!std::isfinite(value)) continue;
    series.cells.push_back(cells);
    series.size.push_back(run->cell_size);
    series.value.push_back(value);
  }
  if (series.size.size() >= levels_for_uncertainty)
    series.uncertainty = discretisation_uncertainty(series.size, series.value);
  return series;
}

const PlateProbe& probe_of(const Case& c, const std::string& id) {
  return *std::find_if(c.plate_probes.begin(), c.plate_probes.end(),
                       [&](const PlateProbe& probe) { return probe.id == id; });
}

/// Whether the contours are circles, from the radii on the finest mesh of each method.
std::string roundness(const Case& c, const FigureSpec& spec, const std::vector<reports::Run>& runs, double time) {
  std::string text;
  for (const std::string& method : spec.methods) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    std::string radii, angles;
    for (const std::string& id : spec.probes) {
      const PlateProbe& probe = probe_of(c, id);
      if (probe.reads != "radius") continue;
      const Series series = series_of(runs, spec, method, id, time);
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

}  // namespace

std::string words_of(const PlateProbe& probe) {
  if (probe.reads == "radius") return fmt::format("radius of C_d = {:g} at {:g}°", probe.level, probe.angle);
  if (probe.reads == "area") return fmt::format("area with C_d ≥ {:g}", probe.level);
  if (probe.reads == "total") return "∫C dA";
  if (probe.reads == "platen") return "displacement of the platen";
  if (probe.reads == "largest") return "largest C_d";
  return probe.id;
}

std::string unit_of(const PlateProbe& probe) {
  const std::string& reads = probe.reads;
  if (reads == "radius" || reads == "platen" || reads.starts_with("displacement")) return "m";
  if (reads == "area") return "m²";
  if (reads == "total") return "1/m";
  if (reads == "concentration") return "1/m³";
  if (reads.starts_with("velocity")) return "m/s";
  if (reads.starts_with("stress")) return "Pa";
  return reads == "acoustic-angle" ? "°" : "";
}

reports::Figure convergence_figure(const Case& c, const FigureSpec& spec, const std::vector<reports::Run>& runs) {
  const double time = spec.times.front();
  reports::Figure figure;
  figure.id = spec.id;
  figure.title = title_of(c, spec);
  figure.notes = plate_notes(c, spec);
  figure.x_label = "cell size h [m]";
  double coarsest = 0;
  for (const std::string& id : spec.probes) {
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
      const Series series = series_of(runs, spec, method, id, time);
      if (series.value.empty()) continue;
      const std::string kind = kind_of_method(method), name = name_of_method(method);
      const double finest = series.size.back();
      reports::Curve values, band;
      for (std::size_t k = 0; k < series.size.size(); ++k) {
        const double h = series.size[k], value = series.value[k];
        if (h > 8.5 * finest) continue;  // what is coarser is off by more than the rest of the panel
        coarsest = std::max(coarsest, h);
        values.x.push_back(h);
        values.y.push_back(value);
        hold(value);
        if (!series.uncertainty) continue;
        const double u = series.uncertainty->of(k);
        band.x.insert(band.x.end(), {h, h, none});
        band.y.insert(band.y.end(), {value - u, value + u, none});
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
  return figure;
}

std::string distance_from_settled(const Case& c, const FigureSpec& spec, const std::vector<reports::Run>& runs) {
  std::map<std::string, double> off{{"radius", 0}, {"area", 0}, {"total", 0}};
  int finest = 0;
  for (const PlateProbe& probe : c.plate_probes) {
    if (!off.contains(probe.reads)) continue;
    for (const std::string& method : spec.methods) {
      for (const double time : spec.times.empty() ? c.times : spec.times) {
        const Series series = series_of(runs, spec, method, probe.id, time);
        const auto here = std::find(series.cells.begin(), series.cells.end(), spec.cells);
        if (here == series.cells.end()) continue;
        finest = std::max(finest, series.cells.back());
        const double value = series.value[static_cast<std::size_t>(here - series.cells.begin())];
        off[probe.reads] = std::max(off[probe.reads], std::abs(value / series.value.back() - 1));
      }
    }
  }
  if (finest <= spec.cells) return {};
  const Cells mesh = cells_of(*c.plate, finest);
  return fmt::format(
      "This mesh is not settled: beside {} × {} cells its radii are off by up to {:.0f} %, its areas by {:.0f} % and "
      "its "
      "∫C dA by {:.0f} %",
      mesh.x, mesh.y, 100 * off["radius"], 100 * off["area"], 100 * off["total"]);
}

reports::Figure rupture_figure(const Case& c, const FigureSpec& spec, const std::vector<reports::Run>& runs) {
  const double time = (spec.times.empty() ? c.times : spec.times).back(), ruptured = 0.9;
  const material::TensileDamage& law = c.plate->cracking()->law;
  const double cap = c.plate->cracking()->evolution.cap, mega = 1e6;
  reports::Figure figure;
  figure.id = spec.id;
  figure.title = title_of(c, spec);
  figure.notes = plate_notes(c, spec);
  std::vector<double> loads;
  std::vector<int> meshes;
  for (const Axes& axes : c.axes) {
    if (!axes.parameters.contains(spec.over) || !contains(axes.variant, spec.variant)) continue;
    loads = axes.parameters.at(spec.over);
    meshes.insert(meshes.end(), axes.cells.begin(), axes.cells.end());
  }
  std::sort(loads.begin(), loads.end());
  std::sort(meshes.begin(), meshes.end());
  reports::Figure::Panel over_load, over_size;
  const Cells finest = cells_of(*c.plate, meshes.back());
  over_load.label = fmt::format("largest D at {:g} ms, {} × {} cells", time * 1e3, finest.x, finest.y);
  over_load.x_label = "load p [MPa]";
  over_load.y_label = "D";
  over_load.x_range = {loads.front() / mega, loads.back() / mega};
  over_load.y_range = {0, 1.12};
  over_load.marks = {{1, "D = 1", false}, {ruptured, fmt::format("D = {:g}: ruptured", ruptured), false}};
  over_size.label = fmt::format("load at which D reaches {:g} somewhere", ruptured);
  over_size.x_label = "cell size h [m]";
  over_size.y_label = "load of rupture [MPa]";
  double least = std::numeric_limits<double>::infinity(), most = 0, largest_size = 0;
  std::string missing;
  for (const std::string& method : spec.methods) {
    reports::Curve rupture;
    for (const int cells : meshes) {
      reports::Curve damage;
      double size = 0, load = none;
      for (const double p : loads) {
        FigureSpec one = spec;
        one.cells = cells;
        one.parameters[spec.over] = p;
        const reports::Run* run = find_run(runs, one, method, spec.variant);
        if (!run) continue;
        size = run->cell_size;
        const double D = law.damage(std::clamp(reading(*run, time, spec.probe), 0.0, cap));
        if (std::isnan(load) && D >= ruptured && !damage.y.empty() && damage.y.back() < ruptured)
          load = damage.x.back() + (p / mega - damage.x.back()) * (ruptured - damage.y.back()) / (D - damage.y.back());
        damage.x.push_back(p / mega);
        damage.y.push_back(D);
      }
      if (cells == meshes.back()) over_load.series.push_back({name_of_method(method), kind_of_method(method), damage});
      if (std::isnan(load)) {
        missing += fmt::format("{}{} on {} cells", missing.empty() ? "" : ", ", name_of_method(method), cells);
        continue;
      }
      rupture.x.push_back(size);
      rupture.y.push_back(load);
      least = std::min(least, load);
      most = std::max(most, load);
      largest_size = std::max(largest_size, size);
    }
    over_size.series.push_back({name_of_method(method), kind_of_method(method), std::move(rupture)});
  }
  if (most > 0) {
    figure.notes.push_back(
        fmt::format("Load of rupture between {:.0f} and {:.0f} MPa over methods and meshes: a spread of {:.1f} %",
                    least, most, 100 * (most / least - 1)));
    const double margin = std::max(10.0, 0.2 * (most - least));
    over_size.y_range = {least - margin, most + margin};
    over_size.x_range = {0, 1.1 * largest_size};
  }
  if (!missing.empty())
    figure.notes.push_back(fmt::format("No rupture begins between {:g} and {:g} MPa: {}", loads.front() / mega,
                                       loads.back() / mega, missing));
  figure.panels = {std::move(over_load), std::move(over_size)};
  return figure;
}

}  // namespace diptych::runner
