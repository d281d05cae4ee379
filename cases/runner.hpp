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

/// One run of a leaf's scene, measured: errors, predictions, ledger, invariants and limits that the case's gates ask for.
reports::Run run_leaf(const Case&, const Leaf&, const std::atomic<bool>* cancelled = nullptr);

/// Throws InputError where a leaf asks for a Courant number above the method's limit and the case does not allow it.
void refuse_unstable(const Case&);

struct Progress {
  std::function<void(std::size_t done, std::size_t total)> step;  ///< called after each run, from one thread at a time
};

/// Runs all leaves of all cases on `threads` threads. Runs not begun when `cancelled` turns true are left out with
/// status "cancelled"; finished ones stay.
std::vector<reports::Case> run_cases(const std::vector<Case>&, int threads, const std::atomic<bool>* cancelled,
                                     const Progress&);

}  // namespace diptych::cases
