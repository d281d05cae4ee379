// From a plate's case to what the solvers and the oracle take.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "analytic/diffusion_front.hpp"
#include "analytic/impact_lattice.hpp"
#include "analytic/plane_discrete.hpp"
#include "analytic/plane_exact.hpp"
#include "analytic/plane_solutions.hpp"
#include "hinge/diffusion/concentration.hpp"
#include "hinge/diffusion/dilatancy.hpp"
#include "hinge/scene/plate.hpp"
#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"

namespace diptych::runner {

/// Cells of a run: `cells` across, and up so many that they have the aspect asked for.
Cells cells_of(const PlateSpec&, int cells);
diffusion::Grid grid_of(const PlateSpec&, int cells);

/// The solid on so many cells. Of a failure wave the impact face is a column of nodes, and V_d at the start theirs.
PlateSolid solid_of(const Case&, int cells);

/// The scene of one run on so many cells. Holds expressions of its own: make one for each thread.
Plate make_plate(const Case&, int cells);
/// The row of the plate's exact solution; null where it names none or gives expressions.
const analytic::PlaneSolutionRow* plane_solution_of(const PlateSpec&);
/// The plate as exact solutions see it, but for its medium and its diffusivity.
analytic::PlaneSetting plane_setting(const PlateSpec&);
/// The exact solution, or null where the case names none.
std::unique_ptr<analytic::PlaneSolution> make_plane_exact(const Case&);
analytic::PlaneMedium medium_of(const PlateSpec&);
/// The lattice of an elastic plate that a flyer strikes; nothing where there is no theory of the panel.
std::optional<analytic::ImpactLattice::Parameters> impact_lattice(const PlateSpec&, const Leaf&, double time_step);
analytic::FrontProfile profile_of(diffusion::Profile);
/// The panel's scheme and grid as theory sees them; nothing where there is none.
std::optional<analytic::PlaneDiscretisation> plane_discretisation(const PlateSpec&, const Leaf&, double time_step);

/// A scene of diffusion alone, likewise.
DiffusionScene make_diffusion(const Case&);

/// The features that the scene switches on, each with the key that does it.
std::map<std::string, std::string> plate_features(const Case&);

/// "E = 50 GPa, ν = 0.3, ...": for people.
std::string words_of(const PlateSpec&);

}  // namespace diptych::runner
