// The material point method in two dimensions: 4-node cells (eq. 7), lumped mass, USF, USL and MUSL.
#pragma once

#include <optional>
#include <vector>

#include "diffusion/damage_evolution.hpp"
#include "material/plate.hpp"
#include "material/scene.hpp"
#include "mpm/bar.hpp"

namespace diptych::mpm {

/// Largest stable step of a plate whose particles stand in every cell at positions × positions (natural coordinates in
/// [0, 1]) [s]. It holds for free sides too. A plate whose particles move is given the least limit over arrangements that
/// it may pass through.
double critical_time_step(const Plate&, const Cells&, const std::vector<double>& positions, Scheme);

/// Runs the plate. `evolution` is needed with TensileDamage, and only then.
/// Throws std::invalid_argument for a scene that MPM cannot take.
PlateRecord run(const Plate&, const Cells&, const std::vector<double>& positions, Scheme,
                const std::optional<diffusion::Evolution>& evolution, const Stepping&);

}  // namespace diptych::mpm
