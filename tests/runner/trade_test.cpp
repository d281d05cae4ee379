// What settings cost and how far off they are: more values of the axes, points, the front, the pick and what it
// proposes.
#include "runner/trade/trade.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "reports/trade_table.hpp"
#include "runner/app/case_file.hpp"
#include "runner/input/leaf.hpp"
#include "runner/run/run_leaf.hpp"
#include "runner/trade/over.hpp"
#include "runner/trade/pick.hpp"
#include "runner/trade/timing.hpp"
#include "runner/trade/work_precision.hpp"
#include "tests/case_text.hpp"
#include "tests/folder.hpp"
#include "tests/made_runs.hpp"
#include "tests/messages.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(trade)

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;
using reports::Aim;
using reports::Cost;
using reports::Trade;
using reports::TradePoint;
namespace tt = boost::test_tools;

namespace {

const std::string text = head("t", "code-verification", "paper") + pulled_bar +
                         axes({"fem", "mpm-musl"}, "10, 20", "0.5") + "particles = [[0.25, 0.75]]\n" +
                         sampled("0.5, 1.0") + gate("near", "exact", "displacement.L2", "max = 1.0\n");

const Aim aim{"stress.L2", 1};

TradePoint made(const std::string& setting, int cells, double error, long work) {
  TradePoint point;
  point.setting = setting;
  point.label = setting + " N=" + std::to_string(cells);
  point.method = "fem";
  point.cells = cells;
  point.cell_size = 1.0 / cells;
  point.status = "completed";
  point.element_steps = work;
  point.bytes = static_cast<std::size_t>(cells) * 100;
  point.errors = {{aim.quantity, aim.time, error, 0, {}}};
  return point;
}

/// a: first order; b: dearer on each mesh, but nearer.
Trade two_settings() {
  Trade t;
  t.case_id = "t";
  t.time_unit = "L/c";
  t.points = {made("a", 10, 0.16, 100), made("a", 20, 0.08, 400),  made("a", 40, 0.04, 1600),
              made("b", 10, 0.06, 300), made("b", 20, 0.03, 1200), made("b", 40, 0.015, 4800)};
  for (std::size_t i = 0; i < t.points.size(); ++i) t.points[i].leaf = i;
  return t;
}

std::vector<std::string> labels(const Trade& t, const std::vector<bool>& chosen) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (chosen[i]) all.push_back(t.points[i].label);
  return all;
}

Case with(const std::vector<std::string>& over) {
  Case c = parse_case(text, "t.toml");
  add_values(c, over);
  return c;
}

void expect_in(const std::string& said, const std::vector<std::string>& wanted) {
  for (const std::string& part : wanted) BOOST_TEST(holds(said, part), "wanted '" + part + "' in\n" + said);
}

void refused(const std::string& over, const std::vector<std::string>& wanted) {
  expect_in(message_of([&] { with({over}); }), wanted);
}

}  // namespace

BOOST_AUTO_TEST_CASE(more_values_are_added_to_those_of_the_case) {
  const Case c = with({"courant=0.2:0.8:4", "cells=10:80:4", "particles=1,2", "method=mpm-usl"});
  const Axes& axes = c.axes.front();
  BOOST_TEST(axes.courant.size() == 5u);  // 0.5 is not among 0.2, 0.4, 0.6, 0.8
  BOOST_TEST((axes.courant == std::vector{0.5, 0.2, 0.4, 0.6, 0.8}));
  BOOST_TEST((axes.cells == std::vector{10, 20, 40, 80}));
  BOOST_TEST((axes.particles == std::vector<std::vector<double>>{{0.25, 0.75}, {0.5}}));  // two are there already
  BOOST_TEST((axes.method == std::vector<std::string>{"fem", "mpm-musl", "mpm-usl"}));
  BOOST_TEST(c.allow_unstable);
  BOOST_TEST(!with({}).allow_unstable);
}

