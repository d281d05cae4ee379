// A run of diffusion without mechanics.
#pragma once

#include "analytic/plane_exact.hpp"
#include "runner/run/leaf_scene.hpp"

namespace diptych::runner {

class DiffusionLeaf final : public LeafScene<DiffusionScene, diffusion::Grid, PlateRecord> {
 public:
  /// Throws InputError where the diffusivity is not ≥ 0 in the middle of some cell.
  DiffusionLeaf(const Case&, const Leaf&);

  double unit_time_step() const override;  ///< h²/d, h the smaller side of a cell and d the largest diffusivity
  std::vector<double> instants() const override { return c.times; }
  Read reads(bool keep_fields) const override { return keep_fields ? Read::all : Read::whole; }
  std::optional<double> mass() const override { return {}; }
  reports::Sample sample(const PlateSnapshot& own, const PlateSnapshot& at, double asked, bool keep_fields,
                         const reports::Run&) const override;
  void measure(const PlateRecord&, const Stepping&, reports::Run&) const override;
  double differing(const PlateRecord&, const PlateRecord&, const PowersOfTwo&, bool mirror) const override;

 private:
  WhenAsked<analytic::PlaneSolution> exact_;
  double largest_diffusivity_;
};

/// Size of a cell and unknowns.
void describe_diffusion(const Case&, const Leaf&, reports::Run&);

}  // namespace diptych::runner
