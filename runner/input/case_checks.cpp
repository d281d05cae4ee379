#include "runner/input/case_checks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "runner/input/build.hpp"
#include "runner/input/constants.hpp"
#include "runner/input/expression.hpp"
#include "runner/input/plate_build.hpp"

namespace diptych::runner {
namespace {

constexpr double most_cells_in_a_row = 1e7;  // as many as axes.cells may have

bool bar_is_known(const Case& c) {
  const double speed = material::wave_speed(c.first().material);
  return c.first().length > 0 && std::isfinite(speed) && speed > 0;
}

/// Places and times at which expressions are tried.
struct TriedAt {
  std::vector<double> x{0}, y{0}, t{0};
};
TriedAt trial_of(const Case& c) {
  TriedAt trial;
  const double width = c.plate ? c.plate->width : c.first().length;
  trial.x = {0, width / 2, width};
  if (c.plate) trial.y = {0, c.plate->height / 2, c.plate->height};
  for (const double time : c.times) trial.t.push_back(time * time_unit(c, c.time_unit));
  return trial;
}

}  // namespace

std::map<std::string, std::string> features_in_use(const Case& c) {
  std::map<std::string, std::string> used;
  for (const BarSpec& bar : c.bars)
    used[material::feature(bar.material)] = "material.model = " + words(material::model(bar.material));
  if (used.size() > 1) used.erase(material::Elastic::feature);  // elastic bars beside others run under the others' law
  if (c.bars.size() > 1) used["contact"] = "a second [[bar]]";
  if (c.viscosity) used["viscosity"] = "[viscosity]";
  if (!c.body_force.empty()) used["body-force"] = "[body_force]";
  if (c.convected) used["convection"] = "model.displacements = \"finite\"";
  for (const LoadSpec& load : c.loads)
    if (load.transfer == Transfer::boundary_layer) used["boundary-layer"] = "[[load]] transfer = \"boundary-layer\"";
  return used;
}

std::vector<Case> cases_of_runs(const Case& c) {
  std::vector<Case> all;
  std::set<Parameters> seen;
  const Case bare = without_axes(c);
  for (const Leaf& leaf : leaves(c))
    if (seen.insert(leaf.parameters).second) all.push_back(with_parameters(bare, leaf));
  if (all.empty()) all.push_back(c);
  return all;
}

Names methods_of(const Case& c) { return panels_for(kind_of(c)); }

Names variants_of(const Case& c) {
  Names names{""};
  for (const PlateVariant& variant : c.variants) names.push_back(variant.id);
  return names;
}

Axes all_axes(const Case& c) {
  Axes all;
  all.particles.clear();
  all.variant.clear();
  const auto add = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
    std::sort(to.begin(), to.end());
    to.erase(std::unique(to.begin(), to.end()), to.end());
  };
  for (const Axes& block : c.axes) {
    add(all.method, block.method);
    add(all.cells, block.cells);
    add(all.courant, block.courant);
    add(all.particles, block.particles);
    add(all.variant, block.variant);
    for (const auto& [name, values] : block.parameters) add(all.parameters[name], values);
  }
  return all;
}

double bar_in(const std::string& unit, const Case& c) {
  if (unit != "cells") return unit == "m" ? c.first().length : 1;
  const std::vector<int> cells = all_axes(c).cells;
  return cells.empty() ? 0 : cells.front();
}

std::vector<Leaf> runs_of(const GateSpec& gate, const Case& c) {
  std::vector<Leaf> runs = leaves(c);
  std::erase_if(runs, [&](const Leaf& run) { return !matches(gate.where, run); });
  return runs;
}

