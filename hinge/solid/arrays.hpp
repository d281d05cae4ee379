// Tensors of a plate's points and stiffnesses of its cells, one array a component: what loops over rows of cells read.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "hinge/material/plane.hpp"

namespace diptych {

/// Room for `count` numbers, with a little to spare where arrays of this length that are allocated one after the other
/// would begin a whole multiple of 64 KiB apart: all of them would fall on the same few lines of the caches.
inline std::size_t off_cycles(std::size_t count) {
  constexpr std::size_t cycle = 8192, near = 1024;  // in numbers
  return count + ((count + near) % cycle < 3 * near && count > cycle ? 4 * near : 0);
}
/// `count` zeros in such room.
inline void allocate(std::vector<double>& values, std::size_t count) {
  values.reserve(off_cycles(count));
  values.assign(count, 0);
}

/// A length for rows of which several are worked on together, a few numbers longer where rows of the length itself
/// would lie whole pages apart, which caches and store buffers take for one and the same address.
inline std::size_t off_pages(std::size_t length, std::size_t rows) {
  constexpr std::size_t page = 512, near = 16;  // in numbers
  const auto clashes = [&](std::size_t padded) {
    for (std::size_t k = 1; k < std::min<std::size_t>(rows, 8); ++k) {
      const std::size_t apart = k * padded;
      if (apart + near > page && (apart + near) % page < 2 * near) return true;
    }
    return false;
  };
  for (std::size_t padded = length; padded < length + 64; ++padded) {
    if (!clashes(padded)) return padded;
  }
  return length;
}

/// A symmetric tensor on every point.
struct TensorField {
  std::vector<double> xx, yy, xy;
  void resize(std::size_t count) {
    for (auto* component : {&xx, &yy, &xy}) allocate(*component, count);
  }
  [[gnu::always_inline]] material::Tensor operator[](std::size_t p) const { return {xx[p], yy[p], xy[p]}; }
  void set(std::size_t p, const material::Tensor& t) { xx[p] = t.xx, yy[p] = t.yy, xy[p] = t.xy; }
  std::size_t bytes() const { return (xx.capacity() + yy.capacity() + xy.capacity()) * sizeof(double); }
};

/// Components of it from a point on, as plain addresses.
struct TensorRow {
  double *xx = nullptr, *yy = nullptr, *xy = nullptr;
  TensorRow(TensorField& field, std::size_t first)
      : xx(field.xx.data() + first), yy(field.yy.data() + first), xy(field.xy.data() + first) {}
  [[gnu::always_inline]] void set(std::size_t i, const material::Tensor& t) const {
    xx[i] = t.xx;
    yy[i] = t.yy;
    xy[i] = t.xy;
  }
};

/// A stiffness of every cell.
struct StiffnessField {
  std::vector<double> normal, cross, shear;
  void assign(std::size_t count, const material::Stiffness& all) {
    normal.assign(count, all.normal);
    cross.assign(count, all.cross);
    shear.assign(count, all.shear);
  }
  void set(std::size_t k, const material::Stiffness& s) {
    normal[k] = s.normal, cross[k] = s.cross, shear[k] = s.shear;
  }
  material::Stiffness operator[](std::size_t k) const { return {normal[k], cross[k], shear[k]}; }
  std::size_t bytes() const { return (normal.capacity() + cross.capacity() + shear.capacity()) * sizeof(double); }
};

/// A row of cells of it, as plain addresses.
struct StiffnessRow {
  const double *normal = nullptr, *cross = nullptr, *shear = nullptr;
  [[gnu::always_inline]] StiffnessRow(const StiffnessField& field, std::size_t first)
      : normal(field.normal.data() + first), cross(field.cross.data() + first), shear(field.shear.data() + first) {}
};

}  // namespace diptych
