// Gates of kind "limit" on runs above it.
#pragma once

#include "runner/judge/gate_kind.hpp"

namespace diptych::runner {

/// Runs above the limit must be seen to blow up.
struct BlowUpCriterion : Criterion {
  void judge(const Case&, const GateSpec&, const std::vector<JudgedRun>&, reports::Gate&) const override;
};

}  // namespace diptych::runner
