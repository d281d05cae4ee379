// The two loops over a row of the mesh that take nearly all of the time: forces of whole cells, and motion of nodes.
//
// A node's displacement is needed by the cells above and below it and by nobody after them. So one sweep from the
// bottom to the top finds the forces of a row of cells and moves, in place, the nodes whose forces are then complete:
// every value passes the memory once a step.
#pragma once

#include <array>
#include <cstddef>

#include "fem/cell.hpp"

namespace diptych::fem {

/// Stiffness of a cell whose four triangles are the same solid, from σ of plane.hpp times A/h of cell.hpp [Pa].
struct WholeCell {
  double xx, yy;                     ///< a M/h_x and b M/h_y, M the normal stiffness
  double shear_x, shear_y;           ///< a G/h_x and b G/h_y
  double cross, shear;               ///< λ/4 and G/4
  double direct_x, direct_y, mixed;  ///< their sums: xx + shear_y, yy + shear_x, cross + shear

  WholeCell(const material::Stiffness& s, const CellSize& h)
      : xx(s.normal * h.y / (4 * h.x)),
        yy(s.normal * h.x / (4 * h.y)),
        shear_x(s.shear * h.y / (4 * h.x)),
        shear_y(s.shear * h.x / (4 * h.y)),
        cross(s.cross / 4),
        shear(s.shear / 4),
        direct_x(xx + shear_y),
        direct_y(yy + shear_x),
        mixed(cross + shear) {}
};

/// Cells that are looked at together: their forces stay in the nearest cache.
inline constexpr std::size_t block = 128;

/// Forces of a block of cells on its corners, by node: the corners on the left stand at their cell's place, those on
/// the right one further. The first place of these belongs to the cell before the block.
struct CornerForces {
  alignas(64) double lower_left[2][block] = {}, upper_left[2][block] = {};
  alignas(64) double lower_right[2][block + 1] = {}, upper_right[2][block + 1] = {};

  /// The last cell's forces on the right become those before the next block.
  void carry(std::size_t cells) {
    for (const std::size_t c : {std::size_t{0}, std::size_t{1}}) {
      lower_right[c][0] = lower_right[c][cells];
      upper_right[c][0] = upper_right[c][cells];
    }
  }
};

/// Where a row of nodes stands in memory, or a part of it.
struct NodeRow {
  double *ux, *uy, *vx, *vy;      ///< displacement and velocity
  const double *body_x, *body_y;  ///< body force on the nodes, or null
};

struct KickAndDrift {
  double kick;   ///< length of the kick over the mass of a node [s/kg]
  double drift;  ///< time step [s]
};

/// Stresses of a row of cells [Pa], or of a part of it: one row of tensors a triangle, and q of eq. 21 with viscosity.
struct StressRows {
  struct Triangle {
    const double *xx, *yy, *xy, *q;

    template <bool viscous>
    [[gnu::always_inline]] material::Tensor at(std::size_t i) const {
      if constexpr (viscous) return {xx[i] + q[i], yy[i] + q[i], xy[i]};
      return {xx[i], yy[i], xy[i]};
    }
  };
  std::array<Triangle, 4> triangle;
};

/// Eq. 19 of `cells` whole cells: forces on corners, from the displacements of the rows of nodes below and above; kicks
/// and moves the nodes in the middle (eq. 18).
using CellLoop = void (*)(const WholeCell&, std::size_t cells, const double* lower_x, const double* lower_y,
                          const double* upper_x, const double* upper_y, const NodeRow& middle, const KickAndDrift&,
                          CornerForces&, std::size_t first);

/// The same of cells that have stresses of their own.
using OwnCellLoop = void (*)(const StressRows&, const CellSize&, std::size_t cells, const NodeRow& middle,
                             const KickAndDrift&, CornerForces&, std::size_t first);

/// Eq. 18 of the nodes from `first` to before `end` of a block: `below_x`, `below_y` have the forces of the cells below
/// and receive those on the next row.
using NodeLoop = void (*)(std::size_t first, std::size_t end, const CornerForces&, const NodeRow&, const KickAndDrift&,
                          double* below_x, double* below_y);

struct Loops {
  CellLoop cells;
  OwnCellLoop own_cells;
  NodeLoop nodes;
};

/// viscous: stresses have a q.
Loops loops(bool body_force, bool viscous);

}  // namespace diptych::fem
