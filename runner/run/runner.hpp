// Running a case: every leaf of its sweep, in parallel, with the same bits whatever the number of threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "reports/results.hpp"
#include "runner/input/case.hpp"
#include "runner/run/run_leaf.hpp"
#include "runner/store/store.hpp"

namespace diptych::runner {

/// Runs that were made before are taken from a store, and those that are made are kept there as each of them ends.
struct Keeping {
  Store store;
  bool fresh = false;                       ///< make all of them anew
  bool only = false;                        ///< make none: what is not there has status "missing"
  std::atomic<std::size_t> found{0};        ///< taken from the store
  std::atomic<std::size_t> kept{0};         ///< written to it
  std::mutex telling = {};                  ///< of the next
  std::optional<std::string> trouble = {};  ///< why one could not be kept, which costs no run
};

/// Runs all leaves of all cases. Throws InputError before the first run where a leaf asks for a Courant number above
/// the method's limit and its case does not allow it. Runs not begun when `cancelled` turns true are left out with
/// status "cancelled"; finished ones stay. A case whose exact solution fails its own test has only runs that cannot be
/// judged.
std::vector<reports::Case> run_cases(const std::vector<Case>&, const Running&);

/// Whether the same run would come to this again: what was stopped, or went wrong, is not kept.
bool worth_keeping(const reports::Run&);

/// A run that a command would make.
struct PlannedRun {
  std::string case_id, label;
  std::string words;   ///< all that it can see, see words_of_run
  double updates = 0;  ///< of unknowns, about
};

/// The runs that run_cases would make or take from a store, those of equal words once, in the order of the cases.
/// Throws as it does.
std::vector<PlannedRun> plan_runs(const std::vector<Case>&, const Running&);

/// Threads within a run of so many unknowns, where there are fewer runs than threads: as many as the runs leave each
/// other and as find enough to do.
int threads_within(int threads, std::size_t runs, int unknowns);

}  // namespace diptych::runner
