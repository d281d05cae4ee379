// The particles of bars: what each carries, the cell it stands in, and the loops between particles and nodes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mpm/bar_grid.hpp"

namespace diptych::mpm::bars {

/// A particle stands in a cell at an offset η = ξ − ½ from its centre, so that N₁ = ½ − η, N₂ = ½ + η (eq. 6):
/// mirroring the bar or shifting it by whole cells leaves every bit of the shape functions alone. A particle on a node
/// stays one ulp inside its cell: no node it touches is without mass, and the limit ξ → 0 is taken rather than 0/0.
inline constexpr double edge = 0.5 - 0x1p-54;

/// What a particle must carry beside its state: nothing where one bar fills the grid cell by cell and stays; its cell
/// and mass where several bars stand in it; and its stretch where it moves.
enum class Carries { nothing, cell, stretch };

/// One bar of the scene: its particles are [first, last).
template <class Law>
struct Member {
  Law law;
  std::size_t cells, first, last;
  double particle_mass;
};

template <class Law, Carries carries, bool viscous>
class Particles {
 public:
  static constexpr bool placed = carries != Carries::nothing, convected = carries == Carries::stretch;

  /// `at`: natural coordinates ξ of the particles of every cell.
  Particles(const Scene& scene, const std::vector<Law>& laws, int cells, const std::vector<double>& at)
      : h(scene.bars[0].length / cells), scene_(scene), positions_(at), per_cell_(at.size()) {
    for (std::size_t b = 0, first = 0; b < scene.bars.size(); ++b) {
      const auto count = static_cast<std::size_t>(cells_of(scene, b, cells));
      member.push_back(
          {laws[b], count, first, first + count * per_cell_, laws[b].density * h / static_cast<double>(per_cell_)});
      first = member.back().last;
    }
    lay_cells();
    allocate(member.back().last);
    for (std::size_t b = 0; b < member.size(); ++b) place(b);
    if constexpr (placed) {
      count_by_cell();
    } else {
      for (std::size_t c = 0; c <= cells_; ++c) cell_start_[c] = c * per_cell_;
    }
  }

  // --- what a particle is --------------------------------------------------------------------------------------------

  double rest_length() const { return h / static_cast<double>(per_cell_); }
  /// Length of bar that a particle stands for [m]: constant unless the particles move.
  double length(std::size_t p) const {
    if constexpr (convected) return rest_length() * stretch[p];
    return rest_length();
  }
  double mass(std::size_t p) const {
    if constexpr (placed) return mass_[p];
    return member[0].particle_mass;
  }
  /// Of the law and of the viscosity together [Pa].
  double stress(std::size_t p) const {
    if constexpr (viscous) return state[p].stress + q[p];
    return state[p].stress;
  }
  /// Where the k-th particle of a bar started [m].
  double reference(std::size_t b, std::size_t k) const {
    const double cell = static_cast<double>(k / per_cell_) + positions_[k % per_cell_];
    return scene_.bars[b].begin + scene_.bars[b].length * (cell / static_cast<double>(member[b].cells));
  }
  /// How far from the left end of its bar the share of the k-th particle begins [m]; from the right end it is as far to
  /// the share of the k-th particle from there.
  double share_depth(std::size_t b, std::size_t k) const {
    return scene_.bars[b].length * (static_cast<double>(k) / static_cast<double>(member[b].cells * per_cell_));
  }
  /// Where it is now [m].
  double position(std::size_t cell, std::size_t p) const {
    return scene_.begin() + (static_cast<double>(cell) - static_cast<double>(first_cell_) + 0.5 + offset[p]) * h;
  }

  // --- where it stands -----------------------------------------------------------------------------------------------

  std::size_t cells() const { return cells_; }
  std::size_t cell_of(std::size_t p) const {
    if constexpr (placed) return static_cast<std::size_t>(cell_[p]);
    return p / per_cell_;
  }
  /// The first and the last cell in which a particle stands: there may be empty ones between bars, and beyond their
  /// ends three times as many as they fill.
  std::size_t first_filled() const { return cell_of(0); }
  std::size_t last_filled() const { return cell_of(offset.size() - 1); }
  std::size_t left_end_node() const { return cell_of(0); }
  std::size_t right_end_node() const { return cell_of(offset.size() - 1) + 1; }
  /// Whether the grid has a node that both bar `b` and the next one reach.
  bool share_a_node(std::size_t b) const {
    if constexpr (placed) return cell_[member[b + 1].first] - cell_[member[b].last - 1] <= 1;
    return false;
  }

