// Fields of bars of particles at an instant, each at its own time level.
#pragma once

#include <algorithm>
#include <cstddef>

#include "hinge/step/record.hpp"
#include "mpm/bar.hpp"
#include "mpm/bar_particles.hpp"

namespace diptych::mpm::bars {

/// After n steps of Δt = dt [s].
template <class P>
Snapshot sample(const P& particles, const Scene& scene, Scheme scheme, double dt, long n) {
  const double time = static_cast<double>(n) * dt, half = dt / 2;
  const bool usf = scheme == Scheme::usf;
  Snapshot s;
  s.step = n;
  s.stress.time = usf ? std::max(time - half, half) : time;
  s.velocity.time = usf ? time : std::max(time - half, 0.0);
  s.displacement.time = usf ? time + half : time;
  s.stress.first.clear();
  for (std::size_t b = 0; b < particles.member.size(); ++b) {
    const std::size_t count = particles.member[b].last - particles.member[b].first;
    s.stress.first.push_back(particles.member[b].first);
    for (std::size_t k = 0; k <= count; ++k)
      s.stress.edges.push_back(scene.bars[b].begin + particles.share_depth(b, k));
    for (std::size_t k = 0; k < count; ++k) s.stress.x.push_back(particles.reference(b, k));
  }
  for (const auto& state : particles.state) s.stress.value.push_back(state.stress);
  s.velocity.first = s.displacement.first = s.stress.first;
  s.velocity.x = s.displacement.x = s.stress.x;
  s.velocity.value = particles.velocity;
  s.displacement.value = particles.displacement;
  return s;
}

}  // namespace diptych::mpm::bars
