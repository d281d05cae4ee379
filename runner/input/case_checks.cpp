#include "runner/input/case_checks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "runner/input/build.hpp"
#include "runner/input/constants.hpp"
#include "runner/input/expression.hpp"
#include "runner/input/plate_build.hpp"

namespace diptych::runner {
namespace {

/// What a `constant` gate may be measured against, and where that theory holds.
struct Theory {
  std::string name, solution;
  Names quantities;
  std::vector<analytic::Scheme> schemes = {};  ///< none: a theory of the bar or its loads, whatever the scheme
  Names methods() const {
    Names names = panels_for(SceneKind::bars);
    std::erase_if(names, [&](const std::string& method) {
      const auto scheme = panel(method).bar_theory;
      return !schemes.empty() && (!scheme || std::find(schemes.begin(), schemes.end(), *scheme) == schemes.end());
    });
    return names;
  }
};
using Scheme = analytic::Scheme;
const std::vector<Scheme> all_schemes{Scheme::fem, Scheme::mpm_usf, Scheme::mpm_usl, Scheme::mpm_musl};
const std::vector<Theory> all_theories{
    {"discrete-step", "bar-wave", {"stress.L2", "displacement.L2"}, all_schemes},
    {"airy-step",
     "bar-wave",
     {"stress.L2", "displacement.L2", "displacement.Linf"},
     {Scheme::fem, Scheme::mpm_usf, Scheme::mpm_musl}},
    {"end-equilibrium", "", {}},  // the loads' own: probes of stress, whatever the solution
    {"mode", "standing-mode", quantities_of("order", {}), all_schemes},
    {"viscous-front", "bar-wave", {"stress.L1", "stress.L2", "velocity.L1", "velocity.L2"}},
    {"impact", "impact", outcomes},
    {"plastic-impact", "plastic-impact", outcomes},
};

/// The same of plates: standing modes; of a plate that a flyer strikes what the solid does, what the lattice does, and
/// where the damage has got to.
const Names plate_theories{"mode", "plate-impact", "impact-lattice", "diffusion-front"};

/// The values of parameters that the runs have: those of [parameters] where none is swept.
std::vector<Case> variants(const Case& c) {
  std::vector<Case> all;
  std::vector<Parameters> seen;
  for (const Leaf& leaf : leaves(c)) {
    if (std::find(seen.begin(), seen.end(), leaf.parameters) != seen.end()) continue;
    seen.push_back(leaf.parameters);
    all.push_back(with_parameters(c, leaf));
  }
  if (all.empty()) all.push_back(c);
  return all;
}

bool bar_is_known(const Case& c) {
  const double speed = material::wave_speed(c.first().material);
  return c.first().length > 0 && std::isfinite(speed) && speed > 0;
}

/// The features that the scene switches on, each with the key that does it.
std::map<std::string, std::string> features_in_use(const Case& c) {
  std::map<std::string, std::string> used;
  // Elastic bars beside others take the others' law, see material::laws.
  const auto other = std::find_if(c.bars.begin(), c.bars.end(), [](const BarSpec& bar) {
    return !std::holds_alternative<material::Elastic>(bar.material);
  });
  const material::Material& law = (other == c.bars.end() ? c.first() : *other).material;
  used[material::feature(law)] = fmt::format("material.model = \"{}\"", material::model(law));
  if (c.bars.size() > 1) used["contact"] = "a second [[bar]]";
  if (c.viscosity) used["viscosity"] = "[viscosity]";
  if (!c.body_force.empty()) used["body-force"] = "[body_force]";
  if (c.convected) used["convection"] = "model.displacements = \"finite\"";
  for (const LoadSpec& load : c.loads)
    if (load.transfer == Transfer::boundary_layer) used["boundary-layer"] = "[[load]] transfer = \"boundary-layer\"";
  return used;
}

/// A norm of an error needs something exact to compare with.
void check_comparable(const Place& quantity, const GateSpec& gate, const Case& c) {
  if (gate.quantity.empty() || gate.quantity.starts_with("probe.") || contains(outcomes, gate.quantity)) return;
  const std::string field = gate.quantity.substr(0, gate.quantity.find('.'));
  const ExactSpec& exact = c.exact;
  if (exact.solution == "none")
    quantity.refuse(words(gate.quantity) + " in a case without an exact solution",
                    joined(invariants) + " (kind invariant), or give [exact]");
  if (exact.solution != "expressions" || !contains(fields, field)) return;
  const std::string& formula = field == "stress"     ? exact.stress
                               : field == "velocity" ? exact.velocity
                                                     : exact.displacement;
  if (formula.empty())
    quantity.refuse(words(gate.quantity), "fields that [exact] gives: exact." + field + " is missing");
}

void check_theory(const Place& predict, const GateSpec& gate, const Case& c) {
  const auto theory = std::find_if(all_theories.begin(), all_theories.end(),
                                   [&](const Theory& one) { return one.name == gate.predict; });
  if (theory == all_theories.end() || c.exact.solution.empty()) return;
  const std::string name = words(gate.predict), solution = "exact.solution = " + words(c.exact.solution);
  if (!theory->solution.empty() && theory->solution != c.exact.solution) {
    Names possible;
    for (const Theory& one : all_theories)
      if (one.solution == c.exact.solution) possible.push_back(one.name);
    predict.refuse(name + ", which is a theory of " + words(theory->solution),
                   possible.empty() ? "no such gate: " + solution + " has no theory"
                                    : joined(possible) + ", theories of " + solution);
    return;
  }
  if (!gate.quantity.empty() && !theory->quantities.empty() && !contains(theory->quantities, gate.quantity))
    predict.refuse(name + " for " + words(gate.quantity), "for " + joined(theory->quantities));
  std::set<std::string> others;
  for (const Leaf& run : runs_of(gate, c))
    if (!contains(theory->methods(), run.method)) others.insert(run.method);
  for (const std::string& method : others)
    predict.refuse(name + " for method " + words(method), "for " + joined(theory->methods()),
                   "say so in where = { method = ... }");
  if (gate.predict == "viscous-front") {
    const std::vector<Case> all = variants(c);
    if (!c.viscosity)
      predict.refuse(name + " without [viscosity]", "with [viscosity] whose c2 is 0");
    else if (std::any_of(all.begin(), all.end(), [](const Case& variant) { return viscosity_of(variant).c2 != 0; }))
      predict.refuse(name + " with viscosity.c2 other than 0", "with c2 = 0: one ν for the whole front");
  } else if (c.viscosity && (theory->solution == "bar-wave" || theory->solution == "standing-mode")) {
    predict.refuse(name + " with [viscosity]", "\"viscous-front\", or no viscosity");
  }
  if (gate.predict != "end-equilibrium") return;
  const bool of_stress = std::any_of(c.probes.begin(), c.probes.end(), [&](const Probe& probe) {
    return gate.quantity == "probe." + probe.id && probe.field == "stress";
  });
  if (!gate.quantity.empty() && !of_stress)
    predict.refuse(name + " for " + words(gate.quantity), "for probes of stress");
  const bool loaded = std::any_of(c.loads.begin(), c.loads.end(), [](const LoadSpec& load) {
    return load.history.empty() || load.history == "step" || load.history == "ramp";
  });
  if (!loaded) predict.refuse(name + " without a steady load", "with a [[load]] of history step or ramp");
}

void check_order(Table& t, const GateSpec& gate, const Case& c) {
  if (gate.band && gate.expect && (*gate.expect < (*gate.band)[0] || *gate.expect > (*gate.band)[1]))
    t.place("expect").refuse(words(*gate.expect),
                             "an order within the band, " + words((*gate.band)[0]) + " to " + words((*gate.band)[1]));
  const char* varies = gate.over_time_step ? "courant" : "cells";
  std::map<std::string, int> meshes;  // of each series that differs in nothing else
  for (const Leaf& run : runs_of(gate, c))
    ++meshes[run.method +
             (gate.over_time_step ? ", cells = " + words(run.cells) : ", courant = " + words(run.courant)) +
             (run.particles.empty() ? "" : ", particles = " + words(run.particles)) +
             (parameters_label(run).empty() ? "" : ", " + parameters_label(run))];
  for (const auto& [series, count] : meshes) {
    if (count >= gate.levels_min) continue;
    t.place("levels_min")
        .refuse(fmt::format("{} values of {} for {}", count, varies, series),
                fmt::format("at least levels_min = {}", gate.levels_min));
    return;  // the other series differ in the same way
  }
}

/// Places and times at which expressions are tried.
struct Trial {
  std::vector<double> x{0}, y{0}, t{0};
};
Trial trial_of(const Case& c) {
  Trial trial;
  const double width = c.plate ? c.plate->width : c.first().length;
  trial.x = {0, width / 2, width};
  if (c.plate) trial.y = {0, c.plate->height / 2, c.plate->height};
  for (const double time : c.times) trial.t.push_back(time * time_unit(c, c.time_unit));
  return trial;
}

const Names plate_invariants{"energy.drift",        "energy.lost",         "energy.closure",    "momentum.drift",
                             "bits.repeat",         "bits.threads",        "bits.mirror",       "bits.power-of-two",
                             "bits.undamaged",      "numbers.largest",     "area.error",        "concentration.balance",
                             "concentration.least", "cross.forward-euler", "energy.dissipated", "energy.given-back",
                             "energy.excess",       "dilatancy.ahead",     "impact.left-over"};
const Names failure_measures{"failure.speed", "failure.delay", "failure.slowing"};
const Names plate_fields{"displacement", "velocity", "stress", "concentration"};

Names plate_quantities_of(const std::string& kind, const Case& c) {
  const auto of_gauges = [&](const Names& measures) {
    Names names;
    for (const GaugeSpec& gauge : c.gauges)
      for (const std::string& measure : measures) names.push_back("gauge." + gauge.id + "." + measure);
    return names;
  };
  const auto with = [](Names names, const Names& more) {
    names.insert(names.end(), more.begin(), more.end());
    return names;
  };
  if (kind == "invariant") return with(plate_invariants, of_gauges({"prediction"}));
  if (kind == "limit") return {"critical_courant", "stable"};
  Names names;
  if (kind == "settling") names = of_gauges({"xx", "yy", "dilatancy"});
  if (kind != "agreement" && kind != "settling")
    for (const std::string& field : plate_fields)
      for (const char* norm : {".L1", ".L2", ".Linf"}) names.push_back(field + norm);
  if (kind == "exact" || kind == "agreement" || kind == "settling")
    for (const PlateProbe& probe : c.plate_probes) names.push_back("probe." + probe.id);
  if (kind == "agreement")
    names = with(with(names, {"contour.distance", "platen.history"}), of_gauges({"xx", "yy", "dilatancy"}));
  if (kind == "exact" || kind == "constant") names = with(names, of_gauges(gauge_measures));
  if (kind == "exact" && c.gauges.size() > 1) names = with(names, failure_measures);
  return names;
}

}  // namespace

Names methods_of(const Case& c) { return panels_for(kind_of(c)); }

Names variants_of(const Case& c) {
  Names names{""};
  for (const PlateVariant& variant : c.variants) names.push_back(variant.id);
  return names;
}

Names theories(const Case& c) {
  if (c.plate) return plate_theories;
  Names names;
  for (const Theory& theory : all_theories) names.push_back(theory.name);
  return names;
}

Names quantities_of(const std::string& kind, const Case& c) {
  if (c.plate) return plate_quantities_of(kind, c);
  if (kind == "invariant") return invariants;
  if (kind == "limit") return {"critical_courant", "stable"};
  Names names;
  for (const std::string& field : fields)
    for (const char* norm : {".L1", ".L2", ".Linf"}) names.push_back(field + norm);
  if (kind == "exact" || kind == "constant") {
    for (const Probe& probe : c.probes) names.push_back("probe." + probe.id);
    names.insert(names.end(), outcomes.begin(), outcomes.end());
  }
  if (kind == "order")
    for (const std::string& outcome : outcomes)
      if (outcome != "contact.early")
        names.push_back(outcome + ".error");  // of which nothing but rigid flight is known
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
  for (const Case& variant : variants(c)) {
    check_expression(place, formula, {}, variant);
    if (place.mistakes->size() != before) return false;
  }
  return true;
}

void check_not_negative(const Place& place, const std::string& formula, const Case& c) {
  for (const Case& variant : variants(c)) {
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
  for (const int cells : all_axes(c).cells) {
    const double h = c.first().length / cells;
    for (std::size_t b = 1; b < c.bars.size(); ++b) {
      const double size = c.bars[b].length / h;
      if (std::abs(size - std::round(size)) <= 1e-9 * size && std::round(size) >= 1) continue;
      place.say(
          fmt::format("found bar {} of length {}, which is {:g} cells where the first bar has {}; allowed: whole "
                      "numbers of cells, all of one size",
                      b + 1, c.bars[b].length, size, cells));
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
  for (const Case& variant : variants(c)) {
    if (std::isfinite(contact_time(variant, all_axes(c).cells.front()))) continue;
    place.say("found \"contact\" where no two bars close in; allowed: with bars whose velocities make them meet");
    return;
  }
}

void check_times(const Place& place, const Case& c) {
  if (!bar_is_known(c) || c.axes.empty() || c.times.empty()) return;
  for (const Case& variant : variants(c)) {
    for (const Leaf& leaf : leaves(c)) {
      if (instant(variant, leaf, c.times.front()) > 0) continue;
      place.refuse(words(c.times.front()) + ", which is before the start in some run", "times after the start");
      return;
    }
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
    const Trial trial = trial_of(c);
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
  for (const Case& variant : variants(c))
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
  for (const Case& variant : variants(c)) {
    for (const std::string& misfit : row->misfits(bar_setting(variant, 1))) say(misfit);
    meet = meet || std::isfinite(contact_time(variant, 1));
  }
  if (row->of_impact && meet && !c.convected && any_particles(c))
    say("together with MPM, infinitesimal displacements and bars that fly; allowed: model.displacements = \"finite\": "
        "particles that stay in place never meet");
}

/// Two methods, otherwise alike, on the same four meshes or more.
void check_agreement(Table& t, const GateSpec& gate, const Case& c) {
  std::map<std::string, std::set<int>> meshes;
  std::set<std::string> otherwise;
  for (const Leaf& run : runs_of(gate, c)) {
    meshes[run.method].insert(run.cells);
    otherwise.insert("courant = " + words(run.courant) +
                     (parameters_label(run).empty() ? "" : ", " + parameters_label(run)));
  }
  const Place place = t.place("where");
  if (otherwise.size() > 1)
    place.say(fmt::format("found runs that differ in more than method and mesh ({}); allowed: one of them, in where",
                          listed(otherwise, "; ")));
  if (meshes.size() != 2)
    place.say(fmt::format("found {} methods; allowed: two, fem and one of MPM", meshes.size()));
  else if (meshes.begin()->second != std::next(meshes.begin())->second)
    place.say("found other meshes for each method; allowed: the same");
  else if (gate.max && meshes.begin()->second.size() < 4)
    place.say(fmt::format("found {} meshes; allowed: at least 4, on which the uncertainties are found",
                          meshes.begin()->second.size()));
}

/// One or two methods, each otherwise alike on four meshes or more.
void check_settling(Table& t, const GateSpec& gate, const Case& c) {
  std::map<std::string, std::set<int>> meshes;
  std::map<std::string, std::set<std::string>> otherwise;
  for (const Leaf& run : runs_of(gate, c)) {
    meshes[run.method].insert(run.cells);
    otherwise[run.method].insert("courant = " + words(run.courant) +
                                 (run.particles.empty() ? "" : ", particles = " + words(run.particles)) +
                                 (parameters_label(run).empty() ? "" : ", " + parameters_label(run)));
  }
  const Place place = t.place("where");
  if (meshes.size() > 2) place.say(fmt::format("found {} methods; allowed: one or two", meshes.size()));
  for (const auto& [method, runs] : otherwise)
    if (runs.size() > 1)
      place.say(fmt::format("found runs of {} that differ in more than the mesh ({}); allowed: one of them, in where",
                            method, listed(runs, "; ")));
  const bool of_probe = gate.quantity.starts_with("probe.");  // which tells its meshes itself
  if (of_probe && gate.judged.size() < 2)
    t.place("judged").refuse(listed(gate.judged), "two meshes or more, for what changes between them");
  for (const auto& [method, cells] : meshes)
    if (cells.size() < 4 && !of_probe)
      place.say(fmt::format("found {} meshes of {}; allowed: at least 4", cells.size(), method));
}

/// A quantity of a plate needs what it is about.
void check_plate_gate(Table& t, const GateSpec& gate, const Case& c) {
  const Place place = t.place("quantity");
  const std::string field = gate.quantity.substr(0, gate.quantity.find('.'));
  const PlateExact& e = c.plate->exact;
  if (contains(plate_fields, field) && !contains(plate_invariants, gate.quantity)) {
    const bool solid = c.plate->solid.has_value();
    const bool given = e.solution.empty()            ? true
                       : e.solution == "none"        ? false
                       : e.solution == "expressions" ? !(field == "stress"         ? e.stress[0]
                                                         : field == "velocity"     ? e.velocity[0]
                                                         : field == "displacement" ? e.displacement[0]
                                                                                   : e.concentration)
                                                            .empty()
                       : solid ? field != "concentration"
                               : field == "concentration";
    if (!given) place.refuse(words(gate.quantity) + " where [exact] does not give it", "fields that [exact] gives");
  }
  const bool of_gauge = gate.quantity.starts_with("gauge.");
  if (gate.kind == "constant" && !gate.predict.empty() && !gate.quantity.empty() &&
      of_gauge == (gate.predict == "mode"))
    t.place("predict").refuse(words(gate.predict) + " for " + words(gate.quantity),
                              of_gauge ? "\"plate-impact\", \"impact-lattice\" or \"diffusion-front\"" : "\"mode\"");
  if (gate.kind == "settling" && !c.axes.empty()) check_settling(t, gate, c);
  if (gate.predict == "mode" && !of_gauge && !e.solution.empty() &&
      !contains({"lame-mode", "roller-mode", "p-wave"}, e.solution))
    t.place("predict").refuse("\"mode\" for exact.solution = " + words(e.solution),
                              "with \"lame-mode\", \"roller-mode\" or \"p-wave\"");
  const auto needs = [&](const Names& quantities, bool there, const std::string& what) {
    if (contains(quantities, gate.quantity) && !there)
      place.refuse(words(gate.quantity) + " without " + what, "with it");
  };
  const auto& supports = c.plate->supports;
  const auto& solid = c.plate->solid;
  const bool damage = c.plate->cracking(), changes = solid && changes_in_cells(*solid);
  const bool spreads = solid && diffuses(*solid);
  needs({"contour.distance"}, damage, "damage");
  needs({"bits.undamaged"}, changes, "damage");
  needs({"dilatancy.ahead", "impact.left-over"}, c.plate->flyer.has_value(), "a flyer");
  needs({"cross.forward-euler"}, spreads, "damage that diffuses");
  needs({"concentration.balance", "concentration.least"}, spreads || c.plate->diffusion, "diffusion");
  needs({"platen.history"}, std::find(supports.begin(), supports.end(), Edge::Support::platen) != supports.end(),
        "a platen");
  needs({"area.error", "bits.repeat", "bits.threads", "bits.mirror", "bits.power-of-two", "energy.drift", "energy.lost",
         "energy.closure", "energy.given-back", "energy.excess", "momentum.drift", "critical_courant"},
        solid.has_value(), "a material");
  if (gate.kind == "agreement" && !c.axes.empty()) check_agreement(t, gate, c);
  const bool of_ledger = gate.quantity.starts_with("energy.") || gate.quantity.starts_with("momentum.");
  if (of_ledger && !c.ledger)
    place.refuse(words(gate.quantity) + " with run.ledger = false", "with the ledger, run.ledger = true");
  if (gate.quantity == "bits.mirror" && c.plate->flyer)
    place.refuse(words(gate.quantity) + " of a flyer, which comes from the left", "without [flyer]");
  if (gate.quantity == "bits.mirror" && c.plate->face)
    place.refuse(words(gate.quantity) + " of an impact face, which stays where it is", "without diffusion.face");
  if (gate.quantity == "bits.power-of-two" && (c.plate->solid && changes_in_cells(*c.plate->solid)))
    place.refuse(words(gate.quantity) + " of a plate with damage", "of elastic plates: eq. 23a is not free of units");
  if (gate.kind == "order") check_order(t, gate, c);
}

/// What only theory of the scheme predicts needs a panel of which there is one.
void check_predicted(Table& t, const GateSpec& gate, const Case& c) {
  const bool of_scheme =
      contains({"stability-limit", "impact-lattice"}, gate.predict) || (c.plate && gate.predict == "mode");
  if (!of_scheme) return;
  Names known = methods_of(c), without;
  std::erase_if(known, [&](const std::string& method) { return !panel(method).has_theory(kind_of(c)); });
  for (const Leaf& run : runs_of(gate, c))
    if (!contains(known, run.method) && !contains(without, run.method)) without.push_back(run.method);
  for (const std::string& method : without)
    t.place("predict").refuse(
        words(gate.predict) + " for method " + words(method) + ", of which there is no prediction",
        "for " + joined(known), "say so in where = { method = ... }");
}

void check_gate(Table& t, const GateSpec& gate, const Case& c) {
  check_predicted(t, gate, c);
  if (c.plate) {
    check_plate_gate(t, gate, c);
    return;
  }
  if (gate.kind == "constant") check_theory(t.place("predict"), gate, c);
  if (contains({"exact", "constant", "order"}, gate.kind)) check_comparable(t.place("quantity"), gate, c);
  const Place quantity = t.place("quantity");
  if (gate.quantity.starts_with("contact.") && c.bars.size() == 1)
    quantity.refuse(words(gate.quantity) + " of one bar", "with two bars or more");
  const bool yields = std::any_of(c.bars.begin(), c.bars.end(), [](const BarSpec& bar) {
    return std::visit([](const auto& law) { return law.yields; }, bar.material);
  });
  if (gate.quantity.starts_with("plastic.") && !yields)
    quantity.refuse(words(gate.quantity) + " of elastic bars", "with a bar of model = \"hardening\"");
  const bool off = gate.quantity.starts_with("contact.") || gate.quantity.starts_with("plastic.");
  const analytic::BarSolution* solution = solution_of(c);
  if (gate.kind == "order" && off && c.exact.solution != "none" && !(solution && solution->of_impact))
    quantity.refuse(words(gate.quantity) + " with exact.solution = " + words(c.exact.solution),
                    "with \"impact\" or \"plastic-impact\"");
  const bool of_ledger = gate.quantity.starts_with("plastic.") || gate.quantity.starts_with("energy.") ||
                         gate.quantity.starts_with("momentum.");
  if (of_ledger && !c.ledger)
    t.place("quantity").refuse(words(gate.quantity) + " with run.ledger = false", "with the ledger, run.ledger = true");
  if (gate.kind == "order") check_order(t, gate, c);
}

void check_where(const Place& place, const GateSpec& gate, const Case& c) {
  const std::vector<Leaf> runs = runs_of(gate, c);
  const auto met = [&](const char* key, const auto& values, const auto& of_run) {
    for (const auto& value : values) {
      const auto has = [&](const Leaf& run) { return of_run(run) == value; };
      if (std::any_of(runs.begin(), runs.end(), has)) continue;
      place.say(
          fmt::format("found {} = {} in a combination of values that no run has; allowed: combinations within one "
                      "[axes]",
                      key, words(value)));
      return;
    }
  };
  if (runs.empty()) {
    place.say("found a combination of values that no run has; allowed: combinations within one [axes]");
    return;
  }
  met("method", gate.where.method, [](const Leaf& run) { return run.method; });
  met("cells", gate.where.cells, [](const Leaf& run) { return run.cells; });
  met("courant", gate.where.courant, [](const Leaf& run) { return run.courant; });
  met("variant", gate.where.variant, [](const Leaf& run) { return run.variant; });
  for (const auto& [name, values] : gate.where.parameters)
    met(name.c_str(), values, [&, key = name](const Leaf& run) {
      return run.parameters.contains(key) ? run.parameters.at(key) : std::nan("");
    });
  const bool no_particles =
      std::all_of(runs.begin(), runs.end(), [](const Leaf& run) { return run.particles.empty(); });
  if (no_particles) return;
  met("particles", gate.where.particles, [](const Leaf& run) { return run.particles; });
}

/// One leaf has one critical Courant number.
void check_limits(const Place& place, const Case& c) {
  const GateSpec* first = nullptr;
  for (const GateSpec& gate : c.gates) {
    if (gate.quantity != "critical_courant") continue;
    if (first && first->steps != gate.steps)
      place.say(fmt::format("found steps = {} in {} and {} in {}; allowed: the same for every gate on critical_courant",
                            first->steps, words(first->id), gate.steps, words(gate.id)));
    if (!first) first = &gate;
  }
}

/// Bands of slopes alone do not tell a right discontinuous solution from a wrong one.
void check_gates(const Place& place, const Case& c) {
  const auto any = [&](const Names& kinds) {
    return std::any_of(c.gates.begin(), c.gates.end(),
                       [&](const GateSpec& gate) { return gate.kind.empty() || contains(kinds, gate.kind); });
  };
  if (any({"order"}) && !any({"exact", "constant", "invariant"}))
    place.say(
        "found order gates alone, which a wrong solution can pass; allowed: with a gate of kind exact, constant "
        "or invariant beside them");
  check_limits(place, c);
}

}  // namespace diptych::runner
