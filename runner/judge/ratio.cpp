#include "runner/judge/ratio.hpp"

#include <fmt/core.h>

#include <cmath>

#include "runner/judge/judging.hpp"
#include "runner/judge/readings.hpp"

namespace diptych::runner {

std::array<double, 2> read_ratio(Table& t) {
  constexpr double widest = 10;
  const std::array<double, 2> ratio = t.need("ratio", interval(positive()));
  if (ratio[1] > widest * ratio[0])
    t.place("ratio").refuse(words(std::vector{ratio[0], ratio[1]}),
                            "[least, most], most at most " + words(widest) + " times the least");
  return ratio;
}

void RatioCriterion::judge(const Case& c, const GateSpec& gate, const std::vector<JudgedRun>& runs,
                           reports::Gate& result) const {
  const auto readings = read(c, gate, runs, theory);
  result.formula = fmt::format("{} / predicted by {} within [{}, {}]", gate.quantity, theory, ratio[0], ratio[1]);
  for (const Reading& r : readings) {
    if (!r.predicted) not_judged(fmt::format("{}: {} has no prediction for {}", r.what, theory, gate.quantity));
    // A right prediction of round-off says nothing, and an error of exactly nothing is a comparison with oneself.
    if (r.value == 0 || !(std::abs(*r.predicted) > floor_of_noise))
      not_judged(fmt::format("{}: {} = {:g} against {:g} is at the floor of round-off", r.what, gate.quantity, r.value,
                             *r.predicted));
    hold(result, {r.what, r.value, r.predicted, ratio[0], ratio[1], r.value / *r.predicted, false});
  }
}

}  // namespace diptych::runner
