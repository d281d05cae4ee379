// What settings cost and how far off they are: more values of the axes, points, the front, the pick and what it
// proposes.
#include "runner/trade/trade.hpp"

#include <algorithm>
#include <atomic>
#include <boost/test/unit_test.hpp>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <thread>

#include "reports/trade_table.hpp"
#include "runner/app/case_file.hpp"
#include "runner/input/leaf.hpp"
#include "runner/run/deadline.hpp"
#include "runner/run/run_leaf.hpp"
#include "runner/trade/efficacy.hpp"
#include "runner/trade/errors.hpp"
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

Trade measured(const Case& c, int rounds) { return measure_trade({c}, {}, {rounds}); }

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
  const Trade t = measured(parse_case(text, "t.toml"), 0);
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
  const Trade t = measured(with({"courant=1.9"}), 1);
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
  const Case c = parse_case(text, "t.toml");
  const Leaf leaf = leaves(c).front();
  BOOST_TEST(point_of(c, leaf, run).completed());
  BOOST_TEST(point_of(c, leaf, run).errors.size() == 3u);
  run.time_step = 1.02;
  BOOST_TEST(point_of(c, leaf, run).status == "above limit");
  BOOST_TEST(point_of(c, leaf, run).errors.empty());
  run.time_step = 1;
  run.invalid = "a number is none";
  BOOST_TEST(point_of(c, leaf, run).status == "invalid");
  BOOST_TEST(point_of(c, leaf, run).message == "a number is none");
  BOOST_TEST(point_of(c, leaf, run).errors.empty());
}

BOOST_AUTO_TEST_CASE(each_cost_has_its_unit) {
  TradePoint point = made("a", 10, 0.1, 1000);
  point.node_steps = 200;
  point.particle_steps = 30;
  point.diffusion_updates = 4;
  point.bytes = 777;
  point.timed = {3, 0.25, 0};
  BOOST_TEST(cost_of(point, Cost::work) == 1234);
  BOOST_TEST(cost_of(point, Cost::bytes) == 777);
  BOOST_TEST(cost_of(point, Cost::seconds) == 0.25);
  point.timed = {};
  BOOST_TEST(std::isinf(cost_of(point, Cost::seconds)));
}

