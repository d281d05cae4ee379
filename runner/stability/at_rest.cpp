#include "runner/stability/at_rest.hpp"

#include <bit>
#include <cstdint>

namespace diptych::runner {
namespace {

/// Mixes all bits of a number into all of the answer's: the finaliser of splitmix64, after Steele, Lea and Flood
/// (2014).
std::uint64_t mixed(std::uint64_t bits) {
  bits += 0x9e3779b97f4a7c15U;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9U;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebU;
  return bits ^ (bits >> 31);
}

}  // namespace

double noise_at(double x, double y, unsigned which) {
  const std::uint64_t bits = mixed(std::bit_cast<std::uint64_t>(x) ^ mixed(std::bit_cast<std::uint64_t>(y) ^ which));
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1;
}

Scene at_rest(const Scene& scene) {
  Scene out = scene;
  out.loads.clear();
  out.body_force = {};
  for (Bar& bar : out.bars) {
    bar.initial_stress = {};
    bar.initial_velocity = [speed = seed * material::wave_speed(bar.material)](double x) {
      return speed * noise_at(x, 0, 0);
    };
  }
  return out;
}

Plate at_rest(const Plate& plate) {
  Plate out = plate;
  for (Edge& edge : out.edges) {
    edge.normal_traction = edge.shear_traction = {};
    if (edge.support == Edge::Support::driven) edge.support = Edge::Support::fixed;
    edge.velocity = {};
  }
  out.body_force = {};
  out.initial_displacement = {};
  out.impact = {};
  out.gauges.clear();
  out.initial_velocity = [speed = seed * elastic(plate).pressure_wave_speed()](double x, double y) {
    return Vector{speed * noise_at(x, y, 0), speed * noise_at(x, y, 1)};
  };
  return out;
}

DiffusionScene at_rest(const DiffusionScene& scene) {
  DiffusionScene out = scene;
  out.rate = {};
  out.corner_rate = 0;
  out.initial = [](double x, double y) { return noise_at(x, y, 0); };
  return out;
}

}  // namespace diptych::runner
