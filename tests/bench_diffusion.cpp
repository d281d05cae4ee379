// Node updates per second of the diffusion, at the step of the wave on the paper's plate and its refinements.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "diffusion/concentration.hpp"

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

BENCHMARK_MAIN();
