#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "runner/app/case_file.hpp"
#include "runner/app/catalogue.hpp"
#include "runner/app/provenance.hpp"
#include "runner/run/doubt.hpp"
#include "runner/run/runner.hpp"
#include "runner/run/sharing.hpp"
#include "tests/messages.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(running_cases)

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;
namespace tt = boost::test_tools;

namespace {

Case by_id(const std::string& id) { return select_cases({id}).at(0); }

/// Everything a run says but its wall time.
bool same(const reports::Run& a, const reports::Run& b) {
  if (a.status != b.status || a.measures != b.measures || a.samples.size() != b.samples.size()) return false;
  for (std::size_t s = 0; s < a.samples.size(); ++s) {
    for (std::size_t e = 0; e < a.samples[s].errors.size(); ++e) {
      const auto &x = a.samples[s].errors[e], &y = b.samples[s].errors[e];
      if (x.l1 != y.l1 || x.l2 != y.l2 || x.linf != y.linf || x.time != y.time) return false;
    }
  }
  return a.steps == b.steps && a.bytes == b.bytes && a.element_steps == b.element_steps;
}

}  // namespace

BOOST_AUTO_TEST_CASE(any_number_of_threads_gives_the_same_bits) {
  const std::vector<Case> cases{by_id("bar.step.free-free"), by_id("bar.mode.fixed-free")};
  const auto one = run_cases(cases, {1}), four = run_cases(cases, {4});
  std::size_t compared = 0;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    for (std::size_t r = 0; r < one[c].runs.size(); ++r, ++compared) {
      BOOST_TEST(same(one[c].runs[r], four[c].runs[r]), one[c].runs[r].label());
    }
  }
  BOOST_TEST(compared > 20U);
}

BOOST_AUTO_TEST_CASE(runs_that_plates_have_in_common_are_made_once) {
  std::ifstream file(by_id("plate.damage").path);
  std::stringstream text;
  text << file.rdbuf();
  const std::string whole = text.str(), gate = R"([[gate]]
id = "whole"
kind = "invariant"
quantity = "area.error"
max = 1e-12
reason = "to the end"
)";
  const std::string one_mesh =
      replaced(whole.substr(0, whole.find("[[gate]]")), "cells = [10, 16, 20, 40, 80, 160]", "cells = [10]") + gate;
  const auto read = [&](const std::string& id, const std::string& from, const std::string& to) {
    const std::string named = replaced(one_mesh, "id = \"plate.damage\"", "id = \"" + id + "\"");
    return parse_case(replaced(named, from, to), "t.toml");
  };
  const std::vector<Case> cases{read("plate.one", "", ""),
                                read("plate.same", "courant = [0.5]", "courant = [0.5, 0.4]"),
                                read("plate.other", "radius = 0.1", "radius = 0.11")};
  const auto results = run_cases(cases, {1});
  std::size_t compared = 0;
  for (std::size_t r = 0; r < results[0].runs.size(); ++r) {
    const reports::Run &first = results[0].runs[r], &other = results[2].runs.at(r);
    for (const reports::Run& second : results[1].runs) {
      if (second.label() != first.label()) continue;
      BOOST_TEST(second.case_id == "plate.same");
      BOOST_TEST(second.status == "completed");
      BOOST_TEST(same(first, second));
      BOOST_TEST(first.wall_seconds == second.wall_seconds);
      ++compared;
    }
    BOOST_TEST(other.case_id == "plate.other");
    BOOST_TEST(!same(first, other));
    BOOST_TEST(first.wall_seconds != other.wall_seconds);
  }
  BOOST_TEST(compared == 2U);
}

