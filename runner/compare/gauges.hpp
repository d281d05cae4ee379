// What gauges in a struck plate tell: when fronts arrive, what stress they leave behind, and what theory says of each.
#pragma once

#include <string>
#include <vector>

#include "hinge/diffusion/concentration.hpp"
#include "hinge/scene/plate.hpp"
#include "reports/results.hpp"
#include "runner/compare/uncertainty.hpp"
#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"

namespace diptych::runner {

/// When a history first reaches a level from below, on the line between its samples; NaN where it does not.
double first_passage(const History&, double level);
/// Mean over [from, to] of the line through the samples; NaN where they do not cover it.
double mean_over(const History&, double from, double to);

/// Numbers of an impact that theory knows, for a place so far from the impact face in the target.
struct ImpactTheory {
  double plateau = 0;         ///< ½ρ c_d v, compression positive [Pa]
  double lateral_ratio = 0;   ///< ν/(1 − ν)
  double arrival = 0;         ///< of the elastic front [s]
  double release = 0;         ///< when the plateau ends: a wave comes back from a free side [s]
  double failed_lateral = 0;  ///< −σ_yy at the plateau's strain and f = f_max [Pa]; NaN without a failure wave
  double failure = 0;         ///< when −σ_yy is half-way to it, by diffusion into a half space; NaN likewise [s]
};
ImpactTheory impact_theory(const PlateSpec&, double from_face);

/// The histories, and of each gauge
/// - "arrival" [s]: −σ_xx passes half of the plateau; "rise" [s]: from 10 % to 90 % of it;
/// - "overshoot": largest −σ_xx before the release, over the plateau, less 1;
/// - "plateau" [Pa], "ratio": mean −σ_xx, and mean σ_yy over it, over the middle half of the time from front to
/// release;
/// - "longitudinal", "lateral": means over a tenth of that time that ends a fifth of it before the release, over the
///   elastic plateau's;
/// - "release" [s]: −σ_xx falls below half of the plateau again;
/// - "failure" [s]: −σ_yy is half-way from the elastic plateau's to that at f_max.
/// Each with ".exact" where the solid's own theory knows it, ".predicted" where the lattice's does (elastic, inviscid);
/// "prediction": largest difference from the lattice's history, over the plateau. Of the first and last gauge
/// "failure.speed" [m/s] between them, "failure.delay" [s]: when a front of that speed has left the face, and
/// "failure.slowing": the ratio of their failures. "dilatancy.ahead": largest V_d at sample times in front of the
/// elastic front and three nodes, over the largest; "impact.left-over": see PlateRecord, in cells.
void measure_gauges(const Case&, const Leaf&, const diffusion::Grid&, const PlateRecord&, double time_step,
                    reports::Run&);

}  // namespace diptych::runner