BOOST_AUTO_TEST_CASE(a_wrong_value_is_told_with_what_is_allowed) {
  refused("courrant=0.5", {"--over", "\"courrant\"", "\"courant\"", "did you mean"});
  refused("courant=0.5:0.9", {"--over courant", "FROM:TO:HOW-MANY"});
  refused("courant=0.5:0.9:2.5", {"--over courant", "FROM:TO:HOW-MANY"});
  refused("courant=0.5x", {"--over courant", "numbers"});
  refused("courant=-0.5", {"--over courant", "> 0"});
  refused("courant=", {"--over courant", "courant=VALUES"});
  refused("courant", {"--over courant", "courant=VALUES"});
  refused("cells=10.5", {"--over cells", "whole"});
  refused("cells=0", {"--over cells", "whole"});
  refused("particles=99", {"--over particles", "1 to 16"});
  refused("method=mpm-mussl", {"--over method", "mpm-musl", "did you mean"});
}

BOOST_AUTO_TEST_CASE(keys_of_the_file_are_changed) {
  const Folder folder;
  const auto file = folder.path / "t.toml";
  std::ofstream(file) << text;
  const auto over = [&](const std::vector<std::string>& values) { return with_values(read_case(file), values); };
  const auto cases = over({"material.E=1e4,4e4", "cells=40"});
  BOOST_TEST_REQUIRE(cases.size() == 2U);
  BOOST_TEST(cases[0].changed == "material.E=10000");
  BOOST_TEST(cases[1].changed == "material.E=40000");
  BOOST_TEST(std::get<material::Elastic>(cases[1].first().material).youngs_modulus == 4e4);
  BOOST_TEST(leaves(cases[1]).size() == 6U);
  BOOST_TEST((cases[0].gates.empty() && cases[0].allow_unstable));
  const auto run = describe(cases[1], leaves(cases[1]).front());
  BOOST_TEST(run.parameters == "material.E=40000");
  BOOST_TEST(over({"material.E=1e4:3e4:3", "load[0].traction=-1,-2"}).size() == 6U);
  BOOST_TEST(!over({}).front().gates.empty());
  const auto refuses = [&](const std::string& values, const std::vector<std::string>& wanted) {
    expect_in(message_of([&] { over({values}); }), wanted);
  };
  refuses("material.e=1", {"material.e", "unknown key", "\"E\""});
  refuses("material.E=-1", {"material.E", "found -1", "> 0"});
  refuses("load[1].traction=1", {"load[1]", "load[0]"});
  refuses("material.E=", {"--over material.E", "without values"});
}

BOOST_AUTO_TEST_CASE(work_is_counted_by_hand) {
  const Trade t = measure_trade(parse_case(text, "t.toml"), {}, 0);
  BOOST_REQUIRE(t.points.size() == 4u);
  // C = 0.5, 10 cells, to t = L/c: 20 steps.
  const TradePoint& fem = t.points[0];
  BOOST_TEST(fem.status == "completed");
  BOOST_TEST(fem.setting == "fem C=0.5");
  BOOST_TEST(fem.steps == 20);
  BOOST_TEST(fem.work() == 20 * 10 + 20 * 11);
  const TradePoint& mpm = t.points[3];
  BOOST_TEST(mpm.label == "mpm-musl N=20 C=0.5 ppc=2");
  BOOST_TEST(mpm.work() == 40 * 40 + 40 * 21);
  BOOST_TEST(mpm.timed.rounds == 0);
  // Three fields, three norms, two times.
  BOOST_TEST(mpm.errors.size() == 18u);
  BOOST_TEST(t.aims().size() == 18u);
  BOOST_TEST(fem.error_of("stress.L2", 1)->error > 0);
  BOOST_TEST((fem.error_of("stress.L4", 1) == nullptr));
}

