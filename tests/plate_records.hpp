// What tests of plates make and read of runs.
#pragma once

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "hinge/scene/scene.hpp"
#include "tests/steps.hpp"

namespace diptych {

using tests::steps_of;

/// A run that was cut off has no samples.
template <class AnyRecord>
const auto& first(const AnyRecord& r) {
  BOOST_TEST_CONTEXT(r.message) { BOOST_REQUIRE(!r.snapshots.empty()); }
  return r.snapshots[0];
}

inline double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::isnan(v) ? v : std::max(most, std::abs(v));
  return most;
}

}  // namespace diptych
