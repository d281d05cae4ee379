// Particles in the plate's cells: those that stay in their places, and those that move through the grid.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "mpm/plate_grid.hpp"
#include "mpm/plate_kernels.hpp"
#include "mpm/plate_law.hpp"

namespace diptych::mpm {

/// A particle on a face of its cell stays one ulp inside: no node it touches is without mass, and the limit ξ → 0 is
/// taken rather than 0/0. Counted from the cell's centre, so that mirroring leaves the shape functions' bits alone.
constexpr double edge = 0.5 - 0x1p-54;

/// Particles at n places along each axis. Offsets from the cell's centre.
struct Places {
  std::vector<double> offset;
  explicit Places(const std::vector<double>& positions) {
    for (const double xi : positions) offset.push_back(std::clamp(xi - 0.5, -edge, edge));
  }
  std::size_t count() const { return offset.size(); }
  /// Means of the shape functions of the nodes at smaller and larger coordinates.
  double near() const { return 0.5 - mean(); }
  double far() const { return 0.5 + mean(); }
  Arrangement arrangement() const {
    Arrangement places;
    places.count = count();
    for (std::size_t a = 0; a < count(); ++a) {
      places.near[a] = 0.5 - offset[a];
      places.far[a] = 0.5 + offset[a];
    }
    return places;
  }

 private:
  double mean() const {
    return pair_sum<0>(count(), [&](std::size_t a) { return offset[a]; }) / static_cast<double>(count());
  }
};

/// What every particle carries; equal masses and volumes.
struct State {
  double mass = 0, volume = 0;  ///< of one particle [kg], [m³]
  VectorField velocity, displacement;
  TensorField strain;
  void resize(std::size_t count) {
    velocity.resize(count);
    displacement.resize(count);
    strain.resize(count);
  }
  std::size_t count() const { return velocity.x.size(); }
  std::size_t bytes() const { return velocity.bytes() + displacement.bytes() + strain.bytes(); }
};

/// Where a particle is: its cell's first node, its shape functions along x and y (eq. 7 is their product), and who it
/// is.
struct Place {
  std::size_t particle, node, next_row, cell;
  double left, right, bottom, top;

  double value(const std::vector<double>& f) const {
    return bottom * (left * f[node] + right * f[node + 1]) +
           top * (left * f[node + next_row] + right * f[node + next_row + 1]);
  }
  Vector value(const VectorField& f) const { return {value(f.x), value(f.y)}; }
  /// The symmetric part of the gradient.
  material::Tensor gradient(const VectorField& f, const Grid& grid) const {
    const auto along_x = [&](const std::vector<double>& v) {
      return (bottom * (v[node + 1] - v[node]) + top * (v[node + next_row + 1] - v[node + next_row])) / grid.hx;
    };
    const auto along_y = [&](const std::vector<double>& v) {
      return (left * (v[node + next_row] - v[node]) + right * (v[node + next_row + 1] - v[node + 1])) / grid.hy;
    };
    return {along_x(f.x), along_y(f.y), 0.5 * (along_y(f.x) + along_x(f.y))};
  }
};

/// Infinitesimal displacements: particles keep their places, the same in every cell, and nothing of them is stored. In
/// each row of cells those of one place stand side by side: particle (row · places + place) · stride + column.
class Standing {
 public:
  static constexpr bool moving = false;

  Standing(const Plate&, const Cells&, const Places& places, Grid& grid)
      : grid_(grid),
        places_(places.arrangement()),
        offset_(places.offset),
        columns_(grid.columns()),
        stride_(off_pages(columns_, per_cell())) {}

  State& state() { return state_; }
  const State& state() const { return state_; }
  std::size_t per_cell() const { return places_.count * places_.count; }
  std::size_t count() const { return columns_ * grid_.ny * per_cell(); }
  std::size_t storage() const { return stride_ * grid_.ny * per_cell(); }
  std::size_t bytes() const { return state_.bytes(); }
  static std::string trouble() { return {}; }
  static bool has_moved() { return false; }

  /// k-th particle of a cell, each row of particles from the left.
  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const { return (j * per_cell() + k) * stride_ + i; }
  std::size_t rows() const { return grid_.ny; }

