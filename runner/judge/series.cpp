#include "runner/judge/series.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "runner/judge/judging.hpp"

namespace diptych::runner {

using reports::Run;

std::map<std::string, Series> by_method(const std::vector<JudgedRun>& runs) {
  std::map<std::string, Series> all;
  for (const JudgedRun& judged : runs) {
    check_judgeable(*judged.run);
    all[judged.run->method].push_back(judged.run);
  }
  for (auto& [method, series] : all)
    std::sort(series.begin(), series.end(), [](const Run* a, const Run* b) { return a->cells < b->cells; });
  return all;
}

std::array<Series, 2> both_methods(const std::vector<JudgedRun>& runs, std::size_t least) {
  const std::map<std::string, Series> all = by_method(runs);
  if (all.size() != 2) not_judged(fmt::format("{} methods; two are compared", all.size()));
  std::array<Series, 2> both{all.begin()->second, std::next(all.begin())->second};
  const auto meshes = [](const Series& series) {
    std::vector<int> cells;
    for (const Run* run : series) cells.push_back(run->cells);
    return cells;
  };
  if (meshes(both[0]) != meshes(both[1])) not_judged("the methods were not run on the same meshes");
  const auto cells = meshes(both[0]);
  if (cells.size() < least) not_judged(fmt::format("{} meshes, at least {} are needed", cells.size(), least));
  if (std::adjacent_find(cells.begin(), cells.end()) != cells.end()) not_judged("two runs of a method on one mesh");
  return both;
}

const reports::Sample& sample_at(const Run& run, double time) {
  for (const auto& sample : run.samples)
    if (sample.asked == time) return sample;
  not_judged(fmt::format("{} has no sample at {:g}", run.label(), time));
}

double probe_of(const Run& run, double time, const std::string& id) {
  for (const auto& probe : sample_at(run, time).probes)
    if (probe.id == id) return probe.value;
  not_judged(run.label() + " has no probe " + id);
}

/// "platen.history" or "gauge.ID.xx", ".yy" or ".dilatancy".
History history_of(const Run& run, const std::string& quantity) {
  History history{run.platen.x, run.platen.y};
  if (quantity.starts_with("gauge.")) {
    const auto dot = quantity.rfind('.');
    const std::string id = quantity.substr(6, dot - 6), component = quantity.substr(dot + 1);
    history = {};
    for (const auto& gauge : run.gauges)
      if (gauge.id == id)
        history = {gauge.time, component == "xx" ? gauge.xx : component == "yy" ? gauge.yy : gauge.dilatancy};
  }
  if (history.value.empty()) not_judged(run.label() + " has no " + quantity);
  for (const double value : history.value)
    if (!std::isfinite(value)) not_judged(run.label() + ": " + quantity + " is not a finite number");
  return history;
}

}  // namespace diptych::runner
