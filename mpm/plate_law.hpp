// What a particle's stress follows from: its total strain, the crack density or dilatancy of its cell, its plastic
// strain. And the artificial viscosity beside it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "hinge/diffusion/damage_evolution.hpp"
#include "hinge/scene/plate.hpp"
#include "mpm/plate_grid.hpp"

namespace diptych::mpm {

/// A symmetric tensor on every particle, one array a component.
struct TensorField {
  std::vector<double> xx, yy, xy;
  void resize(std::size_t count) {
    for (auto* component : {&xx, &yy, &xy}) allocate(*component, count);
  }
  material::Tensor operator[](std::size_t p) const { return {xx[p], yy[p], xy[p]}; }
  std::size_t bytes() const { return (xx.capacity() + yy.capacity() + xy.capacity()) * sizeof(double); }
};

/// A stiffness of every cell, one array a modulus.
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
  StiffnessRow() = default;
  StiffnessRow(const StiffnessField& field, std::size_t first)
      : normal(field.normal.data() + first), cross(field.cross.data() + first), shear(field.shear.data() + first) {}
};

/// What changes the law of a cell.
enum class Damage { none, cracks, failure_wave };

template <Damage damage, bool plastic_>
class Law {
 public:
  static constexpr bool damaging = damage == Damage::cracks, failing = damage == Damage::failure_wave;
  static constexpr bool plastic = plastic_;

  Law(const Plate& plate, std::size_t cells, std::size_t particles) : whole_(elastic(plate).stiffness()) {
    if constexpr (failing) failure_ = std::get<material::FailureWave>(plate.material);
    if constexpr (damaging) {
      material_ = std::get<material::TensileDamage>(plate.material);
      crack_density_.assign(cells, 0);
      for (StiffnessField* field : {&open_, &closed_}) field->assign(cells, whole_);
    }
    if constexpr (plastic) {
      compression_ = *plate.compression;
      plastic_strain_.resize(particles);
    }
  }

  /// The law of a row of cells and its particles: plain addresses, for a loop.
  struct Row {
    material::Stiffness whole;
    StiffnessRow open, closed;
    material::FailureWave failure;
    const double* dilatancy = nullptr;
    const material::Compression* compression = nullptr;
    double *xx = nullptr, *yy = nullptr, *xy = nullptr;  // plastic strain

    /// Of particle p in cell i of the row; brings the plastic strain up to date.
    [[gnu::always_inline]] material::Tensor stress(const material::Tensor& strain, std::size_t i,
                                                   [[maybe_unused]] std::size_t p) const {
      if constexpr (failing) return failure.stress(strain, dilatancy[i]);
      const material::Stiffness now = stiffness(strain, i);
      if constexpr (plastic) {
        material::PlasticStrain state{xx[p], yy[p], xy[p]};
        double dissipated = 0;
        const material::Tensor stress = compression->stress(now, strain, state, dissipated);
        xx[p] = state.xx;
        yy[p] = state.yy;
        xy[p] = state.xy;
        return stress;
      } else {
        return now.stress(strain);
      }
    }
    /// Cracks are open where the mean strain is not negative; its sign is that of ε_xx + ε_yy.
    [[gnu::always_inline]] material::Stiffness stiffness(const material::Tensor& strain,
                                                         [[maybe_unused]] std::size_t i) const {
      if constexpr (damaging) {
        const double normal = open.normal[i], cross = open.cross[i], shear = open.shear[i];
        const double normal_closed = closed.normal[i], cross_closed = closed.cross[i], shear_closed = closed.shear[i];
        const bool tension = strain.xx + strain.yy >= 0;
        return {tension ? normal : normal_closed, tension ? cross : cross_closed, tension ? shear : shear_closed};
      } else {
        return {whole.normal, whole.cross, whole.shear};
      }
    }
  };

