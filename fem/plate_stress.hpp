// Stresses of the plate's triangles. Most cells are whole, and their forces come from a cell's stiffness at one go (see
// sweep.hpp): only the stress of the others is kept.
#pragma once

#include <array>
#include <vector>

#include "fem/plate_mesh.hpp"
#include "fem/sweep.hpp"
#include "hinge/material/plane.hpp"

namespace diptych::fem {

struct CellStress {
  material::Stiffness solid;  ///< of the whole solid
  WholeCell whole;
  // of each cell; empty where every cell is whole for ever
  std::vector<Triangles> stress = {};               ///< of cells that are not whole [Pa]
  std::vector<unsigned char> own = {};              ///< 1 where the stress is not the whole solid's
  std::vector<std::array<double, 4>> viscous = {};  ///< q of eq. 21 of the triangles, only with viscosity [Pa]

  CellStress(const material::Stiffness& s, const CellSize& h) : solid(s), whole(s, h) {}

  bool is_own(Index cell) const { return !own.empty() && own[cell]; }
  /// The material's, without q.
  Triangles of(const Mesh& mesh, CellAt at) const {
    if (is_own(at.cell)) return stress[at.cell];
    Triangles t = mesh.strain(at);
    for (material::Tensor& one : t) one = solid.stress(one);
    return t;
  }
  Index bytes() const {
    return stress.capacity() * sizeof(Triangles) + own.capacity() + viscous.capacity() * sizeof(std::array<double, 4>);
  }
};

}  // namespace diptych::fem
