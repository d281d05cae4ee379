// What the boundary layer of eq. 16 does to the stress it is meant to bring in.
#pragma once

#include <vector>

namespace diptych::analytic {

/// Stress of the last cell divided by the traction once the end is at rest or in uniform motion. Equilibrium of the end
/// node: that cell's stress is the part of the traction that the layer's particles hand to the end node, i.e. the sum
/// over the particles of the last cell of (part of the layer that the particle fills) × N_end(ξ_p).
/// distances: of the end cell's equal-mass particles from the end, in cells, each in [0, 1], nearest first;
/// thickness: of the layer, in cells, > 0. One centred particle and a layer of one cell: ½, an error of 50 %.
double end_stress_share(const std::vector<double>& distances, double thickness);

}  // namespace diptych::analytic
