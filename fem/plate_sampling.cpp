#include "fem/plate_sampling.hpp"

#include <array>

namespace diptych::fem {

PlateSnapshot sample_mesh(const Mesh& mesh, const CellStress& cell_stress, long n, double dt) {
  PlateSnapshot s;
  const Index nx = mesh.nx, ny = mesh.ny;
  const CellSize h = mesh.h;
  s.step = n;
  s.time = s.displacement.time = s.stress.time = static_cast<double>(n) * dt;
  s.velocity.time = n == 0 ? 0 : s.time - dt / 2;
  const auto nodes_of = [&](const Nodes& nodes, auto x_of, auto y_of, bool middle) {
    for (Index j = 0; j < nodes.up; ++j) {
      for (Index i = 0; i < nodes.across; ++i) {
        const double sides_of = (i == 0 || i == nx ? 0.5 : 1) * (j == 0 || j == ny ? 0.5 : 1);
        for (PointField* f : {&s.displacement, &s.velocity}) {
          f->x.push_back(x_of(i));
          f->y.push_back(y_of(j));
          f->weight.push_back(h.x * h.y * (middle ? 1 : 2 * sides_of) / 3);
        }
        for (const Index c : {Index{0}, Index{1}}) {
          s.displacement.component[c].push_back(nodes.u[j * nodes.across + i][c]);
          s.velocity.component[c].push_back(nodes.v[j * nodes.across + i][c]);
        }
      }
    }
  };
  s.displacement.component.resize(2);
  s.velocity.component.resize(2);
  s.stress.component.resize(3);
  nodes_of(
      mesh.corners, [&](Index i) { return mesh.corner_x(i); }, [&](Index j) { return mesh.corner_y(j); }, false);
  nodes_of(
      mesh.middles, [&](Index i) { return mesh.middle_x(i); }, [&](Index j) { return mesh.middle_y(j); }, true);
  const std::array<Vector, 4> towards{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};  // where a triangle lies in its cell
  mesh.for_cells([&](CellAt at) {
    const Triangles stress = cell_stress.of(mesh, at);
    const double x = mesh.middle_x(at.cell - at.row * nx), y = mesh.middle_y(at.row);
    for (Index t = 0; t < 4; ++t) {
      s.stress.x.push_back(x + towards[t][0] * h.x / 3);
      s.stress.y.push_back(y + towards[t][1] * h.y / 3);
      s.stress.weight.push_back(h.triangle_area());
      s.stress.component[0].push_back(stress[t].xx);
      s.stress.component[1].push_back(stress[t].yy);
      s.stress.component[2].push_back(stress[t].xy);
    }
  });
  return s;
}

material::Tensor mean_stress(const Mesh& mesh, const CellStress& cell_stress, CellAt at) {
  const auto [bottom, right, top, left] = cell_stress.of(mesh, at);
  return ((right + left) + (bottom + top)) * 0.25;
}

}  // namespace diptych::fem
