// The law of failure_wave.hpp, for the loops that it is built into: the other header says what each means. Nothing is
// asked before it is computed, so that a loop takes several points at once.
#pragma once

#include <cmath>

#include "hinge/material/failure_wave.hpp"

namespace diptych::material {

[[gnu::always_inline]] inline Stiffness FailureWave::whole() const {
  return material::stiffness(elastic.youngs_modulus, elastic.poissons_ratio, Plane::strain);
}

[[gnu::always_inline]] inline double FailureWave::pressure(const Tensor& strain) const {
  return -elastic.bulk_modulus() * (strain.xx + strain.yy);
}

[[gnu::always_inline]] inline double FailureWave::shear_energy(const Tensor& strain) const {
  const double third = (strain.xx + strain.yy) / 3, x = strain.xx - third, y = strain.yy - third;
  return whole().shear * (x * x + y * y + third * third + 2 * (strain.xy * strain.xy));
}

[[gnu::always_inline]] inline double FailureWave::equivalent_stress(const Tensor& strain) const {
  return std::sqrt(6 * whole().shear * shear_energy(strain));
}

[[gnu::always_inline]] inline double FailureWave::ceiling(const Tensor& strain) const {
  const double K = elastic.bulk_modulus(), p = pressure(strain), W = shear_energy(strain);
  const double root = (std::sqrt(p * p + 2 * K * most_converted * W) - p) / K;
  return p <= 0 ? 0 * W : root;  // NaN stays it
}

[[gnu::always_inline]] inline double FailureWave::open_ceiling(const Tensor& strain) const {
  const double open = ceiling(strain);
  return equivalent_stress(strain) <= threshold ? 0 : open;
}

[[gnu::always_inline]] inline double FailureWave::converted(const Tensor& strain, double dilatancy) const {
  const double raised = dilatancy * (2 * pressure(strain) + elastic.bulk_modulus() * dilatancy);
  const double f = raised / (2 * shear_energy(strain));
  const double least = f < 0 ? 0 : f, part = f > most_converted ? most_converted : least;  // NaN stays it
  return dilatancy == 0 ? 0 : part;
}

[[gnu::always_inline]] inline Tensor FailureWave::stress(const Tensor& strain, double dilatancy) const {
  const Tensor elastic_stress = whole().stress(strain);
  const double kept = 2 * whole().shear * std::sqrt(1 - converted(strain, dilatancy));
  const double third = (strain.xx + strain.yy) / 3;
  const double mean = elastic.bulk_modulus() * (3 * third - dilatancy);
  const Tensor failed{mean + kept * (strain.xx - third), mean + kept * (strain.yy - third), kept * strain.xy};
  const bool none = dilatancy == 0;
  return {none ? elastic_stress.xx : failed.xx, none ? elastic_stress.yy : failed.yy,
          none ? elastic_stress.xy : failed.xy};
}

[[gnu::always_inline]] inline double FailureWave::stored(const Tensor& strain, double dilatancy) const {
  const double K = elastic.bulk_modulus(), p = pressure(strain) + K * dilatancy;
  return p * p / (2 * K) + (1 - converted(strain, dilatancy)) * shear_energy(strain);
}

}  // namespace diptych::material
