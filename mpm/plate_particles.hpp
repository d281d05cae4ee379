// Particles in the plate's cells: those that stay in their places, and those that move through the grid.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "hinge/solid/arrays.hpp"
#include "mpm/plate_grid.hpp"
#include "mpm/plate_kernels.hpp"
#include "mpm/plate_place.hpp"
#include "mpm/plate_viscosity.hpp"

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
  /// Sums of what `tell` says of the particles of columns [from, to) of a row of cells, cell by cell. told: room, which
  /// grows as needed.
  template <class Tell>
  std::array<double, told_by<Tell>> sum_row(std::size_t j, std::size_t from, std::size_t to, Tell tell,
                                            std::vector<double>& told) const {
    constexpr std::size_t numbers = told_by<Tell>;
    const std::size_t width = to - from, particles = per_cell();
    if (told.size() < numbers * particles * width) told.resize(numbers * particles * width);
    tell_row(j, from, to, tell, told.data());
    std::array<double, numbers> sum{};
    for (std::size_t i = 0; i < width; ++i) {
      for (std::size_t k = 0; k < particles; ++k) {
        for (std::size_t q = 0; q < numbers; ++q) sum[q] += told[(q * particles + k) * width + i];
      }
    }
    return sum;
  }
  template <class Tell>
  auto sum_row(std::size_t j, Tell tell, std::vector<double>& told) const {
    return sum_row(j, 0, columns_, tell, told);
  }
  /// See mpm::tell_row.
  template <class Tell>
  void tell_row(std::size_t j, std::size_t from, std::size_t to, Tell tell, double* out) const {
    for_runs([&](std::size_t first, std::size_t node, std::size_t length) {
      const std::size_t begin = std::max(first, from), end = std::min(first + length, to);
      if (begin >= end) return;
      const Place place{index(begin, j, 0),
                        grid_.row(j) + node + (begin - first),
                        grid_.next_row(),
                        j * columns_ + begin,
                        0,
                        0,
                        0,
                        0};
      with_count([&]<std::size_t n>() {
        mpm::tell_row<n>(places_, end - begin, stride_, place, tell, to - from, out + (begin - from));
      });
    });
  }

  Vector position(const Place& at) const {
    const std::size_t k = at.particle / stride_ % per_cell(), j = at.cell / columns_, i = at.cell % columns_;
    return {(static_cast<double>(i) + 0.5 + offset_[k % places_.count]) * grid_.hx,
            (static_cast<double>(j) + 0.5 + offset_[k / places_.count]) * grid_.hy};
  }

  void map_mass(Bands&);
  void map_momentum(Bands& bands) { kick_and_move(bands, 0, 0, 0, false); }

  /// eqs. 11, 9 and 10, and the new velocities mapped: to be held by the supports yet.
  void kick_and_move(Bands& bands, double kick, double drift, double pic, bool from_kicked);

  /// viscous: Inviscid or Damping. Damping knows the largest |D| only after all strains, so never Update::both with it.
  template <Update what, class Model, class Viscous>
  void strain_and_force(Bands& bands, const VectorField& velocity, double dt, Model& model, Viscous& viscous) {
    constexpr bool damped = std::is_same_v<Viscous, Damping>;
    static_assert(!damped || what != Update::both);
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
          strain_row<n, what>(places_, length, stride_, dt, grid_.hx, grid_.hy, state_.volume,
                              {velocity.x.data() + low, velocity.x.data() + high},
                              {velocity.y.data() + low, velocity.y.data() + high}, strain_rows(first),
                              model.row(j * columns_ + from, first), viscous_row(first),
                              ShareRows(band.shares[0], node), ShareRows(band.shares[1], node));
        });
      });
      if constexpr (damped && what == Update::strain) viscous.note(j, index(0, j, 0), stride_, per_cell(), columns_);
    };
    if constexpr (what == Update::strain) {
      bands.for_each([&](Band& band) {
        for (std::size_t j = band.first; j < band.last; ++j) cells(j, band);
      });
      if constexpr (damped) viscous.find_largest();
    } else {
      bands.gather(cells, [&](std::size_t j, const double* x, const double* y) { accelerate(grid_, j, x, y); });
    }
  }

  /// Mean of a cell's strains.
  material::Tensor mean_strain(std::size_t i, std::size_t j) const;
  /// What those of a row of cells show to what changes in cells.
  template <class Driver>
  void drive_row(std::size_t j, Driver driver, double* out) {
    const std::size_t first = index(0, j, 0);
    with_count(
        [&]<std::size_t n>() { mpm::drive_row<n>(places_.count, columns_, stride_, strain_rows(first), driver, out); });
  }

  void convect(Bands&) {}

  /// eq. 18 but for the loads: a = f/m of a row of nodes.
  static void accelerate(Grid& grid, std::size_t j, const double* x, const double* y);

 private:
  /// Calls f(first column of particles, first of nodes, columns) for a row's cells: for all at once, or for those on
  /// either side of the cut.
  template <class F>
  void for_runs(F&& f) const {
    const std::size_t cut = std::min(grid_.cut, columns_);
    f(std::size_t{0}, std::size_t{0}, cut);
    if (cut < columns_) f(cut, cut + 1, columns_ - cut);
  }

  TensorRows strain_rows(std::size_t first) {
    return {state_.strain.xx.data() + first, state_.strain.yy.data() + first, state_.strain.xy.data() + first};
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
  void kick_and_move(Bands& bands, double kick, double drift, double part, bool from_kicked);

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

  Moving(const Plate&, const Cells& cells, const Places& places, Grid& grid);

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
    if (j < reach_.bottom || j >= reach_.top) return;
    for (std::size_t i = reach_.left; i < reach_.right; ++i) visit_cell(i, j, f);
  }
  /// Sums of what `tell` says of the particles in a row of cells.
  template <class Tell>
  std::array<double, told_by<Tell>> sum_row(std::size_t j, Tell tell, std::vector<double>&) const {
    std::array<double, told_by<Tell>> sum{};
    visit_row(j, [&](const Place& at) {
      const auto told = tell(at);
      for (std::size_t q = 0; q < sum.size(); ++q) sum[q] += told[q];
    });
    return sum;
  }
  Vector position(const Place& at) const {
    const std::size_t c = cell_[at.particle];
    return {grid_.x(c % grid_.nx) + (0.5 + offset_.x[at.particle]) * grid_.hx,
            grid_.y(c / grid_.nx) + (0.5 + offset_.y[at.particle]) * grid_.hy};
  }

  void map_mass(Bands& bands);  // eq. 15
  void map_momentum(Bands& bands);
  void kick_and_move(Bands& bands, double kick, double drift, double pic, bool from_kicked);

  template <Update what, class Model>
  void strain_and_force(Bands& bands, const VectorField& velocity, double dt, Model& model, Inviscid) {
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
    if constexpr (what != Update::strain) map_force(bands, model);
  }

  /// eqs. 19 and 18 but for the loads, at the particles' present places.
  template <class Model>
  void map_force(Bands& bands, Model& model) {
    const double area_x = state_.volume / grid_.hx, area_y = state_.volume / grid_.hy;
    const auto row = model.row(0, 0);
    gather(
        bands,
        [&](const Place& at, Corners& sums) DIPTYCH_INLINE {
          const material::Tensor stress = row.stress(state_.strain[at.particle], at.cell, at.particle);
          const auto give = [&](std::size_t c, double along_x, double along_y) DIPTYCH_INLINE {
            const double x = area_x * along_x, y = area_y * along_y;
            sums.bottom_left[c] += at.bottom * x + at.left * y;
            sums.bottom_right[c] += at.right * y - at.bottom * x;
            sums.top_left[c] += at.top * x - at.left * y;
            sums.top_right[c] -= at.top * x + at.right * y;
          };
          give(0, stress.xx, stress.xy);
          give(1, stress.xy, stress.yy);
        },
        [&](std::size_t j, const double* x, const double* y) {
          divide_by_mass(grid_.acceleration, bands.reach(), j, x, y);
        });
  }

  /// Of the particles that started in a cell.
  material::Tensor mean_strain(std::size_t i, std::size_t j) const;

  /// Particles take up their new places on a grid that is as it was.
  void convect(Bands& bands);

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

  /// What the particles of a cell give to its corners, by component.
  struct Corners {
    std::array<double, 2> bottom_left{}, bottom_right{}, top_left{}, top_right{};
  };

  /// Calls give(place, corners) for all particles and nodes(j, x, y) for the rows of nodes, see Bands::gather.
  template <class Give, class Nodes>
  void gather(Bands& bands, Give&& give, Nodes&& nodes) {
    const Reach reach = bands.reach();
    bands.gather(
        [&](std::size_t j, Band& band) {
          for (CornerShares& s : band.shares)  // beyond the reach there is no cell
            s.bottom_right[reach.left] = s.top_right[reach.left] = s.bottom_left[reach.right] =
                s.top_left[reach.right] = 0;
          for (std::size_t i = reach.left; i < reach.right; ++i) {
            Corners sums;
            visit_cell(i, j, [&](const Place& at) DIPTYCH_INLINE { give(at, sums); });
            for (std::size_t c = 0; c < 2; ++c) {
              CornerShares& s = band.shares[c];
              s.bottom_left[i] = sums.bottom_left[c];
              s.bottom_right[i + 1] = sums.bottom_right[c];
              s.top_left[i] = sums.top_left[c];
              s.top_right[i + 1] = sums.top_right[c];
            }
          }
        },
        nodes);
  }
  /// The same of a vector that each particle gives by its shape functions, eq. 7.
  template <class Given, class Nodes>
  void gather_by_shape(Bands& bands, Given&& given, Nodes&& nodes) {
    gather(
        bands,
        [&](const Place& at, Corners& sums) DIPTYCH_INLINE {
          const Vector all = given(at);
          for (std::size_t c = 0; c < 2; ++c) {
            sums.bottom_left[c] += at.bottom * (at.left * all[c]);
            sums.bottom_right[c] += at.bottom * (at.right * all[c]);
            sums.top_left[c] += at.top * (at.left * all[c]);
            sums.top_right[c] += at.top * (at.right * all[c]);
          }
        },
        nodes);
  }
  void divide_by_mass(VectorField& field, const Reach&, std::size_t j, const double* x, const double* y);
  void cross(std::size_t p, double x, double y);
  void list();
  void find_reach();

  Grid& grid_;
  std::size_t per_row_, nx_, ny_;
  State state_;
  std::vector<std::uint32_t> cell_, order_;  // of each particle; particles by cells
  VectorField offset_, advance_;             // in cells, from the cell's centre; of the step at hand
  std::vector<std::size_t> start_;           // particles of cell c are order_[start_[c], start_[c+1])
  Reach reach_;                              // outside there are none
  bool moved_ = false;
  std::string trouble_;
};

}  // namespace diptych::mpm
