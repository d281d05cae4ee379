// The background grid of the plate: 4-node cells, what supports do to its nodes, and how cells' shares add up on them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "hinge/scene/plate.hpp"
#include "hinge/solid/arrays.hpp"
#include "hinge/step/threads.hpp"

namespace diptych::mpm {

/// A vector on every node or particle, one array a component.
struct VectorField {
  std::vector<double> x, y;
  void resize(std::size_t count) {
    allocate(x, count);
    allocate(y, count);
  }
  std::size_t bytes() const { return (x.capacity() + y.capacity()) * sizeof(double); }
};

/// Nodes row by row from the bottom, each row from the left.
struct Grid {
  static constexpr std::size_t uncut = static_cast<std::size_t>(-1);
  std::size_t nx = 1, ny = 1;   ///< cells across and up
  double hx = 1, hy = 1;        ///< of a cell [m]
  double left = 0, bottom = 0;  ///< where the first node stands [m]
  std::size_t stride = 2;       ///< from a node to the one above it, ≥ nx + 1
  bool alike = true;            ///< all rows between the bottom and the top one have the same masses, stored once
  /// Column of nodes at which two bodies meet that were apart: this one is the left one's and the next one the right
  /// one's, both at the same place, and the column of cells between them holds nothing.
  std::size_t cut = uncut;
  std::vector<double> mass;  ///< [kg]
  VectorField velocity;      ///< mapped from the particles [m/s]
  VectorField acceleration;  ///< [m/s²]
  VectorField kicked;        ///< the grid's own new velocity, kept for USL only [m/s]

  std::size_t row_length() const { return nx + 1; }
  std::size_t next_row() const { return stride; }
  std::size_t row(std::size_t j) const { return j * stride; }
  std::size_t nodes() const { return (nx + 1) * (ny + 1); }
  /// Columns of cells that there are without the one at the cut, and where the i-th of them is in the grid.
  std::size_t columns() const { return cut == uncut ? nx : nx - 1; }
  std::size_t column(std::size_t i) const { return i < cut ? i : i + 1; }
  bool ends_right(std::size_t i) const { return i == nx || i == cut; }  ///< node column without a cell to its right
  bool ends_left(std::size_t i) const { return i == 0 || i == cut + 1; }
  std::size_t storage() const { return stride * (ny + 1); }
  std::size_t mass_rows() const { return alike ? 3 : ny + 1; }
  std::size_t mass_row(std::size_t j) const { return row(!alike ? j : j == 0 ? 0 : j == ny ? 2 : 1); }
  double mass_of(std::size_t i, std::size_t j) const { return mass[mass_row(j) + i]; }
  double x(std::size_t i) const { return left + static_cast<double>(i <= cut ? i : i - 1) * hx; }
  double y(std::size_t j) const { return bottom + static_cast<double>(j) * hy; }
  std::size_t bytes() const {
    return mass.capacity() * sizeof(double) + velocity.bytes() + acceleration.bytes() + kicked.bytes();
  }
};

/// The grid of a plate. Flyer and target in front of a gap have nodes of their own, and where `roaming` particles move
/// through it there is room on the plate's free sides. Masses are yet to be mapped.
Grid grid_of(const Plate&, const Cells&, bool roaming, bool keeps_kicked);

/// What the cells of a row give to their four corners, one number a cell: bottom left, bottom right, top left, top
/// right. Left shares stand at the cell's number, right ones at the next, where the node's number is.
struct CornerShares {
  std::vector<double> bottom_left, bottom_right, top_left, top_right;
  void resize(std::size_t row_length) {
    for (auto* shares : {&bottom_left, &bottom_right, &top_left, &top_right}) {
      shares->reserve(off_pages(row_length, 8));
      shares->assign(row_length, 0);
    }
  }
};

/// A run of cell rows that one thread works on, with room for what rolls through.
struct Band {
  std::size_t first = 0, last = 0;  ///< rows [first, last)
  std::array<CornerShares, 2> shares;
  std::array<std::vector<double>, 2> from_below, seam, sum;  ///< of one node row
  std::array<std::vector<double>, 2> low, high;              ///< kicked velocities of the row's bottom and top nodes
  std::vector<double> told;                                  ///< of a row's particles, where something is added up
};

/// Cells from `left` to before `right`, of rows from `bottom` to before `top`.
struct Reach {
  std::size_t left = 0, right = 0, bottom = 0, top = 0;
  bool operator==(const Reach&) const = default;
};

/// The rows' bands and the threads that take them. Nothing of a sum depends on their number: a node's value is (what
/// the row below gives) + (what the row above gives), and each of the two is (left cell) + (right cell).
class Bands {
 public:
  Bands(std::size_t rows, std::size_t row_length, int threads) : reach_{0, row_length - 1, 0, rows}, threads_(threads) {
    const std::size_t count = std::min(rows, static_cast<std::size_t>(std::max(1, threads)));
    bands_.resize(count);
    for (std::size_t b = 0; b < count; ++b) {
      Band& band = bands_[b];
      band.first = rows * b / count;
      band.last = rows * (b + 1) / count;
      for (std::size_t c = 0; c < 2; ++c) {
        band.shares[c].resize(row_length);
        for (auto* row : {&band.from_below, &band.seam, &band.sum, &band.low, &band.high}) {
          (*row)[c].reserve(off_pages(row_length, 8));
          (*row)[c].assign(row_length, 0);
        }
      }
    }
  }

