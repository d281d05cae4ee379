#include "runner/store/store.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <set>

#include "reports/files.hpp"
#include "reports/run_record.hpp"
#include "runner/app/catalogue.hpp"
#include "runner/run/runner.hpp"
#include "runner/run/sharing.hpp"
#include "tests/folder.hpp"
#include "tests/messages.hpp"

BOOST_AUTO_TEST_SUITE(store)

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A run in which nothing is as it is in a new one.
reports::Run full_run() {
  reports::Run run;
  run.case_id = "bar.one";
  run.method = "mpm-usl";
  run.work_unit = "particle-steps";
  run.cells = 7;
  run.courant_asked = 0.1;
  run.courant = 1.0 / 3;
  run.particles = "0.25 0.75";
  run.parameters = "v0=0.1";
  run.status = "completed";
  run.message = "π and\nmore";
  run.cell_size = 0.1;
  run.unknowns = 14;
  run.time_step = -0.0;
  run.time_step_limit = infinity;
  run.steps = 1L << 40;
  run.element_steps = 2;
  run.particle_steps = 3;
  run.node_steps = 4;
  run.bytes = std::size_t{1} << 41;
  run.wall_seconds = 5e-324;
  run.features = {"viscosity"};
  run.finite = false;
  run.invalid = "why";
  run.measures = {{"energy.drift", std::nan("7")}};
  reports::Sample sample;
  sample.asked = 1;
  sample.time = 2;
  sample.errors = {{"stress", 1, 2, 3, 4, 5, 6.0, {}, -infinity}};
  sample.probes = {{"tip", 1.5, 2.5}, {"root", 3.5, {}}};
  sample.curves = {{"stress", {{1, std::nan("")}, {3, 4}}}};
  sample.exact_curves = {{"velocity", {{5}, {6}}}};
  sample.plate = reports::PlateFields{2, 3, 4, 5, {6, 7}, {8, 9}};
  sample.files = {{"mesh", {{1}, {2}, {0}, 3}, {{"velocity", {"x", "y"}, {7, 8}, true}}}};
  sample.bar_points = {{"nodes", {1}, {2}, {{"stress", {3}}}, {{"velocity", {4}}}}};
  run.samples = {sample, {}};
  run.ledger = {{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}};
  run.paths = {{1}, {2}};
  run.exact_paths = {{3}, {4}};
  run.path_origins = {5};
  run.gauges = {{"one", 1, {2}, {3}, {4}, {5}}};
  run.platen = {{6}, {7}};
  return run;
}

void write_as_it_is(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_run_comes_back_to_the_last_bit) {
  const reports::Run run = full_run();
  const std::string bytes = reports::run_record(run);
  const reports::Run back = reports::run_of_record(bytes);
  BOOST_TEST(reports::run_record(back) == bytes);  // NaN and -0 with it
  BOOST_TEST(reports::run_record(reports::Run()) != bytes);
  BOOST_TEST(back.label() == run.label());
  BOOST_TEST(back.message == run.message);
  BOOST_TEST(std::isnan(back.measures.at("energy.drift")));
  BOOST_TEST(std::signbit(back.time_step));
  BOOST_TEST(back.samples.at(0).plate->damage.at(1) == 9);
  BOOST_TEST(!back.samples.at(1).plate);
  BOOST_TEST(back.samples.at(0).probes.at(0).predicted.value() == 2.5);
  BOOST_TEST(!back.samples.at(0).probes.at(1).predicted);
  BOOST_TEST(back.samples.at(0).files.at(0).arrays.at(0).on_cells);
  BOOST_TEST(back.ledger.at(0).impulse == 11);
  BOOST_TEST(back.bytes == run.bytes);
}

BOOST_AUTO_TEST_CASE(a_part_of_a_record_or_more_than_one_is_none) {
  const std::string bytes = reports::run_record(full_run());
  for (std::size_t length = 0; length < bytes.size(); length += 7)
    BOOST_CHECK_THROW(reports::run_of_record(bytes.substr(0, length)), std::runtime_error);
  BOOST_CHECK_THROW(reports::run_of_record(bytes + "x"), std::runtime_error);
}

BOOST_AUTO_TEST_CASE(what_was_kept_is_found_by_its_words_and_its_build) {
  const Folder folder;
  const Store one(folder.path, "build one"), other(folder.path, "build two");
  BOOST_TEST(!one.find("words"));
  one.keep("words", full_run());
  BOOST_REQUIRE(one.find("words"));
  BOOST_TEST(reports::run_record(*one.find("words")) == reports::run_record(full_run()));
  BOOST_TEST(!one.find("words "));
  BOOST_TEST(!other.find("words"));
  const auto records = one.records();
  BOOST_TEST_REQUIRE(records.size() == 1U);
  BOOST_TEST(records[0].build == "build one");
  BOOST_TEST(records[0].words == "words");
  BOOST_TEST(records[0].case_id == "bar.one");
  BOOST_TEST(records[0].label == full_run().label());
  BOOST_TEST(records[0].damage == "");
  // The same words again take its place.
  reports::Run later = full_run();
  later.steps = 1;
  one.keep("words", later);
  BOOST_TEST(one.find("words")->steps == 1);
  BOOST_TEST(one.records().size() == 1U);
}

