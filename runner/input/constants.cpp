#include "runner/input/constants.hpp"

#include <numbers>

namespace diptych::runner {
namespace {

std::map<std::string, double> plate_constants(const Case& c) {
  std::map<std::string, double> constants = c.parameters;
  constants["Lx"] = c.plate->width;
  constants["Ly"] = c.plate->height;
  constants["pi"] = std::numbers::pi;
  if (!c.plate->solid) return constants;
  const material::PlaneElastic& elastic = elastic_of(*c.plate);
  constants["E"] = elastic.youngs_modulus;
  constants["nu"] = elastic.poissons_ratio;
  constants["rho"] = elastic.density;
  constants["c"] = elastic.uniaxial_wave_speed();
  constants["c_d"] = elastic.pressure_wave_speed();
  constants["c_s"] = elastic.shear_wave_speed();
  return constants;
}

}  // namespace

std::map<std::string, double> expression_constants(const Case& c) {
  if (c.plate) return plate_constants(c);
  std::map<std::string, double> constants = c.parameters;
  constants["L"] = c.first().length;
  constants["E"] = material::youngs_modulus(c.first().material);
  constants["rho"] = material::density(c.first().material);
  constants["c"] = material::wave_speed(c.first().material);
  constants["pi"] = std::numbers::pi;
  return constants;
}

}  // namespace diptych::runner
