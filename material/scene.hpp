// What both solvers are given: one bar, how it is held, loaded and set off, and the steps to take.
//
// It lives beside the materials because fem/ and mpm/ may both include this folder and never each other.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

#include "material/material.hpp"

namespace diptych {

enum class End { left, right };
enum class Support { free, fixed };

/// How a traction reaches the grid: on the boundary node, or spread over the points of a boundary layer (eq. 16).
enum class Transfer { node, boundary_layer };

/// A traction on one end, tension positive: it pulls the end outwards.
struct Load {
  End end = End::right;
  /// Mean traction over [from, to], to > from [Pa]. The solvers ask for the mean over the interval of one kick,
  /// so a step or an impulse gives the bar its exact impulse wherever it falls between two steps.
  std::function<double(double from, double to)> mean_traction;
  Transfer transfer = Transfer::node;
  double layer_thickness = 0;  ///< h of eq. 16 [m]; > 0 for Transfer::boundary_layer
};

/// A bar of unit cross-section on 0 ≤ x ≤ length in uniaxial stress. An empty function is a feature that is off.
struct Scene {
  double length = 0;  ///< L [m]
  material::Material material;
  Support left = Support::free;
  Support right = Support::free;
  std::vector<Load> loads;
  std::function<double(double x, double t)> body_force;  ///< specific body force b of eq. 2 [m/s²]
  std::function<double(double x)> initial_velocity;      ///< [m/s]
  std::function<double(double x)> initial_stress;        ///< [Pa]
  bool convected = false;  ///< particles move and cross cells; false: infinitesimal displacements, they stay put
};

/// How much of the energy and momentum ledger to keep. Off: neither computed nor stored. Sums: its largest entries.
/// Lines: every step's line as well.
enum class Books { off, sums, lines };

/// The steps of one run. Times are multiples of time_step; the caller has checked it against critical_time_step.
struct Stepping {
  double time_step = 0;            ///< Δt [s]
  long steps = 0;                  ///< number of steps
  std::vector<long> sample_after;  ///< step counts after which fields are sampled, ascending, each ≤ steps
  Books books = Books::sums;
  const std::atomic<bool>* cancelled = nullptr;  ///< asked between steps; true stops the run
};

}  // namespace diptych
