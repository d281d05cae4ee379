#include "runner/run/sharing.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <set>

#include "runner/run/curves.hpp"
#include "runner/run/instants.hpp"
#include "runner/run/measures.hpp"

namespace diptych::runner {

std::string words_of_run(const Case& c, const Leaf& leaf, const Running& running) {
  std::string words =
      fmt::format("{} {} {} [{}]", leaf.method, leaf.cells, leaf.courant, fmt::join(leaf.particles, " "));
  for (const auto& [name, value] : leaf.parameters) words += fmt::format(" {}={}", name, value);
  words += fmt::format("\nvariant {}\nchanged {}\n", leaf.variant, c.changed);
  for (const auto& [key, value] : c.scene)
    if (!key.starts_with("axes") && (!leaf.variant.empty() || !key.starts_with("variant")))
      words += key + " = " + value + "\n";
  std::set<std::string> asked;
  for (const GateSpec& gate : c.gates)
    if (takes_runs(gate.quantity) && matches(gate.where, leaf))
      asked.insert(fmt::format("{} {}", gate.quantity, gate.steps));
  words += fmt::format("asked {}\n", fmt::join(asked, " "));
  if (drawn(c, leaf, &Recorded::curves)) words += "curves\n";
  if (drawn(c, leaf, &Recorded::paths))
    for (const FigureSpec& figure : c.figures)
      if (figure.recorded.paths)
        words +=
            figure.recorded.closely ? fmt::format("paths {}\n", fmt::join(*figure.recorded.closely, " ")) : "paths\n";
  return words + fmt::format("kept {} {} {}", static_cast<int>(books_of(c, leaf, running.books)),
                             static_cast<int>(what_to_meet(c)), running.keep_fields);
}

}  // namespace diptych::runner
