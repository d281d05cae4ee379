// Fields as plain numbers: made at random, and how far apart two of them are.
#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

namespace diptych::tests {

inline std::vector<double> random_values(std::size_t count, unsigned seed, double low = 0, double high = 1) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> draw(low, high);
  std::vector<double> values(count);
  for (double& v : values) v = draw(generator);
  return values;
}

/// NaN where one of them has it.
inline double largest_difference(std::span<const double> a, std::span<const double> b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double difference = std::abs(a[k] - b[k]);
    if (!(difference <= largest)) largest = difference;
  }
  return largest;
}

}  // namespace diptych::tests
