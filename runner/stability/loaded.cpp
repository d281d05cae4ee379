#include "runner/stability/loaded.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "runner/input/messages.hpp"
#include "runner/run/built.hpp"
#include "runner/run/run_leaf.hpp"
#include "runner/stability/at_rest.hpp"
#include "runner/stability/growth.hpp"
#include "runner/trade/errors.hpp"

namespace diptych::runner {
namespace {

// ---- the scene with a little noise on it ----

Scene seeded(const Scene& scene) {
  Scene out = scene;
  for (Bar& bar : out.bars) {
    bar.initial_velocity = [own = bar.initial_velocity, speed = seed * material::wave_speed(bar.material)](double x) {
      return (own ? own(x) : 0) + speed * noise_at(x, 0, 0);
    };
  }
  return out;
}

Plate seeded(const Plate& plate) {
  if (plate.impact)
    throw std::invalid_argument("a flyer gives the initial velocity, which noise has no place beside (with [flyer])");
  Plate out = plate;
  out.initial_velocity = [own = plate.initial_velocity, speed = seed * elastic(plate).pressure_wave_speed()](double x,
                                                                                                             double y) {
    const Vector v = own ? own(x, y) : Vector{};
    return Vector{v[0] + speed * noise_at(x, y, 0), v[1] + speed * noise_at(x, y, 1)};
  };
  return out;
}

// ---- what is followed ----

double squared_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

/// As a kinetic energy goes: of the velocities by which the two differ.
double difference_of_motion(const Snapshot& a, const Snapshot& b) {
  return squared_difference(a.velocity.value, b.velocity.value);
}
double difference_of_motion(const PlateSnapshot& a, const PlateSnapshot& b) {
  double sum = 0;
  for (std::size_t k = 0; k < std::min(a.velocity.component.size(), b.velocity.component.size()); ++k)
    sum += squared_difference(a.velocity.component[k], b.velocity.component[k]);
  return sum;
}

/// Where the points of one bar are no longer in their order; nothing where they are.
std::optional<double> turned_inside_out(const Scene& scene, const Snapshot& s) {
  if (!scene.convected) return {};  // displacements are infinitesimal, whatever their numbers
  for (std::size_t bar = 0; bar < scene.bars.size(); ++bar) {
    const Field u = s.displacement.of_bar(bar);
    for (std::size_t i = 1; i < u.x.size(); ++i)
      if (!(u.x[i] + u.value[i] > u.x[i - 1] + u.value[i - 1])) return u.x[i];
  }
  return {};
}
std::optional<double> turned_inside_out(const Plate&, const PlateSnapshot&) { return {}; }

template <class S, class M, class R>
LoadedRun looked_at(const LeafScene<S, M, R>& it, std::optional<long> steps, const std::atomic<bool>* cancelled) {
  constexpr long samples = 400, least = 20;
  Stepping stepping;
  stepping.time_step = it.asked_time_step();
  const double limit = it.limit();
  if (std::isfinite(limit)) stepping.limit = limit;
  stepping.steps = steps ? *steps : std::max(least, std::lround(std::ceil(it.instants().back() / stepping.time_step)));
  stepping.cancelled = cancelled;
  const long stride = std::max(1L, stepping.steps / samples);
  for (long step = 0; step <= stepping.steps; step += stride) stepping.sample_after.push_back(step);
  const R plain = it.solver.run(it.scene, it.mesh, stepping);
  LoadedRun found;
  if (plain.outcome == Outcome::cancelled) return found;
  for (const auto& snapshot : plain.snapshots) {
    if (const auto x = turned_inside_out(it.scene, snapshot)) {
      found.why = fmt::format("invalid: turned inside out at x = {:g}, after step {}", *x, snapshot.step);
      return found;
    }
  }
  if (plain.outcome == Outcome::left_grid) {
    found.why = "invalid: " + plain.message;
    return found;
  }
  const R other = it.solver.run(seeded(it.scene), it.mesh, stepping);
  std::vector<double> differences;
  for (std::size_t k = 0; k < std::min(plain.snapshots.size(), other.snapshots.size()); ++k)
    differences.push_back(difference_of_motion(plain.snapshots[k], other.snapshots[k]));
  std::erase_if(differences, [](double one) { return !std::isfinite(one); });
  const Growth growth = growth_of(differences, stride, stepping.steps);
  found.rate = growth.rate;
  for (const R* record : {&plain, &other}) {
    if (record->outcome == Outcome::completed) continue;
    found.why = record->message;
    return found;
  }
  // Particles that cross cells part from each other at any step, and what they hold keeps its bound all the same.
  const bool crosses = it.row.particles && it.scene.convected;
  found.stable = crosses || !growth.unstable;
  if (!found.stable) found.why = "small differences grow";
  return found;
}

LoadedRun looked_at(const DiffusionLeaf&, std::optional<long>, const std::atomic<bool>*) {
  throw InputError("a scene of diffusion alone: found --limit-of; allowed: scenes with [material], which have loads");
}

/// Why the case's own run does not keep below the ceiling; empty: it does.
std::string above(const Case& c, const Leaf& leaf, const Ceiling& ceiling, const std::atomic<bool>* cancelled) {
  Running running;
  running.cancelled = cancelled;
  const reports::Run run = run_leaf(c, leaf, running);
  if (run.status != "completed") return run.status + ": " + run.message;
  bool known = false;
  for (const RunNumber& one : numbers_of(c, run)) {
    if (one.quantity != ceiling.quantity) continue;
    known = true;
    if (!(one.value <= ceiling.most)) return fmt::format("{} = {:g}", one.quantity, one.value);
  }
  if (!known) throw std::runtime_error(run.label() + ": no " + ceiling.quantity + " came of it");
  return {};
}

}  // namespace

LoadedRun run_loaded(const Case& c, const Leaf& leaf, std::optional<long> steps, const std::optional<Ceiling>& ceiling,
                     const std::atomic<bool>* cancelled) {
  LoadedRun found = built(c, leaf, [&](const auto& it) { return looked_at(it, steps, cancelled); });
  if (!found.stable || !ceiling) return found;
  found.why = above(c, leaf, *ceiling, cancelled);
  found.stable = found.why.empty();
  return found;
}

}  // namespace diptych::runner
