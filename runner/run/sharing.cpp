#include "runner/run/sharing.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <set>

#include "runner/run/measures.hpp"

namespace diptych::runner {

std::optional<std::string> words_of_run(const Case& c, const Leaf& leaf, const Running& running) {
  if (kind_of(c) != SceneKind::plate || !leaf.variant.empty() || !c.changed.empty()) return {};
  std::string words = fmt::format("{} {} {} [{}] {}\n", leaf.method, leaf.cells, leaf.courant,
                                  fmt::join(leaf.particles, " "), parameters_label(leaf.parameters));
  for (const auto& [key, value] : c.scene)
    if (!key.starts_with("axes") && !key.starts_with("variant")) words += key + " = " + value + "\n";
  std::set<std::string> asked;
  for (const GateSpec& gate : c.gates)
    if (takes_runs(gate.quantity) && matches(gate.where, leaf))
      asked.insert(fmt::format("{} {}", gate.quantity, gate.steps));
  words += fmt::format("{}\n", fmt::join(asked, " "));
  return words + fmt::format("{} {} {}", static_cast<int>(books_of(c, leaf, running.books)),
                             static_cast<int>(what_to_meet(c)), running.keep_fields);
}

}  // namespace diptych::runner
