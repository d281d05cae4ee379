// The plate's solid on the mesh: four points a cell, the triangles.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "fem/plate_mesh.hpp"
#include "fem/plate_stress.hpp"
#include "hinge/scene/plate.hpp"
#include "hinge/solid/plane_model.hpp"
#include "hinge/wide.hpp"

namespace diptych::fem {

/// What the material has taken in a step [J/m³].
struct Taken {
  double by_damage = 0, by_flow = 0;
};

/// What each cell's mean strain shows to what changes in cells.
template <class Driver>
DIPTYCH_WIDEST void drive_row(const CellRow& displacement, const CellSize& h, Index cells, Driver driver,
                              double* __restrict out) {
  const CellRow u = displacement;
  const CellSize size = h;
#pragma GCC ivdep
  for (Index i = 0; i < cells; ++i) out[i] = driver(mean_strain(u[i], size));
}

/// Stresses of the triangles of a run of cells.
template <class LawRow>
DIPTYCH_WIDEST void stress_row(const CellRow& displacement, const CellSize& h, Index cells, LawRow law,
                               const std::array<TensorRow, 4>& out) {
  const CellRow u = displacement;
  const CellSize size = h;
  const std::array<TensorRow, 4> stress = out;
#pragma GCC ivdep
  for (Index i = 0; i < cells; ++i) {
    const Triangles strain = strains(u[i], size);
    const auto set = [&](Index t) DIPTYCH_INLINE { stress[t].set(i, law.stress(strain[t], i, 4 * i + t)); };
    set(0), set(1), set(2), set(3);
  }
}

/// A law whose rows tell energies, too: loops then ask all of a row's cells at once.
template <class LawRow>
concept TellsEnergy = requires(const LawRow& law, const material::Tensor& strain) {
  law.stored(strain, Index{});
  law.whole(Index{});
};

/// ψ of a triangle of a row's i-th cell [J/m³].
template <TellsEnergy LawRow>
[[gnu::always_inline]] inline double stored_in(const LawRow& law, const material::Stiffness& solid,
                                               const material::Tensor& strain, Index i) {
  const double whole = solid.stress(strain).contract(strain) / 2, cracked = law.stored(strain, i);
  return law.whole(i) ? whole : cracked;
}

/// ψ of each triangle where the last step began and where it ended: eight rows of as many numbers as there are cells.
template <class LawRow>
DIPTYCH_WIDE void stored_row(const CellRow& displacement, const CellRow& velocity, const CellSize& h, double dt,
                             Index cells, LawRow law, const material::Stiffness& solid, double* __restrict out) {
  const CellRow u = displacement, v = velocity;
  const CellSize size = h;
  const material::Stiffness whole = solid;
#pragma GCC ivdep
  for (Index i = 0; i < cells; ++i) {
    const Triangles now = strains(u[i], size), rate = strains(v[i], size);
    const auto tell = [&](Index t) DIPTYCH_INLINE {
      out[2 * t * cells + i] = stored_in(law, whole, now[t] - rate[t] * dt, i);
      out[(2 * t + 1) * cells + i] = stored_in(law, whole, now[t], i);
    };
    tell(0), tell(1), tell(2), tell(3);
  }
}

template <solid::PlaneModel Model>
class PlateMaterial {
 public:
  /// stress: of the cells, kept up to date by update_stress; books: `taken` will be asked for.
  template <class Solid>
  PlateMaterial(const Solid& solid, const Mesh& mesh, const Rows& rows, CellStress& stress, bool viscous, bool books)
      : mesh_(mesh),
        rows_(rows),
        stress_(stress),
        model_(solid, {static_cast<int>(mesh.nx), static_cast<int>(mesh.ny), mesh.h.x, mesh.h.y}, 4 * mesh.cells()) {
    if (!Model::linear || viscous) stress_.resize(mesh.cells());
    if (!Model::linear && books) taken_.resize(mesh.ny);
    if (Model::staggered) driver_.resize(mesh.cells());
  }

  /// Eqs. 23 to 28, staggered: the cells' mean strains at the end of the step give what changes in cells.
  void advance(double dt) {
    rows_.for_each([&](Index j) {
      const Index first = j * mesh_.nx;
      drive_row(mesh_.displacements({first, j}), mesh_.h, mesh_.nx, model_.driver(), &driver_[first]);
    });
    model_.advance(driver_, dt);
  }

  /// Stresses of all cells at uⁿ. keeps_books: also what damage and flow take, in the step of dt that ends there.
  void update_stress(double dt, bool keeps_books) {
    const bool counts = !Model::linear && keeps_books;
    rows_.for_bands([&](Index band) {
      std::vector<double> room;
      for (Index j = rows_.begin(band); j < rows_.end(band); ++j) {
        Taken taken;
        renew(j, dt, counts && model_.has_potential(), taken, room);
        if constexpr (Model::yields)
          mesh_.for_row(j, [&](CellAt at) { stress_.own[at.cell] = update_cell(at, taken); });
        else
          update_row(j);
        if (counts) taken_[j] = taken;
      }
    });
  }