  Row row(std::size_t first_cell, std::size_t first_particle) {
    Row r;
    r.whole = whole_;
    if constexpr (damaging) {
      r.open = StiffnessRow(open_, first_cell);
      r.closed = StiffnessRow(closed_, first_cell);
    }
    if constexpr (failing) {
      r.failure = failure_;
      r.dilatancy = dilatancy_.data() + first_cell;
    }
    if constexpr (plastic) {
      r.compression = &compression_;
      r.xx = plastic_strain_.xx.data() + first_particle;
      r.yy = plastic_strain_.yy.data() + first_particle;
      r.xy = plastic_strain_.xy.data() + first_particle;
    }
    return r;
  }

  material::Stiffness stiffness(const material::Tensor& strain, [[maybe_unused]] std::size_t cell) const {
    if constexpr (damaging) {
      return strain.xx + strain.yy >= 0 ? open_[cell] : closed_[cell];
    } else {
      return whole_;
    }
  }
  /// Stress that stands, for the books and for samples.
  material::Tensor stress(const material::Tensor& strain, std::size_t cell, [[maybe_unused]] std::size_t p) const {
    if constexpr (failing) return failure_.stress(strain, dilatancy_[cell]);
    const material::Stiffness now = stiffness(strain, cell);
    if constexpr (plastic) {
      material::PlasticStrain copy = plastic_strain_[p];
      double dissipated = 0;
      return compression_.stress(now, strain, copy, dissipated);
    }
    return now.stress(strain);
  }
  /// Recoverable energy [J/m³].
  double stored(const material::Tensor& strain, std::size_t cell, [[maybe_unused]] std::size_t p) const {
    if constexpr (failing) return failure_.stored(strain, dilatancy_[cell]);
    const material::Stiffness now = stiffness(strain, cell);
    if constexpr (plastic) return material::Compression::stored(now, strain, plastic_strain_[p]);
    return now.stress(strain).contract(strain) / 2;
  }

  /// Whether the stress of a given crack density or dilatancy is the derivative of an energy.
  bool has_potential() const {
    if constexpr (failing) return false;
    if constexpr (damaging) return material_.has_potential();
    return true;
  }

  /// Keeps the plastic strains, or not, for work_of_flow after the next update.
  void note_flow(bool keep) {
    if (keep) plastic_before_ = plastic_strain_;
  }
  /// σ:Δε_p since then [J/m³], ≥ 0.
  double work_of_flow(const material::Tensor& strain, std::size_t cell, std::size_t p) const {
    const material::PlasticStrain more = plastic_strain_[p] - plastic_before_[p];
    if (more.xx == 0 && more.yy == 0 && more.xy == 0) return 0;
    const material::Tensor s = stress(strain, cell, p);
    const material::Stiffness now = stiffness(strain, cell);
    const double pressure = -(now.cross + 2 * now.shear / 3) * (strain.xx + strain.yy);  // flow leaves it alone
    const double zz = -(s.xx + s.yy + 2 * pressure);                                     // of the deviator
    return s.contract(more) - zz * (more.xx + more.yy) + pressure * (more.xx + more.yy);
  }

  /// New crack densities of the cells. A cell whose own did not change keeps its stiffness.
  void crack(std::span<const double> density) {
    for (std::size_t cell = 0; cell < density.size(); ++cell) {
      if (density[cell] == crack_density_[cell]) continue;
      crack_density_[cell] = density[cell];
      const auto [open, closed] = material_.damaged_stiffness(density[cell]);
      open_.set(cell, open);
      closed_.set(cell, closed);
    }
  }

  /// V_d of the cells, from now on and as it changes.
  void dilate(std::span<const double> dilatancy) { dilatancy_ = dilatancy; }

  /// What a cell shows of its mean strain to the spread of its dilatancy; NaN of NaN.
  double ceiling(const material::Tensor& mean) const { return failure_.open_ceiling(mean); }

  std::size_t bytes() const {
    return plastic_strain_.bytes() + plastic_before_.bytes() + crack_density_.capacity() * sizeof(double) +
           open_.bytes() + closed_.bytes();
  }

 private:
  material::Stiffness whole_;
  material::TensileDamage material_;
  material::FailureWave failure_;
  std::span<const double> dilatancy_;
  material::Compression compression_;
  std::vector<double> crack_density_;  // of each cell
  StiffnessField open_, closed_;
  TensorField plastic_strain_, plastic_before_;  // the latter with books alone
};

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
