#include <algorithm>
#include <stdexcept>

#include "runner/judge/gate_kind.hpp"

namespace diptych::runner {

// Each stands in a file of its name.
GateKind exact_gate(), constant_gate(), order_gate(), invariant_gate(), limit_gate(), agreement_gate(), settling_gate();

Registry<GateKind>& all_gate_kinds() {
  static Registry<GateKind> rows(
      {
          exact_gate(),
          constant_gate(),
          order_gate(),
          invariant_gate(),
          limit_gate(),
          agreement_gate(),
          settling_gate(),
      },
      "a kind of gate");
  return rows;
}

bool GateKind::takes(const Case& c) const { return scenes == Scenes::all || c.plate.has_value(); }

bool GateKind::has(const std::string& key, const std::string& quantity) const {
  return std::any_of(keys.begin(), keys.end(), [&](const GateKey& one) {
    return one.name == key &&
           (one.of.empty() || std::any_of(one.of.begin(), one.of.end(),
                                          [&](const std::string& begin) { return quantity.starts_with(begin); }));
  });
}

std::vector<const GateKind*> gate_kinds(const Case& c) {
  std::vector<const GateKind*> kinds;
  for (const GateKind& kind : all_gate_kinds())
    if (kind.takes(c)) kinds.push_back(&kind);
  return kinds;
}

const GateKind& gate_kind(const std::string& id) {
  if (const GateKind* found = all_gate_kinds().find(id)) return *found;
  throw std::invalid_argument("no kind of gate is called '" + id + "'");
}

}  // namespace diptych::runner
