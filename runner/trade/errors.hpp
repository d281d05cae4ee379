// What is off in a run, and by how much: all numbers of it that a gate could name as an error or as a value.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "reports/results.hpp"
#include "reports/trade_results.hpp"
#include "runner/input/case.hpp"
#include "runner/input/messages.hpp"

namespace diptych::runner {

/// A number of a run.
struct RunNumber {
  std::string quantity;        ///< "probe.tip", "contact.duration", "gauge.near.arrival"
  double time = std::nan("");  ///< sample time; NaN: said of the whole run
  double value = 0;            ///< in its own unit
  /// What it differs by from its exact value, part of that or of what gates divide by; none: nothing exact is known.
  std::optional<double> error = {};
};
/// Probes at their times, and what is measured once a run: outcomes, what gauges read, speeds of failure.
std::vector<RunNumber> numbers_of(const Case&, const reports::Run&);
/// What they may be called in runs of the case.
Names names_of_numbers(const Case&);
/// The finite ones with their errors, what is said of a whole run at the last sample time; of the case that the run's
/// leaf has. Of what gauges read the exact value is that of the elastic shock; of other solids it tells the arrival
/// alone, the elastic front being ahead of what comes after it.
std::vector<RunNumber> readings(const Case&, const reports::Run&);

/// Norms of the fields' errors, and the readings whose exact value is known.
std::vector<reports::TradeError> known_errors(const Case&, const reports::Run&);

/// Of readings whose exact value is not known, the errors against what the setting with the least uncertainty
/// extrapolates to, its uncertainty as their band. `of` holds each point's readings. Nothing where no setting of the
/// scene has meshes enough, or none whose uncertainty is less than a quarter of the value.
void add_extrapolated(const std::vector<std::vector<RunNumber>>& of, reports::Trade&);

}  // namespace diptych::runner
