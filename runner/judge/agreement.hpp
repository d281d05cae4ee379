// FEM against MPM where there is no exact solution: their difference against the numerical uncertainty of both. It
// never outranks a gate against an exact solution.
#pragma once

#include <vector>

#include "reports/results.hpp"
#include "runner/input/case.hpp"

namespace diptych::runner {

/// Judges a gate of kind "agreement" on the runs that it speaks of: two methods on the same four meshes or more. On
/// each of gate.judged, |difference|/√(U_FEM² + U_MPM²) ≤ gate.max, U the uncertainty that all meshes of a method give
/// (uncertainty.hpp); the difference is at most gate.apart of the value, where that is given; and, where gate.shrinks,
/// the difference on the finest of them is at most that on the coarsest. An uncertainty of more than a quarter of the
/// value judges nothing, and is not judged. Quantities: "probe.ID";
/// "contour.distance", the Hausdorff distance of the contours of C_d = gate.level, U the largest of the radii at 0°,
/// 5°, ..., 90°; "platen.history" and "gauge.ID.COMPONENT", the combined Sprague–Geers measure of the platen's
/// displacement and of a gauge's history, U that of each method between this mesh and its finest, on the finest that
/// of the one before. Throws Stop where it cannot be judged.
void judge_agreement(const Case&, const GateSpec&, const std::vector<const reports::Run*>&, reports::Gate&);

/// Judges a gate of kind "settling" on the runs that it speaks of, of one or two methods. "probe.ID": what its values
/// on gate.judged span is at most gate.max of the one on the finest, for each method and time. Histories of gauges, on
/// four meshes or more: the combined Sprague–Geers distance of a gauge's history between successive meshes, and with
/// two methods that between them on each mesh, is at most gate.max times the one before. Throws Stop where it cannot be
/// judged.
void judge_settling(const Case&, const GateSpec&, const std::vector<const reports::Run*>&, reports::Gate&);

}  // namespace diptych::runner