BOOST_AUTO_TEST_CASE(what_is_not_completed_stays_a_point_of_its_own_kind) {
  const Trade t = measure_trade(with({"courant=1.9"}), {}, 1);
  bool unstable = false;
  for (const TradePoint& point : t.points) {
    if (point.method == "fem" && point.setting == "fem C=1.9") {
      unstable = true;
      BOOST_TEST((point.status == "unstable" || point.status == "above limit"), point.status);
      BOOST_TEST(point.errors.empty());
      BOOST_TEST(point.timed.rounds == 0);
      expect_in(reports::trade_text(t, aim, Cost::work), {point.label});
      expect_in(reports::trade_csv(t), {point.label + ",fem C=1.9,,fem", point.status});
      expect_in(reports::trade_json(t, {}), {"\"run\":\"" + point.label, "\"status\":\"" + point.status});
    } else if (point.completed()) {
      BOOST_TEST(point.timed.rounds == 1);
      BOOST_TEST(point.timed.seconds > 0);
    }
  }
  BOOST_TEST(unstable);
}

BOOST_AUTO_TEST_CASE(a_run_above_its_limit_that_has_not_blown_up_yet_is_not_completed) {
  reports::Run run = made_run("fem", 10, 1.02);
  run.time_step_limit = 1;
  reports::FieldError error;
  error.field = "stress";
  error.l2 = 0.1;
  reports::Sample sample;
  sample.asked = 1;
  sample.errors = {error};
  run.samples = {sample};
  run.time_step = 1;
  BOOST_TEST(point_of(run).completed());
  BOOST_TEST(point_of(run).errors.size() == 3u);
  run.time_step = 1.02;
  BOOST_TEST(point_of(run).status == "above limit");
  BOOST_TEST(point_of(run).errors.empty());
  run.time_step = 1;
  run.invalid = "a number is none";
  BOOST_TEST(point_of(run).status == "invalid");
  BOOST_TEST(point_of(run).message == "a number is none");
  BOOST_TEST(point_of(run).errors.empty());
}

BOOST_AUTO_TEST_CASE(the_front_holds_what_nothing_beats) {
  Trade t = two_settings();
  BOOST_TEST(
      (labels(t, on_front(t, aim, Cost::work)) == std::vector<std::string>{"a N=10", "b N=10", "b N=20", "b N=40"}));
  // Two points of the sweep that are taken for each other are seen.
  std::swap(t.points[0].errors, t.points[3].errors);
  BOOST_TEST((labels(t, on_front(t, aim, Cost::work)) == std::vector<std::string>{"a N=10", "b N=20", "b N=40"}));
  // Two that are exact but for round-off are equally near, and the dearer one is no better.
  t = two_settings();
  t.points[3].errors[0].error = 2e-15;
  t.points[4].errors[0].error = 1e-15;
  BOOST_TEST((labels(t, on_front(t, aim, Cost::work)) == std::vector<std::string>{"a N=10", "b N=10"}));
  // And so are two below the band of their reference.
  t = two_settings();
  t.points[4].errors[0].band = t.points[5].errors[0].band = 0.07;
  BOOST_TEST((labels(t, on_front(t, aim, Cost::work)) == std::vector<std::string>{"a N=10", "a N=40", "b N=10"}));
  // What was not timed is not the cheapest.
  t = two_settings();
  for (TradePoint& point : t.points) point.timed = {5, point.work(), 0};
  t.points[5].timed = {};
  BOOST_TEST((labels(t, on_front(t, aim, Cost::seconds)) == std::vector<std::string>{"a N=10", "b N=10", "b N=20"}));
  // Points of another scene are not compared.
  t.points[3].scene = "plane-stress";
  BOOST_TEST(reports::of_scene(t, "").points.size() == 5u);
  BOOST_TEST(reports::of_scene(t, "plane-stress").points.size() == 1u);
  // What is unstable or no number beats nothing.
  t = two_settings();
  t.points[3].status = "unstable";
  t.points[4].errors[0].error = std::nan("");
  BOOST_TEST(
      (labels(t, on_front(t, aim, Cost::work)) == std::vector<std::string>{"a N=10", "a N=20", "a N=40", "b N=40"}));
  BOOST_TEST((labels(two_settings(), on_front(two_settings(), aim, Cost::bytes)) ==
              std::vector<std::string>{"b N=10", "b N=20", "b N=40"}));
}