  /// Takes every particle to where its `advance` leads, into another cell where it must.
  void convect() {
    int beyond = 0;
    for (std::size_t p = 0; p < offset.size(); ++p) beyond |= std::abs(offset[p] + advance[p]) > 0.5;
    if (!beyond) {
      for (std::size_t p = 0; p < offset.size(); ++p) offset[p] = std::clamp(offset[p] + advance[p], -edge, edge);
      return;
    }
    for (std::size_t p = 0; p < offset.size(); ++p) {
      const double moved = offset[p] + advance[p];
      if (std::abs(moved) > 0.5) {
        cross(p, moved);
      } else {
        offset[p] = std::clamp(moved, -edge, edge);
      }
    }
    count_by_cell();
  }

  // --- loops between particles and nodes -----------------------------------------------------------------------------

  /// Sum over a cell's particles from the outside in: a mirrored bar adds the same numbers in the same order.
  template <class F>
  auto sum_over_cell(std::size_t cell, F&& f) const {
    std::size_t low = cell_start_[cell], high = cell_start_[cell + 1];
    decltype(f(low)) sum{};
    for (; low + 1 < high; ++low) {
      --high;
      sum = sum + (f(low) + f(high));
    }
    if (low < high) sum = sum + f(low);
    return sum;
  }

  /// Visits the nodes that particles reach, in order, with the sum of what the particles of the two cells beside it
  /// give to each: contribution(p, its cell) is a Pair.
  template <class F, class Visit>
  void gather(F&& contribution, Visit&& visit) const {
    double carried = 0;
    const std::size_t end = last_filled() + 1;
    for (std::size_t c = first_filled(); c < end; ++c) {
      const Pair sum = sum_over_cell(c, [&](std::size_t p) { return contribution(p, c); });
      visit(c, carried + sum.left);
      carried = sum.right;
    }
    visit(end, carried);
  }

  /// Calls f(p, left node, right node) for the particles of one bar.
  template <class F>
  void for_each(const Member<Law>& bar, const std::vector<Node>& node, F&& f) const {
    if constexpr (placed) {
      for (std::size_t p = bar.first; p < bar.last; ++p) {
        const auto c = static_cast<std::size_t>(cell_[p]);
        f(p, node[c], node[c + 1]);
      }
    } else {
      for (std::size_t c = 0; c < cells_; ++c) {
        for (std::size_t p = c * per_cell_; p < (c + 1) * per_cell_; ++p) f(p, node[c], node[c + 1]);
      }
    }
  }
  template <class F>
  void for_each(const std::vector<Node>& node, F&& f) const {
    for (const Member<Law>& bar : member) for_each(bar, node, f);
  }

  // --- sums ----------------------------------------------------------------------------------------------------------

  double kinetic_energy() const {
    double sum = 0;
    for (std::size_t p = 0; p < velocity.size(); ++p) sum += mass(p) * velocity[p] * velocity[p] / 2;
    return sum;
  }
  /// Kinetic and stored.
  double energy() const {
    double sum = kinetic_energy();
    for (const Member<Law>& bar : member) {
      for (std::size_t p = bar.first; p < bar.last; ++p) sum += rest_length() * bar.law.stored(state[p]);
    }
    return sum;
  }
  double momentum() const {
    double sum = 0;
    for (std::size_t p = 0; p < velocity.size(); ++p) sum += mass(p) * velocity[p];
    return sum;
  }
  double total_mass() const {
    double sum = 0;
    for (const Member<Law>& bar : member) sum += static_cast<double>(bar.last - bar.first) * bar.particle_mass;
    return sum;
  }
  std::size_t bytes() const {
    const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    return of(offset) + of(state) + of(velocity) + of(displacement) + of(cell_) + of(mass_) + of(stretch) +
           of(advance) + of(q) + of(cell_start_);
  }
  const std::string& trouble() const { return trouble_; }

