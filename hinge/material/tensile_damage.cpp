#include "hinge/material/tensile_damage.hpp"

#include <cmath>

namespace diptych::material {

namespace {

/// xⁿ by squaring, n ≥ 0.
double whole_power(double x, unsigned n) {
  double power = 1;
  for (; n > 0; n >>= 1U, x *= x)
    if ((n & 1U) != 0) power *= x;
  return power;
}

}  // namespace

double CrackGrowth::operator()(double volumetric_strain, double strain_rate) const {
  constexpr double most = 64;  // a sixth of the time, as long as few factors are needed; their round-off is below 2e-14
  const bool whole = exponent >= 0 && exponent <= most && exponent == std::floor(exponent);
  const double power =
      whole ? whole_power(volumetric_strain, static_cast<unsigned>(exponent)) : std::pow(volumetric_strain, exponent);
  return coefficient * power / (strain_rate * strain_rate);
}

double TensileDamage::crack_coefficient() const {
  const double ratio = fracture_toughness / (elastic.density * elastic.uniaxial_wave_speed());
  return 2.5 * flaw_density * ratio * ratio;
}

double TensileDamage::crack_density(double volumetric_strain, double strain_rate) const {
  return volumetric_strain <= 0 ? 0 : crack_growth()(volumetric_strain, strain_rate);
}

}  // namespace diptych::material
