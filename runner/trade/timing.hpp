// How long runs take, measured so that it can be compared.
#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "reports/trade_results.hpp"
#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"

namespace diptych::runner {

/// Median and spread of the rounds of one run.
reports::Timed summed_up(std::vector<double> rounds);

/// A run to be timed; the case must outlive it.
struct TimedRun {
  const Case* c = nullptr;
  Leaf leaf;
  int threads = 1;
};

/// Each of these once a round, one after the other and without books; a first round is not counted.
/// A run that takes less than a hundredth of a second is repeated within its round until it has taken so long. Other
/// work must not go on in this process; what is stopped by `cancelled` has as many rounds as were finished.
std::vector<reports::Timed> time_runs(const std::vector<TimedRun>&, int rounds, const std::atomic<bool>* cancelled,
                                      const std::function<void(std::size_t done, std::size_t total)>& progress);

}  // namespace diptych::runner
