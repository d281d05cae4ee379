// Up to which time step, or which other number, the settings of a case are stable, beside what theory says.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reports/stability_results.hpp"
#include "runner/input/case.hpp"

namespace diptych::runner {

struct StabilityPlan {
  std::vector<std::string> over;  ///< see with_values; not of the number that is sought
  std::optional<long> steps;      ///< of each look-ahead; none: 2000 about rest, under loads the case's own time
  int threads = 1;                ///< for all settings together
  const std::atomic<bool>* cancelled = nullptr;
  std::function<void(std::size_t done, std::size_t total)> progress = {};
  std::string limit_of = {};  ///< "KEY=LEAST:MOST", see limit_of; empty: the time step about rest
  std::string at_most = {};   ///< "QUANTITY=MOST", see ceiling_of; of limit_of alone
};

/// The limit of every setting of the case and of what --over adds: about rest, see about_rest.hpp, or of a number of
/// the scene under its loads, see loaded.hpp. Courant numbers of the case make no difference where they are sought;
/// where no numbers of cells are asked for, the coarsest mesh of each block of axes, of 4 cells if it can be, stands
/// for all. Throws InputError where `over` has values of what is sought, and for what limit_of and ceiling_of refuse.
reports::StabilityMap stability_map(const Case&, const StabilityPlan&);

}  // namespace diptych::runner
