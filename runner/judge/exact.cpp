// Gates of kind "exact": what an exact solution says, and what is known otherwise of a probe.
#include <cmath>
#include <memory>

#include "runner/compare/quantities.hpp"
#include "runner/input/toml_table.hpp"
#include "runner/judge/bound.hpp"

namespace diptych::runner {
namespace {

using Sort = Quantity::Sort;

constexpr double widest_tolerance = 1e12;  ///< of a number whose size nobody has told

Names quantities_of_exact(const Case& c) {
  return quantity_names(c, {Sort::error_norm, Sort::probe, Sort::outcome, Sort::gauge_reading, Sort::failure});
}

void read_exact(Table& t, const Case& c, GateSpec& gate) {
  BoundCriterion bound;
  const Quantity* quantity = find_quantity(gate.quantity, c);
  const auto is = [&](Sort sort) { return quantity && quantity->sort == sort; };
  if (is(Sort::probe) || is(Sort::gauge_reading) || is(Sort::failure))
    bound.expect = t.must("expect", any_number());  // what else would be exact about it
  if (is(Sort::error_norm))
    bound.max = read_tolerance(t, "max", 1, "the scale of the field");
  else if (bound.expect && *bound.expect != 0)
    bound.max = read_tolerance(t, "max", std::abs(*bound.expect), "the size of what is expected");
  else
    bound.max = read_tolerance(t, "max", widest_tolerance, "beyond which nothing is bounded");
  gate.criterion = std::make_shared<BoundCriterion>(bound);
}

}  // namespace

GateKind exact_gate() {
  return {.id = "exact",
          .says = "the error against the exact solution, or a number less what it must be, is at most so large",
          .keys = {{"times"}, {"max"}, {"expect", {"probe.", "gauge.", "failure."}}},
          .quantities = quantities_of_exact,
          .read = read_exact};
}

}  // namespace diptych::runner
