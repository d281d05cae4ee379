// What runs do with the solid of cracking.hpp.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hinge/solid/arrays.hpp"
#include "hinge/solid/cracking.hpp"
#include "hinge/solid/plane_model.hpp"
#include "hinge/wide.hpp"

namespace diptych::solid {

class Cracking::Model {
 public:
  static constexpr bool linear = false, staggered = true, stands_at_start = true, only_takes = true, yields = false;
  static constexpr bool takes_viscosity = false;
  static constexpr double gives_back = 0;

  Model(const Cracking& solid, const diffusion::Grid& grid, std::size_t)
      : law_(solid.law), evolution_(solid.evolution, solid.law.crack_growth(), grid) {
    crack_density_.assign(grid.cells(), 0);
    for (StiffnessField* field : {&open_, &closed_}) field->assign(grid.cells(), law_.elastic.stiffness());
  }

  /// Cracks are open where the mean strain is not negative; its sign is that of ε_xx + ε_yy.
  struct Row {
    StiffnessRow open, closed;
    const double* crack_density;

    [[gnu::always_inline]] material::Stiffness stiffness(const material::Tensor& strain, std::size_t i) const {
      const double normal = open.normal[i], cross = open.cross[i], shear = open.shear[i];
      const double normal_closed = closed.normal[i], cross_closed = closed.cross[i], shear_closed = closed.shear[i];
      const bool tension = strain.xx + strain.yy >= 0;
      return {tension ? normal : normal_closed, tension ? cross : cross_closed, tension ? shear : shear_closed};
    }
    [[gnu::always_inline]] material::Tensor stress(const material::Tensor& strain, std::size_t i, std::size_t) const {
      return stiffness(strain, i).stress(strain);
    }
    [[gnu::always_inline]] material::Tensor stress(const material::Tensor& strain, std::size_t i, std::size_t p,
                                                   double&) const {
      return stress(strain, i, p);
    }
    [[gnu::always_inline]] double stored(const material::Tensor& strain, std::size_t i) const {
      return stiffness(strain, i).stress(strain).contract(strain) / 2;
    }
    [[gnu::always_inline]] bool whole(std::size_t i) const { return crack_density[i] == 0; }
  };
  [[gnu::always_inline]] Row row(std::size_t first_cell, std::size_t) const {
    return {StiffnessRow(open_, first_cell), StiffnessRow(closed_, first_cell), crack_density_.data() + first_cell};
  }

  material::Stiffness stiffness(const material::Tensor& strain, std::size_t cell) const {
    return strain.xx + strain.yy >= 0 ? open_[cell] : closed_[cell];
  }
  [[gnu::always_inline]] material::Tensor standing(const material::Tensor& strain, std::size_t cell,
                                                   std::size_t p) const {
    return row(cell, p).stress(strain, 0, p);
  }
  [[gnu::always_inline]] double stored(const material::Tensor& strain, std::size_t cell, std::size_t p) const {
    return row(cell, p).stored(strain, 0);
  }
  bool whole(std::size_t cell, std::size_t p) const { return row(cell, p).whole(0); }
  bool has_potential() const { return law_.has_potential(); }

  auto driver() const {
    return [law = law_](const material::Tensor& mean) DIPTYCH_INLINE { return law.volumetric(mean); };
  }
  void advance(std::span<const double> volumetric_strain, double dt) { evolution_.advance(volumetric_strain, dt); }
  bool outdated(std::size_t cell) const { return evolution_.crack_density()[cell] != crack_density_[cell]; }
  void renew(std::size_t first, std::size_t cells);

  Fields fields() const { return {evolution_.crack_density(), {}, evolution_.concentration()}; }
  double volumetric(const material::Tensor& mean) const { return law_.volumetric(mean); }
  double fed() const { return evolution_.fed(); }
  long node_updates() const { return evolution_.node_updates(); }
  void name_features(std::vector<std::string>& active) const {
    active.emplace_back(feature);
    if (!evolution_.concentration().empty()) active.emplace_back("diffusion");
  }
  std::size_t bytes() const {
    return crack_density_.capacity() * sizeof(double) + open_.bytes() + closed_.bytes() + evolution_.bytes();
  }

 private:
  material::TensileDamage law_;
  diffusion::DamageEvolution evolution_;
  std::vector<double> crack_density_;  // that the cell's stiffness has
  StiffnessField open_, closed_;
};

}  // namespace diptych::solid
