// What every kind of gate is judged with.
#pragma once

#include <string>
#include <utility>

#include "reports/results.hpp"

namespace diptych::runner {

/// A gate stops being judged where it cannot be: the verdict and the reason.
struct Stop {
  reports::Verdict verdict;
  std::string message;
};

[[noreturn]] inline void not_judged(const std::string& why) { throw Stop{reports::Verdict::invalid, why}; }

/// Throws Stop where the run did not complete or cannot be judged.
inline void check_judgeable(const reports::Run& run) {
  using reports::Verdict;
  if (run.status == "unstable") throw Stop{Verdict::unstable, run.label() + ": " + run.message};
  if (run.status != "completed") throw Stop{Verdict::error, run.label() + ": " + run.status + ": " + run.message};
  if (!run.invalid.empty()) throw Stop{Verdict::invalid, run.label() + ": " + run.invalid};
}

inline void hold(reports::Gate& result, reports::Check check) {
  check.passed = check.judged >= check.low && check.judged <= check.high;  // false for NaN
  result.checks.push_back(std::move(check));
}

}  // namespace diptych::runner
