#include "analytic/grid_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace diptych::analytic {
namespace {

/// The next time after t at which a particle stands on a face, moving on; faces are where x/h is whole.
double next_face(double at, double velocity, double cell, double t) {
  if (velocity == 0) return std::numeric_limits<double>::infinity();
  const double faces = (at + velocity * t) / cell, slack = 1e-9;  // a particle on a face has crossed it
  const double next = velocity > 0 ? std::floor(faces + slack) + 1 : std::ceil(faces - slack) - 1;
  return (next * cell - at) / velocity;
}

/// The cell just behind a face that a particle has reached counts as left.
double cell_at(double at, double velocity, double cell, double t) {
  const double faces = (at + velocity * t) / cell, slack = 1e-9;
  return velocity < 0 ? std::ceil(faces - slack) - 1 : std::floor(faces + slack);
}

}  // namespace

double grid_contact_time(const Approach& a) {
  if (!(a.left < a.right)) throw std::invalid_argument("grid_contact_time: the left particle must stand on the left");
  if (!(a.cell > 0)) throw std::invalid_argument("grid_contact_time: the cell must be > 0");
  const double closing = a.left_velocity - a.right_velocity;
  double t = 0;
  const auto near = [&] {
    return cell_at(a.right, a.right_velocity, a.cell, t) - cell_at(a.left, a.left_velocity, a.cell, t) <= 1;
  };
  if (near()) return 0;
  if (!(closing > 0)) return std::numeric_limits<double>::infinity();
  // Nothing happens before they are 2h apart. Then either crosses a face within the time that closes the rest.
  t = std::max(0.0, (a.right - a.left - 2 * a.cell) / closing * (1 - 1e-12));
  while (!near()) {
    const double next =
        std::min(next_face(a.left, a.left_velocity, a.cell, t), next_face(a.right, a.right_velocity, a.cell, t));
    if (!(next > t) || !std::isfinite(next))
      throw std::domain_error("grid_contact_time: the faces that the particles cross are lost in round-off");
    t = next;
  }
  return t;
}

}  // namespace diptych::analytic
