// Particle steps a second of the plate, beside what the memory can carry: 136 B a particle and step.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "mpm/plate.hpp"

using namespace diptych;

namespace {

constexpr double bytes_a_particle = 136;

/// Bytes a second of a[i] = s a[i] + b[i] in place, 16 B an element, on arrays of this many bytes together; the best of
/// some rounds.
double bandwidth(std::size_t bytes) {
  const std::size_t count = bytes / 16;
  std::vector<double> a(count, 1.0), b(count, 0.5);
  const std::size_t rounds = std::max<std::size_t>(3, (std::size_t{1} << 29) / bytes);
  double best = 0;
  for (std::size_t r = 0; r < rounds + 1; ++r) {
    const auto begin = std::chrono::steady_clock::now();
    double *pa = a.data(), *pb = b.data();
    const double s = 0.999;
#pragma GCC ivdep
    for (std::size_t i = 0; i < count; ++i) pa[i] = s * pa[i] + pb[i];
    benchmark::DoNotOptimize(a.data());
    benchmark::ClobberMemory();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    if (r > 0) best = std::max(best, static_cast<double>(16 * count) / taken.count());
  }
  return best;
}

Plate wave() {
  Plate plate;
  plate.width = plate.height = 1;
  plate.solid = solid::Elastic{{1, 0.3, 1, material::Plane::strain}};
  plate.initial_velocity = [](double x, double y) {
    return Vector{std::cos(M_PI * x) * std::sin(M_PI * y), -std::sin(M_PI * x) * std::cos(M_PI * y)};
  };
  return plate;
}

/// Time of one step: a long run's less a short one's, so that building the plate up does not count.
void musl(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const Plate plate = wave();
  const std::vector<double> positions{0.25, 0.75};
  Stepping stepping;
  stepping.time_step = 0.5 / n / elastic(plate).pressure_wave_speed();
  stepping.books = Books::off;
  stepping.threads = static_cast<int>(state.range(1));
  const double particles = 4.0 * n * n;
  const long few = 2, many = few + static_cast<long>(4e7 / particles);
  const auto seconds = [&](long steps) {
    stepping.steps = steps;
    const auto begin = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(mpm::run(plate, {n, n}, positions, mpm::Scheme::musl, stepping));
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  double rate = 0;
  for (auto _ : state) {
    const double taken = seconds(many) - seconds(few);
    state.SetIterationTime(taken);
    rate = std::max(rate, particles * static_cast<double>(many - few) / taken);
  }
  const double carried = bandwidth(static_cast<std::size_t>(70 * particles));
  const double from_memory = bandwidth(std::size_t{1} << 28);
  state.SetItemsProcessed(static_cast<std::int64_t>(particles) * (many - few) * state.iterations());
  state.counters["bandwidth"] = from_memory;
  state.counters["of_floor"] = rate / (from_memory / bytes_a_particle);
  state.counters["bandwidth_in_reach"] = carried;
  state.counters["of_floor_in_reach"] = rate / (carried / bytes_a_particle);
}

}  // namespace

BENCHMARK(musl)
    ->ArgNames({"cells", "threads"})
    ->Args({158, 1})
    ->Args({500, 1})
    ->Args({158, 2})
    ->Args({500, 2})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
