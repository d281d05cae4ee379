// Gates of kind "limit": the Courant number up to which runs stay bounded, and that those above it are seen to blow up.
#include "runner/judge/limit.hpp"

#include <fmt/core.h>

#include <memory>

#include "runner/compare/quantities.hpp"
#include "runner/input/toml_table.hpp"
#include "runner/judge/judging.hpp"
#include "runner/judge/ratio.hpp"
#include "runner/judge/theories.hpp"

namespace diptych::runner {
namespace {

Names quantities_of_limit(const Case& c) { return quantity_names(c, {Quantity::Sort::limit}); }

void read_limit(Table& t, const Case& c, GateSpec& gate) {
  const auto of = [&](const char* key, const char* quantity) {
    return t.applies(key, "quantity", gate.quantity, {quantity});
  };
  RatioCriterion bisected;
  bisected.of_limit = true;
  if (of("predict", "critical_courant")) bisected.theory = t.need("predict", one_of({"stability-limit"}));
  if (of("ratio", "critical_courant")) bisected.ratio = read_ratio(t);
  const bool of_outcome = of("outcome", "stable");
  const bool completes = of_outcome && t.need("outcome", one_of({"unstable", "completed"})) == "completed";
  gate.steps = t.get("steps", whole(1, 1'000'000'000), static_cast<int>(gate.steps));
  if (!bisected.theory.empty()) check_scheme_theory(t.place("predict"), bisected.theory, gate, c);
  if (of_outcome)
    gate.criterion = std::make_shared<BlowUpCriterion>(completes);
  else
    gate.criterion = std::make_shared<RatioCriterion>(bisected);
}

/// One leaf has one critical Courant number.
void check_limits(const Place& place, const Case& c) {
  const GateSpec* first = nullptr;
  for (const GateSpec& gate : c.gates) {
    if (gate.quantity != "critical_courant") continue;
    if (first && first->steps != gate.steps)
      place.say(fmt::format("found steps = {} in {} and {} in {}; allowed: the same for every gate on critical_courant",
                            first->steps, words(first->id), gate.steps, words(gate.id)));
    if (!first) first = &gate;
  }
}

}  // namespace

void BlowUpCriterion::judge(const Case&, const GateSpec&, const std::vector<JudgedRun>& runs,
                            reports::Gate& result) const {
  result.formula = completes_ ? "the run is not unstable" : "the run is detected as unstable";
  for (const JudgedRun& judged : runs) {
    const reports::Run& run = *judged.run;
    if (run.status != "unstable" && run.status != "completed") {
      throw Stop{reports::Verdict::error, run.label() + ": " + run.status + ": " + run.message};
    }
    const double seen = (run.status == "completed") == completes_ ? 1 : 0;
    hold(result,
         {fmt::format("{}: {} after {} steps", run.label(), run.status, run.steps), seen, 1.0, 1, 1, seen, false});
  }
}

GateKind limit_gate() {
  return {.id = "limit",
          .says = "runs stay bounded up to the Courant number that theory gives, and blow up above it",
          .keys = {{"predict"}, {"ratio"}, {"outcome"}, {"steps"}},
          .quantities = quantities_of_limit,
          .read = read_limit,
          .check_all = check_limits};
}

}  // namespace diptych::runner
