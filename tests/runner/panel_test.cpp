// The table of panels: what is known by a name alone, and a third panel as one row of it.
#include "runner/panel.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <set>

#include "reports/figure.hpp"
#include "reports/files.hpp"
#include "reports/tables.hpp"
#include "runner/app/case_file.hpp"
#include "runner/draw/figure_kinds.hpp"
#include "runner/draw/figure_runs.hpp"
#include "runner/input/leaf.hpp"
#include "runner/judge/gates.hpp"
#include "runner/run/runner.hpp"
#include "tests/case_text.hpp"
#include "tests/folder.hpp"
#include "tests/messages.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(panel)

using namespace diptych;
using namespace diptych::runner;
using reports::Verdict;
using tests::holds;
using tests::replaced;

namespace {

/// What another code found, as its reader would hand it over: a bar that has been pulled out by `pull`.
constexpr double pull = 0.25;

Record foreign_bars(const Scene& scene, const BarMesh& mesh, const Stepping& stepping) {
  Record record;
  record.steps = stepping.steps;
  record.time = static_cast<double>(stepping.steps) * stepping.time_step;
  record.features = {"elastic"};
  record.work.element_steps = mesh.cells * stepping.steps;
  const double h = scene.bars[0].length / mesh.cells;
  for (const long step : stepping.sample_after) {
    Field points{static_cast<double>(step) * stepping.time_step, {}, {}, {}, {0}};
    for (int i = 0; i < mesh.cells; ++i) {
      points.x.push_back(scene.bars[0].begin + (i + 0.5) * h);
      points.value.push_back(pull);
    }
    record.snapshots.push_back({step, points, points, points});
  }
  return record;
}

PlateRecord foreign_plate(const Plate& plate, const PlateMesh& mesh, const Stepping& stepping) {
  PlateRecord record;
  record.steps = stepping.steps;
  record.time = static_cast<double>(stepping.steps) * stepping.time_step;
  record.features = {"elastic"};
  const auto cells = mesh.cells();
  for (const long step : stepping.sample_after) {
    PlateSnapshot s;
    s.step = step;
    s.time = static_cast<double>(step) * stepping.time_step;
    PointField points;
    points.time = s.time;
    for (int j = 0; j < cells.y; ++j) {
      for (int i = 0; i < cells.x; ++i) {
        points.x.push_back((i + 0.5) * mesh.grid.hx);
        points.y.push_back((j + 0.5) * mesh.grid.hy);
        points.weight.push_back(plate.width * plate.height / (cells.x * cells.y));
      }
    }
    points.component.assign(2, std::vector<double>(points.x.size(), pull));
    s.displacement = s.velocity = points;
    points.component.push_back(points.component[0]);
    s.stress = points;
    record.snapshots.push_back(s);
  }
  return record;
}

/// The row: everything that a third panel needs.
Panel foreign() {
  Panel row{.id = "other", .name = "Other code", .look = {}, .work = "element-steps"};
  row.look = {
      "other", "Other", false, {"lw 1.1 lc rgb '#123456'"}, {"lw 0.6 lc rgb '#123456'"}, "lw 1.7 lc rgb '#123456'"};
  row.refuses = {{"body-force"}};
  row.bars.run = foreign_bars;
  row.plate.run = foreign_plate;
  return row;
}

const std::string bar = tests::head("t", "code-verification", "paper") + tests::pulled_bar + R"([[axes]]
method = ["fem", "other"]
cells = [10]
courant = [0.5]
[sample]
times = { unit = "L/c", at = [0.5] }
probes = [{ id = "middle", field = "displacement", at = { value = 0.5, unit = "L" } }]
[[gate]]
id = "read"
kind = "exact"
quantity = "probe.middle"
expect = 0.25
max = 0.0
where = { method = "other" }
reason = "t"
[[figure]]
id = "picture"
kind = "profiles"
field = "displacement"
)";

const std::string plate = tests::head("t", "code-verification") + tests::plate("1.0", "0.5") +
                          tests::elastic("1e4", "0.25", "1.0") + R"([supports]
left = "roller"
right = "roller"
bottom = "roller"
top = "roller"
[model]
features = ["elastic"]
[exact]
solution = "p-wave"
mode = 1
amplitude = 1e-3
[[axes]]
method = ["fem", "other"]
cells = [4]
courant = [0.3]
[sample]
times = { unit = "s", at = [0.01] }
probes = [{ id = "middle", reads = "displacement-x", at = [0.5, 0.25] }]
[[gate]]
id = "read"
kind = "exact"
quantity = "probe.middle"
expect = 0.25
max = 0.0
where = { method = "other" }
reason = "t"
)";

std::string with_gate(std::string text, const std::string& gate) { return text + "[[gate]]\nreason = \"t\"\n" + gate; }

/// Why the text is refused; empty where it is not.
std::string refusal(const std::string& text) {
  return tests::message_of<InputError>([&] { parse_case(text, "t.toml"); });
}

