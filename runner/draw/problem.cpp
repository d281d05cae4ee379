// The problem itself: a plate, its mesh, its supports and its loads. Of no run.
#include <fmt/core.h>

#include <exception>

#include "runner/draw/figure_kind.hpp"
#include "runner/draw/figure_runs.hpp"
#include "runner/input/plate_build.hpp"

namespace diptych::runner {
namespace {

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

void draw_problem(const Case& c, const FigureSpec& spec, reports::Case& result) {
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
  result.problem_figures.push_back(std::move(figure));
}

}  // namespace

FigureKind problem_kind() {
  return {.id = "problem",
          .scenes = FigureKind::Scenes::plates,
          .keys = {"cells"},
          .draws = FigureKind::Draws::what_there_is,
          .add = draw_problem};
}

}  // namespace diptych::runner
