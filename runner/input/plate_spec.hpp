// A plate as written in a case file.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "analytic/solution_parameter.hpp"
#include "hinge/diffusion/concentration.hpp"
#include "hinge/diffusion/dilatancy.hpp"
#include "hinge/scene/plate.hpp"
#include "runner/input/toml_table.hpp"

namespace diptych::runner {

/// As case files and people call them, in the order of Side and of Edge::Support.
inline const std::vector<std::string> side_names{"left", "right", "bottom", "top"};
inline const std::vector<std::string> support_names{"free", "roller", "fixed", "driven", "platen"};

/// A traction on one side: its history with times in seconds.
struct SideLoad {
  Side side = Side::top;
  bool shear = false;    ///< along the side, towards larger coordinates; else along the outward normal
  std::string history;   ///< "step", "ramp", "impulse" or "expression"
  std::string traction;  ///< amplitude, an expression of parameters; of t for "expression" [Pa]
  double start = 0, rise = 0, duration = 0;  ///< [s]
};

/// A flyer on the left that strikes the rest of the plate.
struct FlyerSpec {
  double thickness = 0;        ///< [m]
  double velocity = 0;         ///< [m/s]
  double gap = 0;              ///< to the target at the start, in `gap_unit`
  std::string gap_unit = "m";  ///< "m" or "cells"
};

/// Two or three components, each an expression of x, y and t or of x and y; empty: none.
using Pair = std::array<std::string, 2>;
using Triple = std::array<std::string, 3>;

struct PlateExact {
  std::string solution = "none";            ///< one of analytic::plane_solutions, "expressions" or "none"
  analytic::SolutionParameters parameters;  ///< those of the solution
  Pair displacement, velocity;
  Triple stress;
  std::string concentration;

  /// Radius around the origin where nothing is compared [m].
  double core() const {
    const auto given = parameters.find("core");
    return given == parameters.end() ? 0 : given->second;
  }
};

/// A diffusion scene without mechanics.
struct PureDiffusion {
  std::string diffusivity = "0";  ///< of x and y [m²/s]
  std::string rate;               ///< Q of x, y and t [C/s]
  double corner_rate = 0;         ///< a source at the origin's node, of the quarter plane [C m²/s]
  diffusion::Scheme scheme = diffusion::Scheme::forward_euler;
  diffusion::Reading reading = diffusion::Reading::isotropic;
  /// Instead of all these: a dilatancy of 1 held on the left side spreads, the ceiling being 1 everywhere.
  std::optional<diffusion::Spread> spread;
};

struct PlateSpec {
  double width = 0, height = 0;  ///< L_x, L_y [m]
  double cell_aspect = 1;        ///< height of a cell / its width
  int rows = 0;                  ///< of cells, whatever the mesh: the height follows; 0: the height is given
  double pic = 0;
  std::optional<PlateSolid> solid;         ///< none: diffusion alone
  std::optional<PureDiffusion> diffusion;  ///< without a solid
  std::optional<double> face;              ///< impact face of a failure wave without a flyer [m]
  std::optional<FlyerSpec> flyer;
  std::optional<material::Viscosity> viscosity;
  std::array<Edge::Support, 4> supports{};  ///< by Side
  std::vector<SideLoad> loads;
  Pair drive, body_force;                       ///< of x, y and t
  Pair initial_velocity, initial_displacement;  ///< of x and y
  std::string initial_concentration;            ///< of x and y; C, or V_d of a failure wave
  PlateExact exact;

  /// The solid, where it is such a one; else null.
  const solid::Cracking* cracking() const { return solid ? std::get_if<solid::Cracking>(&*solid) : nullptr; }
  solid::Cracking* cracking() { return solid ? std::get_if<solid::Cracking>(&*solid) : nullptr; }
  const solid::Failing* failing() const { return solid ? std::get_if<solid::Failing>(&*solid) : nullptr; }
  solid::Failing* failing() { return solid ? std::get_if<solid::Failing>(&*solid) : nullptr; }
};

inline const material::PlaneElastic& elastic_of(const PlateSpec& plate) { return elastic(*plate.solid); }

/// What is read from a plate at each sample time as a single number.
struct PlateProbe {
  std::string id;
  /// Of C_d: "radius" of a contour along an angle, "area" where C_d ≥ level, "largest"; of C: "total", ∫C dA; of the
  /// cells' strains: "acoustic-ratio", the least ratio of the acoustic tensor's determinant to that of the whole solid,
  /// and "acoustic-angle", the direction of its normal there [degrees]; "platen", its displacement. At a place: a
  /// component of a field, "displacement-x", "stress-xy", ..., of the point that stands nearest, or "concentration".
  std::string reads;
  double x = 0, y = 0;  ///< [m]
  double angle = 0;     ///< from the x axis [degrees]
  double level = 0;     ///< of C_d
};

/// Stress is read there at every step.
struct GaugeSpec {
  std::string id;
  double from_face = 0;  ///< distance from the impact face, in the target [m]
};

/// The plate with some keys set otherwise.
struct PlateVariant {
  std::string id, says;
  PlateSpec plate;
  std::vector<Change> changes = {};  ///< of the file's scene
};

}  // namespace diptych::runner
