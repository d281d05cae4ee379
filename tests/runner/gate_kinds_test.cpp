// Kinds of gates are rows of one table: one more is read, checked, judged and explained by what its row says.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <memory>
#include <stdexcept>

#include "runner/app/case_file.hpp"
#include "runner/compare/quantities.hpp"
#include "runner/input/toml_table.hpp"
#include "runner/judge/gate_kind.hpp"
#include "runner/judge/gates.hpp"
#include "runner/judge/judging.hpp"
#include "runner/judge/readings.hpp"
#include "tests/case_text.hpp"
#include "tests/criteria.hpp"
#include "tests/made_runs.hpp"
#include "tests/messages.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(gate_kinds)

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;

namespace {

// ---- a kind of its own ----------------------------------------------------------------------------------------------

/// What a quantity spans over all runs is at most `most`, a tenth unless it says otherwise.
struct SpanCriterion : Criterion {
  double most = 0.1;

  void judge(const Case& c, const GateSpec& gate, const std::vector<JudgedRun>& runs,
             reports::Gate& result) const override {
    const auto readings = read(c, gate, runs);
    result.formula = "span of " + gate.quantity;
    const auto [least, largest] = std::minmax_element(
        readings.begin(), readings.end(), [](const Reading& a, const Reading& b) { return a.value < b.value; });
    const double span = largest->value - least->value;
    hold(result, {"all runs", span, {}, -most, most, span, false});
  }
};

GateKind span_gate() {
  return {.id = "span",
          .says = "what a number spans over all runs",
          .keys = {{"most"}},
          .quantities = [](const Case& c) { return quantity_names(c, {Quantity::Sort::invariant}); },
          .read =
              [](Table& t, const Case& c, GateSpec& gate) {
                SpanCriterion span;
                span.most = t.get("most", positive(), span.most);
                if (span.most > 1 && c.bars.size() == 1)
                  t.place("most").refuse(words(span.most), "at most 1 of one bar");
                gate.criterion = std::make_shared<SpanCriterion>(span);
              },
          .check_all =
              [](const Place& gates, const Case& c) {
                if (c.gates.size() > 2) gates.say("found many gates; allowed: two beside a span");
              }};
}

const std::string usual = gate("books", "invariant", "energy.closure", "max = 1e-9\n");
const std::string spanning = gate("wide", "span", "energy.drift", "most = 0.25\n");

std::string bar(const std::string& gates) {
  return head("t", "code-verification") + pulled_bar + axes({"fem"}, "10, 20", "0.5") +
         R"([sample]
times = { unit = "L/c", at = [0.5] }
)" + gates;
}

std::string refusal(const std::string& text) {
  return message_of<InputError>([&] { parse_case(text, "t.toml"); });
}

std::vector<reports::Run> runs_with(double first, double second) {
  std::vector<reports::Run> runs{made_run("fem", 10, 0.5), made_run("fem", 20, 0.5)};
  runs[0].measures["energy.drift"] = first;
  runs[1].measures["energy.drift"] = second;
  return runs;
}

