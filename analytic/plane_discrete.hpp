// What theory says of the discrete schemes in the plane: stability limits, and the error to expect of standing modes.
// Uniform rectangular cells, lumped mass, infinitesimal displacements. FEM: every cell cut by its diagonals into four
// constant-strain triangles, a third of whose mass goes to each corner. MPM: bilinear cells, equal-mass particles that
// stay where they are, FLIP.
#pragma once

#include <optional>
#include <vector>

#include "analytic/plane_exact.hpp"

namespace diptych::analytic {

/// A scheme on its grid. positions: natural coordinates ξ in [0, 1]; particles of a cell stand at positions × positions
/// (ignored for FEM). Whatever takes one throws std::invalid_argument where a value is out of range.
struct PlaneDiscretisation {
  enum class Method { fem, usf, musl, usl };
  Method method;
  double hx, hy;     ///< of a cell [m]
  double time_step;  ///< Δt [s]
  std::vector<double> positions;
};

/// Predicted norm of the error at time t, (Σ w|e|^p / Σ w)^(1/p) for p = 1, 2, the largest |e| for p = 0, e the vector
/// of the components' errors (a stress's xy counts twice, as in the tensor's own norm), w the areas that the points
/// stand for: corners and centres of cells (displacement and velocity of FEM), triangles (its stress, at centroids),
/// particles. In the quantity's own unit. Nothing where there is no theory, and where the mode's rectangle is not a
/// whole number of cells or particles do not lie symmetrically in them.
///
/// t is the time to which the quantity belongs: FEM, MUSL and USL displacement and stress at whole steps, velocity half
/// a step before; USF velocity at whole steps, stress half a step before and displacement half a step after. Throws
/// std::invalid_argument for other times.
///
/// Modes on rollers: what the scheme's error is, not an estimate. Reflected at its sides the rectangle is part of an
/// unbounded lattice, of whose waves exp(i k·x) only those with (±k_x, ±k_y) take part. Displacements are of second
/// order in h; with FEM the optical branch makes velocity (from rest) and stress of first, with MPM the bilinear cell
/// the stress.
///
/// Lamé's mode: the same lattice, of which its free sides are no mirrors. What they add is of the same order in h but
/// does not grow with time, as the error of the phase does. So measured / predicted goes to 1 only where the latter
/// rules: at times when the exact field vanishes, after some periods. L2 of displacement from rest at 32 × 32 cells
/// after ¼, 1¼, 4¼ and 10¼ periods: FEM 1.080, 1.041, 1.004, 1.001; MPM 1.24, 1.23, 1.07, 1.05. Elsewhere it may be off
/// by a multiple.
///
/// Strains at the start are those of the exact displacements at the nodes; USF starts with half a step of strain and
/// displacement, the others with half a kick.
std::optional<double> predicted_error(const PlaneSolution&, const PlaneDiscretisation&, PlaneQuantity, int norm,
                                      double t);

/// Largest stable Δt of a large rectangle of such cells with free sides [s]; time_step is not looked at. The least of
/// the interior's and that of 6 × 6 free cells, which larger free rectangles meet within 2 %, FEM's within 0.1 %;
/// smaller ones may bear less. At ν = 0.3, in units of h/c_d: FEM 0.5783 in plane strain, 0.5685 in plane stress; two
/// by two particles at ±¼, plane strain: USF and MUSL 1.675, USL 0.7497.
double plane_stability_limit(const PlaneMedium&, const PlaneDiscretisation&);

/// The same of the unbounded lattice, and so of a large rectangle on rollers all round, by a scan over its waves [s]:
/// FEM 0.5879 and 0.5738, USF and MUSL 1.732, USL 0.756.
double interior_stability_limit(const PlaneMedium&, const PlaneDiscretisation&);

/// The same of a rectangle of nx × ny cells, 400 at most, with free sides [s]. What FEM's single cell bears (0.5533 and
/// 0.5469), every assembly of such cells bears; an MPM rectangle may bear less than its cells and than the interior
/// (2 × 2 cells at ±¼ with MUSL 1.497).
double free_stability_limit(const PlaneMedium&, const PlaneDiscretisation&, int nx, int ny);

}  // namespace diptych::analytic