BOOST_AUTO_TEST_CASE(runs_are_told_apart_by_all_that_they_see) {
  std::ifstream file(by_id("plate.damage").path);
  std::stringstream text;
  text << file.rdbuf();
  const Leaf leaf{"fem", 16, 0.5, {}, {}, ""};
  const auto words = [&](const std::string& from, const std::string& to, const Running& running = {}) {
    return words_of_run(parse_case(replaced(text.str(), from, to), "t.toml"), leaf, running);
  };
  const std::string plain = words("", "");
  BOOST_TEST(words("id = \"plate.damage\"", "id = \"plate.same\"") == plain);
  BOOST_TEST(words("cells = [10, 16, 20, 40, 80, 160]", "cells = [10, 16, 20, 40, 80, 160, 320]") == plain);
  BOOST_TEST(words("apart = [0.05, 0.03, 0.01, 0.005]", "apart = [0.05, 0.03, 0.01, 0.006]") == plain);
  BOOST_TEST(words("height = 1.5", "height = 1.6") != plain);
  BOOST_TEST(words("E = 50e9", "E = 51e9") != plain);
  BOOST_TEST(words("at = [0.4e-3, ", "at = [0.3e-3, 0.4e-3, ") != plain);
  BOOST_TEST(words("level = 0.05, angle = 45", "level = 0.05, angle = 46") != plain);
  BOOST_TEST(words("quantity = \"bits.threads\"", "quantity = \"bits.repeat\"") != plain);
  BOOST_TEST(words("", "", {.books = Books::lines}) != plain);
  BOOST_TEST(words("", "", {.keep_fields = true}) != plain);
  Leaf finer = leaf;
  finer.cells = 20;
  Case c = parse_case(text.str(), "t.toml");
  BOOST_TEST(words_of_run(c, finer, {}) != plain);
  c.changed = "material.nu=0.3";
  BOOST_TEST(words_of_run(c, leaf, {}) != plain);
  c.changed.clear();
  Leaf literal = leaf;
  literal.variant = "literal";
  BOOST_TEST(words_of_run(c, literal, {}) != plain);
  // A swept value is told to its last digit, which a label does not show.
  Leaf swept = leaf, beside = leaf;
  swept.parameters = {{"v0", 0.1}};
  beside.parameters = {{"v0", 0.1000000000000001}};
  BOOST_TEST(words_of_run(c, swept, {}) != words_of_run(c, beside, {}));
}

BOOST_AUTO_TEST_CASE(a_step_above_the_limit_is_refused_with_both_numbers) {
  Case c = by_id("bar.step.free-free");
  c.axes[0].courant = {1.25};
  try {
    run_cases({c}, {});
    BOOST_FAIL("was not refused");
  } catch (const InputError& error) {
    const std::string said = error.what();
    BOOST_TEST(holds(said, "0.000125"), said);  // asked: 1.25 · 0.01/100
    BOOST_TEST(holds(said, "0.0001 "), said);   // limit
    BOOST_TEST(holds(said, "allow_unstable"), said);
  }
}

BOOST_AUTO_TEST_CASE(the_step_count_is_rounded_up_and_never_to_nearest) {
  Case c = by_id("bar.step.free-free");
  c.axes = {{{"fem"}, {100}, {0.9}, {{0.5}}, {}}};
  c.times = {1.0};
  c.gates.clear();
  const auto run = run_leaf(c, leaves(c).at(0));
  BOOST_TEST(run.steps == 112);  // 100/0.9 = 111.1
  BOOST_TEST(run.courant == 100.0 / 112, tt::tolerance(1e-12));
  c.axes[0].courant = {1.0};
  BOOST_TEST(run_leaf(c, leaves(c).at(0)).steps == 100);  // not 101 for round-off's sake
}

BOOST_AUTO_TEST_CASE(features_other_than_declared_make_a_run_invalid) {
  Case c = by_id("bar.step.free-free");
  c.features = {"elastic", "viscosity"};
  const auto run = run_leaf(c, leaves(c).at(0));
  BOOST_TEST(holds(run.invalid, "viscosity"), run.invalid);
}

BOOST_AUTO_TEST_CASE(two_sample_times_on_one_step_are_two) {
  Case c = by_id("bar.free-fall");
  c.times = {0.5, 0.5001, 1.0};
  for (const Leaf& leaf : leaves(c)) {
    const auto run = run_leaf(c, leaf);
    BOOST_TEST_REQUIRE(run.samples.size() == 3U);
    BOOST_TEST(run.invalid == "");
    for (const auto& sample : run.samples)
      BOOST_TEST(sample.probes.at(0).value == 9 * sample.asked, tt::tolerance(1e-12));
  }
}