BOOST_AUTO_TEST_CASE(the_cheapest_that_is_near_enough_is_picked) {
  const Trade t = two_settings();
  Target target;
  target.aim = aim;
  target.error = 0.05;
  Pick found = pick(t, target);
  BOOST_REQUIRE((found.best && found.runner_up && found.halved));
  BOOST_TEST(t.points[*found.best].label == "b N=20");
  BOOST_TEST(t.points[*found.runner_up].label == "a N=40");
  BOOST_TEST(t.points[*found.halved].label == "b N=40");
  expect_in(words_of(t, target, found), {"b N=20: 3 % (0.60 of what is allowed)", "runner-up: a N=40", "1.3 times",
                                         "half the error: b N=40, 4 times"});
  // Memory rules out the finest, and no half.
  target.bytes = 2500;
  found = pick(t, target);
  BOOST_TEST(t.points[found.best.value()].label == "b N=20");
  BOOST_TEST((!found.runner_up && !found.halved));
  // Runs that were not timed meet no limit of time.
  target.bytes = {};
  target.seconds = 10;
  BOOST_TEST((!pick(t, target).best && !pick(t, target).nearest));
  // Another unit of cost, another pick.
  Trade dear = t;
  dear.points[4].node_steps = 1000;
  target.seconds = {};
  BOOST_TEST(dear.points[pick(dear, target).best.value()].label == "a N=40");
}

BOOST_AUTO_TEST_CASE(where_none_is_near_enough_the_nearest_is_named) {
  Trade t = two_settings();
  Target target;
  target.aim = aim;
  target.error = 0.01;
  Pick found = pick(t, target);
  BOOST_TEST((!found.best && found.nearest));
  expect_in(words_of(t, target, found), {"none of the measured settings does", "b N=40", "1.5 %"});
  // The band of a reference counts: 1.5 % ± 0.6 % is not within 2 %.
  target.error = 0.02;
  BOOST_TEST(bool(pick(t, target).best));
  t.points[5].errors[0].band = 0.006;
  BOOST_TEST(!pick(t, target).best);
}

BOOST_AUTO_TEST_CASE(fewer_cells_are_proposed_where_the_meshes_let_expect_it) {
  const Trade t = two_settings();
  Target target;
  target.aim = aim;
  target.error = 0.05;
  // b is of first order: 0.05 is met between 10 and 20 cells, at 0.06 * 10 / 0.05 = 12.
  const auto proposal = propose(t, target, pick(t, target));
  BOOST_REQUIRE(bool(proposal));
  BOOST_TEST(proposal->cells == 12);
  BOOST_TEST(proposal->setting == "b");
  BOOST_TEST(proposal->error == 0.05, tt::tolerance(1e-12));
  // A mesh that is just near enough leaves none between.
  target.error = 0.03;
  BOOST_TEST(!propose(t, target, pick(t, target)));
  // Beyond the finest: 0.015 * 40 / 0.01 = 60; and no further than four times as fine.
  target.error = 0.01;
  BOOST_TEST(propose(t, target, pick(t, target)).value().cells == 60);
  target.error = 0.001;
  BOOST_TEST(!propose(t, target, pick(t, target)));
  BOOST_TEST(proposal->like == 3u);
  // A reference that is extrapolated lets expect nothing.
  Trade uncertain = t;
  for (TradePoint& point : uncertain.points) point.errors[0].band = 1e-3;
  target.error = 0.05;
  BOOST_TEST(!propose(uncertain, target, pick(uncertain, target)));
  // The coarsest mesh is near enough: there is nothing below it to read a line from.
  target.error = 0.2;
  BOOST_TEST(!propose(t, target, pick(t, target)));
}

