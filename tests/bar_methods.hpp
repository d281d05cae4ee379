// The methods that bars are run with, by number: 0 is FEM, 1 to 3 are MPM's schemes.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "fem/bar.hpp"
#include "mpm/bar.hpp"

namespace diptych::tests {

inline constexpr std::array schemes{mpm::Scheme::usf, mpm::Scheme::usl, mpm::Scheme::musl};

/// `xi`: where the particles of a cell stand.
inline Record run_bars(int method, const Scene& scene, int cells, const Stepping& stepping,
                       const std::vector<double>& xi = {0.25, 0.75}) {
  return method == 0 ? fem::run(scene, cells, stepping)
                     : mpm::run(scene, cells, xi, schemes[static_cast<std::size_t>(method - 1)], stepping);
}

}  // namespace diptych::tests
