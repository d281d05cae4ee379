#include "runner/ablate/strip.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "runner/input/plate_build.hpp"

namespace diptych::runner {
namespace {

/// Values of one component at the same place but for the axis.
struct Row {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  int count = 0;
};

}  // namespace

Variation variation_along(Axis axis, const reports::Run& run) {
  const std::size_t along = axis == Axis::y ? 1 : 0;
  std::map<std::string, double> largest = largest_lengths(run);
  Variation found;
  const auto note = [&](double part, const std::string& field, double time) {
    if (part > found.part || std::isnan(part)) found = {part, field, time};
  };
  for (const reports::Sample& sample : run.samples) {
    for (const PointValues& field : fields_at(sample)) {
      const double scale = largest[field.name];
      if (!(scale > 0)) continue;
      const std::vector<double>& place = axis == Axis::y ? field.x : field.y;
      const double extent = *std::max_element(place.begin(), place.end());
      for (std::size_t k = 0; k < field.component.size(); ++k) {
        std::map<long, Row> rows;
        for (std::size_t p = 0; p < place.size(); ++p) {
          Row& row = rows[std::lround(1e7 * place[p] / std::max(extent, 1e-300))];
          const double value = field.component[k][p];
          row.least = std::min(row.least, value);
          row.most = std::max(row.most, value);
          ++row.count;
        }
        for (const auto& [at, row] : rows)
          if (row.count > 1) note((row.most - row.least) / scale, field.name, sample.asked);
      }
      // What moves along the strip would be held by its rollers.
      if (field.name == "displacement" || field.name == "velocity")
        for (const double value : field.component[along]) note(std::abs(value) / scale, field.name, sample.asked);
    }
  }
  return found;
}

std::optional<Revision> strip_across(Axis axis, const Case& c, const Leaf& leaf) {
  const PlateSpec& plate = *c.plate;
  const diffusion::Grid grid = grid_of(plate, leaf.cells);
  const bool rows = axis == Axis::y;
  const int n = rows ? grid.ny : grid.nx;
  if (n < 2) return {};
  Revision r;
  r.says = fmt::format("a strip of one {} of cells instead of {}", rows ? "row" : "column", n);
  if (rows && plate.cell_aspect == 1) {
    r.says += ": plate.rows = 1";
    r.changes.push_back({"plate.rows", Node{{}, std::int64_t{1}}});
    for (const char* key : {"plate.height", "plate.cell_aspect"})
      if (c.scene.contains(key)) r.changes.push_back({key, {}});
  } else if (rows) {
    r.says += fmt::format(": plate.height = {:.6g}", grid.hy);
    r.changes.push_back({"plate.height", Node{{}, grid.hy}});
  } else {
    r.says += fmt::format(": plate.width = {:.6g} with one cell", grid.hx);
    r.changes.push_back({"plate.width", Node{{}, grid.hx}});
    r.cells = 1;
  }
  const std::array<std::size_t, 2> sides = rows ? std::array<std::size_t, 2>{2, 3} : std::array<std::size_t, 2>{0, 1};
  bool rollers = false;
  for (const std::size_t side : sides) {
    if (!plate.solid || plate.supports[side] != Edge::Support::free) continue;
    r.changes.push_back({"supports." + side_names[side], value_in("roller")});
    rollers = true;
  }
  if (rollers) r.says += ", and rollers where its long sides are free";
  if (plate.solid && std::holds_alternative<solid::Elastic>(*plate.solid) && !compression_of(*plate.solid)) {
    const double speed = elastic_of(plate).pressure_wave_speed();  // of a strip that cannot widen
    r.says += fmt::format("; or a bar with E = {:.4g}", elastic_of(plate).density * speed * speed);
  }
  for (const PlateProbe& probe : c.plate_probes) {
    const std::string key = "sample.probes[" + probe.id + ']';
    if (probe.reads == "total" || probe.reads == "area") {
      r.changes.push_back({key, {}});  // of so many cells less
    } else if (c.scene.contains(key + ".at")) {
      // On the strip's edge: wherever it stands, nothing varies along it.
      const double x = rows ? probe.x : 0, y = rows ? 0 : probe.y;
      r.changes.push_back({key + ".at", Node{{}, Node::List{Node{{}, x}, Node{{}, y}}}});
    }
  }
  return r;
}

}  // namespace diptych::runner