// Shear on in tension, off in compression, twice round and once the other way, at a fixed crack density: what the books
// call the scheme's, in which energy from nowhere would stand, is the same at the same stage of each turn, to 1e-12 of
// what the literal reading of closure gives at most, 2Ga². So is what damage has taken.
BOOST_AUTO_TEST_CASE(a_closed_cycle_gives_nothing_and_takes_nothing) {
  const Case c = by_id("plate.cycle");
  const double steps_of_part = 200;
  std::size_t compared = 0;
  for (const Leaf& leaf : leaves(c)) {
    if (leaf.variant == "cone" || leaf.variant == "literal") continue;
    Running running;
    running.books = Books::lines;
    const auto run = run_leaf(c, leaf, running);
    BOOST_TEST_REQUIRE(run.status == "completed");
    BOOST_TEST_REQUIRE(run.steps == 14 * 200);
    const auto middle_of = [&](int part) {
      return run.ledger.at(static_cast<std::size_t>((part + 0.5) * steps_of_part));
    };
    const double shear_modulus = (leaf.variant == "plane-stress" ? 5.4e10 : 4.8e10) / (2 * 1.25), shear = 5e-4;
    const double most = 1e-12 * 2 * shear_modulus * shear * shear;
    const auto same = [&](int part, int other) {
      BOOST_TEST_CONTEXT(run.label() << ", part " << part << " and part " << other) {
        BOOST_TEST(std::abs(middle_of(part).scheme - middle_of(other).scheme) <= most);
        BOOST_TEST(middle_of(part).dissipated == middle_of(other).dissipated);
        BOOST_TEST(std::abs(middle_of(part).scheme) > most);  // of what came before
      }
    };
    for (const int part : {2, 3, 4, 5}) same(part, part + 4);
    same(9, 12);  // back into tension, without shear and with it
    same(7, 10);  // into compression, with it and without
    ++compared;
  }
  BOOST_TEST(compared == 5U * 4);
}

// The exact solution's own test looks long enough, however short the runs.
BOOST_AUTO_TEST_CASE(a_short_run_can_be_judged) {
  Case c = by_id("bar.step.free-free");
  c.times = {0.02};
  c.gates.clear();
  c.figures.clear();
  const auto results = run_cases({c}, {2});
  for (const auto& run : results[0].runs) BOOST_TEST(run.invalid == "");
}

BOOST_AUTO_TEST_CASE(runs_not_begun_when_asked_to_stop_are_left_out) {
  const std::atomic<bool> cancelled{true};
  const auto results = run_cases({by_id("bar.step.free-free")}, {2, &cancelled});
  for (const auto& run : results[0].runs) BOOST_TEST(run.status == "cancelled");
}

BOOST_AUTO_TEST_CASE(the_ledger_is_kept_where_it_is_asked_for) {
  const Case c = by_id("bar.energy");
  const Leaf leaf = leaves(c).at(0);
  BOOST_TEST(run_leaf(c, leaf).ledger.empty());
  Running running;
  running.books = Books::lines;
  const auto run = run_leaf(c, leaf, running);
  BOOST_TEST(run.ledger.size() == static_cast<std::size_t>(run.steps));
}

BOOST_AUTO_TEST_CASE(every_case_that_comes_with_the_program_is_locked) {
  const auto differences = differences_from_lock(all_cases(), true);
  for (const auto& line : differences) BOOST_TEST_MESSAGE(line);
  BOOST_TEST(differences.empty());
}

// What a list of tables with ids declares goes by the ids: one more of them moves no line of the others.
BOOST_AUTO_TEST_CASE(a_declaration_names_variants_and_probes) {
  Case c = by_id("plate.choices");
  BOOST_TEST(c.scene["variant[heals].set.damage.heals"] == "true");
  BOOST_TEST(c.scene["variant[step-load].set.load[0].traction"] == "7e+08");
  BOOST_TEST(!c.scene.contains("variant[heals].says"));
  BOOST_TEST(!c.scene.contains("variant[heals].id"));
}

BOOST_AUTO_TEST_CASE(what_differs_from_the_lock_is_named) {
  const auto only_difference = [](const std::vector<Case>& cases) {
    const auto differences = differences_from_lock(cases, true);
    BOOST_TEST(differences.size() == 1U);
    return differences.empty() ? "" : differences.front();
  };
  auto cases = all_cases();
  BOOST_REQUIRE(cases.at(0).id == "bar.body-force");
  BOOST_REQUIRE(cases[0].gates.at(0).id == "displacement-order");
  Declaration& scene = cases[0].scene;
  Declaration& gate = cases[0].gates[0].declaration;
  const Declaration scene_was = scene, gate_was = gate;
  gate["band"] = "[1.9 2.2]";
  BOOST_TEST(only_difference(cases) == "bar.body-force/displacement-order: band = [1.9 2.2] is locked as [1.9 2.1]");
  gate = gate_was;
  gate["slow"] = "true";
  BOOST_TEST(only_difference(cases) == "bar.body-force/displacement-order: slow = true is not in cases/gates.lock");
  gate = gate_was;
  gate.erase("expect");
  BOOST_TEST(only_difference(cases) ==
             "bar.body-force/displacement-order: expect = 2 is in cases/gates.lock but the case does not declare it");
  gate = gate_was;
  scene["axes[0].cells"] = "[20 40 80]";
  BOOST_TEST(only_difference(cases) == "bar.body-force: axes[0].cells = [20 40 80] is locked as [20 40 80 160]");
  scene = scene_was;
  cases[0].gates[0].reason = "A reason is not locked.";
  BOOST_TEST(differences_from_lock(cases, true).empty());

  cases[0].gates[0].id = "renamed";
  BOOST_TEST(differences_from_lock(cases, true).size() == 2U);
  cases[0].gates.erase(cases[0].gates.begin());
  BOOST_TEST(only_difference(cases) ==
             "bar.body-force/displacement-order is in cases/gates.lock but no case declares it");
  BOOST_TEST(differences_from_lock(cases, false).empty());  // part of the catalogue may be asked for
}

