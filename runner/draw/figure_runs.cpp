#include "runner/draw/figure_runs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "runner/input/leaf.hpp"
#include "runner/input/plate_build.hpp"

namespace diptych::runner {

const reports::Run* find_run(const std::vector<reports::Run>& runs, const FigureSpec& spec, const std::string& method,
                             const std::string& variant) {
  const std::string parameters = parameters_label(Leaf{method, spec.cells, 0, {}, spec.parameters, variant});
  for (const auto& run : runs) {
    if (run.method == method && run.cells == spec.cells && run.courant_asked == spec.courant_of(method) &&
        run.parameters == parameters && run.status == "completed" &&
        (!panel(method).particles || run.particles == particles_label(spec.particles))) {
      return &run;
    }
  }
  return nullptr;
}

std::string name_of_method(const std::string& method) { return panel(method).name; }

std::string kind_of_method(const std::string& method) { return panel(method).look.id; }

std::string family_of_method(const std::string& method) { return panel(method).look.name; }

std::string title_of(const Case& c, const FigureSpec& spec) {
  const std::string title = spec.title.empty() ? c.title : spec.title;
  return spec.id.rfind("fig", 0) == 0 ? fmt::format("Fig. {}. {}", spec.id.substr(3), title) : title;
}

std::string table_cell(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "–";
}

void widen(reports::Figure& figure, const reports::Curve& curve) {
  for (const double y : curve.y) {
    if (!std::isfinite(y)) continue;
    figure.y_min = std::min(figure.y_min, y);
    figure.y_max = std::max(figure.y_max, y);
  }
}

void take_range(const FigureSpec& spec, reports::Figure& figure) {
  if (spec.range) {
    figure.y_min = (*spec.range)[0];
    figure.y_max = (*spec.range)[1];
  }
}

std::vector<std::string> plate_notes(const Case& c, const FigureSpec& spec) {
  std::vector<std::string> notes{words_of(*c.plate)};
  if (const auto* cracking = c.plate->cracking(); cracking && cracking->evolution.diffusion) {
    const diffusion::Evolution* evolution = &cracking->evolution;
    const diffusion::Diffusion& d = *evolution->diffusion;
    notes.push_back(
        fmt::format("Diffusion read as {}; λ1 = {:g} m²/s, d at least {:g} λ1, λ2 = {:g}, T_d = {:g} s, ε_v1 = {:g}, "
                    "ε_vf = {:g}",
                    d.reading == diffusion::Reading::radial ? "∂/∂r (d ∂C/∂r)" : "∇·(d ∇C)", d.mobility, d.floor,
                    d.crack_volume, d.characteristic_time, evolution->critical_strain, d.rupture_strain));
  }
  if (!c.paper_figures.empty() && !spec.choices.empty()) notes.push_back("Reconstructed parameters: " + spec.choices);
  return notes;
}

}  // namespace diptych::runner
