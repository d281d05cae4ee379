// Gates of kind "constant": an error, or another number, over what the theory of the scheme predicts of it.
#include <memory>

#include "runner/compare/quantities.hpp"
#include "runner/input/toml_table.hpp"
#include "runner/judge/ratio.hpp"
#include "runner/judge/theories.hpp"

namespace diptych::runner {
namespace {

using Sort = Quantity::Sort;

Names quantities_of_constant(const Case& c) {
  if (c.plate) return quantity_names(c, {Sort::error_norm, Sort::gauge_reading});
  return quantity_names(c, {Sort::error_norm, Sort::probe, Sort::outcome});
}

void read_constant(Table& t, const Case& c, GateSpec& gate) {
  RatioCriterion measured;
  measured.theory = t.need("predict", one_of(theories(c)));
  measured.ratio = read_ratio(t);
  const Place predict = t.place("predict");
  const bool of_scheme = measured.theory == "impact-lattice" || (c.plate && measured.theory == "mode");
  if (of_scheme) check_scheme_theory(predict, measured.theory, gate, c);
  check_theory(predict, measured.theory, gate, c);
  gate.criterion = std::make_shared<RatioCriterion>(measured);
}

}  // namespace

GateKind constant_gate() {
  return {.id = "constant",
          .says = "what is measured over what theory predicts of it lies in a band",
          .keys = {{"times"}, {"predict"}, {"ratio"}},
          .quantities = quantities_of_constant,
          .read = read_constant};
}

}  // namespace diptych::runner
