#include "mpm/bar.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "mpm/bar_run.hpp"

namespace diptych::mpm {
namespace {

/// Courant number up to which a bar with these natural coordinates in every cell is stable.
double courant_limit(const std::vector<double>& positions, Scheme scheme, bool convected) {
  const auto count = static_cast<double>(positions.size());
  double mean = 0, filter = 0;
  for (const double xi : positions) {
    mean += xi / count;
    filter += 4 * xi * (1 - xi) / count;
  }
  // The end cell of a free bar may limit first: its two nodes carry the shares x̄ and 1 − x̄ of the cell's mass alone.
  const double spread = mean * (1 - mean), gradient_kept = spread > 0 ? std::max(0.0, 1 - filter / (4 * spread)) : 0;
  if (scheme == Scheme::usl) return std::min(2 * std::sqrt(spread / (2 - gradient_kept)), 1 / std::sqrt(1 + filter));
  if (convected) return 1;  // reached when every particle stands on a node
  const double q = filter > 0.5 ? 1 / (2 * filter) : 1, inside = 1 / std::sqrt(q * (1 - filter * q));
  return gradient_kept > 0 ? std::min(inside, 2 * std::sqrt(spread / gradient_kept)) : inside;
}

}  // namespace

double critical_time_step(const Scene& scene, int cells, const std::vector<double>& positions, Scheme scheme) {
  const double h = scene.bars[0].length / cells, fastest = largest_wave_speed(scene);
  const double jump = initial_velocity_jump(scene);
  double least = std::numeric_limits<double>::infinity();
  for (const Bar& bar : scene.bars) {
    const double speed = material::wave_speed(bar.material), begin = (bar.begin - scene.begin()) / h;
    const double shift = std::abs(begin - std::round(begin)) < 1e-9 ? 0 : begin - std::floor(begin);
    std::vector<double> there;
    for (const double xi : positions) there.push_back(xi + shift > 1 ? xi + shift - 1 : xi + shift);
    double courant = courant_limit(there, scheme, scene.convected);
    if (scene.viscosity) {
      const bool york = scene.viscosity->form == material::Viscosity::Form::york;
      courant = with_viscosity(courant, scene.viscosity->strength(speed, jump) * (york ? fastest / speed : 1));
    }
    least = std::min(least, courant * h / speed);
  }
  return least;
}

Record run(const Scene& scene, int cells, const std::vector<double>& positions, Scheme scheme,
           const Stepping& stepping) {
  if (cells < 1 || positions.empty()) throw std::invalid_argument("mpm needs at least one cell and one particle");
  for (std::size_t b = 1; b < scene.bars.size(); ++b) {
    const double size = scene.bars[b].length / (scene.bars[0].length / cells);
    if (std::abs(size - cells_of(scene, b, cells)) > 1e-9 * size)
      throw std::invalid_argument("mpm: bar " + std::to_string(b + 1) + " is not a whole number of cells long");
  }
  const double span = (scene.end() - scene.begin()) / (scene.bars[0].length / cells);
  if (scene.right == Support::fixed && std::abs(span - std::round(span)) > 1e-9 * span)
    throw std::invalid_argument(
        "mpm: a wall at the right end must stand on a face of the grid, a whole number of cells "
        "from the left end of the first bar");
  return std::visit([&](const auto& laws) { return bars::run(scene, laws, cells, positions, scheme, stepping); },
                    laws(scene));
}

}  // namespace diptych::mpm
