// What tests of plates make and read of runs.
#pragma once

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "hinge/scene/plate.hpp"
#include "hinge/scene/scene.hpp"
#include "tests/steps.hpp"

namespace diptych {

using tests::steps_of;

/// Plasticity in compression of an elastic or a cracking plate.
inline std::optional<material::Compression>& compression(Plate& plate) {
  if (auto* cracking = std::get_if<solid::Cracking>(&plate.solid)) return cracking->compression;
  return std::get<solid::Elastic>(plate.solid).compression;
}

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
