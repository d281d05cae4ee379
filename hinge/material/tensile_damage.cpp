#include "hinge/material/tensile_damage.hpp"

#include <algorithm>
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

double TensileDamage::damaged_poissons_ratio(double crack_density) const {
  return elastic.poissons_ratio * std::max(1 - alpha() * crack_density, 0.0);
}

double TensileDamage::damage(double crack_density) const {
  const double nu = damaged_poissons_ratio(crack_density);
  return std::min(16 * (1 - nu * nu) / (9 * (1 - 2 * nu)) * crack_density, 1.0);  // this order keeps NaN
}

double TensileDamage::damaged_bulk_modulus(double crack_density) const {
  return std::max(1 - damage(crack_density), residual_stiffness) * elastic.bulk_modulus();
}

double TensileDamage::damaged_shear_modulus(double crack_density) const {
  const double nu = damaged_poissons_ratio(crack_density), whole = elastic.shear_modulus();
  const double shear = 1.5 * (1 - damage(crack_density)) * elastic.bulk_modulus() * (1 - 2 * nu) / (1 + nu);
  return std::min(std::max(shear, residual_stiffness * whole), whole);
}

CrackedStiffness TensileDamage::damaged_stiffness(double crack_density) const {
  const Stiffness whole = elastic.stiffness();
  if (crack_density == 0) return {whole, whole};
  const double shear = damaged_shear_modulus(crack_density);
  const auto with_bulk = [&](double bulk) { return stiffness_of_moduli(bulk, shear, elastic.plane); };
  return {with_bulk(damaged_bulk_modulus(crack_density)),
          closure == Closure::whole ? whole : with_bulk(elastic.bulk_modulus())};
}

}  // namespace diptych::material
