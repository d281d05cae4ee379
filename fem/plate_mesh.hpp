// The plate's mesh: nodes at the corners and in the middle of cells, and how rows of cells are shared out.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "fem/cell.hpp"
#include "fem/sweep.hpp"
#include "hinge/material/plane.hpp"
#include "hinge/scene/plate.hpp"
#include "hinge/step/threads.hpp"

namespace diptych::fem {

using Index = std::size_t;

/// A vector on every node, one array a component.
struct Components {
  std::vector<double> x, y;

  Components() = default;
  explicit Components(Index n) : x(n), y(n) {}
  Vector operator[](Index i) const { return {x[i], y[i]}; }
  void set(Index i, const Vector& v) { x[i] = v[0], y[i] = v[1]; }
  Index bytes() const { return (x.capacity() + y.capacity()) * sizeof(double); }
};

inline Vector plus(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1]}; }

/// Corners of cells, or their middles: row by row from the bottom.
struct Nodes {
  Index across, up;
  Components u, v;       ///< displacement [m], velocity [m/s]
  Components body = {};  ///< body force at the nodes [N/m], only with one

  Nodes(Index nx, Index ny) : across(nx), up(ny), u(nx * ny), v(nx * ny) {}
  NodeRow row(Index j, Index i = 0) {
    const Index k = j * across + i;
    return {&u.x[k],
            &u.y[k],
            &v.x[k],
            &v.y[k],
            body.x.empty() ? nullptr : &body.x[k],
            body.y.empty() ? nullptr : &body.y[k]};
  }
  Index bytes() const { return u.bytes() + v.bytes() + body.bytes(); }
};

/// Kinetic energy [J/m] and momentum [kg/s] of nodes.
struct Motion {
  double kinetic = 0;
  Vector momentum{};

  void add(const Motion& more) {
    kinetic += more.kinetic;
    momentum = plus(momentum, more.momentum);
  }
};

/// A cell by its number and the row that it stands in: loops know both, and the division that finds the one in the
/// other costs as much as a cell's strains.
struct CellAt {
  Index cell, row;
};

/// A vector on the nodes of a row of cells, or of a part of it: plain addresses, for a loop.
struct CellRow {
  const double *lower_x, *lower_y, *upper_x, *upper_y, *middle_x, *middle_y;

  [[gnu::always_inline]] CellValues operator[](Index i) const {
    return {{{lower_x[i], lower_y[i]},
             {lower_x[i + 1], lower_y[i + 1]},
             {upper_x[i + 1], upper_y[i + 1]},
             {upper_x[i], upper_y[i]},
             {middle_x[i], middle_y[i]}}};
  }
};

/// Cells are numbered row by row from the bottom, each row from the left.
struct Mesh {
  double width, height;  ///< of the plate [m]
  double density;        ///< ρ [kg/m³]
  Index nx, ny;
  CellSize h;
  double cell_mass;  ///< ρ h_x h_y [kg/m]: a third to its middle, a sixth to each corner
  Nodes corners, middles;

  /// At rest and where it belongs, or as the plate starts.
  Mesh(const Plate&, const Cells&);

  double corner_x(Index i) const { return width * static_cast<double>(i) / static_cast<double>(nx); }
  double corner_y(Index j) const { return height * static_cast<double>(j) / static_cast<double>(ny); }
  double middle_x(Index i) const { return width * (static_cast<double>(i) + 0.5) / static_cast<double>(nx); }
  double middle_y(Index j) const { return height * (static_cast<double>(j) + 0.5) / static_cast<double>(ny); }
  /// Calls act(nodes, number, x, y) for all nodes, the corners first.
  template <class Act>
  void for_nodes(Act act) {
    for (Index j = 0; j <= ny; ++j) {
      for (Index i = 0; i <= nx; ++i) act(corners, j * (nx + 1) + i, corner_x(i), corner_y(j));
    }
    for (Index j = 0; j < ny; ++j) {
      for (Index i = 0; i < nx; ++i) act(middles, j * nx + i, middle_x(i), middle_y(j));
    }
  }

  Index cells() const { return nx * ny; }
  /// Calls act(CellAt) for all cells of a row, and of the mesh.
  template <class Act>
  void for_row(Index row, Act&& act) const {
    const Index first = row * nx, count = nx;
    for (Index i = 0; i < count; ++i) act(CellAt{first + i, row});
  }
  template <class Act>
  void for_cells(Act&& act) const {
    for (Index row = 0; row < ny; ++row) for_row(row, act);
  }
  /// From a cell on, to the end of its row.
  CellRow displacements(CellAt at) const { return of_row(corners.u, middles.u, at); }
  CellRow velocities(CellAt at) const { return of_row(corners.v, middles.v, at); }
  CellValues displacement(CellAt at) const { return displacements(at)[0]; }
  CellValues velocity(CellAt at) const { return velocities(at)[0]; }
  Triangles strain(CellAt at) const { return strains(displacement(at), h); }
  Triangles strain_rate(CellAt at) const { return strains(velocity(at), h); }
  material::Tensor mean_strain(CellAt at) const { return fem::mean_strain(displacement(at), h); }

  Motion motion() const;         ///< of all nodes
  Motion motion(Index j) const;  ///< of a row of corners and of the middles above it

 private:
  CellRow of_row(const Components& of_corners, const Components& of_middles, CellAt at) const {
    const Index k = at.cell + at.row, l = k + nx + 1;  // a row has one corner more than it has cells
    return {&of_corners.x[k], &of_corners.y[k],       &of_corners.x[l],
            &of_corners.y[l], &of_middles.x[at.cell], &of_middles.y[at.cell]};
  }
};

/// Rows of cells in as many bands as there are threads; the same bits for any number of them.
class Rows {
 public:
  Rows(Index rows, int threads)
      : rows_(rows), bands_(std::min(static_cast<Index>(std::max(1, threads)), rows)), threads_(threads) {}

  Index bands() const { return bands_; }
  Index begin(Index band) const { return band * rows_ / bands_; }
  Index end(Index band) const { return (band + 1) * rows_ / bands_; }
  template <class Act>
  void for_bands(Act&& act) const {
    threads_.for_each(bands_, act);
  }
  /// Calls act(row) for every row of cells.
  template <class Act>
  void for_each(Act&& act) const {
    for_bands([&](Index band) {
      for (Index j = begin(band); j < end(band); ++j) act(j);
    });
  }

 private:
  Index rows_, bands_;
  Threads threads_;
};

}  // namespace diptych::fem
