#include "reports/verdicts.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>

#include "tests/made_runs.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(verdicts)

using namespace diptych::reports;
using namespace diptych::tests;

namespace {

Gate gate(const std::string& id, const std::string& kind, Verdict verdict, std::vector<Check> checks = {}) {
  Gate g;
  g.case_id = "bar.one";
  g.id = id;
  g.kind = kind;
  g.verdict = verdict;
  g.message = "because";
  g.checks = std::move(checks);
  g.line = 17;
  return g;
}

Case judged(std::vector<Gate> gates, std::vector<std::string> features) {
  Case data;
  data.id = "bar.one";
  data.path = "cases/one.toml";
  data.gates = std::move(gates);
  Run run = made_run("fem", 10, 0.5);
  run.features = std::move(features);
  run.wall_seconds = 2;
  data.runs = {run, made_run("mpm-usl", 20, 0.5)};
  return data;
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_failed_is_told_by_its_worst_number) {
  const Check inside{"a", 1, {}, 0, 2, 1, true}, near{"b", 3, {}, 0, 2, 3, false}, far{"c", 9, {}, 0, 2, 9, false};
  const std::vector<Case> cases{judged(
      {gate("good", "exact", Verdict::pass, {inside}), gate("bad", "order", Verdict::fail, {inside, near, far, near})},
      {})};
  BOOST_TEST(failures_text(cases) ==
             "FAIL     bar.one/bad\n         c: 9 is not in [0, 2]\n         cases/one.toml:17\n");
}

BOOST_AUTO_TEST_CASE(a_number_that_is_none_is_worse_than_any) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const Check none{"none", nan, {}, 0, 2, nan, false}, far{"far", 1e9, {}, 0, 2, 1e9, false};
  BOOST_TEST(holds(failures_text({judged({gate("bad", "order", Verdict::fail, {far, none, far})}, {})}), "none: nan"));
  // A band with one edge, and one of a single value.
  const Check little{"little", 1, {}, 2, infinity, 1, false}, least{"least", -9, {}, 2, infinity, -9, false};
  BOOST_TEST(holds(failures_text({judged({gate("bad", "order", Verdict::fail, {little, least})}, {})}), "least: -9"));
  const Check one{"one", 1, {}, 0, 0, 1, false}, two{"two", 2, {}, 0, 0, 2, false};
  BOOST_TEST(holds(failures_text({judged({gate("bad", "invariant", Verdict::fail, {two, one})}, {})}), "two: 2"));
}

BOOST_AUTO_TEST_CASE(what_could_not_be_judged_is_told_by_its_message) {
  const std::string text = failures_text({judged({gate("odd", "order", Verdict::invalid)}, {})});
  BOOST_TEST(text == "INVALID  bar.one/odd\n         because\n         cases/one.toml:17\n");
  BOOST_TEST(failures_text({judged({gate("good", "exact", Verdict::pass)}, {})}).empty());
}

BOOST_AUTO_TEST_CASE(what_no_gate_looked_at_has_a_dash) {
  const std::string text = verified_text(
      {judged({gate("a", "exact", Verdict::pass), gate("b", "order", Verdict::fail)}, {"viscosity", "damage"}),
       judged({gate("c", "exact", Verdict::pass)}, {"viscosity"}), judged({gate("d", "exact", Verdict::pass)}, {})});
  BOOST_TEST(holds(text, "active:       exact      order\n"));
  BOOST_TEST(holds(text, "(none)                                1          -\n"));
  BOOST_TEST(holds(text, "damage                                1          -\n"));
  BOOST_TEST(holds(text, "viscosity                             2          -\n"));
  BOOST_TEST(verified_text({}).empty());
}

BOOST_AUTO_TEST_CASE(the_slowest_come_first) {
  Case slow = judged({}, {}), quick = judged({}, {});
  slow.id = "slow";
  slow.runs[1].wall_seconds = 3;
  quick.id = "quick";
  const std::string text = durations_text({quick, slow}, 5);
  BOOST_TEST(text == "    5.00 s  slow  2 runs, the slowest 3.00 s: " + slow.runs[1].label() +
                         "\n    2.00 s  quick  2 runs, the slowest 2.00 s: " + quick.runs[0].label() + "\n");
  BOOST_TEST(durations_text({quick, slow}, 1).find("quick") == std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
