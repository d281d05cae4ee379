#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fem/cell.hpp"
#include "fem/plate.hpp"
#include "hinge/step/eigenvalues.hpp"
#include "hinge/step/viscous_step.hpp"

namespace diptych::fem {
namespace {

/// Cells of a mesh each way beyond which its stiffest mode hardly changes: it lives within a few cells of the sides. A
/// larger mesh is made up of pieces of 6 to 11 cells each way. None of them is stiffer than 6 × 6 by more than 6e-6 of
/// the limit, found over Poisson's ratios from −0.9 to 0.499 and cells up to 1:30 (plane stress, ν = 0.49, 6 × 8).
constexpr int enough = 6;
constexpr double margin = 1e-5;

/// 2/ω of a mesh of this solid.
double limit(const material::PlaneElastic& solid, const CellSize& h, const Cells& cells) {
  const int nx = std::min(cells.x, enough), ny = std::min(cells.y, enough), corners = (nx + 1) * (ny + 1);
  const double cell_mass = solid.density * h.x * h.y;

  std::array<CellValues, 10> columns;  // of a cell's stiffness matrix: forces that answer to a motion of one node
  for (std::size_t k = 0; k < 10; ++k) {
    CellValues u{};
    u[k / 2][k % 2] = 1;
    Triangles stress = strains(u, h);
    for (material::Tensor& t : stress) t = solid.stiffness().stress(t);
    columns[k] = internal_forces(stress, h);
  }

  const auto freedoms = static_cast<std::size_t>(2 * (corners + nx * ny));
  material::SymmetricMatrix dynamic(freedoms);  // K, then M^-½ K M^-½
  std::vector<double> mass(freedoms);
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const int a = j * (nx + 1) + i, d = a + nx + 1;
      const std::array<int, 5> node{a, a + 1, d + 1, d, corners + j * nx + i};
      const auto place = [&](std::size_t k) { return 2 * static_cast<std::size_t>(node[k / 2]) + k % 2; };
      for (std::size_t k = 0; k < 10; ++k) {
        for (std::size_t l = 0; l < 10; ++l) dynamic(place(l), place(k)) -= columns[k][l / 2][l % 2];
        mass[place(k)] += cell_mass / (k < 8 ? 6 : 3);
      }
    }
  }
  for (std::size_t k = 0; k < freedoms; ++k) {
    for (std::size_t l = 0; l < freedoms; ++l) dynamic(k, l) *= 1 / std::sqrt(mass[k]) * (1 / std::sqrt(mass[l]));
  }
  const bool larger = cells.x > enough || cells.y > enough;
  return (larger ? 1 - margin : 1) * 2 / std::sqrt(material::largest_eigenvalue(dynamic));
}

}  // namespace

double critical_time_step(const Plate& plate, const Cells& cells) {
  const CellSize h{plate.width / cells.x, plate.height / cells.y};
  return material::plate_time_step(plate, h.x * h.y,
                                   [&](const material::PlaneElastic& solid) { return limit(solid, h, cells); });
}

}  // namespace diptych::fem
