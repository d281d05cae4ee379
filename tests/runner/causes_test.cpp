// A message names its cause, and a number that means nothing is refused: not told as another's fault, not passed.
#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "hinge/step/ledger.hpp"
#include "runner/app/case_file.hpp"
#include "runner/app/commands.hpp"
#include "runner/app/showing.hpp"
#include "runner/input/messages.hpp"
#include "runner/run/runner.hpp"
#include "tests/case_text.hpp"
#include "tests/messages.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(causes)

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;

namespace {

const std::string closed = gate("closed", "invariant", "energy.closure", "max = 1.0\n");
const std::string start = head("x", "robustness", "paper");
const std::string plain = start + pulled_bar + axes({"fem", "mpm-musl"}, "10", "0.5") + sampled("0.5, 1.0") + closed;

std::string refusal(const std::string& text) {
  return message_of<InputError>([&] { parse_case(text, "x.toml"); });
}

void expect_refused(const std::string& text, const std::vector<std::string>& parts) {
  const std::string message = refusal(text);
  BOOST_TEST(holds_all(message, parts), message);
}

std::vector<reports::Run> runs_of(const std::string& text, Books books = Books::sums) {
  Running running;
  running.books = books;
  return run_cases({parse_case(text, "x.toml")}, running)[0].runs;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_load_that_is_no_number) {
  const std::string expression =
      replaced(replaced(plain, "[exact]\nsolution = \"bar-wave\"\n", ""), "history = \"step\"\ntraction = 1.0",
               "history = \"expression\"\ntraction = \"sqrt(0.0071 - t)\"");
  for (const reports::Run& run : runs_of(replaced(expression, "at = [0.5, 1.0]", "at = [0.5, 0.7]"))) {
    BOOST_TEST(run.status == "error", run.label());
    BOOST_TEST(holds_all(run.message, {"load: found \"sqrt(0.0071 - t)\"", "NaN at t = 0.00", "allowed: finite"}),
               run.message);
  }
}

BOOST_AUTO_TEST_CASE(a_body_force_that_is_no_number) {
  const std::string text =
      replaced(replaced(start + paper_bar, "rho = 1.0\n", "rho = 1.0\n[body_force]\nacceleration = \"1/(x-0.3)\"\n"),
               "[supports]", "[model]\nfeatures = [\"body-force\", \"elastic\"]\n[supports]") +
      axes({"fem"}, "10", "0.5") + sampled("0.5") + closed;
  const auto runs = runs_of(text);
  BOOST_TEST(holds_all(runs[0].message, {"body_force: found \"1/(x-0.3)\"", "inf at x = 0.3"}), runs[0].message);
}

BOOST_AUTO_TEST_CASE(a_load_that_is_too_large_for_a_double) {
  for (const reports::Run& run : runs_of(replaced(plain, "traction = 1.0", "traction = 1e200"))) {
    BOOST_TEST(run.status == "unstable", run.label());
    BOOST_TEST(holds_all(run.message, {"not finite", "larger than a double can hold"}), run.message);
    BOOST_TEST(!holds(run.message, "more energy than was put in"), run.message);
  }
}

BOOST_AUTO_TEST_CASE(bars_beside_a_plate) {
  const std::string message = refusal(plain + plate("1.0", "1.0"));
  BOOST_TEST(holds(message, "bar: found beside [plate]; allowed: [bar] or [plate]"), message);
  BOOST_TEST(lines(message).size() == 1U, message);
}

BOOST_AUTO_TEST_CASE(quotes_that_are_missing) {
  const std::string closing = "closing quote is missing", without = "without quotes";
  for (const auto& [title, cause] : {std::pair{"\"My bar", closing},
                                     {"'My bar", closing},
                                     {"My bar\"", without},
                                     {"My bar", without},
                                     {"“My bar”", without},
                                     {"True", without},
                                     {"\"a \"b\" c\"", std::string("more behind the end of a text")},
                                     {"1,5", std::string("decimal point")}})
    expect_refused(replaced(plain, "title = \"t\"", std::string("title = ") + title), {"x.toml:3:", "not TOML", cause});
  expect_refused("title = \"\"\"a\nb\n", {closing});
}

BOOST_AUTO_TEST_CASE(a_length_that_is_not_quite_a_number_of_cells) {
  const std::string two = start +
                          "[material]\nmodel = \"elastic\"\nE = 1e4\nrho = 1.0\n[[bar]]\nlength = 1.0\n[[bar]]\n"
                          "length = 0.3000001\n[supports]\nleft = \"free\"\nright = \"free\"\n[model]\n"
                          "features = [\"contact\", \"elastic\"]\n" +
                          axes({"fem"}, "100", "0.5") + sampled("0.5") + closed;
  expect_refused(two, {"length 0.3000001, which is 30.00001 cells", "to a part of 1e-9"});
}

BOOST_AUTO_TEST_CASE(a_courant_number_above_the_limit_has_its_line) {
  const std::string text = replaced(plain, "courant = [0.5]", "courant = [1.5]");
  const std::string message = message_of<InputError>([&] { runs_of(text); });
  BOOST_TEST(
      holds_all(message, {"x.toml:" + std::to_string(line_of(text, "courant = ")) + ": axes.courant: 1.5 for fem",
                          "above the limit"}),
      message);
}

BOOST_AUTO_TEST_CASE(bands_that_hold_every_value) {
  const auto with = [](const std::string& quantity, const std::string& kind, const std::string& rest) {
    return plain + gate("wide", kind, quantity, rest);
  };
  for (const char* max : {"1.5", "1e308"}) {
    expect_refused(with("stress.L2", "exact", std::string("max = ") + max + "\n"),
                   {"gate \"wide\": max", "0 to 1, the scale of the field"});
    expect_refused(with("energy.closure", "invariant", std::string("max = ") + max + "\n"),
                   {"gate \"wide\": max", "0 to 1, all of what"});
  }
  const std::string probed =
      replaced(plain, "[sample]\n",
               "[sample]\nprobes = [{ id = \"p\", field = \"stress\", at = { value = 0.5, unit = \"L\" } }]\n");
  const auto probe = [&](const char* rest) { return probed + gate("wide", "exact", "probe.p", rest); };
  expect_refused(probe("expect = 2.0\nmax = 2.1\n"), {"gate \"wide\": max", "0 to 2, the size of what is expected"});
  expect_refused(probe("expect = 0.0\nmax = 1e308\n"), {"gate \"wide\": max", "beyond which nothing is bounded"});
  BOOST_TEST(refusal(probe("expect = 2.0\nmax = 2.0\n")) == "");
  expect_refused(with("stress.L2", "constant", "predict = \"modified-equation\"\nratio = [1e-300, 1e300]\n"),
                 {"gate \"wide\": ratio", "at most 10 times the least"});
  expect_refused(with("stress.L2", "order", "expect = 1\nband = [-1e9, 1e9]\n"),
                 {"gate \"wide\": band", "at most 1 wide"});
}

BOOST_AUTO_TEST_CASE(cells_that_are_no_cells) {
  const std::string square = start + plate("1.0", "1.0") + elastic("1e4", "0.3", "1.0") +
                             supports("roller", "free", "roller", "free") + "[model]\nfeatures = [\"elastic\"]\n" +
                             axes({"fem"}, "10", "0.5") + "[sample]\ntimes = { unit = \"s\", at = [0.01] }\n" + closed;
  BOOST_TEST(refusal(square) == "");
  for (const char* bad : {"1e308", "1e-308", "1.1e6", "0.9e-6"})
    expect_refused(replaced(square, "height = 1.0", std::string("height = 1.0\ncell_aspect = ") + bad),
                   {"plate.cell_aspect: found", "1e-6 to 1e6"});
}

BOOST_AUTO_TEST_CASE(a_corner_that_two_sides_move_otherwise) {
  const auto square = [](const std::string& left, const std::string& bottom, const std::string& velocity) {
    return start + plate("1.0", "1.0") + elastic("1e4", "0.3", "1.0") + supports(left, "free", bottom, "free") +
           "velocity = " + velocity + "\n[model]\nfeatures = [\"elastic\"]\n" + axes({"fem"}, "10", "0.5") +
           "[sample]\ntimes = { unit = \"s\", at = [0.01] }\n" + closed;
  };
  expect_refused(square("driven", "fixed", "[\"0.1\", \"0\"]"), {"supports: found the left side driven at (0.1, 0) m/s",
                                                                 "the bottom side, which is fixed, at t = 0 s"});
  expect_refused(square("fixed", "driven", "[\"0\", \"t\"]"),
                 {"the bottom side driven", "the left side, which is fixed"});
  expect_refused(square("driven", "roller", "[\"0\", \"0.1\"]"), {"the bottom side, which is roller"});
  expect_refused(square("roller", "driven", "[\"0.1\", \"0\"]"), {"the left side, which is roller"});
  BOOST_TEST(refusal(square("driven", "fixed", "[\"0.1*y\", \"y*t\"]")) == "");
  BOOST_TEST(refusal(square("driven", "roller", "[\"0.1\", \"0\"]")) == "");
  BOOST_TEST(refusal(square("driven", "driven", "[\"0.1\", \"0.2\"]")) == "");
  BOOST_TEST(refusal(square("driven", "free", "[\"0.1\", \"0.2\"]")) == "");
}

BOOST_AUTO_TEST_CASE(long_work_is_told_and_asked_for) {
  Ahead told;
  Running running;
  running.ahead = [&](const Ahead& ahead) { told = ahead; };
  const Case c = parse_case(plain, "x.toml");
  run_cases({c}, running);
  BOOST_TEST(told.runs == 2U);
  BOOST_TEST(told.steps == 40.0, boost::test_tools::tolerance(1e-12));  // 1 L/c on 10 cells at Courant 0.5, twice
  BOOST_TEST(told.most_steps == 20.0, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(told.seconds < 1.0);

  Options options;
  const Ahead day{1, 1e12, 1e12, 86400}, minute{1, 1e9, 1e9, 60};
  warning_of(options, false)(minute);
  const std::string message = message_of<InputError>([&] { warning_of(options, false)(day); });
  BOOST_TEST(holds_all(message, {"1e+12 steps", "about 24.0 h", "with --yes"}), message);
  options.yes = true;
  BOOST_TEST(message_of([&] { warning_of(options, false)(day); }) == "");

  // What throws there throws before the first run.
  const Case slow =
      parse_case(replaced(replaced(plain, "at = [0.5, 1.0]", "at = [1e9]"), "cells = [10]", "cells = [100]"), "x.toml");
  running.ahead = warning_of({}, false);
  BOOST_CHECK_EXCEPTION(run_cases({slow}, running), InputError, says({"with --yes"}));
}

// What is needed most where a run blew up.
BOOST_AUTO_TEST_CASE(the_ledger_of_an_unstable_run_is_kept) {
  std::string text = replaced(plain, "courant = [0.5]", "courant = [2.5]");
  text = replaced(replaced(text, "cells = [10]", "cells = [100]"), "at = [0.5, 1.0]", "at = [50.0]");
  for (const reports::Run& run : runs_of(text + "[run]\nallow_unstable = true\n", Books::lines)) {
    BOOST_TEST(run.status == "unstable", run.label());
    BOOST_TEST(static_cast<long>(run.ledger.size()) >= run.steps, run.label());
    BOOST_TEST(run.ledger.size() > 2U);
    BOOST_TEST(run.ledger.back().kinetic > 1e3 * run.ledger.front().kinetic);
  }
}

BOOST_AUTO_TEST_SUITE_END()