BOOST_AUTO_TEST_CASE(what_is_not_whole_is_not_believed) {
  const Folder folder;
  const Store it(folder.path, "build");
  it.keep("words", full_run());
  const auto file = it.file_of("words");
  const std::string good = contents(file);
  BOOST_TEST(it.find("words").has_value());
  std::size_t tried = 0;
  const auto refused = [&](const std::string& bytes, const std::string& why) {
    write_as_it_is(file, bytes);
    BOOST_TEST(!it.find("words"), why);
    BOOST_TEST(it.records().at(0).damage != "", why);
    ++tried;
  };
  for (std::size_t length = 0; length < good.size(); length += 101) refused(good.substr(0, length), "a part");
  for (std::size_t at = 0; at < good.size(); at += 97) {
    std::string flipped = good;
    flipped[at] = static_cast<char>(flipped[at] ^ 1);
    refused(flipped, "a bit at " + std::to_string(at));
  }
  refused(good + "x", "one more byte");
  refused(good + good, "twice");
  BOOST_TEST(tried > 20U);
  write_as_it_is(file, good);
  BOOST_TEST(it.find("words").has_value());
  // A whole record under another's name is not the other.
  std::filesystem::create_directories(it.file_of("other").parent_path());
  write_as_it_is(it.file_of("other"), good);
  BOOST_TEST(!it.find("other"));
  std::size_t damaged = 0;
  for (const StoredRun& record : it.records()) damaged += !record.damage.empty();
  BOOST_TEST(damaged == 1U);
}

BOOST_AUTO_TEST_CASE(runs_are_made_once_and_made_again_where_a_gate_compares_bits) {
  const Folder folder;
  const std::vector<Case> cases = select_cases({"bar.mode.fixed-free", "bar.energy"});
  const auto run = [&](Keeping& keeping) {
    Running running{1};
    running.judged_only = true;
    running.keeping = &keeping;
    return run_cases(cases, running);
  };
  std::size_t of_bits = 0, all = 0;
  for (const Case& c : cases)
    for (const Leaf& leaf : leaves(c)) {
      bool bits = false, judged = false;
      for (const GateSpec& gate : c.gates) {
        judged = judged || matches(gate.where, leaf);
        bits = bits || (gate.quantity.starts_with("bits.") && matches(gate.where, leaf));
      }
      all += judged;
      of_bits += bits;
    }
  BOOST_TEST(of_bits > 0U);
  BOOST_TEST(of_bits < all);
  Keeping first{{folder.path, "build"}}, second{{folder.path, "build"}}, fresh{{folder.path, "build"}, true},
      other{{folder.path, "another build"}}, only{{folder.path, "build"}, false, true},
      none{{folder.path / "empty", "build"}, false, true};
  const auto made = run(first), found = run(second);
  BOOST_TEST(first.found == 0U);
  BOOST_TEST(first.kept == all);
  BOOST_TEST(second.found == all - of_bits);
  BOOST_TEST(second.kept == of_bits);
  run(fresh);
  BOOST_TEST(fresh.found == 0U);
  run(other);
  BOOST_TEST(other.found == 0U);
  const auto judged = run(only);
  BOOST_TEST(only.found == all);
  BOOST_TEST(only.kept == 0U);
  for (std::size_t i = 0; i < made.size(); ++i) {
    for (std::size_t r = 0; r < made[i].runs.size(); ++r) {
      reports::Run a = made[i].runs[r], b = found[i].runs[r], c = judged[i].runs[r];
      a.wall_seconds = b.wall_seconds = c.wall_seconds = 0;
      BOOST_TEST(reports::run_record(a) == reports::run_record(b), a.label());
      BOOST_TEST(reports::run_record(a) == reports::run_record(c), a.label());
    }
  }
  for (const auto& result : run(none))
    for (const auto& one : result.runs) BOOST_TEST(one.status == "missing");
}

BOOST_AUTO_TEST_CASE(what_cannot_be_kept_costs_no_run) {
  const Folder folder;
  write_as_it_is(folder.path / "file", "");
  Keeping keeping{{folder.path / "file" / "store", "build"}};
  Running running{1};
  running.keeping = &keeping;
  for (const auto& run : run_cases(select_cases({"bar.energy"}), running).at(0).runs)
    BOOST_TEST(run.status == "completed");
  BOOST_REQUIRE(keeping.trouble);
  BOOST_TEST(keeping.trouble->find("store") != std::string::npos);
  BOOST_TEST(keeping.kept == 0U);
}

BOOST_AUTO_TEST_CASE(a_stopped_run_is_not_kept) {
  const Folder folder;
  Keeping keeping{{folder.path, "build"}};
  Running running{1};
  running.keeping = &keeping;
  running.limit_seconds = 1e-6;
  std::size_t completed = 0, stopped = 0;
  for (const auto& run : run_cases(select_cases({"glass.wave"}), running).at(0).runs) {
    completed += run.status == "completed";
    stopped += run.status == "timed out";
  }
  BOOST_TEST(stopped > 0U);
  BOOST_TEST(keeping.store.records().size() == completed);
}

BOOST_AUTO_TEST_CASE(shards_divide_all_runs_and_do_not_move_when_cases_are_added) {
  const std::vector<Case> some = select_cases({"bar.mode.*"}), more = select_cases({"bar.*"});
  const auto words_of = [](const std::vector<Case>& cases, std::optional<Shard> shard) {
    Running running{1};
    running.shard = shard;
    std::set<std::string> words;
    for (const PlannedRun& run : plan_runs(cases, running)) BOOST_TEST(words.insert(run.words).second);
    return words;
  };
  const auto all = words_of(some, {});
  std::size_t sum = 0;
  for (int k = 1; k <= 3; ++k) {
    const auto part = words_of(some, Shard{k, 3}), of_more = words_of(more, Shard{k, 3});
    sum += part.size();
    BOOST_TEST(part.size() > 0U);
    for (const std::string& one : part) {
      BOOST_TEST(all.count(one) == 1U);
      BOOST_TEST(of_more.count(one) == 1U);
    }
  }
  BOOST_TEST(sum == all.size());  // none twice, none left out
}

BOOST_AUTO_TEST_SUITE_END()
