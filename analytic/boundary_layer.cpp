#include "analytic/boundary_layer.hpp"

#include <algorithm>
#include <stdexcept>

namespace diptych::analytic {

double end_stress_share(const std::vector<double>& distances, double thickness) {
  if (distances.empty() || !(thickness > 0))
    throw std::invalid_argument("a boundary layer needs particles and a thickness > 0");
  const double piece = 1 / static_cast<double>(distances.size());  // of the cell, one particle's share
  double share = 0;
  for (std::size_t p = 0; p < distances.size(); ++p) {
    const double filled = std::clamp(thickness - static_cast<double>(p) * piece, 0.0, piece) / thickness;
    share += filled * (1 - distances[p]);
  }
  return share;
}

}  // namespace diptych::analytic
