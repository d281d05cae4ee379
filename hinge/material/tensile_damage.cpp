#include "hinge/material/tensile_damage.hpp"

#include <cmath>

namespace diptych::material {

double CrackGrowth::operator()(double volumetric_strain, double strain_rate) const {
  return coefficient * std::pow(volumetric_strain, exponent) / (strain_rate * strain_rate);
}

double TensileDamage::crack_coefficient() const {
  const double ratio = fracture_toughness / (elastic.density * elastic.uniaxial_wave_speed());
  return 2.5 * flaw_density * ratio * ratio;
}

double TensileDamage::crack_density(double volumetric_strain, double strain_rate) const {
  return volumetric_strain <= 0 ? 0 : crack_growth()(volumetric_strain, strain_rate);
}

}  // namespace diptych::material
