#include "runner/run/doubt.hpp"

#include <fmt/core.h>

#include <memory>

#include "runner/input/build.hpp"
#include "runner/input/plate_build.hpp"

namespace diptych::runner {
namespace {

/// Bars meet at a time of the run's own.
bool differs_by_run(const Case& c) {
  const analytic::BarSolution* row = solution_of(c);
  return row && row->of_impact;
}

}  // namespace

std::string doubt(double residual) {
  constexpr double allowed = 1e-4;  // room for the round-off of steep ramps; a wrong solution stands at 1
  if (residual <= allowed) return {};
  return fmt::format("the exact solution fails its own test: residual {:.3g}, allowed {:g}", residual, allowed);
}

std::string doubt_exact(const Case& c) {
  if (c.plate) {
    const auto exact = make_plane_exact(c);
    const PlateSpec& plate = *c.plate;
    if (!exact) return {};
    return doubt(exact->residual({plate.width, plate.height, plate.exact.core(), c.times.front(), c.times.back()}));
  }
  if (differs_by_run(c)) return {};
  const auto exact = make_exact(c, {});
  return exact ? doubt(exact->residual(instant(c, 1, c.times.back()))) : "";
}

std::string doubt_own(const Case& c, const analytic::ExactSolution* exact, double end) {
  return exact && differs_by_run(c) ? doubt(exact->residual(end)) : "";
}

}  // namespace diptych::runner
