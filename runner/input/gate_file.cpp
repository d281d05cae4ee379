// [[gate]] of a case file.
#include <algorithm>

#include "runner/input/case_tables.hpp"

namespace diptych::runner {
namespace {

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

}  // namespace

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

}  // namespace diptych::runner
