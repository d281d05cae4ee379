#include "cases/plate_figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "cases/figure_runs.hpp"
#include "cases/leaf.hpp"
#include "cases/messages.hpp"
#include "cases/plate_build.hpp"

namespace diptych::cases {
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

std::vector<std::string> notes_of(const Case& c, const FigureSpec& spec) {
  std::vector<std::string> notes{words_of(*c.plate)};
  if (const auto& evolution = c.plate->evolution; evolution && evolution->diffusion) {
    const diffusion::Diffusion& d = *evolution->diffusion;
    notes.push_back(
        fmt::format("Diffusion read as {}; λ1 = {:g} m²/s, λ2 = {:g}, T_d = {:g} s, ε_v1 = {:g}, ε_vf = {:g}",
                    d.reading == diffusion::Reading::radial ? "∂/∂r (d ∂C/∂r)" : "∇·(d ∇C)", d.mobility, d.crack_volume,
                    d.characteristic_time, evolution->critical_strain, d.rupture_strain));
  }
  if (!c.paper_figures.empty() && !spec.choices.empty()) notes.push_back("Reconstructed parameters: " + spec.choices);
  return notes;
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
  figure.notes = notes_of(c, spec);
  figure.x_label = "x [m]";
  figure.y_label = "y [m]";
  figure.width = c.plate->width;
  figure.height = c.plate->height;
  return figure;
}

}  // namespace

NodalMap map_of(const reports::PlateFields& f, const std::string& field) {
  return {f.nx, f.ny, f.width / f.nx, f.height / f.ny, field == "damage" ? f.damage : f.crack_density};
}

reports::PlateFigure contour_figure(const Case& c, const FigureSpec& spec, const std::vector<reports::Run>& runs) {
  reports::PlateFigure figure = blank(c, spec);
  const Cells cells = cells_of(*c.plate, spec.cells);
  figure.notes.insert(figure.notes.begin() + 1,
                      fmt::format("{} × {} cells; four triangles a cell (FEM), particles at ξ, η = {} (MPM); Courant "
                                  "number {:g}; levels of {}: {}",
                                  cells.x, cells.y, particles_label(spec.particles), spec.courant,
                                  symbol_of(spec.field), listed(spec.levels)));
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
  figure.notes = notes_of(c, spec);
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
  if (const auto& evolution = c.plate->evolution;
      evolution && evolution->diffusion && evolution->diffusion->source == diffusion::Source::zone) {
    figure.weak_radius = evolution->diffusion->radius;
    figure.weak_label = fmt::format("weak zone, r = {:g} m", evolution->diffusion->radius);
  }
  return figure;
}

reports::Figure history_figure(const Case& c, const FigureSpec& spec, const std::vector<reports::Run>& runs) {
  reports::Figure figure;
  figure.id = spec.id;
  figure.title = title_of(c, spec);
  figure.notes = notes_of(c, spec);
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

reports::Figure sweep_figure(const Case& c, const FigureSpec& spec, const std::vector<reports::Run>& runs) {
  const double time = (spec.times.empty() ? c.times : spec.times).back();
  const auto swept =
      std::find_if(c.axes.begin(), c.axes.end(), [&](const Axes& axes) { return axes.parameters.contains(spec.over); });
  reports::Figure figure;
  figure.id = spec.id;
  figure.title = title_of(c, spec);
  figure.notes = notes_of(c, spec);
  figure.x_label = spec.over;
  figure.y_label = fmt::format("{} at {}", spec.probe, in_ms(time));
  figure.y_min = figure.y_max = 0;
  if (swept == c.axes.end()) return figure;
  const auto& values = swept->parameters.at(spec.over);
  figure.x_min = *std::min_element(values.begin(), values.end());
  figure.x_max = *std::max_element(values.begin(), values.end());
  for (const int cells : swept->cells) {
    const Cells mesh = cells_of(*c.plate, cells);
    reports::Figure::Panel panel;
    panel.label = fmt::format("{} × {} cells", mesh.x, mesh.y);
    for (const std::string& method : spec.methods) {
      reports::Curve curve;
      for (const double value : values) {
        FigureSpec one = spec;
        one.cells = cells;
        one.parameters[spec.over] = value;
        double y = std::nan("");
        if (const reports::Run* run = find_run(runs, one, method, spec.variant))
          for (const auto& sample : run->samples)
            for (const auto& probe : sample.probes)
              if (sample.asked == time && probe.id == spec.probe) y = probe.value;
        curve.x.push_back(value);
        curve.y.push_back(y);
        if (std::isfinite(y)) figure.y_max = std::max(figure.y_max, y);
      }
      panel.series.push_back({name_of_method(method), kind_of_method(method), std::move(curve)});
    }
    figure.panels.push_back(std::move(panel));
  }
  figure.y_max *= 1.05;
  return figure;
}

void add_agreement(const Case& c, const FigureSpec& spec, reports::Case& result) {
  reports::Page page;
  reports::Page::Section table;
  page.title = title_of(c, spec);
  table.first = "Quantity, mesh and time";
  page.intro = {
      c.why,
      "Where there is no exact solution the two methods are held against each other. Each one's uncertainty on a mesh "
      "is "
      "found from all of its meshes by the least-squares procedure of Eça and Hoekstra (2014), a band that is "
      "meant to hold the exact value in 95 of 100 cases; expected is the root of the sum of their squares. Such "
      "agreement never outranks a gate against an exact solution."};
  for (const std::string& note : notes_of(c, spec)) page.intro.push_back(note + ".");
  table.columns = {"apart", "expected within", "ratio", "allowed", "verdict"};
  for (const reports::Gate& gate : result.gates) {
    if (gate.kind != "agreement") continue;
    for (const reports::Check& check : gate.checks) {
      const std::string what = check.what.substr(0, check.what.find(':'));
      table.rows.push_back({fmt::format("{}: {}", gate.id, what),
                            gate.quantity,
                            {table_cell(check.value), check.predicted ? table_cell(*check.predicted) : "",
                             table_cell(check.judged), table_cell(check.high), check.passed ? "pass" : "FAIL"},
                            ""});
    }
    if (gate.checks.empty())
      table.rows.push_back({gate.id, gate.message, {"", "", "", "", to_string(gate.verdict)}, ""});
  }
  page.sections.push_back(std::move(table));
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
  for (const std::string& note : notes_of(c, spec)) page.intro.push_back(note + ".");
  for (const std::string& method : spec.methods) {
    const std::string name = method == "fem" ? "FEM" : "MPM";
    for (const char* what : {"radius at 45° [m]", "area [m²]"})
      table.columns.push_back(fmt::format("{} {}", name, what));
    table.columns.push_back(fmt::format("{} largest {}", name, symbol));
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
      const auto* fields = fields_at(find_run(runs, spec, method, variant.id), time);
      if (!fields) {
        row.values.insert(row.values.end(), {"did not complete", "", ""});
        continue;
      }
      any = true;
      const NodalMap map = map_of(*fields, spec.field);
      row.values.push_back(table_cell(radius_along(map, level, 45)));
      row.values.push_back(table_cell(area_above(map, level)));
      row.values.push_back(table_cell(*std::max_element(map.value.begin(), map.value.end())));
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

}  // namespace diptych::cases
