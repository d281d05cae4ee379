// What is measured over what theory predicts, which gates of kind "constant" and "limit" have.
#pragma once

#include <array>
#include <string>

#include "runner/input/toml_table.hpp"
#include "runner/judge/gate_kind.hpp"

namespace diptych::runner {

/// Reads the band of a ratio. Refuses one that is so wide that a wrong solution's ratio is in it, too.
std::array<double, 2> read_ratio(Table&);

struct RatioCriterion : Criterion {
  std::string theory;
  std::array<double, 2> ratio{};  ///< measured / predicted within, inclusive
  bool of_limit = false;          ///< of a limit, which many wrong solutions share

  void judge(const Case&, const GateSpec&, const std::vector<JudgedRun>&, reports::Gate&) const override;
  bool of_single_numbers() const override { return true; }
  bool sees_wrong_solutions() const override { return !of_limit; }
};

}  // namespace diptych::runner