  /// Calls f(place) for the particles that stand in a row of cells.
  template <class F>
  void visit_row(std::size_t j, F&& f) const {
    for (std::size_t i = 0; i < columns_; ++i) {
      for (std::size_t k = 0; k < per_cell(); ++k) {
        const std::size_t a = k % places_.count, b = k / places_.count;
        f(Place{index(i, j, k), grid_.row(j) + grid_.column(i), grid_.next_row(), j * columns_ + i, places_.near[a],
                places_.far[a], places_.near[b], places_.far[b]});
      }
    }
  }
  Vector position(const Place& at) const {
    const std::size_t k = at.particle / stride_ % per_cell(), j = at.cell / columns_, i = at.cell % columns_;
    return {(static_cast<double>(i) + 0.5 + offset_[k % places_.count]) * grid_.hx,
            (static_cast<double>(j) + 0.5 + offset_[k / places_.count]) * grid_.hy};
  }

  void map_mass(Bands&) {  // eq. 15: the product of what stands beside and above a node
    const double near = pair_sum<0>(places_.count, [&](std::size_t a) { return places_.near[a]; });
    const double far = pair_sum<0>(places_.count, [&](std::size_t a) { return places_.far[a]; });
    const auto along = [&](bool first, bool last) { return first ? near : last ? far : far + near; };
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t i = 0; i <= grid_.nx; ++i)
        grid_.mass[grid_.row(j) + i] =
            state_.mass * (along(grid_.ends_left(i), grid_.ends_right(i)) * along(j == 0, j == 2));
    }
  }

  void map_momentum(Bands& bands) { kick_and_move(bands, 0, 0, 0, false); }

  /// eqs. 11, 9 and 10, and the new velocities mapped: to be held by the supports yet.
  void kick_and_move(Bands& bands, double kick, double drift, double pic, bool from_kicked) {
    if (pic > 0)
      kick_and_move<true>(bands, kick, drift, pic, from_kicked);
    else
      kick_and_move<false>(bands, kick, drift, pic, from_kicked);
  }

  /// viscous: Inviscid or Damping. Damping knows the largest |D| only after all strains, so never Do::both with it.
  template <Do what, class LawOf, class Viscous>
  void strain_and_force(Bands& bands, const VectorField& velocity, double dt, LawOf& law, Viscous& viscous) {
    constexpr bool damped = std::is_same_v<Viscous, Damping>;
    static_assert(!damped || what != Do::both);
    const auto viscous_row = [&]([[maybe_unused]] std::size_t first) {
      if constexpr (damped)
        return viscous.row(first);
      else
        return viscous;
    };
    const auto cells = [&](std::size_t j, Band& band) {
      for_runs([&](std::size_t from, std::size_t node, std::size_t length) {
        const std::size_t first = index(from, j, 0), low = grid_.row(j) + node, high = grid_.row(j + 1) + node;
        with_count([&]<std::size_t n>() {
          strain_row<n, what>(
              places_, length, stride_, dt, grid_.hx, grid_.hy, state_.volume,
              {velocity.x.data() + low, velocity.x.data() + high}, {velocity.y.data() + low, velocity.y.data() + high},
              {state_.strain.xx.data() + first, state_.strain.yy.data() + first, state_.strain.xy.data() + first},
              law.row(j * columns_ + from, first), viscous_row(first), ShareRows(band.shares[0], node),
              ShareRows(band.shares[1], node));
        });
      });
      if constexpr (damped && what == Do::strain) viscous.note(j, index(0, j, 0), stride_, per_cell(), columns_);
    };
    if constexpr (what == Do::strain) {
      bands.for_each([&](Band& band) {
        for (std::size_t j = band.first; j < band.last; ++j) cells(j, band);
      });
      if constexpr (damped) viscous.find_largest();
    } else {
      bands.gather(cells, [&](std::size_t j, const double* x, const double* y) { accelerate(grid_, j, x, y); });
    }
  }

  /// Mean of a cell's strains.
  material::Tensor mean_strain(std::size_t i, std::size_t j) const {
    const auto mean = [&](const std::vector<double>& component) {
      return pair_sum<0>(places_.count,
                         [&](std::size_t b) {
                           return pair_sum<0>(places_.count, [&](std::size_t a) {
                             return component[index(i, j, b * places_.count + a)];
                           });
                         }) /
             static_cast<double>(per_cell());
    };
    return {mean(state_.strain.xx), mean(state_.strain.yy), mean(state_.strain.xy)};
  }

  void convect(Bands&) {}

  /// eq. 18 but for the loads: a = f/m of a row of nodes.
  static void accelerate(Grid& grid, std::size_t j, const double* x, const double* y) {
    const double* __restrict m = grid.mass.data() + grid.mass_row(j);
    double* __restrict ax = grid.acceleration.x.data() + grid.row(j);
    double* __restrict ay = grid.acceleration.y.data() + grid.row(j);
    for (std::size_t i = 0; i <= grid.nx; ++i) {
      ax[i] = x[i] / m[i];
      ay[i] = y[i] / m[i];
    }
  }

 private:
  /// Calls f(first column of particles, first of nodes, columns) for a row's cells: for all at once, or for those on
  /// either side of the cut.
  template <class F>
  void for_runs(F&& f) const {
    const std::size_t cut = std::min(grid_.cut, columns_);
    f(std::size_t{0}, std::size_t{0}, cut);
    if (cut < columns_) f(cut, cut + 1, columns_ - cut);
  }

  /// One and two particles along a side are known to the compiler beforehand.
  template <class F>
  void with_count(F&& f) const {
    if (places_.count == 1)
      f.template operator()<1>();
    else if (places_.count == 2)
      f.template operator()<2>();
    else
      f.template operator()<0>();
  }

  template <bool pic>
  void kick_and_move(Bands& bands, double kick, double drift, double part, bool from_kicked) {
    const std::size_t length = grid_.row_length();
    const auto kicked_row = [&](std::size_t j, double* x, double* y) {
      const double *vx = grid_.velocity.x.data() + grid_.row(j), *vy = grid_.velocity.y.data() + grid_.row(j);
      const double *ax = grid_.acceleration.x.data() + grid_.row(j), *ay = grid_.acceleration.y.data() + grid_.row(j);
#pragma GCC ivdep
      for (std::size_t i = 0; i < length; ++i) {
        x[i] = vx[i] + kick * ax[i];
        y[i] = vy[i] + kick * ay[i];
      }
    };
    bands.gather(
        [&](std::size_t j, Band& band) {
          NodeRows kx{grid_.kicked.x.data() + grid_.row(j), grid_.kicked.x.data() + grid_.row(j + 1)};
          NodeRows ky{grid_.kicked.y.data() + grid_.row(j), grid_.kicked.y.data() + grid_.row(j + 1)};
          if (!from_kicked) {  // the mapped velocities of row j are overwritten as soon as this row is done
            if (j == band.first) kicked_row(j, band.high[0].data(), band.high[1].data());
            for (std::size_t c = 0; c < 2; ++c) std::swap(band.low[c], band.high[c]);
            kicked_row(j + 1, band.high[0].data(), band.high[1].data());
            kx = {band.low[0].data(), band.high[0].data()};
            ky = {band.low[1].data(), band.high[1].data()};
          }
          const auto row = [&](std::size_t c, const std::vector<double>& a, NodeRows k, std::vector<double>& v,
                               std::vector<double>& u) {
            for_runs([&](std::size_t from, std::size_t node, std::size_t count) {
              const std::size_t first = index(from, j, 0), low = grid_.row(j) + node, high = grid_.row(j + 1) + node;
              with_count([&]<std::size_t n>() {
                kick_row<n, pic>(places_, count, stride_, kick, drift, part, {a.data() + low, a.data() + high},
                                 {k.low + node, k.high + node}, v.data() + first, u.data() + first,
                                 ShareRows(band.shares[c], node));
              });
            });
          };
          row(0, grid_.acceleration.x, kx, state_.velocity.x, state_.displacement.x);
          row(1, grid_.acceleration.y, ky, state_.velocity.y, state_.displacement.y);
        },
        [&](std::size_t j, const double* x, const double* y) {
          const double* __restrict m = grid_.mass.data() + grid_.mass_row(j);
          double* __restrict vx = grid_.velocity.x.data() + grid_.row(j);
          double* __restrict vy = grid_.velocity.y.data() + grid_.row(j);
          const double mass = state_.mass;
          for (std::size_t i = 0; i < length; ++i) {
            vx[i] = mass * x[i] / m[i];
            vy[i] = mass * y[i] / m[i];
          }
        });
  }

  Grid& grid_;
  Arrangement places_;
  std::vector<double> offset_;
  std::size_t columns_, stride_;
  State state_;
};

