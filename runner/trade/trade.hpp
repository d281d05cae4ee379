// What the settings of a case cost and how far off they are.
#pragma once

#include <vector>

#include "reports/results.hpp"
#include "reports/trade_results.hpp"
#include "runner/input/case.hpp"
#include "runner/run/run_leaf.hpp"

namespace diptych::runner {

/// The case as a trade runs it: without gates, figures and books, which cost time and are not asked for. Settings above
/// a limit may run.
Case bare(Case);

/// Runs all settings of the case (see `bare`), with each as a point, whatever came of it; where rounds > 0 the
/// completed ones are timed afterwards, see time_runs. Errors are those of the fields; and of probes, where their value
/// is known or enough meshes extrapolate to it.
reports::Trade measure_trade(const Case&, const Running&, int rounds);

reports::TradePoint point_of(const reports::Run&);

/// The points of runs that are there, in the order of the case's leaves; none is timed.
reports::Trade trade_of(const Case&, const std::vector<reports::Run>&);

}  // namespace diptych::runner
