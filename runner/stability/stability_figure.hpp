// Stability limits as a figure: over the values of an axis, theory under the points.
#pragma once

#include <optional>

#include "reports/results.hpp"
#include "reports/stability_results.hpp"

namespace diptych::runner {

/// A panel a scene. Nothing where the settings have no axis in common with two values or more that have limits. Powers
/// of ten where values span more than 30.
std::optional<reports::Figure> stability_figure(const reports::StabilityMap&);

}  // namespace diptych::runner
