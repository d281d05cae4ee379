// What is read off the plate: fields at an instant, and gauges at every step.
#pragma once

#include <cstddef>
#include <vector>

#include "hinge/scene/plate.hpp"
#include "hinge/solid/plane_model.hpp"
#include "mpm/plate_kernels.hpp"
#include "mpm/plate_particles.hpp"

namespace diptych::mpm {

/// Cells of the plate across and up, and where the particles started in each.
struct Lattice {
  std::size_t nx, ny;
  double hx, hy;  ///< [m]
  const Places& places;

  template <class F>
  void for_cells(F&& f) const {
    for (std::size_t j = 0; j < ny; ++j) {
      for (std::size_t i = 0; i < nx; ++i) f(i, j);
    }
  }
  /// Where the k-th particle of a cell started.
  Vector start(std::size_t i, std::size_t j, std::size_t k) const {
    return {(static_cast<double>(i) + (0.5 + places.offset[k % places.count()])) * hx,
            (static_cast<double>(j) + (0.5 + places.offset[k / places.count()])) * hy};
  }
};

/// Fields of the particles in the order of their cells, each cell's row by row, and of the cells. Times are the
/// caller's to set.
template <class Particles, solid::PlaneModel Model>
PlateSnapshot sample_particles(const Lattice& lattice, const Particles& particles, const Model& model) {
  PlateSnapshot s;
  const std::size_t count = particles.count(), per_cell = particles.per_cell();
  PointField points;
  points.weight.assign(count, lattice.hx * lattice.hy / static_cast<double>(per_cell));
  std::vector<std::size_t> number;
  lattice.for_cells([&](std::size_t i, std::size_t j) {
    for (std::size_t k = 0; k < per_cell; ++k) {
      const Vector x = lattice.start(i, j, k);
      points.x.push_back(x[0]);
      points.y.push_back(x[1]);
      number.push_back(particles.index(i, j, k));
    }
  });
  const auto in_cell_order = [&](const std::vector<double>& values) {
    std::vector<double> ordered;
    ordered.reserve(count);
    for (const std::size_t p : number) ordered.push_back(values[p]);
    return ordered;
  };
  s.displacement = s.velocity = s.stress = points;
  const State& state = particles.state();
  s.displacement.component = {in_cell_order(state.displacement.x), in_cell_order(state.displacement.y)};
  s.velocity.component = {in_cell_order(state.velocity.x), in_cell_order(state.velocity.y)};
  s.stress.component.resize(3);
  for (std::size_t q = 0; q < count; ++q) {
    const std::size_t p = number[q];
    const material::Tensor stress = model.standing(state.strain[p], q / per_cell, p);
    s.stress.component[0].push_back(stress.xx);
    s.stress.component[1].push_back(stress.yy);
    s.stress.component[2].push_back(stress.xy);
  }
  const solid::Fields fields = model.fields();
  lattice.for_cells([&](std::size_t i, std::size_t j) {
    const material::Tensor mean = particles.mean_strain(i, j);
    s.volumetric_strain.push_back(model.volumetric(mean));
    if (!fields.crack_density.empty()) s.strain.push_back(mean);
  });
  s.take(fields);
  return s;
}

/// Of a cell's particles, from the outside in [Pa].
template <class Particles, solid::PlaneModel Model>
material::Tensor mean_stress(const Lattice& lattice, const Particles& particles, const Model& model, std::size_t i,
                             std::size_t j) {
  const std::size_t along = lattice.places.count();
  const auto mean = [&](double material::Tensor::*component) {
    const double sum = pair_sum<0>(along, [&](std::size_t b) {
      return pair_sum<0>(along, [&](std::size_t a) {
        const std::size_t p = particles.index(i, j, b * along + a);
        return model.standing(particles.state().strain[p], j * lattice.nx + i, p).*component;
      });
    });
    return sum / static_cast<double>(along * along);
  };
  return {mean(&material::Tensor::xx), mean(&material::Tensor::yy), mean(&material::Tensor::xy)};
}

}  // namespace diptych::mpm
