// One run of a case, measured: the same for bars, plates and diffusion alone.
#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "hinge/scene/scene.hpp"
#include "reports/results.hpp"
#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"
#include "runner/run/instants.hpp"

namespace diptych::runner {

struct Keeping;

/// The number-th of `of` parts into which runs are divided, by what they see: which part a run is in does not change
/// when cases are added.
struct Shard {
  int number = 1, of = 1;
  bool has(const std::string& words) const;
};

/// What runs will take, about.
struct Ahead {
  std::size_t runs = 0;
  double steps = 0;       ///< of all of them
  double most_steps = 0;  ///< of one of them
  double seconds = 0;     ///< on the threads that they have
};

/// How to run, as against what.
struct Running {
  int threads = 1;                               ///< for all runs together
  const std::atomic<bool>* cancelled = nullptr;  ///< turns true where runs should stop soon
  Books books = Books::off;                      ///< kept at least; their sums also where a gate asks for them
  bool keep_fields = false;                      ///< keep all fields at the sample times in the results
  bool judged_only = false;                      ///< leave out runs that no gate of their case speaks of
  bool cheapest_first = false;                   ///< instead of the longest, with which the threads end together
  /// Asked before each run of the which-th case: one that is no longer wanted is left out with status "left out".
  std::function<bool(std::size_t which, const Leaf&)> wanted = {};
  /// Told of each run, from one thread at a time.
  std::function<void(std::size_t which, const reports::Run&)> finished = {};
  std::function<void(std::size_t done, std::size_t total)> progress = {};  ///< after each run, likewise
  /// Told what all runs together will take, before the first of them; what it throws leaves run_cases.
  std::function<void(const Ahead&)> ahead = {};
  int threads_a_run = 1;                     ///< of plates; the same bits for any number
  std::optional<double> limit_seconds = {};  ///< run_cases stops a run that takes longer: status "timed out"
  std::optional<Shard> shard = {};           ///< run_cases makes its part alone; the others have status "left out"
  Keeping* keeping = nullptr;                ///< where run_cases looks for runs that were made before; null: nowhere
};

// The case of the next four is the one that the leaf has: see case_of.

/// What a run will be, before it is run.
reports::Run describe(const Case&, const Leaf&);

/// What a run will take.
struct Outlook {
  TimeStep step;
  double duration = 0;                                               ///< [s]
  double steps() const { return duration / step.asked; }             ///< about so many
  double updates(int unknowns) const { return unknowns * steps(); }  ///< of unknowns
  /// On one thread of a usual machine, to a factor of ten: the slower runs of the gates take 2e-8 s for an update of an
  /// unknown, and a step of next to nothing 1e-7 s.
  double seconds(int unknowns) const { return 2e-8 * updates(unknowns) + 1e-7 * steps(); }
};
Outlook outlook(const Case&, const Leaf&);
inline TimeStep step_of(const Case& c, const Leaf& leaf) { return outlook(c, leaf).step; }

/// One run of a leaf's scene, measured: errors, predictions, ledger, invariants and limits that the case's gates ask
/// for.
reports::Run run_leaf(const Case&, const Leaf&, const TimeStep&, const Running& = {});

/// The same of a case as it is written, with the step that the leaf asks for.
reports::Run run_leaf(const Case&, const Leaf&, const Running& = {});

/// How many updates of unknowns a run will take, about; the case as it is written.
double updates_ahead(const Case&, const Leaf&);

}  // namespace diptych::runner
