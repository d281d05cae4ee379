// Stresses of the plate's triangles. Most cells are whole, and their forces come from a cell's stiffness at one go (see
// sweep.hpp): only the stress of the others is kept.
#pragma once

#include <array>
#include <vector>

#include "fem/plate_mesh.hpp"
#include "fem/sweep.hpp"
#include "hinge/material/plane.hpp"
#include "hinge/solid/arrays.hpp"

namespace diptych::fem {

struct CellStress {
  material::Stiffness solid;  ///< of the whole solid
  WholeCell whole;
  // of each cell; empty where every cell is whole for ever
  std::array<TensorField, 4> stress = {};           ///< of the triangles of cells that are not whole [Pa]
  std::vector<unsigned char> own = {};              ///< 1 where the stress is not the whole solid's
  std::array<std::vector<double>, 4> viscous = {};  ///< q of eq. 21 of the triangles, only with viscosity [Pa]

  CellStress(const material::Stiffness& s, const CellSize& h) : solid(s), whole(s, h) {}

  void resize(Index cells) {
    for (TensorField& one : stress) one.resize(cells);
    own.resize(cells);
  }
  bool is_own(Index cell) const { return !own.empty() && own[cell]; }
  /// The material's, without q.
  Triangles of(const Mesh& mesh, CellAt at) const {
    if (is_own(at.cell)) return kept(at.cell);
    Triangles t = mesh.strain(at);
    for (material::Tensor& one : t) one = solid.stress(one);
    return t;
  }
  /// Of a cell that is not whole.
  Triangles kept(Index cell) const { return {stress[0][cell], stress[1][cell], stress[2][cell], stress[3][cell]}; }
  void keep(Index cell, const Triangles& t) {
    for (Index k = 0; k < 4; ++k) stress[k].set(cell, t[k]);
  }
  StressRows rows(Index first) const {
    StressRows all{};
    for (Index k = 0; k < 4; ++k) {
      all.triangle[k] = {&stress[k].xx[first], &stress[k].yy[first], &stress[k].xy[first],
                         viscous[k].empty() ? nullptr : &viscous[k][first]};
    }
    return all;
  }
  Index bytes() const {
    Index sum = own.capacity();
    for (Index k = 0; k < 4; ++k) sum += stress[k].bytes() + viscous[k].capacity() * sizeof(double);
    return sum;
  }
};

}  // namespace diptych::fem
