#include "cases/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/leaf.hpp"

namespace diptych::cases {
namespace {

std::string unit_of(const Case& c, const std::string& field) {
  if (c.units == "paper") return "paper's units";
  return field == "stress" ? "Pa" : field == "velocity" ? "m/s" : "m";
}

std::string symbol_of(const std::string& field) { return field == "stress" ? "σ" : field == "velocity" ? "v" : "u"; }

std::string upper(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char ch) { return static_cast<char>(std::toupper(ch)); });
  return s;
}

const reports::Run* find(const std::vector<reports::Run>& runs, const FigureSpec& spec, const std::string& method) {
  for (const auto& run : runs) {
    if (run.method == method && run.cells == spec.cells && run.courant_asked == spec.courant &&
        run.status == "completed" && (method == "fem" || run.particles == particles_label(spec.particles))) {
      return &run;
    }
  }
  return nullptr;
}

void widen(reports::Figure& figure, const reports::Curve& curve) {
  for (const double y : curve.y) {
    if (!std::isfinite(y)) continue;
    figure.y_min = std::min(figure.y_min, y);
    figure.y_max = std::max(figure.y_max, y);
  }
}

}  // namespace

std::vector<reports::Figure> make_figures(const Case& c, const std::vector<reports::Run>& runs) {
  std::vector<reports::Figure> figures;
  for (const FigureSpec& spec : c.figures) {
    reports::Figure figure;
    figure.id = spec.id;
    figure.title = spec.id.rfind("fig", 0) == 0 ? fmt::format("Fig. {}. {}", spec.id.substr(3), c.title) : c.title;
    figure.y_min = figure.y_max = 0;
    figure.x_label = fmt::format("x [{}]", c.units == "paper" ? "paper's units" : "m");
    figure.y_label = fmt::format("{} {} [{}]", spec.field, symbol_of(spec.field), unit_of(c, spec.field));
    figure.x_max = c.length;
    const bool mpm = spec.methods != std::vector<std::string>{"fem"};
    const std::string particles =
        mpm ? fmt::format("particles at ξ = {} of each cell; ", particles_label(spec.particles)) : "";
    figure.notes.push_back(
        fmt::format("{} cells; Courant number {:g}; {}{} displacements; E = {:g}, ρ = {:g}, L = {:g}", spec.cells,
                    spec.courant, particles, c.convected ? "finite" : "infinitesimal",
                    material::youngs_modulus(c.material), material::density(c.material), c.length));
    if (!c.paper_figures.empty()) {
      figure.notes.push_back("The times are our choice, to show what the paper describes.");
    }
    const auto& times = spec.times.empty() ? c.times : spec.times;
    for (std::size_t i = 0; i < times.size(); ++i) {
      reports::Figure::Panel panel;
      panel.label = fmt::format("t = {:g} {}", times[i], c.time_unit);
      if (i < spec.captions.size()) panel.label += ": " + spec.captions[i];
      for (const std::string& method : spec.methods) {
        const reports::Run* run = find(runs, spec, method);
        if (!run) {
          figure.notes.push_back(method + " is missing: its run did not complete");
          continue;
        }
        for (const auto& sample : run->samples) {
          if (sample.asked != times[i]) continue;
          if (panel.series.empty() && sample.exact_curves.count(spec.field)) {
            panel.series.push_back({"exact", "exact", sample.exact_curves.at(spec.field)});
          }
          const bool fem = method == "fem";
          panel.series.push_back(
              {fem ? "FEM" : "MPM, " + upper(method.substr(4)), fem ? "fem" : "mpm", sample.curves.at(spec.field)});
        }
      }
      for (const auto& series : panel.series) widen(figure, series.curve);
      figure.panels.push_back(std::move(panel));
    }
    const double height = figure.y_max - figure.y_min, margin = height > 0 ? 0.05 * height : 1;
    figure.y_min -= margin;
    figure.y_max += margin;
    if (spec.range) {
      figure.y_min = (*spec.range)[0];
      figure.y_max = (*spec.range)[1];
    }
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace diptych::cases
