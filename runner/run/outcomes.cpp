#include "runner/run/outcomes.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "runner/input/build.hpp"

namespace diptych::runner {
namespace {

using analytic::BarQuantity;

/// Mean over the bar of a field given at points, each of which stands for what is nearest to it: the mass of FEM's
/// lumped nodes and of particles.
double mean_at_points(const Field& field, const Span& bar) {
  double sum = 0;
  for (std::size_t i = 0; i < field.x.size(); ++i) {
    const double from = i == 0 ? bar.begin : (field.x[i - 1] + field.x[i]) / 2;
    const double to = i + 1 == field.x.size() ? bar.end : (field.x[i] + field.x[i + 1]) / 2;
    sum += (to - from) * field.value[i];
  }
  return sum / (bar.end - bar.begin);
}

}  // namespace

void measure_outcomes(const Scene& scene, const std::vector<Span>& bars, const Record& record, double time_step,
                      const analytic::ExactSolution* exact, reports::Run& run) {
  const auto contacts = exact ? exact->contact_times() : std::nullopt;
  const auto note_outcome = [&](const std::string& name, double value, std::optional<double> predicted, double scale) {
    if (!std::isfinite(value)) return;
    run.measures[name] = value;
    if (!predicted || !std::isfinite(*predicted)) return;
    run.measures[name + ".predicted"] = *predicted;
    run.measures[name + ".error"] = std::abs(value - *predicted) / scale;
  };
  if (!record.touches.empty()) {
    const std::size_t pair = record.touches.front().left;
    double begin = record.touches.front().from, end = begin;
    for (const Touch& touch : record.touches)
      if (touch.left == pair) end = touch.to;
    std::optional<double> exact_begin, exact_end;
    if (contacts) {
      for (const auto& contact : *contacts) {
        if (contact.left != pair) continue;
        if (!exact_begin) exact_begin = contact.from;
        exact_end = contact.to;
      }
    }
    std::optional<double> exact_duration;
    if (exact_begin) exact_duration = *exact_end - *exact_begin;
    const double scale = exact_duration ? *exact_duration : 1;
    note_outcome("contact.begin", begin, exact_begin, scale);
    note_outcome("contact.end", end, exact_end, scale);
    note_outcome("contact.duration", end - begin, exact_duration, scale);
  }
  if (scene.bars.size() == 2 && !record.snapshots.empty()) {
    const Field& v = record.snapshots.back().velocity;
    std::array<double, 2> start{}, now{};
    std::array<double, 2> exact_now{};
    for (std::size_t b = 0; b < 2; ++b) {
      const Bar& bar = scene.bars[b];
      start[b] = bar.initial_velocity ? bar.initial_velocity(bar.begin + bar.length / 2) : 0;
      now[b] = mean_at_points(v.of_bar(b), bars[b]);
      if (contacts) exact_now[b] = mean_between_fronts(*exact, BarQuantity::velocity, bars[b], v.time);
    }
    const double closing = start[0] - start[1];
    if (closing > 0) {
      std::optional<double> predicted;
      if (contacts) predicted = (exact_now[1] - exact_now[0]) / closing;
      note_outcome("contact.restitution", (now[1] - now[0]) / closing, predicted, 1);
    }
  }
  if (record.sums.lines > 0 && record.sums.last.dissipated > 0) {
    // The ledger's last line holds what was dissipated before the last step.
    const double time = record.time - time_step, last = std::max(time, 0.0);
    const auto predicted = exact ? exact->work_of_flow(last) : std::nullopt;
    note_outcome("plastic.work", record.sums.last.dissipated, predicted, predicted && *predicted > 0 ? *predicted : 1);
  }
}

}  // namespace diptych::runner