void check_refused(const std::string& text, const std::vector<std::string>& parts) {
  const std::string said = refusal(text);
  BOOST_TEST(holds_all(said, parts), said);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_kind_that_no_row_has_is_refused) {
  check_refused(bar(usual + spanning), {"gate \"wide\": kind", "\"span\"", "\"exact\", \"constant\", \"order\""});
  BOOST_CHECK_THROW(gate_kind("span"), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(one_more_is_read_by_its_own_keys) {
  const AddedGateKind added(span_gate());
  BOOST_REQUIRE_EQUAL(refusal(bar(usual + spanning)), "");
  const Case c = parse_case(bar(usual + spanning), "t.toml");
  BOOST_TEST((c.gates[1].kind == "span" && c.gates[1].reason == "r" && c.gates[1].quantity == "energy.drift"));
  BOOST_TEST(criterion<SpanCriterion>(c.gates[1]).most == 0.25);
  const Case usually = parse_case(bar(usual + without(spanning, {"most ="})), "t.toml");
  BOOST_TEST(criterion<SpanCriterion>(usually.gates[1]).most == 0.1);
  BOOST_CHECK_THROW(AddedGateKind twice(span_gate()), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(its_mistakes_are_told_as_those_of_the_others) {
  const AddedGateKind added(span_gate());
  const auto with = [](const std::string& from, const std::string& to) {
    return bar(usual + replaced(spanning, from, to));
  };
  check_refused(with("most", "mosst"), {"gate \"wide\": mosst", "unknown key", "did you mean \"most\"?"});
  check_refused(with("0.25", "-1"), {"gate \"wide\": most", "found -1", "> 0"});
  check_refused(with("0.25", "2"), {"gate \"wide\": most", "found 2", "at most 1 of one bar"});
  check_refused(with("\"span\"", "\"spam\""), {"gate \"wide\": kind", "did you mean \"span\"?"});
  check_refused(with("energy.drift", "energy.drit"), {"gate \"wide\": quantity", "did you mean \"energy.drift\"?"});
  check_refused(with("energy.drift", "stress.L2"), {"\"stress.L2\", which is not for kind = \"span\""});
  // Keys of other kinds, and its own in others.
  check_refused(with("most", "max"), {"gate \"wide\": max", "kind = \"span\"", "\"exact\", \"invariant\""});
  check_refused(bar(replaced(usual, "max", "most = 1\nmax") + spanning),
                {"gate \"books\": most", "kind = \"invariant\"", "with kind = \"span\""});
  check_refused(bar(usual + spanning + replaced(spanning, "wide", "other")), {"found many gates"});
}

BOOST_AUTO_TEST_CASE(it_is_judged_and_explained) {
  const AddedGateKind added(span_gate());
  const Case c = parse_case(bar(usual + spanning), "t.toml");
  const auto narrow = judge(c, c.gates[1], runs_with(0.5, 0.7)), wide = judge(c, c.gates[1], runs_with(0.5, 0.8));
  BOOST_TEST((narrow.verdict == reports::Verdict::pass), narrow.message);
  BOOST_TEST((wide.verdict == reports::Verdict::fail));
  BOOST_TEST(wide.message == "all runs: 0.3 is outside [-0.25, 0.25]");
  BOOST_TEST((!of_single_numbers(c.gates[1]) && of_single_numbers(c.gates[0])));
  auto lost = runs_with(0.5, 0.7);
  lost[1].measures.clear();
  BOOST_TEST((judge(c, c.gates[1], lost).verdict == reports::Verdict::invalid));
  lost[1].status = "unstable";
  BOOST_TEST((judge(c, c.gates[1], lost).verdict == reports::Verdict::unstable));

  const std::string text = explanation(c, wide);
  BOOST_TEST(holds_all(text, {"t/wide: FAIL", "kind        span: what a number spans over all runs",
                              "judged      span of energy.drift", "why so      r", "FAIL all runs", "[-0.25, 0.25]"}),
             text);
}

// Every row tells what it is, and its kinds of quantities are in the table.
BOOST_AUTO_TEST_CASE(rows_hold_what_they_need) {
  const Case c = parse_case(bar(usual), "t.toml");
  std::vector<std::string> ids;
  for (const GateKind* kind : runner::gate_kinds(c)) {
    ids.push_back(kind->id);
    BOOST_TEST((!kind->says.empty() && kind->read && !kind->quantities(c).empty()), kind->id);
    for (const std::string& name : kind->quantities(c)) BOOST_TEST(find_quantity(name, c), name);
  }
  BOOST_TEST((ids == std::vector<std::string>{"exact", "constant", "order", "invariant", "limit"}));
}

BOOST_AUTO_TEST_SUITE_END()
