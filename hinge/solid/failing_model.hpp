// What runs do with the solid of failing.hpp.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hinge/material/failure_wave_law.hpp"
#include "hinge/solid/failing.hpp"
#include "hinge/solid/plane_model.hpp"
#include "hinge/wide.hpp"

namespace diptych::solid {

class Failing::Model {
 public:
  static constexpr bool linear = false, staggered = true, stands_at_start = false, only_takes = false, yields = false;
  static constexpr bool takes_viscosity = true;
  static constexpr double gives_back = material::FailureWave::gives_back;

  Model(const Failing& solid, const diffusion::Grid& grid, std::size_t)
      : law_(solid.law), dilatancy_(solid.spread, grid) {}

  struct Row {
    material::FailureWave law;
    const double* dilatancy;

    [[gnu::always_inline]] material::Tensor stress(const material::Tensor& strain, std::size_t i, std::size_t) const {
      return law.stress(strain, dilatancy[i]);
    }
    [[gnu::always_inline]] material::Tensor stress(const material::Tensor& strain, std::size_t i, std::size_t p,
                                                   double&) const {
      return stress(strain, i, p);
    }
    [[gnu::always_inline]] double stored(const material::Tensor& strain, std::size_t i) const {
      return law.stored(strain, dilatancy[i]);
    }
    [[gnu::always_inline]] bool whole(std::size_t i) const { return dilatancy[i] == 0; }
  };
  [[gnu::always_inline]] Row row(std::size_t first_cell, std::size_t) const {
    return {law_, dilatancy_.of_cells().data() + first_cell};
  }

  [[gnu::always_inline]] material::Tensor standing(const material::Tensor& strain, std::size_t cell,
                                                   std::size_t) const {
    return law_.stress(strain, dilatancy_.of_cells()[cell]);
  }
  [[gnu::always_inline]] double stored(const material::Tensor& strain, std::size_t cell, std::size_t p) const {
    return row(cell, p).stored(strain, 0);
  }
  bool whole(std::size_t cell, std::size_t p) const { return row(cell, p).whole(0); }
  bool has_potential() const { return false; }

  auto driver() const {
    return [law = law_](const material::Tensor& mean) DIPTYCH_INLINE { return law.open_ceiling(mean); };
  }
  void advance(std::span<const double> ceiling, double dt) { dilatancy_.advance(ceiling, dt); }
  bool outdated(std::size_t) const { return false; }  // cells read their dilatancy where it changes
  void renew(std::size_t, std::size_t) {}

  Fields fields() const { return {{}, dilatancy_.of_cells(), dilatancy_.of_nodes()}; }
  double volumetric(const material::Tensor& mean) const { return law_.elastic.volumetric(mean); }
  double fed() const { return dilatancy_.fed(); }
  long node_updates() const { return dilatancy_.node_updates(); }
  void name_features(std::vector<std::string>& active) const {
    active.emplace_back(feature);
    active.emplace_back("diffusion");
  }
  std::size_t bytes() const { return dilatancy_.bytes(); }

 private:
  material::FailureWave law_;
  diffusion::Dilatancy dilatancy_;
};

}  // namespace diptych::solid