  template <class F>
  void for_each(F&& f) {
    threads_.for_each(bands_.size(), [&](std::size_t b) { f(bands_[b]); });
  }

  /// From now on only these cells have particles: what is outside gives nothing, and its nodes are not visited.
  void set_reach(const Reach& reach) { reach_ = reach; }
  const Reach& reach() const { return reach_; }

  /// Calls cells(j, band) for each row of cells, which leaves what they give to their nodes in band.shares, and
  /// nodes(j, x, y) for each row of nodes with the sums, as soon as the row of cells above has been visited.
  template <class Cells, class Nodes>
  void gather(Cells&& cells, Nodes&& nodes) {
    const std::size_t left = reach_.left, end = reach_.right + 1;  // of nodes
    const auto clear = [&](std::vector<double>& row) {
      std::fill(row.begin() + static_cast<std::ptrdiff_t>(left), row.begin() + static_cast<std::ptrdiff_t>(end), 0.0);
    };
    for_each([&](Band& band) {
      const std::size_t first = std::max(band.first, reach_.bottom), last = std::min(band.last, reach_.top);
      for (auto& row : band.from_below) clear(row);
      for (std::size_t j = first; j < last; ++j) {
        cells(j, band);
        const bool at_seam = j == band.first && &band != &bands_.front();
        for (std::size_t c = 0; c < 2; ++c) {
          const CornerShares& s = band.shares[c];
          double *below = band.from_below[c].data(), *sum = at_seam ? band.seam[c].data() : band.sum[c].data();
          const double *bl = s.bottom_left.data(), *br = s.bottom_right.data();
          const double *tl = s.top_left.data(), *tr = s.top_right.data();
#pragma GCC ivdep
          for (std::size_t i = left; i < end; ++i) {
            sum[i] = below[i] + (br[i] + bl[i]);
            below[i] = tr[i] + tl[i];
          }
        }
        if (!at_seam) nodes(j, band.sum[0].data(), band.sum[1].data());
      }
      if (band.first < reach_.bottom || first >= last) {  // its first row gives nothing to the seam below it
        for (auto& row : band.seam) clear(row);
      }
      const bool to_seam = last == band.last && &band != &bands_.back();
      if (first < last && !to_seam) nodes(last, band.from_below[0].data(), band.from_below[1].data());
    });
    for (std::size_t b = 1; b < bands_.size(); ++b) {
      Band &below = bands_[b - 1], &above = bands_[b];
      if (above.first < reach_.bottom || above.first > reach_.top) continue;
      for (std::size_t c = 0; c < 2; ++c) {
        for (std::size_t i = left; i < end; ++i) above.seam[c][i] += below.from_below[c][i];
      }
      nodes(above.first, above.seam[0].data(), above.seam[1].data());
    }
  }

