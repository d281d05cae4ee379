// How quick the solvers' loops are: scenes in which something goes on, rows, and what is made of them.
#include "runner/trade/bench.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "reports/bench_table.hpp"
#include "runner/trade/bench_scenes.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(bench)

namespace tt = boost::test_tools;
using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;
using reports::BenchRow;

namespace {

/// Of few points and one round.
std::vector<BenchRow> rows_of(const std::vector<std::string>& scenes, const std::vector<int>& threads = {1}) {
  return runner::bench({scenes, {"fem", "mpm-musl"}, {600}, threads, 1}, nullptr, {});
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_a_scene_is_to_show_goes_on_in_it_from_the_first_step) {
  for (const BenchScene& scene : bench_scenes()) {
    if (!scene.plate) continue;
    const Cells cells{4, 6};
    const Plate plate = scene.plate(cells);
    const Panel& row = panel("mpm-musl");
    const PlateMesh mesh{{cells.x, cells.y, plate.width / 4, plate.height / 6}, {0.25, 0.75}};
    Stepping stepping;
    stepping.time_step = 0.5 * mesh.grid.hx / elastic(plate).pressure_wave_speed();
    stepping.books = Books::off;
    stepping.steps = 1;
    stepping.sample_after = {1};
    const PlateRecord record = row.plate.run(plate, mesh, stepping);
    BOOST_TEST_CONTEXT(scene.id) {
      BOOST_REQUIRE(record.outcome == diptych::Outcome::completed);
      const PlateSnapshot& after = record.snapshots.at(0);
      const auto everywhere = [](const std::vector<double>& values) {
        return !values.empty() && std::all_of(values.begin(), values.end(), [](double v) { return v > 0; });
      };
      BOOST_TEST(everywhere(after.crack_density) == (scene.id == "damage" || scene.id == "diffusion"));
      BOOST_TEST(everywhere(after.dilatancy) == (scene.id == "failure"));
      BOOST_TEST((record.diffusion_updates > 0) == (scene.id == "diffusion" || scene.id == "failure"));
      const bool moved =
          std::find(record.features.begin(), record.features.end(), "convection") != record.features.end();
      BOOST_TEST(moved == (scene.id == "crossing"));
    }
  }
}

BOOST_AUTO_TEST_CASE(each_solver_that_takes_it_is_timed_on_a_scene) {
  const std::vector<BenchRow> rows = rows_of({"elastic", "crossing", "bar"}, {1, 2});
  std::vector<std::string> names;
  for (const BenchRow& row : rows) names.push_back(row.scene + ' ' + row.method + ' ' + std::to_string(row.threads));
  const std::vector<std::string> expected{"elastic fem 1",      "elastic fem 2",       "elastic mpm-musl 1",
                                          "elastic mpm-musl 2", "crossing mpm-musl 1", "crossing mpm-musl 2",
                                          "bar fem 1",          "bar mpm-musl 1"};
  BOOST_TEST(names == expected, tt::per_element());
  for (const BenchRow& row : rows) {
    BOOST_TEST_CONTEXT(row.scene << ' ' << row.method) {
      BOOST_TEST(row.trouble == "");
      BOOST_TEST(row.points == 600U);
      BOOST_TEST((row.step.seconds > 0 && row.step.rounds == 1 && row.bandwidth > 0));
      BOOST_TEST(row.bytes > 8.0 * static_cast<double>(row.points));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_rate_is_of_points_and_the_floor_of_bytes_read_and_written) {
  BenchRow row;
  row.scene = "damage";
  row.method = "fem";
  row.points = 1024;
  row.cells_x = 10;
  row.cells_y = 25;
  row.step = {3, 0x1p-17, 0.02};
  row.bytes = 0x1p16;
  row.bandwidth = 0x1p35;
  row.diffusion = 4096;
  BOOST_TEST(row.rate() == 0x1p27);
  BOOST_TEST(row.of_floor() == 0.5);
  BenchRow other = row;
  other.trouble = "particle 7 left the grid";
  const std::string text = reports::bench_text({row, other});
  BOOST_TEST(holds_all(text, {"damage", "fem", "10x25", "134.2", "2 %", "64", "34.4", "50 %",
                              "4.0 diffusion updates a point", "particle 7 left the grid"}));
  const std::string json = reports::bench_json({row, other}, {});
  BOOST_TEST(holds_all(json, {R"("points_per_second":134217728.0)", R"("of_floor":0.5)",
                              R"("trouble":"particle 7 left the grid")", R"("type":"provenance")"}));
}

BOOST_AUTO_TEST_SUITE_END()
