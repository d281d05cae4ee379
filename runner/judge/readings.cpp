#include "runner/judge/readings.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "analytic/discrete.hpp"
#include "runner/compare/quantities.hpp"
#include "runner/input/build.hpp"
#include "runner/judge/judging.hpp"

namespace diptych::runner {
namespace {

using reports::Run;

bool wanted(const GateSpec& gate, double time) {
  return gate.times.empty() || std::find(gate.times.begin(), gate.times.end(), time) != gate.times.end();
}

/// Leading-order theory of a step: asked for by name, beside the run's own prediction.
std::optional<double> airy(const Case& c, const JudgedRun& judged, const reports::FieldError& error,
                           const ErrorNorm& norm) {
  const auto exact = make_exact(with_parameters(c, judged.leaf), judged.leaf);
  const double time = error.time * time_unit(c, c.time_unit);
  const auto scheme = discretisation(c, judged.leaf, judged.run->courant);
  if (!scheme) return {};
  auto predicted = analytic::airy_step_error(*exact, *scheme, norm.of(), norm.as(), time);
  if (predicted) *predicted /= error.scale;
  return predicted;
}

void read_error(const Case& c, const GateSpec& gate, const JudgedRun& judged, const std::string& theory,
                std::vector<Reading>& readings) {
  const ErrorNorm norm(gate.quantity);
  for (const auto& sample : judged.run->samples) {
    if (!wanted(gate, sample.asked)) continue;
    for (const auto& error : sample.errors) {
      if (error.field != norm.field) continue;
      const bool l1 = norm.norm == "L1", l2 = norm.norm == "L2";
      auto predicted = l1 ? error.predicted_l1 : l2 ? error.predicted_l2 : error.predicted_linf;
      if (theory == "airy-step") predicted = airy(c, judged, error, norm);
      readings.push_back({&judged, sample.asked,
                          l1   ? error.l1
                          : l2 ? error.l2
                               : error.linf,
                          predicted, fmt::format("{}, t = {:g} {}", judged.run->label(), sample.asked, c.time_unit)});
    }
  }
}

void add_probe_readings(const Case& c, const GateSpec& gate, const JudgedRun& judged, std::vector<Reading>& readings) {
  const std::string id = gate.quantity.substr(gate.quantity.find('.') + 1);
  for (const auto& sample : judged.run->samples) {
    if (!wanted(gate, sample.asked)) continue;
    for (const auto& probe : sample.probes)
      if (probe.id == id)
        readings.push_back({&judged, sample.asked, probe.value, probe.predicted,
                            fmt::format("{}, t = {:g} {}", judged.run->label(), sample.asked, c.time_unit)});
  }
}

void read_measure(const GateSpec& gate, const JudgedRun& judged, const std::string& theory,
                  std::vector<Reading>& readings) {
  const Run& run = *judged.run;
  const auto value = run.measures.find(gate.quantity);
  if (value == run.measures.end()) return;
  const bool of_solid = theory == "plate-impact" || theory == "diffusion-front";
  const auto predicted = run.measures.find(gate.quantity + (of_solid ? ".exact" : ".predicted"));
  readings.push_back({&judged, std::nan(""), value->second,
                      predicted == run.measures.end() ? std::nullopt : std::optional(predicted->second), run.label()});
}

}  // namespace

ErrorNorm::ErrorNorm(const std::string& quantity)
    : field(quantity.substr(0, quantity.find('.'))), norm(quantity.substr(quantity.find('.') + 1)) {}

analytic::BarQuantity ErrorNorm::of() const {
  return field == "stress"     ? analytic::BarQuantity::stress
         : field == "velocity" ? analytic::BarQuantity::velocity
                               : analytic::BarQuantity::displacement;
}

analytic::Norm ErrorNorm::as() const {
  return norm == "L1" ? analytic::Norm::l1 : norm == "L2" ? analytic::Norm::l2 : analytic::Norm::linf;
}

std::vector<Reading> read(const Case& c, const GateSpec& gate, const std::vector<JudgedRun>& runs,
                          const std::string& theory) {
  const Quantity* quantity = find_quantity(gate.quantity, c);
  const bool norm = quantity && quantity->sort == Quantity::Sort::error_norm;
  const bool probe = quantity && quantity->sort == Quantity::Sort::probe;
  const std::size_t planned = norm || probe ? (gate.times.empty() ? c.times.size() : gate.times.size()) : 1;
  std::vector<Reading> readings;
  for (const JudgedRun& judged : runs) {
    check_judgeable(*judged.run);
    const std::size_t before = readings.size();
    if (norm)
      read_error(c, gate, judged, theory, readings);
    else if (probe)
      add_probe_readings(c, gate, judged, readings);
    else
      read_measure(gate, judged, theory, readings);
    if (readings.size() - before != planned)
      not_judged(fmt::format("{} gave {} of {} values of {}", judged.run->label(), readings.size() - before, planned,
                             gate.quantity));
  }
  if (readings.empty()) not_judged("no run matches where");
  for (const Reading& r : readings)
    if (!std::isfinite(r.value)) not_judged(fmt::format("{}: {} is {}", r.what, gate.quantity, r.value));
  return readings;
}

}  // namespace diptych::runner
