// What the gates of all cases come to, in words: which failed and by what, what took long, and what nobody looked at.
#pragma once

#include <string>
#include <vector>

#include "reports/results.hpp"

namespace diptych::reports {

/// Each gate that did not pass: its name, the number furthest outside of its band or the message, and where it is
/// declared. Empty where all passed.
std::string failures_text(const std::vector<Case>&);

/// How many gates of each kind passed where each feature was active: a table, feature × kind. What has none is not
/// verified in that way.
std::string verified_text(const std::vector<Case>&);

/// The cases whose runs took longest, up to `most` of them, with their slowest run. Runs that were taken from a store
/// count with what they once took.
std::string durations_text(const std::vector<Case>&, int most);

}  // namespace diptych::reports
