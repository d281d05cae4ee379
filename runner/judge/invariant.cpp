// Gates of kind "invariant": what is nothing where all is well, whatever the scene.
#include <memory>

#include "runner/compare/quantities.hpp"
#include "runner/input/toml_table.hpp"
#include "runner/judge/bound.hpp"

namespace diptych::runner {
namespace {

Names quantities_of_invariant(const Case& c) { return quantity_names(c, {Quantity::Sort::invariant}); }

void read_invariant(Table& t, const Case&, GateSpec& gate) {
  BoundCriterion bound;
  bound.max = read_tolerance(t, "max", 1, "all of what the part is taken of");
  gate.criterion = std::make_shared<BoundCriterion>(bound);
}

}  // namespace

GateKind invariant_gate() {
  return {.id = "invariant",
          .says = "what is nothing where all is well is at most so large",
          .keys = {{"times"}, {"max"}},
          .quantities = quantities_of_invariant,
          .read = read_invariant};
}

}  // namespace diptych::runner
