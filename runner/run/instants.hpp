// Sample times: the steps of a run that meet them, and fields at an instant between two steps.
#pragma once

#include <vector>

#include "hinge/scene/plate.hpp"
#include "hinge/scene/scene.hpp"
#include "hinge/step/record.hpp"
#include "runner/input/case.hpp"

namespace diptych::runner {

/// A run's number of steps is rounded up, never to nearest: at the limit one step fewer is unstable. The slack lets a
/// Courant number that fits the time exactly but for round-off take the steps it asks for.
constexpr double round_off = 1e-12;

/// The time step that a leaf asks for and the largest stable one. Courant number 1 is Δt = h/c of the fastest bar; of a
/// plate h/c_d, h the smaller side of a cell; of diffusion alone h²/d with the largest diffusivity.
struct TimeStep {
  double asked, limit;  ///< [s]; limit: infinite where any step is stable, NaN where none is known
  double unit;          ///< Δt of Courant number 1 [s]
};

/// The steps of a run, sampled wherever a field's own time is next to an instant that is asked for.
struct Plan {
  Stepping stepping;
  std::vector<long> nearest;  ///< for each instant the step that ends nearest to it

  std::vector<long> own_steps() const;  ///< these, each once
};

/// Whether a step may be a little shorter than it was asked for, to meet more instants than the last one.
enum class Meet { all, last };

/// The order of a scheme shows where Δt/h is the same on all meshes: a case that measures it keeps its step.
Meet what_to_meet(const Case&);

/// Which of a run's fields are read at the instants: those that stand at whole steps, as damage does, or all, some of
/// which stand half a step beside them.
enum class Read { whole, all };

/// Steps of equal length, none longer than the one asked for, that meet the last of the instants [s], ascending and
/// > 0. Meet::all: all of them, where 16 steps more or 1 in 25 are enough for that. A step that fits the end as it is
/// asked for stays as it is: at Courant number 1 FEM is exact.
Plan plan_steps(const std::vector<double>& instants, const TimeStep&, Meet, Read, Books);

/// The snapshots of these steps.
template <class Snapshot>
std::vector<Snapshot> taken_after(const std::vector<long>& steps, const std::vector<Snapshot>& snapshots) {
  std::vector<Snapshot> those;
  for (const long step : steps)
    for (const Snapshot& s : snapshots)
      if (s.step == step) those.push_back(s);
  return those;
}

/// Every field at the instant [s], linear between the two of its own times around it (next to it, where it has none
/// before); displacements between whole steps with the acceleration there. A field that stands at the instant is taken
/// as it is, to the bit. step: the nearest one, of the length time_step [s].
Snapshot at_instant(const std::vector<Snapshot>&, long step, double time_step, double instant);
PlateSnapshot at_instant(const std::vector<PlateSnapshot>&, long step, double time_step, double instant);

/// Likewise of values at ascending times; NaN where there are none.
double at_instant(const std::vector<double>& time, const std::vector<double>& value, double instant);

}  // namespace diptych::runner
