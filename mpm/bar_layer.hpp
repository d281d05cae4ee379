// Boundary layers of bars: the particles under a loaded end that take up its traction together (eq. 16).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "mpm/bar_particles.hpp"

namespace diptych::mpm::bars {

struct LayerPoint {
  std::size_t particle;
  double share;  ///< M_p h⁻¹ of eq. 16 in lengths: the part of the layer that this particle fills
};

/// The layer under a load; empty where the load acts on the end node.
///
/// From the surface inwards, counted from the loaded end: a mirrored bar adds the same numbers in the same order.
template <class P>
std::vector<LayerPoint> boundary_layer(const Load& load, const P& particles) {
  std::vector<LayerPoint> layer;
  if (load.transfer != Transfer::boundary_layer) return layer;
  const std::size_t bar = load.end == End::left ? 0 : particles.member.size() - 1;
  const auto& member = particles.member[bar];
  for (std::size_t q = 0; q < member.last - member.first; ++q) {
    const double begin = particles.share_depth(bar, q), end = particles.share_depth(bar, q + 1);
    const double inside = std::min(end - begin, load.layer_thickness - begin);
    if (inside > 0)
      layer.push_back({load.end == End::left ? member.first + q : member.last - 1 - q, inside / load.layer_thickness});
  }
  return layer;
}

/// Adds the forces of a layer under this traction to those on the nodes.
template <class P>
void add_layer_force(const std::vector<LayerPoint>& layer, double traction, const P& particles,
                     std::vector<NodalForce>& forces) {
  for (const LayerPoint& point : layer) {
    const std::size_t cell = particles.cell_of(point.particle);
    const double force = traction * point.share;
    forces.push_back({cell, (0.5 - particles.offset[point.particle]) * force});
    forces.push_back({cell + 1, (0.5 + particles.offset[point.particle]) * force});
  }
}

}  // namespace diptych::mpm::bars
