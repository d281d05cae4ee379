// What runs do with the solid of elastic.hpp.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hinge/solid/elastic.hpp"
#include "hinge/solid/plane_model.hpp"

namespace diptych::solid {

class Elastic::Model : public Unchanging {
 public:
  static constexpr bool linear = true;

  Model(const Elastic& solid, const diffusion::Grid&, std::size_t)
      : Unchanging(solid.law), stiffness_(solid.law.stiffness()) {}

  struct Row {
    material::Stiffness all;

    [[gnu::always_inline]] material::Stiffness stiffness(const material::Tensor&, std::size_t) const {
      return {all.normal, all.cross, all.shear};
    }
    [[gnu::always_inline]] material::Tensor stress(const material::Tensor& strain, std::size_t i, std::size_t) const {
      return stiffness(strain, i).stress(strain);
    }
    [[gnu::always_inline]] material::Tensor stress(const material::Tensor& strain, std::size_t i, std::size_t p,
                                                   double&) const {
      return stress(strain, i, p);
    }
  };
  Row row(std::size_t, std::size_t) { return {stiffness_}; }

  const material::Stiffness& stiffness(const material::Tensor&, std::size_t) const { return stiffness_; }
  [[gnu::always_inline]] material::Tensor standing(const material::Tensor& strain, std::size_t, std::size_t) const {
    return stiffness_.stress(strain);
  }
  [[gnu::always_inline]] double stored(const material::Tensor& strain, std::size_t, std::size_t) const {
    return stiffness_.stress(strain).contract(strain) / 2;
  }
  bool whole(std::size_t, std::size_t) const { return true; }
  void name_features(std::vector<std::string>& active) const { active.emplace_back(feature); }

 private:
  material::Stiffness stiffness_;
};

}  // namespace diptych::solid
