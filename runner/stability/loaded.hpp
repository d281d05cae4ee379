// Whether a scene under its own loads is stable: how a run ends, and whether small differences grow in it.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"

namespace diptych::runner {

/// A number of a run that is to stay small, "probe.largest" at most 0.45.
struct Ceiling {
  std::string quantity;
  double most = 0;  ///< in the quantity's own unit, at each of its sample times
};

/// How a run under its loads went.
struct LoadedRun {
  bool stable = false;
  std::optional<double> rate;  ///< of amplitudes of small differences, per step; none: they have faded to nothing
  std::string why;             ///< it is not stable; empty: it is
};

/// Runs the scene as it stands and once more with a part `seed` of the wave speed, random, on all initial velocities.
/// Unstable: either run holds more energy than was put in, or ends with no numbers; or, unless particles cross
/// cells, what the two differ by, as fitted over the second half of the look-ahead, grows as growth_of says. Invalid:
/// the points of a bar that moves have changed places, or particles have left the grid. Then, with a ceiling, the
/// case's own run: it must end, and keep below. steps: of the look-ahead; none: up to the case's last sample time. The
/// case is the one that the leaf has: see case_of. Throws std::invalid_argument where the panel refuses the step.
LoadedRun run_loaded(const Case&, const Leaf&, std::optional<long> steps, const std::optional<Ceiling>&,
                     const std::atomic<bool>* cancelled = nullptr);

}  // namespace diptych::runner
