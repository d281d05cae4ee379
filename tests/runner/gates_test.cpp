// The judge judged: every way of passing while checking nothing must end in INVALID.
#include "runner/judge/gates.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "runner/app/case_file.hpp"
#include "runner/input/leaf.hpp"
#include "runner/judge/limit.hpp"
#include "runner/judge/order.hpp"
#include "runner/run/runner.hpp"
#include "tests/case_text.hpp"
#include "tests/criteria.hpp"

namespace gates {

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;
using reports::Verdict;

namespace {

const std::string text = head("t", "code-verification", "paper") + pulled_bar + R"toml([[axes]]
method = ["fem"]
cells = [50, 100, 200, 400]
courant = [0.5]
[sample]
times = { unit = "L/c", at = [0.5] }
)toml" + gate("order", "order", "displacement.L2", "expect = 1.0\nband = [0.9, 1.1]\n") +
                         gate("small", "exact", "displacement.L2", "max = 0.1\n") +
                         gate("constant", "constant", "stress.L2",
                              "where = { cells = [200, 400] }\npredict = \"discrete-step\"\nratio = [0.98, 1.02]\n");

struct Fixture {
  Case c = parse_case(text, "t.toml");
  std::vector<reports::Run> runs;
  Fixture() {
    for (const Leaf& leaf : leaves(c)) runs.push_back(run_leaf(c, leaf));
  }
  reports::Gate judged(std::size_t gate) { return judge(c, c.gates[gate], runs); }
  reports::FieldError& error(std::size_t run, const std::string& field) {
    for (auto& e : runs[run].samples[0].errors) {
      if (e.field == field) return e;
    }
    throw std::logic_error("no such field");
  }
};

}  // namespace

}  // namespace gates

BOOST_FIXTURE_TEST_SUITE(gates, gates::Fixture)

BOOST_AUTO_TEST_CASE(a_right_solver_passes) {
  for (std::size_t g = 0; g < c.gates.size(); ++g) {
    const auto gate = judged(g);
    BOOST_TEST((gate.verdict == Verdict::pass), gate.id << ": " << gate.message);
    BOOST_TEST(!gate.checks.empty());
    BOOST_TEST(gate.headroom() > 0);
  }
}

BOOST_AUTO_TEST_CASE(nan_is_invalid_and_never_a_pass) {
  error(1, "displacement").l2 = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST((judged(0).verdict == Verdict::invalid));
  BOOST_TEST((judged(1).verdict == Verdict::invalid));
}

BOOST_AUTO_TEST_CASE(all_nan_is_invalid) {
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (auto& e : runs[r].samples[0].errors) e.l1 = e.l2 = e.linf = std::numeric_limits<double>::quiet_NaN();
  }
  for (std::size_t g = 0; g < 3; ++g) BOOST_TEST((judged(g).verdict == Verdict::invalid));
}

BOOST_AUTO_TEST_CASE(no_run_to_judge_is_invalid) {
  c.gates[1].where.cells = {77};
  BOOST_TEST((judged(1).verdict == Verdict::invalid));
}

BOOST_AUTO_TEST_CASE(too_few_meshes_are_invalid) {
  c.gates[0].where.cells = {50, 100, 200};
  BOOST_TEST((judged(0).verdict == Verdict::invalid));
}

BOOST_AUTO_TEST_CASE(two_meshes_that_are_secretly_one_are_invalid) {
  runs[1].cell_size = runs[0].cell_size;
  BOOST_TEST((judged(0).verdict == Verdict::invalid));
}

BOOST_AUTO_TEST_CASE(a_missing_sample_is_invalid) {
  runs[2].samples.clear();
  BOOST_TEST((judged(1).verdict == Verdict::invalid));
}

BOOST_AUTO_TEST_CASE(a_run_that_cannot_be_judged_is_invalid) {
  runs[0].invalid = "active features are not the declared";
  BOOST_TEST((judged(1).verdict == Verdict::invalid));
}

BOOST_AUTO_TEST_CASE(the_order_keeps_its_sign) {
  for (std::size_t r = 0; r < 4; ++r) error(r, "displacement").l2 = 1e-3 * std::pow(2.0, static_cast<double>(r));
  const auto gate = judged(0);
  BOOST_TEST((gate.verdict == Verdict::fail));
  BOOST_TEST(gate.checks[0].value < 0);
}

