#include "runner/run/instants.hpp"

#include <algorithm>
#include <cmath>

namespace diptych::runner {
namespace {

/// A value is (1 − part) of the one before and part of the one after.
struct Between {
  std::size_t before = 0, after = 0;
  double part = 0;

  double of(double first, double second) const { return part == 0 ? first : (1 - part) * first + part * second; }
  std::vector<double> of(const std::vector<double>& first, const std::vector<double>& second) const {
    std::vector<double> value = first;
    if (part != 0)
      for (std::size_t i = 0; i < value.size(); ++i) value[i] = of(first[i], second[i]);
    return value;
  }
};

/// Among times that do not descend, at least one.
Between between(const std::vector<double>& times, double instant) {
  if (times.size() < 2) return {};
  const auto above = std::upper_bound(times.begin() + 1, times.end() - 1, instant);
  Between found{0, static_cast<std::size_t>(above - times.begin()), 0};
  found.before = found.after - 1;
  while (found.before > 0 && times[found.before] == times[found.after]) --found.before;
  while (found.after + 1 < times.size() && times[found.before] == times[found.after]) ++found.after;
  const double span = times[found.after] - times[found.before], near = 1e-9;
  if (!(span > 0)) return {found.before, found.before, 0};
  found.part = (instant - times[found.before]) / span;
  if (std::abs(found.part) <= near) return {found.before, found.before, 0};
  if (std::abs(found.part - 1) <= near) return {found.after, found.after, 0};
  return found;
}

/// The two snapshots around an instant, by one of their times.
template <class Snapshot, class Time>
Between between(const std::vector<Snapshot>& snapshots, double instant, Time time_of) {
  std::vector<double> times;
  for (const Snapshot& s : snapshots) times.push_back(time_of(s));
  return between(times, instant);
}

/// From the whole step tⁿ next to an instant t displacements fall freely: u(tⁿ) + (t − tⁿ) v + (t − tⁿ)²/2 a, with the
/// leapfrog's own v and a around tⁿ.
struct Fall {
  double whole, dt, ahead;