/// Particles that move through a grid which reaches beyond the plate's free sides as far as the plate itself. They are
/// kept in the order in which they started, cell by cell, and listed by the cell in which they are.
class Moving {
 public:
  static constexpr bool moving = true;

  Moving(const Plate&, const Cells& cells, const Places& places, Grid& grid)
      : grid_(grid),
        per_row_(places.count()),
        nx_(static_cast<std::size_t>(cells.x)),
        ny_(static_cast<std::size_t>(cells.y)) {
    const auto before = [](double start, double size) { return static_cast<std::size_t>(std::lround(-start / size)); };
    const std::size_t first_i = before(grid.left, grid.hx), first_j = before(grid.bottom, grid.hy);
    const std::size_t total = count();
    cell_.resize(total);
    offset_.resize(total);
    advance_.resize(total);
    order_.resize(total);
    for (std::size_t j = 0; j < ny_; ++j) {
      for (std::size_t i = 0; i < nx_; ++i) {
        for (std::size_t k = 0; k < per_cell(); ++k) {
          const std::size_t p = index(i, j, k);
          cell_[p] = static_cast<std::uint32_t>((j + first_j) * grid.nx + i + first_i);
          offset_.x[p] = places.offset[k % per_row_];
          offset_.y[p] = places.offset[k / per_row_];
        }
      }
    }
    list();
  }