BOOST_AUTO_TEST_CASE(selectors_find_ids_patterns_and_single_gates) {
  BOOST_TEST(select_cases({"bar.step.*"}).size() == 2U);
  const auto one = select_cases({"bar.step.fixed-free/energy", "bar.step.fixed-free/momentum"});
  BOOST_REQUIRE(one.size() == 1U);
  BOOST_TEST(one[0].gates.size() == 2U);
  BOOST_CHECK_EXCEPTION(select_cases({"bar.step.fixed-fre"}), InputError, says({"bar.step.fixed-free"}));
  BOOST_CHECK_THROW(select_cases({"bar.step.fixed-free/enrgy"}), InputError);
  BOOST_CHECK_THROW(select_cases({"nowhere.toml"}), InputError);
}

BOOST_AUTO_TEST_CASE(runs_are_kept_by_their_labels) {
  const Case whole = by_id("impact.sweep");  // which sweeps a parameter
  const auto all = leaves(whole);
  const auto label_of = [](const Case& c, const Leaf& leaf) { return describe(c, leaf).label(); };
  for (const Leaf& leaf : {all.front(), all.back()}) {
    std::vector<Case> cases{whole, by_id("bar.energy")};
    keep_runs(cases, {label_of(whole, leaf)});
    BOOST_REQUIRE(cases.size() == 1U);  // of the other case no run has this label
    BOOST_TEST((leaves(cases[0]) == std::vector<Leaf>{leaf}));
  }
  std::vector<Case> cases{by_id("bar.step.free-free")};
  const auto before = leaves(cases[0]);
  const std::string least = "mpm-musl N=*", most = label_of(cases[0], before.front());
  keep_runs(cases, {least, most});
  const auto kept = leaves(cases[0]);
  BOOST_TEST(!kept.empty());
  BOOST_TEST(kept.size() < before.size());
  for (const Leaf& leaf : before) {
    const bool wanted = leaf.method == "mpm-musl" || leaf == before.front();
    BOOST_TEST((std::find(kept.begin(), kept.end(), leaf) != kept.end()) == wanted, label_of(cases[0], leaf));
  }
}

BOOST_AUTO_TEST_CASE(a_label_of_no_run_is_answered_with_those_there_are) {
  std::vector<Case> cases{by_id("bar.energy")};
  const std::string said = message_of<InputError>([&] { keep_runs(cases, {"fem N=100 C=0.9", "fem N=100 C=0.8"}); });
  BOOST_TEST(holds(said, "no run 'fem N=100 C=0.8' (did you mean 'fem N=100 C=0.9'?); there are\n  fem N=100 C=0.9"));
  BOOST_TEST(!holds(said, "mpm"));
  cases = {by_id("bar.energy")};
  const std::string unlike = message_of<InputError>([&] { keep_runs(cases, {"x"}); });
  BOOST_TEST(holds(unlike, "  mpm-musl N=100 C=0.9 ppc=1"));
}

BOOST_AUTO_TEST_CASE(threads_that_no_run_needs_go_into_the_runs_that_are_large_enough) {
  BOOST_TEST(threads_within(8, 2, 1'000'000) == 4);
  BOOST_TEST(threads_within(8, 3, 1'000'000) == 2);
  BOOST_TEST(threads_within(8, 16, 1'000'000) == 1);
  BOOST_TEST(threads_within(8, 1, 9'999) == 1);
  BOOST_TEST(threads_within(8, 1, 29'999) == 2);
  BOOST_TEST(threads_within(1, 1, 1'000'000) == 1);
}

BOOST_AUTO_TEST_CASE(a_solution_is_trusted_by_its_own_test_alone) {
  BOOST_TEST(doubt(1e-5) == "");
  BOOST_TEST(doubt(1e-3).find("fails its own test") != std::string::npos);
  for (const double untested : {std::nan(""), std::numeric_limits<double>::infinity()})
    BOOST_TEST(doubt(untested).find("fails its own test") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
