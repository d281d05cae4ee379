// Runs of bars of particles. A law with a file of its own (bar_elastic.cpp, bar_hardening.cpp) is compiled there,
// beside the others; one without is compiled with bar.cpp, which only takes longer to build.
#pragma once

#include <vector>

#include "mpm/bar_step.hpp"

namespace diptych::mpm::bars {

/// Runs bars that have been checked; `laws` has one for each.
template <class Law>
Record run(const Scene& scene, const std::vector<Law>& laws, int cells, const std::vector<double>& positions,
           Scheme scheme, const Stepping& stepping) {
  const auto go = [&]<Carries carries, bool viscous>() {
    Bars<Law, carries, viscous> bars(scene, laws, cells, positions, scheme, stepping);
    return take_steps(bars, stepping);
  };
  const auto with = [&]<Carries carries>() {
    return material::acting(scene.viscosity) ? go.template operator()<carries, true>()
                                             : go.template operator()<carries, false>();
  };
  if (scene.convected) return with.template operator()<Carries::stretch>();
  if (scene.bars.size() > 1) return with.template operator()<Carries::cell>();
  return with.template operator()<Carries::nothing>();
}

extern template Record run(const Scene&, const std::vector<material::Elastic>&, int, const std::vector<double>&, Scheme,
                           const Stepping&);
extern template Record run(const Scene&, const std::vector<material::Hardening>&, int, const std::vector<double>&,
                           Scheme, const Stepping&);

}  // namespace diptych::mpm::bars
