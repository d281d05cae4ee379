// Gates of kind "order".
#pragma once

#include <array>

#include "runner/judge/gate_kind.hpp"

namespace diptych::runner {

/// The slope of log(error) over log(h), all but the mesh held fast, or over log(Δt) on each mesh.
struct OrderCriterion : Criterion {
  double expect = 0;             ///< must agree with theory where there is one
  std::array<double, 2> band{};  ///< allowed slope, inclusive
  int levels_min = 4;            ///< least number of meshes (or time steps)
  bool over_time_step = false;

  void judge(const Case&, const GateSpec&, const std::vector<JudgedRun>&, reports::Gate&) const override;
};

}  // namespace diptych::runner