  /// ψ of a triangle at a strain [J/m³].
  double stored(Index cell, Index t, const material::Tensor& strain) const {
    if (!Model::yields && model_.whole(cell, 0)) return stress_.solid.stress(strain).contract(strain) / 2;
    return model_.stored(strain, cell, 4 * cell + t);
  }
  const std::vector<Taken>& taken() const { return taken_; }  ///< of rows, in the last update with books
  const Model& model() const { return model_; }
  Index bytes() const {
    return model_.bytes() + driver_.capacity() * sizeof(double) + taken_.capacity() * sizeof(Taken);
  }

 private:
  /// ψ of each triangle where the last step began and where it ended [J/m³].
  std::array<std::array<double, 2>, 4> stored_along(CellAt at, double dt) const {
    const Triangles now = mesh_.strain(at), rate = mesh_.strain_rate(at);
    std::array<std::array<double, 2>, 4> energy{};
    for (Index t = 0; t < 4; ++t) energy[t] = {stored(at.cell, t, now[t] - rate[t] * dt), stored(at.cell, t, now[t])};
    return energy;
  }

  /// What damage can have taken at the least, of the falls of ψ where the step began and where it ended.
  static double least_taken(double at_begin, double at_end) { return std::min(at_begin, at_end); }

  /// What has changed in a row's cells takes effect. room: for what is told of the row, which grows as needed.
  void renew(Index j, double dt, bool counts, Taken& taken, std::vector<double>& room) {
    if (!counts) return model_.renew(j * mesh_.nx, mesh_.nx);
    if constexpr (!Model::yields && TellsEnergy<typename Model::Row>) {
      const auto [from, to] = solid::outdated_in(model_, {j * mesh_.nx, (j + 1) * mesh_.nx});
      if (from == to) return;
      const Index cells = to - from;
      if (room.size() < 16 * cells) room.resize(16 * cells);
      double *before = room.data(), *after = before + 8 * cells;
      const auto tell = [&](double* energy) {
        stored_row(mesh_.displacements({from, j}), mesh_.velocities({from, j}), mesh_.h, dt, cells,
                   model_.row(from, 4 * from), stress_.solid, energy);
      };
      tell(before);
      model_.renew(from, cells);
      tell(after);
      const auto fall = [&](Index k, Index i) { return before[k * cells + i] - after[k * cells + i]; };
      for (Index i = 0; i < cells; ++i) {
        for (Index t = 0; t < 4; ++t) taken.by_damage += least_taken(fall(2 * t, i), fall(2 * t + 1, i));
      }
      return;
    }
    mesh_.for_row(j, [&](CellAt at) {
      if (!model_.outdated(at.cell)) return;
      const auto before = stored_along(at, dt);
      model_.renew(at.cell, 1);
      const auto after = stored_along(at, dt);
      for (Index t = 0; t < 4; ++t)
        taken.by_damage += least_taken(before[t][0] - after[t][0], before[t][1] - after[t][1]);
    });
  }

  /// Cells of the whole solid keep no stress.
  void update_row(Index j) {
    const Index first = j * mesh_.nx, end = first + mesh_.nx;
    const auto whole = [&](Index cell) { return model_.whole(cell, 0); };
    for (Index cell = first; cell < end; ++cell) stress_.own[cell] = !whole(cell);
    for (Index from = first, to = 0; from < end; from = to) {
      const bool own = stress_.own[from];
      for (to = from + 1; to < end && static_cast<bool>(stress_.own[to]) == own; ++to) {
      }
      if (own) {
        stress_row(mesh_.displacements({from, j}), mesh_.h, to - from, model_.row(from, 4 * from),
                   {TensorRow(stress_.stress[0], from), TensorRow(stress_.stress[1], from),
                    TensorRow(stress_.stress[2], from), TensorRow(stress_.stress[3], from)});
      }
    }
  }

  /// Of points that may flow. 0 where the stresses are those of the whole solid, which are not kept.
  unsigned char update_cell(CellAt at, Taken& taken) {
    const Index cell = at.cell;
    const auto law = model_.row(cell, 4 * cell);
    Triangles stress = mesh_.strain(at);
    bool whole = true;
    for (Index t = 0; t < 4; ++t) {
      double dissipated = 0;
      stress[t] = law.stress(stress[t], 0, t, dissipated);
      taken.by_flow += dissipated;
      whole = whole && model_.whole(cell, 4 * cell + t);
    }
    if (whole) return 0;
    stress_.keep(cell, stress);
    return 1;
  }

  const Mesh& mesh_;
  const Rows& rows_;
  CellStress& stress_;
  Model model_;
  std::vector<double> driver_;  // of cells
  std::vector<Taken> taken_;    // of rows
};

}  // namespace diptych::fem
