#include "runner/trade/bench.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "hinge/step/threads.hpp"
#include "runner/input/messages.hpp"
#include "runner/panel.hpp"
#include "runner/trade/bench_scenes.hpp"
#include "runner/trade/timing.hpp"

namespace diptych::runner {
namespace {

constexpr double least = 0.1;  // [s] of a round: a clock's tick and a moment's noise are small beside it
const std::vector<double> particles{0.25, 0.75};

/// One solver on one scene: how it is run for so many steps, and what that took.
struct Subject {
  reports::BenchRow row;
  std::function<Work(long steps, double& diffusion)> run;
  long more = 16;  ///< steps of the long run beyond the short one's
  std::vector<double> seconds, bandwidths;
};

/// The run of a scene for so many steps, by its solver.
template <class S, class M, class R>
auto runs(const Solver<S, M, R>& solver, const S& scene, const M& mesh, const Stepping& stepping) {
  return [&solver, scene, mesh, stepping](long steps, double& diffusion) {
    Stepping with = stepping;
    with.steps = steps;
    const R record = solver.run(scene, mesh, with);
    if (record.outcome != Outcome::completed) throw std::runtime_error(record.message);
    if constexpr (requires { record.diffusion_updates; })
      diffusion = static_cast<double>(record.diffusion_updates) / static_cast<double>(record.steps);
    return record.work;
  };
}

Subject of_plate(const BenchScene& scene, const Panel& row, double points, int threads) {
  Subject subject;
  const int n = std::max(2, static_cast<int>(std::lround(std::sqrt(points / 6))));  // four points a cell, n × 1.5 n
  const Cells cells{n, 3 * n / 2};
  const Plate plate = scene.plate(cells);
  const PlateMesh mesh{{cells.x, cells.y, plate.width / cells.x, plate.height / cells.y}, particles};
  Stepping stepping;
  stepping.time_step = 0.5 * std::min(mesh.grid.hx, mesh.grid.hy) / elastic(plate).pressure_wave_speed();
  stepping.books = Books::off;
  stepping.threads = threads;
  subject.row.points = 4 * mesh.grid.cells();
  subject.row.cells_x = cells.x;
  subject.row.cells_y = cells.y;
  subject.run = runs(row.plate, plate, mesh, stepping);
  return subject;
}

Subject of_bars(const BenchScene& scene, const Panel& row, double points) {
  Subject subject;
  const Scene bars = scene.bars();
  const int cells = static_cast<int>(points) / (row.particles ? 2 : 1);
  const BarMesh mesh{cells, particles};
  Stepping stepping;
  stepping.time_step = 0.5 * bars.bars[0].length / cells / largest_wave_speed(bars);
  stepping.books = Books::off;
  subject.row.points = static_cast<std::size_t>(row.particles ? 2 * cells : cells);
  subject.row.cells_x = cells;
  subject.row.cells_y = 1;
  subject.run = runs(row.bars, bars, mesh, stepping);
  return subject;
}

double seconds_of(const Subject& subject, long steps, Work& work, double& diffusion) {
  const auto begin = std::chrono::steady_clock::now();
  work = subject.run(steps, diffusion);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Bytes a second, read and written, of a sweep in place over so many bytes with so many threads.
double bandwidth(double bytes, int threads) {
  const auto count = std::max<std::size_t>(1024, static_cast<std::size_t>(bytes / sizeof(double)));
  const Threads pool(threads);
  const auto parts = static_cast<std::size_t>(threads);
  std::vector<double> values(count, 1);
  const auto sweep = [&] {
    pool.for_each(parts, [&](std::size_t k) {
      double* __restrict at = values.data() + k * count / parts;
      const std::size_t length = (k + 1) * count / parts - k * count / parts;
      for (std::size_t i = 0; i < length; ++i) at[i] = 0.999 * at[i] + 0.5;
    });
    asm volatile("" : : "r"(values.data()) : "memory");  // the values are wanted
  };
  sweep();
  double spent = 0;
  std::size_t sweeps = 0;
  while (spent < least / 4) {
    const auto begin = std::chrono::steady_clock::now();
    const auto many = std::max<std::size_t>(1, (std::size_t{1} << 20) / count);
    for (std::size_t k = 0; k < many; ++k) sweep();
    spent += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    sweeps += many;
  }
  return 2 * sizeof(double) * static_cast<double>(count) * static_cast<double>(sweeps) / spent;
}

/// One round of one subject.
void time_round(Subject& subject, bool counts) {
  constexpr long few = 2, most = 2000;
  double passed = 0;
  Work work;
  for (long steps = 0; passed < least;) {
    double none = 0;
    const double start_up = seconds_of(subject, few, work, none);
    const double stepping = seconds_of(subject, few + subject.more, work, subject.row.diffusion) - start_up;
    if (!counts && stepping < std::min(least, 2 * start_up) && subject.more < most) {
      subject.more *= 2;  // what is looked for drowns in what every run takes
      continue;
    }
    passed += stepping;
    steps += subject.more;
    if (passed >= least && counts) subject.seconds.push_back(passed / static_cast<double>(steps));
  }
  subject.row.bytes = static_cast<double>(work.bytes);
  if (counts) subject.bandwidths.push_back(bandwidth(subject.row.bytes, subject.row.threads));
}

}  // namespace

std::vector<reports::BenchRow> bench(const BenchPlan& plan, const std::atomic<bool>* cancelled,
                                     const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<Subject> subjects;
  for (const BenchScene& scene : bench_scenes()) {
    if (!contains(plan.scenes, scene.id)) continue;
    for (const std::string& method : plan.methods) {
      const Panel& row = panel(method);
      for (const double points : plan.points) {
        for (const int threads : plan.threads) {
          if (scene.bars && threads > 1) continue;  // bars have no threads
          if (!row.takes(scene.bars ? SceneKind::bars : SceneKind::plate)) continue;
          if (scene.of_particles && !row.particles) continue;
          Subject subject = scene.bars ? of_bars(scene, row, points) : of_plate(scene, row, points, threads);
          subject.row.scene = scene.id;
          subject.row.method = method;
          subject.row.threads = threads;
          subjects.push_back(std::move(subject));
        }
      }
    }
  }
  const std::size_t total = subjects.size() * static_cast<std::size_t>(plan.rounds + 1);
  std::size_t done = 0;
  for (int round = 0; round <= plan.rounds; ++round) {
    for (Subject& subject : subjects) {
      if (cancelled && *cancelled) break;
      try {
        if (subject.row.trouble.empty()) time_round(subject, round > 0);
      } catch (const std::exception& problem) {
        subject.row.trouble = problem.what();
      }
      if (progress) progress(++done, total);
    }
  }
  std::vector<reports::BenchRow> rows;
  for (Subject& subject : subjects) {
    subject.row.step = summed_up(subject.seconds);
    subject.row.bandwidth = summed_up(subject.bandwidths).seconds;
    if (subject.seconds.empty() && subject.row.trouble.empty()) subject.row.trouble = "not timed";
    rows.push_back(std::move(subject.row));
  }
  return rows;
}

}  // namespace diptych::runner