BOOST_AUTO_TEST_CASE(an_order_that_is_too_high_fails_too) {
  for (std::size_t r = 0; r < 4; ++r) error(r, "displacement").l2 = 1e-3 * std::pow(4.0, -static_cast<double>(r));
  BOOST_TEST((judged(0).verdict == Verdict::fail));
}

BOOST_AUTO_TEST_CASE(errors_at_the_floor_of_round_off_have_no_order) {
  for (std::size_t r = 0; r < 4; ++r) error(r, "displacement").l2 = 1e-15 * std::pow(2.0, -static_cast<double>(r));
  BOOST_TEST((judged(0).verdict == Verdict::invalid));
}

BOOST_AUTO_TEST_CASE(saturated_errors_have_no_order) {
  for (std::size_t r = 0; r < 4; ++r) error(r, "displacement").l2 = 0.9 * std::pow(2.0, -static_cast<double>(r));
  BOOST_TEST((judged(0).verdict == Verdict::invalid));
}

BOOST_AUTO_TEST_CASE(errors_on_no_line_have_no_order_even_if_their_slope_is_right) {
  const double off[] = {5, 0.2, 0.2, 5};  // these leave the fitted slope alone
  for (std::size_t r = 0; r < 4; ++r)
    error(r, "displacement").l2 = 1e-2 * off[r] * std::pow(2.0, -static_cast<double>(r));
  BOOST_TEST((judged(0).verdict == Verdict::invalid));
}

BOOST_AUTO_TEST_CASE(an_expected_order_against_theory_is_invalid) {
  auto& order = change_criterion<OrderCriterion>(c.gates[0]);
  order.expect = 2.0;
  order.band = {0.9, 2.1};
  BOOST_TEST((judged(0).verdict == Verdict::invalid));
}

BOOST_AUTO_TEST_CASE(a_constant_without_a_prediction_is_invalid) {
  for (auto& run : runs) {
    for (auto& e : run.samples[0].errors) e.predicted_l2.reset();
  }
  BOOST_TEST((judged(2).verdict == Verdict::invalid));
}

BOOST_AUTO_TEST_CASE(an_error_of_exactly_nothing_has_no_constant) {
  for (std::size_t r = 0; r < 4; ++r) error(r, "stress").l2 = 0;
  BOOST_TEST((judged(2).verdict == Verdict::invalid));
}

BOOST_AUTO_TEST_CASE(a_run_that_blew_up_is_unstable_and_one_that_crashed_an_error) {
  runs[0].status = "unstable";
  BOOST_TEST((judged(1).verdict == Verdict::unstable));
  runs[0].status = "error";
  BOOST_TEST((judged(1).verdict == Verdict::error));
  runs[0].status = "cancelled";
  BOOST_TEST((judged(1).verdict == Verdict::error));
}

BOOST_AUTO_TEST_CASE(exit_status_is_zero_only_if_every_declared_gate_was_judged_and_passed) {
  reports::Case result;
  for (std::size_t g = 0; g < c.gates.size(); ++g) result.gates.push_back(judged(g));
  BOOST_TEST(sum_up({result}, 3, 0).exit_code == 0);
  BOOST_TEST(sum_up({result}, 4, 0).exit_code == 13);  // a gate was lost
  BOOST_TEST(sum_up({}, 0, 0).exit_code == 13);        // nothing at all is no success
  result.gates[0].verdict = Verdict::fail;
  BOOST_TEST(sum_up({result}, 3, 0).exit_code == 10);
  result.gates[1].verdict = Verdict::unstable;
  BOOST_TEST(sum_up({result}, 3, 0).exit_code == 12);
  result.gates[2].verdict = Verdict::invalid;  // a later verdict never hides an earlier one
  BOOST_TEST(sum_up({result}, 3, 0).exit_code == 13);
}

BOOST_AUTO_TEST_CASE(a_blow_up_that_does_not_happen_fails) {
  GateSpec gate;
  gate.id = "detected";
  gate.kind = "limit";
  gate.quantity = "stable";
  replace_criterion<BlowUpCriterion>(gate);
  BOOST_TEST((judge(c, gate, runs).verdict == Verdict::fail));
  for (auto& run : runs) run.status = "unstable";
  BOOST_TEST((judge(c, gate, runs).verdict == Verdict::pass));
}

BOOST_AUTO_TEST_SUITE_END()
