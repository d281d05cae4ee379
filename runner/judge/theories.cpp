#include "runner/judge/theories.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "runner/compare/quantities.hpp"
#include "runner/input/build.hpp"
#include "runner/input/case_checks.hpp"
#include "runner/input/toml_table.hpp"

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

/// Of bars.
std::vector<Theory> all_theories(const Case& c) {
  const Names norms = quantity_names(c, {Quantity::Sort::error_norm}),
              outcomes = quantity_names(c, {Quantity::Sort::outcome});
  const std::vector<Scheme> all{Scheme::fem, Scheme::mpm_usf, Scheme::mpm_usl, Scheme::mpm_musl};
  return {
      {"discrete-step", "bar-wave", {"stress.L2", "displacement.L2"}, all},
      {"airy-step",
       "bar-wave",
       {"stress.L2", "displacement.L2", "displacement.Linf"},
       {Scheme::fem, Scheme::mpm_usf, Scheme::mpm_musl}},
      {"end-equilibrium", "", {}},  // the loads' own: probes of stress, whatever the solution
      {"mode", "standing-mode", norms, all},
      {"viscous-front", "bar-wave", {"stress.L1", "stress.L2", "velocity.L1", "velocity.L2"}},
      {"impact", "impact", outcomes},
      {"plastic-impact", "plastic-impact", outcomes},
  };
}

/// The same of plates: standing modes; of a plate that a flyer strikes what the solid does, what the lattice does, and
/// where the damage has got to.
const Names plate_theories{"mode", "plate-impact", "impact-lattice", "diffusion-front"};

void check_of_bars(const Place& predict, const std::string& id, const GateSpec& gate, const Case& c) {
  const std::vector<Theory> all = all_theories(c);
  const auto theory = std::find_if(all.begin(), all.end(), [&](const Theory& one) { return one.name == id; });
  if (theory == all.end() || c.exact.solution.empty()) return;
  const std::string name = words(id), solution = "exact.solution = " + words(c.exact.solution);
  if (!theory->solution.empty() && theory->solution != c.exact.solution) {
    Names possible;
    for (const Theory& one : all)
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
  if (id == "viscous-front") {
    const std::vector<Case> variants = cases_of_runs(c);
    if (!c.viscosity)
      predict.refuse(name + " without [viscosity]", "with [viscosity] whose c2 is 0");
    else if (std::any_of(variants.begin(), variants.end(),
                         [](const Case& variant) { return viscosity_of(variant).c2 != 0; }))
      predict.refuse(name + " with viscosity.c2 other than 0", "with c2 = 0: one ν for the whole front");
  } else if (c.viscosity && (theory->solution == "bar-wave" || theory->solution == "standing-mode")) {
    predict.refuse(name + " with [viscosity]", "\"viscous-front\", or no viscosity");
  }
  if (id != "end-equilibrium") return;
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

void check_of_plate(const Place& predict, const std::string& id, const GateSpec& gate, const Case& c) {
  const std::string& solution = c.plate->exact.solution;
  const bool of_gauge = gate.quantity.starts_with("gauge.");
  if (!id.empty() && !gate.quantity.empty() && of_gauge == (id == "mode"))
    predict.refuse(words(id) + " for " + words(gate.quantity),
                   of_gauge ? "\"plate-impact\", \"impact-lattice\" or \"diffusion-front\"" : "\"mode\"");
  if (id == "mode" && !of_gauge && !solution.empty() && !contains({"lame-mode", "roller-mode", "p-wave"}, solution))
    predict.refuse("\"mode\" for exact.solution = " + words(solution),
                   "with \"lame-mode\", \"roller-mode\" or \"p-wave\"");
}

}  // namespace

Names theories(const Case& c) {
  if (c.plate) return plate_theories;
  Names names;
  for (const Theory& theory : all_theories(c)) names.push_back(theory.name);
  return names;
}

void check_theory(const Place& predict, const std::string& theory, const GateSpec& gate, const Case& c) {
  if (c.plate)
    check_of_plate(predict, theory, gate, c);
  else
    check_of_bars(predict, theory, gate, c);
}

void check_scheme_theory(const Place& predict, const std::string& theory, const GateSpec& gate, const Case& c) {
  Names known = methods_of(c), without;
  std::erase_if(known, [&](const std::string& method) { return !panel(method).has_theory(kind_of(c)); });
  for (const Leaf& run : runs_of(gate, c))
    if (!contains(known, run.method) && !contains(without, run.method)) without.push_back(run.method);
  for (const std::string& method : without)
    predict.refuse(words(theory) + " for method " + words(method) + ", of which there is no prediction",
                   "for " + joined(known), "say so in where = { method = ... }");
}

}  // namespace diptych::runner
