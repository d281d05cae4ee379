// A trade as a figure that is fair to methods of different size: what accuracy a second buys.
#pragma once

#include <string>

#include "reports/results.hpp"
#include "reports/trade_results.hpp"

namespace diptych::runner {

/// Digits of efficacy, −log10(error × cost), over digits of size, log10 of the unknowns that move: of the
/// time-accuracy-size spectrum (Chang, Fabien, Knepley & Mills, SIAM J. Sci. Comput. 40, 2018, C779). Of two settings
/// with as many unknowns, the higher one gives more accuracy for its cost. The cost is in seconds where runs were
/// timed, else in updates.
reports::Figure efficacy(const reports::Trade&, const reports::Aim&, const std::string& id);

}  // namespace diptych::runner
