// What acts on the plate from outside: tractions on the nodes of its sides, and the body force on its particles.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "hinge/scene/plate.hpp"
#include "hinge/step/stepping.hpp"
#include "mpm/plate_grid.hpp"
#include "mpm/plate_particles.hpp"

namespace diptych::mpm {

class Loads {
 public:
  Loads(const Plate& plate, Grid& grid, const Supports& supports, const Places& places)
      : plate_(plate), grid_(grid), supports_(supports), places_(places) {
    nodal_forces_.reserve(8 * (grid.nx + grid.ny));
    if (plate.body_force) body_.resize(grid.storage());
  }

  /// Eqs. 17a and 20: adds their accelerations to the grid's.
  template <class Particles>
  void apply(const Kick& kick, const Particles& particles) {
    find_tractions(kick);
    for (const NodalForce& f : nodal_forces_) {
      grid_.acceleration.x[f.node] += f.force[0] / f.mass;
      grid_.acceleration.y[f.node] += f.force[1] / f.mass;
    }
    if (plate_.body_force) add_body_force((kick.from + kick.to) / 2, particles);
  }

  bool has_body_force() const { return !body_.x.empty(); }
  double work_rate(const VectorField& velocity) const;  ///< of loads and of what drives sides [W/m]
  double impulse_rate() const;                          ///< of loads, x and y together [N/m]
  std::size_t bytes() const { return body_.bytes() + nodal_forces_.capacity() * sizeof(NodalForce); }

 private:
  /// A traction's force on a node.
  struct NodalForce {
    std::size_t node;
    double mass;
    Vector force;
  };

  void find_tractions(const Kick&);

  template <class Particles>
  void add_body_force(double time, const Particles& particles) {  // the function is asked in one thread only
    for (auto* b : {&body_.x, &body_.y}) std::fill(b->begin(), b->end(), 0.0);
    for (std::size_t j = 0; j < particles.rows(); ++j) {
      particles.visit_row(j, [&](const Place& at) {
        const Vector x = particles.position(at), b = plate_.body_force(x[0], x[1], time);
        for (std::size_t c = 0; c < 2; ++c) {
          double* nodal = (c == 0 ? body_.x : body_.y).data() + at.node;
          const double force = particles.state().mass * b[c];
          nodal[0] += at.bottom * (at.left * force);
          nodal[1] += at.bottom * (at.right * force);
          nodal[at.next_row] += at.top * (at.left * force);
          nodal[at.next_row + 1] += at.top * (at.right * force);
        }
      });
    }
    for (std::size_t j = 0; j <= grid_.ny; ++j) {
      for (std::size_t i = 0; i <= grid_.nx; ++i) {
        const std::size_t node = grid_.row(j) + i;
        const double m = grid_.mass_of(i, j);
        if (m > 0) {
          grid_.acceleration.x[node] += body_.x[node] / m;
          grid_.acceleration.y[node] += body_.y[node] / m;
        }
      }
    }
  }

  const Plate& plate_;
  Grid& grid_;
  const Supports& supports_;
  const Places& places_;
  VectorField body_;                      // forces on nodes, only with a body force
  std::vector<NodalForce> nodal_forces_;  // of the current step
};

}  // namespace diptych::mpm