BOOST_AUTO_TEST_CASE(each_point_is_that_of_its_own_run) {
  const Case c = with({"cells=500"});
  const Trade t = measured(c, 1);
  const std::vector<Leaf> all = leaves(c);
  BOOST_TEST_REQUIRE(t.points.size() == all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const reports::Run run = run_leaf(bare(c), all[i]);
    BOOST_TEST(t.points[i].label == run.label());
    BOOST_TEST(t.points[i].steps == run.steps);
    const reports::FieldError& stress = run.samples.back().errors.front();
    BOOST_TEST_REQUIRE(stress.field == "stress");
    const reports::TradeError* found = t.points[i].error_of("stress.L2", 1);
    BOOST_TEST_REQUIRE(found != nullptr);
    BOOST_TEST(found->error == stress.l2);
    BOOST_TEST((found->predicted == stress.predicted_l2));
    BOOST_TEST(found->predicted.has_value());
  }
  // 50 cells have 1/2500 of the updates: no machine is so busy that it takes longer.
  BOOST_TEST(t.points[0].cells == 10);
  BOOST_TEST(t.points[2].cells == 500);
  BOOST_TEST(t.points[0].timed.seconds < t.points[2].timed.seconds);
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

BOOST_AUTO_TEST_CASE(what_is_near_by_chance_is_passed_over) {
  Trade t = two_settings();
  t.points[0].errors[0].error = 0.03;  // nearer than the next two meshes of its setting
  Target target;
  target.aim = aim;
  target.error = 0.05;
  Pick found = pick(t, target);
  BOOST_TEST(t.points[found.best.value()].label == "b N=20");
  expect_in(words_of(t, target, found),
            {"passed over: a N=10: 3 %, 0.083 times the cost, but near by chance: a N=20 has 8 %"});
  target.error = 0.1;
  found = pick(t, target);
  BOOST_TEST(t.points[found.best.value()].label == "a N=10");
  BOOST_TEST(!holds(words_of(t, target, found), "passed over"));
  // Nothing else: the nearest is what can be trusted to be.
  t.points.resize(2);
  target.error = 0.05;
  found = pick(t, target);
  BOOST_TEST((!found.best && t.points[found.nearest.value()].label == "a N=20"));
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
  const Trade t = measured(c, 0);
  Target target;
  target.aim = aim;
  const double coarse = t.points[0].error_of("stress.L2", 1)->error, fine = t.points[1].error_of("stress.L2", 1)->error;
  target.error = std::sqrt(coarse * fine);
  Proposal proposal{t.points[1].setting, 0, 0, 1, 16, 0.9 * target.error};
  const Trial good = tried({c}, target, proposal, {});
  expect_in(good.words, {"fem N=16 C=0.5", "confirmed"});
  BOOST_TEST(good.confirmed);
  BOOST_TEST(good.point.cells == 16);
  // Near enough, but not within its memory or its time.
  target.bytes = 100;
  BOOST_TEST(!tried({c}, target, proposal, {}).confirmed);
  target.bytes = {};
  target.seconds = 1e-12;
  target.rounds = 1;
  BOOST_TEST(!tried({c}, target, proposal, {}).confirmed);
  target.seconds = 100;
  BOOST_TEST(tried({c}, target, proposal, {}).confirmed);
  BOOST_TEST(tried({c}, target, proposal, {}).point.timed.rounds == 1);
  target.seconds = {};
  // An expectation that is a tenth too good.
  target.error = fine;
  proposal.error = fine;
  const Trial bad = tried({c}, target, proposal, {});
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

BOOST_AUTO_TEST_CASE(the_table_names_once_what_all_runs_have) {
  Trade t = two_settings();
  for (std::size_t i = 0; i < t.points.size(); ++i)
    t.points[i].label += std::string(" viscosity.form=york viscosity.c1=") + (i % 2 == 0 ? "0.1" : "0.2");
  const std::string table = reports::trade_text(t, aim, Cost::work);
  expect_in(table, {"  all with viscosity.form=york\n", "  a N=10 viscosity.c1=0.1 "});
  BOOST_TEST(table.find("york") == table.rfind("york"));
  expect_in(reports::trade_csv(t), {"a N=10 viscosity.form=york viscosity.c1=0.1,"});
  BOOST_TEST(!holds(reports::trade_text(two_settings(), aim, Cost::work), "all with"));
}

BOOST_AUTO_TEST_CASE(what_has_no_error_stands_in_a_strip_above_it) {
  Trade t = two_settings();
  t.points[1].status = "unstable";
  t.points[2].status = "above limit";
  t.points[3].status = "timed out";
  t.points[3].timed = {1, 2.5, 0};
  t.points[4].status = "invalid";
  t.points[4].method = "mpm-musl";
  const reports::Figure figure = work_precision(t, aim, "t");
  BOOST_TEST_REQUIRE(figure.panels.size() == 1U);  // what was stopped is no timing
  expect_in(figure.notes.at(1), {"4 of 6 runs have no error"});
  const auto& panel = figure.panels[0];
  const double edge = panel.marks.front().at;
  BOOST_TEST(panel.marks.front().label == "above: no error");
  std::map<std::string, std::vector<long>> costs;
  for (const auto& series : panel.series)
    for (std::size_t k = 0; k < series.curve.x.size(); ++k) {
      if (!std::isfinite(series.curve.x[k])) continue;
      const bool above = series.curve.y[k] > edge && series.curve.y[k] < figure.y_max;
      BOOST_TEST(above == series.label.ends_with("unstable") + series.label.ends_with("timed out") +
                              series.label.ends_with("not judged"),
                 series.label);
      if (above) costs[series.label].push_back(std::lround(std::pow(10, series.curve.x[k])));
    }
  BOOST_TEST((costs["FEM, unstable"] == std::vector{400L, 1600L}));
  BOOST_TEST((costs["FEM, timed out"] == std::vector{300L}));
  BOOST_TEST((costs["MPM, not judged"] == std::vector{1200L}));
  // Each is drawn by a look of its own.
  for (const auto& [label, at] : costs) {
    const auto series =
        std::find_if(panel.series.begin(), panel.series.end(), [&](const auto& s) { return s.label == label; });
    BOOST_TEST(std::count_if(figure.looks.begin(), figure.looks.end(),
                             [&](const auto& l) { return l.id == series->kind; }) == 1);
  }
  expect_in(reports::trade_text(t, aim, Cost::work), {"a N=20", "unstable", "above limit", "timed out", "invalid"});
}

BOOST_AUTO_TEST_CASE(few_settings_have_a_line_each_and_theory_its_own) {
  Trade t = two_settings();
  for (TradePoint& point : t.points) {
    point.setting = "fem C=" + point.setting;
    point.errors[0].predicted = 1.1 * point.errors[0].error;
  }
  const reports::Figure figure = work_precision(t, aim, "t");
  const auto& series = figure.panels[0].series;
  BOOST_TEST_REQUIRE(series.size() == 4U);
  BOOST_TEST(series[1].label == "FEM C=a");
  BOOST_TEST(series[2].label == "FEM C=b");
  BOOST_TEST(series[3].label == "FEM, predicted");
  BOOST_TEST(series[3].kind == "fem-thin");
  for (std::size_t k = 0; k < 3; ++k) {
    BOOST_TEST(series[3].curve.y.at(k) == std::log10(1.1 * t.points[k].errors[0].error), tt::tolerance(1e-14));
    BOOST_TEST(series[3].curve.y.at(k + 4) == std::log10(1.1 * t.points[k + 3].errors[0].error), tt::tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_CASE(efficacy_is_accuracy_for_cost_over_size) {
  Trade t = two_settings();
  for (TradePoint& point : t.points) point.unknowns = 2 * point.cells;
  t.points[5].status = "unstable";
  reports::Figure figure = efficacy(t, aim, "t");
  BOOST_TEST_REQUIRE(figure.panels.size() == 1U);
  expect_in(figure.y_label, {"updates"});
  const auto& curve = figure.panels[0].series.at(0).curve;
  BOOST_TEST(curve.x.at(1) == std::log10(40.0), tt::tolerance(1e-15));
  BOOST_TEST(curve.y.at(1) == -std::log10(0.08 * 400), tt::tolerance(1e-15));
  // Half the error at twice the cost is as good.
  BOOST_TEST(figure.panels[0].series.back().label == "FEM, unstable");
  BOOST_TEST(figure.panels[0].series.back().curve.y.at(0) > curve.y.at(0));
  for (TradePoint& point : t.points) point.timed = {5, 0.5, 0};
  figure = efficacy(t, aim, "t");
  expect_in(figure.y_label, {"seconds"});
  BOOST_TEST(figure.panels[0].series.at(0).curve.y.at(1) == -std::log10(0.08 * 0.5), tt::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(how_a_scene_is_solved_is_told_from_what_it_is) {
  for (const char* key : {"viscosity", "viscosity.c1", "diffusion.scheme", "load[0].transfer", "load[0].thickness",
                          "plate.cell_aspect", "model.pic"})
    BOOST_TEST(is_numerical(key), key);
  for (const char* key : {"material.nu", "load[0].traction", "diffusion.lambda1", "damage.rate", "viscosities"})
    BOOST_TEST(!is_numerical(key), key);
  const Folder folder;
  const auto file = folder.path / "t.toml";
  std::ofstream(file) << text;
  const auto cases = with_values(read_case(file), {"load[0].traction=1,2", "viscosity.form=linear-quadratic",
                                                   "viscosity.c1=0,0.06", "viscosity.c2=0", "cells=40"});
  const Trade t = measure_trade(cases, {}, {});
  BOOST_TEST_REQUIRE(t.points.size() == 4U * 6U);
  const Trade plain = measured(with({"cells=40"}), 0);
  for (const TradePoint& point : t.points) {
    BOOST_TEST(point.completed(), point.label + ": " + point.message);
    BOOST_TEST(point.which < 4U);
    BOOST_TEST(point.scene == (point.which < 2 ? "load[0].traction=1" : "load[0].traction=2"));
    BOOST_TEST(point.setting.ends_with("viscosity.c2=0"));
    BOOST_TEST_REQUIRE(point.error_of("stress.L2", 1) != nullptr);
    if (point.which == 0)  // no viscosity is none
      BOOST_TEST(point.error_of("stress.L2", 1)->error == plain.points[point.leaf].error_of("stress.L2", 1)->error);
  }
  BOOST_TEST(reports::of_scene(t, "load[0].traction=1").points.size() == 12U);
  expect_in(message_of([&] { with_values(read_case(file), {"viscosity.c1=0.06"}); }),
            {"viscosity.form: missing", "viscosity.c2"});
}

BOOST_AUTO_TEST_CASE(a_variant_of_numerics_alone_is_a_setting_of_the_same_scene) {
  const std::string strip_text = head("t", "code-verification") + strip("42e-3") + glass() + guided() + R"toml(
[flyer]
thickness = 18e-3
velocity = 684.0
[viscosity]
form = "york"
c1 = 0.2
c2 = 0.2
[model]
features = ["elastic", "impact", "viscosity"]
[[variant]]
id = "inviscid"
says = "s"
without = ["viscosity"]
[[variant]]
id = "fast"
says = "s"
set = { "flyer.velocity" = 700.0 }
[exact]
solution = "plate-impact"
)toml" + axes({"fem", "mpm-musl"}, "21, 42, 84, 168", "0.25") +
                                 R"toml(variant = ["", "inviscid", "fast"]
[sample]
times = { unit = "s", at = [5e-6] }
gauges = [{ id = "g", from_face = 6e-3 }]
)toml" + gate("near", "exact", "displacement.L2", "max = 1.0\n");
  const Case c = parse_case(strip_text, "t.toml");
  const Trade t = measured(c, 0);
  BOOST_TEST_REQUIRE(t.points.size() == 24U);
  for (const TradePoint& point : t.points) {
    BOOST_TEST(point.completed(), point.label + ": " + point.message);
    BOOST_TEST(point.scene == (holds(point.label, "fast") ? "fast" : ""));
    // What an elastic shock does is known; how long it takes to rise on a mesh is only to be extrapolated.
    const reports::TradeError* arrival = point.error_of("gauge.g.arrival", 5e-6);
    BOOST_TEST_REQUIRE(arrival != nullptr);
    BOOST_TEST(arrival->band == 0);
    const reports::Run run = run_leaf(bare(c), leaves(c).at(point.leaf));
    BOOST_TEST(arrival->error ==
               std::abs(run.measures.at("gauge.g.arrival") / run.measures.at("gauge.g.arrival.exact") - 1));
    BOOST_TEST(point.error_of("gauge.g.plateau", 5e-6) != nullptr);
  }
  // The face of its flyer would lie between two columns of nodes of a mesh that is proposed.
  Target target;
  target.aim = {"gauge.g.arrival", 5e-6};
  const Trial trial = tried({c}, target, {"fem C=0.25", 0, 0, 1, 22, 0.01}, {});
  expect_in(trial.words, {"fem C=0.25 with 22 cells", "cannot be run", "column"});
  BOOST_TEST((!trial.confirmed && !trial.point.completed()));
  // A solid that fails behind its shock has an arrival like any, and no plateau that theory knows.
  const reports::Run first = run_leaf(bare(c), leaves(c).front());
  Case failing = c;
  failing.plate->solid = solid::Failing{};
  const auto exact = [&](const Case& one, const std::string& quantity) {
    for (const RunNumber& reading : readings(one, first))
      if (reading.quantity == quantity) return reading.error.has_value();
    return false;
  };
  BOOST_TEST((exact(c, "gauge.g.plateau") && exact(c, "gauge.g.arrival") && !exact(c, "gauge.g.rise")));
  BOOST_TEST((!exact(failing, "gauge.g.plateau") && exact(failing, "gauge.g.arrival")));
}

BOOST_AUTO_TEST_CASE(outcomes_and_what_is_extrapolated_are_errors_too) {
  Case c = parse_case(text, "t.toml");
  c.bars.resize(2);
  reports::Run run = made_run("fem", 10, 0.5);
  run.measures = {{"contact.duration", 2.2},
                  {"contact.duration.error", 0.1},
                  {"contact.restitution", 0.9},
                  {"energy.drift", 1e-14},
                  {"contact.end", std::nan("")}};
  const auto read = readings(c, run);
  BOOST_TEST_REQUIRE(read.size() == 2U);
  BOOST_TEST(read[0].quantity == "contact.duration");
  BOOST_TEST(read[0].time == 1);
  BOOST_TEST(read[0].error.value() == 0.1);
  BOOST_TEST(read[1].quantity == "contact.restitution");
  BOOST_TEST(!read[1].error.has_value());
  // 1 + h²: four meshes of "a" tell that it goes to 1; "b" has two, and is measured by it.
  Trade t;
  std::vector<std::vector<RunNumber>> of;
  for (const int cells : {10, 20, 40, 80}) {
    t.points.push_back(made("a", cells, 0, 100));
    of.push_back({{"probe.p", 1, 1 + 1.0 / (cells * cells)}});
  }
  for (const int cells : {10, 20}) {
    t.points.push_back(made("b", cells, 0, 100));
    of.push_back({{"probe.p", 1, 1 - 3.0 / (cells * cells)}});
  }
  t.points.push_back(made("a", 10, 0, 100));
  t.points.back().scene = "other";
  of.push_back({{"probe.p", 1, 5.0}});
  add_extrapolated(of, t);
  BOOST_TEST(t.points[0].error_of("probe.p", 1)->error == 0.01, tt::tolerance(1e-6));
  BOOST_TEST(t.points[5].error_of("probe.p", 1)->error == 0.0075, tt::tolerance(1e-6));
  BOOST_TEST(t.points[0].error_of("probe.p", 1)->band > 0);
  BOOST_TEST(t.points[5].error_of("probe.p", 1)->band == t.points[0].error_of("probe.p", 1)->band);
  BOOST_TEST((t.points[6].error_of("probe.p", 1) == nullptr));
}

BOOST_AUTO_TEST_CASE(a_run_that_takes_too_long_is_stopped_and_stays_a_point) {
  Case c = parse_case(text, "t.toml");
  c.axes.front().method = {"fem"};
  c.axes.front().cells = {20000};  // 40 000 steps
  Running running;
  running.limit_seconds = 0.005;
  Trade t = measure_trade({c}, running, {1});
  BOOST_TEST_REQUIRE(t.points.size() == 1U);
  BOOST_TEST(t.points[0].status == "timed out");
  expect_in(t.points[0].message, {"stopped after 0.005 s at step", "of about 40000"});
  BOOST_TEST(t.points[0].steps < 40000);
  BOOST_TEST(t.points[0].timed.rounds == 1);
  BOOST_TEST(t.points[0].timed.seconds > 0);
  BOOST_TEST(t.points[0].errors.empty());
  expect_in(reports::trade_csv(t), {",timed out,"});
  // What would take far longer than runs before it is not begun.
  running.limit_seconds = 0.05;
  c.axes.front().cells = {2000, 1000000};
  t = measure_trade({c}, running, {0});
  BOOST_TEST_REQUIRE(t.points.size() == 2U);
  BOOST_TEST(t.points[1].status == "timed out");
  expect_in(t.points[1].message, {"not begun"});
  BOOST_TEST(t.points[1].work() == 0);
}

BOOST_AUTO_TEST_CASE(a_deadline_tells_time_from_cancelling) {
  const auto begin = std::chrono::steady_clock::now();
  const Deadline soon(0.02, nullptr);
  while (!*soon.stop()) std::this_thread::yield();
  BOOST_TEST(soon.passed());
  BOOST_TEST(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() >= 0.02);
  std::atomic<bool> cancelled{false};
  const Deadline late(3600, &cancelled);
  BOOST_TEST(!*late.stop());
  cancelled = true;
  while (!*late.stop()) std::this_thread::yield();
  BOOST_TEST(!late.passed());
}

BOOST_AUTO_TEST_CASE(plates_are_timed_with_several_threads) {
  const Case bars = parse_case(text, "t.toml");
  expect_in(message_of([&] { measure_trade({bars}, {}, {1, {1, 2}}); }), {"--over threads", "plate"});
  const std::string plate_text =
      head("t", "code-verification") + plate("1.0", "1.0") + elastic("1e4", "0.3", "1") +
      supports("free", "free", "free", "free") +
      "[model]\nfeatures = [\"elastic\"]\n[exact]\nsolution = \"lame-mode\"\nmode = 1\namplitude = 1e-3\n" +
      axes({"fem"}, "4", "0.3") + "[sample]\ntimes = { unit = \"s\", at = [0.01] }\n" +
      gate("near", "exact", "displacement.L2", "max = 1.0\n");
  const Trade t = measure_trade({parse_case(plate_text, "t.toml")}, {}, {1, {1, 2}});
  BOOST_TEST_REQUIRE(t.points.size() == 2U);
  BOOST_TEST(t.points[0].label + " | " + t.points[1].label == "fem N=4 C=0.3 threads=1 | fem N=4 C=0.3 threads=2");
  BOOST_TEST(t.points[1].setting == "fem C=0.3 threads=2");
  BOOST_TEST(t.points[1].threads == 2);
  BOOST_TEST(t.points[1].timed.rounds == 1);
  BOOST_TEST(t.points[0].work() == t.points[1].work());
}

BOOST_AUTO_TEST_SUITE_END()
