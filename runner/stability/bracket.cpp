#include "runner/stability/bracket.hpp"

#include <algorithm>
#include <cmath>

namespace diptych::runner {
namespace {

/// By ratios, until the two ends are one part in a thousand apart.
void narrow(const std::function<bool(double)>& stable, Bracket& found) {
  constexpr double apart = 1e-3;
  while (found.stable && found.unstable && *found.unstable > (1 + apart) * *found.stable) {
    const double middle = std::sqrt(*found.stable * *found.unstable);
    (stable(middle) ? found.stable : found.unstable) = middle;
  }
}

}  // namespace

Bracket bracket_limit(const std::function<bool(double)>& stable, double least, double most) {
  constexpr double begin = 0.25;
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
  narrow(stable, found);
  return found;
}

Bracket bracket_between(const std::function<bool(double)>& stable, double least, double most) {
  Bracket found;
  (stable(least) ? found.stable : found.unstable) = least;
  if (!found.stable) return found;
  (stable(most) ? found.stable : found.unstable) = most;
  narrow(stable, found);
  return found;
}

}  // namespace diptych::runner
