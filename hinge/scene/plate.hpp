// What both solvers are given in two dimensions: a rectangle, how its sides are held and loaded, and how it starts.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hinge/material/plane.hpp"
#include "hinge/material/viscosity.hpp"
#include "hinge/solid/plane_model.hpp"
#include "hinge/solid/plate_solid.hpp"
#include "hinge/step/record.hpp"

namespace diptych {

using Vector = std::array<double, 2>;  ///< x and y

enum class Side { left, right, bottom, top };
inline constexpr std::array sides{Side::left, Side::right, Side::bottom, Side::top};

/// The component of a vector across a side, 0 or 1, and the sign of the outward normal.
constexpr std::size_t across(Side side) { return side == Side::left || side == Side::right ? 0 : 1; }
constexpr double outward(Side side) { return side == Side::left || side == Side::bottom ? -1 : 1; }

/// One side of a plate. An empty function is a feature that is off.
struct Edge {
  enum class Support {
    free,
    roller,  ///< no motion across the side, free along it
    fixed,   ///< no motion
    driven,  ///< moves with the given velocity
    platen   ///< a rigid frictionless one: equal motion across the side, free along it; top or bottom, left or right
  };
  Support support = Support::free;
  /// Mean traction over [from, to], to > from [Pa], along the outward normal (tension positive) and along the side
  /// (towards larger coordinates). On a platen the first one, times the side's length, is the total load.
  std::function<double(double from, double to)> normal_traction, shear_traction;
  std::function<Vector(double x, double y, double t)> velocity;  ///< of a driven side [m/s]
};

/// A flyer strikes the rest of the plate. Left of x = face everything moves to the right at the start, and what is
/// right of it rests.
struct Impact {
  double face = 0;      ///< where the two meet [m], on a column of the cells' nodes, > 0 and < width
  double velocity = 0;  ///< of the flyer [m/s], > 0
  /// Between flyer and target at the start [m], ≥ 0. Time counts from when they meet. FEM has no contact: there they
  /// are bonded from the start, as in the paper. Places are those that the two have when they meet.
  double gap = 0;
};

/// A place where stress is recorded at every step.
struct Gauge {
  double x = 0, y = 0;  ///< [m]
};

/// What a gauge saw: stress and dilatancy, the means over cells, read as hinge/scene/gauges.hpp says. The stress is the
/// material's, without the artificial viscosity.
struct GaugeRecord {
  std::vector<double> time;       ///< of the stress [s]
  std::vector<double> xx, yy;     ///< [Pa]
  std::vector<double> dilatancy;  ///< V_d; empty without a failure wave
};

/// 0 ≤ x ≤ width, 0 ≤ y ≤ height, of unit thickness, small strain.
struct Plate {
  double width = 0, height = 0;  ///< L_x, L_y [m]
  PlateSolid solid;
  std::array<Edge, 4> edges;                                       ///< by Side
  std::function<Vector(double x, double y, double t)> body_force;  ///< specific, b of eq. 2 [m/s²]
  std::function<Vector(double x, double y)> initial_velocity;      ///< [m/s]
  std::function<Vector(double x, double y)> initial_displacement;  ///< [m], strains follow from it
  std::optional<Impact> impact;                                    ///< beside it no initial state
  std::optional<material::Viscosity> viscosity;                    ///< artificial; form york
  std::vector<Gauge> gauges;
  bool convected = false;  ///< particles move and cross cells; false: infinitesimal displacements
  double pic = 0;          ///< part of PIC in MPM's velocity update, 0 (FLIP) to 1

  Edge& edge(Side side) { return edges[static_cast<std::size_t>(side)]; }
  const Edge& edge(Side side) const { return edges[static_cast<std::size_t>(side)]; }
};

/// Cells of the mesh and of MPM's grid, across and up; cells are numbered row by row from the bottom, each row from the
/// left.
struct Cells {
  int x = 1, y = 1;
};

/// The whole solid.
inline const material::PlaneElastic& elastic(const Plate& plate) { return elastic(plate.solid); }

/// A field at points of a plate, at its own time level.
struct PointField {
  double time = 0;                             ///< [s]
  std::vector<double> x, y;                    ///< where the points started [m]
  std::vector<double> weight;                  ///< area that each stands for [m²]; they add up to the plate
  std::vector<std::vector<double>> component;  ///< each has one value a point
};

struct PlateSnapshot {
  long step = 0;
  double time = 0;                        ///< of strain, crack density and concentration [s]
  PointField displacement, velocity;      ///< x, y
  PointField stress;                      ///< xx, yy, xy
  std::vector<double> volumetric_strain;  ///< of each cell, the mean over its triangles or particles
  std::vector<double> crack_density;      ///< C_d of each cell; empty without damage
  std::vector<material::Tensor> strain;   ///< with damage: of each cell, the mean over its triangles or particles
  std::vector<double> concentration;      ///< C of each cell node, row by row; empty without diffusion [1/m³]
  std::vector<double> dilatancy;          ///< V_d of each cell; empty without a failure wave; of nodes: `concentration`

  void take(const solid::Fields& fields) {
    crack_density.assign(fields.crack_density.begin(), fields.crack_density.end());
    dilatancy.assign(fields.dilatancy.begin(), fields.dilatancy.end());
    concentration.assign(fields.concentration.begin(), fields.concentration.end());
  }
};

/// True if every value is finite.
inline bool finite(const PlateSnapshot& s) {
  const auto all_finite = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  };
  for (const PointField* f : {&s.displacement, &s.velocity, &s.stress}) {
    if (!std::all_of(f->component.begin(), f->component.end(), all_finite)) return false;
  }
  return all_finite(s.volumetric_strain) && all_finite(s.crack_density) && all_finite(s.concentration) &&
         all_finite(s.dilatancy);
}

struct PlateRecord : BasicRecord<PlateSnapshot> {
  static constexpr const char* energy_unit = "J/m";  ///< of a plate's thickness
  double fed = 0;  ///< with diffusion: ∫C dA (∫V_d dA) at the start and what the source (the face) has given since
  long diffusion_updates = 0;       ///< nodes that the diffusion has brought up to date, over the run
  std::vector<GaugeRecord> gauges;  ///< one a gauge of the plate, a value after each step
  double approach = 0;              ///< MPM with a gap: time of flight until the two met [s]
  double left_over = 0;        ///< MPM with a gap: how far they were apart (< 0: too near) when they were joined [m]
  std::vector<double> platen;  ///< displacement of the platen along its outward normal after each step [m]; or empty
  double platen_ahead = 0;     ///< how much later than the end of its step each of them stands: MPM, USF [s]
};

}  // namespace diptych
