#include "runner/draw/bar_figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "runner/draw/figure_runs.hpp"
#include "runner/input/build.hpp"
#include "runner/input/leaf.hpp"

namespace diptych::runner {
namespace {

bool same(const BarSpec& a, const BarSpec& b) { return words_of(a) == words_of(b); }

}  // namespace

std::string length_unit(const Case& c) { return c.units == "paper" ? "paper's units" : "m"; }

std::vector<std::string> bar_notes(const Case& c, const FigureSpec& spec, bool of_the_scene) {
  const bool mpm = std::any_of(spec.methods.begin(), spec.methods.end(),
                               [](const std::string& method) { return panel(method).particles; });
  const std::string particles =
      mpm ? fmt::format("particles at ξ = {} of each cell; ", particles_label(spec.particles)) : "";
  std::vector<std::string> notes;
  std::string courant = "Courant number";
  if (spec.courants.empty()) courant += fmt::format(" {:g}", spec.courant);
  for (const auto& [method, number] : spec.courants)
    courant += fmt::format("{} {:g} ({})", courant.ends_with("r") ? "" : ",", number, name_of_method(method));
  const bool several = c.bars.size() > 1;
  const std::string bars =
      !several ? words_of(c.first())
      : std::all_of(c.bars.begin(), c.bars.end(), [&](const BarSpec& b) { return same(b, c.first()); })
          ? "each bar " + words_of(c.first())
          : "";
  notes.push_back(fmt::format("{} cells{}; {}; {}{} displacements{}{}", spec.cells, several ? " in the first bar" : "",
                              courant, particles, c.convected ? "finite" : "infinitesimal", bars.empty() ? "" : "; ",
                              bars));
  if (bars.empty()) {
    for (std::size_t b = 0; b < c.bars.size(); ++b)
      notes.push_back(fmt::format("bar {}: {}", b + 1, words_of(c.bars[b])));
  }
  std::string velocities;
  for (std::size_t b = 0; b < c.bars.size(); ++b) {
    if (!c.bars[b].velocity.empty())
      velocities += fmt::format("{}{:g}", velocities.empty() ? "" : ", ", velocity_of(c, b));
  }
  if (!velocities.empty())
    notes.push_back(fmt::format(
        "Velocities at the start {}.{}", velocities,
        !mpm || !c.from_contact || of_the_scene
            ? ""
            : " Each method's times count from its own contact: MPM's bars touch as soon as they share a node."));
  if (c.viscosity) {
    notes.push_back("Artificial viscosity " + words_of(viscosity_of(c)));
  }
  if (!c.paper_figures.empty() && !spec.choices.empty()) notes.push_back("Reconstructed parameters: " + spec.choices);
  if (!c.paper_figures.empty() && spec.choices.empty())
    notes.push_back("The times are our choice, to show what the paper describes.");
  return notes;
}

reports::Figure bar_figure(const Case& c, const FigureSpec& spec, std::vector<std::string> notes) {
  reports::Figure figure;
  figure.id = spec.id;
  figure.title = title_of(c, spec);
  figure.notes = std::move(notes);
  return figure;
}

void fit_x(reports::Figure& figure) {
  bool any = false;
  for (const auto& panel : figure.panels) {
    for (const auto& series : panel.series) {
      for (const double x : series.curve.x) {
        if (!std::isfinite(x)) continue;
        figure.x_min = any ? std::min(figure.x_min, x) : x;
        figure.x_max = any ? std::max(figure.x_max, x) : x;
        any = true;
      }
    }
  }
  const double room = 0.02 * (figure.x_max - figure.x_min);
  figure.x_min -= room;
  figure.x_max += room;
}

}  // namespace diptych::runner
