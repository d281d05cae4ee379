// Up to which time step the settings of a case are stable, beside what theory says.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reports/stability_results.hpp"
#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"
#include "runner/stability/growth.hpp"

namespace diptych::runner {

struct StabilityPlan {
  std::vector<std::string> over;  ///< see with_values; no Courant numbers, which are what is sought
  long steps = 2000;              ///< of each look-ahead
  int threads = 1;                ///< for all settings together
  const std::atomic<bool>* cancelled = nullptr;
  std::function<void(std::size_t done, std::size_t total)> progress = {};
};

/// How small motions about rest grow at a Courant number (alone diffusing: at a diffusion number d Δt/h²). Throws
/// std::invalid_argument where the panel refuses the step. The case is the one that the leaf has: see case_of.
Growth growth_about_rest(const Case&, const Leaf&, double number, long steps);

/// What theory says of the limit about rest, or nothing. Bars of 16 cells or more, with a free end where it matters;
/// lagged viscosity after √(c1² + C0²) − c1. Plates: with free sides the eigenvalues of this very mesh up to 100 cells,
/// beyond that the lesser of 6 × 6 cells' and the unbounded lattice's; on rollers all round, with 16 cells or more each
/// way, the lattice's. Diffusion: forward Euler with one diffusivity.
std::optional<double> limit_about_rest(const Case&, const Leaf&);

/// The limit of every setting of the case and of what --over adds. Courant numbers of the case make no difference;
/// where no numbers of cells are asked for, the coarsest mesh of each block of axes, of 4 cells if it can be, stands
/// for all. Throws InputError for Courant numbers in `over`.
reports::StabilityMap stability_map(const Case&, const StabilityPlan&);

}  // namespace diptych::runner
