// FEM against MPM where nothing exact is known: runs made by hand, so that each verdict has one reason.
#include "cases/agreement.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "cases/case_file.hpp"
#include "cases/gates.hpp"
#include "cases/judging.hpp"
#include "cases/uncertainty.hpp"

using namespace diptych;
using namespace diptych::cases;
using reports::Run;
using reports::Verdict;
namespace tt = boost::test_tools;

namespace {

const char* const text = R"toml(schema = 1
id = "t"
title = "t"
claim = "cross-code"
why = "w"
units = "SI"
[plate]
width = 1.0
height = 1.0
[material]
model = "tensile-damage"
E = 50e9
nu = 0.3
rho = 2500
plane = "strain"
K_IC = 1e6
k = 5e22
m = 7
[damage]
critical_strain = 0.002
rate = "reference"
reference_rate = 100
[supports]
left = "free"
right = "free"
bottom = "free"
top = "platen"
[model]
features = ["damage", "platen"]
[axes]
method = ["fem", "mpm-musl"]
cells = [10, 20, 40, 80]
courant = [0.5]
[sample]
times = { unit = "s", at = [1.0, 2.0] }
probes = [{ id = "p", reads = "largest" }]
[[gate]]
id = "probe"
kind = "agreement"
quantity = "probe.p"
max = 1.0
judged = [20, 40, 80]
reason = "r"
[[gate]]
id = "contour"
kind = "agreement"
quantity = "contour.distance"
level = 0.5
max = 1.0
judged = [20, 40, 80]
reason = "r"
[[gate]]
id = "platen"
kind = "agreement"
quantity = "platen.history"
max = 1.0
judged = [20, 40, 80]
reason = "r"
)toml";

/// C_d that falls along the radius and is ½ at `radius`.
reports::PlateFields cone(int cells, double radius) {
  reports::PlateFields fields{cells, cells, 1, 1, {}, {}};
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      fields.crack_density.push_back(0.5 + radius - std::hypot(i, j) / cells);
      fields.damage.push_back(0);
    }
  return fields;
}

struct Fixture {
  Case c = parse_case(text, "t.toml");
  std::vector<Run> runs;

  /// Both methods converge to 1 with an error of second order: MPM with half of FEM's.
  Fixture() {
    for (const char* method : {"fem", "mpm-musl"}) {
      const bool fem = std::string(method) == "fem";
      for (const int cells : {10, 20, 40, 80}) {
        Run run;
        run.method = method;
        run.cells = cells;
        run.courant_asked = 0.5;
        run.particles = fem ? "" : "0.25 0.75";
        run.cell_size = 1.0 / cells;
        run.status = "completed";
        const double h = run.cell_size, error = (fem ? 1 : 0.5) * h * h;
        for (const double time : {1.0, 2.0}) {
          reports::Sample sample;
          sample.asked = sample.time = time;
          sample.probes = {{"p", 1 + error, {}}};
          sample.plate = cone(cells, 0.6 + error);
          run.samples.push_back(sample);
        }
        for (int n = 1; n <= 20; ++n) {
          run.platen.x.push_back(0.1 * n);
          run.platen.y.push_back(std::sin(0.1 * n) * (1 + error));
        }
        runs.push_back(run);
      }
    }
  }

