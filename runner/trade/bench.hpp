// How quick the solvers' loops are in scenes where something goes on, beside what the memory gives.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "reports/bench_results.hpp"

namespace diptych::runner {

struct BenchPlan {
  std::vector<std::string> scenes, methods;  ///< ids of bench_scenes() and of panels
  std::vector<double> points;                ///< about so many elements or particles
  std::vector<int> threads;
  int rounds = 3;
};

/// Every solver that takes it on every scene, size and number of threads: each once a round, one after the other, and a
/// first round that is not counted. A step's time is that of a long run less a short one, so that building the scene up
/// does not count. Other work must not go on in this process.
std::vector<reports::BenchRow> bench(const BenchPlan&, const std::atomic<bool>* cancelled,
                                     const std::function<void(std::size_t done, std::size_t total)>& progress);

}  // namespace diptych::runner