BOOST_AUTO_TEST_CASE(a_proposal_is_run_and_confirmed_or_retracted) {
  const Case c = parse_case(text, "t.toml");
  const Trade t = measure_trade(c, {}, 0);
  Target target;
  target.aim = aim;
  const double coarse = t.points[0].error_of("stress.L2", 1)->error, fine = t.points[1].error_of("stress.L2", 1)->error;
  target.error = std::sqrt(coarse * fine);
  Proposal proposal{t.points[1].setting, 0, 16, 0.9 * target.error};
  const Trial good = tried(c, target, proposal, {});
  expect_in(good.words, {"fem N=16 C=0.5", "confirmed"});
  BOOST_TEST(good.confirmed);
  BOOST_TEST(good.point.cells == 16);
  // Near enough, but not within its memory or its time.
  target.bytes = 100;
  BOOST_TEST(!tried(c, target, proposal, {}).confirmed);
  target.bytes = {};
  target.seconds = 1e-12;
  target.rounds = 1;
  BOOST_TEST(!tried(c, target, proposal, {}).confirmed);
  target.seconds = 100;
  BOOST_TEST(tried(c, target, proposal, {}).confirmed);
  BOOST_TEST(tried(c, target, proposal, {}).point.timed.rounds == 1);
  target.seconds = {};
  // An expectation that is a tenth too good.
  target.error = fine;
  proposal.error = fine;
  const Trial bad = tried(c, target, proposal, {});
  expect_in(bad.words, {"fem N=16 C=0.5", "retracted"});
  BOOST_TEST(!bad.confirmed);
}

BOOST_AUTO_TEST_CASE(rounds_are_summed_up_by_median_and_quartiles) {
  const reports::Timed timed = summed_up({5, 1, 3, 2, 4});
  BOOST_TEST(timed.rounds == 5);
  BOOST_TEST(timed.seconds == 3);
  BOOST_TEST(timed.spread == 1.0 / 3, tt::tolerance(1e-15));
  BOOST_TEST(summed_up({2}).seconds == 2);
  BOOST_TEST(summed_up({2}).spread == 0);
  BOOST_TEST(summed_up({}).rounds == 0);
}

BOOST_AUTO_TEST_CASE(the_figure_joins_the_meshes_of_a_setting_and_lays_the_front_below) {
  const Trade t = two_settings();
  const reports::Figure figure = work_precision(t, aim, "t");
  BOOST_REQUIRE(figure.panels.size() == 1u);  // not timed: no panel of seconds
  const auto& series = figure.panels[0].series;
  BOOST_REQUIRE(series.size() == 2u);
  BOOST_TEST(series[0].kind == "exact");
  BOOST_TEST(series[0].curve.x.size() == 4u);
  BOOST_TEST(series[1].label == "FEM");  // three meshes of a, a break, three of b, a break
  BOOST_REQUIRE(series[1].curve.x.size() == 8u);
  BOOST_TEST(series[1].curve.x[1] == std::log10(400.0), tt::tolerance(1e-15));
  BOOST_TEST(std::isnan(series[1].curve.y[3]));
  BOOST_TEST(series[1].curve.y[6] == std::log10(0.015), tt::tolerance(1e-15));
  BOOST_TEST((figure.x_powers && figure.y_powers));
  BOOST_TEST(figure.panels[0].marks.size() == 2u);  // 10 % and 3 %
  Trade uncertain = t;
  for (TradePoint& point : uncertain.points) point.errors[0].band = 0.02;
  BOOST_TEST(work_precision(uncertain, aim, "t").panels[0].marks.back().label == "U = 2 %");
}

BOOST_AUTO_TEST_SUITE_END()
