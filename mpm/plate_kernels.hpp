// One row of cells at a time: from the grid to the particles and back. Particles of the same place in their cells stand
// side by side, so that a row is worked through several cells at once.
#pragma once

#include <array>
#include <cstddef>

#include "hinge/material/plane.hpp"
#include "hinge/wide.hpp"
#include "mpm/plate_grid.hpp"

namespace diptych::mpm {

/// Places of a cell's particles along one axis, the same along x and y: eq. 7 is the product of two of eq. 6.
struct Arrangement {
  static constexpr std::size_t most = 8;
  std::size_t count = 1;
  std::array<double, most> near{}, far{};  ///< shape functions of the nodes at smaller and larger coordinates
};

/// Sum of f(0) … f(count − 1) from the outside in: a mirrored plate adds the same numbers in the same order. n: the
/// count where it is known beforehand, or 0.
template <std::size_t n, class F>
[[gnu::always_inline]] inline double pair_sum(std::size_t count, F&& f) {
  if constexpr (n == 1) {
    return f(std::size_t{0});
  } else if constexpr (n == 2) {
    return f(std::size_t{0}) + f(std::size_t{1});
  } else {
    double sum = 0;
    std::size_t low = 0, high = count;
    for (; low + 1 < high; ++low) {
      --high;
      sum += f(low) + f(high);
    }
    return low < high ? sum + f(low) : sum;
  }
}

/// f(0) … f(count − 1).
template <std::size_t n, class F>
[[gnu::always_inline]] inline void for_places(std::size_t count, F&& f) {
  if constexpr (n == 1) {
    f(std::size_t{0});
  } else if constexpr (n == 2) {
    f(std::size_t{0});
    f(std::size_t{1});
  } else {
    for (std::size_t k = 0; k < count; ++k) f(k);
  }
}

/// The nodes of a row of cells: below and above it.
struct NodeRows {
  const double *low, *high;
};

/// Shares of a row of cells for their corners, see CornerShares.
struct ShareRows {
  double *bottom_left, *bottom_right, *top_left, *top_right;
  /// first: of the row's cells that are worked on.
  explicit ShareRows(CornerShares& s, std::size_t first)
      : bottom_left(s.bottom_left.data() + first),
        bottom_right(s.bottom_right.data() + first + 1),
        top_left(s.top_left.data() + first),
        top_right(s.top_right.data() + first + 1) {}
};

/// One component of v += τ Σ N a (eq. 11) and u += Δt Σ N v (eqs. 9, 10) of the particles of a row of cells, and their
/// new Σ N v on the nodes, in units of a particle's mass. Particles of one place begin `stride` after those of the
/// last. With a part of PIC, that part of the velocity is the grid's.
template <std::size_t n, bool pic>
DIPTYCH_WIDE void kick_row(const Arrangement& places, std::size_t cells, std::size_t stride, double kick, double drift,
                           double part, NodeRows acceleration, NodeRows kicked, double* velocity, double* displacement,
                           ShareRows out) {
  const double* __restrict al = acceleration.low;
  const double* __restrict ah = acceleration.high;
  const double* __restrict kl = kicked.low;
  const double* __restrict kh = kicked.high;
  double* __restrict bottom_left = out.bottom_left;
  double* __restrict bottom_right = out.bottom_right;
  double* __restrict top_left = out.top_left;
  double* __restrict top_right = out.top_right;
  const std::size_t count = n > 0 ? n : places.count;
  const std::array<double, Arrangement::most> near = places.near, far = places.far;
#pragma GCC ivdep
  for (std::size_t i = 0; i < cells; ++i) {
    for_places<n>(count, [&](std::size_t a) DIPTYCH_INLINE {
      const double acceleration_low = near[a] * al[i] + far[a] * al[i + 1];
      const double acceleration_high = near[a] * ah[i] + far[a] * ah[i + 1];
      const double kicked_low = near[a] * kl[i] + far[a] * kl[i + 1];
      const double kicked_high = near[a] * kh[i] + far[a] * kh[i + 1];
      for_places<n>(count, [&](std::size_t b) DIPTYCH_INLINE {
        const std::size_t p = (b * count + a) * stride + i;
        const double grid = near[b] * kicked_low + far[b] * kicked_high;
        double v = velocity[p] + kick * (near[b] * acceleration_low + far[b] * acceleration_high);
        if constexpr (pic) v = (1 - part) * v + part * grid;
        velocity[p] = v;
        displacement[p] += drift * grid;
      });
    });
    const auto along = [&](const std::array<double, Arrangement::most>& weight, std::size_t b) DIPTYCH_INLINE {
      return pair_sum<n>(
          count, [&](std::size_t a) DIPTYCH_INLINE { return weight[a] * velocity[(b * count + a) * stride + i]; });
    };
    bottom_left[i] = pair_sum<n>(count, [&](std::size_t b) DIPTYCH_INLINE { return near[b] * along(near, b); });
    bottom_right[i] = pair_sum<n>(count, [&](std::size_t b) DIPTYCH_INLINE { return near[b] * along(far, b); });
    top_left[i] = pair_sum<n>(count, [&](std::size_t b) DIPTYCH_INLINE { return far[b] * along(near, b); });
    top_right[i] = pair_sum<n>(count, [&](std::size_t b) DIPTYCH_INLINE { return far[b] * along(far, b); });
  }
}

/// Components of a tensor of a row's particles.
struct TensorRows {
  double *xx = nullptr, *yy = nullptr, *xy = nullptr;
};

/// Mean of the values of a cell's particles.
template <std::size_t n>
[[gnu::always_inline]] inline double mean_of_cell(std::size_t along, std::size_t stride, const double* values,
                                                  std::size_t i) {
  const std::size_t count = n > 0 ? n : along;
  return pair_sum<n>(count,
                     [&](std::size_t b) DIPTYCH_INLINE {
                       return pair_sum<n>(
                           count, [&](std::size_t a) DIPTYCH_INLINE { return values[(b * count + a) * stride + i]; });
                     }) /
         static_cast<double>(count * count);
}

/// driver(mean strain) of a row of cells.
template <std::size_t n, class Driver>
DIPTYCH_WIDE void drive_row(std::size_t count, std::size_t cells, std::size_t stride, TensorRows strain, Driver driver,
                            double* __restrict out) {
  const double* xx = strain.xx;
  const double* yy = strain.yy;
  const double* xy = strain.xy;
#pragma GCC ivdep
  for (std::size_t i = 0; i < cells; ++i) {
    const auto mean = [&](const double* values) DIPTYCH_INLINE { return mean_of_cell<n>(count, stride, values, i); };
    out[i] = driver(material::Tensor{mean(xx), mean(yy), mean(xy)});
  }
}

/// What a pass over the particles brings up to date: both at one go, but where something comes between the two.
enum class Update { strain, force, both };

/// Strain increments Δt ∇v of the particles of a row of cells, and the internal forces of their stress (eq. 19) with
/// the artificial viscosity.
template <std::size_t n, Update what, class LawRow, class ViscousRow>
DIPTYCH_WIDE void strain_row(const Arrangement& places, std::size_t cells, std::size_t stride, double dt, double hx,
                             double hy, double volume, NodeRows velocity_x, NodeRows velocity_y, TensorRows strain,
                             LawRow law, [[maybe_unused]] ViscousRow viscous, ShareRows out_x, ShareRows out_y) {
  constexpr std::size_t most = n > 0 ? n : Arrangement::most;
  const std::size_t count = n > 0 ? n : places.count;
  const std::array<double, Arrangement::most> near = places.near, far = places.far;
  const double per_x = dt / hx, per_y = dt / hy, area_x = volume / hx, area_y = volume / hy;
  const double* __restrict xl = velocity_x.low;
  const double* __restrict xh = velocity_x.high;
  const double* __restrict yl = velocity_y.low;
  const double* __restrict yh = velocity_y.high;
  double* __restrict xbl = out_x.bottom_left;
  double* __restrict xbr = out_x.bottom_right;
  double* __restrict xtl = out_x.top_left;
  double* __restrict xtr = out_x.top_right;
  double* __restrict ybl = out_y.bottom_left;
  double* __restrict ybr = out_y.bottom_right;
  double* __restrict ytl = out_y.top_left;
  double* __restrict ytr = out_y.top_right;
#pragma GCC ivdep
  for (std::size_t i = 0; i < cells; ++i) {
    if constexpr (what != Update::force) {
      const double xx_low = per_x * (xl[i + 1] - xl[i]), xx_high = per_x * (xh[i + 1] - xh[i]);
      const double yx_low = per_x * (yl[i + 1] - yl[i]), yx_high = per_x * (yh[i + 1] - yh[i]);
      const double yy_left = per_y * (yh[i] - yl[i]), yy_right = per_y * (yh[i + 1] - yl[i + 1]);
      const double xy_left = per_y * (xh[i] - xl[i]), xy_right = per_y * (xh[i + 1] - xl[i + 1]);
      for_places<n>(count, [&](std::size_t b) DIPTYCH_INLINE {
        const double xx = near[b] * xx_low + far[b] * xx_high, yx = near[b] * yx_low + far[b] * yx_high;
        for_places<n>(count, [&](std::size_t a) DIPTYCH_INLINE {
          const std::size_t p = (b * count + a) * stride + i;
          const double yy = near[a] * yy_left + far[a] * yy_right;
          strain.xx[p] += xx;
          strain.yy[p] += yy;
          if constexpr (ViscousRow::on) viscous.divergence[p] = (xx + yy) / dt;
          strain.xy[p] += 0.5 * ((near[a] * xy_left + far[a] * xy_right) + yx);
        });
      });
    }
    if constexpr (what != Update::strain) {
      std::array<double, most * most> xx, yy, xy;
      for_places<n>(count, [&](std::size_t b) DIPTYCH_INLINE {
        for_places<n>(count, [&](std::size_t a) DIPTYCH_INLINE {
          const std::size_t k = b * count + a, p = k * stride + i;
          material::Tensor stress = law.stress({strain.xx[p], strain.yy[p], strain.xy[p]}, i, p);
          if constexpr (ViscousRow::on) {
            const double q = viscous.stress(p);
            stress.xx += q;
            stress.yy += q;
          }
          xx[k] = stress.xx;
          yy[k] = stress.yy;
          xy[k] = stress.xy;
        });
      });
      // ∂N/∂x is ∓1/hx times the shape function along y, ∂N/∂y ∓1/hy times the one along x.
      const auto rows = [&](const std::array<double, Arrangement::most>& weight, const auto& component) DIPTYCH_INLINE {
        return area_x * pair_sum<n>(count, [&](std::size_t b) DIPTYCH_INLINE {
                 return weight[b] *
                        pair_sum<n>(count, [&](std::size_t a) DIPTYCH_INLINE { return component[b * count + a]; });
               });
      };
      const auto columns = [&](const std::array<double, Arrangement::most>& weight,
                               const auto& component) DIPTYCH_INLINE {
        return area_y * pair_sum<n>(count, [&](std::size_t a) DIPTYCH_INLINE {
                 return weight[a] *
                        pair_sum<n>(count, [&](std::size_t b) DIPTYCH_INLINE { return component[b * count + a]; });
               });
      };
      const double x_low = rows(near, xx), x_high = rows(far, xx), x_left = columns(near, xy),
                   x_right = columns(far, xy);
      const double y_low = rows(near, xy), y_high = rows(far, xy), y_left = columns(near, yy),
                   y_right = columns(far, yy);
      xbl[i] = x_low + x_left;
      xbr[i] = x_right - x_low;
      xtl[i] = x_high - x_left;
      xtr[i] = -(x_high + x_right);
      ybl[i] = y_low + y_left;
      ybr[i] = y_right - y_low;
      ytl[i] = y_high - y_left;
      ytr[i] = -(y_high + y_right);
    }
  }
}

}  // namespace diptych::mpm
