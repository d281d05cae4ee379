// Values of a grid's nodes, and the one sweep over them that every explicit scheme of the diffusion makes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <new>
#include <span>
#include <vector>

#include "hinge/diffusion/concentration.hpp"
#include "hinge/wide.hpp"

namespace diptych::diffusion {

/// Memory that begins where a line of the cache does.
template <class T>
struct CacheLines {
  using value_type = T;
  static constexpr std::align_val_t line{64};
  CacheLines() = default;
  template <class U>
  explicit CacheLines(const CacheLines<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), line)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, line); }
  bool operator==(const CacheLines&) const = default;
};

/// A value a node with a row of zeros below and above: a sweep over all nodes then reads only what is there.
class NodeField {
 public:
  NodeField() = default;
  /// Rows one after the other.
  explicit NodeField(const Grid& grid) : NodeField(grid, static_cast<std::size_t>(grid.nx) + 1) {}
  /// Rows begin `pitch` apart; what is between their ends and the next row's begin is zero.
  NodeField(const Grid& grid, std::size_t pitch)
      : pitch_(pitch),
        columns_(static_cast<std::size_t>(grid.nx) + 1),
        rows_(static_cast<std::size_t>(grid.ny) + 1),
        data_((rows_ + 2) * pitch) {}

  /// The pitch with which each row begins at a line of the cache: no load of a node's own row or column then straddles
  /// two of them.
  static std::size_t of_whole_lines(const Grid& grid) {
    constexpr std::size_t line = 8;  // in numbers
    return (static_cast<std::size_t>(grid.nx) + line) / line * line;
  }

  double* data() { return data_.data() + pitch_; }
  const double* data() const { return data_.data() + pitch_; }
  /// Of a field whose rows are one after the other.
  std::span<double> values() { return {data(), rows_ * columns_}; }
  std::span<const double> values() const { return {data(), rows_ * columns_}; }
  void fill(double value) { std::ranges::fill(values(), value); }
  /// Takes the values of a field of the same grid.
  void take(const NodeField& other) {
    for (std::size_t j = 0; j < rows_; ++j) std::copy_n(other.data() + j * other.pitch_, columns_, data() + j * pitch_);
  }
  std::size_t bytes() const { return data_.size() * sizeof(double); }

 private:
  std::size_t pitch_ = 0, columns_ = 0, rows_ = 0;
  std::vector<double, CacheLines<double>> data_;
};

/// combine(k, what flows into node k's volume per unit time), rows of `up` nodes. A face gives its two nodes the same
/// bits with opposite signs; and mirrored fields give mirrored bits.
template <class Combine>
DIPTYCH_WIDEST void for_inflows(std::ptrdiff_t nodes, std::ptrdiff_t up, const double* __restrict east,
                                const double* __restrict north, const double* __restrict u, Combine combine) {
#pragma GCC ivdep
  for (std::ptrdiff_t k = 0; k < nodes; ++k) {
    const double x = east[k] * (u[k + 1] - u[k]) - east[k - 1] * (u[k] - u[k - 1]);
    const double y = north[k] * (u[k + up] - u[k]) - north[k - up] * (u[k] - u[k - up]);
    combine(k, x + y);
  }
}

}  // namespace diptych::diffusion
