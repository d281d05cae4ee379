// The schema of a bar's tables as the program reads it: one function per table, top to bottom as in cases/README.md.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "analytic/bar_solutions.hpp"
#include "runner/input/case_checks.hpp"
#include "runner/input/case_tables.hpp"
#include "runner/input/toml_table.hpp"

namespace diptych::runner {
namespace {

const Names time_units{"s", "L/c"};

std::string read_expression(Table& t, const std::string& key, const Names& variables, const Case& c) {
  const std::string expression = t.get(key, formula());
  check_expression(t.place(key), expression, variables, c);
  return expression;
}

material::Material read_elastic_bar(Table&, double E, double rho) { return material::Elastic{E, rho}; }

material::Material read_hardening(Table& t, double E, double rho) {
  const double E_t = t.need("E_t", not_negative()), yield_stress = t.need("yield_stress", positive());
  if (E > 0 && E_t >= E) t.place("E_t").refuse(words(E_t), "0 <= E_t < E = " + words(E));
  return material::Hardening{E, rho, E_t, yield_stress};
}

/// A model of [material]: its keys beside E and rho, and how they are read.
struct Model {
  std::string name;
  Names keys;
  material::Material (*read)(Table&, double E, double rho);
};

const std::vector<Model> models{
    {material::Elastic::model, {}, read_elastic_bar},
    {material::Hardening::model, {"E_t", "yield_stress"}, read_hardening},
};

/// Those that have the key.
Names models_with(const std::string& key) {
  Names names;
  for (const Model& model : models)
    if (key == "model" || contains(model.keys, key)) names.push_back(model.name);
  return names;
}

material::Material read_material(Table& t) {
  const std::string chosen = t.need("model", one_of(models_with("model")));
  const double E = t.need("E", positive()), rho = t.need("rho", positive());
  material::Material material = material::Elastic{E, rho};
  for (const Model& model : models) {
    for (const std::string& key : model.keys) t.applies(key, "model", chosen, models_with(key));
    if (model.name == chosen) material = model.read(t, E, rho);
  }
  const double speed = material::wave_speed(material);
  if (E > 0 && rho > 0 && (!std::isfinite(speed) || speed <= 0))
    t.place("E").say("found E = " + words(E) + " and rho = " + words(rho) + ", whose wave speed sqrt(E/rho) is " +
                     words(speed) + "; allowed: a finite wave speed > 0");
  return material;
}

std::function<void(Table&)> read_parameters_of(Case& c) {
  return [&c](Table& t) { read_parameters(t, c); };
}

void read_bar(Table& t, Case& c, const std::optional<material::Material>& common, std::vector<Place>& velocities) {
  BarSpec bar;
  bar.length = t.need("length", positive());
  if (t.has("displacements")) t.place("displacements").say("found it in [bar]; allowed: in [model], for all bars");
  if (t.has("material"))
    t.table("material", [&](Table& m) { bar.material = read_material(m); });
  else if (common)
    bar.material = *common;
  if (c.bars.empty() && t.has("gap"))
    t.place("gap").say("found a gap before the first bar; allowed: gaps before the others");
  if (!c.bars.empty()) bar.gap = t.get("gap", with_unit({"m", "L", "cells"}, not_negative()), bar.gap);
  if (!t.has("material") && !common)
    t.place("material").say("missing; allowed: a material of its own, or one [material] for all bars without");
  c.bars.push_back(bar);
  c.bars.back().velocity = t.get("velocity", constant_formula());
  velocities.push_back(t.place("velocity"));
}

/// Gives the places of the velocities, which can be tried only when the axes are known.
std::vector<Place> read_bars(Table& file, Case& c) {
  std::vector<Place> velocities;
  std::optional<material::Material> common;
  file.maybe_table("material", [&](Table& t) { common = read_material(t); });
  file.maybe_table("parameters", read_parameters_of(c));
  c.bars.clear();
  file.one_or_each("bar", [&](Table& t) { read_bar(t, c, common, velocities); });
  if (c.bars.empty()) c.bars.resize(1);  // its own mistake; what follows still asks for one
  return velocities;
}

void read_viscosity(Table& t, Case& c) {
  material::Viscosity v;
  const std::string form = t.need("form", one_of({"york", "linear-quadratic"}));
  const bool york = form != "linear-quadratic";
  v.form = york ? material::Viscosity::Form::york : material::Viscosity::Form::linear_quadratic;
  ViscositySpec spec;
  for (const auto& [key, formula] : {std::pair{"c1", &spec.c1}, {"c2", &spec.c2}}) {
    *formula = t.must(key, constant_formula()).value_or("0");
    if (check_constant(t.place(key), *formula, c))
      check_not_negative(t.place(key), *formula, c);
    else
      *formula = "0";
  }
  if (t.applies("bulk", "form", form, {"york"})) v.bulk = t.get("bulk", positive(), v.bulk);
  if (t.applies("length", "form", form, {"york"})) v.length = t.get("length", positive(), v.length);
  v.always = t.get("acts", one_of({"compression", "always"})) == "always";
  spec.form = v;
  c.viscosity = spec;
}

void read_supports(Table& t, Case& c) {
  const auto support = [&](const char* end) {
    return t.need(end, one_of({"fixed", "free"})) == "fixed" ? Support::fixed : Support::free;
  };
  c.left = support("left");
  c.right = support("right");
}

Probe read_bar_probe(Table& t, const Case& c) {
  Probe probe;
  probe.id = t.need("id", id());
  probe.field = t.need("field", one_of(fields));
  probe.at = t.need("at", with_unit({"m", "L", "cells"}, not_negative()));
  const std::string unit = ' ' + probe.at.unit;
  const double length = bar_in(probe.at.unit, c);
  if (c.bars.size() == 1 && length > 0 && probe.at.value > length)
    t.place("at").refuse(words(probe.at.value) + unit + ", outside the bar", "0 to " + words(length) + unit);
  return probe;
}

void read_sample(Table& t, Case& c, bool bars_are_read) {
  const std::string allowed = "times = { unit = \"L/c\", at = [0.5, 1.7] }, units " + joined(time_units);
  const Place times = t.place("times");
  if (!times.node)
    times.say("missing; allowed: " + allowed);
  else if (times.node->as<Node::List>() || times.node->is_number())
    times.refuse("times without a unit", allowed);
  else if (!times.node->as<Node::Entries>())
    times.refuse_value(allowed);
  else
    t.table("times", [&](Table& s) {
      c.time_unit = s.need("unit", one_of(time_units));
      c.from_contact = s.get("from", one_of({"start", "contact"})) == "contact";
      if (c.from_contact && bars_are_read) check_contact(s.place("from"), c);
      c.times = s.need("at", list_of(c.from_contact ? any_number() : positive()));
      if (c.from_contact && bars_are_read) check_times(s.place("at"), c);
      if (ascending(c.times)) return;
      s.place("at").refuse(words(c.times), "times in ascending order, each once");
      c.times.clear();
    });
  c.probes = read_each<Probe>(t, "probes", c, read_bar_probe);
  if (!bars_are_read || c.bars.size() == 1) return;
  std::size_t i = 0;
  t.each("probes", [&](Table& p) {
    p.place("id"), p.place("field");
    check_in_some_bar(p.place("at"), c.probes[i++].at, c);
  });
}

LoadSpec read_load(Table& t, const Case& c) {
  LoadSpec load;
  const std::string end = t.need("at", one_of({"left", "right"}));
  load.end = end == "left" ? End::left : End::right;
  if (!end.empty() && (end == "left" ? c.left : c.right) == Support::fixed)
    t.place("at").refuse("a load on the " + end + " end, which is fixed", "loads on free ends");

  load.history = t.need("history", one_of({"step", "ramp", "impulse", "expression"}));
  const Place traction = t.place("traction");
  if (load.history == "expression") {
    load.expression = t.need("traction", formula());
    check_expression(traction, load.expression, {"t"}, c);
  } else if (!load.history.empty()) {
    load.traction = t.need("traction", any_number("a formula of t needs history = \"expression\""));
  }
  if (t.applies("start", "history", load.history, {"step", "ramp", "impulse"}))
    load.start = t.get("start", with_unit(time_units, not_negative()), load.start);
  if (t.applies("rise", "history", load.history, {"ramp"}))
    load.rise = t.need("rise", with_unit(time_units, positive()));
  if (t.applies("duration", "history", load.history, {"impulse"}))
    load.duration = t.need("duration", with_unit(time_units, positive()));

  const std::string transfer = t.get("transfer", one_of({"node", "boundary-layer"}), "node");
  if (t.applies("thickness", "transfer", transfer, {"boundary-layer"})) {
    load.transfer = Transfer::boundary_layer;
    const Measured h = load.layer_thickness = t.need("thickness", with_unit({"cells", "m", "L"}, positive()));
    const double length = bar_in(h.unit, c);
    if (length > 0 && h.value > length)
      t.place("thickness").refuse(words(h.value) + ' ' + h.unit, "at most the bar, " + words(length) + ' ' + h.unit);
  }
  return load;
}

void read_initial(Table& t, Case& c) {
  c.initial_velocity = read_expression(t, "velocity", {"x"}, c);
  c.initial_stress = read_expression(t, "stress", {"x"}, c);
  if (!t.has("velocity") && !t.has("stress")) t.say("found no field; allowed: velocity, stress");
  const bool moving =
      std::any_of(c.bars.begin(), c.bars.end(), [](const BarSpec& bar) { return !bar.velocity.empty(); });
  if (moving && t.has("velocity"))
    t.place("velocity").say("found beside the velocity of a bar; allowed: either bar.velocity or initial.velocity");
}

void read_solution(Table& t, Case& c) {
  ExactSpec& exact = c.exact;
  Names solutions;
  for (const analytic::BarSolution& row : analytic::bar_solutions()) solutions.push_back(row.name);
  solutions.push_back("expressions");
  exact.solution = t.need("solution", one_of(solutions, "without an exact solution leave out the whole table [exact]"));
  const auto of = [&](const char* key, const char* owner) {
    return t.applies(key, "solution", exact.solution, {owner});
  };
  exact.parameters = read_solution_parameters(t, exact.solution, analytic::bar_solutions());
  const auto formula_of = [&](const char* key) {
    return of(key, "expressions") ? read_expression(t, key, {"x", "t"}, c) : "";
  };
  exact.stress = formula_of("stress");
  exact.velocity = formula_of("velocity");
  exact.displacement = formula_of("displacement");
  if (exact.solution == "expressions" && !t.has("stress") && !t.has("velocity") && !t.has("displacement"))
    t.place("solution")
        .say(
            "found \"expressions\" without one; allowed: at least one of the keys stress, velocity, "
            "displacement");
}

}  // namespace

void read_bar_case(Table& file, Case& c) {
  const auto with = [&c](void (*read)(Table&, Case&)) { return [&c, read](Table& t) { read(t, c); }; };
  std::size_t before = file.mistakes();
  const std::vector<Place> velocities = read_bars(file, c);

  bool bars_are_read = file.mistakes() == before;
  const std::vector<AxesBlock> blocks = read_all_axes(file, c, methods_of(c), {{0.5}});
  for (std::size_t b = 0; b < velocities.size(); ++b) {
    if (check_constant(velocities[b], c.bars[b].velocity, c)) continue;
    c.bars[b].velocity.clear();
    bars_are_read = false;
  }
  before = file.mistakes();
  if (bars_are_read) {
    check_bars(file.place("bar"), c);
    check_approach(file.place("bar"), c);
  }
  bars_are_read = bars_are_read && file.mistakes() == before;
  file.table("sample", [&](Table& t) { read_sample(t, c, bars_are_read); });
  file.table("supports", with(read_supports));

  before = file.mistakes();
  std::set<std::string> loaded;
  file.each("load", [&](Table& t) {
    c.loads.push_back(read_load(t, c));
    const Place at = t.place("at");
    const auto* end = at.node ? at.node->as<std::string>() : nullptr;
    if (end && !loaded.insert(*end).second) at.refuse("a second load on the " + *end + " end", "one load on each end");
  });
  const bool loads_are_read = file.mistakes() == before;
  file.maybe_table("body_force", [&](Table& t) {
    c.body_force = t.need("acceleration", formula());
    check_expression(t.place("acceleration"), c.body_force, {"x", "t"}, c);
    if (c.body_force.empty()) c.body_force = "0";  // refused already; the scene still asks for one
  });
  file.maybe_table("initial", with(read_initial));
  file.maybe_table("viscosity", with(read_viscosity));
  file.maybe_table("contact", [&](Table& t) {
    c.contact = t.need("fem", one_of({"node-to-node", "bonded"})) == "bonded" ? Contact::bonded : Contact::node_to_node;
    if (c.bars.size() == 1) t.say("found a contact of one bar; allowed: with two bars or more");
  });
  file.table("model", [&](Table& t) {
    c.convected = t.get("displacements", one_of({"infinitesimal", "finite"})) == "finite";
    Names known;
    material::for_each_law([&]<class Law>() {
      if (!contains(known, Law::feature)) known.push_back(Law::feature);
    });
    for (const char* more : {"body-force", "boundary-layer", "contact", "convection", "viscosity"})
      known.push_back(more);
    c.features = t.need("features", set_of(one_of(known)));
    if (!c.changed.empty() && bars_are_read) {
      c.features.clear();
      for (const auto& used : features_in_use(c)) c.features.push_back(used.first);
    }
    std::sort(c.features.begin(), c.features.end());
    if (bars_are_read) check_features(t.place("features"), c);
  });
  file.maybe_table("exact", [&](Table& t) {
    read_solution(t, c);
    if (loads_are_read && bars_are_read) check_solution(t.place("solution"), c);
  });
  for (const AxesBlock& block : blocks) {
    check_methods(block.method, block.axes, c);
    if (!c.axes.empty() && bars_are_read) check_steps(block.courant, block.axes, c);
  }
}

}  // namespace diptych::runner
