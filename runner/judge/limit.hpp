// Gates of kind "limit" on runs above it.
#pragma once

#include "runner/judge/gate_kind.hpp"

namespace diptych::runner {

/// Runs above the limit must be seen to blow up; those below it must come to their end.
struct BlowUpCriterion : Criterion {
  BlowUpCriterion() = default;
  explicit BlowUpCriterion(bool completes) : completes_(completes) {}
  void judge(const Case&, const GateSpec&, const std::vector<JudgedRun>&, reports::Gate&) const override;

 private:
  bool completes_ = false;
};

}  // namespace diptych::runner
