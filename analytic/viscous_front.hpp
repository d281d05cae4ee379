// What linear artificial viscosity does to an explicit bar scheme and to a step that travels in it.
//
// q = ρν D, D the velocity gradient and ν [m²/s]: ν = c₁ch in the usual form q = ρc₁ch D, ν = λ g c c₁ in that of York,
// Sulsky & Schreyer (Int. J. Numer. Meth. Engng 48, 2000, eq. 24) where c₂ = 0, g being √2 h there.
#pragma once

#include <optional>

#include "analytic/discrete.hpp"
#include "analytic/exact.hpp"

namespace diptych::analytic {

/// Courant number cΔt/h up to which a scheme is stable under lagged linear viscosity, of both signs: √(c₁² + C₀²) − c₁.
/// Lagged: q of step n + 1 is ρν D^(n+½), and pushes together with the stress of step n + 1.
/// Viscosity of compression alone has this limit too while every cell is being compressed, but what grows beyond it
/// stops where it stretches one. To grow for ever takes the limit of c1 / 2: of the checkerboard half is in
/// compression. That is exact for FEM, USL and one centred particle; elsewhere other waves are the first to go under
/// USF and MUSL, and it was measured to hold within 2.5 %, on either side, at c1 ≤ 1.5.
/// inviscid_limit: C₀ > 0, the scheme's own (stability_limit of discrete.hpp; end cells included, USL too).
/// c1: ν/(ch) ≥ 0. Throws std::invalid_argument where either is out of range.
double viscous_stability_limit(double inviscid_limit, double c1);

/// A step of 1 that has travelled for a time t > 0 at ν > 0, at a distance x − ct ahead of its front:
/// ½ erfc((x − ct)/√(2νt)). For large t: of terms that die faster, ν/(2c) is the largest, by which total stress σ + q
/// is ahead, σ behind, and velocity neither. These functions throw std::invalid_argument where ν or t is not > 0.
double viscous_front(double ahead, double viscosity, double t);
double viscous_front_width(double viscosity, double t);  ///< from 90 % to 10 % of the step: 1.8124 √(2νt) [m]
/// ∫|e|dx = √(2νt/π), for a step of 1 whose error is that it is not sharp [m]
double viscous_front_l1(double viscosity, double t);
/// (∫e²dx)^½ = (0.330495/2 · √(2νt))^½ [m^½]
double viscous_front_l2(double viscosity, double t);

/// The error (∫|e|^p dx / L)^(1/p) over the bar at time t that viscosity of compression alone, D < 0, makes of steps
/// and impulses on its ends; L1 or L2 of stress or velocity. Fronts add, L2 in quadrature. Nothing for other solutions,
/// quantities and norms, and unless every front is compressive and has been since it entered (tension is not smoothed:
/// held ends keep the sign of stress, free ones turn it), has entered, has travelled 4√(2νt), and is as far from both
/// ends and twice as far from the next one. √(2νt) should be 8 cells or more and 3 times front_width of discrete.hpp:
/// lumped FEM is then within 0.3 % of this, but at 2.2 widths 2 % above it and at 1.7 widths 13 %, in L1. Throws
/// std::invalid_argument where ν is not > 0 or t not finite.
std::optional<double> viscous_step_error(const ExactSolution&, double viscosity, BarQuantity, Norm, double t);

}  // namespace diptych::analytic
