// Plasticity in compression beside a law that gives each cell a stiffness.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "hinge/diffusion/concentration.hpp"
#include "hinge/material/compression.hpp"
#include "hinge/material/plane.hpp"
#include "hinge/solid/arrays.hpp"
#include "hinge/solid/plane_model.hpp"

namespace diptych::solid {

/// The model Base with the cone: the stiffness is Base's, and points have plastic strains.
template <class Base>
class WithCone : public Base {
 public:
  static constexpr bool linear = false, yields = true, takes_viscosity = false;

  template <class Solid>
  WithCone(const Solid& solid, const diffusion::Grid& grid, std::size_t points)
      : Base(solid, grid, points), compression_(*solid.compression) {
    plastic_strain_.resize(points);
  }

  struct Row : Base::Row {
    const material::Compression* compression;
    double *xx, *yy, *xy;  ///< plastic strain

    [[gnu::always_inline]] material::Tensor stress(const material::Tensor& strain, std::size_t i, std::size_t p) const {
      double dissipated = 0;
      return stress(strain, i, p, dissipated);
    }
    [[gnu::always_inline]] material::Tensor stress(const material::Tensor& strain, std::size_t i, std::size_t p,
                                                   double& dissipated) const {
      material::PlasticStrain state{xx[p], yy[p], xy[p]};
      const material::Tensor stress = compression->stress(Base::Row::stiffness(strain, i), strain, state, dissipated);
      xx[p] = state.xx;
      yy[p] = state.yy;
      xy[p] = state.xy;
      return stress;
    }
  };
  Row row(std::size_t first_cell, std::size_t first_point) {
    return {Base::row(first_cell, first_point), &compression_, plastic_strain_.xx.data() + first_point,
            plastic_strain_.yy.data() + first_point, plastic_strain_.xy.data() + first_point};
  }

  material::Tensor standing(const material::Tensor& strain, std::size_t cell, std::size_t p) const {
    material::PlasticStrain copy = plastic_strain_[p];
    double dissipated = 0;
    return compression_.stress(Base::stiffness(strain, cell), strain, copy, dissipated);
  }
  double stored(const material::Tensor& strain, std::size_t cell, std::size_t p) const {
    return material::Compression::stored(Base::stiffness(strain, cell), strain, plastic_strain_[p]);
  }
  bool whole(std::size_t cell, std::size_t p) const {
    const material::PlasticStrain flown = plastic_strain_[p];
    return Base::whole(cell, p) && flown.xx == 0 && flown.yy == 0 && flown.xy == 0;
  }

  /// Keeps the plastic strains for work_of_flow after the next update.
  void note_flow() { plastic_before_ = plastic_strain_; }
  /// σ:Δε_p since then [J/m³], ≥ 0.
  double work_of_flow(const material::Tensor& strain, std::size_t cell, std::size_t p) const {
    const material::PlasticStrain more = plastic_strain_[p] - plastic_before_[p];
    if (more.xx == 0 && more.yy == 0 && more.xy == 0) return 0;
    const material::Tensor s = standing(strain, cell, p);
    const material::Stiffness now = Base::stiffness(strain, cell);
    const double pressure = -(now.cross + 2 * now.shear / 3) * (strain.xx + strain.yy);  // flow leaves it alone
    const double zz = -(s.xx + s.yy + 2 * pressure);                                     // of the deviator
    return s.contract(more) - zz * (more.xx + more.yy) + pressure * (more.xx + more.yy);
  }

  void name_features(std::vector<std::string>& active) const {
    Base::name_features(active);
    active.push_back("compression-plasticity");
  }
  std::size_t bytes() const { return Base::bytes() + plastic_strain_.bytes() + plastic_before_.bytes(); }

 private:
  material::Compression compression_;
  TensorField plastic_strain_, plastic_before_;  // the latter with books alone
};

/// Calls f<Model>() with the model of a solid: its own, or that with the cone.
template <class Solid, class F>
decltype(auto) with_model(const Solid& solid, F&& f) {
  static_assert(PlaneModel<typename Solid::Model>);
  if constexpr (requires { solid.compression; }) {
    static_assert(PlaneModel<WithCone<typename Solid::Model>>);
    if (solid.compression) return std::forward<F>(f).template operator()<WithCone<typename Solid::Model>>();
  }
  return std::forward<F>(f).template operator()<typename Solid::Model>();
}

}  // namespace diptych::solid
