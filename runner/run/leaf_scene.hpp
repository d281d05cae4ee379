// What run_leaf asks of a kind of scene. Bars, plates and diffusion alone implement it; what they share stands once, in
// run_leaf.cpp.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/results.hpp"
#include "runner/input/build.hpp"
#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"
#include "runner/panel.hpp"
#include "runner/run/instants.hpp"

namespace diptych::runner {

/// An exact solution that is made when it is first asked for: front tracking can cost more than the run, and what looks
/// ahead at a run needs none. Null where the case names none.
template <class Solution>
class WhenAsked {
 public:
  explicit WhenAsked(std::function<std::unique_ptr<Solution>()> make) : make_(std::move(make)) {}
  const Solution* get() const {
    if (make_) made_ = std::exchange(make_, nullptr)();
    return made_.get();
  }

 private:
  mutable std::function<std::unique_ptr<Solution>()> make_;
  mutable std::unique_ptr<Solution> made_;
};

/// One leaf of a case, built: the scene and its mesh, which travel together, and the panel that solves it. `c` is the
/// case as the leaf has it; both must outlive this.
template <class S, class M, class R>
class LeafScene {
 public:
  using Snapshot = typename decltype(R::snapshots)::value_type;
  using Solve = Solver<S, M, R>;

  virtual ~LeafScene() = default;

  R solve(const Stepping& stepping) const { return solver.run(scene, mesh, stepping); }
  /// Largest stable time step [s]; NaN where the panel knows none.
  double limit() const { return solver.limit ? solver.limit(scene, mesh) : std::numeric_limits<double>::quiet_NaN(); }

  virtual double unit_time_step() const = 0;  ///< of Courant number 1 [s]
  virtual double asked_time_step() const { return leaf.courant * unit_time_step(); }
  virtual std::vector<double> instants() const = 0;                             ///< the sample times [s]
  virtual Read reads(bool keep_fields) const = 0;                               ///< which fields are read at them
  virtual std::vector<long> more_samples(const Stepping&) const { return {}; }  ///< steps after which figures look
  virtual std::optional<double> mass() const = 0;  ///< [kg], of a plate's thickness [kg/m]; none: no mechanics

  /// Histories of the whole run, from all of its snapshots.
  /// more: those of more_samples.
  virtual void trace(const R&, const std::vector<long>& /*more*/, const Stepping&, reports::Run&) const {}
  /// own: errors are those of each field at its own time, next to the instant; at: what is read and drawn is the
  /// instant's.
  virtual reports::Sample sample(const Snapshot& own, const Snapshot& at, double asked, bool keep_fields,
                                 const reports::Run&) const = 0;
  /// What is measured on the snapshots next to the instants, beside what run_leaf measures on every scene.
  virtual void measure(const R&, const Stepping&, reports::Run&) const = 0;
  /// Features that the run should show, but for what the panel does not.
  virtual std::vector<std::string> declared() const { return c.features; }
  /// Why the run's own exact solution is not to be trusted, or nothing.
  virtual std::string doubt() const { return {}; }

  /// Numbers that differ between two records after scaling; a different number of samples counts as one more. NaN where
  /// there are only zeros.
  virtual double differing(const R&, const R&, const PowersOfTwo&, bool mirror) const = 0;
  virtual S scaled_scene(const PowersOfTwo&) const { return scene; }
  virtual std::pair<S, M> seen_from_behind() const { return {scene, mesh}; }
  /// Scenes without something that is there and does nothing, each with the quantity that says so.
  virtual std::vector<std::pair<std::string, S>> without_what_does_nothing() const { return {}; }
  /// The Courant number up to which theory says that the scene is stable; nothing where there is none.
  virtual std::optional<double> predicted_limit() const { return {}; }

  const Case& c;
  const Leaf& leaf;
  const Panel& row;
  const Solve& solver;
  const S scene;
  const M mesh;

 protected:
  LeafScene(const Case& case_of_leaf, const Leaf& one, const Panel& its_row, const Solve& its_solver, S built, M cells)
      : c(case_of_leaf), leaf(one), row(its_row), solver(its_solver), scene(std::move(built)), mesh(std::move(cells)) {}
  LeafScene(const LeafScene&) = default;
};

}  // namespace diptych::runner
