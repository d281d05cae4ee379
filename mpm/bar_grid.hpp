// The background grid of bars: what its nodes know, and the forces that loads put on them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hinge/scene/scene.hpp"

namespace diptych::mpm::bars {

/// All that the grid knows of a node, in one record.
struct Node {
  double mass = 0, velocity = 0, force = 0, acceleration = 0;
};

/// Contributions of one cell's particles to its left and right node.
struct Pair {
  double left = 0, right = 0;
  Pair operator+(const Pair& o) const { return {left + o.left, right + o.right}; }
};

/// A traction's force on a node.
struct NodalForce {
  std::size_t node;
  double force;
};

struct Grid {
  explicit Grid(const Scene& bars) : scene(bars) {}

  /// Particles reach nodes first to last from now on: those that they have left know of nothing any more.
  void reach(std::size_t first, std::size_t last) {
    for (std::size_t i = first_; i < node.size() && i <= last_; ++i) {
      if (i >= first && i <= last) continue;
      node[i] = {};
      if (!body_force.empty()) body_force[i] = 0;
    }
    first_ = first;
    last_ = last;
  }
  std::span<Node> reached() { return std::span(node).subspan(first_, last_ - first_ + 1); }
  std::span<const Node> reached() const { return std::span(node).subspan(first_, last_ - first_ + 1); }

  void hold_supports() {
    if (scene.left == Support::fixed) node.front().velocity = node.front().acceleration = 0;
    if (scene.right == Support::fixed) node.back().velocity = node.back().acceleration = 0;
  }

  void integrate_momentum(double kick) {  // eq. 18
    for (Node& at : reached()) {
      at.acceleration = at.mass > 0 ? at.force / at.mass : 0;
      at.velocity += kick * at.acceleration;
    }
    hold_supports();
  }

  /// Of the loads, with the nodes' velocities or others [W].
  double work_rate() const {
    return work_rate([&](std::size_t i) { return node[i].velocity; });
  }
  template <class Velocity>
  double work_rate(Velocity&& velocity) const {
    double sum = 0;
    for (const NodalForce& f : traction) sum += f.force * velocity(f.node);
    for (std::size_t i = 0; i < body_force.size(); ++i) sum += body_force[i] * velocity(i);
    return sum;
  }

  /// Loads plus reactions [N]: a support takes up whatever force stands at its node.
  double impulse_rate() const {
    double sum = 0;
    for (const NodalForce& f : traction) sum += f.force;
    for (const double b : body_force) sum += b;
    if (scene.left == Support::fixed) sum -= node.front().force;
    if (scene.right == Support::fixed) sum -= node.back().force;
    return sum;
  }

  /// Of all forces, internal ones too [W].
  double power() const {
    double sum = 0;
    for (const Node& at : reached()) sum += at.force * at.velocity;
    return sum;
  }

  const Scene& scene;
  std::vector<Node> node;
  std::vector<NodalForce> traction;  ///< of the current step
  std::vector<double> body_force;    ///< per node, only with a body force

 private:
  std::size_t first_ = 0, last_ = 0;  // nodes that particles reach
};

}  // namespace diptych::mpm::bars
