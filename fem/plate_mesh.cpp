#include "fem/plate_mesh.hpp"

#include "hinge/scene/plate_check.hpp"

namespace diptych::fem {
namespace {

// Half of the mass of a node on the face is the flyer's.
void strike(Mesh& mesh, const Plate& plate) {
  const Index face = impact_column(plate, {static_cast<int>(mesh.nx), static_cast<int>(mesh.ny)});
  const double v = plate.impact->velocity;
  for (Index j = 0; j <= mesh.ny; ++j) {
    for (Index i = 0; i <= face; ++i) mesh.corners.v.x[j * (mesh.nx + 1) + i] = i < face ? v : v / 2;
  }
  for (Index j = 0; j < mesh.ny; ++j) {
    for (Index i = 0; i < face; ++i) mesh.middles.v.x[j * mesh.nx + i] = v;
  }
}

}  // namespace

Mesh::Mesh(const Plate& plate, const Cells& cells)
    : width(plate.width),
      height(plate.height),
      density(elastic(plate).density),
      nx(static_cast<Index>(cells.x)),
      ny(static_cast<Index>(cells.y)),
      h{plate.width / cells.x, plate.height / cells.y},
      cell_mass(elastic(plate).density * h.x * h.y),
      corners(nx + 1, ny + 1),
      middles(nx, ny) {
  if (plate.body_force) {
    corners.body = Components((nx + 1) * (ny + 1));
    middles.body = Components(nx * ny);
  }
  for_nodes([&](Nodes& nodes, Index k, double x, double y) {
    if (plate.initial_displacement) nodes.u.set(k, plate.initial_displacement(x, y));
    if (plate.initial_velocity) nodes.v.set(k, plate.initial_velocity(x, y));
  });
  if (plate.impact) strike(*this, plate);
}

Motion Mesh::motion() const {
  Motion sum;
  for (Index j = 0; j <= ny; ++j) sum.add(motion(j));
  return sum;
}

Motion Mesh::motion(Index j) const {
  const auto of = [](const Components& v, Index begin, Index end, double mass) {
    Motion sum;
    for (Index k = begin; k < end; ++k) {
      sum.kinetic += v.x[k] * v.x[k] + v.y[k] * v.y[k];
      sum.momentum[0] += v.x[k];
      sum.momentum[1] += v.y[k];
    }
    return Motion{mass * sum.kinetic / 2, {mass * sum.momentum[0], mass * sum.momentum[1]}};
  };
  const double mass = cell_mass * (j == 0 || j == ny ? 1 : 2) / 3;
  const Index begin = j * (nx + 1), end = begin + nx + 1;
  Motion row = of(corners.v, begin + 1, end - 1, mass);
  row.add(of(corners.v, begin, begin + 1, mass / 2));
  row.add(of(corners.v, end - 1, end, mass / 2));
  if (j < ny) row.add(of(middles.v, j * nx, (j + 1) * nx, cell_mass / 3));
  return row;
}

}  // namespace diptych::fem
