// Running a case: every leaf of its sweep, in parallel, with the same bits whatever the number of threads.
#pragma once

#include <cstddef>
#include <vector>

#include "reports/results.hpp"
#include "runner/input/case.hpp"
#include "runner/run/run_leaf.hpp"

namespace diptych::runner {

/// Runs all leaves of all cases. Throws InputError before the first run where a leaf asks for a Courant number above
/// the method's limit and its case does not allow it. Runs not begun when `cancelled` turns true are left out with
/// status "cancelled"; finished ones stay. A case whose exact solution fails its own test has only runs that cannot be
/// judged.
std::vector<reports::Case> run_cases(const std::vector<Case>&, const Running&);

/// Threads within a run of so many unknowns, where there are fewer runs than threads: as many as the runs leave each
/// other and as find enough to do.
int threads_within(int threads, std::size_t runs, int unknowns);

}  // namespace diptych::runner
