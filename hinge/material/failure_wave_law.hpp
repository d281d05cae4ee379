// The law of failure_wave.hpp, for the loops that it is built into: the other header says what each means.
#pragma once

#include <cmath>

#include "hinge/material/failure_wave.hpp"

namespace diptych::material {

inline double FailureWave::pressure(const Tensor& strain) const {
  return -elastic.bulk_modulus() * (strain.xx + strain.yy);
}

inline double FailureWave::shear_energy(const Tensor& strain) const {
  const double third = (strain.xx + strain.yy) / 3, x = strain.xx - third, y = strain.yy - third;
  return elastic.stiffness().shear * (x * x + y * y + third * third + 2 * (strain.xy * strain.xy));
}

inline double FailureWave::equivalent_stress(const Tensor& strain) const {
  return std::sqrt(6 * elastic.stiffness().shear * shear_energy(strain));
}

inline double FailureWave::ceiling(const Tensor& strain) const {
  const double K = elastic.bulk_modulus(), p = pressure(strain), W = shear_energy(strain);
  if (p <= 0) return 0 * W;  // NaN stays it
  return (std::sqrt(p * p + 2 * K * most_converted * W) - p) / K;
}

inline double FailureWave::open_ceiling(const Tensor& strain) const {
  return equivalent_stress(strain) <= threshold ? 0 : ceiling(strain);
}

inline double FailureWave::converted(const Tensor& strain, double dilatancy) const {
  if (dilatancy == 0) return 0;
  const double raised = dilatancy * (2 * pressure(strain) + elastic.bulk_modulus() * dilatancy);
  const double f = raised / (2 * shear_energy(strain));
  return f > most_converted ? most_converted : f < 0 ? 0 : f;  // this order keeps NaN
}

inline Tensor FailureWave::stress(const Tensor& strain, double dilatancy) const {
  if (dilatancy == 0) return elastic.stiffness().stress(strain);
  const double kept = 2 * elastic.stiffness().shear * std::sqrt(1 - converted(strain, dilatancy));
  const double third = (strain.xx + strain.yy) / 3;
  const double mean = elastic.bulk_modulus() * (3 * third - dilatancy);
  return {mean + kept * (strain.xx - third), mean + kept * (strain.yy - third), kept * strain.xy};
}

inline double FailureWave::stored(const Tensor& strain, double dilatancy) const {
  const double K = elastic.bulk_modulus(), p = pressure(strain) + K * dilatancy;
  return p * p / (2 * K) + (1 - converted(strain, dilatancy)) * shear_energy(strain);
}

}  // namespace diptych::material
