#include "runner/trade/off.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "runner/input/messages.hpp"
#include "runner/panel.hpp"
#include "runner/trade/off_scenes.hpp"
#include "runner/trade/timing.hpp"

namespace diptych::runner {
namespace {

const std::vector<double> of_a_cell{0.25, 0.75};

/// What a run has to show.
struct Shown {
  std::vector<double> numbers;  ///< its fields when the last step is done, in the order of its points
  double bytes = 0, points = 0;
};
struct RunOfSteps {
  std::function<Shown(long steps, bool fields)> run;
};

std::vector<double> fields_at_end(const Snapshot& s) {
  std::vector<double> all;
  for (const Field* f : {&s.stress, &s.velocity, &s.displacement}) {
    const std::vector<double> first = f->of_bar(0).value;
    all.insert(all.end(), first.begin(), first.end());
  }
  return all;
}
std::vector<double> fields_at_end(const PlateSnapshot& s) {
  std::vector<double> all;
  for (const PointField* f : {&s.stress, &s.velocity, &s.displacement})
    for (const std::vector<double>& component : f->component) all.insert(all.end(), component.begin(), component.end());
  return all;
}

template <class S, class M, class R>
RunOfSteps run_of(const Solver<S, M, R>& solver, S scene, M mesh, Stepping stepping) {
  return {[&solver, scene = std::move(scene), mesh = std::move(mesh), stepping](long steps, bool fields) {
    Stepping with = stepping;
    with.steps = steps;
    if (fields) with.sample_after = {steps};
    const R record = solver.run(scene, mesh, with);
    if (record.outcome != Outcome::completed) throw std::runtime_error(record.message);
    const auto done = static_cast<double>(record.work.element_steps + record.work.particle_steps);
    Shown shown{{}, static_cast<double>(record.work.bytes), done / static_cast<double>(steps)};
    if (fields) shown.numbers = fields_at_end(record.snapshots.at(0));
    return shown;
  }};
}

struct OffSubject {
  reports::OffRow row;
  RunOfSteps without, with;
  double points_with = 0;
  long more = 16;  ///< steps of the long run beyond the short one's
  std::vector<double> ratios;
};

OffSubject plates_of(const OffPair& pair, const Panel& row, double points) {
  OffSubject subject;
  const int n = std::max(2, static_cast<int>(std::lround(std::sqrt(points / 6))));  // four points a cell, n × 1.5 n
  const Cells cells{n, 3 * n / 2};
  const Plate without = pair.plate(cells), with = pair.plate_with(cells);
  const PlateMesh mesh{{cells.x, cells.y, without.width / cells.x, without.height / cells.y}, of_a_cell};
  Stepping stepping;
  stepping.time_step = 0.5 * std::min(mesh.grid.hx, mesh.grid.hy) / elastic(without).pressure_wave_speed();
  stepping.books = Books::off;
  subject.without = run_of(row.plate, without, mesh, stepping);
  if (pair.kind == reports::OffRow::Kind::books) stepping.books = Books::sums;
  subject.with = run_of(row.plate, with, mesh, stepping);
  subject.row.scene = "plate";
  subject.row.least = least_bytes(row, mesh, without.solid);
  subject.row.rim = rim_bytes(mesh);
  return subject;
}

OffSubject bars_of(const OffPair& pair, const Panel& row, double points) {
  OffSubject subject;
  const int cells = std::max(1, static_cast<int>(points) / (row.particles ? 2 : 1) / 8) * 8;  // a bar of an eighth
  const Scene without = pair.bars(cells), with = pair.bars_with(cells);
  const BarMesh mesh{cells, of_a_cell};
  Stepping stepping;
  stepping.time_step = 0.5 * without.bars[0].length / cells / largest_wave_speed(without);
  stepping.books = Books::off;
  subject.without = run_of(row.bars, without, mesh, stepping);
  if (pair.kind == reports::OffRow::Kind::books) stepping.books = Books::sums;
  subject.with = run_of(row.bars, with, mesh, stepping);
  subject.row.scene = "bar";
  subject.row.least = least_bytes(row, mesh);
  return subject;
}

bool bitwise_same(const std::vector<double>& a, const std::vector<double>& b) {
  return !a.empty() && a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

void compare_pair(OffSubject& subject) {
  constexpr long steps = 20;
  const Shown a = subject.without.run(steps, true), b = subject.with.run(steps, true);
  reports::OffRow& row = subject.row;
  row.same_bits = bitwise_same(a.numbers, b.numbers);
  row.points = static_cast<std::size_t>(a.points);
  subject.points_with = b.points;
  row.bytes = a.bytes / a.points;
  row.more = b.bytes / b.points - row.bytes;
  row.least /= a.points;
  row.rim /= a.points;
}

double seconds_of_run(const RunOfSteps& run, long steps) {
  const auto begin = std::chrono::steady_clock::now();
  run.run(steps, false);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void time_pair(OffSubject& subject, bool counts) {
  constexpr long few = 2, most = 20000;
  constexpr double smallest = 0.1;  // [s] a run's steps; a clock's tick and a moment's noise are small beside it
  const auto stepping = [&](const RunOfSteps& run, double& start_up) {
    start_up = seconds_of_run(run, few);
    return seconds_of_run(run, few + subject.more) - start_up;
  };
  double start_up = 0;
  if (!counts) {
    while (stepping(subject.without, start_up) < std::max(smallest, 2 * start_up) && subject.more < most)
      subject.more *= 2;
    return;
  }
  const double first = stepping(subject.without, start_up);
  const double second = stepping(subject.with, start_up) + stepping(subject.with, start_up);
  const double both = first + stepping(subject.without, start_up);
  if (both > 0) subject.ratios.push_back(second / subject.points_with / both * static_cast<double>(subject.row.points));
}

}  // namespace

std::vector<reports::OffRow> off(const OffPlan& plan, const std::atomic<bool>* cancelled,
                                 const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<OffSubject> subjects;
  for (const OffPair& pair : off_pairs()) {
    if (!contains(plan.features, pair.feature)) continue;
    for (const std::string& method : plan.methods) {
      const Panel& row = panel(method);
      for (const double points : plan.points) {
        const auto add = [&](OffSubject subject) {
          subject.row.feature = pair.feature;
          subject.row.method = method;
          subject.row.kind = pair.kind;
          subjects.push_back(std::move(subject));
        };
        if (pair.plate && row.takes(SceneKind::plate)) add(plates_of(pair, row, points));
        if (pair.bars && row.takes(SceneKind::bars)) add(bars_of(pair, row, points));
      }
    }
  }
  const std::size_t total = subjects.size() * static_cast<std::size_t>(plan.rounds + 1);
  std::size_t done = 0;
  for (int round = 0; round <= plan.rounds; ++round) {
    for (OffSubject& subject : subjects) {
      if (cancelled && *cancelled) break;
      try {
        if (round == 0) compare_pair(subject);
        if (subject.row.trouble.empty() && plan.rounds > 0) time_pair(subject, round > 0);
      } catch (const std::exception& problem) {
        subject.row.trouble = problem.what();
      }
      if (progress) progress(++done, total);
    }
  }
  std::vector<reports::OffRow> rows;
  for (OffSubject& subject : subjects) {
    subject.row.ratio = summed_up(subject.ratios);
    if (subject.ratios.empty() && plan.rounds > 0 && subject.row.trouble.empty()) subject.row.trouble = "not timed";
    rows.push_back(std::move(subject.row));
  }
  return rows;
}

}  // namespace diptych::runner
