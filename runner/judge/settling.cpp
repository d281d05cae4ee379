#include "runner/judge/settling.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "runner/compare/quantities.hpp"
#include "runner/input/case_checks.hpp"
#include "runner/input/case_tables.hpp"
#include "runner/input/toml_table.hpp"
#include "runner/judge/bound.hpp"
#include "runner/judge/judging.hpp"
#include "runner/judge/series.hpp"

namespace diptych::runner {
namespace {

using reports::Run;
using Sort = Quantity::Sort;

// ---- the keys -------------------------------------------------------------------------------------------------------

Names quantities_of_settling(const Case& c) { return quantity_names(c, {Sort::probe, Sort::history}); }

/// One or two methods, each otherwise alike on four meshes or more.
void check_runs_of_settling(const Place& place, bool of_probe, const GateSpec& gate, const Case& c) {
  std::map<std::string, std::set<int>> meshes;
  std::map<std::string, std::set<std::string>> otherwise;
  for (const Leaf& run : runs_of(gate, c)) {
    meshes[run.method].insert(run.cells);
    otherwise[run.method].insert("courant = " + words(run.courant) +
                                 (run.particles.empty() ? "" : ", particles = " + words(run.particles)) +
                                 (parameters_label(run).empty() ? "" : ", " + parameters_label(run)));
  }
  if (meshes.size() > 2) place.say(fmt::format("found {} methods; allowed: one or two", meshes.size()));
  for (const auto& [method, runs] : otherwise)
    if (runs.size() > 1)
      place.say(fmt::format("found runs of {} that differ in more than the mesh ({}); allowed: one of them, in where",
                            method, listed(runs, "; ")));
  for (const auto& [method, cells] : meshes)
    if (cells.size() < 4 && !of_probe)
      place.say(fmt::format("found {} meshes of {}; allowed: at least 4", cells.size(), method));
}

void read_settling(Table& t, const Case& c, GateSpec& gate) {
  SettlingCriterion limit;
  const bool of_probe = gate.quantity.starts_with("probe.");  // which tells its meshes itself
  limit.max = read_tolerance(t, "max", 1, "all of what changes");
  if (of_probe) {
    limit.judged = t.need("judged", set_of(number_of_cells()));
    among(t.place("judged"), limit.judged, all_axes(c).cells, "axes.cells");
    if (limit.judged.size() < 2 && !c.axes.empty())
      t.place("judged").refuse(listed(limit.judged), "two meshes or more, for what changes between them");
  }
  if (!c.axes.empty()) check_runs_of_settling(t.place("where"), of_probe, gate, c);
  gate.criterion = std::make_shared<SettlingCriterion>(limit);
}

// ---- the judging ----------------------------------------------------------------------------------------------------

/// Per method and time: what the values on the judged meshes span, of the last one. No trend hides in that.
void judge_probe(const Case& c, const GateSpec& gate, const SettlingCriterion& limit,
                 std::map<std::string, Series>& methods, reports::Gate& result) {
  const std::string id = gate.quantity.substr(gate.quantity.find('.') + 1);
  result.formula = fmt::format("what {} spans on {} cells, of its value on the last ≤ {:g}", gate.quantity,
                               listed(limit.judged), limit.max);
  for (auto& [method, series] : methods) {
    std::erase_if(series, [&](const Run* run) {
      return std::find(limit.judged.begin(), limit.judged.end(), run->cells) == limit.judged.end();
    });
    if (series.size() != limit.judged.size())
      not_judged(fmt::format("{}: {} of {} meshes to judge were run", method, series.size(), limit.judged.size()));
    for (const double time : gate.times.empty() ? c.times : gate.times) {
      std::vector<double> values;
      std::vector<std::string> shown;
      for (const Run* run : series) {
        values.push_back(probe_of(*run, time, id));
        shown.push_back(fmt::format("{:.4g}", values.back()));
        if (!std::isfinite(values.back())) not_judged(fmt::format("{}: {} is not finite", run->label(), gate.quantity));
      }
      const auto [least, most] = std::minmax_element(values.begin(), values.end());
      if (*least == *most) not_judged(fmt::format("{}, t = {:g} s: the same number on every mesh", method, time));
      const double span = *most - *least, last = std::abs(values.back());
      hold(result, {fmt::format("{}, t = {:g} s: {}", method, time, listed(shown)), span, last, -limit.max, limit.max,
                    span / last, false});
    }
  }
}

}  // namespace

void SettlingCriterion::judge(const Case& c, const GateSpec& gate, const std::vector<JudgedRun>& runs,
                              reports::Gate& result) const {
  std::map<std::string, Series> methods = by_method(runs);
  if (methods.empty() || methods.size() > 2) not_judged(fmt::format("{} methods; one or two settle", methods.size()));
  if (gate.quantity.starts_with("probe.")) {
    judge_probe(c, gate, *this, methods, result);
    return;
  }
  const auto both = methods.size() == 2 ? both_methods(runs, levels_for_uncertainty) : std::array<Series, 2>{};
  result.formula =
      fmt::format("Sprague–Geers distance of {} between successive meshes{}: each at most {:g} of the one before",
                  gate.quantity, methods.size() == 2 ? ", and between the methods" : "", max);
  const auto distance = [&](const Run& a, const Run& b) {
    return sprague_geers(history_of(a, gate.quantity), history_of(b, gate.quantity)).combined;
  };
  const auto falls = [&](const std::string& what, const std::vector<double>& distances) {
    for (const double one : distances) {
      if (!std::isfinite(one)) not_judged(what + ": a history vanishes");
      if (one <= 1e-12) not_judged(what + ": two histories are the same");
    }
    for (std::size_t k = 0; k + 1 < distances.size(); ++k) {
      hold(result, {fmt::format("{}: {:.3g} after {:.3g}", what, distances[k + 1], distances[k]), distances[k + 1],
                    distances[k], 0, max, distances[k + 1] / distances[k], false});
    }
  };
  for (const auto& [method, series] : methods) {
    if (series.size() < 4) not_judged(fmt::format("{}: {} meshes, at least 4 are needed", method, series.size()));
    std::vector<double> between;
    for (std::size_t k = 0; k + 1 < series.size(); ++k)
      if (series[k]->cells == series[k + 1]->cells) not_judged("two runs of a method on one mesh");
    for (std::size_t k = 0; k + 1 < series.size(); ++k) between.push_back(distance(*series[k], *series[k + 1]));
    falls(method, between);
  }
  if (methods.size() < 2) return;
  std::vector<double> apart;
  for (std::size_t k = 0; k < both[0].size(); ++k) apart.push_back(distance(*both[1][k], *both[0][k]));
  falls(both[0][0]->method + " and " + both[1][0]->method, apart);
}

GateKind settling_gate() {
  return {.id = "settling",
          .says = "what is read changes little, or less and less, from mesh to mesh",
          .scenes = GateKind::Scenes::plates,
          .keys = {{"times", {"probe."}}, {"max"}, {"judged", {"probe."}}},
          .quantities = quantities_of_settling,
          .read = read_settling};
}

}  // namespace diptych::runner
