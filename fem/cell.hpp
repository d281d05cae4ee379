// A rectangular cell of four constant-strain triangles that share the node in its middle.
#pragma once

#include <array>

#include "hinge/material/plane.hpp"
#include "hinge/scene/plate.hpp"

namespace diptych::fem {

/// Of the nodes of a cell: its corners anticlockwise from the lower left one, then the middle.
using CellValues = std::array<Vector, 5>;
/// Of the triangles of a cell, each between a side and the middle: bottom, right, top, left.
using Triangles = std::array<material::Tensor, 4>;

/// Size of a cell.
struct CellSize {
  double x, y;  ///< [m]

  double triangle_area() const { return x * y / 4; }  ///< [m²]
};

/// Strain of each triangle [-] from displacement, or its rate from velocity. Sums are of pairs that change places in a
/// mirror, so that the mirrored cell has the mirrored bits.
[[gnu::always_inline]] inline Triangles strains(const CellValues& u, const CellSize& h) {
  const auto tensor = [&](const Vector& along_x, const Vector& along_y) {
    return material::Tensor{along_x[0] / h.x, along_y[1] / h.y, (along_x[1] / h.x + along_y[0] / h.y) / 2};
  };
  const auto& [a, b, c, d, middle] = u;
  const Vector twice{2 * middle[0], 2 * middle[1]};
  const auto difference = [](const Vector& p, const Vector& q) { return Vector{p[0] - q[0], p[1] - q[1]}; };
  const auto sum = [](const Vector& p, const Vector& q) { return Vector{p[0] + q[0], p[1] + q[1]}; };
  return {
      tensor(difference(b, a), difference(twice, sum(a, b))), tensor(difference(sum(b, c), twice), difference(c, b)),
      tensor(difference(c, d), difference(sum(c, d), twice)), tensor(difference(twice, sum(a, d)), difference(d, a))};
}

/// Mean of the strains of the triangles; the middle node has no part in it.
[[gnu::always_inline]] inline material::Tensor mean_strain(const CellValues& u, const CellSize& h) {
  const auto& [a, b, c, d, middle] = u;
  const auto along_x = [&](std::size_t k) { return ((b[k] + c[k]) - (a[k] + d[k])) / (2 * h.x); };
  const auto along_y = [&](std::size_t k) { return ((c[k] + d[k]) - (a[k] + b[k])) / (2 * h.y); };
  return {along_x(0), along_y(1), (along_x(1) + along_y(0)) / 2};
}

/// Internal forces on the nodes, −∫ σ·∇N (eq. 19) [N per metre of thickness]. At a corner the shape functions of its
/// two triangles have the same gradient, (±1/h_x, ±1/h_y).
[[gnu::always_inline]] inline CellValues internal_forces(const Triangles& stress, const CellSize& h) {
  const double a = h.y / 4, b = h.x / 4;  // A/h_x, A/h_y
  const auto corner = [&](const material::Tensor& p, const material::Tensor& q, double right, double up) {
    const material::Tensor s = p + q;
    return Vector{-(right * (a * s.xx) + up * (b * s.xy)), -(right * (a * s.xy) + up * (b * s.yy))};
  };
  const auto& [bottom, right, top, left] = stress;
  return {corner(bottom, left, -1, -1), corner(bottom, right, 1, -1), corner(top, right, 1, 1),
          corner(top, left, -1, 1),
          Vector{2 * (a * (right.xx - left.xx) + b * (top.xy - bottom.xy)),
                 2 * (a * (right.xy - left.xy) + b * (top.yy - bottom.yy))}};
}

}  // namespace diptych::fem
