// Contact between the end nodes of two bars, solved exactly within a step.
#pragma once

#include <algorithm>

#include "hinge/scene/scene.hpp"

namespace diptych::fem {

/// An end node as its neighbour meets it.
struct Face {
  double mass, force, velocity, displacement;
};

/// The right end of one bar and the left end of the next, equal and opposite forces between them.
///
/// The force is the one that brings the gap to nothing at the end of the step (forward increments: Carpenter, Taylor &
/// Katona, IJNME 32, 1991). What stops the approach is a perfectly plastic impact of the two end masses: it loses their
/// relative energy, of the order of the element size. Contact ends in the middle of the kick in which the opening wave
/// arrives, so that kick feels half of the pressure before it; and it ends when the pressure after it, 2p − p⁻ by that
/// reckoning, would have to pull. With this release (compare Hughes et al., CMAME 8, 1976) bars at Courant number 1
/// part with the exact velocities, and what the impact lost comes back. The pressure before a kick is that of the last
/// one, or, where a front arrived in that, less: what it left behind.
class Pair {
 public:
  Pair(std::size_t left, double gap, Contact contact) : left_(left), gap_at_start_(gap), contact_(contact) {}

  /// The force of this kick [N], pushing the faces apart where > 0. kick: its length; step: of the motion after it [s].
  double force(const Face& a, const Face& b, double kick, double step) {
    const double softness = 1 / a.mass + 1 / b.mass;
    const double gap = gap_at_start_ + (b.displacement - a.displacement), closing = a.velocity - b.velocity;
    const double carried = (a.force / a.mass - b.force / b.mass) / softness;  // what the bars press with
    const double stopping = (closing - gap / step) / (kick * softness);       // what takes their approach away
    const double needed = carried + stopping;
    opened_ = closed_ = false;
    force_ = needed;
    if (touching_) {
      const double half = std::max(0.0, std::min(pressure_, 2 * pressure_ - earlier_)) / 2;
      if (contact_ == Contact::node_to_node && needed < half) {
        force_ = half;
        touching_ = false;
        opened_ = true;
      }
    } else if (needed > 0) {
      touching_ = closed_ = true;
      const double predicted = gap - step * (closing + kick * softness * carried);  // without contact, after this step
      share_of_step_ = gap > predicted ? std::clamp(gap / (gap - predicted), 0.0, 1.0) : 0;
    } else {
      force_ = 0;
    }
    earlier_ = touching_ && !closed_ ? pressure_ : 0;
    pressure_ = touching_ ? std::max(carried, 0.0) : 0;
    if (earlier_ == 0) earlier_ = pressure_;  // nothing is known from before the impact
    return force_;
  }

  double force() const { return force_; }
  std::size_t left() const { return left_; }
  bool opened() const { return opened_; }  ///< in the last kick
  bool closed() const { return closed_; }
  double share_of_step() const { return share_of_step_; }  ///< after which the gap closed, in [0, 1]

 private:
  std::size_t left_;
  double gap_at_start_;
  Contact contact_;
  double force_ = 0, share_of_step_ = 0;
  double pressure_ = 0, earlier_ = 0;  // what the bars pressed with in the last kick and in the one before it
  bool touching_ = false, opened_ = false, closed_ = false;
};

}  // namespace diptych::fem
