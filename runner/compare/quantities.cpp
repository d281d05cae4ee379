#include "runner/compare/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "runner/input/build.hpp"
#include "runner/input/case_checks.hpp"

namespace diptych::runner {
namespace {

using Sort = Quantity::Sort;
using Scenes = Quantity::Scenes;
using Lack = Quantity::Lack;
using Needed = std::optional<Lack>;

// ---- what a case must hold ------------------------------------------------------------------------------------------

Needed without(bool there, const std::string& what) { return there ? Needed{} : Lack{" without " + what, "with it"}; }

std::string field_in(const std::string& name) { return name.substr(0, name.find('.')); }

/// A norm of an error needs something exact to compare with.
Needed exact_bars(const std::string& name, const Case& c) {
  const ExactSpec& exact = c.exact;
  if (exact.solution == "none")
    return Lack{" in a case without an exact solution",
                joined(quantity_names(c, {Sort::invariant})) + " (kind invariant), or give [exact]"};
  if (exact.solution != "expressions" || !contains(fields, field_in(name))) return {};
  const std::string field = field_in(name);
  const std::string& formula = field == "stress"     ? exact.stress
                               : field == "velocity" ? exact.velocity
                                                     : exact.displacement;
  if (!formula.empty()) return {};
  return Lack{"", "fields that [exact] gives: exact." + field + " is missing"};
}

Needed exact_plate(const std::string& name, const Case& c) {
  const PlateExact& e = c.plate->exact;
  const std::string field = field_in(name);
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
  return given ? Needed{} : Lack{" where [exact] does not give it", "fields that [exact] gives"};
}

Needed exact(const std::string& name, const Case& c) { return c.plate ? exact_plate(name, c) : exact_bars(name, c); }

Needed two_bars(const std::string&, const Case& c) {
  return c.bars.size() > 1 ? Needed{} : Lack{" of one bar", "with two bars or more"};
}

Needed yield(const std::string&, const Case& c) {
  if (std::any_of(c.bars.begin(), c.bars.end(), [](const BarSpec& bar) { return material::yields(bar.material); }))
    return {};
  Names that_yield;
  material::for_each_law([&]<class Law>() {
    if (Law::yields) that_yield.push_back(Law::model);
  });
  return Lack{" of elastic bars", "with a bar of model = " + joined(that_yield)};
}

Needed exact_impact(const std::string&, const Case& c) {
  const analytic::BarSolution* solution = solution_of(c);
  if (c.exact.solution == "none" || (solution && solution->of_impact)) return {};
  return Lack{" with exact.solution = " + words(c.exact.solution), "with \"impact\" or \"plastic-impact\""};
}

Needed books(const std::string&, const Case& c) {
  return c.ledger ? Needed{} : Lack{" with run.ledger = false", "with the ledger, run.ledger = true"};
}

Needed material(const std::string&, const Case& c) { return without(!c.plate || c.plate->solid, "a material"); }

Needed damage(const std::string&, const Case& c) { return without(c.plate->cracking() != nullptr, "damage"); }

bool changes(const Case& c) { return c.plate->solid && changes_in_cells(*c.plate->solid); }

bool spreads(const Case& c) { return c.plate->solid && diffuses(*c.plate->solid); }

Needed any_damage(const std::string&, const Case& c) { return without(changes(c), "damage"); }

Needed spreading_damage(const std::string&, const Case& c) { return without(spreads(c), "damage that diffuses"); }

Needed diffusion(const std::string&, const Case& c) { return without(spreads(c) || c.plate->diffusion, "diffusion"); }

Needed flyer(const std::string&, const Case& c) { return without(c.plate->flyer.has_value(), "a flyer"); }

Needed platen(const std::string&, const Case& c) {
  const auto& supports = c.plate->supports;
  return without(std::find(supports.begin(), supports.end(), Edge::Support::platen) != supports.end(), "a platen");
}

Needed no_flyer(const std::string&, const Case& c) {
  if (!c.plate || !c.plate->flyer) return {};
  return Lack{" of a flyer, which comes from the left", "without [flyer]"};
}

Needed no_face(const std::string&, const Case& c) {
  if (!c.plate || !c.plate->face) return {};
  return Lack{" of an impact face, which stays where it is", "without diffusion.face"};
}

Needed free_of_units(const std::string&, const Case& c) {
  if (!c.plate || !c.plate->solid || std::holds_alternative<solid::Elastic>(*c.plate->solid)) return {};
  if (changes(c)) return Lack{" of a plate with damage", "of elastic plates: eq. 23a is not free of units"};
  return Lack{" of a plate that is not elastic", "of elastic plates: no other law says how it scales"};
}

// ---- what the books make --------------------------------------------------------------------------------------------

double part(double value, double of) { return of > 0 ? value / of : value; }

double drift(const LedgerSums& sums, double) { return part(sums.taken, sums.held); }
double lost(const LedgerSums& sums, double) {
  return part(sums.last.contact + sums.last.scheme + sums.last.lost, sums.held);
}
double dissipated(const LedgerSums& sums, double) { return part(sums.last.dissipated, sums.held); }
double closure(const LedgerSums& sums, double) { return part(sums.lost, sums.held); }
double given_back(const LedgerSums& sums, double) { return part(sums.given_back, sums.held); }
double excess(const LedgerSums& sums, double) { return part(sums.excess, sums.put_in); }
/// Of what the mass with the largest kinetic energy could have.
double momentum(const LedgerSums& sums, double mass) { return part(sums.momentum, std::sqrt(2 * mass * sums.kinetic)); }

// ---- the table ------------------------------------------------------------------------------------------------------

std::vector<Quantity> rows_of_table() {
  std::vector<Quantity> rows;
  const auto norms = [&](const char* field, Scenes scenes) {
    for (const char* norm : {".L1", ".L2", ".Linf"})
      rows.push_back({std::string(field) + norm, "", Sort::error_norm, scenes, {exact}});
  };
  norms("stress", Scenes::both);
  norms("velocity", Scenes::both);
  norms("displacement", Scenes::both);
  norms("concentration", Scenes::plates);
  const std::vector<Quantity> others{
      {"probe.ID", "of the probe", Sort::probe, Scenes::both},
      {"contact.begin", "s", Sort::outcome, Scenes::bars, {two_bars}},
      {"contact.early", "s", Sort::outcome, Scenes::bars, {two_bars}},
      {"contact.end", "s", Sort::outcome, Scenes::bars, {two_bars}},
      {"contact.duration", "s", Sort::outcome, Scenes::bars, {two_bars}},
      {"contact.restitution", "", Sort::outcome, Scenes::bars, {two_bars}},
      {"plastic.work", "J", Sort::outcome, Scenes::bars, {yield, books}, true},
      // None of contact.early, of which nothing but rigid flight is known.
      {"contact.begin.error", "", Sort::outcome_error, Scenes::bars, {exact, two_bars, exact_impact}},
      {"contact.end.error", "", Sort::outcome_error, Scenes::bars, {exact, two_bars, exact_impact}},
      {"contact.duration.error", "", Sort::outcome_error, Scenes::bars, {exact, two_bars, exact_impact}},
      {"contact.restitution.error", "", Sort::outcome_error, Scenes::bars, {exact, two_bars, exact_impact}},
      {"plastic.work.error", "", Sort::outcome_error, Scenes::bars, {exact, yield, exact_impact, books}, true},
      {"contour.distance", "m", Sort::distance, Scenes::plates, {damage}},
      {"platen.history", "", Sort::distance, Scenes::plates, {platen}},
      {"gauge.ID.xx", "", Sort::history, Scenes::plates},
      {"gauge.ID.yy", "", Sort::history, Scenes::plates},
      {"gauge.ID.dilatancy", "", Sort::history, Scenes::plates},
      {"gauge.ID.arrival", "s", Sort::gauge_reading, Scenes::plates},
      {"gauge.ID.rise", "s", Sort::gauge_reading, Scenes::plates},
      {"gauge.ID.overshoot", "", Sort::gauge_reading, Scenes::plates},
      {"gauge.ID.plateau", "Pa", Sort::gauge_reading, Scenes::plates},
      {"gauge.ID.ratio", "", Sort::gauge_reading, Scenes::plates},
      {"gauge.ID.longitudinal", "Pa", Sort::gauge_reading, Scenes::plates},
      {"gauge.ID.lateral", "Pa", Sort::gauge_reading, Scenes::plates},
      {"gauge.ID.failure", "s", Sort::gauge_reading, Scenes::plates},
      {"gauge.ID.release", "s", Sort::gauge_reading, Scenes::plates},
      {"failure.speed", "m/s", Sort::failure, Scenes::plates},
      {"failure.delay", "s", Sort::failure, Scenes::plates},
      {"failure.slowing", "", Sort::failure, Scenes::plates},
      {"energy.drift", "", Sort::invariant, Scenes::both, {material, books}, true, drift},
      {"energy.lost", "", Sort::invariant, Scenes::both, {material, books}, true, lost},
      {"energy.dissipated", "", Sort::invariant, Scenes::plates, {books}, true, dissipated},
      {"energy.closure", "", Sort::invariant, Scenes::both, {material, books}, true, closure},
      {"energy.given-back", "", Sort::invariant, Scenes::both, {material, books}, true, given_back},
      {"energy.excess", "", Sort::invariant, Scenes::both, {material, books}, true, excess},
      {"momentum.drift", "", Sort::invariant, Scenes::both, {material, books}, true, momentum},
      {"bits.power-of-two", "", Sort::invariant, Scenes::both, {material, free_of_units}},
      {"bits.mirror", "", Sort::invariant, Scenes::both, {material, no_flyer, no_face}},
      {"bits.repeat", "", Sort::invariant, Scenes::both, {material}},
      {"bits.alone", "", Sort::invariant, Scenes::bars},
      {"bits.inviscid", "", Sort::invariant, Scenes::bars},
      {"bits.threads", "", Sort::invariant, Scenes::plates, {material}},
      {"bits.undamaged", "", Sort::invariant, Scenes::plates, {any_damage}},
      {"cross.fem-on-half-the-cells", "", Sort::invariant, Scenes::bars},
      {"cross.forward-euler", "", Sort::invariant, Scenes::plates, {spreading_damage}},
      {"numbers.largest", "", Sort::invariant, Scenes::plates},
      {"area.error", "", Sort::invariant, Scenes::plates, {material}},
      {"concentration.balance", "", Sort::invariant, Scenes::plates, {diffusion}},
      {"concentration.least", "", Sort::invariant, Scenes::plates, {diffusion}},
      {"dilatancy.ahead", "", Sort::invariant, Scenes::plates, {flyer}},
      {"impact.left-over", "", Sort::invariant, Scenes::plates, {flyer}},
      {"gauge.ID.prediction", "", Sort::invariant, Scenes::plates},
      {"critical_courant", "", Sort::limit, Scenes::both, {material}},
      {"stable", "", Sort::limit, Scenes::both, {}, true},
  };
  rows.insert(rows.end(), others.begin(), others.end());
  return rows;
}

/// One name, or one for each probe or gauge that ID stands for.
Names names_in(const Quantity& row, const Case& c) {
  if (!(row.scenes == Scenes::both || (row.scenes == Scenes::plates) == c.plate.has_value())) return {};
  if (row.sort == Sort::failure && c.gauges.size() < 2) return {};  // a speed needs two places
  const auto at = row.name.find("ID");
  if (at == std::string::npos) return {row.name};
  Names names;
  const auto add = [&](const std::string& id) { names.push_back(std::string(row.name).replace(at, 2, id)); };
  if (row.name.starts_with("gauge."))
    for (const GaugeSpec& gauge : c.gauges) add(gauge.id);
  else if (c.plate)
    for (const PlateProbe& probe : c.plate_probes) add(probe.id);
  else
    for (const Probe& probe : c.probes) add(probe.id);
  return names;
}

}  // namespace

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> rows = rows_of_table();
  return rows;
}

Names quantity_names(const Case& c, std::initializer_list<Sort> sorts) {
  Names names;
  for (const Quantity& row : quantities()) {
    if (std::find(sorts.begin(), sorts.end(), row.sort) == sorts.end()) continue;
    const Names some = names_in(row, c);
    names.insert(names.end(), some.begin(), some.end());
  }
  return names;
}

const Quantity* find_quantity(const std::string& name, const Case& c) {
  for (const Quantity& row : quantities())
    if (contains(names_in(row, c), name)) return &row;
  return nullptr;
}

void check_quantity(const Place& place, const std::string& name, const Case& c) {
  const Quantity* row = find_quantity(name, c);
  if (!row) return;
  for (const Quantity::Need need : row->needs)
    if (const auto lack = need(name, c)) place.refuse(words(name) + lack->found, lack->allowed);
}

}  // namespace diptych::runner
