// A page: how far the methods are apart and how far they may be, as the gates of kind "agreement" have found.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "runner/draw/figure_kind.hpp"
#include "runner/draw/figure_runs.hpp"
#include "runner/draw/plate_maps.hpp"
#include "runner/draw/readings.hpp"
#include "runner/input/plate_build.hpp"

namespace diptych::runner {
namespace {

/// "radius of C_d = 0.05 at 45°" and "m" of a quantity of an agreement gate.
std::pair<std::string, std::string> quantity_words(const Case& c, const reports::Gate& gate) {
  for (const PlateProbe& probe : c.plate_probes)
    if (gate.quantity == "probe." + probe.id) return {words_of(probe), unit_of(probe)};
  if (gate.quantity == "contour.distance") return {"distance of the contours", "m"};
  if (gate.quantity == "platen.history") return {"history of the platen's displacement", ""};
  return {gate.quantity, ""};
}

void draw_agreement(const Case& c, const FigureSpec& spec, reports::Case& result) {
  reports::Page page;
  page.title = title_of(c, spec);
  page.intro = {
      c.why,
      "Where there is no exact solution the two methods are held against each other. Each one's uncertainty on a mesh "
      "is found from all of its meshes by the least-squares procedure of Eça and Hoekstra (2014), a band that is "
      "meant to hold the exact value in 95 of 100 cases; U is the root of the sum of their squares. Where U is more "
      "than a quarter of the value nothing is judged. Such agreement never outranks a gate against an exact solution."};
  for (const std::string& note : plate_notes(c, spec)) page.intro.push_back(note + ".");
  for (const reports::Gate& gate : result.gates) {
    if (gate.kind != "agreement") continue;
    const auto [words, unit] = quantity_words(c, gate);
    const auto of_unit = [&](const char* what) { return unit.empty() ? what : fmt::format("{} [{}]", what, unit); };
    const auto known = [&, heading = words](const auto& section) { return section.heading == heading; };
    if (std::none_of(page.sections.begin(), page.sections.end(), known)) {
      reports::Page::Section table;
      table.heading = words;
      table.first = "Mesh and time";
      table.columns = {of_unit("FEM"), of_unit("MPM"), of_unit("apart"), "apart [%]", of_unit("U"), "U [%]", "verdict"};
      page.sections.push_back(std::move(table));
    }
    reports::Page::Section& table = *std::find_if(page.sections.begin(), page.sections.end(), known);
    for (const reports::Agreement& one : gate.agreements) {
      const Cells mesh = cells_of(*c.plate, one.cells);
      std::string name = fmt::format("{} × {} cells", mesh.x, mesh.y);
      if (std::isfinite(one.time)) name += fmt::format(", {}", in_ms(one.time));
      const auto part = [&](double value) { return fmt::format("{:.2f}", 100 * value / one.size); };
      const bool passed = std::all_of(gate.checks.begin(), gate.checks.end(), [&](const reports::Check& check) {
        const bool about =
            check.what.starts_with(fmt::format("{} cells", one.cells)) &&
            (!std::isfinite(one.time) || check.what.find(fmt::format("t = {:g} s:", one.time)) != std::string::npos);
        return !about || check.passed;
      });
      table.rows.push_back({name,
                            gate.id,
                            {table_cell(one.values[0], 5), table_cell(one.values[1], 5), table_cell(one.apart),
                             part(one.apart), table_cell(one.expected), part(one.expected), passed ? "pass" : "FAIL"},
                            ""});
    }
    if (gate.agreements.empty())
      table.rows.push_back({gate.id, gate.message, {"", "", "", "", "", "", to_string(gate.verdict)}, ""});
  }
  result.pages.emplace_back(spec.id, std::move(page));
}

}  // namespace

FigureKind agreement_kind() {
  return {.id = "agreement",
          .scenes = FigureKind::Scenes::plates,
          .keys = {"cells"},
          .draws = FigureKind::Draws::what_there_is,
          .add = draw_agreement};
}

}  // namespace diptych::runner