  State& state() { return state_; }
  const State& state() const { return state_; }
  std::size_t per_cell() const { return per_row_ * per_row_; }
  std::size_t count() const { return nx_ * ny_ * per_cell(); }
  std::size_t storage() const { return count(); }
  std::size_t bytes() const {
    return state_.bytes() + offset_.bytes() + advance_.bytes() +
           (cell_.capacity() + order_.capacity()) * sizeof(std::uint32_t) + start_.capacity() * sizeof(std::size_t);
  }
  const std::string& trouble() const { return trouble_; }
  bool has_moved() const { return moved_; }

  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const { return (j * nx_ + i) * per_cell() + k; }
  std::size_t rows() const { return grid_.ny; }

  template <class F>
  void visit_row(std::size_t j, F&& f) const {
    for (std::size_t i = 0; i < grid_.nx; ++i) visit_cell(i, j, f);
  }
  Vector position(const Place& at) const {
    const std::size_t c = cell_[at.particle];
    return {grid_.x(c % grid_.nx) + (0.5 + offset_.x[at.particle]) * grid_.hx,
            grid_.y(c / grid_.nx) + (0.5 + offset_.y[at.particle]) * grid_.hy};
  }

  void map_mass(Bands& bands) {  // eq. 15
    gather(
        bands,
        [&](const Place&) {
          return Vector{state_.mass, 0};
        },
        [&](std::size_t j, const double* x, const double*) {
          std::copy(x, x + grid_.row_length(), grid_.mass.begin() + static_cast<std::ptrdiff_t>(grid_.row(j)));
        });
  }

  void map_momentum(Bands& bands) {
    gather(
        bands,
        [&](const Place& at) {
          return Vector{state_.mass * state_.velocity.x[at.particle], state_.mass * state_.velocity.y[at.particle]};
        },
        [&](std::size_t j, const double* x, const double* y) { divide_by_mass(grid_.velocity, j, x, y); });
  }

