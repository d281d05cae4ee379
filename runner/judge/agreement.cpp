#include "runner/judge/agreement.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "runner/compare/contours.hpp"
#include "runner/compare/uncertainty.hpp"
#include "runner/input/messages.hpp"
#include "runner/judge/judging.hpp"

namespace diptych::runner {
namespace {

using reports::Run;
using reports::Verdict;

/// Runs of one method from the coarsest mesh to the finest.
using Series = std::vector<const Run*>;

[[noreturn]] void invalid(const std::string& why) { throw Stop{Verdict::invalid, why}; }

/// least: number of meshes.
std::array<Series, 2> both_methods(const std::vector<const Run*>& runs, std::size_t least) {
  std::map<std::string, Series> by_method;
  for (const Run* run : runs) {
    check_judgeable(*run);
    by_method[run->method].push_back(run);
  }
  if (by_method.size() != 2) invalid(fmt::format("{} methods; two are compared", by_method.size()));
  std::array<Series, 2> both{by_method.begin()->second, std::next(by_method.begin())->second};
  for (Series& series : both)
    std::sort(series.begin(), series.end(), [](const Run* a, const Run* b) { return a->cells < b->cells; });
  const auto meshes = [](const Series& series) {
    std::vector<int> cells;
    for (const Run* run : series) cells.push_back(run->cells);
    return cells;
  };
  if (meshes(both[0]) != meshes(both[1])) invalid("the methods were not run on the same meshes");
  const auto cells = meshes(both[0]);
  if (cells.size() < least) invalid(fmt::format("{} meshes, at least {} are needed", cells.size(), least));
  if (std::adjacent_find(cells.begin(), cells.end()) != cells.end()) invalid("two runs of a method on one mesh");
  return both;
}

const reports::Sample& sample_at(const Run& run, double time) {
  for (const auto& sample : run.samples)
    if (sample.asked == time) return sample;
  invalid(fmt::format("{} has no sample at {:g}", run.label(), time));
}

double probe_of(const Run& run, double time, const std::string& id) {
  for (const auto& probe : sample_at(run, time).probes)
    if (probe.id == id) return probe.value;
  invalid(run.label() + " has no probe " + id);
}

NodalMap crack_density_of(const Run& run, double time) {
  const auto& sample = sample_at(run, time);
  if (!sample.plate) invalid(run.label() + " has no damage");
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
        invalid(run->label() +
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
  if (history.value.empty()) invalid(run.label() + " has no " + quantity);
  for (const double value : history.value)
    if (!std::isfinite(value)) invalid(run.label() + ": " + quantity + " is not a finite number");
  return history;
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

void judge(const std::array<Series, 2>& both, const Meshes& meshes, const GateSpec& gate, double time,
           const std::string& when, reports::Gate& result) {
  std::vector<double> judged;
  for (std::size_t k = 0; k < both[0].size(); ++k) {
    const Apart& one = meshes[k];
    const int cells = both[0][k]->cells;
    const auto named = std::find(gate.judged.begin(), gate.judged.end(), cells);
    if (named == gate.judged.end()) continue;
    const std::string where = fmt::format("{} cells{}", cells, when);
    if (gate.max && !(one.band > 0)) invalid(where + ": no uncertainty to compare with");
    if (gate.max && !(one.band <= widest_band * one.size))
      invalid(
          fmt::format("{}: the uncertainty {:.3g} is {:.0f} % of the value {:.3g}, more than {:.0f} %: nothing is "
                      "judged by it",
                      where, one.band, 100 * one.band / one.size, one.size, 100 * widest_band));
    if (!(one.difference > 1e-12 * (gate.max ? one.band : one.size)))
      invalid(where + ": the two methods give the same number: one of them twice, or a bound that both have reached?");
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
    invalid(fmt::format("{} of {} meshes to judge were run", judged.size(), gate.judged.size()));
  if (judged.size() < 2 || !gate.shrinks) return;
  hold(result, {fmt::format("finest / coarsest difference{}", when), judged.back(), judged.front(), -1, 1,
                judged.back() / judged.front(), false});
}

/// Per method and time: what the values on the judged meshes span, of the last one. No trend hides in that.
void judge_probe_settling(const Case& c, const GateSpec& gate, std::map<std::string, Series>& by_method,
                          reports::Gate& result) {
  const std::string id = gate.quantity.substr(gate.quantity.find('.') + 1);
  result.formula = fmt::format("what {} spans on {} cells, of its value on the last ≤ {:g}", gate.quantity,
                               listed(gate.judged), *gate.max);
  for (auto& [method, series] : by_method) {
    std::erase_if(series, [&](const Run* run) {
      return std::find(gate.judged.begin(), gate.judged.end(), run->cells) == gate.judged.end();
    });
    std::sort(series.begin(), series.end(), [](const Run* a, const Run* b) { return a->cells < b->cells; });
    if (series.size() != gate.judged.size())
      invalid(fmt::format("{}: {} of {} meshes to judge were run", method, series.size(), gate.judged.size()));
    for (const double time : gate.times.empty() ? c.times : gate.times) {
      std::vector<double> values;
      std::vector<std::string> shown;
      for (const Run* run : series) {
        values.push_back(probe_of(*run, time, id));
        shown.push_back(fmt::format("{:.4g}", values.back()));
        if (!std::isfinite(values.back())) invalid(fmt::format("{}: {} is not finite", run->label(), gate.quantity));
      }
      const auto [least, most] = std::minmax_element(values.begin(), values.end());
      if (*least == *most) invalid(fmt::format("{}, t = {:g} s: the same number on every mesh", method, time));
      const double span = *most - *least, last = std::abs(values.back());
      hold(result, {fmt::format("{}, t = {:g} s: {}", method, time, listed(shown)), span, last, -*gate.max, *gate.max,
                    span / last, false});
    }
  }
}

}  // namespace

void judge_agreement(const Case& c, const GateSpec& gate, const std::vector<const Run*>& runs, reports::Gate& result) {
  const auto both = both_methods(runs, gate.max ? levels_for_uncertainty : 1);
  result.formula = fmt::format("|{} − {}| of {}", both[0][0]->method, both[1][0]->method, gate.quantity);
  if (gate.max) result.formula += fmt::format(" / √(U² + U²) ≤ {:g}", *gate.max);
  if (!gate.apart.empty()) result.formula += fmt::format(", at most {} of the value", listed(gate.apart));
  if (gate.shrinks) result.formula += ", and it shrinks";
  if (gate.quantity == "platen.history" || gate.quantity.starts_with("gauge.")) {
    judge(both, of_histories(both, gate.quantity), gate, std::nan(""), "", result);
    return;
  }
  for (const double time : gate.times.empty() ? c.times : gate.times) {
    const std::string when = fmt::format(", t = {:g} s", time);
    if (gate.quantity == "contour.distance") {
      judge(both, of_contours(both, time, gate.level), gate, time, when, result);
    } else {
      const std::string id = gate.quantity.substr(gate.quantity.find('.') + 1);
      judge(both, of_values(both, [&](const Run& run) { return probe_of(run, time, id); }), gate, time, when, result);
    }
  }
}

void judge_settling(const Case& c, const GateSpec& gate, const std::vector<const Run*>& runs, reports::Gate& result) {
  std::map<std::string, Series> by_method;
  for (const Run* run : runs) {
    check_judgeable(*run);
    by_method[run->method].push_back(run);
  }
  if (by_method.empty() || by_method.size() > 2)
    invalid(fmt::format("{} methods; one or two settle", by_method.size()));
  if (gate.quantity.starts_with("probe.")) {
    judge_probe_settling(c, gate, by_method, result);
    return;
  }
  const auto both = by_method.size() == 2 ? both_methods(runs, levels_for_uncertainty) : std::array<Series, 2>{};
  result.formula =
      fmt::format("Sprague–Geers distance of {} between successive meshes{}: each at most {:g} of the one before",
                  gate.quantity, by_method.size() == 2 ? ", and between the methods" : "", *gate.max);
  const auto distance = [&](const Run& a, const Run& b) {
    return sprague_geers(history_of(a, gate.quantity), history_of(b, gate.quantity)).combined;
  };
  const auto falls = [&](const std::string& what, const std::vector<double>& distances) {
    for (const double one : distances) {
      if (!std::isfinite(one)) invalid(what + ": a history vanishes");
      if (one <= 1e-12) invalid(what + ": two histories are the same");
    }
    for (std::size_t k = 0; k + 1 < distances.size(); ++k) {
      hold(result, {fmt::format("{}: {:.3g} after {:.3g}", what, distances[k + 1], distances[k]), distances[k + 1],
                    distances[k], 0, *gate.max, distances[k + 1] / distances[k], false});
    }
  };
  for (auto& [method, series] : by_method) {
    std::sort(series.begin(), series.end(), [](const Run* a, const Run* b) { return a->cells < b->cells; });
    if (series.size() < 4) invalid(fmt::format("{}: {} meshes, at least 4 are needed", method, series.size()));
    std::vector<double> between;
    for (std::size_t k = 0; k + 1 < series.size(); ++k)
      if (series[k]->cells == series[k + 1]->cells) invalid("two runs of a method on one mesh");
    for (std::size_t k = 0; k + 1 < series.size(); ++k) between.push_back(distance(*series[k], *series[k + 1]));
    falls(method, between);
  }
  if (by_method.size() < 2) return;
  std::vector<double> apart;
  for (std::size_t k = 0; k < both[0].size(); ++k) apart.push_back(distance(*both[1][k], *both[0][k]));
  falls(both[0][0]->method + " and " + both[1][0]->method, apart);
}

}  // namespace diptych::runner
