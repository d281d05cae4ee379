// A trade as text, CSV and JSON.
#pragma once

#include <string>

#include "reports/results.hpp"
#include "reports/trade_results.hpp"

namespace diptych::reports {

/// "3.1e-05 ± 2 %", with the unit after the number; "-" where it was not timed, and no spread of a single round.
std::string time_words(const Timed&, const char* unit = "");

/// One quantity at one time: a line a setting, the cheapest first; "front" where none is both cheaper and nearer.
std::string trade_text(const Trade&, const Aim&, Cost);
/// Every quantity at every time, one line each; a setting without errors has one line with its status.
std::string trade_csv(const Trade&);
/// The same as one JSON object, with the provenance.
std::string trade_json(const Trade&, const Provenance&);

}  // namespace diptych::reports