  void kick_and_move(Bands& bands, double kick, double drift, double pic, bool) {
    bands.for_each([&](Band& band) {
      for (std::size_t j = band.first; j < band.last; ++j) {
        visit_row(j, [&](const Place& at) {
          const Vector a = at.value(grid_.acceleration), before = at.value(grid_.velocity);
          const std::size_t p = at.particle;
          const auto component = [&](double& v, double& u, double& advance, double ai, double vi, double h) {
            const double grid = vi + kick * ai;
            v += kick * ai;
            if (pic > 0) v = (1 - pic) * v + pic * grid;
            u += drift * grid;
            advance = drift * grid / h;  // the grid is left behind only when the step is done
          };
          component(state_.velocity.x[p], state_.displacement.x[p], advance_.x[p], a[0], before[0], grid_.hx);
          component(state_.velocity.y[p], state_.displacement.y[p], advance_.y[p], a[1], before[1], grid_.hy);
        });
      }
    });
    map_momentum(bands);
  }

  template <Do what, class LawOf>
  void strain_and_force(Bands& bands, const VectorField& velocity, double dt, LawOf& law, Inviscid) {
    bands.for_each([&](Band& band) {
      for (std::size_t j = band.first; j < band.last; ++j) {
        visit_row(j, [&](const Place& at) {
          const material::Tensor rate = at.gradient(velocity, grid_);
          state_.strain.xx[at.particle] += dt * rate.xx;
          state_.strain.yy[at.particle] += dt * rate.yy;
          state_.strain.xy[at.particle] += dt * rate.xy;
        });
      }
    });
    map_force(bands, law);
  }

  /// eqs. 19 and 18 but for the loads, at the particles' present places.
  template <class LawOf>
  void map_force(Bands& bands, LawOf& law) {
    const double area_x = state_.volume / grid_.hx, area_y = state_.volume / grid_.hy;
    const auto row = law.row(0, 0);
    bands.gather(
        [&](std::size_t j, Band& band) {
          clear(band);
          visit_row(j, [&](const Place& at) {
            const std::size_t p = at.particle, i = at.node - grid_.row(j);
            const material::Tensor stress = row.stress(state_.strain[p], at.cell, p);
            const auto give = [&](std::size_t c, double along_x, double along_y) {
              const double x = area_x * along_x, y = area_y * along_y;
              CornerShares& s = band.shares[c];
              s.bottom_left[i] += at.bottom * x + at.left * y;
              s.bottom_right[i + 1] += at.right * y - at.bottom * x;
              s.top_left[i] += at.top * x - at.left * y;
              s.top_right[i + 1] -= at.top * x + at.right * y;
            };
            give(0, stress.xx, stress.xy);
            give(1, stress.xy, stress.yy);
          });
        },
        [&](std::size_t j, const double* x, const double* y) { divide_by_mass(grid_.acceleration, j, x, y); });
  }

  /// Of the particles that started in a cell.
  material::Tensor mean_strain(std::size_t i, std::size_t j) const {
    material::Tensor sum;
    for (std::size_t k = 0; k < per_cell(); ++k) sum = sum + state_.strain[index(i, j, k)];
    return sum * (1 / static_cast<double>(per_cell()));
  }

  /// Particles take up their new places on a grid that is as it was.
  void convect(Bands& bands) {
    bool crossed = false;
    for (std::size_t p = 0; p < count(); ++p) {
      const double x = offset_.x[p] + advance_.x[p], y = offset_.y[p] + advance_.y[p];
      if (std::abs(x) > 0.5 || std::abs(y) > 0.5) {
        crossed = true;
        cross(p, x, y);
      } else {
        offset_.x[p] = std::clamp(x, -edge, edge);
        offset_.y[p] = std::clamp(y, -edge, edge);
      }
      if (std::isnan(x) || std::isnan(y)) trouble_ = left_grid(p);
    }
    moved_ = true;
    if (crossed) list();
    map_mass(bands);
  }

  /// A displacement at the start.
  void displace(std::size_t p, const Vector& by) {
    advance_.x[p] = by[0] / grid_.hx;
    advance_.y[p] = by[1] / grid_.hy;
  }

