// How many steps a run of a test takes, and when it is sampled.
#pragma once

#include <utility>
#include <vector>

#include "hinge/scene/scene.hpp"

namespace diptych::tests {

inline Stepping steps_of(double time_step, long steps, std::vector<long> samples, Books books = Books::lines) {
  Stepping stepping;
  stepping.time_step = time_step;
  stepping.steps = steps;
  stepping.sample_after = std::move(samples);
  stepping.books = books;
  return stepping;
}

/// With a sample after the last.
inline Stepping steps_of(double time_step, long steps, Books books = Books::lines) {
  return steps_of(time_step, steps, std::vector<long>{steps}, books);
}

}  // namespace diptych::tests
