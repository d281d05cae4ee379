#include "runner/judge/gates.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "runner/input/leaf.hpp"
#include "runner/judge/gate_kind.hpp"
#include "runner/judge/judging.hpp"

namespace diptych::runner {
namespace {

using reports::Check;
using reports::Gate;
using reports::Run;
using reports::Verdict;

/// The runs that the gate speaks of.
std::vector<JudgedRun> runs_judged(const Case& c, const Leaves& leaves, const GateSpec& gate,
                                   const std::vector<Run>& runs) {
  std::vector<JudgedRun> judged;
  for (const Run& run : runs) {
    const Leaf* leaf = leaves.of(run);
    if (!leaf) throw std::logic_error("run " + run.label() + " is not one of case " + c.id);
    if (matches(gate.where, *leaf)) judged.push_back({&run, *leaf});
  }
  return judged;
}

Verdict worst(Verdict a, Verdict b) { return std::max(a, b); }

}  // namespace

Gate judge(const Case& c, const Leaves& leaves, const GateSpec& gate, const std::vector<Run>& runs) {
  Gate result;
  result.case_id = c.id;
  result.id = gate.id;
  result.kind = gate.kind;
  result.quantity = gate.quantity;
  result.reason = gate.reason;
  result.line = gate.line;
  try {
    if (gate.criterion) gate.criterion->judge(c, gate, runs_judged(c, leaves, gate, runs), result);
  } catch (const Stop& stop) {
    result.verdict = stop.verdict;
    result.message = stop.message;
    return result;
  }
  if (result.checks.empty()) {
    result.message = "nothing was judged";
    return result;  // INVALID
  }
  result.verdict = Verdict::pass;
  for (const Check& check : result.checks) {
    if (check.passed) continue;
    if (result.verdict == Verdict::pass) {
      result.message = fmt::format("{}: {:.6g} is outside [{}, {}]", check.what, check.judged, check.low, check.high);
    }
    result.verdict = Verdict::fail;
  }
  return result;
}

Gate judge(const Case& c, const GateSpec& gate, const std::vector<Run>& runs) {
  return judge(c, Leaves(c), gate, runs);
}

std::string explanation(const Case& c, const Gate& gate) {
  std::string text = fmt::format(
      "{}/{}: {}\n  {}\n  case        {}\n  declared    {}:{}\n  kind        {}: {}\n  judged      {}\n  why so      "
      "{}\n",
      gate.case_id, gate.id, to_string(gate.verdict), gate.message.empty() ? "every check passed" : gate.message,
      c.title, c.path.string(), gate.line, gate.kind, gate_kind(gate.kind).says, gate.formula, gate.reason);
  for (const Check& check : gate.checks)
    text += fmt::format("  {} {:60} value {:12.6g}{} judged {:12.6g} in [{}, {}]\n", check.passed ? "ok  " : "FAIL",
                        check.what, check.value,
                        check.predicted ? fmt::format("  predicted {:12.6g}", *check.predicted) : "", check.judged,
                        check.low, check.high);
  if (gate.verdict == Verdict::pass) text += fmt::format("  headroom    {:.0f} %\n", 100 * gate.headroom());
  return text;
}

bool of_single_numbers(const GateSpec& gate) { return gate.criterion && gate.criterion->of_single_numbers(); }

bool all_made(const Case& c, const GateSpec& gate, const std::vector<Run>& runs) {
  const std::vector<JudgedRun> judged = runs_judged(c, Leaves(c), gate, runs);
  return std::none_of(judged.begin(), judged.end(),
                      [](const JudgedRun& one) { return one.run->status == "cancelled"; });
}

Summary sum_up(const std::vector<reports::Case>& cases, int declared, int left_out) {
  Summary outcome;
  outcome.declared = declared;
  outcome.left_out = left_out;
  Verdict verdict = Verdict::pass;
  for (const auto& c : cases) {
    for (const Gate& gate : c.gates) {
      ++outcome.judged;
      if (gate.verdict == Verdict::pass) ++outcome.passed;
      verdict = worst(verdict, gate.verdict);
    }
  }
  if (outcome.judged == 0 || outcome.judged != declared) verdict = Verdict::invalid;
  outcome.verdict = reports::to_string(verdict);
  switch (verdict) {
    case Verdict::pass: outcome.exit_code = all_passed; break;
    case Verdict::fail: outcome.exit_code = some_failed; break;
    case Verdict::unstable:
    case Verdict::error: outcome.exit_code = unstable_or_error; break;
    case Verdict::invalid: outcome.exit_code = invalid; break;
  }
  return outcome;
}

}  // namespace diptych::runner
