#include "mpm/plate_particles.hpp"

namespace diptych::mpm {

// --- particles that stay --------------------------------------------------------------------------------------------

void Standing::map_mass(Bands&) {  // eq. 15: the product of what stands beside and above a node
  const double near = pair_sum<0>(places_.count, [&](std::size_t a) { return places_.near[a]; });
  const double far = pair_sum<0>(places_.count, [&](std::size_t a) { return places_.far[a]; });
  const auto along = [&](bool first, bool last) { return first ? near : last ? far : far + near; };
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i <= grid_.nx; ++i)
      grid_.mass[grid_.row(j) + i] =
          state_.mass * (along(grid_.ends_left(i), grid_.ends_right(i)) * along(j == 0, j == 2));
  }
}

template <bool pic>
void Standing::kick_and_move(Bands& bands, double kick, double drift, double part, bool from_kicked) {
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

void Standing::kick_and_move(Bands& bands, double kick, double drift, double pic, bool from_kicked) {
  if (pic > 0)
    kick_and_move<true>(bands, kick, drift, pic, from_kicked);
  else
    kick_and_move<false>(bands, kick, drift, pic, from_kicked);
}

material::Tensor Standing::mean_strain(std::size_t i, std::size_t j) const {
  const auto mean = [&](const std::vector<double>& component) {
    return mean_of_cell<0>(places_.count, stride_, component.data() + index(0, j, 0), i);
  };
  return {mean(state_.strain.xx), mean(state_.strain.yy), mean(state_.strain.xy)};
}

void Standing::accelerate(Grid& grid, std::size_t j, const double* x, const double* y) {
  const double* __restrict m = grid.mass.data() + grid.mass_row(j);
  double* __restrict ax = grid.acceleration.x.data() + grid.row(j);
  double* __restrict ay = grid.acceleration.y.data() + grid.row(j);
  for (std::size_t i = 0; i <= grid.nx; ++i) {
    ax[i] = x[i] / m[i];
    ay[i] = y[i] / m[i];
  }
}

// --- particles that move --------------------------------------------------------------------------------------------

namespace {

std::string left_grid(std::size_t p) {
  return "particle " + std::to_string(p) +
         " left the grid, which reaches as far beyond a free side as the plate reaches";
}

}  // namespace

Moving::Moving(const Plate&, const Cells& cells, const Places& places, Grid& grid)
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

void Moving::divide_by_mass(VectorField& field, const Reach& reach, std::size_t j, const double* x, const double* y) {
  for (std::size_t i = reach.left; i <= reach.right; ++i) {
    const double m = grid_.mass_of(i, j);
    field.x[grid_.row(j) + i] = m > 0 ? x[i] / m : 0;
    field.y[grid_.row(j) + i] = m > 0 ? y[i] / m : 0;
  }
}

void Moving::cross(std::size_t p, double x, double y) {
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
/// Lists the particles by cells, each cell's in the order of their numbers.
void Moving::list() {
  start_.assign(grid_.nx * grid_.ny + 1, 0);
  for (const std::uint32_t c : cell_) ++start_[c + 1];
  for (std::size_t c = 0; c + 1 < start_.size(); ++c) start_[c + 1] += start_[c];
  for (std::size_t p = cell_.size(); p-- > 0;) order_[--start_[cell_[p] + 1]] = static_cast<std::uint32_t>(p);
  // Each cell's start was counted down from its end; its end is the next one's start.
  std::rotate(start_.begin(), start_.begin() + 1, start_.end());
  start_.back() = cell_.size();
  find_reach();
}

void Moving::find_reach() {
  reach_ = {grid_.nx, 0, grid_.ny, 0};
  for (std::size_t j = 0; j < grid_.ny; ++j) {
    const std::size_t *first = start_.data() + j * grid_.nx, *end = first + grid_.nx;  // of cells
    if (*first == *end) continue;
    reach_.bottom = std::min(reach_.bottom, j);
    reach_.top = j + 1;
    // Up to the first cell with particles, and from behind the last one, nothing is counted.
    const auto left = static_cast<std::size_t>(std::upper_bound(first, end, *first) - first - 1);
    const auto right = static_cast<std::size_t>(std::lower_bound(first, end, *end) - first);
    reach_.left = std::min(reach_.left, left);
    reach_.right = std::max(reach_.right, right);
  }
}

void Moving::map_mass(Bands& bands) {  // eq. 15
  if (!(bands.reach() == reach_)) {    // nodes that nobody reaches any more have nothing
    bands.set_reach(reach_);
    for (auto* field : {&grid_.mass, &grid_.velocity.x, &grid_.velocity.y, &grid_.acceleration.x, &grid_.acceleration.y,
                        &grid_.kicked.x, &grid_.kicked.y})
      std::fill(field->begin(), field->end(), 0.0);
  }
  gather_by_shape(
      bands,
      [&](const Place&) {
        return Vector{state_.mass, 0};
      },
      [&](std::size_t j, const double* x, const double*) {
        const Reach& reach = bands.reach();
        std::copy(x + reach.left, x + reach.right + 1, grid_.mass.data() + grid_.row(j) + reach.left);
      });
}

void Moving::map_momentum(Bands& bands) {
  gather_by_shape(
      bands,
      [&](const Place& at) {
        return Vector{state_.mass * state_.velocity.x[at.particle], state_.mass * state_.velocity.y[at.particle]};
      },
      [&](std::size_t j, const double* x, const double* y) { divide_by_mass(grid_.velocity, bands.reach(), j, x, y); });
}

void Moving::kick_and_move(Bands& bands, double kick, double drift, double pic, bool) {
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

material::Tensor Moving::mean_strain(std::size_t i, std::size_t j) const {
  material::Tensor sum;
  for (std::size_t k = 0; k < per_cell(); ++k) sum = sum + state_.strain[index(i, j, k)];
  return sum * (1 / static_cast<double>(per_cell()));
}

void Moving::convect(Bands& bands) {
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

}  // namespace diptych::mpm
