// The numbers that a gate speaks of, read from its runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analytic/exact.hpp"
#include "runner/judge/gate_kind.hpp"

namespace diptych::runner {

/// Below this many round-offs an error is noise and has neither an order nor a constant.
constexpr double floor_of_noise = 100 * 2.3e-16;

struct Reading {
  const JudgedRun* of;
  double time;  ///< asked, or NaN for quantities of the whole run
  double value;
  std::optional<double> predicted;
  std::string what;

  const reports::Run& run() const { return *of->run; }
};

/// Every number the gate speaks of; each must be there and finite. Predicted by the theory of that name, or by the
/// run's own where it is empty. Throws Stop where a run cannot be judged or a number is missing.
std::vector<Reading> read(const Case&, const GateSpec&, const std::vector<JudgedRun>&, const std::string& theory = "");

/// An error norm's parts: "stress" and "L2" of "stress.L2".
struct ErrorNorm {
  std::string field, norm;

  explicit ErrorNorm(const std::string& quantity);
  analytic::BarQuantity of() const;  ///< of bars
  analytic::Norm as() const;
};

}  // namespace diptych::runner
