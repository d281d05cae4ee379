// True norms of a field's error against the exact field.
#pragma once

#include <vector>

#include "analytic/exact.hpp"
#include "hinge/step/record.hpp"
#include "runner/input/span.hpp"

namespace diptych::runner {

/// Mean norms over all bars of the error divided by the exact solution's scale: (1/L ∫ |e|^p dx)^(1/p) and the largest
/// |e| met; so L1 ≤ L2 ≤ L∞.
struct Norms {
  double l1 = 0, l2 = 0, linf = 0;
};

/// The field is taken as it is (constant over its intervals, or linear between its points) and never projected. Each
/// interval between edges, points and exact fronts is integrated by itself with four Gauss points, so a front inside a
/// cell counts with its exact position; L∞ is over the Gauss points. NaN anywhere makes all three NaN.
Norms error_norms(const Field&, const analytic::ExactSolution&, analytic::BarQuantity, const std::vector<Span>& bars);

/// The value at x of a field of one bar.
double value_at(const Field&, double x);

/// Mean of a solution that is constant between its fronts.
double mean_between_fronts(const analytic::ExactSolution&, analytic::BarQuantity, const Span& bar, double t);

}  // namespace diptych::runner
