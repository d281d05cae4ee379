#include "runner/stability/bracket.hpp"

#include <algorithm>
#include <cmath>

namespace diptych::runner {

Bracket bracket_limit(const std::function<bool(double)>& stable, double least, double most) {
  constexpr double begin = 0.25, apart = 1e-3;
  double at = std::clamp(begin, least, most);
  Bracket found;
  const bool upwards = stable(at);
  if (upwards) {
    found.stable = at;
    while (!found.unstable && at < most) {
      at = std::min(2 * at, most);
      (stable(at) ? found.stable : found.unstable) = at;
    }
  } else {
    found.unstable = at;
    while (!found.stable && at > least) {
      at = std::max(at / 2, least);
      (stable(at) ? found.stable : found.unstable) = at;
    }
  }
  while (found.stable && found.unstable && *found.unstable > (1 + apart) * *found.stable) {
    const double middle = std::sqrt(*found.stable * *found.unstable);
    (stable(middle) ? found.stable : found.unstable) = middle;
  }
  return found;
}

}  // namespace diptych::runner
