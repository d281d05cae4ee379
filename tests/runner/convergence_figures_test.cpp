// Figures of convergence and of rupture, and how far a mesh is from settled, from runs made by hand.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "runner/app/case_file.hpp"
#include "runner/draw/readings.hpp"
#include "runner/input/leaf.hpp"
#include "tests/case_figures.hpp"
#include "tests/case_text.hpp"
#include "tests/made_runs.hpp"
#include "tests/text.hpp"

namespace convergence_figures {

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;
using reports::Run;
namespace tt = boost::test_tools;

namespace {

const std::string text = head("t", "cross-code") + plate("1.0", "1.5") + rock + R"toml([parameters]
p = 5e8
)toml" + reference_damage +
                         supports("free", "free", "free", "platen") + R"toml([[load]]
at = "top"
history = "step"
traction = "p"
[model]
features = ["damage", "platen"]
)toml" + axes({"fem", "mpm-musl"}, "4, 10, 20, 40, 80", "0.5") +
                         R"toml(parameters = { p = [4e8, 5e8, 6e8] }
[sample]
times = { unit = "s", at = [1.0, 2.0] }
probes = [
  { id = "r0", reads = "radius", level = 0.05, angle = 0 },
  { id = "r90", reads = "radius", level = 0.05, angle = 90 },
  { id = "a", reads = "area", level = 0.05 },
  { id = "l", reads = "largest" },
]
)toml" + gate("whole", "invariant", "area.error", "max = 1\n") +
                         R"toml([[figure]]
id = "converges"
kind = "convergence"
times = [2.0]
probes = ["r0", "r90", "a"]
parameters = { p = 5e8 }
[[figure]]
id = "ruptures"
kind = "rupture"
over = "p"
probe = "l"
times = [2.0]
[[figure]]
id = "fig13"
cells = 20
levels = [0.1]
parameters = { p = 5e8 }
)toml";

struct Fixture {
  Case c = parse_case(text, "t.toml");
  std::vector<Run> runs;

  /// Radii are 0.5 + h² and a tenth larger along y, areas 2 + h; C_d jumps to 0.56 between 400 and 500 MPa with FEM,
  /// between 500 and 600 MPa with MPM.
  Fixture() {
    for (const char* method : {"fem", "mpm-musl"}) {
      const bool fem = std::string(method) == "fem";
      for (const int cells : {4, 10, 20, 40, 80}) {
        for (const double p : {4e8, 5e8, 6e8}) {
          Run run = made_run(method, cells, 0.5);
          run.parameters = parameters_label(Parameters{{"p", p}});
          const double h = run.cell_size;
          for (const double time : {1.0, 2.0}) {
            reports::Sample sample;
            sample.asked = sample.time = time;
            const double r = 0.5 + h * h;
            sample.probes = {{"r0", r, {}},
                             {"r90", 1.1 * r, {}},
                             {"a", 2 + h, {}},
                             {"l", p > (fem ? 4.5e8 : 5.5e8) ? 0.56 : 0.0, {}}};
            run.samples.push_back(sample);
          }
          runs.push_back(run);
        }
      }
    }
  }
};

bool noted(const std::vector<std::string>& notes, const std::string& part) {
  return std::any_of(notes.begin(), notes.end(), [&](const std::string& note) { return holds(note, part); });
}

}  // namespace

}  // namespace convergence_figures

BOOST_FIXTURE_TEST_SUITE(convergence_figures, convergence_figures::Fixture)