  /// Of a method on a mesh.
  Run& run(const std::string& method, int cells) {
    for (Run& one : runs)
      if (one.method == method && one.cells == cells) return one;
    throw std::logic_error("no such run");
  }
  double& probe(const std::string& method, int cells, std::size_t sample) {
    return run(method, cells).samples.at(sample).probes.at(0).value;
  }
  void lose(const std::string& method, int cells) {
    std::erase_if(runs, [&](const Run& one) { return one.method == method && one.cells == cells; });
  }
  reports::Gate judged(std::size_t gate = 0) { return judge(c, c.gates[gate], runs); }
  /// INVALID, and the reason holds `part`.
  void invalid(const std::string& part, std::size_t gate = 0) {
    const auto result = judged(gate);
    BOOST_TEST((result.verdict == Verdict::invalid), "got " << to_string(result.verdict));
    BOOST_TEST(result.message.find(part) != std::string::npos, "wanted '" << part << "' in: " << result.message);
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(agreement, Fixture)

BOOST_AUTO_TEST_CASE(methods_that_converge_to_the_same_agree) {
  for (std::size_t g = 0; g < 3; ++g) {
    const auto gate = judged(g);
    BOOST_TEST((gate.verdict == Verdict::pass), gate.id << ": " << gate.message);
    // Three meshes and whether they shrink; of each sample time, or of the whole history.
    BOOST_TEST(gate.checks.size() == (gate.id == "platen" ? 4u : 8u));
    BOOST_TEST(gate.headroom() > 0);
  }
  c.gates[0].times = {2.0};
  BOOST_TEST(judged().checks.size() == 4u);
}

BOOST_AUTO_TEST_CASE(the_difference_is_measured_by_the_uncertainty_of_both) {
  const auto gate = judged();
  std::vector<double> sizes, fem, mpm;
  for (const int cells : {10, 20, 40, 80}) {
    sizes.push_back(1.0 / cells);
    fem.push_back(probe("fem", cells, 0));
    mpm.push_back(probe("mpm-musl", cells, 0));
  }
  const Uncertainty a = discretisation_uncertainty(sizes, fem), b = discretisation_uncertainty(sizes, mpm);
  for (std::size_t k = 0; k < 3; ++k) {
    const reports::Check& check = gate.checks[k];
    const double difference = std::abs(fem[k + 1] - mpm[k + 1]), band = std::hypot(a.of(k + 1), b.of(k + 1));
    BOOST_TEST(check.value == difference);
    BOOST_TEST(check.predicted.value() == band);
    BOOST_TEST(check.judged == difference / band);
    BOOST_TEST((check.low == -1 && check.high == 1 && check.passed));
  }
  BOOST_TEST(gate.checks[3].judged == 1.0 / 16, tt::tolerance(1e-9));  // h² from 20 to 80 cells, but for round-off
}

BOOST_AUTO_TEST_CASE(methods_that_are_further_apart_than_their_meshes_let_expect_fail) {
  for (const int cells : {10, 20, 40, 80}) probe("mpm-musl", cells, 1) += 0.1;  // converges, but to something else
  const auto gate = judged();
  BOOST_TEST((gate.verdict == Verdict::fail));
  BOOST_TEST(gate.message.find("t = 2 s") != std::string::npos, gate.message);
  c.gates[0].times = {1.0};
  BOOST_TEST((judged().verdict == Verdict::pass));
  c.gates[0].times = {};
  c.gates[0].max = 1e6;  // how far is too far is the gate's to say
  c.gates[0].shrinks = false;
  BOOST_TEST((judged().verdict == Verdict::pass));
}

BOOST_AUTO_TEST_CASE(the_difference_must_shrink_where_that_is_asked) {
  // On the finest mesh as far apart as on the coarsest that is judged, and still within wide bands.
  c.gates[0].max = 1e6;
  const double apart = probe("fem", 20, 0) - probe("mpm-musl", 20, 0);
  probe("fem", 80, 0) = probe("mpm-musl", 80, 0) + 1.5 * apart;
  const auto gate = judged();
  BOOST_TEST((gate.verdict == Verdict::fail));
  BOOST_TEST(gate.message.find("finest / coarsest") != std::string::npos, gate.message);
  c.gates[0].shrinks = false;
  BOOST_TEST((judged().verdict == Verdict::pass));
  BOOST_TEST(judged().checks.size() == 6u);
  c.gates[0].shrinks = true;
  probe("fem", 80, 0) = probe("mpm-musl", 80, 0) + 0.5 * apart;
  BOOST_TEST((judged().verdict == Verdict::pass));
}

BOOST_AUTO_TEST_CASE(only_the_meshes_that_are_named_are_judged) {
  probe("mpm-musl", 10, 0) += 1;  // far off, on a mesh that is not judged
  c.gates[0].judged = {80};
  c.gates[0].max = 1e9;
  BOOST_TEST((judged().verdict == Verdict::pass));
  BOOST_TEST(judged().checks.size() == 2u);  // one mesh tells nothing of shrinking
  c.gates[0].judged = {80, 160};
  invalid("1 of 2 meshes to judge were run");
}

BOOST_AUTO_TEST_CASE(fewer_than_four_meshes_are_invalid) {
  c.gates[0].where.cells = {20, 40, 80};
  invalid("3 meshes, at least 4 are needed");
  c.gates[0].where.cells.clear();
  lose("fem", 10);
  invalid("not run on the same meshes");
  lose("mpm-musl", 10);
  invalid("3 meshes, at least 4 are needed");
}

BOOST_AUTO_TEST_CASE(one_method_or_three_are_invalid) {
  c.gates[0].where.method = {"fem"};
  invalid("1 methods; two are compared");
  c.gates[0].where.method = {"mpm-usl"};
  invalid("0 methods; two are compared");
  c.gates[0].where.method.clear();
  c.axes[0].method.push_back("mpm-usf");
  for (const int cells : {10, 20, 40, 80}) {
    runs.push_back(run("mpm-musl", cells));
    runs.back().method = "mpm-usf";
  }
  invalid("3 methods; two are compared");
  c.gates[0].where.method = {"fem", "mpm-usf"};
  BOOST_TEST((judged().verdict == Verdict::pass));
  runs.clear();
  invalid("0 methods");
}

BOOST_AUTO_TEST_CASE(two_runs_on_one_mesh_are_invalid) {
  for (const char* method : {"fem", "mpm-musl"}) {
    runs.push_back(run(method, 40));
    runs.back().courant_asked = 0.25;
  }
  c.axes[0].courant = {0.5, 0.25};
  invalid("two runs of a method on one mesh");
  c.gates[0].where.courant = {0.5};
  BOOST_TEST((judged().verdict == Verdict::pass));
}

BOOST_AUTO_TEST_CASE(a_missing_probe_sample_field_or_history_is_invalid) {
  Fixture other;
  other.run("fem", 40).samples[1].probes.clear();
  other.invalid("has no probe p");
  other.run("fem", 40).samples.pop_back();
  other.invalid("no sample at 2");
  other = Fixture();
  other.run("mpm-musl", 80).samples[0].plate.reset();
  other.invalid("has no damage", 1);
  other = Fixture();
  other.run("mpm-musl", 10).platen = {};
  other.invalid("has no platen", 2);
}

BOOST_AUTO_TEST_CASE(a_number_that_is_none_is_invalid_and_never_a_pass) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (const int cells : {10, 20, 40, 80}) {  // on meshes that are not judged, too
      for (const char* method : {"fem", "mpm-musl"}) {
        Fixture other;
        other.probe(method, cells, 1) = bad;
        other.invalid("not a finite number");
      }
    }
  }
  const double nan_value = std::numeric_limits<double>::quiet_NaN();
  Fixture other;
  other.run("fem", 80).samples[0].plate->crack_density[0] = nan_value;
  other.invalid("not a finite number", 1);
  for (const int cells : {10, 20, 40, 80}) {
    Fixture shaken;
    shaken.run("fem", cells).platen.y[3] = nan_value;
    BOOST_TEST((shaken.judged(2).verdict != Verdict::pass), cells);
  }
}