 private:
  template <class F>
  void visit_cell(std::size_t i, std::size_t j, F&& f) const {
    const std::size_t c = j * grid_.nx + i;
    for (std::size_t q = start_[c]; q < start_[c + 1]; ++q) {
      const std::size_t p = order_[q];
      f(Place{p, grid_.row(j) + i, grid_.next_row(), 0, 0.5 - offset_.x[p], 0.5 + offset_.x[p], 0.5 - offset_.y[p],
              0.5 + offset_.y[p]});
    }
  }

  static void clear(Band& band) {
    for (CornerShares& s : band.shares) {
      for (auto* shares : {&s.bottom_left, &s.bottom_right, &s.top_left, &s.top_right})
        std::fill(shares->begin(), shares->end(), 0.0);
    }
  }

  template <class Give, class Nodes>
  void gather(Bands& bands, Give&& particle_gives, Nodes&& nodes) {
    bands.gather(
        [&](std::size_t j, Band& band) {
          clear(band);
          visit_row(j, [&](const Place& at) {
            const Vector given = particle_gives(at);
            const std::size_t i = at.node - grid_.row(j);
            for (std::size_t c = 0; c < 2; ++c) {
              CornerShares& s = band.shares[c];
              s.bottom_left[i] += at.bottom * (at.left * given[c]);
              s.bottom_right[i + 1] += at.bottom * (at.right * given[c]);
              s.top_left[i] += at.top * (at.left * given[c]);
              s.top_right[i + 1] += at.top * (at.right * given[c]);
            }
          });
        },
        nodes);
  }

  void divide_by_mass(VectorField& field, std::size_t j, const double* x, const double* y) {
    for (std::size_t i = 0; i <= grid_.nx; ++i) {
      const double m = grid_.mass_of(i, j);
      field.x[grid_.row(j) + i] = m > 0 ? x[i] / m : 0;
      field.y[grid_.row(j) + i] = m > 0 ? y[i] / m : 0;
    }
  }

  void cross(std::size_t p, double x, double y) {
    const auto along = [&](double offset, std::size_t cell, std::size_t cells, double& kept) {
      const double crossed = std::abs(offset) > 0.5 ? std::round(offset) : 0,
                   target = static_cast<double>(cell) + crossed;
      if (target >= 0 && target < static_cast<double>(cells)) {
        kept = std::clamp(offset - crossed, -edge, edge);
        return static_cast<std::size_t>(target);
      }
      if (std::abs(offset) > 0.5 + 1e-9) trouble_ = left_grid(p);  // else round-off beyond a wall
      kept = std::clamp(offset, -edge, edge);
      return cell;
    };
    const std::size_t i = along(x, cell_[p] % grid_.nx, grid_.nx, offset_.x[p]);
    const std::size_t j = along(y, cell_[p] / grid_.nx, grid_.ny, offset_.y[p]);
    cell_[p] = static_cast<std::uint32_t>(j * grid_.nx + i);
  }
  static std::string left_grid(std::size_t p) {
    return "particle " + std::to_string(p) +
           " left the grid, which reaches as far beyond a free side as the plate reaches";
  }

  /// Lists the particles by cells, each cell's in the order of their numbers.
  void list() {
    start_.assign(grid_.nx * grid_.ny + 1, 0);
    for (const std::uint32_t c : cell_) ++start_[c + 1];
    for (std::size_t c = 0; c + 1 < start_.size(); ++c) start_[c + 1] += start_[c];
    for (std::size_t p = cell_.size(); p-- > 0;) order_[--start_[cell_[p] + 1]] = static_cast<std::uint32_t>(p);
    // Each cell's start was counted down from its end; its end is the next one's start.
    std::rotate(start_.begin(), start_.begin() + 1, start_.end());
    start_.back() = cell_.size();
  }

  Grid& grid_;
  std::size_t per_row_, nx_, ny_;
  State state_;
  std::vector<std::uint32_t> cell_, order_;  // of each particle; particles by cells
  VectorField offset_, advance_;             // in cells, from the cell's centre; of the step at hand
  std::vector<std::size_t> start_;           // particles of cell c are order_[start_[c], start_[c+1])
  bool moved_ = false;
  std::string trouble_;
};

}  // namespace diptych::mpm
