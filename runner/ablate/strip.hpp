// Whether a plate's fields vary along a side, and the strip of one cell that would do where they do not.
#pragma once

#include <optional>

#include "runner/ablate/features.hpp"
#include "runner/ablate/readings.hpp"

namespace diptych::runner {

/// How much fields vary along one of the axes, and how much moves along it: the largest of all fields and sample times.
struct Variation {
  double part = 0;    ///< of the field's largest value; infinite where nothing is the same along it
  std::string field;  ///< that varies so
  double time = 0;    ///< the sample time [the case's unit of time]
};
Variation variation_along(Axis, const reports::Run&);

/// The plate on one cell along the axis, whose sides there are rollers where they are free. Nothing where the mesh has
/// but one.
std::optional<Revision> strip_across(Axis, const Case&, const Leaf&);

}  // namespace diptych::runner
