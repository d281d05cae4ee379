// Contours of a field on a plate by each method, and of their difference.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "runner/draw/figure_kind.hpp"
#include "runner/draw/figure_runs.hpp"
#include "runner/draw/plate_maps.hpp"
#include "runner/draw/readings.hpp"
#include "runner/input/leaf.hpp"
#include "runner/input/messages.hpp"
#include "runner/input/plate_build.hpp"

namespace diptych::runner {
namespace {

struct Contours {
  std::string field;  ///< "crack-density" or "damage"
  std::vector<double> levels;
};

void read_contours(Table& t, const Case&, FigureSpec& figure) {
  figure.options = Contours{t.get("field", one_of({"crack-density", "damage"}), "crack-density"),
                            t.need("levels", set_of(positive()))};
}

void draw_contours(const Case& c, const FigureSpec& spec, reports::Case& result) {
  const auto& [field, levels] = options_of<Contours>(spec);
  const std::vector<reports::Run>& runs = result.runs;
  reports::PlateFigure figure = blank_plate(c, spec);
  const Cells cells = cells_of(*c.plate, spec.cells);
  figure.notes.insert(figure.notes.begin() + 1,
                      fmt::format("{} × {} cells; four triangles a cell (FEM), particles at ξ, η = {} (MPM); Courant "
                                  "number {:g}; levels of {}: {}",
                                  cells.x, cells.y, particles_label(spec.particles), spec.courant,
                                  symbol_of_damage(field), listed(levels)));
  if (const std::string words = distance_from_settled(c, spec, runs); !words.empty())
    figure.notes.insert(figure.notes.begin() + 2, words);
  const std::string symbol = symbol_of_damage(field);
  const auto& times = spec.times.empty() ? c.times : spec.times;
  figure.columns = static_cast<int>(spec.methods.size()) + (spec.methods.size() == 2 ? 1 : 0);
  double largest = 0, apart = 0;
  for (const double time : times) {
    std::vector<NodalMap> maps;
    for (const std::string& method : spec.methods) {
      reports::PlateFigure::Panel panel;
      panel.label = fmt::format("{}, {}", name_of_method(method), in_ms(time));
      if (const auto* fields = fields_at(find_run(runs, spec, method), time)) {
        maps.push_back(map_of(*fields, field));
        const NodalMap& map = maps.back();
        add_contours(map, levels, kind_of_method(method), panel);
        panel.map = {map.nx, map.ny, map.value, 0, 1, symbol, false};
        for (const double value : map.value) largest = std::max(largest, value);
      } else {
        panel.label += ": its run did not complete";
      }
      figure.panels.push_back(std::move(panel));
    }
    if (spec.methods.size() != 2) continue;
    reports::PlateFigure::Panel panel;
    panel.label = fmt::format("difference, {}", in_ms(time));
    if (maps.size() == 2) {
      const NodalMap less = difference(maps[0], maps[1]);
      panel.map = {less.nx, less.ny, less.value, -1, 1, fmt::format("{} of FEM less MPM", symbol), true};
      for (const double value : less.value) apart = std::max(apart, std::abs(value));
      for (std::size_t m = 0; m < 2; ++m) add_contours(maps[m], levels, kind_of_method(spec.methods[m]), panel);
      for (auto& one : panel.contours) one.label.clear();
    }
    figure.panels.push_back(std::move(panel));
  }
  for (auto& panel : figure.panels) {
    if (!panel.map) continue;
    panel.map->max = panel.map->diverging ? (apart > 0 ? apart : 1) : largest > 0 ? largest : 1;
    if (spec.range && !panel.map->diverging) panel.map->max = (*spec.range)[1];
    panel.map->min = panel.map->diverging ? -panel.map->max : spec.range ? (*spec.range)[0] : 0;
  }
  result.plate_figures.push_back(std::move(figure));
}

}  // namespace

FigureKind contours_kind() {
  return {.id = "contours",
          .scenes = FigureKind::Scenes::plates,
          .keys = {"field", "levels", "times", "range", "cells"},
          .read = read_contours,
          .add = draw_contours};
}

}  // namespace diptych::runner
