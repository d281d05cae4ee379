// Judging gates: from measured runs to verdicts. Arithmetic on results; no solver is called here.
#pragma once

#include <string>
#include <vector>

#include "reports/results.hpp"
#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"

namespace diptych::runner {

/// Judges one gate on the case's runs. A gate that finds nothing to judge is INVALID, never a pass.
reports::Gate judge(const Case&, const GateSpec&, const std::vector<reports::Run>&);
/// The same for whoever judges many gates of a case, and has its leaves already.
reports::Gate judge(const Case&, const Leaves&, const GateSpec&, const std::vector<reports::Run>&);

/// A judged gate in words: where it is declared, what its kind judges, and each number with what it was held against.
std::string explanation(const Case&, const reports::Gate&);

/// Whether the gate bounds numbers one by one, so that it has failed as soon as one run fails it.
bool of_single_numbers(const GateSpec&);

/// Whether all the runs that the gate speaks of have been made: none was cancelled.
bool all_made(const Case&, const GateSpec&, const std::vector<reports::Run>&);

/// What became of all gates together: the worst verdict and the exit status it stands for.
struct Summary {
  int exit_code = 13;
  std::string verdict;  ///< "PASS", or the worst of the gates' verdicts
  int declared = 0, judged = 0, passed = 0;
  int left_out = 0;  ///< slow gates that --quick did not run
};
Summary sum_up(const std::vector<reports::Case>&, int declared, int left_out);

/// Exit statuses (1, 2, 126, 127 and 128+n belong to the shell and to signals, and are never produced).
enum Exit : int { all_passed = 0, some_failed = 10, unstable_or_error = 12, invalid = 13, usage = 14 };

}  // namespace diptych::runner
