// Diffusion without mechanics, on the nodes of a plate's cells.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "hinge/diffusion/concentration.hpp"
#include "hinge/diffusion/dilatancy.hpp"
#include "hinge/scene/plate.hpp"
#include "hinge/scene/scene.hpp"

namespace diptych::runner {

struct DiffusionScene {
  double width = 0, height = 0;                              ///< L_x, L_y [m]
  std::function<double(double x, double y)> diffusivity;     ///< d [m²/s]
  std::function<double(double x, double y, double t)> rate;  ///< Q [units of C per s]; empty: none
  std::function<double(double x, double y)> initial;         ///< C at the start; empty: none
  double corner_rate = 0;  ///< of a source at the origin's node, of the quarter plane [units of C · m²/s]
  diffusion::Scheme scheme = diffusion::Scheme::forward_euler;
  diffusion::Reading reading = diffusion::Reading::isotropic;
  /// Instead of all these: a dilatancy of 1 held on the left side from the start spreads, the ceiling being 1
  /// everywhere.
  std::optional<diffusion::Spread> spread;
};

/// The largest diffusivity at the middles of cells [m²/s], and the first that is not ≥ 0, where there is one.
struct DiffusivityRange {
  double largest = 0;
  std::optional<double> wrong = {};
};
DiffusivityRange range_of(const DiffusionScene&, const diffusion::Grid&);

double node_area(const diffusion::Grid&, std::size_t node);  ///< of its control volume [m²]

/// Snapshots hold the values of nodes at whole steps, in `concentration`.
PlateRecord run_diffusion(const DiffusionScene&, const diffusion::Grid&, const Stepping&);

}  // namespace diptych::runner
