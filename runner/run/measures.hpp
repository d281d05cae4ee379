// What is measured in the same way for bars and plates.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hinge/scene/scene.hpp"
#include "hinge/step/record.hpp"
#include "reports/results.hpp"
#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"

namespace diptych::runner {

/// What a run keeps of its books: at least so much, and their sums where a gate or a table asks for
/// something of them.
Books books_of(const Case&, const Leaf&, Books least);

/// Whether a quantity takes runs of its own beside the one that it is of.
bool takes_runs(const std::string& quantity);

/// Whether some gate judges this quantity, which takes runs of its own, of this run. Throws std::logic_error where it
/// takes none: it is then measured of every run, or runs of several cases would be taken for the same, see sharing.hpp.
bool asks_for(const Case&, const Leaf&, const std::string& quantity);

std::string status_of(Outcome);

/// What a solver says of its own run.
template <class Record>
void take_outcome(const Record& record, reports::Run& run) {
  run.status = status_of(record.outcome);
  run.message = record.message;
  run.steps = record.steps;
  run.element_steps = record.work.element_steps;
  run.particle_steps = record.work.particle_steps;
  run.node_steps = record.work.node_steps;
  run.bytes = record.work.bytes;
  run.features = record.features;
}

/// Energies as parts of the largest energy, momentum as a part of what the mass [kg] with that energy could have; and
/// the lines, where they were kept.
void measure_ledger(double mass, const LedgerSums&, const std::vector<LedgerLine>&, reports::Run&);

/// Largest Courant number, to one part in a thousand, at which runs stay bounded. The bracket opens around the
/// predicted limit until one end is stable and the other is not, and closes without looking at the prediction again.
/// NaN where no such bracket is found.
double bisect_limit(const std::function<bool(double courant)>& stable, double predicted);

/// Why a completed run cannot be judged, or nothing: `active` features that are not the `declared`, sample times not
/// reached, numbers that are not finite, norms out of order.
std::string why_invalid(const Case&, const std::vector<std::string>& active, const std::vector<std::string>& declared,
                        const reports::Run&);

}  // namespace diptych::runner
