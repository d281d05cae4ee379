// Where a particle is, and what is told of the particles of a row of cells, several cells at once.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "hinge/material/plane.hpp"
#include "hinge/wide.hpp"
#include "mpm/plate_grid.hpp"
#include "mpm/plate_kernels.hpp"

namespace diptych::mpm {

/// Where a particle is: its cell's first node, its shape functions along x and y (eq. 7 is their product), and who it
/// is.
struct Place {
  std::size_t particle, node, next_row, cell;
  double left, right, bottom, top;

  [[gnu::always_inline]] double value(const std::vector<double>& f) const {
    return bottom * (left * f[node] + right * f[node + 1]) +
           top * (left * f[node + next_row] + right * f[node + next_row + 1]);
  }
  [[gnu::always_inline]] Vector value(const VectorField& f) const { return {value(f.x), value(f.y)}; }
  /// The symmetric part of the gradient.
  [[gnu::always_inline]] material::Tensor gradient(const VectorField& f, const Grid& grid) const {
    const auto along_x = [&](const std::vector<double>& v) DIPTYCH_INLINE {
      return (bottom * (v[node + 1] - v[node]) + top * (v[node + next_row + 1] - v[node + next_row])) / grid.hx;
    };
    const auto along_y = [&](const std::vector<double>& v) DIPTYCH_INLINE {
      return (left * (v[node + next_row] - v[node]) + right * (v[node + next_row + 1] - v[node + 1])) / grid.hy;
    };
    return {along_x(f.x), along_y(f.y), 0.5 * (along_y(f.x) + along_x(f.y))};
  }
};

/// What `tell` says of a particle: so many numbers.
template <class Tell>
constexpr std::size_t told_by = std::tuple_size_v<decltype(std::declval<Tell>()(std::declval<Place>()))>;

/// What `tell` says of each particle of a run of cells, whose first is that of the place `first`. The q-th number of
/// the k-th particle of cell i goes to out[(q · particles of a cell + k) · width + i].
template <std::size_t n, class Tell>
DIPTYCH_WIDE void tell_row(const Arrangement& places, std::size_t cells, std::size_t stride, const Place& first,
                           Tell tell, std::size_t width, double* __restrict out) {
  const std::size_t count = n > 0 ? n : places.count;
  const std::array<double, Arrangement::most> near = places.near, far = places.far;
  const Place from = first;
#pragma GCC ivdep
  for (std::size_t i = 0; i < cells; ++i) {
    for_places<n>(count, [&](std::size_t b) DIPTYCH_INLINE {
      for_places<n>(count, [&](std::size_t a) DIPTYCH_INLINE {
        const std::size_t k = b * count + a;
        const auto told = tell(Place{from.particle + k * stride + i, from.node + i, from.next_row, from.cell + i,
                                     near[a], far[a], near[b], far[b]});
        for (std::size_t q = 0; q < told_by<Tell>; ++q) out[(q * count * count + k) * width + i] = told[q];
      });
    });
  }
}

}  // namespace diptych::mpm
