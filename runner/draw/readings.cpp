#include "runner/draw/readings.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "runner/draw/figure_runs.hpp"
#include "runner/input/plate_build.hpp"

namespace diptych::runner {

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

const PlateProbe& probe_of(const Case& c, const std::string& id) {
  return *std::find_if(c.plate_probes.begin(), c.plate_probes.end(),
                       [&](const PlateProbe& probe) { return probe.id == id; });
}

double reading(const reports::Run& run, double time, const std::string& id) {
  for (const auto& sample : run.samples)
    for (const auto& probe : sample.probes)
      if (sample.asked == time && probe.id == id) return probe.value;
  return std::numeric_limits<double>::quiet_NaN();
}

Readings series_of(const std::vector<reports::Run>& runs, const FigureSpec& spec, const std::string& method,
                   const std::string& variant, const std::string& probe, double time) {
  std::map<int, const reports::Run*> meshes;
  for (const reports::Run& run : runs) {
    FigureSpec one = spec;
    one.cells = run.cells;
    if (const reports::Run* found = find_run(runs, one, method, variant)) meshes[run.cells] = found;
  }
  Readings series;
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

std::string distance_from_settled(const Case& c, const FigureSpec& spec, const std::vector<reports::Run>& runs) {
  std::map<std::string, double> off{{"radius", 0}, {"area", 0}, {"total", 0}};
  int finest = 0;
  for (const PlateProbe& probe : c.plate_probes) {
    if (!off.contains(probe.reads)) continue;
    for (const std::string& method : spec.methods) {
      for (const double time : spec.times.empty() ? c.times : spec.times) {
        const Readings series = series_of(runs, spec, method, "", probe.id, time);
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

}  // namespace diptych::runner
