#include "runner/trade/off_scenes.hpp"

#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>

#include "hinge/solid/arrays.hpp"

namespace diptych::runner {
namespace {

using Kind = reports::OffRow::Kind;

constexpr material::PlaneElastic stone{50e9, 0.3, 2500, material::Plane::strain};  // of the paper's plate
constexpr material::Elastic bar_of_stone{50e9, 2500};

/// Waves so weak that nothing cracks and nothing flows, with no node at rest.
Plate weak_waves(PlateSolid solid) {
  Plate plate;
  plate.width = 1;
  plate.height = 1.5;
  plate.solid = std::move(solid);
  plate.initial_velocity = [](double x, double y) {
    return Vector{std::cos(3 * x) * std::sin(2 * y), -std::sin(3 * x) * std::cos(2 * y)};
  };
  return plate;
}
Plate elastic_plate(const Cells&) { return weak_waves(solid::Elastic{stone}); }
Plate cracking_plate(const Cells&) { return weak_waves(solid::Cracking{{stone}}); }

Scene elastic_bar(int) {
  Scene scene;
  scene.bars[0].length = 1;
  scene.bars[0].material = bar_of_stone;
  scene.bars[0].initial_velocity = [](double x) { return 1 + std::sin(3 * x); };
  return scene;
}

template <class S>
S with_viscosity_of_nothing(S scene) {
  material::Viscosity bare;
  bare.c1 = bare.c2 = 0;
  scene.viscosity = bare;
  return scene;
}

/// A second bar, an eighth as long, beyond a gap that the motion of thousands of steps does not close: both move alike.
Scene bars_apart(int cells) {
  Scene scene = elastic_bar(cells);
  scene.bars.push_back(scene.bars[0]);
  scene.bars[1].begin = 1.125;
  scene.bars[1].length = 0.125;
  return scene;
}

Scene bar_far_from_yield(int cells) {
  Scene scene = elastic_bar(cells);
  scene.bars[0].material = material::Hardening{bar_of_stone.youngs_modulus, bar_of_stone.density, 1e9, 1e30};
  return scene;
}

Plate plate_far_from_yield(const Cells&) {
  solid::Cracking solid{{stone}};
  solid.compression = material::Compression{1e30, 0};
  return weak_waves(solid);
}

Plate with_idle_diffusion(const Cells&) {
  solid::Cracking solid{{stone}};
  solid.evolution.diffusion.emplace();
  return weak_waves(solid);
}

Plate with_one_gauge(const Cells& cells) {
  Plate plate = elastic_plate(cells);
  plate.gauges = {{0.3, 0.4}};
  return plate;
}

}  // namespace

const std::vector<OffPair>& off_pairs() {
  const auto viscous_plate = [](const Cells& cells) { return with_viscosity_of_nothing(elastic_plate(cells)); };
  const auto viscous_bar = [](int cells) { return with_viscosity_of_nothing(elastic_bar(cells)); };
  static const std::vector<OffPair> pairs{
      {"viscosity", "of coefficients that are zero, beside none", Kind::zero, elastic_plate, viscous_plate, elastic_bar,
       viscous_bar},
      {"damage", "a solid that can crack and does not, beside an elastic one", Kind::idle, elastic_plate,
       cracking_plate},
      {"diffusion", "of cracks that do not come, beside cracks that do not diffuse", Kind::idle, cracking_plate,
       with_idle_diffusion},
      {"plasticity", "a yield far above, beside an elastic bar and a plate that can crack", Kind::idle, cracking_plate,
       plate_far_from_yield, elastic_bar, bar_far_from_yield},
      {"contact",
       "of bars that do not meet, beside one bar; time and bytes a point",
       Kind::idle,
       {},
       {},
       elastic_bar,
       bars_apart},
      {"books", "energies and momentum of every step, beside none", Kind::books, elastic_plate, elastic_plate,
       elastic_bar, elastic_bar},
      {"gauges", "one that reads every step, beside none", Kind::idle, elastic_plate, with_one_gauge},
  };
  return pairs;
}

double least_bytes(const Panel& row, const BarMesh& mesh) {
  constexpr double number = sizeof(double);
  const double cells = mesh.cells, nodes = cells + 1;
  if (!row.particles) return number * (cells + 4 * nodes);  // σ; m, f, v, u
  const double points = cells * static_cast<double>(mesh.particles.size());
  return number * (4 * points + 4 * nodes + nodes);  // η, σ, v, u; m, v, f, a; where a cell's particles begin
}

double least_bytes(const Panel& row, const PlateMesh& mesh, const PlateSolid& solid) {
  constexpr double number = sizeof(double);
  const std::size_t cells = mesh.grid.cells(), places = mesh.particles.size() * mesh.particles.size();
  const auto of = [](std::size_t arrays, std::size_t count) {
    return number * static_cast<double>(arrays * off_cycles(count));
  };
  const auto of_cells = [&](std::size_t numbers, std::size_t flags) {
    return static_cast<double>(cells) * (number * static_cast<double>(numbers) + static_cast<double>(flags));
  };
  double sum = 0;
  if (std::holds_alternative<solid::Cracking>(solid)) {
    // ε_v, C_d handed out, kept and in the stiffness, K and G where open and closed, whether critical.
    sum += of_cells(4 + 6, 1);
    if (!row.particles) sum += of(4 * 3, cells) + of_cells(0, 1);  // σ of triangles, and whether a cell has its own
  }
  if (!row.particles) return sum + of_cells(4, 0) + 4 * number * static_cast<double>(mesh.grid.nodes());  // u, v
  const auto nx = static_cast<std::size_t>(mesh.grid.nx), ny = static_cast<std::size_t>(mesh.grid.ny);
  // v, u, ε of particles; v and a of nodes, and with USL the grid's own new v as well.
  const bool own = row.bar_theory == analytic::Scheme::mpm_usl;
  return sum + of(7, off_pages(nx, places) * ny * places) + of(own ? 6 : 4, off_pages(nx + 1, 4) * (ny + 1));
}

double rim_bytes(const PlateMesh& mesh) { return 80.0 * sizeof(double) * (mesh.grid.nx + mesh.grid.ny); }

}  // namespace diptych::runner
