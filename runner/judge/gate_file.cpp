#include "runner/judge/gate_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "runner/compare/quantities.hpp"
#include "runner/input/case_tables.hpp"
#include "runner/input/toml_table.hpp"
#include "runner/judge/gate_kind.hpp"

namespace diptych::runner {
namespace {

/// What a gate of this kind judges.
Rule<std::string> quantity(const std::string& kind, const Case& c) {
  if (kind.empty()) return {[](const Place&) -> std::optional<std::string> { return {}; }};  // reported already
  const Names allowed = gate_kind(kind).quantities(c);
  return {[&kind, &c, allowed](const Place& place) -> std::optional<std::string> {
            const auto name = text().read(place);
            if (!name) return {};
            if (contains(allowed, *name)) return name;
            for (const GateKind* other : gate_kinds(c))
              if (contains(other->quantities(c), *name))
                return place.refuse(words(*name) + ", which is not for kind = " + words(kind), joined(allowed));
            const bool probe = name->starts_with("probe.");
            return place.refuse(words(*name), joined(allowed) + (probe ? " (probes are declared in [sample])" : ""),
                                suggestion(*name, allowed));
          },
          "; allowed: " + joined(allowed)};
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

/// Each value that `where` names must be met by some run of the gate, or it would be judged on less than it says.
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

/// Notes each key that belongs to other kinds of gates of this scene.
void refuse_keys_of_other_gates(Table& t, const GateSpec& gate, const Case& c) {
  std::map<std::string, Names> owners;
  for (const GateKind* kind : gate_kinds(c)) {
    for (const GateKey& key : kind->keys) {
      Names& kinds = owners[key.name];
      if (kind->has(key.name, gate.quantity)) kinds.push_back(kind->id);
    }
  }
  for (const auto& [key, kinds] : owners) t.applies(key, "kind", gate.kind, kinds);
}

}  // namespace

GateSpec read_gate(Table& t, const Case& c) {
  GateSpec gate;
  gate.line = static_cast<int>(t.line());
  gate.declaration = t.declaration();
  gate.id = t.need("id", id());
  if (!gate.id.empty()) t.rename("gate " + words(gate.id) + ": ");
  Names kinds;
  for (const GateKind* kind : gate_kinds(c)) kinds.push_back(kind->id);
  gate.kind = t.need("kind", one_of(kinds));
  gate.reason = t.need("reason", text());
  gate.slow = t.get("slow", flag());
  gate.quantity = t.need("quantity", quantity(gate.kind, c));
  const std::size_t before = t.mistakes();
  t.maybe_table("where", [&](Table& where) { gate.where = read_where(where, c); });
  const bool where_is_read = t.mistakes() == before;

  refuse_keys_of_other_gates(t, gate, c);
  if (!gate.kind.empty()) {
    const GateKind& kind = gate_kind(gate.kind);
    if (kind.has("times", gate.quantity)) gate.times = read_times(t, c);
    check_quantity(t.place("quantity"), gate.quantity, c);
    kind.read(t, c, gate);
  }
  if (!c.axes.empty() && where_is_read) check_where(t.place("where"), gate, c);
  return gate;
}

void check_gates(const Place& place, const Case& c) {
  for (const GateKind* kind : gate_kinds(c)) {
    const auto is_one = [&](const GateSpec& gate) { return gate.kind == kind->id; };
    if (kind->check_all && std::any_of(c.gates.begin(), c.gates.end(), is_one)) kind->check_all(place, c);
  }
}

}  // namespace diptych::runner