BOOST_AUTO_TEST_CASE(a_contour_that_is_not_there_is_no_agreement) {
  c.gates[1].level = 5;  // nowhere reached
  invalid("not a finite number", 1);
}

BOOST_AUTO_TEST_CASE(methods_that_give_the_very_same_numbers_are_invalid) {
  for (const int cells : {10, 20, 40, 80}) {
    run("mpm-musl", cells).samples = run("fem", cells).samples;
    run("mpm-musl", cells).platen = run("fem", cells).platen;
  }
  invalid("the same number");
  invalid("the same number", 1);
  invalid("the same number", 2);
}

BOOST_AUTO_TEST_CASE(values_that_do_not_change_with_the_mesh_have_no_uncertainty) {
  for (const int cells : {10, 20, 40, 80}) {
    probe("fem", cells, 0) = 1;
    probe("mpm-musl", cells, 0) = 2;
  }
  invalid("no uncertainty to compare with");
}

BOOST_AUTO_TEST_CASE(runs_that_failed_cannot_be_judged) {
  run("fem", 10).status = "unstable";
  BOOST_TEST((judged().verdict == Verdict::unstable));
  run("fem", 10).status = "error";
  BOOST_TEST((judged().verdict == Verdict::error));
  run("fem", 10).status = "cancelled";
  BOOST_TEST((judged().verdict == Verdict::error));
  run("fem", 10).status = "completed";
  run("fem", 10).invalid = "why not";
  invalid("why not");
}

BOOST_AUTO_TEST_CASE(the_order_of_the_runs_does_not_matter) {
  const auto before = judged();
  std::reverse(runs.begin(), runs.end());
  const auto after = judged();
  BOOST_REQUIRE_EQUAL(before.checks.size(), after.checks.size());
  for (std::size_t k = 0; k < before.checks.size(); ++k) BOOST_TEST(before.checks[k].judged == after.checks[k].judged);
}

// The cones are circles of radius 0.6 + error, off by what the bilinear map makes of them.
BOOST_AUTO_TEST_CASE(contours_are_as_far_apart_as_their_radii) {
  const auto gate = judged(1);
  for (std::size_t k = 0; k < 3; ++k) {
    const double h = 1.0 / (k == 0 ? 20 : k == 1 ? 40 : 80);
    BOOST_TEST(gate.checks[k].value == 0.5 * h * h, tt::tolerance(0.05));
  }
}

