// The books of the plate: energies and momentum, step by step.
//
// With Fⁿ = −Σ A Bᵀσⁿ, the kick changes the kinetic energy by the work of the loads less ½ Σ A σⁿ:(εⁿ⁺¹ − εⁿ⁻¹). With
// the energy ψ of what can be got back and
//   Sⁿ⁺½ = Σ A [ψⁿ + ½ σⁿ:(εⁿ⁺¹ − εⁿ)]
// this is −Sⁿ⁺½ + Sⁿ⁻½ − Dⁿ, where Dⁿ = Sⁿ⁻½ − Σ A [ψⁿ − ½ σⁿ:(εⁿ − εⁿ⁻¹)] is nothing for a linear solid. Of it the
// material takes what damage takes at the least, the smaller of ψ(ε; C_dⁿ⁻¹) − ψ(ε; C_dⁿ) at both ends of the step,
// and what flows, σⁿ:Δε_p: neither is ever negative. The rest is what the trapezium of the leapfrog misses of the
// path between two steps, where cracks close, crack or flow in between: the scheme's.
//
// A failure wave has an energy, but its stress is not that energy's derivative, and neither is that of cracks which
// close whole: all of Dⁿ is the material's, and of either sign.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "fem/plate_border.hpp"
#include "fem/plate_material.hpp"
#include "fem/plate_mesh.hpp"
#include "fem/plate_viscosity.hpp"
#include "hinge/scene/scene.hpp"
#include "hinge/step/ledger.hpp"
#include "hinge/wide.hpp"

namespace diptych::fem {

/// The ledger has one number for a vector: its component along the diagonal.
inline double along_diagonal(const Vector& v) { return (v[0] + v[1]) / std::sqrt(2.0); }

/// Σ A [ψ + ½ σ:(ε' − ε)] of the triangles of each cell of a row [J/m]: ε where the step began and ε' where it ended,
/// or `back`, ψ and σ being those at ε.
template <bool back, class LawRow>
DIPTYCH_WIDE void energy_row(const CellRow& displacement, const CellRow& velocity, const CellSize& h, double dt,
                             Index cells, LawRow law, const material::Stiffness& solid, const StressRows& kept,
                             const unsigned char* __restrict own, double* __restrict out) {
  const CellRow u = displacement, v = velocity;
  const CellSize size = h;
  const material::Stiffness whole = solid;
  const auto stress_of = kept.triangle;
  const double area = h.triangle_area();
#pragma GCC ivdep
  for (Index i = 0; i < cells; ++i) {
    const Triangles now = strains(u[i], size), rate = strains(v[i], size);
    const bool is_own = own[i] != 0;
    const auto energy = [&](Index t) DIPTYCH_INLINE {
      const material::Tensor then = now[t] - rate[t] * dt;
      const material::Tensor here = back ? now[t] : then, there = back ? then : now[t];
      const material::Tensor of_whole = whole.stress(here), own_one = stress_of[t].template at<false>(i);
      const material::Tensor stress{is_own ? own_one.xx : of_whole.xx, is_own ? own_one.yy : of_whole.yy,
                                    is_own ? own_one.xy : of_whole.xy};
      return area * (stored_in(law, whole, here, i) + stress.contract(there - here) / 2);
    };
    out[i] = ((energy(0) + energy(1)) + energy(2)) + energy(3);
  }
}

template <solid::PlaneModel Model>
class PlateBooks {
  static constexpr bool by_rows = !Model::yields && !Model::linear && TellsEnergy<typename Model::Row>;

 public:
  PlateBooks(const Mesh& mesh, const Rows& rows, const Border& border, const CellStress& stress,
             const PlateMaterial<Model>& material, std::optional<ArtificialViscosity>& viscosity, double dt, bool kept)
      : mesh_(mesh),
        rows_(rows),
        border_(border),
        stress_(stress),
        material_(material),
        viscosity_(viscosity),
        dt_(dt),
        sums_(mesh.ny + 1) {
    if (Model::linear || !kept) return;
    recoverable_.resize(mesh.cells());
    own_before_.resize(mesh.cells());
    if (by_rows) after_.resize(mesh.cells());
  }

  double energy() const {
    double sum = 0;
    mesh_.for_cells([&](CellAt at) {
      const Triangles strain = mesh_.strain(at);
      for (Index t = 0; t < 4; ++t) sum += mesh_.h.triangle_area() * material_.stored(at.cell, t, strain[t]);
    });
    return sum + mesh_.motion().kinetic;
  }

  /// Work and impulse of loads and of what holds or drives the sides, once the nodes have moved.
  void keep_work(double kick, Ledger& ledger) const {
    const auto [before, after, force] = border_.external_work(kick);
    ledger.before_kick(before, along_diagonal(force), kick);
    ledger.after_kick(after, kick);
  }

  /// At σⁿ, εⁿ⁺¹ and vⁿ⁺½.
  void measure_energies(Ledger& ledger) {
    rows_.for_each([&](Index j) { sums_[j] = {mesh_.motion(j), recoverable(j)}; });
    sums_[mesh_.ny] = {mesh_.motion(mesh_.ny)};
    if (!Model::linear && ledger.keeps()) own_before_ = stress_.own;
    if (viscosity_) ledger.take_by_viscosity(viscosity_->work(dt_));
  }

