// What self-tests of exact solutions are made of.
#pragma once

#include <cmath>

namespace diptych::analytic {

/// Keeps the larger violation. NaN wins and stays: std::max would lose it.
inline void note(double& worst, double violation) {
  if (!std::isnan(worst) && !(std::abs(violation) <= worst)) worst = std::abs(violation);
}

/// Central difference of sixth order; exact for polynomials, and to round-off for waves much longer than d.
template <class F>
double derivative(const F& f, double x, double d) {
  return (45 * (f(x + d) - f(x - d)) - 9 * (f(x + 2 * d) - f(x - 2 * d)) + (f(x + 3 * d) - f(x - 3 * d))) / (60 * d);
}

}  // namespace diptych::analytic
