// Up to which time step the settings of a case are stable, beside what theory says.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "reports/stability_results.hpp"
#include "runner/input/case.hpp"

namespace diptych::runner {

struct StabilityPlan {
  std::vector<std::string> over;  ///< see with_values; no Courant numbers, which are what is sought
  long steps = 2000;              ///< of each look-ahead
  int threads = 1;                ///< for all settings together
  const std::atomic<bool>* cancelled = nullptr;
  std::function<void(std::size_t done, std::size_t total)> progress = {};
};

/// The limit of every setting of the case and of what --over adds. Courant numbers of the case make no difference;
/// where no numbers of cells are asked for, the coarsest mesh of each block of axes, of 4 cells if it can be, stands
/// for all. Throws InputError for Courant numbers in `over`.
reports::StabilityMap stability_map(const Case&, const StabilityPlan&);

}  // namespace diptych::runner