  const double h;  ///< size of a cell [m]
  std::vector<Member<Law>> member;
  // Per particle, in the order of the bars and hence of the cells:
  std::vector<double> offset, velocity, displacement;  ///< η [-], [m/s], [m]
  std::vector<typename Law::State> state;
  std::vector<double> stretch, advance;  ///< length over its first one; way of this step in cells; where particles move
  std::vector<double> q;                 ///< viscous stress [Pa], only with viscosity

 private:
  /// The grid has a face where the first bar begins. Bars that move have room on their free sides.
  void lay_cells() {
    const double span = scene_.end() - scene_.begin();
    auto cells = static_cast<std::size_t>(std::ceil(span / h * (1 - 1e-12)));
    if constexpr (!placed) cells = member[0].cells;
    first_cell_ = convected && scene_.left == Support::free ? cells : 0;
    cells_ = first_cell_ + cells + (convected && scene_.right == Support::free ? cells : 0);
    cell_start_.resize(cells_ + 1);
  }

  void allocate(std::size_t count) {
    offset.resize(count);
    state.resize(count);
    velocity.resize(count);
    displacement.resize(count);
    if constexpr (placed) {
      cell_.resize(count);
      mass_.resize(count);
    }
    if constexpr (convected) {
      stretch.assign(count, 1);
      advance.resize(count);
    }
    if constexpr (viscous) q.resize(count);
  }

  void place(std::size_t b) {
    const Bar& bar = scene_.bars[b];
    // Where the bar begins, in cells; a whole number but for round-off is whole, so that its shape functions are to
    // the bit those of the bar alone.
    double begin = (bar.begin - scene_.begin()) / h;
    if (std::abs(begin - std::round(begin)) < 1e-9) begin = std::round(begin);
    const double shift = begin - std::floor(begin);
    for (std::size_t p = member[b].first; p < member[b].last; ++p) {
      const std::size_t k = p - member[b].first;
      double at = positions_[k % per_cell_] - 0.5 + shift;
      auto cell = static_cast<std::int32_t>(first_cell_ + static_cast<std::size_t>(begin) + k / per_cell_);
      if (at > 0.5) {
        at -= 1;
        ++cell;
      }
      offset[p] = std::clamp(at, -edge, edge);
      if constexpr (placed) {
        cell_[p] = cell;
        mass_[p] = member[b].particle_mass;
      }
      if (bar.initial_stress) state[p].stress = bar.initial_stress(reference(b, k));
      if (bar.initial_velocity) velocity[p] = bar.initial_velocity(reference(b, k));
    }
  }

  void cross(std::size_t p, double moved) {
    const double cells_crossed = std::round(moved);
    const double target = static_cast<double>(cell_[p]) + cells_crossed;
    if (target >= 0 && target < static_cast<double>(cells_)) {
      cell_[p] = static_cast<std::int32_t>(target);
      offset[p] = std::clamp(moved - cells_crossed, -edge, edge);
    } else if (std::abs(moved) <= 0.5 + 1e-9) {  // round-off beyond a wall
      offset[p] = std::clamp(moved, -edge, edge);
    } else {
      trouble_ =
          "particle " + std::to_string(p) + " left the grid, which reaches as far beyond a free end as the bars reach";
    }
  }

  void count_by_cell() {
    std::size_t p = 0;
    for (std::size_t c = 0; c <= cells_; ++c) {
      while (p < cell_.size() && static_cast<std::size_t>(cell_[p]) < c) ++p;
      cell_start_[c] = p;
    }
    if (!std::is_sorted(cell_.begin(), cell_.end()) && trouble_.empty()) trouble_ = "particles passed one another";
  }

  const Scene& scene_;
  const std::vector<double>& positions_;
  std::size_t per_cell_, first_cell_ = 0, cells_ = 0;  // the first bar starts in first_cell_
  std::vector<std::size_t> cell_start_;                // particles of cell c are [cell_start_[c], cell_start_[c+1])
  std::vector<std::int32_t> cell_;                     // only where several bars stand in the grid, or particles move
  std::vector<double> mass_;                           // likewise
  std::string trouble_;
};

}  // namespace diptych::mpm::bars
