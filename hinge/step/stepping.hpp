// The loop over time steps, the same for every method.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "hinge/scene/scene.hpp"
#include "hinge/step/ledger.hpp"
#include "hinge/step/record.hpp"

namespace diptych {

/// The interval over which forces act on the velocity at one go.
struct Kick {
  double from, to;  ///< [s]
  double length;    ///< [s]
};

/// The kick that takes vⁿ⁻½ to vⁿ⁺½; the first takes v⁰ to v½ and is half as long.
inline Kick kick_around(long n, double time_step) {
  const double time = static_cast<double>(n) * time_step, half = time_step / 2;
  if (n == 0) return {0, half, half};
  return {time - half, time + half, time_step};
}

/// The kick that takes vⁿ to vⁿ⁺¹.
inline Kick kick_after(long n, double time_step) {
  const double time = static_cast<double>(n) * time_step;
  return {time, time + time_step, time_step};
}

/// True if every value is finite.
inline bool finite(const Snapshot& s) {
  const auto all_finite = [](const Field& f) {
    return std::all_of(f.value.begin(), f.value.end(), [](double v) { return std::isfinite(v); });
  };
  return all_finite(s.stress) && all_finite(s.velocity) && all_finite(s.displacement);
}

/// Takes the steps of a run with any method's body, samples it and keeps its ledger. A sample wanted of the step after
/// the last one, where a leapfrog field of the end is between two of its own times, is taken when everything else of
/// the run has been handed over: that step leaves no other trace.
template <class Result = Record, class Body>
Result take_steps(Body& body, const Stepping& stepping) {
  Result record;
  Ledger ledger(stepping.books, stepping.time_step, body.first_ledger_time(), body.energy(), body.momentum(),
                body.free_mass(),
                {stepping.gains, stepping.limit > 0 ? stepping.time_step / stepping.limit : 0, body.gives_back()});
  auto next = stepping.sample_after.begin();
  const auto sample_after = [&](long steps) {
    if (next == stepping.sample_after.end() || *next != steps) return;
    record.snapshots.push_back(body.sample(steps));
    ++next;
    if (finite(record.snapshots.back())) return;
    record.outcome = Outcome::unstable;
    record.message = "a sampled value is not finite, at step " + std::to_string(steps);
  };
  sample_after(0);
  for (long n = 0; n < stepping.steps && record.outcome == Outcome::completed; ++n) {
    if (stepping.cancelled && *stepping.cancelled) {
      record.outcome = Outcome::cancelled;
      record.message = "stopped on request";
      break;
    }
    ledger.begin_step(n, n + 1 == stepping.steps);
    body.step(n, ledger);
    record.steps = n + 1;
    if (!body.trouble().empty()) {
      record.outcome = Outcome::left_grid;
      record.message = body.trouble();
      break;
    }
    if (ledger.due() && ledger.unstable()) {
      record.outcome = Outcome::unstable;
      record.message = ledger.trouble(Result::energy_unit) + ", at step " + std::to_string(n + 1);
      break;
    }
    sample_after(n + 1);
  }
  record.time = static_cast<double>(record.steps) * stepping.time_step;
  record.sums = ledger.sums();
  record.ledger = ledger.take_lines();
  record.features = body.features();
  record.work = body.work(record.steps);
  body.complete(record);
  if (record.outcome == Outcome::completed && next != stepping.sample_after.end()) {
    Ledger none(Books::off, stepping.time_step, 0, 0, 0, 0);
    none.begin_step(1);
    body.step(stepping.steps, none);
    if (body.trouble().empty()) sample_after(stepping.steps + 1);
  }
  return record;
}

}  // namespace diptych
