// A scene at rest but for small random motions of all its points.
#pragma once

#include "hinge/scene/plate.hpp"
#include "hinge/scene/scene.hpp"
#include "runner/diffusion_alone.hpp"

namespace diptych::runner {

/// In [−1, 1), the same for the same place and so for every run; no smooth function of it, so that every mode of every
/// mesh has a part in it.
double noise_at(double x, double y, unsigned which);

/// Speed of the random motions as a part of the wave speed, and so the strains that come of them: nothing yields,
/// cracks or meets at such strains, and the motions are those of the linear scene.
inline constexpr double seed = 1e-10;

/// The scene without its loads and without what sets it off: the velocities of its points are noise. Driven sides are
/// held; what was struck together moves as one.
Scene at_rest(const Scene&);
Plate at_rest(const Plate&);
/// Likewise: without sources, from a concentration of noise.
DiffusionScene at_rest(const DiffusionScene&);

}  // namespace diptych::runner
