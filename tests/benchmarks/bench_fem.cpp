// Speed of the plate's step in FEM, beside what the memory can do: an elastic plate on structured meshes, without
// books.
//
// `of_floor` is the rate over bandwidth / 36 B, 144 B being the traffic of a cell of four elements: displacement and
// velocity of two nodes read and written, and two masses read. (These masses follow from the place in the mesh and are
// not read: 128 B move.) The bandwidth is that of a[i] = s a[i] + b in place, 16 B an element and all of its traffic,
// on an array of 128 MB; `of_floor_literal` takes that of a[i] = s a[i] + b[i] counted as 16 B, though it moves 24. The
// 16 MB of 500 × 500 cells fit into the outermost cache of many a processor, the 64 MB of 1000 × 1000 into few. `best`
// and both ratios are of the best repetition, items_per_second is the mean.
#include <benchmark/benchmark.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "fem/plate.hpp"

namespace {

using namespace diptych;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Best of several sweeps [B/s], 16 B an element.
double bandwidth(int threads, bool literal) {
  const std::size_t n = std::size_t{1} << 24;
  std::vector<double> a(n, 1), b(literal ? n : 0, 1);
  tbb::task_arena arena(threads);
  double best = 0;
  for (int repeat = 0; repeat < 8; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    arena.execute([&] {
      tbb::parallel_for(
          0, threads,
          [&](int k) {
            const std::size_t part = n / static_cast<std::size_t>(threads), begin = static_cast<std::size_t>(k) * part;
            double* x = a.data() + begin;
            const double* y = literal ? b.data() + begin : nullptr;
            if (literal) {
              for (std::size_t i = 0; i < part; ++i) x[i] = 0.999 * x[i] + y[i];
            } else {
              for (std::size_t i = 0; i < part; ++i) x[i] = 0.999 * x[i] + 0.5;
            }
          },
          tbb::static_partitioner{});
    });
    best = std::max(best, 16.0 * static_cast<double>(n) / seconds_since(start));
    benchmark::DoNotOptimize(a.data());
    benchmark::ClobberMemory();
  }
  return best;
}

Plate elastic_plate() {
  Plate plate;
  plate.width = plate.height = 1;
  plate.solid = solid::Elastic{{50e9, 0.3, 2500, material::Plane::strain}};
  plate.edge(Side::left).support = plate.edge(Side::bottom).support = Edge::Support::roller;
  plate.edge(Side::top).normal_traction = [](double, double) { return 1e6; };
  return plate;
}

void fem_elastic(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0)), threads = static_cast<int>(state.range(1));
  const Plate plate = elastic_plate();
  Stepping stepping;
  stepping.time_step = 0.9 * fem::critical_time_step(plate, {cells, cells});
  stepping.books = Books::off;
  stepping.threads = threads;
  const double elements = 4.0 * cells * cells;
  const auto time = [&](long steps) {  // of a run of so many steps and of what every run takes
    stepping.steps = steps;
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(fem::run(plate, {cells, cells}, stepping));
    return seconds_since(start);
  };
  const long steps = std::max(20L, static_cast<long>(4e7 / elements));
  const double copied = bandwidth(threads, false), literal = bandwidth(threads, true);
  double best = 0;
  for (auto _ : state) {
    const double start_up = time(1), all = time(steps + 1);
    state.SetIterationTime(all - start_up);
    best = std::max(best, elements * static_cast<double>(steps) / (all - start_up));
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(elements) * steps * state.iterations());
  state.counters["GB/s"] = copied / 1e9;
  state.counters["best"] = best;
  state.counters["of_floor"] = best / (copied / 36);
  state.counters["of_floor_literal"] = best / (literal / 36);
}
BENCHMARK(fem_elastic)
    ->ArgNames({"cells", "threads"})
    ->ArgsProduct({{100, 158, 500, 1000}, {1, 2}})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
