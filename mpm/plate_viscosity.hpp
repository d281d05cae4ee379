// Artificial viscosity of the plate's particles, eqs. 21 and 22.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "hinge/material/viscosity.hpp"
#include "hinge/scene/plate.hpp"
#include "hinge/solid/arrays.hpp"
#include "mpm/plate_grid.hpp"

namespace diptych::mpm {

/// No artificial viscosity.
struct Inviscid {
  static constexpr bool on = false;
};

/// Artificial viscosity of the plate's particles, eq. 21: q adds to both normal stresses in what gives forces.
class Damping {
 public:
  Damping(const material::Viscosity& viscosity, const Plate& plate, const Grid& grid, std::size_t particles)
      : whole_{viscosity, elastic(plate).density, elastic(plate).pressure_wave_speed(), std::sqrt(grid.hx * grid.hy)},
        row_largest_(grid.ny) {
    allocate(divergence_, particles);
  }

  /// Of a row of cells: plain addresses and what all particles share.
  struct Row {
    static constexpr bool on = true;
    material::Viscosity viscosity;
    double density = 0, speed = 0, h = 0;  ///< [kg/m³], c_d [m/s], √(hx hy) [m]
    double largest = 0;                    ///< |D| of all particles where it acts [1/s]
    double* divergence = nullptr;          ///< D of each particle [1/s]
    [[gnu::always_inline]] double stress(std::size_t p) const {
      return viscosity.stress(divergence[p], largest, density, speed, h);
    }
  };
  Row row(std::size_t first_particle) {
    Row r = whole_;
    r.divergence = divergence_.data() + first_particle;
    return r;
  }

  /// To be told of a row of cells once its D are new, `count` of them from each `first`, and then of all rows.
  void note(std::size_t row, std::size_t first, std::size_t stride, std::size_t places, std::size_t count) {
    double largest = 0;
    for (std::size_t k = 0; k < places; ++k) {
      const double* D = divergence_.data() + first + k * stride;
      for (std::size_t i = 0; i < count; ++i) {
        if (whole_.viscosity.acts(D[i])) largest = std::max(largest, std::abs(D[i]));
      }
    }
    row_largest_[row] = largest;
  }
  void find_largest() {
    whole_.largest = *std::max_element(row_largest_.begin(), row_largest_.end());
    acted_ |= whole_.largest > 0;
  }
  bool acted() const { return acted_; }

  /// q that stands [Pa].
  double stress(std::size_t p) const {
    return whole_.viscosity.stress(divergence_[p], whole_.largest, whole_.density, whole_.speed, whole_.h);
  }
  std::size_t bytes() const { return (divergence_.capacity() + row_largest_.capacity()) * sizeof(double); }

 private:
  Row whole_;
  std::vector<double> divergence_, row_largest_;
  bool acted_ = false;
};

}  // namespace diptych::mpm
