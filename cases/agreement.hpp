// FEM against MPM where there is no exact solution: their difference against the numerical uncertainty of both. It
// never outranks a gate against an exact solution.
#pragma once

#include <vector>

#include "cases/case.hpp"
#include "reports/results.hpp"

namespace diptych::cases {

/// Judges a gate of kind "agreement" on the runs that it speaks of: two methods on the same four meshes or more. On
/// each of gate.judged, |difference|/√(U_FEM² + U_MPM²) ≤ gate.max, U the uncertainty that all meshes of a method give
/// (uncertainty.hpp); and, where gate.shrinks, the difference on the finest of them is at most that on the
/// coarsest. Quantities: "probe.ID";
/// "contour.distance", the Hausdorff distance of the contours of C_d = gate.level, U the largest of the radii at 0°,
/// 5°, ..., 90°; "platen.history" and "gauge.ID.COMPONENT", the combined Sprague–Geers measure of the platen's
/// displacement and of a gauge's history, U that of each method between this mesh and its finest, on the finest that
/// of the one before. Throws Stop where it cannot be judged.
void judge_agreement(const Case&, const GateSpec&, const std::vector<const reports::Run*>&, reports::Gate&);

/// Judges a gate of kind "settling" on the runs that it speaks of: one or two methods, each on four meshes or more. The
/// combined Sprague–Geers distance of a gauge's history between successive meshes, and with two methods that between
/// them on each mesh, is at most gate.max times the one before. Throws Stop where it cannot be judged.
void judge_settling(const GateSpec&, const std::vector<const reports::Run*>&, reports::Gate&);

}  // namespace diptych::cases
