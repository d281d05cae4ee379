// What the ledger is told of bars of elements, and of the contacts between them.
#pragma once

#include <vector>

#include "fem/bar_mesh.hpp"
#include "hinge/step/ledger.hpp"

namespace diptych::fem {

/// Force of the tractions on the outer end nodes [N].
struct EndForces {
  double left = 0, right = 0;
};

template <class Mesh>
class BarBooks {
 public:
  BarBooks(const Scene& scene, const std::vector<Mesh>& meshes, const std::vector<Pair>& pairs, const EndForces& load)
      : scene_(scene), meshes_(meshes), pairs_(pairs), load_(load) {}

  void before_kick(double kick, Ledger& ledger) const {
    ledger.before_kick(work_rate(), impulse_rate(), kick);
    ledger.take_by_contact(-kick * contact_work_rate() / 2);
  }
  void after_kick(double kick, Ledger& ledger) const {
    ledger.after_kick(work_rate(), kick);
    ledger.take_by_contact(-kick * contact_work_rate() / 2);
  }

  void close_line(const StressWork& work, Ledger& ledger) const {
    double kinetic = 0;
    for (const Mesh& mesh : meshes_) kinetic += mesh.kinetic_energy();
    ledger.take_by_viscosity(work.viscous_before);
    ledger.close_line(kinetic, work.strain, work.dissipated, momentum(), -work.viscous_after / 2);
    ledger.take_by_viscosity(work.viscous_after);
    ledger.take_by_scheme(work.lost);
  }

  /// Kinetic and stored.
  double energy() const {
    double sum = 0;
    for (const Mesh& mesh : meshes_) sum += mesh.kinetic_energy() + mesh.stored_energy();
    return sum;
  }
  double momentum() const {
    double sum = 0;
    for (const Mesh& mesh : meshes_) sum += mesh.momentum();
    return sum;
  }
  /// Of bars that no support holds; 0 if one does.
  double free_mass() const {
    double sum = 0;
    if (scene_.left == Support::free && scene_.right == Support::free) {
      for (const Mesh& mesh : meshes_) sum += mesh.mass();
    }
    return sum;
  }

 private:
  double work_rate() const {
    double sum = load_.left * first().velocity_at(0) + load_.right * last().velocity_at(last().cells());
    for (const Mesh& mesh : meshes_) sum += mesh.body_work_rate();
    return sum;
  }

  double contact_work_rate() const {
    double sum = 0;
    for (const Pair& pair : pairs_) {
      const Mesh &a = meshes_[pair.left()], &b = meshes_[pair.left() + 1];
      sum += pair.force() * (b.velocity_at(0) - a.velocity_at(a.cells()));
    }
    return sum;
  }

  /// Loads plus reactions: a support takes up whatever force stands at its node.
  double impulse_rate() const {
    double sum = load_.left + load_.right;
    for (const Mesh& mesh : meshes_) sum += mesh.body_impulse_rate();
    if (scene_.left == Support::fixed) sum -= first().force_at(0);
    if (scene_.right == Support::fixed) sum -= last().force_at(last().cells());
    return sum;
  }

  const Mesh& first() const { return meshes_.front(); }
  const Mesh& last() const { return meshes_.back(); }

  const Scene& scene_;
  const std::vector<Mesh>& meshes_;
  const std::vector<Pair>& pairs_;
  const EndForces& load_;
};

}  // namespace diptych::fem
