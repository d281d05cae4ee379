// What exact solutions ask of their parameters, and the time that never comes.
#pragma once

#include <cmath>
#include <limits>

namespace diptych::analytic {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline bool positive(double x) { return std::isfinite(x) && x > 0; }

}  // namespace diptych::analytic
