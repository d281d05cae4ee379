// The panels: one row of the table in panel.cpp for each method that a case can name. What a method is called, what it
// can, what theory says of it and how it is run stand there and nowhere else: panel.cpp alone includes fem/ and mpm/,
// and no other file decides by a method's name.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analytic/discrete.hpp"
#include "analytic/plane_discrete.hpp"
#include "hinge/diffusion/concentration.hpp"
#include "hinge/diffusion/dilatancy.hpp"
#include "hinge/scene/plate.hpp"
#include "hinge/scene/scene.hpp"
#include "hinge/step/record.hpp"
#include "reports/look.hpp"
#include "runner/diffusion_alone.hpp"
#include "runner/registry.hpp"

namespace diptych::runner {

/// Elements or cells of the first bar, and natural coordinates in [0, 1] of a cell's particles.
struct BarMesh {
  int cells = 1;
  std::vector<double> particles;
};

/// Cells of a plate, and natural coordinates in [0, 1] along both of a cell's sides at which its particles stand.
struct PlateMesh {
  diffusion::Grid grid;
  std::vector<double> particles;

  Cells cells() const { return {grid.nx, grid.ny}; }
};

/// How a panel solves one kind of scene. Both throw std::invalid_argument for a scene that the method cannot take.
template <class Scene, class Mesh, class Record>
struct Solver {
  std::function<double(const Scene&, const Mesh&)> limit;  ///< largest stable time step [s]; empty: not known
  std::function<Record(const Scene&, const Mesh&, const Stepping&)> run;  ///< empty: takes no scene of this kind
};

enum class SceneKind { bars, plate, diffusion };

/// One row of the table.
struct Panel {
  std::string id;           ///< "mpm-musl": as case files name it
  std::string name;         ///< "MPM, MUSL": for people
  reports::PanelLook look;  ///< in figures; panels of one family share it
  std::string work;         ///< what its work is counted in: "element-steps" or "particle-steps"

  bool particles = false;     ///< its cells hold particles, whose places are an axis of its runs
  bool elements = false;      ///< its fields are those of a mesh's elements, drawn as steps; else those of points
  bool grid_contact = false;  ///< bodies touch as soon as they share a node of the grid; else when their ends meet
  bool usual = false;         ///< is meant where nobody says which of its family
  bool half_steps = false;    ///< strains stand half a step beside whole ones, and damage with them

  /// Features of bars that it does not take, alone or together.
  std::vector<std::vector<std::string>> refuses = {};
  /// Features that a scene may have and that make no difference to it, so that its runs do not show them.
  std::vector<std::string> shows_not = {};

  /// What theory calls its scheme; empty: there is no theory, and nothing is predicted of its runs.
  std::optional<analytic::Scheme> bar_theory = {};
  std::optional<analytic::PlaneDiscretisation::Method> plate_theory = {};

  Solver<Scene, BarMesh, Record> bars = {};
  Solver<Plate, PlateMesh, PlateRecord> plate = {};
  Solver<DiffusionScene, diffusion::Grid, PlateRecord> diffusion = {};

  bool takes(SceneKind) const;
  bool has_theory(SceneKind) const;
};

/// The panel of this id. Throws std::invalid_argument where there is none, with the ids that there are.
const Panel& panel(const std::string& id);
/// The panel of this scheme. Throws std::invalid_argument where there is none.
const Panel& panel(analytic::Scheme);
/// Ids of the panels that take such scenes, in the order of the table.
std::vector<std::string> panels_for(SceneKind);
/// The looks of all panels, each once.
std::vector<reports::PanelLook> looks();

/// All panels.
Registry<Panel>& panels();
using AddedPanel = Added<Panel, panels>;

}  // namespace diptych::runner
