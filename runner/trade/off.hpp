// What features cost where they are off: pairs of runs, one after the other, without each feature and with it.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "reports/off_results.hpp"

namespace diptych::runner {

struct OffPlan {
  std::vector<std::string> features, methods;  ///< of off_pairs(), and ids of panels
  std::vector<double> points;                  ///< about so many elements or particles
  int rounds = 3;                              ///< 0: nothing is timed
};

/// Every pair with every solver that takes it and every size, on one thread. Bits and bytes are those of a short run
/// with books off, or what the pair says. A step's time is that of a long run less a short one; a round is the first
/// scene, the second twice and the first again, so that what slowly changes around them cancels. Other work must not go
/// on in this process.
std::vector<reports::OffRow> off(const OffPlan&, const std::atomic<bool>* cancelled,
                                 const std::function<void(std::size_t done, std::size_t total)>& progress);

}  // namespace diptych::runner
