#include "runner/draw/plate_figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "runner/draw/convergence_figures.hpp"
#include "runner/draw/figure_runs.hpp"
#include "runner/input/leaf.hpp"
#include "runner/input/messages.hpp"
#include "runner/input/plate_build.hpp"

namespace diptych::runner {
namespace {

std::string symbol_of(const std::string& field) { return field == "damage" ? "D" : "C_d"; }

const reports::PlateFields* fields_at(const reports::Run* run, double time) {
  if (run)
    for (const auto& sample : run->samples)
      if (sample.asked == time && sample.plate) return &*sample.plate;
  return nullptr;
}

std::string in_ms(double seconds) { return fmt::format("t = {:g} ms", seconds * 1e3); }

std::string load_words(const SideLoad& load) {
  std::string text = load.traction;
  try {
    text = fmt::format("{:g} MPa", std::stod(load.traction) / 1e6);
  } catch (const std::exception&) {  // an expression stands for itself
  }
  if (load.history == "ramp") text += fmt::format(" within {:g} µs", load.rise * 1e6);
  if (load.history == "step") text += ", at once";
  if (load.history == "impulse") text += fmt::format(" for {:g} µs", load.duration * 1e6);
  return text;
}

std::vector<reports::Line> lines_of(const NodalMap& map, double level) {
  std::vector<reports::Line> lines;
  for (Polyline& one : contour(map, level)) {
    if (one.closed && !one.x.empty()) {
      one.x.push_back(one.x.front());
      one.y.push_back(one.y.front());
    }
    lines.push_back({std::move(one.x), std::move(one.y)});
  }
  return lines;
}

void add_contours(const NodalMap& map, const std::vector<double>& levels, const std::string& kind,
                  reports::PlateFigure::Panel& panel) {
  for (const double level : levels)
    panel.contours.push_back({fmt::format("{:g}", level), level, kind, lines_of(map, level)});
}

reports::PlateFigure blank(const Case& c, const FigureSpec& spec) {
  reports::PlateFigure figure;
  figure.id = spec.id;
  figure.title = title_of(c, spec);
  figure.notes = plate_notes(c, spec);
  figure.x_label = "x [m]";
  figure.y_label = "y [m]";
  figure.width = c.plate->width;
  figure.height = c.plate->height;
  return figure;
}

}  // namespace

reports::PlateFigure contour_figure(const Case& c, const FigureSpec& spec, const std::vector<reports::Run>& runs) {
  reports::PlateFigure figure = blank(c, spec);
  const Cells cells = cells_of(*c.plate, spec.cells);
  figure.notes.insert(figure.notes.begin() + 1,
                      fmt::format("{} × {} cells; four triangles a cell (FEM), particles at ξ, η = {} (MPM); Courant "
                                  "number {:g}; levels of {}: {}",
                                  cells.x, cells.y, particles_label(spec.particles), spec.courant,
                                  symbol_of(spec.field), listed(spec.levels)));
  if (const std::string words = distance_from_settled(c, spec, runs); !words.empty())
    figure.notes.insert(figure.notes.begin() + 2, words);
  const std::string symbol = symbol_of(spec.field);
  const auto& times = spec.times.empty() ? c.times : spec.times;
  figure.columns = static_cast<int>(spec.methods.size()) + (spec.methods.size() == 2 ? 1 : 0);
  double largest = 0, apart = 0;
  for (const double time : times) {
    std::vector<NodalMap> maps;
    for (const std::string& method : spec.methods) {
      reports::PlateFigure::Panel panel;
      panel.label = fmt::format("{}, {}", name_of_method(method), in_ms(time));
      if (const auto* fields = fields_at(find_run(runs, spec, method), time)) {
        maps.push_back(map_of(*fields, spec.field));
        const NodalMap& map = maps.back();
        add_contours(map, spec.levels, kind_of_method(method), panel);
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
      for (std::size_t m = 0; m < 2; ++m) add_contours(maps[m], spec.levels, kind_of_method(spec.methods[m]), panel);
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
  return figure;
}

reports::ProblemFigure problem_figure(const Case& c, const FigureSpec& spec) {
  reports::ProblemFigure figure;
  figure.id = spec.id;
  figure.title = title_of(c, spec);
  figure.notes = plate_notes(c, spec);
  figure.width = c.plate->width;
  figure.height = c.plate->height;
  figure.width_label = fmt::format("L_x = {:g} m", c.plate->width);
  figure.height_label = fmt::format("L_y = {:g} m", c.plate->height);
  const Cells cells = cells_of(*c.plate, spec.cells);
  figure.nx = cells.x;
  figure.ny = cells.y;
  using Support = Edge::Support;
  for (std::size_t side = 0; side < 4; ++side) {
    const Support support = c.plate->supports[side];
    auto& drawn = figure.sides[side];
    drawn.support = support_names[static_cast<std::size_t>(support)];
    if (support == Support::platen) drawn.label = "rigid, frictionless platen";
  }
  for (const SideLoad& load : c.plate->loads) {
    auto& drawn = figure.sides[static_cast<std::size_t>(load.side)];
    drawn.load = "p = " + load_words(load);
    drawn.outward = !load.traction.starts_with("-");
  }
  if (const auto* cracking = c.plate->cracking();
      cracking && cracking->evolution.diffusion && cracking->evolution.diffusion->source == diffusion::Source::zone) {
    figure.weak_radius = cracking->evolution.diffusion->radius;
    figure.weak_label = fmt::format("weak zone, r = {:g} m", cracking->evolution.diffusion->radius);
  }
  return figure;
}

reports::Figure history_figure(const Case& c, const FigureSpec& spec, const std::vector<reports::Run>& runs) {
  reports::Figure figure;
  figure.id = spec.id;
  figure.title = title_of(c, spec);
  figure.notes = plate_notes(c, spec);
  figure.x_label = "time t [ms]";
  figure.y_label = "displacement of the platen [mm]";
  figure.x_max = c.times.back() * 1e3;
  figure.y_min = figure.y_max = 0;
  reports::Figure::Panel panel;
  for (const std::string& method : spec.methods) {
    const reports::Run* run = find_run(runs, spec, method);
    if (!run) {
      figure.notes.push_back(method + " is missing: its run did not complete");
      continue;
    }
    reports::Curve curve = run->platen;
    for (double& t : curve.x) t *= 1e3;
    for (double& u : curve.y) {
      u *= 1e3;
      figure.y_min = std::min(figure.y_min, u);
      figure.y_max = std::max(figure.y_max, u);
    }
    panel.series.push_back({name_of_method(method), kind_of_method(method), std::move(curve)});
  }
  figure.panels.push_back(std::move(panel));
  const double margin = 0.05 * (figure.y_max - figure.y_min);
  figure.y_min -= margin > 0 ? margin : 1;
  figure.y_max += margin > 0 ? margin : 1;
  return figure;
}

namespace {

/// "radius of C_d = 0.05 at 45°" and "m" of a quantity of an agreement gate.
std::pair<std::string, std::string> quantity_words(const Case& c, const reports::Gate& gate) {
  for (const PlateProbe& probe : c.plate_probes)
    if (gate.quantity == "probe." + probe.id) return {words_of(probe), unit_of(probe)};
  if (gate.quantity == "contour.distance") return {"distance of the contours", "m"};
  if (gate.quantity == "platen.history") return {"history of the platen's displacement", ""};
  return {gate.quantity, ""};
}

}  // namespace

void add_agreement(const Case& c, const FigureSpec& spec, reports::Case& result) {
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

void add_choices(const Case& c, const FigureSpec& spec, const std::vector<reports::Run>& runs, reports::Case& result) {
  const double time = (spec.times.empty() ? c.times : spec.times).back(), level = spec.levels.front();
  const std::string symbol = symbol_of(spec.field);
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
    reports::PlateFigure picture = blank(c, spec);
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
      const NodalMap map = map_of(*fields, spec.field);
      row.values.push_back(table_cell(radius_along(map, level, 45)));
      row.values.push_back(table_cell(area_above(map, level)));
      row.values.push_back(table_cell(*std::max_element(map.value.begin(), map.value.end())));
      const auto given = run->measures.find("energy.given-back");
      row.values.push_back(given == run->measures.end() ? "" : fmt::format("{:.2g}", 100 * given->second));
      add_contours(map, spec.levels, kind_of_method(method), panel);
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

}  // namespace diptych::runner
