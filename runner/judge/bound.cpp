#include "runner/judge/bound.hpp"

#include <fmt/core.h>

#include "runner/judge/judging.hpp"
#include "runner/judge/readings.hpp"

namespace diptych::runner {

double read_tolerance(Table& t, const std::string& key, double most, const std::string& of) {
  const double tolerance = t.need(key, not_negative());
  if (tolerance > most) t.place(key).refuse(words(tolerance), "0 to " + words(most) + ", " + of);
  return tolerance;
}

void BoundCriterion::judge(const Case& c, const GateSpec& gate, const std::vector<JudgedRun>& runs,
                           reports::Gate& result) const {
  const auto readings = read(c, gate, runs);
  result.formula = expect ? fmt::format("|{} − {:g}| ≤ {:g}", gate.quantity, *expect, max)
                          : fmt::format("|{}| ≤ {:g}", gate.quantity, max);
  const double from = expect.value_or(0);
  for (const Reading& r : readings) hold(result, {r.what, r.value, from, -max, max, r.value - from, false});
}

}  // namespace diptych::runner
