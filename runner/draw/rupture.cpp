// The load of rupture over the cell size, read from a sweep.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "runner/draw/figure_kind.hpp"
#include "runner/draw/figure_runs.hpp"
#include "runner/draw/readings.hpp"
#include "runner/input/case_tables.hpp"
#include "runner/input/plate_build.hpp"

namespace diptych::runner {
namespace {

struct Rupture {
  std::string probe;  ///< of the largest C_d
  std::string variant;
};

void read_rupture(Table& t, const Case& c, FigureSpec& figure) {
  Names swept, largest;
  for (const auto& entry : all_axes(c).parameters) swept.push_back(entry.first);
  for (const PlateProbe& probe : c.plate_probes)
    if (probe.reads == "largest") largest.push_back(probe.id);
  figure.over = t.need("over", one_of(swept));
  figure.options = Rupture{t.need("probe", one_of(largest)), t.get("variant", one_of(variants_of(c)))};
}

constexpr double unread = std::numeric_limits<double>::quiet_NaN();

void draw_rupture(const Case& c, const FigureSpec& spec, reports::Case& result) {
  const auto& [probe, variant] = options_of<Rupture>(spec);
  const std::vector<reports::Run>& runs = result.runs;
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
    if (!axes.parameters.contains(spec.over) || !contains(axes.variant, variant)) continue;
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
      double size = 0, load = unread;
      for (const double p : loads) {
        FigureSpec one = spec;
        one.cells = cells;
        one.parameters[spec.over] = p;
        const reports::Run* run = find_run(runs, one, method, variant);
        if (!run) continue;
        size = run->cell_size;
        const double D = law.damage(std::clamp(reading(*run, time, probe), 0.0, cap));
        if (std::isnan(load) && D >= ruptured && !damage.y.empty() && damage.y.back() < ruptured)
          load = damage.x.back() + (p / mega - damage.x.back()) * (ruptured - damage.y.back()) / (D - damage.y.back());
        damage.add(p / mega, D);
      }
      if (cells == meshes.back()) over_load.series.push_back({name_of_method(method), kind_of_method(method), damage});
      if (std::isnan(load)) {
        missing += fmt::format("{}{} on {} cells", missing.empty() ? "" : ", ", name_of_method(method), cells);
        continue;
      }
      rupture.add(size, load);
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
  result.figures.push_back(std::move(figure));
}

}  // namespace

FigureKind rupture_kind() {
  return {.id = "rupture",
          .scenes = FigureKind::Scenes::plates,
          .keys = {"over", "probe", "variant", "times"},
          .draws = FigureKind::Draws::what_there_is,
          .read = read_rupture,
          .add = draw_rupture};
}

}  // namespace diptych::runner
