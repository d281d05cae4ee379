// Gates of kind "agreement": FEM against MPM where there is no exact solution, their difference against the numerical
// uncertainty of both. It never outranks a gate against an exact solution.
#pragma once

#include <optional>
#include <vector>

#include "runner/judge/gate_kind.hpp"

namespace diptych::runner {

/// Two methods on the same four meshes or more. On each of `judged`, |difference|/√(U_FEM² + U_MPM²) ≤ max, U the
/// uncertainty that all meshes of a method give (uncertainty.hpp); the difference is at most `apart` of the value,
/// where that is given; and, where it shrinks, the difference on the finest of them is at most that on the coarsest. An
/// uncertainty of more than a quarter of the value judges nothing, and is not judged. Quantities: "probe.ID";
/// "contour.distance", the Hausdorff distance of the contours of C_d = level, U the largest of the radii at 0°, 5°,
/// ..., 90°; "platen.history" and "gauge.ID.COMPONENT", the combined Sprague–Geers measure of the platen's displacement
/// and of a gauge's history, U that of each method between this mesh and its finest, on the finest that of the one
/// before.
struct AgreementCriterion : Criterion {
  std::optional<double> max;  ///< none where `apart` alone is judged
  std::vector<int> judged;    ///< meshes that the gate is about
  std::vector<double> apart;  ///< most that the methods differ by on each of `judged`, of the value; or none
  bool shrinks = true;        ///< the difference must do so from coarse to fine
  double level = 0;           ///< of contours: of C_d

  void judge(const Case&, const GateSpec&, const std::vector<JudgedRun>&, reports::Gate&) const override;
};

}  // namespace diptych::runner
