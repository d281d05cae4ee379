// What both solvers are given: bars in a row, how they are held, loaded and set off, and the steps to take.
//
// It lives beside the materials because fem/ and mpm/ may both include this folder and never each other.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "hinge/material/material.hpp"
#include "hinge/material/viscosity.hpp"

namespace diptych {

enum class End { left, right };
enum class Support { free, fixed };

/// How a traction reaches the grid: on the boundary node, or spread over the points of a boundary layer (eq. 16).
enum class Transfer { node, boundary_layer };

/// A traction on one of the two outer ends, tension positive: it pulls the end outwards.
struct Load {
  End end = End::right;
  /// Mean traction over [from, to], to > from [Pa]. The solvers ask for the mean over the interval of one kick,
  /// so a step or an impulse gives the bar its exact impulse wherever it falls between two steps.
  std::function<double(double from, double to)> mean_traction;
  Transfer transfer = Transfer::node;
  double layer_thickness = 0;  ///< h of eq. 16 [m]; > 0 for Transfer::boundary_layer
};

/// A bar of unit cross-section in uniaxial stress that starts on begin ≤ x ≤ begin + length. x is the coordinate of the
/// scene. An empty function is a feature that is off.
struct Bar {
  double begin = 0;   ///< [m]
  double length = 0;  ///< L [m]
  material::Material material;
  std::function<double(double x)> initial_velocity;  ///< [m/s]
  std::function<double(double x)> initial_stress;    ///< [Pa]

  double end() const { return begin + length; }
};

/// What FEM does where the ends of two bars meet. MPM has no choice: bars that share a node of the grid move as one.
enum class Contact {
  node_to_node,  ///< the ends push each other and part again
  bonded         ///< once they have met, they hold
};

/// Bars from left to right that may touch but not overlap.
struct Scene {
  std::vector<Bar> bars = std::vector<Bar>(1);
  Support left = Support::free;   ///< of the first bar's left end
  Support right = Support::free;  ///< of the last bar's right end
  std::vector<Load> loads;
  std::function<double(double x, double t)> body_force;  ///< specific body force b of eq. 2 [m/s²]
  std::optional<material::Viscosity> viscosity;          ///< artificial, eqs. 21 and 22
  bool convected = false;  ///< particles move and cross cells; false: infinitesimal displacements, they stay put
  Contact contact = Contact::node_to_node;

  double begin() const { return bars.front().begin; }
  double end() const { return bars.back().end(); }
};

/// How much of the energy and momentum ledger to keep. Off: nothing, and energies are looked at now and then, to tell
/// an instability. Sums: its largest entries. Lines: every step's line as well.
enum class Books { off, sums, lines };

/// The steps of one run. Times are multiples of time_step; the caller has checked it against critical_time_step.
struct Stepping {
  double time_step = 0;  ///< Δt [s]
  double limit = 0;      ///< the largest stable Δt, as far as it is known; 0: it is not [s]
  /// Largest part of what was put in that the scheme may add to it. None does where particles keep their places; at
  /// nine tenths of the wave speed the crossing of cells adds 1.7 %.
  double gains = 0.02;
  long steps = 0;                  ///< number of steps
  std::vector<long> sample_after;  ///< step counts after which fields are sampled, ascending, from 0 to steps + 1
  Books books = Books::sums;
  int threads = 1;                               ///< plates; the results are the same bits for any number
  const std::atomic<bool>* cancelled = nullptr;  ///< asked between steps; true stops the run
};

/// Elements or cells of a bar where the first bar has `cells`: the nearest whole number to the same size, at least one.
inline int cells_of(const Scene& scene, std::size_t bar, int cells) {
  if (bar == 0) return cells;
  return std::max(1, static_cast<int>(std::lround(scene.bars[bar].length / (scene.bars[0].length / cells))));
}

/// The laws of the scene's bars, of one type.
inline auto laws(const Scene& scene) {
  std::vector<material::Material> materials;
  for (const Bar& bar : scene.bars) materials.push_back(bar.material);
  return material::laws(materials);
}

/// The largest wave speed of all bars, c_max of eq. 21 [m/s].
inline double largest_wave_speed(const Scene& scene) {
  double largest = 0;
  for (const Bar& bar : scene.bars) largest = std::max(largest, material::wave_speed(bar.material));
  return largest;
}

/// Largest difference of the velocities that the bars start with, where the middles and ends of bars are looked at
/// [m/s].
inline double initial_velocity_jump(const Scene& scene) {
  double least = 0, most = 0;
  bool any = false;
  for (const Bar& bar : scene.bars) {
    for (const double x : {bar.begin, bar.begin + bar.length / 2, bar.end()}) {
      const double v = bar.initial_velocity ? bar.initial_velocity(x) : 0;
      least = any ? std::min(least, v) : v;
      most = any ? std::max(most, v) : v;
      any = true;
    }
  }
  return most - least;
}

/// Courant number of a bar up to which lagged viscosity is stable where the bar alone is up to `limit`:
/// C² s² + 2 ν/(c h) C s² ≤ 1 with the largest s² of the grid's waves, 1/limit².
inline double with_viscosity(double limit, double strength) {
  return std::sqrt(strength * strength + limit * limit) - strength;
}

}  // namespace diptych