  /// With one thread.
  std::size_t bytes() const {
    return (18 * bands_[0].sum[0].capacity() + bands_[0].told.capacity()) * sizeof(double) + sizeof(Band);
  }

 private:
  std::vector<Band> bands_;
  Reach reach_;
  Threads threads_;
};

/// Holds the grid's sides in velocity and acceleration. Supports reach along the whole side of the grid.
class Supports {
 public:
  /// A node that moves as it is told.
  struct Driven {
    std::size_t i, j;
    Side side;
    Vector before, after;         ///< given velocities at the last two levels [m/s]
    Vector unheld{}, reaction{};  ///< the velocity that the particles would give it, and its support's force [N]
  };

  Supports(const Plate& plate, Grid& grid) : plate_(plate), grid_(grid) {
    for (const Side side : sides) {
      if (plate.edge(side).support == Edge::Support::platen) platens_.push_back(platen_on(side));
      if (plate.edge(side).support == Edge::Support::driven) {
        for_nodes(side, [&](std::size_t i, std::size_t j) {
          const auto here = [&](const Driven& d) { return d.i == i && d.j == j; };
          if (std::any_of(driven_.begin(), driven_.end(), here)) return;  // a corner goes with the first of its sides
          Vector v = plate.initial_velocity ? plate.initial_velocity(grid.x(i), grid.y(j)) : Vector{0, 0};
          if (plate.impact && grid.x(i) < plate.impact->face) v = {plate.impact->velocity, 0};
          driven_.push_back({i, j, side, v, v});
        });
      }
    }
  }

  bool free() const {
    for (const Side side : sides) {
      const auto support = plate_.edge(side).support;
      if (support != Edge::Support::free && support != Edge::Support::platen) return false;
    }
    return true;
  }
  bool has_platen() const { return !platens_.empty(); }
  /// From now on the nodes on both sides of the grid's cut move as one.
  void join() { joined_ = true; }
  const std::vector<Driven>& driven() const { return driven_; }
  std::size_t bytes() const { return driven_.capacity() * sizeof(Driven); }

  /// Holds the velocities just mapped. Returns Σ m (held − mapped) along (1, 1) [kg m/s].
  double hold_velocity() {
    for (Driven& d : driven_) d.unheld = {grid_.velocity.x[at(d.i, d.j)], grid_.velocity.y[at(d.i, d.j)]};
    if (joined_) unite(grid_.velocity);
    level_platens(grid_.velocity);
    return hold(grid_.velocity, [](const Driven& d) { return d.after; });
  }

  /// Holds the accelerations of a kick [from, to]. Returns the supports' forces along (1, 1) [N].
  double hold_acceleration(double to, double kick) {
    for (Driven& d : driven_) {
      d.before = d.after;
      d.after = plate_.edge(d.side).velocity(grid_.x(d.i), grid_.y(d.j), to);
      d.reaction = {grid_.acceleration.x[at(d.i, d.j)], grid_.acceleration.y[at(d.i, d.j)]};
    }
    if (joined_) unite(grid_.acceleration);
    level_platens(grid_.acceleration);
    const double total = hold(grid_.acceleration, [&](const Driven& d) {
      return Vector{(d.after[0] - d.before[0]) / kick, (d.after[1] - d.before[1]) / kick};
    });
    for (Driven& d : driven_) {
      const double m = grid_.mass_of(d.i, d.j);
      d.reaction = {m * (grid_.acceleration.x[at(d.i, d.j)] - d.reaction[0]),
                    m * (grid_.acceleration.y[at(d.i, d.j)] - d.reaction[1])};
    }
    return total;
  }

  /// Of the first platen along its outward normal, of a field that stands held.
  double of_platen(const VectorField& field) const {
    const Platen& p = platens_.front();
    return outward(p.side) * (p.along_x ? field.x : field.y)[p.first];
  }

  /// Calls f(i, j) for the nodes of a side, towards larger coordinates.
  template <class F>
  void for_nodes(Side side, F&& f) const {
    if (across(side) == 0) {
      for (std::size_t j = 0; j <= grid_.ny; ++j) f(side == Side::left ? 0 : grid_.nx, j);
    } else {
      for (std::size_t i = 0; i <= grid_.nx; ++i) f(i, side == Side::bottom ? 0 : grid_.ny);
    }
  }

