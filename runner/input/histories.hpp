// Tractions over time as their means over an interval, which give a body its exact impulse wherever they begin or end.
#pragma once

#include <functional>
#include <string>

#include "runner/input/expression.hpp"

namespace diptych::runner {

/// "step": amplitude from `start` on. "ramp": rises from 0 at `start` over `rise`. "impulse": a step for `duration`.
/// Times in seconds.
struct LoadHistory {
  std::string kind;
  double amplitude = 0, start = 0, rise = 0, duration = 0;
};
std::function<double(double from, double to)> mean_over(const LoadHistory&);
/// Of an expression of t: Simpson's rule, exact for cubics.
std::function<double(double from, double to)> mean_over(const Expression&);

}  // namespace diptych::runner