bool ascending(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

bool check_constant(const Place& place, const std::string& formula, const Case& c) {
  const std::size_t before = place.mistakes->size();
  for (const Case& variant : cases_of_runs(c)) {
    check_expression(place, formula, {}, variant);
    if (place.mistakes->size() != before) return false;
  }
  return true;
}

void check_not_negative(const Place& place, const std::string& formula, const Case& c) {
  for (const Case& variant : cases_of_runs(c)) {
    double value = 0;
    try {
      value = Expression(formula, {}, expression_constants(variant))();
    } catch (const InputError&) {
      return;  // reported already
    }
    if (value >= 0) continue;
    place.refuse(words(value), "a number >= 0");
    return;
  }
}

void check_bars(const Place& place, const Case& c) {
  if (c.bars.size() == 1 || !bar_is_known(c)) return;
  std::set<std::string> laws;
  for (const BarSpec& bar : c.bars) laws.insert(material::model(bar.material));
  laws.erase(material::Elastic::model);
  if (laws.size() > 1)
    place.say("found bars of material.model = " + joined(Names(laws.begin(), laws.end())) +
              " beside one another; allowed: bars of one model, and \"" + material::Elastic::model +
              "\" ones beside them");
  for (const int cells : all_axes(c).cells) {
    const double h = c.first().length / cells;
    for (std::size_t b = 1; b < c.bars.size(); ++b) {
      const double size = c.bars[b].length / h;
      if (std::abs(size - std::round(size)) <= 1e-9 * size && std::round(size) >= 1) continue;
      place.say(
          fmt::format("found bar {} of length {}, which is {:.10g} cells where the first bar has {}; allowed: whole "
                      "numbers of cells, all of one size, to a part of 1e-9",
                      b + 1, c.bars[b].length, size, cells));
      return;
    }
    const double row = (begins_of(c, cells).back() + c.bars.back().length) / h;
    if (row <= most_cells_in_a_row) continue;
    place.say(fmt::format("found bars and gaps of {:g} cells in all; allowed: at most {:g}", row, most_cells_in_a_row));
    return;
  }
}

void check_approach(const Place& place, const Case& c) {
  if (c.bars.size() == 1 || !bar_is_known(c)) return;
  for (const Case& variant : cases_of_runs(c)) {
    for (std::size_t b = 1; b < c.bars.size(); ++b) {
      const double before = velocity_of(variant, b - 1), after = velocity_of(variant, b), closing = before - after;
      const double least = std::max(1e-12 * material::wave_speed(c.first().material),
                                    1e-6 * std::max(std::abs(before), std::abs(after)));
      if (closing <= 0 || closing >= least) continue;
      place.say(
          fmt::format("found bars {} and {} that close in at {:g}; allowed: at rest to each other, or at least {:g}, "
                      "1e-12 of the wave speed and 1e-6 of what they move at",
                      b, b + 1, closing, least));
      return;
    }
  }
}

void check_in_some_bar(const Place& place, const Measured& at, const Case& c) {
  for (const int cells : all_axes(c).cells) {
    const double x = length_of(c, at, cells);
    const std::vector<double> begins = begins_of(c, cells);
    bool inside = false;
    for (std::size_t b = 0; b < c.bars.size(); ++b)
      inside = inside || (x >= begins[b] && x <= begins[b] + c.bars[b].length);
    if (inside) continue;
    place.refuse(words(at.value) + ' ' + at.unit + ", which is in no bar",
                 "places in a bar, from the first one's left end");
    return;
  }
}

void check_contact(const Place& place, const Case& c) {
  if (!bar_is_known(c) || c.axes.empty()) return;
  for (const Case& variant : cases_of_runs(c)) {
    if (std::isfinite(contact_time(variant, all_axes(c).cells.front()))) continue;
    place.say("found \"contact\" where no two bars close in; allowed: with bars whose velocities make them meet");
    return;
  }
}

void check_times(const Place& place, const Case& c) {
  if (!bar_is_known(c) || c.axes.empty() || c.times.empty()) return;
  const Case bare = without_axes(c);
  for (const Leaf& leaf : leaves(c)) {
    if (instant(with_parameters(bare, leaf), leaf, c.times.front()) > 0) continue;
    place.refuse(words(c.times.front()) + ", which is before the start in some run", "times after the start");
    return;
  }
}

void check_expression(const Place& place, const std::string& text, const Names& variables, const Case& c) {
  if (text.empty()) return;
  const bool known = c.plate ? c.plate->width > 0 && c.plate->height > 0 : bar_is_known(c);
  std::map<std::string, double> constants = expression_constants(c);
  if (!known)  // reported already: any values will do to find the mistakes of the formula itself
    for (const char* name : {"L", "E", "rho", "c"}) constants[name] = 0.7;
  try {
    const Expression expression(text, variables, constants);
    if (!known || variables.empty()) return;  // the reader of expressions has seen a constant one to be finite
    const TriedAt trial = trial_of(c);
    const std::map<std::string, const std::vector<double>*> tried{{"x", &trial.x}, {"y", &trial.y}, {"t", &trial.t}};
    std::array<const std::vector<double>*, 3> values{};
    static const std::vector<double> once{0};
    for (std::size_t k = 0; k < 3; ++k) values[k] = k < variables.size() ? tried.at(variables[k]) : &once;
    for (const double a : *values[0]) {
      for (const double b : *values[1]) {
        for (const double third : *values[2]) {
          const double value = variables.size() == 1   ? expression(a)
                               : variables.size() == 2 ? expression(a, b)
                                                       : expression(a, b, third);
          if (std::isfinite(value)) continue;
          const std::array<double, 3> at{a, b, third};
          std::string where;
          for (std::size_t k = 0; k < variables.size(); ++k)
            where += (k > 0 ? ", " : "") + variables[k] + " = " + words(at[k]);
          place.say(
              fmt::format("found {}, which is {} at {}; allowed: finite values at {} and t in {{0, sample times}}",
                          words(text), std::isnan(value) ? "NaN" : words(value), where,
                          c.plate ? "the corners and the middle" : "x in {0, L/2, L}"));
          return;
        }
      }
    }
  } catch (const InputError& error) {
    place.say(error.what());
  }
}

void check_features(const Place& place, const Case& c) {
  if (c.features.empty()) return;
  const auto used = features_in_use(c);
  const std::string allowed = "; allowed: exactly the features in use";
  for (const auto& [feature, key] : used)
    if (!contains(c.features, feature))
      place.say("missing " + words(feature) + ", which " + key + " switches on" + allowed);
  for (const std::string& feature : c.features)
    if (!used.contains(feature))
      place.say("found " + words(feature) + ", which nothing in the scene switches on" + allowed);
}

void check_steps(const Place& place, const Axes& axes, const Case& c) {
  constexpr double most = 1e12;
  if (c.times.empty() || !bar_is_known(c)) return;
  const double courant = *std::min_element(axes.courant.begin(), axes.courant.end());
  const int cells = *std::max_element(axes.cells.begin(), axes.cells.end());
  double end = 0;  // in L/c
  for (const Case& variant : cases_of_runs(c))
    end = std::max(end, instant(variant, cells, c.times.back()) / time_unit(c, "L/c"));
  if (std::isinf(end)) return;  // bars that never meet: reported already
  const double steps = end * cells / courant;
  if (!(steps <= most))
    place.say("found " + words(courant) + ", which needs " + words(steps) + " steps on " + words(cells) +
              " cells; allowed: at most " + words(most) + " steps");
}

void check_methods(const Place& place, const Axes& axes, const Case& c) {
  const auto used = features_in_use(c);
  const auto refused = [&](const Panel& p, const Names& together) {
    return std::find(p.refuses.begin(), p.refuses.end(), together) != p.refuses.end() &&
           std::all_of(together.begin(), together.end(), [&](const std::string& f) { return used.contains(f); });
  };
  for (const std::string& method : axes.method) {
    for (const Names& together : panel(method).refuses) {
      if (!refused(panel(method), together)) continue;
      Names others, families;
      for (const std::string& other : methods_of(c)) {
        if (refused(panel(other), together)) continue;
        others.push_back(other);
        if (!contains(families, panel(other).look.name)) families.push_back(panel(other).look.name);
      }
      const bool moving = together.back() == "convection" && together.size() > 1;
      place.refuse(
          words(method) + " together with " + used.at(together.front()) + (moving ? " and finite displacements" : ""),
          listed(families) + " methods only: " + listed(others));
    }
  }
}

bool any_particles(const Case& c) {
  const std::vector<Leaf> runs = leaves(c);
  return std::any_of(runs.begin(), runs.end(), [](const Leaf& run) { return panel(run.method).particles; });
}

/// What the named solutions leave out, they cannot be compared with.
void check_solution(const Place& place, const Case& c) {
  const analytic::BarSolution* row = solution_of(c);
  if (!row) return;
  std::set<std::string> said;
  bool meet = false;
  const auto say = [&](const std::string& misfit) {
    if (said.insert(misfit).second) place.say("found " + words(c.exact.solution) + " " + misfit);
  };
  for (const Case& variant : cases_of_runs(c)) {
    for (const std::string& misfit : row->misfits(bar_setting(variant, 1))) say(misfit);
    meet = meet || std::isfinite(contact_time(variant, 1));
  }
  if (row->of_impact && meet && !c.convected && any_particles(c))
    say("together with MPM, infinitesimal displacements and bars that fly; allowed: model.displacements = \"finite\": "
        "particles that stay in place never meet");
}

}  // namespace diptych::runner
