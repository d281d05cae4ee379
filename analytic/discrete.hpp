// What theory says of the discrete schemes themselves: dispersion, damping, stability limits, and from them the error
// to expect. Uniform 1-D grid, lumped mass, linear shape functions, infinitesimal displacements.
#pragma once

#include <optional>
#include <vector>

#include "analytic/exact.hpp"

namespace diptych::analytic {

enum class Scheme { fem, mpm_usf, mpm_usl, mpm_musl };
enum class Norm { l1, l2, linf };

/// A scheme on its grid. positions: natural coordinates ξ in [0, 1] of the equal-mass particles of a cell (ignored for
/// FEM). Whatever takes one throws std::invalid_argument where a value is out of range or an MPM cell is empty.
struct Discretisation {
  Scheme scheme;
  double cell;     ///< h [m]
  double courant;  ///< C = cΔt/h
  std::vector<double> positions;
};

/// a = mean of 4ξ(1−ξ) over a cell's particles; 0 for FEM.
double particle_filter(const Discretisation&);

/// One step multiplies a wave exp(ikx) by exp(−damping ± i·phase).
struct StepFactor {
  double phase;    ///< ω_h Δt, in [0, π]
  double damping;  ///< ≥ 0 where stable
};
/// θ = kh in [0, π]. FEM, USF, MUSL: sin²(ω_hΔt/2) = C² s²(1 − a s²), s = sin(θ/2), no damping.
/// USL: eigenvalues of a matrix with trace 2 − 4C²s² and determinant 1 − 4C²a s⁴.
StepFactor step_factor(const Discretisation&, double theta);

/// Courant number up to which a bar with free ends is stable. FEM 1. USF and MUSL [q(1−aq)]^(−½), q = min(1, 1/(2a)).
/// USL: the lesser of the periodic (1+a)^(−½) and that of an end cell standing alone, 2·sqrt(x̄(1−x̄)/(2−g)), x̄ the
/// mean position, g = var/(x̄(1−x̄)); √(2ξ(1−ξ)) for one particle at ξ, (1+a)^(−½) again for symmetric sets. The end
/// cell also bounds USF and MUSL, by 2·sqrt(x̄(1−x̄)/g), but only where particles crowd unequally at its two sides.
double stability_limit(const Discretisation&);

/// w = [|1+3a−C²| c t h²/8]^(1/3), the width of a front that has travelled c t (Airy scaling) [m].
double front_width(const Discretisation&, double travelled);

/// Leading-order error of steps and impulses by Airy scaling, w the width of a front: stress L2 σ₀ (0.517639 w/L)^½,
/// displacement L2 (σ₀/E) w^{3/2}/(3 √L) and L∞ 0.258819 (σ₀/E) w, fronts adding in quadrature (L∞: the widest). Good
/// to 5 % (L∞ a sixth) at 200 cells. Nothing for USL, ramps and other norms, and where two fronts are within 10 widths
/// of each other, or one is within 6 of an end or of where it entered, or narrower than a cell.
std::optional<double> airy_step_error(const ExactSolution&, const Discretisation&, BarQuantity, Norm, double t);

/// Predicted norm of the error at time t, (∫|e|^p dx / L)^(1/p) over the bar, or nothing where there is no theory for
/// this solution, scheme, quantity and norm. The field is stress constant in each cell, displacement on lines between
/// nodes or particles.
///
/// Bar waves whose tractions are steps and impulses, in a whole number of cells:
/// - Stress and displacement L2 from the exact dispersion relation, mode by mode: what the scheme's error is, not an
///   estimate, if particles lie symmetrically in their cells and tractions change at whole steps. Stress to round-off
///   (USL 0.2 % at N = 200 cells and C = ½, less on finer grids), at any time unless fronts share a cell. Displacement
///   at nodes likewise while fronts are at nodes; else, and at particles, to 6 % at N = 100, 3 % at 200. For one front
///   of σ₀ they tend to σ₀ (0.517639 w/L)^½ and (σ₀/E) w^{3/2}/(3 √L) as h → 0 (not USL).
/// - Displacement L∞ (not USL) from airy_step_error.
///
/// Times are those to which quantities belong: FEM, USL and MUSL start with half a kick, and stress and displacement
/// are at whole steps; USF starts with a whole one, velocity is at whole steps and stress and displacement half-way
/// between, stress before and displacement after. Half a step off, displacement errors change by as much again.
///
/// Standing modes: L1, L2 and L∞ of the phase error |exp(−γt) sin(ω_h t) − sin(ωt)| for stress and displacement, the
/// same with cosines for velocity; errors of amplitude are not in it, so take times where the exact solution vanishes.
/// Velocities live half a step before displacements.
std::optional<double> predicted_error(const ExactSolution&, const Discretisation&, BarQuantity, Norm, double t);

/// Expected order in h at fixed Courant number, or nothing without theory. Steps: stress L1 ½ (USL ⅝), L2 ⅓, L∞ 0;
/// displacement 4/3, 1, 2/3. Standing modes: 2.
std::optional<double> expected_order(const ExactSolution&, Scheme, BarQuantity, Norm);

}  // namespace diptych::analytic
