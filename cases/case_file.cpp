// The schema of case files as the program reads it: one function per table, top to bottom as in cases/README.md.
#include "cases/case_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>
#include <system_error>

#include "cases/case_tables.hpp"
#include "cases/expression.hpp"
#include "cases/leaf.hpp"
#include "cases/plate_build.hpp"
#include "cases/toml_table.hpp"

namespace diptych::cases {

Rule<std::string> formula() { return text("an expression in quotes"); }

Rule<Measured> with_unit(const Names& units, const Rule<double>& number) {
  const std::string allowed =
      fmt::format("a value with its unit, {{ value = ..., unit = {} }}, units {}", words(units.front()), joined(units));
  return {[=](const Place& place) -> std::optional<Measured> {
            if (!place.node->as<Node::Entries>())
              return place.refuse(words(*place.node) + (place.node->is_number() ? " without a unit" : ""), allowed);
            Table t(place, place.label + '.');
            const std::string unit = t.need("unit", one_of(units));
            const auto value = t.must("value", number);
            t.refuse_other_keys();
            return value && !unit.empty() ? std::optional(Measured{*value, unit}) : std::nullopt;
          },
          "; allowed: " + allowed};
}

Rule<std::string> constant_formula() {
  return {[](const Place& place) -> std::optional<std::string> {
    if (place.node->is_number()) {
      const auto value = any_number().read(place);
      return value ? std::optional(words(*value)) : std::nullopt;
    }
    return text("a number, or an expression of parameters in quotes").read(place);
  }};
}

void read_parameters(Table& t, Case& c) {
  Names reserved{"L", "E", "rho", "c", "pi", "x", "t", "_e", "_pi"};
  if (c.plate) reserved.insert(reserved.end(), {"Lx", "Ly", "nu", "c_d", "c_s", "y"});
  reserved.insert(reserved.end(), function_names().begin(), function_names().end());
  for (const auto& [name, at, value] : t.entries()) {
    const bool is_name =
        !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
        name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == std::string::npos;
    const bool is_free = !contains(reserved, name);
    if (!is_name)
      t.place(name).say("found " + words(name) + " as a name; allowed: letters, digits and _, no digit first");
    else if (!is_free)
      t.place(name).say(
          fmt::format("found a name that expressions have already; allowed: other names than {}", listed(reserved)));
    const double number = t.get(name, any_number(), 0.7);
    if (is_name && is_free) c.parameters[name] = number;
  }
}

namespace {

// ---- rules of this schema -------------------------------------------------------------------------------------------

const Names time_units{"s", "L/c"};

Rule<int> number_of_cells() { return whole(1, 10'000'000); }

/// The particles of one cell: natural coordinates in [0, 1], ascending, or their number n, which puts them at
/// (2i - 1)/(2n).
Rule<std::vector<double>> particles() {
  return {[](const Place& place) -> std::optional<std::vector<double>> {
    constexpr int most = 1000;
    std::vector<double> xi;
    if (const auto* n = place.node->as<std::int64_t>(); n && *n >= 1 && *n <= most) {
      for (int i = 1; i <= *n; ++i) xi.push_back((2 * i - 1) / (2.0 * static_cast<double>(*n)));
      return xi;
    }
    const auto* list = place.node->as<Node::List>();
    if (!list || list->empty() || list->size() > most)
      return place.refuse_value(
          "a number of particles from 1 to 1000, or a list of natural coordinates in [0, 1], ascending");
    for (const Node& one : *list) {
      const auto value = one.number();
      constexpr double round_off = 1e-12;  // a particle 1e-18 outside its cell is on the cell's face
      if (!value || !(*value >= -round_off && *value <= 1 + round_off))
        return place.entry(xi.size()).refuse_value("natural coordinates of the cell, from 0 to 1");
      xi.push_back(std::clamp(*value, 0.0, 1.0));
    }
    if (ascending(xi)) return xi;
    return place.refuse(words(xi), "natural coordinates in ascending order, each once");
  }};
}

/// What a gate of this kind judges.
Rule<std::string> quantity(const std::string& kind, const Case& c) {
  const Names allowed = quantities_of(kind, c);
  return {[&kind, &c, allowed](const Place& place) -> std::optional<std::string> {
            const auto name = text().read(place);
            if (!name || kind.empty()) return {};
            if (contains(allowed, *name)) return name;
            for (const char* other : {"exact", "order", "invariant", "limit", "agreement"})
              if (contains(quantities_of(other, c), *name))
                return place.refuse(words(*name) + ", which is not for kind = " + words(kind), joined(allowed));
            const bool probe = name->starts_with("probe.");
            return place.refuse(words(*name), joined(allowed) + (probe ? " (probes are declared in [sample])" : ""),
                                suggestion(*name, allowed));
          },
          "; allowed: " + joined(allowed)};
}

/// Notes each of `values` that is not among `all`; an empty `all` has been reported already.
template <class Value>
bool among(const Place& place, const std::vector<Value>& values, const std::vector<Value>& all,
           const std::string& where) {
  bool good = true;
  for (const Value& value : values) {
    if (all.empty() || std::find(all.begin(), all.end(), value) != all.end()) continue;
    place.refuse(words(value), "values of " + where + ": " + joined(all));
    good = false;
  }
  return good;
}

std::string read_expression(Table& t, const std::string& key, const Names& variables, const Case& c) {
  const std::string expression = t.get(key, formula());
  check_expression(t.place(key), expression, variables, c);
  return expression;
}

/// The times of a gate or figure, all of them sampled.
std::vector<double> read_times(Table& t, const Case& c) {
  const auto times = t.get("times", set_of(any_number()));
  among(t.place("times"), times, c.times, "sample.times.at");
  if (ascending(times)) return times;
  t.place("times").refuse(words(times), "times in ascending order");
  return {};
}

// ---- one function per table -----------------------------------------------------------------------------------------

material::Material read_material(Table& t) {
  const std::string model = t.need("model", one_of({"elastic", "hardening"}));
  const double E = t.need("E", positive()), rho = t.need("rho", positive());
  material::Material material = material::Elastic{E, rho};
  const bool hardens = t.applies("E_t", "model", model, {"hardening"});
  if (t.applies("yield_stress", "model", model, {"hardening"}) && hardens) {
    const double E_t = t.need("E_t", not_negative()), yield_stress = t.need("yield_stress", positive());
    if (E > 0 && E_t >= E) t.place("E_t").refuse(words(E_t), "0 <= E_t < E = " + words(E));
    material = material::Hardening{E, rho, E_t, yield_stress};
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

Probe read_probe(Table& t, const Case& c) {
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
  c.probes = read_each<Probe>(t, "probes", c, read_probe);
  if (!bars_are_read || c.bars.size() == 1) return;
  std::size_t i = 0;
  t.each("probes", [&](Table& p) {
    p.place("id"), p.place("field");
    check_in_some_bar(p.place("at"), c.probes[i++].at, c);
  });
}

/// Values of parameters, { v0 = [0.1, 1.0] } or { v0 = 1.0 }.
std::map<std::string, std::vector<double>> read_values(Table& t, const Case& c) {
  std::map<std::string, std::vector<double>> values;
  Names known;
  for (const auto& [name, value] : c.parameters) known.push_back(name);
  for (const auto& entry : t.entries()) {
    if (c.parameters.contains(entry.key))
      values[entry.key] = t.get(entry.key, one_or_set_of(any_number()));
    else
      t.place(entry.key).refuse("no such parameter",
                                known.empty() ? "names of [parameters], of which there are none" : joined(known),
                                suggestion(entry.key, known));
  }
  return values;
}

Axes read_axes(Table& t, const Case& c, const Names& known_methods,
               const std::vector<std::vector<double>>& usual_particles) {
  Axes axes;
  axes.particles = usual_particles;
  axes.method = t.need("method", set_of(one_of(known_methods)));
  axes.cells = t.need("cells", set_of(number_of_cells()));
  axes.courant =
      t.need("courant",
             set_of(positive("the time step is courant * cell size / wave speed, and a time step of 0 gets nowhere")));
  axes.particles = t.get("particles", set_of(particles()), axes.particles);
  t.maybe_table("parameters", [&](Table& p) { axes.parameters = read_values(p, c); });
  if (c.plate) axes.variant = t.get("variant", set_of(one_of(variants_of(c))), axes.variant);
  return axes;
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

void read_exact(Table& t, Case& c) {
  ExactSpec& exact = c.exact;
  exact.solution = t.need("solution", one_of({"bar-wave", "standing-mode", "impact", "plastic-impact", "expressions"},
                                             "without an exact solution leave out the whole table [exact]"));
  const auto of = [&](const char* key, const char* owner) {
    return t.applies(key, "solution", exact.solution, {owner});
  };
  if (of("mode", "standing-mode")) exact.mode = t.need("mode", whole(1, 1000));
  if (of("amplitude", "standing-mode")) exact.amplitude = t.need("amplitude", not_zero());
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

/// Notes each parameter that is not swept and each value that no run has.
bool among_swept(const Place& place, const std::map<std::string, std::vector<double>>& parameters, const Case& c) {
  if (c.axes.empty()) return true;  // reported already
  const Axes axes = all_axes(c);
  Names names;
  for (const auto& entry : axes.parameters) names.push_back(entry.first);
  bool good = true;
  for (const auto& [name, values] : parameters) {
    const auto swept = axes.parameters.find(name);
    if (swept != axes.parameters.end()) {
      good &= among(place, values, swept->second, "axes.parameters." + name);
      continue;
    }
    place.refuse(words(name) + ", which is not swept", names.empty() ? "no parameters here: no [axes] sweeps one"
                                                                     : "those that [axes] sweep: " + joined(names));
    good = false;
  }
  return good;
}

Where read_where(Table& t, const Case& c) {
  Where where;
  where.method = t.get("method", one_or_set_of(one_of(methods_of(c))));
  where.cells = t.get("cells", one_or_set_of(number_of_cells()));
  where.courant = t.get("courant", one_or_set_of(positive()));
  if (const Node* node = t.place("particles").node) {
    // [0.25, 0.75] is the one set of these two positions, [[0.25, 0.75], [0.5]] and [2, 1] are two sets.
    const auto* list = node->as<Node::List>();
    const bool one_set = !list || (!list->empty() && list->front().as<double>());
    if (!one_set)
      where.particles = t.get("particles", set_of(particles()));
    else if (const auto set = t.maybe("particles", particles()))
      where.particles = {*set};
  }
  t.maybe_table("parameters", [&](Table& p) { where.parameters = read_values(p, c); });
  if (c.plate) where.variant = t.get("variant", one_or_set_of(one_of(variants_of(c))));
  const Axes axes = all_axes(c);
  among(t.place("method"), where.method, axes.method, "axes.method");
  among(t.place("cells"), where.cells, axes.cells, "axes.cells");
  among(t.place("courant"), where.courant, axes.courant, "axes.courant");
  among(t.place("particles"), where.particles, axes.particles, "axes.particles");
  among_swept(t.place("parameters"), where.parameters, c);
  return where;
}

GateSpec read_gate(Table& t, const Case& c) {
  GateSpec gate;
  gate.line = static_cast<int>(t.line());
  gate.declaration = t.declaration();
  gate.id = t.need("id", id());
  if (!gate.id.empty()) t.rename("gate " + words(gate.id) + ": ");
  Names known_kinds{"exact", "constant", "order", "invariant", "limit"};
  if (c.plate) known_kinds.insert(known_kinds.end(), {"agreement", "settling"});
  gate.kind = t.need("kind", one_of(known_kinds));
  gate.reason = t.need("reason", text());
  gate.slow = t.get("slow", flag());
  gate.quantity = t.need("quantity", quantity(gate.kind, c));
  const std::size_t before = t.mistakes();
  t.maybe_table("where", [&](Table& where) { gate.where = read_where(where, c); });
  const bool where_is_read = t.mistakes() == before;

  const auto of = [&](const char* key, const Names& kinds) { return t.applies(key, "kind", gate.kind, kinds); };
  const auto of_limit = [&](const char* key, const char* quantity) {
    return t.applies(key, "quantity", gate.quantity, {quantity});
  };
  const bool limit = gate.kind == "limit";
  const bool settles = gate.kind == "settling" && gate.quantity.starts_with("probe.");
  if (of("times", settles ? Names{"settling"} : Names{"exact", "constant", "order", "invariant", "agreement"}))
    gate.times = read_times(t, c);
  const bool parts_alone = gate.kind == "agreement" && t.has("apart") && !t.has("max");
  if (of("max", {"exact", "invariant", "agreement", "settling"}) && !parts_alone)
    gate.max = t.must("max", not_negative());
  if (c.plate && of("judged", settles ? Names{"agreement", "settling"} : Names{"agreement"})) {
    gate.judged = t.need("judged", set_of(number_of_cells()));
    among(t.place("judged"), gate.judged, all_axes(c).cells, "axes.cells");
  }
  if (c.plate && of("apart", {"agreement"})) {
    gate.apart = t.get("apart", list_of(positive()));
    if (!gate.apart.empty() && gate.apart.size() != gate.judged.size())
      t.place("apart").refuse(words(gate.apart), "one part for each mesh of judged, " + listed(gate.judged));
  }
  if (c.plate && of("shrinks", {"agreement"})) gate.shrinks = t.get("shrinks", flag(), true);
  if (c.plate && t.applies("level", "quantity", gate.quantity, {"contour.distance"}))
    gate.level = t.need("level", positive());
  if (of("predict", {"constant", "limit"}) && (!limit || of_limit("predict", "critical_courant")))
    gate.predict = t.need("predict", one_of(limit ? Names{"stability-limit"} : theories(c)));
  if (of("ratio", {"constant", "limit"}) && (!limit || of_limit("ratio", "critical_courant")))
    gate.ratio = t.must("ratio", interval(positive()));
  if (of("outcome", {"limit"}) && of_limit("outcome", "stable")) gate.outcome = t.need("outcome", one_of({"unstable"}));
  if (of("steps", {"limit"})) gate.steps = t.get("steps", whole(1, 1'000'000'000), static_cast<int>(gate.steps));
  const bool probe = gate.quantity.starts_with("probe.") || gate.quantity.starts_with("gauge.") ||
                     gate.quantity.starts_with("failure.");  // what else would be exact about it
  if (of("expect", probe ? Names{"order", "exact"} : Names{"order"})) gate.expect = t.must("expect", any_number());
  if (of("band", {"order"})) gate.band = t.must("band", interval());
  if (of("over", {"order"})) gate.over_time_step = t.get("over", one_of({"cells", "courant"})) == "courant";
  if (of("levels_min", {"order"})) gate.levels_min = t.get("levels_min", whole(3, 100), gate.levels_min);
  check_gate(t, gate, c);
  if (!c.axes.empty() && where_is_read) check_where(t.place("where"), gate, c);
  return gate;
}

/// What figures and pages of gauges have for themselves.
void read_gauge_figure(Table& t, FigureSpec& figure, const Case& c) {
  const auto of = [&](const char* key, const Names& kinds) { return t.applies(key, "kind", figure.kind, kinds); };
  Names gauges, figures;
  for (const GaugeSpec& gauge : c.gauges) gauges.push_back(gauge.id);
  if (of("gauges", {"gauges"})) figure.gauges = t.get("gauges", set_of(one_of(gauges)), gauges);
  if (of("variants", {"gauges"})) figure.variants = t.get("variants", set_of(one_of(variants_of(c))), {""});
  if (of("components", {"gauges"}))
    figure.components = t.need("components", set_of(one_of({"longitudinal", "lateral"})));
  if (of("time_range", {"gauges"})) figure.time_range = t.maybe("time_range", interval());
  if (of("bands", {"gauges"}))
    t.each("bands", [&](Table& b) {
      SpeedBand band;
      band.label = b.need("label", text());
      const auto speed = b.need("speed", one_or_set_of(positive()));  // one speed, or from the least to the largest
      if (!speed.empty()) band.speed = {speed.front(), speed.back()};
      if (speed.size() > 2 || !ascending(speed)) b.place("speed").refuse(words(speed), "one speed, or [least, most]");
      band.delay = b.get("delay", interval(not_negative()), {0, 0});
      figure.bands.push_back(band);
    });
  if (of("sections", {"failure"}))
    t.each("sections", [&](Table& s) {
      PageSection section;
      section.heading = s.need("heading", text());
      section.says = s.need("says", text());
      section.variants = s.need("variants", set_of(one_of(variants_of(c))));
      figure.sections.push_back(section);
    });
  if (of("pictures", {"failure"})) figure.pictures = t.get("pictures", set_of(id()));
  // What draws or tabulates histories of gauges needs them: a variant that keeps its flyer.
  const auto struck = [&](const Place& place, const Names& names) {
    for (const PlateVariant& variant : c.variants)
      if (contains(names, variant.id) && !variant.plate.flyer)
        place.refuse(words(variant.id) + ", a variant without a flyer", "variants with [flyer]");
  };
  struck(t.place("variants"), figure.variants);
  if (contains({"gauges", "failure"}, figure.kind) && gauges.empty())
    t.place("kind").refuse(words(figure.kind) + " without a gauge", "with sample.gauges");
}

FigureSpec read_figure(Table& t, const Case& c) {
  FigureSpec figure;
  figure.id = t.need("id", id());
  if (!figure.id.empty()) t.rename("figure " + words(figure.id) + ": ");
  figure.title = t.get("title", text());
  figure.kind = t.get("kind", one_of(figure_kinds(c)), figure_kinds(c).front());
  const auto of = [&](const char* key, const Names& kinds) { return t.applies(key, "kind", figure.kind, kinds); };
  if (c.plate) {
    if (of("field", {"contours", "choices"}))
      figure.field = t.get("field", one_of({"crack-density", "damage"}), "crack-density");
    if (of("levels", {"contours", "choices"})) figure.levels = t.need("levels", set_of(positive()));
    Names swept, probes, largest;
    for (const auto& entry : all_axes(c).parameters) swept.push_back(entry.first);
    for (const PlateProbe& probe : c.plate_probes) {
      probes.push_back(probe.id);
      if (probe.reads == "largest") largest.push_back(probe.id);
    }
    if (of("over", {"rupture"})) figure.over = t.need("over", one_of(swept));
    if (of("probe", {"rupture"})) figure.probe = t.need("probe", one_of(largest));
    if (of("probes", {"convergence"})) figure.probes = t.need("probes", set_of(one_of(probes)));
    if (of("variant", {"convergence", "rupture"})) figure.variant = t.get("variant", one_of(variants_of(c)));
    read_gauge_figure(t, figure, c);
  } else if (of("field", {"profiles"})) {
    figure.field = t.get("field", one_of(fields), figure.field);
  }
  if (of("times", {"profiles", "contours", "choices", "convergence", "rupture"})) figure.times = read_times(t, c);
  if (figure.kind == "convergence" && figure.times.size() != 1)
    t.place("times").refuse(listed(figure.times), "one time of sample.times.at");
  if (of("captions", {"profiles"})) figure.captions = t.get("captions", list_of(text()));
  if (of("magnify", {"motion"})) figure.magnify = t.get("magnify", positive(), figure.magnify);
  if (of("zoom", {"motion"})) {
    t.maybe_table("zoom", [&](Table& z) { figure.zoom = Zoom{z.need("x", interval()), z.need("t", interval())}; });
  }
  const std::size_t instants = figure.times.empty() ? c.times.size() : figure.times.size();
  if (!figure.captions.empty() && instants > 0 && figure.captions.size() != instants)
    t.place("captions")
        .refuse(fmt::format("{} captions", figure.captions.size()),
                fmt::format("one for each of the {} times", instants));

  // An axis with one value need not be named again.
  const Axes axes = all_axes(c);
  const auto one_of_axis = [&](const char* key, const auto& rule, const auto& axis) {
    if (t.has(key) || axis.size() > 1) return t.need(key, rule);
    return axis.empty() ? std::decay_t<decltype(axis[0])>{} : axis[0];  // empty: the axes' own mistake
  };
  const Names of_all{"convergence", "rupture"};
  const bool of_all_meshes = contains(of_all, figure.kind);
  Names of_one_mesh = figure_kinds(c);
  std::erase_if(of_one_mesh, [&](const std::string& kind) { return contains(of_all, kind); });
  if (of("cells", of_one_mesh)) figure.cells = one_of_axis("cells", number_of_cells(), axes.cells);
  figure.choices = t.get("choices", text());
  figure.methods = t.get("methods", set_of(one_of(methods_of(c))), axes.method);
  const std::size_t before = t.mistakes();
  if (const Node* courant = t.place("courant").node; courant && courant->as<Node::Entries>()) {
    // { fem = 1.0, mpm-musl = 0.1 }: one for each method that is drawn
    t.table("courant", [&](Table& each) {
      for (const std::string& method : figure.methods)
        figure.courants[method] = figure.courant = each.need(method, positive());
      for (const auto& entry : each.entries()) {
        const Place place = each.place(entry.key);
        if (!figure.methods.empty() && !contains(figure.methods, entry.key))
          place.refuse("a method that is not drawn", joined(figure.methods), suggestion(entry.key, figure.methods));
      }
    });
  } else {
    figure.courant = one_of_axis("courant", positive(), axes.courant);
  }
  const bool one_set = t.has("particles") || axes.particles.size() == 1;
  if (one_set) figure.particles = one_of_axis("particles", particles(), axes.particles);
  if (of("range", {"profiles", "contours", "gauges"})) figure.range = t.maybe("range", interval());
  t.maybe_table("parameters", [&](Table& p) {
    const auto given = read_values(p, c);
    among_swept(t.place("parameters"), given, c);
    for (const auto& [name, values] : given) {
      figure.parameters[name] = values.empty() ? 0 : values.front();
      if (values.size() > 1) p.place(name).refuse(words(values), "one value, for the runs to draw");
    }
  });
  for (const auto& [name, values] : axes.parameters) {
    if (figure.parameters.contains(name) || name == figure.over) continue;
    if (values.size() > 1)
      t.place("parameters")
          .say("missing " + words(name) + ", which is swept; allowed: one value of it, " + joined(values));
    else
      figure.parameters[name] = values.front();
  }

  bool good =
      (figure.cells > 0 || of_all_meshes) && figure.courant > 0 && !figure.particles.empty() && t.mistakes() == before;
  if (figure.cells > 0) good &= among(t.place("cells"), std::vector{figure.cells}, axes.cells, "axes.cells");
  for (const std::string& method : figure.methods) {
    if (figure.courant_of(method) > 0)
      good &= among(t.place("courant"), std::vector{figure.courant_of(method)}, axes.courant, "axes.courant");
  }
  good &= among(t.place("methods"), figure.methods, axes.method, "axes.method");
  if (!figure.particles.empty() && figure.methods != Names{"fem"})
    good &= among(t.place("particles"), std::vector<std::vector<double>>{figure.particles}, axes.particles,
                  "axes.particles");
  const std::vector<Leaf> runs = leaves(c);
  if (contains({"problem", "convergence", "rupture", "agreement", "gauges", "failure"}, figure.kind))
    return figure;  // of no run, or of many
  for (const std::string& method : figure.methods) {
    const Leaf leaf{method, figure.cells, figure.courant_of(method),
                    method.starts_with("mpm") ? figure.particles : std::vector<double>{}, figure.parameters};
    if (good && !runs.empty() && std::find(runs.begin(), runs.end(), leaf) == runs.end())
      t.place("methods").refuse(
          fmt::format("{} with cells = {}, courant = {}{}{}", words(method), leaf.cells, words(leaf.courant),
                      leaf.particles.empty() ? "" : ", particles = " + words(leaf.particles),
                      leaf.parameters.empty() ? "" : ", " + parameters_label(leaf.parameters)),
          "a run of the axes");
  }
  return figure;
}

}  // namespace

std::vector<AxesBlock> read_all_axes(Table& file, Case& c, const Names& known_methods,
                                     const std::vector<std::vector<double>>& usual_particles) {
  std::vector<AxesBlock> blocks;
  const std::size_t before = file.mistakes();
  file.one_or_each("axes", [&](Table& t) {
    blocks.push_back({read_axes(t, c, known_methods, usual_particles), t.place("method"), t.place("courant")});
  });
  if (file.mistakes() == before)  // nothing is compared with axes that are not known
    for (const AxesBlock& block : blocks) c.axes.push_back(block.axes);
  return blocks;
}

void read_judgement(Table& file, Case& c) {
  file.maybe_table("run", [&](Table& t) {
    c.allow_unstable = t.get("allow_unstable", flag(), false);
    c.ledger = t.get("ledger", flag(), true);
  });
  c.gates = read_each<GateSpec>(file, "gate", c, read_gate);
  c.figures = read_each<FigureSpec>(file, "figure", c, read_figure);
  Names drawn;
  for (const FigureSpec& figure : c.figures)
    if (figure.kind == "gauges") drawn.push_back(figure.id);
  for (const FigureSpec& figure : c.figures)
    for (const std::string& picture : figure.pictures)
      if (!contains(drawn, picture))
        file.place("figure").say("found " + words(picture) + " among the pictures of " + words(figure.id) +
                                 "; allowed: figures of kind gauges of this case, " + joined(drawn));

  if (c.gates.empty())
    file.place("gate").say("missing; a case with no gate is an error; allowed: at least one [[gate]]");
  check_gates(file.place("gate"), c);
}

namespace {

Case read_file(Table& file) {
  Case c;
  const auto with = [&c](void (*read)(Table&, Case&)) { return [&c, read](Table& t) { read(t, c); }; };
  file.need("schema", whole(1, 1));
  c.scene = file.declaration({"schema", "id", "title", "claim", "why", "paper", "gate", "figure"});
  c.id = file.need("id", id());
  c.title = file.need("title", text());
  c.claim = file.need("claim", one_of({"code-verification", "solution-verification", "cross-code", "regression",
                                       "robustness", "performance"}));
  c.why = file.need("why", text());
  c.units = file.need("units", one_of({"SI", "paper"}));
  file.maybe_table("paper", [&](Table& t) { c.paper_figures = t.need("figures", set_of(text())); });
  if (file.has("plate")) {
    read_plate_case(file, c);
    return c;
  }
  std::size_t before = file.mistakes();
  const std::vector<Place> velocities = read_bars(file, c);

  bool bars_are_read = file.mistakes() == before;
  const std::vector<AxesBlock> blocks = read_all_axes(file, c, methods, {{0.5}});
  for (std::size_t b = 0; b < velocities.size(); ++b) {
    if (check_constant(velocities[b], c.bars[b].velocity, c)) continue;
    c.bars[b].velocity.clear();
    bars_are_read = false;
  }
  if (bars_are_read) check_bars(file.place("bar"), c);
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
    c.features = t.need("features", set_of(one_of({"elastic", "plasticity", "body-force", "boundary-layer", "contact",
                                                   "convection", "viscosity"})));
    std::sort(c.features.begin(), c.features.end());
    if (bars_are_read) check_features(t.place("features"), c);
  });
  file.maybe_table("exact", [&](Table& t) {
    read_exact(t, c);
    if (loads_are_read && bars_are_read) check_solution(t.place("solution"), c);
  });
  read_judgement(file, c);
  for (const AxesBlock& block : blocks) {
    check_methods(block.method, block.axes, c);
    if (!c.axes.empty() && bars_are_read) check_steps(block.courant, block.axes, c);
  }
  return c;
}

}  // namespace

std::map<std::string, double> expression_constants(const Case& c) {
  if (c.plate) return plate_constants(c);
  std::map<std::string, double> constants = c.parameters;
  constants["L"] = c.first().length;
  constants["E"] = material::youngs_modulus(c.first().material);
  constants["rho"] = material::density(c.first().material);
  constants["c"] = material::wave_speed(c.first().material);
  constants["pi"] = std::numbers::pi;
  return constants;
}

Case parse_case(const std::string& text, const std::filesystem::path& name) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw InputError(name.string() + ":1:1: found an empty file; allowed: a case, see cases/README.md");
  Case c;
  read_toml(text, name.string(), [&](Table& file) { c = read_file(file); });
  c.path = name;
  return c;
}

Case read_case(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& reason) { throw InputError(path.string() + ": cannot be read: " + reason); };
  std::error_code status;
  if (std::filesystem::is_directory(path, status)) fail("it is a directory; allowed: a case file (*.toml)");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(std::generic_category().message(errno));
  std::ostringstream text;
  text << in.rdbuf();
  if (in.bad()) fail(std::generic_category().message(errno));
  return parse_case(text.str(), path);
}

}  // namespace diptych::cases
