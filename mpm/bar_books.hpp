// What the schemes take of a bar's energy, for the ledger.
#pragma once

#include <cstddef>
#include <vector>

#include "hinge/step/ledger.hpp"
#include "mpm/bar.hpp"
#include "mpm/bar_particles.hpp"

namespace diptych::mpm::bars {

/// Energies of one update of the stress, summed over the particles [J].
struct StressWork {
  double strain = 0, dissipated = 0;
  double lost = 0;                               ///< by the trapezium of the leapfrog across a yield point
  double viscous_before = 0, viscous_after = 0;  ///< halves of the viscosity's work
  double half_before = 0, half_after = 0;        ///< of the whole stress on half of the strain
};

template <class P>
class BarBooks {
 public:
  BarBooks(const P& particles, const Grid& grid, Scheme scheme, double dt)
      : particles_(particles), grid_(grid), scheme_(scheme), dt_(dt) {}

  /// What the scheme takes on its way from one map to the next. The stress was updated with one map's velocities, half
  /// of its work on that strain stands in the strain energy, and the other half is done by the internal forces with the
  /// particles' new stretches, places and velocities. The two cancel where nothing moved in between.
  void account_for_remapping(Ledger& ledger) const {
    if (!ledger.keeps() || (!P::convected && scheme_ != Scheme::usl)) return;
    const double power = grid_.power();
    ledger.take_by_scheme(-(dt_ * power / 2 + half_work_));
  }

  void before_kick(double kick, Ledger& ledger) const {
    ledger.before_kick(grid_.work_rate(), grid_.impulse_rate(), kick);
  }
  void after_kick(double kick, Ledger& ledger) const { ledger.after_kick(grid_.work_rate(), kick); }

  /// USF: the work of the kick's second half, at the places where its forces were found, with the particles' new
  /// velocities on the grid.
  void after_kick_of_usf(double kick, Ledger& ledger) {
    const double external = grid_.work_rate();
    ledger.after_kick(external, kick);
    double power = -external;
    for (const Node& node : grid_.reached()) power += node.force * node.velocity;
    half_work_of_kick_ = kick * power / 2;
  }

  /// USL strains with the grid's own velocities w⁺ = P v⁻ + τ a, while its particles take up N a, of which the next map
  /// leaves P N a. So its loads work on the way from w⁻ to w⁺; what they would have done from P v⁻ on is the scheme's.
  void before_kick_of_usl(double kick, Ledger& ledger) const {
    const double mapped = grid_.work_rate();
    double own = mapped;
    if (!kicked_.empty()) {
      own = grid_.work_rate([&](std::size_t i) { return kicked_[i]; });
    }
    ledger.before_kick(own, grid_.impulse_rate(), kick);
    ledger.take_by_scheme(kick * (own - mapped) / 2);
  }
  void keep_velocities_of_usl() {
    kicked_.resize(grid_.node.size());
    for (std::size_t i = 0; i < grid_.node.size(); ++i) kicked_[i] = grid_.node[i].velocity;
  }

  /// USL's kick does τ²/2 Σ m a² of work on the grid with lumped masses; particles take up less of it, D = Σ m a² less
  /// their part. H of the leapfrog then falls by τ²/2 aⁿ·D(aⁿ + aⁿ⁻¹) in a step, so that H + τ²/4 a·D a never grows:
  /// of what the scheme takes it gives so much back.
  void account_for_lumping(double kick, Ledger& ledger) {
    if (!ledger.due()) return;
    double grid = 0, particles = 0;
    for (const Node& node : grid_.reached()) grid += node.mass * node.acceleration * node.acceleration;
    const std::vector<double>& offset = particles_.offset;
    particles_.for_each(grid_.node, [&](std::size_t p, const Node& left, const Node& right) {
      const double a = (0.5 - offset[p]) * left.acceleration + (0.5 + offset[p]) * right.acceleration;
      particles += particles_.mass(p) * a * a;
    });
    const double taken = kick * kick / 2 * (grid - particles);
    ledger.take_by_scheme(taken);
    lent_ = taken / 2;
  }

  void close_line(const StressWork& work, Ledger& ledger) {
    ledger.take_by_viscosity(work.viscous_before);
    if (P::convected && scheme_ == Scheme::usf) ledger.take_by_scheme(-(half_work_of_kick_ + work.half_before));
    ledger.close_line(particles_.kinetic_energy(), work.strain, work.dissipated, particles_.momentum(),
                      lent_ - work.viscous_after / 2);
    ledger.take_by_viscosity(work.viscous_after);
    ledger.take_by_scheme(work.lost);
    half_work_ = work.half_after;
  }

 private:
  const P& particles_;
  const Grid& grid_;
  Scheme scheme_;
  double dt_;
  double half_work_ = 0, half_work_of_kick_ = 0, lent_ = 0;
  std::vector<double> kicked_;  // velocities of the nodes after the last kick, only with USL
};

}  // namespace diptych::mpm::bars
