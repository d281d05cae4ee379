// Running a case: every leaf of its sweep, in parallel, with the same bits whatever the number of threads.
#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "cases/case.hpp"
#include "cases/leaf.hpp"
#include "material/record.hpp"
#include "reports/results.hpp"

namespace diptych::cases {

/// How to run, as against what.
struct Running {
  int threads = 1;
  const std::atomic<bool>* cancelled = nullptr;  ///< turns true where runs should stop soon
  bool keep_ledger = false;                      ///< keep every step's line of the ledger in the results
  bool keep_fields = false;                      ///< keep all fields of plates at the sample times in the results
  bool judged_only = false;                      ///< leave out runs that no gate of their case speaks of
  std::function<void(std::size_t done, std::size_t total)> progress =
      {};  ///< after each run, from one thread at a time
};

/// One run of a leaf's scene, measured: errors, predictions, ledger, invariants and limits that the case's gates ask
/// for.
reports::Run run_leaf(const Case&, const Leaf&, const Running& = {});

/// Throws InputError where a leaf asks for a Courant number above the method's limit and the case does not allow it.
void refuse_unstable(const Case&);

/// Runs all leaves of all cases. Runs not begun when `cancelled` turns true are left out with status "cancelled";
/// finished ones stay. A case whose exact solution fails its own test has only runs that cannot be judged.
std::vector<reports::Case> run_cases(const std::vector<Case>&, const Running&);

}  // namespace diptych::cases
