#include "runner/trade/bench_scenes.hpp"

#include <cmath>

namespace diptych::runner {
namespace {

constexpr material::PlaneElastic rock{50e9, 0.3, 2500, material::Plane::strain};  // of the paper's plate

Plate waves(PlateSolid solid) {
  Plate plate;
  plate.width = 1;
  plate.height = 1.5;
  plate.solid = std::move(solid);
  plate.initial_velocity = [](double x, double y) {
    return Vector{std::cos(3 * x) * std::sin(2 * y), -std::sin(3 * x) * std::cos(2 * y)};
  };
  return plate;
}

/// Every cell is strained beyond the critical state and cracks on: the strain is not the same everywhere.
Plate cracking(const std::optional<diffusion::Diffusion>& spreads) {
  solid::Cracking solid{{rock}};
  solid.evolution.diffusion = spreads;
  Plate plate = waves(solid);
  plate.initial_displacement = [](double x, double y) { return Vector{0.005 * x * (1 + 0.1 * y), 0.005 * y}; };
  for (const Side side : {Side::left, Side::bottom}) plate.edge(side).support = Edge::Support::roller;
  for (const Side side : {Side::right, Side::top}) plate.edge(side).support = Edge::Support::fixed;
  return plate;
}

Plate spreading() {
  diffusion::Diffusion spreads;  // the paper's plate has a weak corner; here the source is in every cell
  spreads.source = diffusion::Source::everywhere;
  return cracking(spreads);
}

/// Glass that has been compressed and has failed everywhere.
Plate failing(const Cells& cells) {
  solid::Failing solid{{{70e9, 0.22, 2500, material::Plane::strain}, 0, 0.8}};
  const double h = 1.0 / cells.x;
  solid.spread.diffusivity = 0.1 * h * 5000;  // some parts of a step, as in a shock's strip
  solid.spread.start.assign(static_cast<std::size_t>(cells.x + 1) * static_cast<std::size_t>(cells.y + 1), 1e-4);
  for (std::size_t k = 0; k < solid.spread.start.size(); ++k)
    solid.spread.start[k] *= 1 + 1e-3 * static_cast<double>(k % 7);
  Plate plate = waves(solid);
  plate.initial_displacement = [](double x, double) { return Vector{-0.01 * x, 0}; };
  for (const Side side : sides) plate.edge(side).support = Edge::Support::roller;
  return plate;
}

/// Particles that cross cells.
Plate crossing() {
  Plate plate = waves(solid::Elastic{rock});
  plate.convected = true;
  plate.initial_velocity = [](double x, double y) { return Vector{100 + std::sin(3 * y), 50 + std::sin(2 * x)}; };
  return plate;
}

Scene flying_bar() {
  Scene scene;
  scene.convected = true;
  scene.bars[0].length = 1;
  scene.bars[0].material = material::Elastic{50e9, 2500};
  scene.bars[0].initial_velocity = [](double x) { return 100 + std::sin(3 * x); };
  return scene;
}

}  // namespace

const std::vector<BenchScene>& bench_scenes() {
  static const std::vector<BenchScene> scenes{
      {"elastic", "waves in an elastic plate", [](const Cells&) { return waves(solid::Elastic{rock}); }},
      {"damage", "every cell cracks by eq. 23a", [](const Cells&) { return cracking({}); }},
      {"diffusion", "every cell cracks, and C diffuses in parts of the step", [](const Cells&) { return spreading(); }},
      {"failure", "glass that has failed everywhere", failing},
      {"crossing", "particles of a plate cross cells", [](const Cells&) { return crossing(); }, {}, true},
      {"bar", "a bar in flight", {}, flying_bar},
  };
  return scenes;
}

}  // namespace diptych::runner
