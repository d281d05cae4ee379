// What the settings of a case cost and how far off they are, as plain data.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace diptych::reports {

/// One quantity at one sample time.
struct TradeError {
  std::string quantity;             ///< "stress.L2", "probe.tip"
  double time = 0;                  ///< as the case file asks for it [the case's unit of time]
  double error = 0;                 ///< part of the quantity's scale, >= 0
  double band = 0;                  ///< ± of the error, where the reference is extrapolated; 0: it is exact
  std::optional<double> predicted;  ///< by theory, as the error
};

/// How long a run takes.
struct Timed {
  int rounds = 0;      ///< in which it was timed; 0: it was not
  double seconds = 0;  ///< median over the rounds
  double spread = 0;   ///< half of their interquartile range, part of the median
};

/// One setting, run.
struct TradePoint {
  std::string label;    ///< of the run
  std::string setting;  ///< the label less the number of cells: what a family of meshes has in common
  std::string method;   ///< "fem", "mpm-musl"
  std::string scene;    ///< variant, parameters and what was changed, "v0=0.1": only points of one are compared
  std::size_t which = 0, leaf = 0;  ///< which of the cases, and of its runs
  int threads = 1;                  ///< with which it is timed
  int cells = 0;
  double cell_size = 0;  ///< [case units]
  /// "completed", or why it is no candidate; "timed out": `timed` is what it had taken when it was stopped.
  std::string status;
  std::string message;                                         ///< more of that
  int unknowns = 0;                                            ///< that move
  long steps = 0;                                              ///< of time
  long element_steps = 0, particle_steps = 0, node_steps = 0;  ///< deterministic work
  long diffusion_updates = 0;                                  ///< and that of the diffusion, of nodes
  std::size_t bytes = 0;                                       ///< of the solver's arrays
  Timed timed;
  std::vector<TradeError> errors;  ///< of a completed run

  bool completed() const { return status == "completed"; }
  double work() const { return static_cast<double>(element_steps + particle_steps + node_steps + diffusion_updates); }
  /// Null where it has none.
  const TradeError* error_of(const std::string& quantity, double time) const {
    for (const TradeError& one : errors)
      if (one.quantity == quantity && one.time == time) return &one;
    return nullptr;
  }
};

/// What is looked at in a trade.
struct Aim {
  std::string quantity;
  double time = 0;
};

/// All settings of a case, and of its changes, that were run.
struct Trade {
  std::string case_id, title, time_unit;
  std::vector<TradePoint> points;  ///< in the order of the axes
  /// All that has an error, in the order of first mention.
  std::vector<Aim> aims() const {
    std::vector<Aim> all;
    for (const TradePoint& point : points)
      for (const TradeError& one : point.errors) {
        bool known = false;
        for (const Aim& aim : all) known = known || (aim.quantity == one.quantity && aim.time == one.time);
        if (!known) all.push_back({one.quantity, one.time});
      }
    return all;
  }
};

/// Only the points of this scene.
Trade of_scene(Trade, const std::string& scene);

/// What a setting is paid in.
enum class Cost { work, seconds, bytes };
/// Infinite in seconds where it was not timed: what is not known is never the cheapest.
double cost_of(const TradePoint&, Cost);

/// Whether no other completed point is as cheap and as near, and better in one of the two; of each point. Errors of the
/// size of round-off are equal, and so are those below the band of their reference. What has no
/// finite error stands on no front.
std::vector<bool> on_front(const Trade&, const Aim&, Cost);

}  // namespace diptych::reports
