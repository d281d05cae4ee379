#include <cmath>

#include "hinge/material/failure_wave_law.hpp"

namespace diptych::material {

double FailureWave::stiffening() const {
  const double a = 0.75 * elastic.bulk_modulus() / elastic.stiffness().shear;
  const double f = most_converted > 0.9 ? 0.9 : most_converted;  // this order keeps NaN
  const double r = std::sqrt(1 + f / a) - 1, kept = std::sqrt(1 - f);
  return (a + (kept + a * (r + r * r) / kept)) / (a + 1);
}

}  // namespace diptych::material
