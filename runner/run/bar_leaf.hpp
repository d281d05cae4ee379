// A run of bars.
#pragma once

#include "runner/run/leaf_scene.hpp"

namespace diptych::runner {

class BarLeaf final : public LeafScene<Scene, BarMesh, Record> {
 public:
  BarLeaf(const Case&, const Leaf&);

  double unit_time_step() const override;  ///< of the fastest bar
  std::vector<double> instants() const override;
  Read reads(bool) const override { return Read::all; }
  std::vector<long> more_samples(const Stepping&) const override;
  std::optional<double> mass() const override;
  void trace(const Record&, const std::vector<long>&, const Stepping&, reports::Run&) const override;
  reports::Sample sample(const Snapshot& own, const Snapshot& at, double asked, bool keep_fields,
                         const reports::Run&) const override;
  void measure(const Record&, const Stepping&, reports::Run&) const override;
  std::string doubt() const override;
  double differing(const Record&, const Record&, const PowersOfTwo&, bool mirror) const override;
  Scene scaled_scene(const PowersOfTwo&) const override;
  std::pair<Scene, BarMesh> seen_from_behind() const override;
  std::vector<std::pair<std::string, Scene>> without_what_does_nothing() const override;
  std::optional<double> predicted_limit() const override;

 private:
  void measure_early_contact(const Record&, reports::Run&) const;
  void measure_alone(const Record&, const Stepping&, reports::Run&) const;
  void measure_against_fem(const Record&, const Stepping&, reports::Run&) const;

  WhenAsked<analytic::ExactSolution> exact_;
};

/// Size of a cell and unknowns.
void describe_bars(const Case&, const Leaf&, reports::Run&);

}  // namespace diptych::runner
