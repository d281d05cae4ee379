// A page: what each variant does to a contour, with a picture for each of its rows.
#include <fmt/core.h>

#include <algorithm>

#include "runner/draw/figure_kind.hpp"
#include "runner/draw/figure_runs.hpp"
#include "runner/draw/plate_maps.hpp"
#include "runner/input/leaf.hpp"
#include "runner/input/plate_build.hpp"

namespace diptych::runner {
namespace {

struct Choices {
  std::string field;           ///< "crack-density" or "damage"
  std::vector<double> levels;  ///< radius and area in the table are those of the first
};

void read_choices(Table& t, const Case&, FigureSpec& figure) {
  figure.options = Choices{t.get("field", one_of({"crack-density", "damage"}), "crack-density"),
                           t.need("levels", set_of(positive()))};
  figure.recorded.energy = true;  // the table has the energy that comes back
}

void draw_choices(const Case& c, const FigureSpec& spec, reports::Case& result) {
  const auto& [field, levels] = options_of<Choices>(spec);
  const std::vector<reports::Run>& runs = result.runs;
  const double time = (spec.times.empty() ? c.times : spec.times).back(), level = levels.front();
  const std::string symbol = symbol_of_damage(field);
  reports::Page page;
  reports::Page::Section table;
  page.title = title_of(c, spec);
  const Cells cells = cells_of(*c.plate, spec.cells);
  page.intro = {c.why,
                fmt::format("{} × {} cells, {}. Every row changes the reference in what its name says and in nothing "
                            "else. Radii and area are those of {} = {:g}. FEM solid, MPM dashed.",
                            cells.x, cells.y, in_ms(time), symbol, level)};
  for (const std::string& note : plate_notes(c, spec)) page.intro.push_back(note + ".");
  for (const std::string& method : spec.methods) {
    const std::string name = family_of_method(method);
    for (const char* what : {"radius at 45° [m]", "area [m²]"})
      table.columns.push_back(fmt::format("{} {}", name, what));
    table.columns.push_back(fmt::format("{} largest {}", name, symbol));
    table.columns.push_back(name + " energy given back [%]");
  }
  std::vector<PlateVariant> rows{{"", "Reference", *c.plate}};
  rows.insert(rows.end(), c.variants.begin(), c.variants.end());
  for (const PlateVariant& variant : rows) {
    reports::Page::Row row;
    row.name = variant.id.empty() ? "default set" : variant.id;
    row.description = variant.id.empty() ? spec.choices : variant.says;
    row.reference = variant.id.empty();
    reports::PlateFigure picture = blank_plate(c, spec);
    picture.id = spec.id + "." + (variant.id.empty() ? "reference" : variant.id);
    picture.title = row.name;
    picture.notes.clear();
    picture.columns = 1;
    reports::PlateFigure::Panel panel;
    panel.label = in_ms(time);
    bool any = false;
    for (const std::string& method : spec.methods) {
      const reports::Run* run = find_run(runs, spec, method, variant.id);
      const auto* fields = fields_at(run, time);
      if (!fields) {
        row.values.insert(row.values.end(), {"did not complete", "", "", ""});
        continue;
      }
      any = true;
      const NodalMap map = map_of(*fields, field);
      row.values.push_back(table_cell(radius_along(map, level, 45)));
      row.values.push_back(table_cell(area_above(map, level)));
      row.values.push_back(table_cell(*std::max_element(map.value.begin(), map.value.end())));
      const auto given = run->measures.find("energy.given-back");
      row.values.push_back(given == run->measures.end() ? "" : fmt::format("{:.2g}", 100 * given->second));
      add_contours(map, levels, kind_of_method(method), panel);
    }
    if (any) {
      row.picture = picture.id + ".svg";
      row.caption = fmt::format("contours of {} at {}: {}", symbol, in_ms(time), row.name);
      picture.panels.push_back(std::move(panel));
      result.plate_figures.push_back(std::move(picture));
    }
    table.rows.push_back(std::move(row));
  }
  page.sections.push_back(std::move(table));
  result.pages.emplace_back(spec.id, std::move(page));
}

}  // namespace

FigureKind choices_kind() {
  return {.id = "choices",
          .scenes = FigureKind::Scenes::plates,
          .keys = {"field", "levels", "times", "cells"},
          .read = read_choices,
          .add = draw_choices};
}

}  // namespace diptych::runner