reports::Case measured(const Case& c) {
  auto results = run_cases({c}, {});
  for (const GateSpec& gate : c.gates) results[0].gates.push_back(judge(c, gate, results[0].runs));
  add_figures(c, results[0]);
  return results[0];
}

}  // namespace

BOOST_AUTO_TEST_CASE(an_unknown_method_falls_through_nowhere) {
  for (const char* id : {"", "mpm", "mpm-apic", "FEM", "other"}) {
    try {
      runner::panel(id);
      BOOST_ERROR("found " << id);
    } catch (const std::invalid_argument& error) {
      BOOST_TEST(holds(error.what(), "fem, mpm-usf, mpm-usl, mpm-musl, diffusion"), error.what());
    }
  }
  const AddedPanel added(foreign());
  Case c = parse_case(bar, "t.toml");
  c.axes[0].method = {"mpm-apic"};
  BOOST_CHECK_THROW(leaves(c), std::invalid_argument);
  BOOST_CHECK_THROW(run_leaf(c, {"mpm-apic", 10, 0.5, {}, {}, ""}), std::invalid_argument);
  BOOST_CHECK_THROW(AddedPanel{foreign()}, std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(every_row_has_a_name_and_solves_something) {
  std::set<std::string> ids;
  for (const SceneKind kind : {SceneKind::bars, SceneKind::plate, SceneKind::diffusion}) {
    BOOST_TEST(!panels_for(kind).empty());
    for (const std::string& id : panels_for(kind)) {
      const Panel& row = runner::panel(id);
      BOOST_TEST((!row.name.empty() && !row.look.id.empty() && !row.look.lines.empty() && !row.work.empty()));
      BOOST_TEST((row.takes(kind) && row.has_theory(kind) == (kind != SceneKind::diffusion)));
      ids.insert(id);
    }
  }
  BOOST_TEST(ids.size() == 5U);
  BOOST_TEST(looks().size() == 3U);
  for (const auto scheme : {analytic::Scheme::fem, analytic::Scheme::mpm_usl})
    BOOST_TEST((runner::panel(scheme).bar_theory == scheme));
}

BOOST_AUTO_TEST_CASE(a_third_panel_is_one_row) {
  BOOST_TEST(holds(refusal(bar), "\"other\""));  // not there yet
  const AddedPanel added(foreign());
  BOOST_TEST(refusal(bar) == "");
  for (const SceneKind kind : {SceneKind::bars, SceneKind::plate}) {
    BOOST_TEST(panels_for(kind).size() == 5U);
    BOOST_TEST(panels_for(kind).back() == "other");
  }
  BOOST_TEST(panels_for(SceneKind::diffusion).size() == 1U);
  BOOST_TEST(holds(refusal(replaced(bar, "\"other\"]", "\"othr\"]")), "other"));  // listed, and the nearest

  const reports::Case bars = measured(parse_case(bar, "t.toml"));
  BOOST_TEST_REQUIRE(bars.runs.size() == 2U);
  const reports::Run& run = bars.runs[1];
  BOOST_TEST((run.method == "other" && run.status == "completed" && run.invalid == ""), run.message + run.invalid);
  BOOST_TEST((run.unknowns == 10 && run.work_unit == "element-steps" && run.particles == ""));
  BOOST_TEST(std::isnan(run.time_step_limit));
  BOOST_TEST((bars.gates[0].verdict == Verdict::pass), bars.gates[0].message);
  for (const auto& error : run.samples.at(0).errors) {
    BOOST_TEST(error.l2 > 0);
    BOOST_TEST(!error.predicted_l2.has_value());
    BOOST_TEST(!error.predicted_linf.has_value());
  }

  BOOST_TEST(holds(reports::text_table(bars), "== other, Courant number 0.5 asked =="));
  BOOST_TEST(holds(reports::results_jsonl({bars}, {}), "\"method\":\"other\""));

  const reports::Case plates = measured(parse_case(plate, "t.toml"));
  BOOST_TEST_REQUIRE(plates.runs.size() == 2U);
  BOOST_TEST((plates.runs[1].status == "completed" && plates.runs[1].invalid == ""), plates.runs[1].invalid);
  BOOST_TEST((plates.gates[0].verdict == Verdict::pass), plates.gates[0].message);
  BOOST_TEST(plates.runs[0].samples.at(0).errors.size() == plates.runs[1].samples.at(0).errors.size());
}

BOOST_AUTO_TEST_CASE(it_is_drawn_with_its_own_look) {
  const AddedPanel added(foreign());
  const reports::Case result = measured(parse_case(bar, "t.toml"));
  BOOST_TEST_REQUIRE(result.figures.size() == 1U);
  const reports::Figure& figure = result.figures[0];
  bool drawn = false;
  for (const auto& series : figure.panels.at(0).series)
    drawn = drawn || (series.label == "Other code" && series.kind == "other");
  BOOST_TEST(drawn);
  const tests::Folder folder;
  std::string message;
  reports::draw(figure, folder.path, message);
  const std::string gp = tests::contents(folder.path / "picture.gp");
  BOOST_TEST(holds(gp, "lw 1.1 lc rgb '#123456'"), gp);
  BOOST_TEST(family_of_method("other") == "Other");
}

// Nothing is predicted of what no theory is about: such gates are refused when they are read, and INVALID where a case
// was made otherwise.
BOOST_AUTO_TEST_CASE(without_theory_there_is_no_prediction) {
  const AddedPanel added(foreign());
  const std::string step =
      "id = \"step\"\nkind = \"constant\"\nquantity = \"stress.L2\"\npredict = \"discrete-step\"\n"
      "ratio = [0.9, 1.1]\n";
  BOOST_TEST(holds(refusal(with_gate(bar, step)), "\"other\""));
  BOOST_TEST(holds(refusal(with_gate(bar, step)), "for \"fem\", \"mpm-usf\", \"mpm-usl\", \"mpm-musl\""),
             refusal(with_gate(bar, step)));
  BOOST_TEST(refusal(with_gate(bar, step + "where = { method = \"fem\" }\n")) == "");
  const std::string mode =
      "id = \"mode\"\nkind = \"constant\"\nquantity = \"stress.L2\"\npredict = \"mode\"\nratio = [0.9, 1.1]\n";
  BOOST_TEST(holds(refusal(with_gate(plate, mode)), "of which there is no prediction"));
  BOOST_TEST(refusal(with_gate(plate, mode + "where = { method = \"fem\" }\n")) == "");

  for (const std::string& scene : {bar, plate}) {
    Case c = parse_case(with_gate(scene, scene == bar ? step + "where = { method = \"fem\" }\n"
                                                      : mode + "where = { method = \"fem\" }\n"),
                        "t.toml");
    c.gates[1].where.method = {"other"};
    const reports::Case result = measured(c);
    BOOST_TEST((result.gates[1].verdict == Verdict::invalid));
    BOOST_TEST(holds(result.gates[1].message, "has no prediction"), result.gates[1].message);
  }
}

BOOST_AUTO_TEST_CASE(an_unknown_limit_is_not_looked_for) {
  const AddedPanel added(foreign());
  const std::string limit =
      "id = \"limit\"\nkind = \"limit\"\nquantity = \"critical_courant\"\npredict = \"stability-limit\"\n"
      "ratio = [0.9, 1.1]\nsteps = 100\n";
  for (const std::string& scene : {bar, plate}) {
    BOOST_TEST(holds(refusal(with_gate(scene, limit)), "of which there is no prediction"),
               refusal(with_gate(scene, limit)));
    Case c = parse_case(with_gate(scene, limit + "where = { method = \"fem\" }\n"), "t.toml");
    BOOST_TEST(std::isnan(step_of(c, leaves(c)[1]).limit));
    c.gates[1].where.method = {"other"};
    c.axes[0].courant = {50};  // no limit is known, so none is above it
    c.axes[0].method = {"other"};
    const reports::Case result = measured(c);
    BOOST_TEST((result.runs.at(0).status == "completed"));
    BOOST_TEST((result.gates[1].verdict == Verdict::invalid));
    BOOST_TEST(holds(result.gates[1].message, "critical_courant"), result.gates[1].message);
  }
}

BOOST_AUTO_TEST_CASE(a_feature_that_it_refuses_is_refused) {
  const AddedPanel added(foreign());
  const std::string heavy = replaced(replaced(replaced(bar, "[model]", "[body_force]\nacceleration = \"1.0\"\n[model]"),
                                              "\"elastic\"]", "\"body-force\", \"elastic\"]"),
                                     "solution = \"bar-wave\"", "solution = \"none\"");
  const std::string why = refusal(heavy);
  BOOST_TEST(holds(why, "\"other\" together with [body_force]"), why);
  BOOST_TEST(holds(why, "FEM, MPM methods only: fem, mpm-usf, mpm-usl, mpm-musl"), why);
}

// What the solver of diffusion alone had lacked: numbers that are not finite end a run whatever spreads.
BOOST_AUTO_TEST_CASE(diffusion_alone_sees_what_is_not_finite) {
  DiffusionScene scene;
  scene.width = scene.height = 1;
  scene.diffusivity = [](double, double) { return 1.0; };
  scene.initial = [](double x, double) { return x > 0.5 ? std::nan("") : 1; };
  Stepping stepping;
  stepping.time_step = 1e-3;
  stepping.steps = 2;
  stepping.sample_after = {0, 2};
  stepping.books = Books::off;
  const diffusion::Grid grid{2, 2, 0.5, 0.5};
  BOOST_TEST((run_diffusion(scene, grid, stepping).outcome == diptych::Outcome::unstable));
  scene.spread = diffusion::Spread{};
  scene.spread->start.assign(grid.nodes(), std::nan(""));
  BOOST_TEST((run_diffusion(scene, grid, stepping).outcome == diptych::Outcome::unstable));
}

BOOST_AUTO_TEST_SUITE_END()
