// A trade as a figure: error over cost, both as powers of ten.
#pragma once

#include <string>

#include "reports/results.hpp"
#include "reports/trade_results.hpp"

namespace diptych::runner {

/// A panel over the updates and, where the settings were timed, one over the seconds: the meshes of a setting joined,
/// what theory predicts of them thin, the front under all, and lines at 10, 3, 1, 0.3 and 0.1 %.
reports::Figure work_precision(const reports::Trade&, const reports::Aim&, const std::string& id);

}  // namespace diptych::runner
