#include "runner/trade/timing.hpp"

#include <tbb/global_control.h>

#include <algorithm>

#include "reports/results.hpp"
#include "runner/run/run_leaf.hpp"

namespace diptych::runner {
namespace {

/// Between two of the sorted values, as far as `share` says.
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

reports::Timed summed_up(std::vector<double> rounds) {
  if (rounds.empty()) return {};
  std::sort(rounds.begin(), rounds.end());
  const double median = quantile(rounds, 0.5);
  const double range = quantile(rounds, 0.75) - quantile(rounds, 0.25);
  return {static_cast<int>(rounds.size()), median, median > 0 ? range / 2 / median : 0};
}

std::vector<reports::Timed> time_runs(const std::vector<TimedRun>& runs, int rounds, const std::atomic<bool>* cancelled,
                                      const std::function<void(std::size_t, std::size_t)>& progress) {
  constexpr double least = 0.01;  // [s] of a round; a clock and a cold cache are then small beside it
  Running running;
  running.cancelled = cancelled;
  std::vector<std::vector<double>> taken(runs.size());
  const std::size_t total = runs.size() * static_cast<std::size_t>(rounds + 1);
  std::size_t done = 0;
  for (int round = 0; round <= rounds; ++round) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (cancelled && *cancelled) break;
      const tbb::global_control own_threads(tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(runs[i].threads));
      running.threads_a_run = runs[i].threads;
      double spent = 0;
      int repeats = 0;
      bool completed = true;
      while (completed && spent < least) {
        const reports::Run run = run_leaf(*runs[i].c, runs[i].leaf, running);
        completed = run.status == "completed";
        spent += run.wall_seconds;
        ++repeats;
        if (!(run.wall_seconds > 0)) break;  // shorter than the clock's tick
      }
      if (completed && round > 0) taken[i].push_back(spent / repeats);
      if (progress) progress(++done, total);
    }
  }
  std::vector<reports::Timed> all;
  for (const std::vector<double>& each : taken) all.push_back(summed_up(each));
  return all;
}

}  // namespace diptych::runner
