// The table of the kinds of figures, and one more kind as a row of it.
#include "runner/draw/figure_kinds.hpp"

#include <boost/test/unit_test.hpp>
#include <set>
#include <stdexcept>

#include "reports/results.hpp"
#include "runner/app/case_file.hpp"
#include "runner/draw/figure_kind.hpp"
#include "runner/input/case_tables.hpp"
#include "runner/run/runner.hpp"
#include "tests/case_figures.hpp"
#include "tests/case_text.hpp"
#include "tests/messages.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(figure_kinds)

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;

namespace {

// The kind: how many points each run drew of a field, as a mark.
struct Points {
  std::string counted;
};

void read(Table& t, const Case&, FigureSpec& figure) {
  figure.options = Points{t.need("counted", one_of(fields))};
  figure.recorded.curves = true;
}

void add(const Case&, const FigureSpec& spec, reports::Case& result) {
  const std::string& field = options_of<Points>(spec).counted;
  reports::Figure figure;
  figure.id = spec.id;
  figure.panels.push_back({});
  for (const reports::Run& run : result.runs)
    for (const reports::Sample& sample : run.samples)
      figure.panels[0].marks.push_back(
          {static_cast<double>(sample.curves.at(field).x.size()), run.method + ", " + field});
  result.figures.push_back(figure);
}

FigureKind points_kind() { return {.id = "points", .keys = {"cells", "counted"}, .read = read, .add = add}; }

const std::string bar = head("t", "code-verification", "paper") + pulled_bar + axes({"fem", "mpm-musl"}, "10", "0.5") +
                        "particles = [[0.25, 0.75]]\n" + sampled("0.5") +
                        gate("near", "exact", "displacement.L2", "max = 1.0\n") + R"([[figure]]
id = "picture"
kind = "points"
counted = "displacement"
)";

std::string refusal(const std::string& of) {
  return message_of<InputError>([&] { parse_case(of, "t.toml"); });
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_row_has_a_name_of_its_own_and_draws) {
  std::set<std::string> names;
  for (const FigureKind& kind : runner::figure_kinds()) {
    BOOST_TEST((kind.add != nullptr), kind.id);
    BOOST_TEST(names.insert(kind.id).second, kind.id);
    // What is read nowhere would be taken and mean nothing; the common keys are read for every kind.
    for (const std::string& key : kind.keys)
      BOOST_TEST((kind.read != nullptr || key == "cells" || key == "times" || key == "range"), kind.id + ": " + key);
  }
  BOOST_TEST(names.size() == 11U);
}

BOOST_AUTO_TEST_CASE(one_more_kind_is_one_row) {
  BOOST_TEST(holds_all(refusal(bar), {"\"points\"", "\"profiles\""}));  // not there yet
  const AddedFigureKind added(points_kind());
  BOOST_TEST(refusal(bar) == "");
  BOOST_CHECK_THROW(AddedFigureKind{points_kind()}, std::invalid_argument);
  // Its keys are its own, and those of others are not taken.
  BOOST_TEST(holds_all(refusal(replaced(bar, "counted = \"displacement\"\n", "")), {"counted", "missing"}));
  BOOST_TEST(holds_all(refusal(replaced(bar, "\"points\"", "\"profiles\"")), {"counted", "kind = \"points\""}));
  BOOST_TEST(holds_all(refusal(bar + "captions = [\"c\"]\n"), {"captions", "kind = \"profiles\""}));
  BOOST_TEST(holds(refusal(replaced(bar, "\"points\"", "\"pionts\"")), "did you mean \"points\"?"));
  BOOST_TEST(holds(refusal(bar + "cells = 20\n"), "axes.cells"));

  const Case c = parse_case(bar, "t.toml");
  const reports::Figure figure = drawn_figure(c, "picture", run_cases({c}, {}).at(0).runs);
  const auto& marks = figure.panels.at(0).marks;
  BOOST_TEST_REQUIRE(marks.size() == 2U);
  BOOST_TEST((marks[0].at == 11 && marks[0].label == "fem, displacement"), marks[0].at);
  BOOST_TEST((marks[1].at == 20 && marks[1].label == "mpm-musl, displacement"), marks[1].at);
  BOOST_TEST(!figure.looks.empty());
}

BOOST_AUTO_TEST_SUITE_END()
