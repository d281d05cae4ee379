// What the settings of a case cost and how far off they are.
#pragma once

#include <vector>

#include "reports/results.hpp"
#include "reports/trade_results.hpp"
#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"
#include "runner/run/run_leaf.hpp"

namespace diptych::runner {

/// The case as a trade runs it: without gates, figures and books, which cost time and are not asked for. Settings above
/// a limit may run.
Case bare(Case);

/// How the settings are timed.
struct Timing {
  int rounds = 0;               ///< 0: not at all
  std::vector<int> threads{1};  ///< plates: a point for each number
};

/// Runs all settings of a case, and of its changes (see with_values), with each as a point, whatever came of it.
/// With Running::limit_seconds a run that takes longer is stopped, and one that would take more than twice as long, by
/// what runs of its method took before, is not begun: both are points with status "timed out". The completed ones are
/// timed afterwards, see time_runs. Errors are those of errors.hpp. Throws InputError where bars are asked for threads.
reports::Trade measure_trade(const std::vector<Case>&, const Running&, const Timing&);

/// A point of a run: what it cost and what came of it.
reports::TradePoint point_of(const reports::Run&);
/// The same in its scene, and of a completed one with its known errors. The case is that of the run's leaf.
reports::TradePoint point_of(const Case&, const Leaf&, const reports::Run&);
/// The same, run; the case as it is written.
reports::TradePoint measured_point(const Case&, const Leaf&, const Running&);

}  // namespace diptych::runner