  /// At σⁿ⁺¹, εⁿ⁺¹ and vⁿ⁺½.
  void close(Ledger& ledger) {
    RowSums sum;
    for (const RowSums& row : sums_) {
      sum.motion.add(row.motion);
      sum.strain += row.strain;
    }
    const double between = !Model::linear && ledger.keeps() ? dissipation() : 0;  // Dⁿ⁺¹
    Taken all;
    for (const Taken& row : material_.taken()) {
      all.by_damage += mesh_.h.triangle_area() * row.by_damage;
      all.by_flow += mesh_.h.triangle_area() * row.by_flow;
    }
    const bool has_potential = material_.model().has_potential();
    const double taken = has_potential ? all.by_damage + all.by_flow : between;
    const double spent = !Model::only_takes ? 0 : has_potential ? all.by_damage : between;
    const double viscous_after = viscosity_ ? viscosity_->work(dt_) : 0;
    ledger.close_line(sum.motion.kinetic, sum.strain, taken, along_diagonal(sum.motion.momentum), -viscous_after / 2,
                      spent);
    ledger.take_by_scheme(between - taken);
    ledger.take_by_viscosity(viscous_after);
  }

  Index bytes() const {
    return sums_.capacity() * sizeof(RowSums) + (recoverable_.capacity() + after_.capacity()) * sizeof(double) +
           own_before_.capacity();
  }

 private:
  /// Of a row of cells and of the nodes at its middle and bottom.
  struct RowSums {
    Motion motion;
    double strain = 0, dissipated = 0;
  };

  /// Sⁿ⁺½ of a row of cells [J/m].
  double recoverable(Index row) {
    double sum = 0;
    if (stress_.own.empty()) {  // for ever: a loop without a question, which the compiler takes two cells at a time
      mesh_.for_row(row, [&](CellAt at) {
        const Triangles now = mesh_.strain(at), here = before(at, now);
        sum += energy_between(at.cell, here, now, [&](Index t) { return stress_.solid.stress(here[t]); });
      });
      return sum;
    }
    if constexpr (by_rows) {
      if (!recoverable_.empty()) {
        energies<false>(row, recoverable_);
        mesh_.for_row(row, [&](CellAt at) { sum += recoverable_[at.cell]; });
        return sum;
      }
    }
    mesh_.for_row(row, [&](CellAt at) {
      const Triangles now = mesh_.strain(at);
      const double energy = energy_between(at.cell, before(at, now), now);
      if (!recoverable_.empty()) recoverable_[at.cell] = energy;
      sum += energy;
    });
    return sum;
  }
  template <bool back>
  void energies(Index row, std::vector<double>& out) const {
    const Index first = row * mesh_.nx;
    energy_row<back>(mesh_.displacements({first, row}), mesh_.velocities({first, row}), mesh_.h, dt_, mesh_.nx,
                     material_.model().row(first, 4 * first), stress_.solid, stress_.rows(first), &stress_.own[first],
                     &out[first]);
  }
  /// Strains of a cell where the step began that ended with these.
  Triangles before(CellAt at, const Triangles& now) const {
    Triangles strain = mesh_.strain_rate(at);
    for (Index t = 0; t < 4; ++t) strain[t] = now[t] - strain[t] * dt_;
    return strain;
  }
  /// Σ A [ψ + ½ σ:(ε − ε here)] of the triangles of a cell, ψ and σ where it stands, at the strains `here` [J/m].
  double energy_between(Index cell, const Triangles& here, const Triangles& strain) const {
    if (stress_.is_own(cell))
      return energy_between(cell, here, strain, [&](Index t) { return stress_.stress[t][cell]; });
    return energy_between(cell, here, strain, [&](Index t) { return stress_.solid.stress(here[t]); });
  }
  template <class Stress>
  double energy_between(Index cell, const Triangles& here, const Triangles& strain, const Stress& stress) const {
    double sum = 0;
    for (Index t = 0; t < 4; ++t)
      sum +=
          mesh_.h.triangle_area() * (material_.stored(cell, t, here[t]) + stress(t).contract(strain[t] - here[t]) / 2);
    return sum;
  }
  double dissipation() {
    rows_.for_each([&](Index j) {
      sums_[j].dissipated = 0;
      if constexpr (by_rows) energies<true>(j, after_);
      mesh_.for_row(j, [&](CellAt at) {
        if (!stress_.is_own(at.cell) && !own_before_[at.cell]) return;
        const auto after = [&] {
          if (by_rows) return after_[at.cell];
          const Triangles now = mesh_.strain(at);
          return energy_between(at.cell, now, before(at, now));
        };
        sums_[j].dissipated += recoverable_[at.cell] - after();
      });
    });
    double sum = 0;
    for (const RowSums& row : sums_) sum += row.dissipated;
    return sum;
  }

  const Mesh& mesh_;
  const Rows& rows_;
  const Border& border_;
  const CellStress& stress_;
  const PlateMaterial<Model>& material_;
  std::optional<ArtificialViscosity>& viscosity_;
  double dt_;
  std::vector<RowSums> sums_;              // per row, and the top row of nodes
  std::vector<double> recoverable_;        // per cell, where the solid may change [J/m]
  std::vector<double> after_;              // likewise: what of it is left
  std::vector<unsigned char> own_before_;  // likewise: CellStress::own before the step's update
};

}  // namespace diptych::fem
