// The loop over time steps, the same for every method.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "material/ledger.hpp"
#include "material/record.hpp"
#include "material/scene.hpp"

namespace diptych {

/// True if every value is finite.
inline bool finite(const Snapshot& s) {
  const auto all_finite = [](const Field& f) {
    return std::all_of(f.value.begin(), f.value.end(), [](double v) { return std::isfinite(v); });
  };
  return all_finite(s.stress) && all_finite(s.velocity) && all_finite(s.displacement);
}

/// Takes the steps of a run with any method's body, samples it and keeps its ledger.
template <class Body>
Record take_steps(Body& body, const Stepping& stepping) {
  Record record;
  Ledger ledger(stepping.time_step, body.first_ledger_time(), body.energy(), body.momentum());
  auto next = stepping.sample_after.begin();
  for (long n = 0; n < stepping.steps; ++n) {
    if (stepping.cancelled && *stepping.cancelled) {
      record.outcome = Outcome::cancelled;
      record.message = "stopped on request";
      break;
    }
    body.step(n, stepping.ledger ? &ledger : nullptr);
    record.steps = n + 1;
    if (!body.trouble().empty()) {
      record.outcome = Outcome::left_grid;
      record.message = body.trouble();
      break;
    }
    if (stepping.ledger && ledger.unstable()) {
      record.outcome = Outcome::unstable;
      record.message = "energy grew beyond anything the loads put in, at step " + std::to_string(n + 1);
      break;
    }
    if (next != stepping.sample_after.end() && *next == n + 1) {
      record.snapshots.push_back(body.sample(n + 1));
      ++next;
      if (!finite(record.snapshots.back())) {
        record.outcome = Outcome::unstable;
        record.message = "a sampled value is not finite, at step " + std::to_string(n + 1);
        break;
      }
    }
  }
  record.time = static_cast<double>(record.steps) * stepping.time_step;
  record.ledger = ledger.take();
  record.work = body.work(record.steps);
  return record;
}

}  // namespace diptych