 private:
  std::size_t at(std::size_t i, std::size_t j) const { return grid_.row(j) + i; }

  /// A side's nodes that move as one across it: all but those at its ends that a side beside it holds or drives.
  struct Platen {
    Side side;
    bool along_x;  ///< moves along x
    std::size_t first, stride, count, i, j;
  };

  Platen platen_on(Side side) const {
    const bool along_x = across(side) == 0;
    const auto held = [&](Side beside) {
      const auto support = plate_.edge(beside).support;
      return support == Edge::Support::fixed || support == Edge::Support::driven ? std::size_t{1} : std::size_t{0};
    };
    const std::size_t skipped = held(along_x ? Side::bottom : Side::left);
    const std::size_t count = (along_x ? grid_.ny : grid_.nx) + 1 - skipped - held(along_x ? Side::top : Side::right);
    const std::size_t i = side == Side::right ? grid_.nx : along_x ? 0 : skipped;
    const std::size_t j = side == Side::top ? grid_.ny : along_x ? skipped : 0;
    return {side, along_x, at(i, j), along_x ? grid_.next_row() : 1, count, i, j};
  }

  /// A platen's nodes share their momentum or force across the side: the M-orthogonal mean, which does no work. Summed
  /// from the outside in, so that a mirrored plate adds the same numbers.
  void level_platens(VectorField& field) {
    for (const Platen& p : platens_) {
      double* values = (p.along_x ? field.x : field.y).data() + p.first;
      const auto mass = [&](std::size_t k) {
        return grid_.mass_of(p.along_x ? p.i : p.i + k, p.along_x ? p.j + k : p.j);
      };
      double sum = 0, masses = 0;
      for (std::size_t k = 0; k < p.count / 2; ++k) {
        const std::size_t far = p.count - 1 - k;
        sum += mass(k) * values[k * p.stride] + mass(far) * values[far * p.stride];
        masses += mass(k) + mass(far);
      }
      if (p.count % 2 == 1) {
        const std::size_t middle = p.count / 2;
        sum += mass(middle) * values[middle * p.stride];
        masses += mass(middle);
      }
      for (std::size_t k = 0; k < p.count; ++k) values[k * p.stride] = sum / masses;
    }
  }

  /// The single-valued field of MPM's own contact: two nodes at one place share their momentum or force.
  void unite(VectorField& field) {
    for (std::size_t j = 0; j <= grid_.ny; ++j) {
      const std::size_t a = at(grid_.cut, j), b = a + 1;
      const double of_a = grid_.mass_of(grid_.cut, j), of_b = grid_.mass_of(grid_.cut + 1, j);
      for (auto* values : {&field.x, &field.y}) {
        double *left = values->data() + a, *right = values->data() + b;
        *left = *right = (of_a * *left + of_b * *right) / (of_a + of_b);
      }
    }
  }

  template <class Given>
  double hold(VectorField& field, Given&& given) {
    double total = 0;
    const auto set = [&](std::vector<double>& values, std::size_t i, std::size_t j, double value) {
      double& old = values[at(i, j)];
      total += grid_.mass_of(i, j) * (value - old);
      old = value;
    };
    for (const Driven& d : driven_) {
      const Vector v = given(d);
      set(field.x, d.i, d.j, v[0]);
      set(field.y, d.i, d.j, v[1]);
    }
    for (const Side side : sides) {  // a wall at rest has the last word at a corner
      const auto support = plate_.edge(side).support;
      if (support != Edge::Support::roller && support != Edge::Support::fixed) continue;
      const bool along_x = across(side) == 0, all = support == Edge::Support::fixed;
      for_nodes(side, [&](std::size_t i, std::size_t j) {
        if (along_x || all) set(field.x, i, j, 0);
        if (!along_x || all) set(field.y, i, j, 0);
      });
    }
    return total;
  }

  const Plate& plate_;
  Grid& grid_;
  std::vector<Platen> platens_;
  std::vector<Driven> driven_;
  bool joined_ = false;
};

}  // namespace diptych::mpm
