#include "runner/judge/agreement.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <set>

#include "runner/compare/contours.hpp"
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

Names quantities_of_agreement(const Case& c) { return quantity_names(c, {Sort::probe, Sort::distance, Sort::history}); }

/// Two methods, otherwise alike, on the same four meshes or more.
void check_runs_of_agreement(const Place& place, bool uncertain, const GateSpec& gate, const Case& c) {
  std::map<std::string, std::set<int>> meshes;
  std::set<std::string> otherwise;
  for (const Leaf& run : runs_of(gate, c)) {
    meshes[run.method].insert(run.cells);
    otherwise.insert("courant = " + words(run.courant) +
                     (parameters_label(run).empty() ? "" : ", " + parameters_label(run)));
  }
  if (otherwise.size() > 1)
    place.say(fmt::format("found runs that differ in more than method and mesh ({}); allowed: one of them, in where",
                          listed(otherwise, "; ")));
  if (meshes.size() != 2)
    place.say(fmt::format("found {} methods; allowed: two, fem and one of MPM", meshes.size()));
  else if (meshes.begin()->second != std::next(meshes.begin())->second)
    place.say("found other meshes for each method; allowed: the same");
  else if (uncertain && meshes.begin()->second.size() < 4)
    place.say(fmt::format("found {} meshes; allowed: at least 4, on which the uncertainties are found",
                          meshes.begin()->second.size()));
}

void read_agreement(Table& t, const Case& c, GateSpec& gate) {
  AgreementCriterion agreement;
  if (t.has("max") || !t.has("apart")) agreement.max = read_tolerance(t, "max", 10, "ten times the uncertainty");
  agreement.judged = t.need("judged", set_of(number_of_cells()));
  among(t.place("judged"), agreement.judged, all_axes(c).cells, "axes.cells");
  agreement.apart = t.get("apart", list_of(positive()));
  if (!agreement.apart.empty() && agreement.apart.size() != agreement.judged.size())
    t.place("apart").refuse(words(agreement.apart), "one part for each mesh of judged, " + listed(agreement.judged));
  for (const double part : agreement.apart)
    if (part > 1) t.place("apart").refuse(words(part), "parts of what is compared, at most 1");
  agreement.shrinks = t.get("shrinks", flag(), true);
  if (t.applies("level", "quantity", gate.quantity, {"contour.distance"}))
    agreement.level = t.need("level", positive());
  if (!c.axes.empty()) check_runs_of_agreement(t.place("where"), agreement.max.has_value(), gate, c);
  gate.criterion = std::make_shared<AgreementCriterion>(agreement);
}

// ---- the judging ----------------------------------------------------------------------------------------------------

NodalMap crack_density_of(const Run& run, double time) {
  const auto& sample = sample_at(run, time);
  if (!sample.plate) not_judged(run.label() + " has no damage");
  return map_of(*sample.plate, "crack-density");
}

std::vector<double> sizes_of(const Series& series) {
  std::vector<double> sizes;
  for (const Run* run : series) sizes.push_back(run->cell_size);
  return sizes;
}

/// Of one mesh.
struct Apart {
  std::array<double, 2> values{};  ///< of each method; NaN where what is compared is no single number
  double difference = 0;
  double band = 0;  ///< within which that is expected: the root of the sum of the squares of both uncertainties
  double size = 0;  ///< of what is compared, in its unit
};
using Meshes = std::vector<Apart>;

Meshes of_values(const std::array<Series, 2>& both, const std::function<double(const Run&)>& value) {
  std::array<std::vector<double>, 2> values;
  std::array<Uncertainty, 2> uncertainty;
  for (std::size_t m = 0; m < 2; ++m) {
    for (const Run* run : both[m]) {
      values[m].push_back(value(*run));
      if (!std::isfinite(values[m].back()))
        not_judged(run->label() +
                   ": the quantity is not a finite number: the contour does not reach there, or the run has none");
    }
    if (values[m].size() >= levels_for_uncertainty)
      uncertainty[m] = discretisation_uncertainty(sizes_of(both[m]), values[m]);
    else
      uncertainty[m].band.assign(values[m].size(), std::numeric_limits<double>::quiet_NaN());
  }
  Meshes meshes;
  for (std::size_t k = 0; k < both[0].size(); ++k) {
    const double a = values[0][k], b = values[1][k];
    meshes.push_back({{a, b},
                      std::abs(a - b),
                      std::hypot(uncertainty[0].of(k), uncertainty[1].of(k)),
                      (std::abs(a) + std::abs(b)) / 2});
  }
  return meshes;
}

/// The band is the largest of 19 radii, and the least radius is the size.
Meshes of_contours(const std::array<Series, 2>& both, double time, double level) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN(), any = std::numeric_limits<double>::infinity();
  Meshes meshes(both[0].size(), {{none, none}, 0, 0, any});
  for (int angle = 0; angle <= 90; angle += 5) {
    const auto radii =
        of_values(both, [&](const Run& run) { return radius_along(crack_density_of(run, time), level, angle); });
    for (std::size_t k = 0; k < meshes.size(); ++k) {
      meshes[k].band = std::max(meshes[k].band, radii[k].band);
      meshes[k].size = std::min(meshes[k].size, radii[k].size);
    }
  }
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const auto lines = [&](std::size_t m) { return contour(crack_density_of(*both[m][k], time), level); };
    meshes[k].difference = hausdorff(lines(0), lines(1));
  }
  return meshes;
}

