#include "fem/plate_sweep.hpp"

#include <algorithm>
#include <cstddef>

namespace diptych::fem {
namespace {

Vector right_end(const double (&f)[2][block + 1]) { return {f[0][0], f[1][0]}; }

}  // namespace

Sweep::Sweep(Mesh& mesh, Border& border, const CellStress& stress, const Rows& rows, bool body_force, bool viscous)
    : mesh_(mesh), border_(border), stress_(stress), rows_(rows), loops_(loops(body_force, viscous)) {
  for (Index k = 0; k < rows.bands(); ++k)
    bands_.push_back({rows.begin(k), rows.end(k), Components(mesh.nx + 1), Components(mesh.nx + 1), {}});
}

void Sweep::move_nodes(double kick, double dt) {
  rows_.for_bands([&](Index band) { sweep(bands_[band], kick, dt); });
  close_rows(kick, dt);
}

void Sweep::sweep(Band& band, double kick, double dt) {
  const KickAndDrift corner{kick / (mesh_.cell_mass * 2 / 3), dt}, middle{kick / (mesh_.cell_mass / 3), dt};
  for (Index j = band.begin; j < band.end; ++j) {
    band.forces.lower_right[0][0] = band.forces.lower_right[1][0] = 0;
    band.forces.upper_right[0][0] = band.forces.upper_right[1][0] = 0;
    for (Index from = 0; from < mesh_.nx; from += block) {
      const Index cells = std::min(block, mesh_.nx - from);
      cell_forces(j, from, cells, middle, band.forces);
      if (j == band.begin) {
        open_row(band, from, cells);
      } else {
        if (from == 0) move_left_end(band, j, kick, dt);
        loops_.nodes(from == 0 ? 1 : 0, cells, band.forces, mesh_.corners.row(j, from), corner, &band.below.x[from],
                     &band.below.y[from]);
      }
      band.forces.carry(cells);
    }
    const Vector lower = right_end(band.forces.lower_right), upper = right_end(band.forces.upper_right);
    if (j == band.begin) {
      band.first.set(mesh_.nx, lower);
    } else {
      border_.kick(mesh_.nx, j, plus(band.below[mesh_.nx], lower), kick, dt);
    }
    band.below.set(mesh_.nx, upper);
  }
}

/// Eq. 19, and eq. 18 of the nodes in the middle of cells: runs of whole cells at one go, and of the others.
void Sweep::cell_forces(Index j, Index from, Index cells, const KickAndDrift& middle, CornerForces& forces) {
  const NodeRow lower = mesh_.corners.row(j, from), upper = mesh_.corners.row(j + 1, from);
  const auto whole_cells = [&](Index first, Index count) {
    loops_.cells(stress_.whole, count, lower.ux + first, lower.uy + first, upper.ux + first, upper.uy + first,
                 mesh_.middles.row(j, from + first), middle, forces, first);
  };
  if (stress_.own.empty()) return whole_cells(0, cells);
  const auto own = stress_.own.begin() + static_cast<std::ptrdiff_t>(j * mesh_.nx + from);
  const auto end = own + static_cast<std::ptrdiff_t>(cells);
  for (auto at_cell = own; at_cell != end;) {
    const auto next = std::find(at_cell, end, !*at_cell ? 1 : 0);
    const Index first = static_cast<Index>(at_cell - own), count = static_cast<Index>(next - at_cell);
    if (!*at_cell) {
      whole_cells(first, count);
    } else {
      loops_.own_cells(stress_.rows(j * mesh_.nx + from + first), mesh_.h, count, mesh_.middles.row(j, from + first),
                       middle, forces, first);
    }
    at_cell = next;
  }
}

// A band's first row of nodes waits for the band below it.
void Sweep::open_row(Band& band, Index from, Index cells) {
  const CornerForces& f = band.forces;
  for (Index i = 0; i < cells; ++i) {
    band.first.set(from + i, {f.lower_left[0][i] + f.lower_right[0][i], f.lower_left[1][i] + f.lower_right[1][i]});
    band.below.set(from + i, {f.upper_left[0][i] + f.upper_right[0][i], f.upper_left[1][i] + f.upper_right[1][i]});
  }
}

void Sweep::move_left_end(Band& band, Index j, double kick, double dt) {
  const CornerForces& f = band.forces;
  border_.kick(0, j,
               {band.below.x[0] + (f.lower_left[0][0] + f.lower_right[0][0]),
                band.below.y[0] + (f.lower_left[1][0] + f.lower_right[1][0])},
               kick, dt);
  band.below.set(0, {f.upper_left[0][0] + f.upper_right[0][0], f.upper_left[1][0] + f.upper_right[1][0]});
}

/// The rows of nodes between bands, at the bottom and at the top.
void Sweep::close_rows(double kick, double dt) {
  Nodes& corners = mesh_.corners;
  const double factor = kick / (mesh_.cell_mass * 2 / 3);
  for (Index k = 0; k <= bands_.size(); ++k) {
    const Index j = k == bands_.size() ? mesh_.ny : bands_[k].begin;
    const auto force = [&](Index i) {
      if (k == 0) return bands_[k].first[i];
      if (k == bands_.size()) return bands_[k - 1].below[i];
      return plus(bands_[k - 1].below[i], bands_[k].first[i]);
    };
    for (Index i = 0; i <= mesh_.nx; ++i) {
      if (i == 0 || i == mesh_.nx || j == 0 || j == mesh_.ny) {
        border_.kick(i, j, force(i), kick, dt);
        continue;
      }
      const Index node = j * (mesh_.nx + 1) + i;
      const Vector f = corners.body.x.empty() ? force(i) : plus(force(i), corners.body[node]);
      const Vector v{corners.v.x[node] + factor * f[0], corners.v.y[node] + factor * f[1]};
      corners.v.set(node, v);
      corners.u.set(node, {corners.u.x[node] + dt * v[0], corners.u.y[node] + dt * v[1]});
    }
  }
}

Index Sweep::bytes() const {  // with one thread
  const Band& band = bands_.front();
  return sizeof band + band.below.bytes() + band.first.bytes();
}

}  // namespace diptych::fem
