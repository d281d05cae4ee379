// Bisection of a limit about which nothing is known beforehand.
#pragma once

#include <functional>
#include <optional>

namespace diptych::runner {

/// Between which the limit lies.
struct Bracket {
  std::optional<double> stable;    ///< none: unstable at the least
  std::optional<double> unstable;  ///< none: stable at the most
};

/// From ¼ by doubling or halving to the first change, then by ratios until the two are one part in a thousand apart.
/// Nothing below `least` or above `most` is tried. Finds one limit where there are several.
Bracket bracket_limit(const std::function<bool(double)>& stable, double least, double most);

/// The same from both ends, of which 0 < least < most: for numbers of any size.
Bracket bracket_between(const std::function<bool(double)>& stable, double least, double most);

}  // namespace diptych::runner
