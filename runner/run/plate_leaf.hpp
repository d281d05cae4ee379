// A run of a plate.
#pragma once

#include "analytic/plane_exact.hpp"
#include "runner/run/leaf_scene.hpp"

namespace diptych::runner {

class PlateLeaf final : public LeafScene<Plate, PlateMesh, PlateRecord> {
 public:
  PlateLeaf(const Case&, const Leaf&);

  double unit_time_step() const override;  ///< h/c_d, h the smaller side of a cell
  double asked_time_step() const override;
  std::vector<double> instants() const override { return c.times; }
  Read reads(bool keep_fields) const override;
  std::optional<double> mass() const override;
  void trace(const PlateRecord&, const std::vector<long>&, const Stepping&, reports::Run&) const override;
  reports::Sample sample(const PlateSnapshot& own, const PlateSnapshot& at, double asked, bool keep_fields,
                         const reports::Run&) const override;
  void measure(const PlateRecord&, const Stepping&, reports::Run&) const override;
  std::vector<std::string> declared() const override;
  double differing(const PlateRecord&, const PlateRecord&, const PowersOfTwo&, bool mirror) const override;
  Plate scaled_scene(const PowersOfTwo&) const override;
  std::pair<Plate, PlateMesh> seen_from_behind() const override;
  std::vector<std::pair<std::string, Plate>> without_what_does_nothing() const override;
  std::optional<double> predicted_limit() const override;

 private:
  void measure_against_forward_euler(const PlateRecord&, const Stepping&, reports::Run&) const;

  WhenAsked<analytic::PlaneSolution> exact_;
};

/// Size of a cell and unknowns.
void describe_plate(const Case&, const Leaf&, reports::Run&);

/// Errors, fields and probes of a plate's sample, with mechanics or without.
reports::Sample measure_plane_sample(const Case&, const Leaf&, const diffusion::Grid&, const PlateSnapshot& own,
                                     const PlateSnapshot& at, double asked, bool keep_fields,
                                     const analytic::PlaneSolution*, const reports::Run&);
/// What is measured on a plate's whole record, with mechanics or without.
void measure_plane_record(const Case&, const diffusion::Grid&, const PlateRecord&, reports::Run&);

}  // namespace diptych::runner
