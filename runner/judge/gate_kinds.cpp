#include <algorithm>
#include <deque>
#include <stdexcept>
#include <utility>

#include "runner/judge/gate_kind.hpp"

namespace diptych::runner {

// Each stands in a file of its name.
GateKind exact_gate(), constant_gate(), order_gate(), invariant_gate(), limit_gate(), agreement_gate(), settling_gate();

namespace {

/// A deque, so that a row stays where it is when another one is added.
std::deque<GateKind>& table() {
  static std::deque<GateKind> rows{exact_gate(), constant_gate(),  order_gate(),   invariant_gate(),
                                   limit_gate(), agreement_gate(), settling_gate()};
  return rows;
}

auto row(const std::string& id) {
  return std::find_if(table().begin(), table().end(), [&](const GateKind& kind) { return kind.id == id; });
}

}  // namespace

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
  for (const GateKind& kind : table())
    if (kind.takes(c)) kinds.push_back(&kind);
  return kinds;
}

const GateKind& gate_kind(const std::string& id) {
  const auto found = row(id);
  if (found == table().end()) throw std::invalid_argument("no kind of gate is called '" + id + "'");
  return *found;
}

AddedGateKind::AddedGateKind(GateKind added) : id_(added.id) {
  if (row(id_) != table().end()) throw std::invalid_argument("there is a kind of gate '" + id_ + "' already");
  table().push_back(std::move(added));
}

AddedGateKind::~AddedGateKind() { table().erase(row(id_)); }

}  // namespace diptych::runner
