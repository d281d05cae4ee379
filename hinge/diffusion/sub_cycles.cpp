#include "hinge/diffusion/sub_cycles.hpp"

#include <algorithm>
#include <utility>

#include "hinge/wide.hpp"

namespace diptych::diffusion {
namespace {

DIPTYCH_WIDE void add_source(std::size_t count, double part, const double* __restrict source, double* __restrict out) {
  for (std::size_t k = 0; k < count; ++k) out[k] += part * source[k];
}

/// So many rows of the five fields stay in the second cache while parts roll over them.
std::ptrdiff_t rows_at_hand(std::size_t pitch) {
  constexpr std::size_t share_of_cache = 256 * 1024;
  return static_cast<std::ptrdiff_t>(std::max<std::size_t>(2, share_of_cache / (5 * sizeof(double) * pitch)));
}

}  // namespace

void euler(const Faces& faces, std::ptrdiff_t nodes, const double* __restrict u, double* __restrict out) {
  for_inflows(nodes, faces.up, faces.east, faces.north, u,
              [=, s = faces.scale](std::ptrdiff_t k, double inflow) DIPTYCH_INLINE { out[k] = u[k] + s[k] * inflow; });
}

SubCycles::SubCycles(const Grid& grid)
    : columns_(static_cast<std::size_t>(grid.nx) + 1),
      rows_(static_cast<std::size_t>(grid.ny) + 1),
      pitch_(NodeField::of_whole_lines(grid)),
      u_(grid, pitch_),
      next_(grid, pitch_),
      first_run_(rows_ + 1) {}

void SubCycles::feed(std::span<const std::size_t> nodes, std::span<const double> source) {
  source_ = source;
  runs_.clear();
  std::size_t row = 0;
  for (const std::size_t k : nodes) {
    const std::size_t j = k / columns_;
    for (; row <= j; ++row) first_run_[row] = runs_.size();
    if (first_run_[j] < runs_.size() && runs_.back().node + runs_.back().count == k)
      ++runs_.back().count;
    else
      runs_.push_back({j * pitch_ + k % columns_, k, 1});
  }
  for (; row <= rows_; ++row) first_run_[row] = runs_.size();
}

void SubCycles::take(long parts, const NodeField& east, const NodeField& north, const NodeField& scale, double part) {
  const long most = std::max(1L, static_cast<long>(rows_at_hand(pitch_) / 2));
  for (long done = 0; done < parts; done += most) roll(std::min(most, parts - done), east, north, scale, part);
}

void SubCycles::roll(long parts, const NodeField& east, const NodeField& north, const NodeField& scale, double part) {
  const auto rows = static_cast<std::ptrdiff_t>(rows_), pitch = static_cast<std::ptrdiff_t>(pitch_);
  const std::ptrdiff_t block = rows_at_hand(pitch_) / 2;
  double* const fields[] = {u_.data(), next_.data()};
  const auto rows_of_part = [&](long i, std::ptrdiff_t from, std::ptrdiff_t to) {
    const std::ptrdiff_t first = from * pitch;
    const Faces faces{pitch, east.data() + first, north.data() + first, scale.data() + first};
    euler(faces, (to - from) * pitch, fields[i % 2] + first, fields[(i + 1) % 2] + first);
    for (std::size_t r = first_run_[static_cast<std::size_t>(from)]; r < first_run_[static_cast<std::size_t>(to)]; ++r)
      add_source(runs_[r].count, part, source_.data() + runs_[r].node, fields[(i + 1) % 2] + runs_[r].place);
  };
  // Of two fields: part i has read a row and both beside it when part i + 1, a row behind, writes over them.
  for (std::ptrdiff_t first = 0; first < rows + parts - 1; first += block) {
    for (long i = 0; i < parts; ++i) {
      const std::ptrdiff_t from = std::max<std::ptrdiff_t>(0, first - i), to = std::min(rows, first + block - i);
      if (from < to) rows_of_part(i, from, to);
    }
  }
  if (parts % 2 == 1) std::swap(u_, next_);
}

std::size_t SubCycles::bytes() const {
  return u_.bytes() + next_.bytes() + runs_.capacity() * sizeof(Run) + first_run_.capacity() * sizeof(std::size_t);
}

}  // namespace diptych::diffusion