BOOST_AUTO_TEST_CASE(probes_stand_over_the_cell_size_with_their_bands_and_limits) {
  const auto figure = drawn_figure(c, "converges", runs);
  BOOST_TEST_REQUIRE(figure.panels.size() == 3u);
  const auto& panel = figure.panels[0];
  BOOST_TEST(panel.label == "radius of C_d = 0.05 at 0° [m]");
  BOOST_TEST_REQUIRE(panel.series.size() == 4u);
  const auto& values = panel.series[0].curve;
  BOOST_TEST(values.x == (std::vector<double>{0.1, 0.05, 0.025, 0.0125}), tt::per_element());  // 4 cells are too coarse
  BOOST_TEST(values.y[3] == 0.5 + 0.0125 * 0.0125);
  BOOST_TEST((panel.series[0].kind == "fem" && panel.series[1].kind == "fem-thin" && panel.series[2].kind == "mpm"));
  BOOST_TEST(panel.series[1].curve.y[0] < values.y[0]);
  BOOST_TEST(panel.series[1].curve.y[1] > values.y[0]);
  BOOST_TEST(std::isnan(panel.series[1].curve.y[2]));
  BOOST_TEST_REQUIRE(panel.marks.size() == 2u);
  BOOST_TEST(panel.marks[0].at == 0.5, tt::tolerance(1e-6));
  BOOST_TEST(!panel.marks[0].vertical);
  BOOST_TEST((panel.y_range && (*panel.y_range)[0] < 0.5 && (*panel.y_range)[1] > 0.51));
  BOOST_TEST(noted(figure.notes, "Radii on the finest mesh at 0°, 90°: 0.5002, 0.5502 m (FEM), 10.0 % out of round"));
}

BOOST_AUTO_TEST_CASE(runs_that_are_missing_are_not_drawn) {
  std::erase_if(runs, [](const Run& run) { return run.method == "mpm-musl" || run.cells < 40; });
  const auto figure = drawn_figure(c, "converges", runs);
  BOOST_TEST(figure.panels[0].series.size() == 1u);  // two meshes have no band
  BOOST_TEST(figure.panels[0].marks.empty());
  runs.clear();
  for (const auto& panel : drawn_figure(c, "converges", runs).panels) BOOST_TEST(panel.series.empty());
  BOOST_TEST(distance_from_settled(c, c.figures[2], runs).empty());
}

// 20 cells beside 80: 0.5025/0.50015625, 2.05/2.0125.
BOOST_AUTO_TEST_CASE(a_figure_says_how_far_its_mesh_is_from_settled) {
  BOOST_TEST(distance_from_settled(c, c.figures[2], runs) ==
             "This mesh is not settled: beside 80 × 120 cells its radii are off by up to 0 %, its areas by 2 % and its "
             "∫C dA by 0 %");
  for (Run& run : runs)
    if (run.method == "fem" && run.cells == 20) run.samples[0].probes[1].value = 0.8;
  BOOST_TEST(holds(distance_from_settled(c, c.figures[2], runs), "off by up to 45 %"));
  const auto contours = named(drawn_case(c, runs).plate_figures, "fig13");
  BOOST_TEST(noted(contours.notes, "off by up to 45 %"));
  c.figures[2].cells = 80;
  BOOST_TEST(distance_from_settled(c, c.figures[2], runs).empty());
}

BOOST_AUTO_TEST_CASE(the_load_of_rupture_is_read_between_two_loads) {
  const auto figure = drawn_figure(c, "ruptures", runs);
  BOOST_TEST_REQUIRE(figure.panels.size() == 2u);
  const auto &over_load = figure.panels[0], &over_size = figure.panels[1];
  BOOST_TEST(over_load.label == "largest D at 2000 ms, 80 × 120 cells");
  BOOST_TEST(over_load.marks[0].at == 1.0);
  BOOST_TEST(over_load.series[0].curve.x == (std::vector<double>{400, 500, 600}), tt::per_element());
  const double ruptured = over_load.series[0].curve.y[1];  // D of C_d = 0.56
  BOOST_TEST((ruptured > 0.99 && ruptured <= 1));
  BOOST_TEST_REQUIRE(over_size.series[0].curve.y.size() == 5u);
  BOOST_TEST(over_size.series[0].curve.y[0] == 400 + 100 * 0.9 / ruptured, tt::tolerance(1e-9));
  BOOST_TEST(over_size.series[1].curve.y[4] == 500 + 100 * 0.9 / ruptured, tt::tolerance(1e-9));
  BOOST_TEST(
      noted(figure.notes, "Load of rupture between 490 and 590 MPa over methods and meshes: a spread of 20.4 %"));
  for (Run& run : runs)
    for (auto& sample : run.samples) sample.probes[3].value = 0;
  BOOST_TEST(noted(drawn_figure(c, "ruptures", runs).notes, "No rupture begins between 400 and 600 MPa: FEM on 4"));
}

BOOST_AUTO_TEST_SUITE_END()
