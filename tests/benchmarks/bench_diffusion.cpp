// Node updates per second of the diffusion, at the step of the wave on the paper's plate and its refinements; and what
// a failure wave costs at every step of the wave.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "hinge/diffusion/concentration.hpp"
#include "hinge/diffusion/dilatancy.hpp"

using namespace diptych::diffusion;

namespace {

/// Eq. 25 under a wave of strain that moves on from step to step.
void vary(const Grid& g, int step, std::vector<double>& d) {
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i)
      d[static_cast<std::size_t>(j * g.nx + i)] = 500 * (0.7 + 0.3 * std::sin(6 * j * g.hy + i * g.hx - 0.02 * step));
  }
}

void run(benchmark::State& state, Scheme scheme, bool varying) {
  const int n = static_cast<int>(state.range(0));
  const Grid g{n, 3 * n / 2, 1.0 / n, 1.0 / n};
  double dt = 0.5785 * g.hx / 5189;
  if (scheme == Scheme::forward_euler) dt = forward_euler_limit(g, 500);
  Concentration c(g, scheme);
  std::vector<double> s(g.nodes(), 0);
  s[0] = 1;
  std::vector<std::vector<double>> d(varying ? 8 : 1, std::vector<double>(g.cells()));
  for (std::size_t k = 0; k < d.size(); ++k) vary(g, static_cast<int>(k), d[k]);
  c.step(d[0], s, dt);
  const long before = c.node_updates();
  std::size_t k = 0;
  for (auto _ : state) {
    k = (k + 1) % d.size();
    c.step(d[k], s, dt);
    benchmark::DoNotOptimize(c.values().data());
  }
  state.counters["node_updates"] =
      benchmark::Counter(static_cast<double>(c.node_updates() - before), benchmark::Counter::kIsRate);
}

void forward_euler(benchmark::State& state) { run(state, Scheme::forward_euler, true); }
void sub_cycled(benchmark::State& state) { run(state, Scheme::sub_cycled, true); }
void rkl2(benchmark::State& state) { run(state, Scheme::rkl2, true); }
void backward_euler_factor_and_solve(benchmark::State& state) { run(state, Scheme::backward_euler, true); }
void backward_euler_solve(benchmark::State& state) { run(state, Scheme::backward_euler, false); }

/// A strip of glass, 40 mm in cells of 0.1 mm, that a shock crosses in 800 steps of 8.77 ns. Its explicit diffusion
/// takes up to 29 parts; forward Euler is given shorter steps, 29 to one of the wave. Time is that of a wave's step.
void failure_wave(benchmark::State& state, Scheme scheme, Profile profile, double drift = 0) {
  const Grid g{400, 1, 1e-4, 1e-4};
  const double dt = 8.77e-9, d0 = 8;
  const int steps = 2 * g.nx;
  const int parts = scheme == Scheme::forward_euler ? static_cast<int>(std::ceil(dt / forward_euler_limit(g, d0))) : 1;
  long updates = 0;
  for (auto _ : state) {
    Dilatancy v({.diffusivity = d0, .profile = profile, .scheme = scheme, .drift = drift, .face = 0}, g);
    std::vector<double> ceiling(g.cells(), 0);
    for (int n = 0; n < steps; ++n) {
      ceiling[static_cast<std::size_t>(n / 2)] = 0.01;
      for (int k = 0; k < parts; ++k) v.advance(ceiling, dt / parts);
    }
    benchmark::DoNotOptimize(v.of_cells().data());
    updates = v.node_updates();
  }
  using benchmark::Counter;
  state.counters["per_wave_step"] = Counter(steps, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["node_updates_per_wave_step"] = static_cast<double>(updates) / steps;
}

void grids(benchmark::internal::Benchmark* b) {
  for (const int n : {20, 40, 80, 160, 320}) b->Arg(n);
  b->ArgName("cells_across")->Unit(benchmark::kMicrosecond);
}

}  // namespace

BENCHMARK(forward_euler)->Apply(grids);
BENCHMARK(sub_cycled)->Apply(grids);
BENCHMARK(rkl2)->Apply(grids);
BENCHMARK(backward_euler_factor_and_solve)->Apply(grids);
BENCHMARK(backward_euler_solve)->Apply(grids);

BENCHMARK_CAPTURE(failure_wave, forward_euler, Scheme::forward_euler, Profile::falling)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(failure_wave, sub_cycled, Scheme::sub_cycled, Profile::falling)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(failure_wave, rkl2, Scheme::rkl2, Profile::falling)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(failure_wave, backward_euler, Scheme::backward_euler, Profile::falling)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(failure_wave, backward_euler_drift, Scheme::backward_euler, Profile::falling, 0.05)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(failure_wave, crank_nicolson, Scheme::crank_nicolson, Profile::falling)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(failure_wave, sub_cycled_constant, Scheme::sub_cycled, Profile::constant)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(failure_wave, backward_euler_constant, Scheme::backward_euler, Profile::constant)
    ->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
