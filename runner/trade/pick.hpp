// Which setting is the cheapest that is near enough.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/trade_results.hpp"
#include "runner/input/case.hpp"
#include "runner/run/run_leaf.hpp"

namespace diptych::runner {

struct Target {
  double error = 0;  ///< at most, part of the quantity's scale, > 0
  reports::Aim aim;
  std::optional<double> seconds;  ///< at most
  std::optional<double> bytes;    ///< at most
  reports::Cost cost = reports::Cost::work;
  int rounds = 0;  ///< in which what is proposed is timed
};

/// What was picked of the measured points; indices into Trade::points.
struct Pick {
  std::optional<std::size_t> best;       ///< the cheapest that meets the target
  std::optional<std::size_t> runner_up;  ///< the cheapest that does of another setting
  std::optional<std::size_t> halved;     ///< the cheapest with half the error asked for
  std::optional<std::size_t> nearest;    ///< where none meets the target: the least error within the limits
};

/// Error and the band of its reference together must be within the target, and so must those of the finer meshes of the
/// setting: a mesh whose finer ones are further off is near by chance.
Pick pick(const reports::Trade&, const Target&);

/// A number of cells that was not run, of the setting of a measured point, with what the errors of that setting's
/// meshes let expect of it: a line through the two nearest in log error over log h.
struct Proposal {
  std::string setting;
  std::size_t which = 0, like = 0;  ///< a run of the setting among the cases and their leaves
  int threads = 1;
  int cells = 0;
  double error = 0;  ///< expected
};
/// The fewest cells that may do: between the picked mesh and the next coarser one of its setting, or, where none meets
/// the target, beyond the finest one of the setting that is nearest, but no further than four times as fine. Nothing
/// where the reference is extrapolated, the setting has no two meshes whose errors fall, or no number of cells lies
/// between.
std::optional<Proposal> propose(const reports::Trade&, const Target&, const Pick&);

/// The answer in sentences: the pick with its margin, the runner-up, what half the error costs; or that none does and
/// how near the nearest is.
std::string words_of(const reports::Trade&, const Target&, const Pick&);

/// A proposal that was run: whether it meets the target, in words, and its point for the trade.
struct Trial {
  bool confirmed = false;
  std::string words;
  reports::TradePoint point;
};
Trial tried(const std::vector<Case>&, const Target&, const Proposal&, const Running&);

}  // namespace diptych::runner