/// Distances of histories are parts of them: their size is 1.
Meshes of_histories(const std::array<Series, 2>& both, const std::string& quantity) {
  const auto history = [&](const Run& run) { return history_of(run, quantity); };
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Meshes meshes;
  const std::size_t finest = both[0].size() - 1;
  for (std::size_t k = 0; k <= finest; ++k) {
    std::array<double, 2> own{};
    for (std::size_t m = 0; m < 2; ++m)
      own[m] = sprague_geers(history(*both[m][std::min(k, finest - 1)]), history(*both[m][finest])).combined;
    meshes.push_back({{none, none},
                      sprague_geers(history(*both[1][k]), history(*both[0][k])).combined,
                      std::hypot(own[0], own[1]),
                      1});
  }
  return meshes;
}

/// A band that is a good part of the value itself expects anything.
constexpr double widest_band = 0.25;

void judge_meshes(const std::array<Series, 2>& both, const Meshes& meshes, const AgreementCriterion& gate, double time,
                  const std::string& when, reports::Gate& result) {
  std::vector<double> judged;
  for (std::size_t k = 0; k < both[0].size(); ++k) {
    const Apart& one = meshes[k];
    const int cells = both[0][k]->cells;
    const auto named = std::find(gate.judged.begin(), gate.judged.end(), cells);
    if (named == gate.judged.end()) continue;
    const std::string where = fmt::format("{} cells{}", cells, when);
    if (gate.max && !(one.band > 0)) not_judged(where + ": no uncertainty to compare with");
    if (gate.max && !(one.band <= widest_band * one.size))
      not_judged(
          fmt::format("{}: the uncertainty {:.3g} is {:.0f} % of the value {:.3g}, more than {:.0f} %: nothing is "
                      "judged by it",
                      where, one.band, 100 * one.band / one.size, one.size, 100 * widest_band));
    if (!(one.difference > 1e-12 * (gate.max ? one.band : one.size)))
      not_judged(where +
                 ": the two methods give the same number: one of them twice, or a bound that both have reached?");
    result.agreements.push_back({cells, time, one.values, one.difference, one.band, one.size});
    if (gate.max)
      hold(result, {fmt::format("{}: {:.3g} apart, expected within {:.3g}", where, one.difference, one.band),
                    one.difference, one.band, -*gate.max, *gate.max, one.difference / one.band, false});
    if (!gate.apart.empty()) {
      const double limit = gate.apart[static_cast<std::size_t>(named - gate.judged.begin())];
      hold(result, {fmt::format("{}: {:.2g} % apart", where, 100 * one.difference / one.size), one.difference, one.size,
                    -limit, limit, one.difference / one.size, false});
    }
    judged.push_back(one.difference);
  }
  if (judged.size() != gate.judged.size())
    not_judged(fmt::format("{} of {} meshes to judge were run", judged.size(), gate.judged.size()));
  if (judged.size() < 2 || !gate.shrinks) return;
  hold(result, {fmt::format("finest / coarsest difference{}", when), judged.back(), judged.front(), -1, 1,
                judged.back() / judged.front(), false});
}

}  // namespace

void AgreementCriterion::judge(const Case& c, const GateSpec& gate, const std::vector<JudgedRun>& runs,
                               reports::Gate& result) const {
  const auto both = both_methods(runs, max ? levels_for_uncertainty : 1);
  result.formula = fmt::format("|{} − {}| of {}", both[0][0]->method, both[1][0]->method, gate.quantity);
  if (max) result.formula += fmt::format(" / √(U² + U²) ≤ {:g}", *max);
  if (!apart.empty()) result.formula += fmt::format(", at most {} of the value", listed(apart));
  if (shrinks) result.formula += ", and it shrinks";
  if (gate.quantity == "platen.history" || gate.quantity.starts_with("gauge.")) {
    judge_meshes(both, of_histories(both, gate.quantity), *this, std::nan(""), "", result);
    return;
  }
  for (const double time : gate.times.empty() ? c.times : gate.times) {
    const std::string when = fmt::format(", t = {:g} s", time);
    if (gate.quantity == "contour.distance") {
      judge_meshes(both, of_contours(both, time, level), *this, time, when, result);
    } else {
      const std::string id = gate.quantity.substr(gate.quantity.find('.') + 1);
      judge_meshes(both, of_values(both, [&](const Run& run) { return probe_of(run, time, id); }), *this, time, when,
                   result);
    }
  }
}

GateKind agreement_gate() {
  return {.id = "agreement",
          .says = "two methods differ by no more than the numerical uncertainty of both explains",
          .scenes = GateKind::Scenes::plates,
          .keys = {{"times"}, {"max"}, {"judged"}, {"apart"}, {"shrinks"}, {"level"}},
          .quantities = quantities_of_agreement,
          .read = read_agreement};
}

}  // namespace diptych::runner