BOOST_AUTO_TEST_CASE(histories_are_as_far_apart_as_their_sizes) {
  const auto gate = judged(2);
  for (std::size_t k = 0; k < 3; ++k) {
    const double h = 1.0 / (k == 0 ? 20 : k == 1 ? 40 : 80), h_other = k == 2 ? 1.0 / 40 : h, finest = 1.0 / 80;
    const auto size = [](double error) { return 1 + error; };
    BOOST_TEST(gate.checks[k].value == std::abs(size(0.5 * h * h) / size(h * h) - 1), tt::tolerance(1e-6));
    // Each from its own finest mesh; the finest is as uncertain as the one before.
    const double fem = size(h_other * h_other) / size(finest * finest) - 1,
                 mpm = size(0.5 * h_other * h_other) / size(0.5 * finest * finest) - 1;
    BOOST_TEST(gate.checks[k].predicted.value() == std::hypot(fem, mpm), tt::tolerance(1e-6));
  }
}

// ---- order over the time step ---------------------------------------------------------------------------------------

namespace {

const char* const scene = R"toml(schema = 1
id = "t"
title = "t"
claim = "code-verification"
why = "w"
units = "SI"
[plate]
width = 1.0
height = 1.0
[diffusion]
diffusivity = 1.0
scheme = "crank-nicolson"
[model]
features = ["diffusion"]
[exact]
solution = "expressions"
concentration = "1"
[axes]
method = ["diffusion"]
cells = [20, 40]
courant = [2.0, 1.0, 0.5, 0.25]
[sample]
times = { unit = "s", at = [1.0] }
[[gate]]
id = "order"
kind = "order"
quantity = "concentration.L2"
over = "courant"
expect = 2.0
band = [1.9, 2.1]
reason = "r"
[[gate]]
id = "any"
kind = "exact"
quantity = "concentration.L2"
max = 1
reason = "r"
)toml";

/// The same mesh with time steps that halve, and errors of the given order.
struct InTime {
  Case c;
  std::vector<Run> runs;
  explicit InTime(double order) : c(parse_case(scene, "t.toml")) {
    for (const int cells : {20, 40}) {
      for (const double courant : {2.0, 1.0, 0.5, 0.25}) {
        Run run;
        run.method = "diffusion";
        run.cells = cells;
        run.cell_size = 1.0 / cells;
        run.courant_asked = run.courant = courant;
        run.time_step = courant * 1e-3 / cells;
        run.status = "completed";
        reports::Sample sample;
        sample.asked = sample.time = 1;
        const double error = 0.01 * std::pow(courant, order);
        sample.errors = {{"concentration", 1, 1, error, error, error, {}, {}, {}}};
        run.samples = {sample};
        runs.push_back(run);
      }
    }
  }
  reports::Gate judged() { return judge(c, c.gates[0], runs); }
};

}  // namespace

BOOST_AUTO_TEST_CASE(an_order_in_time_is_a_slope_over_the_time_step_on_each_mesh) {
  const auto gate = InTime(2).judged();
  BOOST_TEST((gate.verdict == Verdict::pass), gate.message);
  BOOST_TEST(gate.formula.find("Δt") != std::string::npos, gate.formula);
  BOOST_REQUIRE_EQUAL(gate.checks.size(), 2u);  // one a mesh
  for (const auto& check : gate.checks) {
    BOOST_TEST(check.value == 2.0, tt::tolerance(1e-12));
    BOOST_TEST(check.what.find("4 steps") != std::string::npos, check.what);
  }
  BOOST_TEST(gate.checks[0].what.find("N=20") != std::string::npos, gate.checks[0].what);
  BOOST_TEST((InTime(1).judged().verdict == Verdict::fail));
  BOOST_TEST((InTime(-2).judged().verdict == Verdict::fail));
}

BOOST_AUTO_TEST_CASE(an_order_in_time_needs_different_time_steps) {
  InTime same(2);
  same.runs[1].time_step = same.runs[0].time_step;  // rounding up to whole steps may do that
  BOOST_TEST((same.judged().verdict == Verdict::invalid));
  BOOST_TEST(same.judged().message.find("two time steps are the same") != std::string::npos, same.judged().message);
  InTime few(2);
  few.runs.erase(few.runs.begin());
  BOOST_TEST((few.judged().verdict == Verdict::invalid));
  BOOST_TEST(few.judged().message.find("3 time steps, at least 4 are needed") != std::string::npos);
  // Over the mesh, the same runs are too few.
  InTime over(2);
  over.c.gates[0].over_time_step = false;
  BOOST_TEST((over.judged().verdict == Verdict::invalid));
  BOOST_TEST(over.judged().message.find("2 meshes, at least 4 are needed") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