  Fall(long step, double time_step, double instant)
      : whole(static_cast<double>(step) * time_step), dt(time_step), ahead(instant - whole) {}
  bool falls() const { return std::abs(ahead) > 1e-9 * dt; }
  template <class Velocity>
  void add(Velocity velocity, std::vector<double>& u) const {
    const std::vector<double> before = velocity(whole - dt / 2), at = velocity(whole), after = velocity(whole + dt / 2);
    for (std::size_t i = 0; i < u.size(); ++i)
      u[i] += ahead * at[i] + ahead * ahead / 2 * ((after[i] - before[i]) / dt);
  }
};

}  // namespace

std::vector<long> Plan::own_steps() const {
  std::vector<long> steps = nearest;
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  return steps;
}

Meet what_to_meet(const Case& c) {
  const bool measures_order =
      std::any_of(c.gates.begin(), c.gates.end(), [](const GateSpec& gate) { return gate.keeps_time_steps; });
  return measures_order ? Meet::last : Meet::all;
}

Plan plan_steps(const std::vector<double>& instants, const TimeStep& step, Meet meet, Read read, Books books) {
  const double end = instants.back(), needed = end / step.asked;
  Plan plan;
  Stepping& stepping = plan.stepping;
  stepping.limit = step.limit;
  stepping.books = books;
  stepping.steps = std::max(1L, static_cast<long>(std::ceil(needed * (1 - round_off))));
  const auto whole = [](double steps) { return std::abs(steps - std::round(steps)) <= 1e-9 * std::max(1.0, steps); };
  const auto meets_all = [&](long steps) {
    return std::all_of(instants.begin(), instants.end(),
                       [&](double t) { return whole(t / end * static_cast<double>(steps)); });
  };
  if (meet == Meet::all && !whole(needed)) {
    const long most = stepping.steps + std::max(16L, stepping.steps / 25);
    for (long steps = stepping.steps; steps <= most; ++steps) {
      if (!meets_all(steps)) continue;
      stepping.steps = steps;
      break;
    }
  }
  stepping.time_step = end / static_cast<double>(stepping.steps);
  for (const double t : instants) {
    const double steps = t / stepping.time_step;
    plan.nearest.push_back(std::max(1L, std::lround(steps)));
    const double at = whole(steps) ? std::round(steps) : steps, beside = read == Read::all ? 0.5 : 0;
    const long first = std::max(0L, static_cast<long>(std::floor(at - beside)));
    const long last = read == Read::all ? first + 2 : static_cast<long>(std::ceil(at));
    for (long n = first; n <= std::min(last, stepping.steps + 1); ++n) stepping.sample_after.push_back(n);
  }
  auto& samples = stepping.sample_after;
  samples.insert(samples.end(), plan.nearest.begin(), plan.nearest.end());
  std::sort(samples.begin(), samples.end());
  samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
  return plan;
}

Snapshot at_instant(const std::vector<Snapshot>& snapshots, long step, double time_step, double instant) {
  const auto linear = [&](Field Snapshot::*field, double time) {
    const Between two = between(snapshots, time, [&](const Snapshot& s) { return (s.*field).time; });
    Field now = snapshots[two.before].*field;
    now.time = time;
    now.value = two.of(now.value, (snapshots[two.after].*field).value);
    return now;
  };
  Snapshot result{step, linear(&Snapshot::stress, instant), linear(&Snapshot::velocity, instant),
                  linear(&Snapshot::displacement, instant)};
  const Fall fall(step, time_step, instant);
  if (!fall.falls()) return result;
  result.displacement.value = linear(&Snapshot::displacement, fall.whole).value;
  fall.add([&](double time) { return linear(&Snapshot::velocity, time).value; }, result.displacement.value);
  return result;
}

PlateSnapshot at_instant(const std::vector<PlateSnapshot>& snapshots, long step, double time_step, double instant) {
  const auto linear = [&](PointField PlateSnapshot::*field, double time) {
    const Between two = between(snapshots, time, [&](const PlateSnapshot& s) { return (s.*field).time; });
    PointField now = snapshots[two.before].*field;
    now.time = time;
    for (std::size_t k = 0; k < now.component.size(); ++k)
      now.component[k] = two.of(now.component[k], (snapshots[two.after].*field).component[k]);
    return now;
  };
  PlateSnapshot result;
  result.step = step;
  result.time = instant;
  for (PointField PlateSnapshot::*field :
       {&PlateSnapshot::displacement, &PlateSnapshot::velocity, &PlateSnapshot::stress})
    result.*field = linear(field, instant);
  if (const Fall fall(step, time_step, instant); fall.falls()) {
    const PointField whole = linear(&PlateSnapshot::displacement, fall.whole);
    for (std::size_t k = 0; k < whole.component.size(); ++k) {
      result.displacement.component[k] = whole.component[k];
      fall.add([&](double time) { return linear(&PlateSnapshot::velocity, time).component[k]; },
               result.displacement.component[k]);
    }
  }
  const Between two = between(snapshots, instant, [](const PlateSnapshot& s) { return s.time; });
  const PlateSnapshot &before = snapshots[two.before], &after = snapshots[two.after];
  for (std::vector<double> PlateSnapshot::*values : {&PlateSnapshot::volumetric_strain, &PlateSnapshot::crack_density,
                                                     &PlateSnapshot::concentration, &PlateSnapshot::dilatancy})
    result.*values = two.of(before.*values, after.*values);
  result.strain = before.strain;
  if (two.part != 0)
    for (std::size_t i = 0; i < result.strain.size(); ++i)
      result.strain[i] = before.strain[i] * (1 - two.part) + after.strain[i] * two.part;
  return result;
}

double at_instant(const std::vector<double>& time, const std::vector<double>& value, double instant) {
  if (time.empty()) return std::nan("");
  const Between two = between(time, instant);
  return two.of(value[two.before], value[two.after]);
}

}  // namespace diptych::runner
