#include "mpm/plate_loads.hpp"

namespace diptych::mpm {

/// A node takes its part of the sides of the cells beside it as the particles divide them: half, where they stand
/// evenly. So uniform stress is in equilibrium with its tractions.
void Loads::find_tractions(const Kick& kick) {
  nodal_forces_.clear();
  for (const Side side : sides) {
    const Edge& edge_of_plate = plate_.edge(side);
    if (!edge_of_plate.normal_traction && !edge_of_plate.shear_traction) continue;
    const bool upright = across(side) == 0;
    const auto mean = [&](const auto& traction) { return traction ? traction(kick.from, kick.to) : 0.0; };
    const double normal = outward(side) * mean(edge_of_plate.normal_traction);
    const double shear = mean(edge_of_plate.shear_traction), h = upright ? grid_.hy : grid_.hx;
    supports_.for_nodes(side, [&](std::size_t i, std::size_t j) {
      const std::size_t k = upright ? j : i, last = grid_.ny;
      const bool begins = upright ? k == 0 : grid_.ends_left(k);
      const bool ends = upright ? k == last : grid_.ends_right(k);
      const double length = begins ? h * places_.near() : ends ? h * places_.far() : h;
      nodal_forces_.push_back(
          {grid_.row(j) + i, grid_.mass_of(i, j),
           upright ? Vector{length * normal, length * shear} : Vector{length * shear, length * normal}});
    });
  }
}

double Loads::work_rate(const VectorField& velocity) const {
  double total = 0;
  for (const NodalForce& f : nodal_forces_) total += f.force[0] * velocity.x[f.node] + f.force[1] * velocity.y[f.node];
  for (std::size_t i = 0; i < body_.x.size(); ++i) total += body_.x[i] * velocity.x[i] + body_.y[i] * velocity.y[i];
  for (const auto& d : supports_.driven()) {
    const std::size_t node = grid_.row(d.j) + d.i;
    total += d.reaction[0] * velocity.x[node] + d.reaction[1] * velocity.y[node];
  }
  return total;
}

double Loads::impulse_rate() const {
  double total = 0;
  for (const NodalForce& f : nodal_forces_) total += f.force[0] + f.force[1];
  for (std::size_t i = 0; i < body_.x.size(); ++i) total += body_.x[i] + body_.y[i];
  return total;
}

}  // namespace diptych::mpm
