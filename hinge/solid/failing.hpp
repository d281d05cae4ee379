// A solid that a failure wave runs through: the law of its dilatancy, and how this spreads.
#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "hinge/diffusion/dilatancy.hpp"
#include "hinge/material/failure_wave.hpp"
#include "hinge/solid/plane_model.hpp"

namespace diptych::solid {

/// Plane strain, and no plasticity in compression beside it. The spread is taken as it is: where there is an impact,
/// its face is for the caller to name.
struct Failing {
  static constexpr const char* feature = "failure-wave";
  static constexpr const char* name = "a failure wave";

  material::FailureWave law;
  diffusion::Spread spread = {};

  const material::PlaneElastic& elastic() const { return law.elastic; }  ///< the whole solid
  double stiffening() const { return law.stiffening(); }
  static bool diffuses() { return true; }
  void check() const {
    const auto refuse = [](bool wrong, const char* why) {
      if (wrong) throw std::invalid_argument(why);
    };
    refuse(law.elastic.plane == material::Plane::stress, "a failure wave is for plane strain only");
    refuse(!(law.threshold >= 0), "the threshold of a failure wave must be >= 0");
    refuse(!(law.most_converted >= 0 && law.most_converted <= 1),
           "the part of the shear energy that a failure wave converts lies between 0 and 1");
  }

  class Model {
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
    };
    Row row(std::size_t first_cell, std::size_t) { return {law_, dilatancy_.of_cells().data() + first_cell}; }

    material::Tensor standing(const material::Tensor& strain, std::size_t cell, std::size_t) const {
      return law_.stress(strain, dilatancy_.of_cells()[cell]);
    }
    double stored(const material::Tensor& strain, std::size_t cell, std::size_t) const {
      return law_.stored(strain, dilatancy_.of_cells()[cell]);
    }
    bool whole(std::size_t cell, std::size_t) const { return dilatancy_.of_cells()[cell] == 0; }
    bool has_potential() const { return false; }

    double driver(const material::Tensor& mean) const { return law_.open_ceiling(mean); }
    void advance(std::span<const double> ceiling, double dt) { dilatancy_.advance(ceiling, dt); }
    bool outdated(std::size_t) const { return false; }  // cells read their dilatancy where it changes
    void renew(std::size_t) {}

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
};

}  // namespace diptych::solid
