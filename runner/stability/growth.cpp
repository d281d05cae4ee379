#include "runner/stability/growth.hpp"

#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>

namespace diptych::runner {

Growth growth_of(const std::vector<double>& energies, long stride, long ahead) {
  constexpr std::size_t windows = 10;
  const std::size_t begin = energies.size() / 2, count = energies.size() - begin;
  const std::size_t parts = std::min(windows, count);
  if (parts < 2) return {};
  std::vector<double> when, logs;
  for (std::size_t part = 0; part < parts; ++part) {
    const auto from = begin + part * count / parts, to = begin + (part + 1) * count / parts;
    double largest = 0;
    for (std::size_t k = from; k < to; ++k) largest = std::max(largest, energies[k]);
    if (!(largest > 0)) continue;  // has faded to nothing
    when.push_back(static_cast<double>(from + to - 1) / 2 * static_cast<double>(stride));
    logs.push_back(std::log(largest));
  }
  if (when.size() < 2) return {{}, false};
  double intercept = 0, slope = 0, c00 = 0, c01 = 0, c11 = 0, squares = 0;
  gsl_fit_linear(when.data(), 1, logs.data(), 1, when.size(), &intercept, &slope, &c00, &c01, &c11, &squares);
  return {slope / 2, slope * static_cast<double>(ahead) > std::log(growth_of_instability)};
}

}  // namespace diptych::runner
