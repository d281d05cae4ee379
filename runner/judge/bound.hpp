// A bound on the numbers themselves, which gates of kind "exact" and "invariant" have.
#pragma once

#include <optional>
#include <string>

#include "runner/input/toml_table.hpp"
#include "runner/judge/gate_kind.hpp"

namespace diptych::runner {

/// Reads a tolerance, at least 0. Refuses one that is wider than `most`, the size of what it bounds: no value would be
/// outside. `of` says what that is.
double read_tolerance(Table&, const std::string& key, double most, const std::string& of);

/// |value| ≤ max, or |value − expect| ≤ max.
struct BoundCriterion : Criterion {
  double max = 0;  ///< of error norms in units of the field's scale
  std::optional<double> expect;

  void judge(const Case&, const GateSpec&, const std::vector<JudgedRun>&, reports::Gate&) const override;
  bool of_single_numbers() const override { return true; }
  bool sees_wrong_solutions() const override { return true; }
};

}  // namespace diptych::runner
