// Gates of kind "settling": what is read of a method changes less and less from mesh to mesh.
#pragma once

#include <vector>

#include "runner/judge/gate_kind.hpp"

namespace diptych::runner {

/// Of one or two methods. "probe.ID": what its values on `judged` span is at most `max` of the one on the finest, for
/// each method and time. Histories of gauges, on four meshes or more: the combined Sprague–Geers distance of a gauge's
/// history between successive meshes, and with two methods that between them on each mesh, is at most `max` times the
/// one before.
struct SettlingCriterion : Criterion {
  double max = 0;
  std::vector<int> judged;  ///< of probes

  void judge(const Case&, const GateSpec&, const std::vector<JudgedRun>&, reports::Gate&) const override;
};

}  // namespace diptych::runner
