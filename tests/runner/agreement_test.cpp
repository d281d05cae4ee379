// FEM against MPM where nothing exact is known: runs made by hand, so that each verdict has one reason.
#include "runner/judge/agreement.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "runner/app/case_file.hpp"
#include "runner/compare/uncertainty.hpp"
#include "runner/judge/gates.hpp"
#include "runner/judge/judging.hpp"
#include "runner/judge/order.hpp"
#include "runner/judge/settling.hpp"
#include "tests/case_text.hpp"
#include "tests/criteria.hpp"
#include "tests/made_runs.hpp"
#include "tests/text.hpp"

namespace agreement {

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;
using reports::Run;
using reports::Verdict;
namespace tt = boost::test_tools;

namespace {

const std::string text = head("t", "cross-code") + plate("1.0", "1.0") + rock + reference_damage +
                         supports("free", "free", "free", "platen") + R"toml([model]
features = ["damage", "platen"]
)toml" + axes({"fem", "mpm-musl"}, "10, 20, 40, 80", "0.5") +
                         R"toml([sample]
times = { unit = "s", at = [1.0, 2.0] }
probes = [{ id = "p", reads = "largest" }]
)toml" + gate("probe", "agreement", "probe.p", "max = 1.0\njudged = [20, 40, 80]\n") +
                         gate("contour", "agreement", "contour.distance",
                              "level = 0.5\nmax = 1.0\njudged = [20, 40, 80]\n") +
                         gate("platen", "agreement", "platen.history", "max = 1.0\njudged = [20, 40, 80]\n");

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
        Run run = made_run(method, cells, 0.5);
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
    BOOST_TEST(holds(result.message, part), "wanted '" << part << "' in: " << result.message);
  }
};

}  // namespace

}  // namespace agreement

BOOST_FIXTURE_TEST_SUITE(agreement, agreement::Fixture)

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
  BOOST_TEST(holds(gate.message, "t = 2 s"), gate.message);
  c.gates[0].times = {1.0};
  BOOST_TEST((judged().verdict == Verdict::pass));
  c.gates[0].times = {};
  change_criterion<AgreementCriterion>(c.gates[0]).max = 1e6;  // how far is too far is the gate's to say
  change_criterion<AgreementCriterion>(c.gates[0]).shrinks = false;
  BOOST_TEST((judged().verdict == Verdict::pass));
}

BOOST_AUTO_TEST_CASE(the_difference_must_shrink_where_that_is_asked) {
  // On the finest mesh as far apart as on the coarsest that is judged, and still within wide bands.
  change_criterion<AgreementCriterion>(c.gates[0]).max = 1e6;
  const double apart = probe("fem", 20, 0) - probe("mpm-musl", 20, 0);
  probe("fem", 80, 0) = probe("mpm-musl", 80, 0) + 1.5 * apart;
  const auto gate = judged();
  BOOST_TEST((gate.verdict == Verdict::fail));
  BOOST_TEST(holds(gate.message, "finest / coarsest"), gate.message);
  change_criterion<AgreementCriterion>(c.gates[0]).shrinks = false;
  BOOST_TEST((judged().verdict == Verdict::pass));
  BOOST_TEST(judged().checks.size() == 6u);
  change_criterion<AgreementCriterion>(c.gates[0]).shrinks = true;
  probe("fem", 80, 0) = probe("mpm-musl", 80, 0) + 0.5 * apart;
  BOOST_TEST((judged().verdict == Verdict::pass));
}

BOOST_AUTO_TEST_CASE(only_the_meshes_that_are_named_are_judged) {
  probe("mpm-musl", 10, 0) += 1;  // far off, on a mesh that is not judged
  change_criterion<AgreementCriterion>(c.gates[0]).judged = {80};
  change_criterion<AgreementCriterion>(c.gates[0]).max = 1e9;
  BOOST_TEST((judged().verdict == Verdict::pass));
  BOOST_TEST(judged().checks.size() == 2u);  // one mesh tells nothing of shrinking
  change_criterion<AgreementCriterion>(c.gates[0]).judged = {80, 160};
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
  change_criterion<AgreementCriterion>(c.gates[1]).level = 5;  // nowhere reached
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

// U of a quarter of the value or more expects anything.
BOOST_AUTO_TEST_CASE(an_uncertainty_that_is_too_wide_judges_nothing) {
  for (const int cells : {10, 20, 40, 80}) {
    const double h = 1.0 / cells;
    probe("fem", cells, 0) = 1 + 6 * h;
    probe("mpm-musl", cells, 0) = 1 + 4 * h;
  }
  invalid("20 cells, t = 1 s: the uncertainty ");
  invalid("more than 25 %: nothing is judged by it");
  change_criterion<AgreementCriterion>(c.gates[0]).judged = {80};
  c.gates[0].times = {1.0};
  BOOST_TEST((judged().verdict == Verdict::pass), judged().message);
}

BOOST_AUTO_TEST_CASE(methods_may_be_apart_by_a_part_of_the_value) {
  // 1 + h² against 1 + h²/2: 0.00125, 0.00031 and 0.00008 of the value.
  change_criterion<AgreementCriterion>(c.gates[0]).apart = {0.0013, 0.00032, 0.00008};
  auto gate = judged();
  BOOST_TEST((gate.verdict == Verdict::pass), gate.message);
  BOOST_TEST(gate.checks.size() == 14u);  // two for each of three meshes, and whether it shrinks; at each time
  BOOST_TEST(gate.checks[1].judged == 0.00125 / (1 + 0.001875), tt::tolerance(1e-9));
  BOOST_TEST(gate.agreements.size() == 6u);
  const auto& first = gate.agreements.front();
  BOOST_TEST((first.cells == 20 && first.time == 1 && first.values[0] == probe("fem", 20, 0) &&
              first.values[1] == probe("mpm-musl", 20, 0) && first.apart == gate.checks[0].value &&
              first.expected == *gate.checks[0].predicted));
  change_criterion<AgreementCriterion>(c.gates[0]).apart = {0.0013, 0.0003, 0.00008};
  gate = judged();
  BOOST_TEST((gate.verdict == Verdict::fail));
  BOOST_TEST(holds(gate.message, "40 cells, t = 1 s: 0.031 % apart"), gate.message);
  // Alone it needs no uncertainty, and no four meshes.
  change_criterion<AgreementCriterion>(c.gates[0]).max.reset();
  change_criterion<AgreementCriterion>(c.gates[0]).apart = {0.00032, 0.00008};
  change_criterion<AgreementCriterion>(c.gates[0]).judged = {40, 80};
  c.gates[0].where.cells = {40, 80};
  gate = judged();
  BOOST_TEST((gate.verdict == Verdict::pass), gate.message);
  BOOST_TEST(gate.checks.size() == 6u);
  BOOST_TEST(std::isnan(gate.agreements[0].expected));
}

/// A gate on what a probe spans over some meshes.
struct ProbeSettling : Fixture {
  ProbeSettling() {
    c.gates[0].kind = "settling";
    auto& settling = replace_criterion<SettlingCriterion>(c.gates[0]);
    settling.max = 0.001;
    settling.judged = {40, 80};
  }
};

BOOST_FIXTURE_TEST_CASE(a_probe_settles_by_what_it_spans, ProbeSettling) {
  auto gate = judged();  // 1 + h²: 1.000625 and 1.00015625
  BOOST_TEST((gate.verdict == Verdict::pass), gate.message);
  BOOST_TEST(gate.checks.size() == 4u);  // of two methods at two times
  BOOST_TEST(gate.checks[0].judged == 0.00046875 / 1.00015625, tt::tolerance(1e-9));
  BOOST_TEST(gate.headroom() > 0.5);
  change_criterion<SettlingCriterion>(c.gates[0]).judged = {20, 40, 80};  // a trend shows in the whole span: 0.0023
  gate = judged();
  BOOST_TEST((gate.verdict == Verdict::fail));
  BOOST_TEST(holds(gate.message, "fem, t = 1 s: 1.002, 1.001, 1"), gate.message);
  change_criterion<SettlingCriterion>(c.gates[0]).judged = {40, 80};
  probe("mpm-musl", 40, 1) = 0.998;
  gate = judged();
  BOOST_TEST((gate.verdict == Verdict::fail));
  BOOST_TEST(holds(gate.message, "mpm-musl, t = 2 s"), gate.message);
  c.gates[0].times = {1.0};
  BOOST_TEST((judged().verdict == Verdict::pass));
}

BOOST_FIXTURE_TEST_CASE(what_cannot_settle_is_invalid, ProbeSettling) {
  probe("fem", 40, 0) = std::numeric_limits<double>::quiet_NaN();
  invalid("is not finite");
  probe("fem", 40, 0) = probe("fem", 80, 0);
  invalid("the same number on every mesh");
  lose("fem", 40);
  invalid("fem: 1 of 2 meshes to judge were run");
  c.gates[0].where.method = {"mpm-usf"};
  invalid("0 methods");
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

const std::string scene = head("t", "code-verification") + plate("1.0", "1.0") + R"toml([diffusion]
diffusivity = 1.0
scheme = "crank-nicolson"
[model]
features = ["diffusion"]
[exact]
solution = "expressions"
concentration = "1"
)toml" + axes({"diffusion"}, "20, 40", "2.0, 1.0, 0.5, 0.25") +
                          R"toml([sample]
times = { unit = "s", at = [1.0] }
)toml" + gate("order", "order", "concentration.L2", "over = \"courant\"\nexpect = 2.0\nband = [1.9, 2.1]\n") +
                          gate("any", "exact", "concentration.L2", "max = 1\n");

/// The same mesh with time steps that halve, and errors of the given order.
struct InTime {
  Case c;
  std::vector<Run> runs;
  explicit InTime(double order) : c(parse_case(scene, "t.toml")) {
    for (const int cells : {20, 40}) {
      for (const double courant : {2.0, 1.0, 0.5, 0.25}) {
        Run run = made_run("diffusion", cells, courant);
        run.courant = courant;
        run.time_step = courant * 1e-3 / cells;
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
  BOOST_TEST(holds(gate.formula, "Δt"), gate.formula);
  BOOST_REQUIRE_EQUAL(gate.checks.size(), 2u);  // one a mesh
  for (const auto& check : gate.checks) {
    BOOST_TEST(check.value == 2.0, tt::tolerance(1e-12));
    BOOST_TEST(holds(check.what, "4 steps"), check.what);
  }
  BOOST_TEST(holds(gate.checks[0].what, "N=20"), gate.checks[0].what);
  BOOST_TEST((InTime(1).judged().verdict == Verdict::fail));
  BOOST_TEST((InTime(-2).judged().verdict == Verdict::fail));
}

BOOST_AUTO_TEST_CASE(an_order_in_time_needs_different_time_steps) {
  InTime same(2);
  same.runs[1].time_step = same.runs[0].time_step;  // rounding up to whole steps may do that
  BOOST_TEST((same.judged().verdict == Verdict::invalid));
  BOOST_TEST(holds(same.judged().message, "two time steps are the same"), same.judged().message);
  InTime few(2);
  few.runs.erase(few.runs.begin());
  BOOST_TEST((few.judged().verdict == Verdict::invalid));
  BOOST_TEST(holds(few.judged().message, "3 time steps, at least 4 are needed"));
  // Over the mesh, the same runs are too few.
  InTime over(2);
  change_criterion<OrderCriterion>(over.c.gates[0]).over_time_step = false;
  BOOST_TEST((over.judged().verdict == Verdict::invalid));
  BOOST_TEST(holds(over.judged().message, "2 meshes, at least 4 are needed"));
}

// ---- settling -------------------------------------------------------------------------------------------------------

namespace {

const std::string struck = head("t", "cross-code") + strip("4.0") + elastic("1e4", "0.25", "1") + R"toml([flyer]
thickness = 2.0
velocity = 1.0
)toml" + guided() + R"toml([model]
features = ["elastic", "impact"]
)toml" + axes({"fem", "mpm-musl"}, "10, 20, 40, 80", "0.3") +
                           R"toml([sample]
times = { unit = "s", at = [0.01] }
gauges = [{ id = "near", from_face = 0.5 }, { id = "far", from_face = 1.0 }]
)toml" + gate("settles", "settling", "gauge.far.xx", "max = 0.5\n");

/// Histories of one shape and of size 1 + error: their distance is that of their sizes. The error is h², with MPM half.
struct Settling {
  Case c = parse_case(struck, "t.toml");
  std::vector<Run> runs;

  Settling() {
    for (const char* method : {"fem", "mpm-musl"}) {
      const bool fem = std::string(method) == "fem";
      for (const int cells : {10, 20, 40, 80}) {
        Run run = made_run(method, cells, 0.3);
        const double h = run.cell_size;
        // The other gauge and the other components settle to nothing.
        run.gauges.push_back({"near", 0.5, {0, 1}, {1, 1}, {1, 1}, {1, 1}});
        reports::GaugeHistory far{"far", 1.0, {}, {}, {}, {}};
        for (int n = 0; n <= 20; ++n) {
          far.time.push_back(0.1 * n);
          far.xx.push_back(std::sin(0.1 * n) * size(fem, h));
          far.yy.push_back(1);
          far.dilatancy.push_back(1);
        }
        run.gauges.push_back(far);
        runs.push_back(run);
      }
    }
  }
  static double size(bool fem, double h) { return 1 + (fem ? 1 : 0.5) * h * h; }

  Run& run(const std::string& method, int cells) {
    for (Run& one : runs)
      if (one.method == method && one.cells == cells) return one;
    throw std::logic_error("no such run");
  }
  std::vector<double>& xx(const std::string& method, int cells) { return run(method, cells).gauges.at(1).xx; }
  void scale(const std::string& method, int cells, double by) {
    for (double& value : xx(method, cells)) value *= by;
  }
  reports::Gate judged() { return judge(c, c.gates[0], runs); }
  void invalid(const std::string& part) {
    const auto result = judged();
    BOOST_TEST((result.verdict == Verdict::invalid), "got " << to_string(result.verdict) << " for " << part);
    BOOST_TEST(holds(result.message, part), "wanted '" << part << "' in: " << result.message);
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(histories_settle_where_their_distances_fall) {
  Settling both;
  const auto gate = both.judged();
  BOOST_TEST((gate.verdict == Verdict::pass), gate.message);
  // Of each method two ratios of three distances, between the methods three of four.
  BOOST_REQUIRE_EQUAL(gate.checks.size(), 7u);
  const auto distance = [](double a, double b) { return std::abs(a / b - 1); };
  for (std::size_t k = 0; k < 2; ++k) {
    const double h = k == 0 ? 0.1 : 0.05;
    for (const bool fem : {true, false}) {
      const auto& check = gate.checks[fem ? k : 2 + k];
      const auto at = [&](double size) { return Settling::size(fem, size); };
      const double before = distance(at(h), at(h / 2)), after = distance(at(h / 2), at(h / 4));
      BOOST_TEST(check.predicted.value() == before, tt::tolerance(1e-6));
      BOOST_TEST(check.value == after, tt::tolerance(1e-6));
      BOOST_TEST(check.judged == after / before, tt::tolerance(1e-6));  // about a quarter
      BOOST_TEST((check.low == 0 && check.high == 0.5));
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double h = k == 0 ? 0.1 : k == 1 ? 0.05 : 0.025;
    const auto apart = [&](double size) { return distance(Settling::size(false, size), Settling::size(true, size)); };
    BOOST_TEST(gate.checks[4 + k].predicted.value() == apart(h), tt::tolerance(1e-6));
    BOOST_TEST(gate.checks[4 + k].value == apart(h / 2), tt::tolerance(1e-6));
  }
  change_criterion<SettlingCriterion>(both.c.gates[0]).max = 0.2;  // more than second order
  BOOST_TEST((both.judged().verdict == Verdict::fail));
  BOOST_TEST(holds(gate.formula, "between the methods"), gate.formula);

  std::reverse(both.runs.begin(), both.runs.end());
  change_criterion<SettlingCriterion>(both.c.gates[0]).max = 0.5;
  const auto reversed = both.judged();
  BOOST_REQUIRE_EQUAL(reversed.checks.size(), 7u);
  for (std::size_t k = 0; k < 7; ++k) BOOST_TEST(reversed.checks[k].judged == gate.checks[k].judged);
}

BOOST_AUTO_TEST_CASE(one_distance_that_does_not_fall_fails) {
  for (const char* method : {"fem", "mpm-musl"}) {
    for (const int cells : {20, 40, 80}) {
      Settling other;
      other.scale(method, cells, 1.1);
      BOOST_TEST((other.judged().verdict == Verdict::fail), method << ", " << cells);
    }
  }
  // Each settles, but to something else: alone either passes.
  Settling other;
  for (const int cells : {10, 20, 40, 80}) other.scale("mpm-musl", cells, 1.1);
  BOOST_TEST((other.judged().verdict == Verdict::fail));
  BOOST_TEST(holds(other.judged().message, "fem and mpm-musl"), other.judged().message);
  for (const char* method : {"fem", "mpm-musl"}) {
    other.c.gates[0].where.method = {method};
    BOOST_TEST((other.judged().verdict == Verdict::pass), other.judged().message);
    BOOST_TEST(other.judged().checks.size() == 2u);
  }
}

BOOST_AUTO_TEST_CASE(settling_needs_four_meshes_of_one_or_two_methods) {
  Settling few;
  few.c.gates[0].where.cells = {20, 40, 80};
  few.invalid("3 meshes, at least 4 are needed");
  few.c.gates[0].where.method = {"fem"};
  few.invalid("3 meshes, at least 4 are needed");
  few.c.gates[0].where.method = {"mpm-usl"};
  few.invalid("0 methods");
  Settling three;
  three.c.axes[0].method.push_back("mpm-usf");
  for (const int cells : {10, 20, 40, 80}) {
    three.runs.push_back(three.run("mpm-musl", cells));
    three.runs.back().method = "mpm-usf";
  }
  three.invalid("3 methods");
  Settling unlike;
  std::erase_if(unlike.runs, [](const Run& run) { return run.method == "fem" && run.cells == 10; });
  unlike.invalid("not run on the same meshes");
  Settling none;
  none.runs.clear();
  none.invalid("0 methods");
  // Twice on one mesh, with other particles: of one method as of two.
  Settling twice;
  twice.c.axes[0].particles = {{0.25, 0.75}, {0.5}};
  twice.c.gates[0].where.method = {"mpm-musl"};
  twice.runs.push_back(twice.run("mpm-musl", 40));
  twice.runs.back().particles = "0.5";
  for (double& value : twice.runs.back().gauges.at(1).xx) value *= 1.0001;
  twice.invalid("two runs of a method on one mesh");
}

BOOST_AUTO_TEST_CASE(the_same_history_twice_never_settles) {
  for (const char* method : {"fem", "mpm-musl"}) {
    for (const int cells : {10, 20, 40}) {
      Settling other;
      other.xx(method, cells) = other.xx(method, 2 * cells);
      BOOST_TEST((other.judged().verdict != Verdict::pass));
      other.c.gates[0].where.method = {method};
      other.invalid("the same");
    }
  }
  for (const int cells : {10, 20, 40, 80}) {
    Settling other;
    change_criterion<SettlingCriterion>(other.c.gates[0]).max = 1e9;  // whatever the distances do beside it
    other.xx("fem", cells) = other.xx("mpm-musl", cells);
    other.invalid("the same");
  }
}

BOOST_AUTO_TEST_CASE(settling_of_what_is_no_number_or_not_there_is_invalid) {
  for (const char* method : {"fem", "mpm-musl"}) {
    for (const int cells : {10, 20, 40, 80}) {
      for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Settling other;
        other.xx(method, cells)[7] = bad;
        other.invalid("not a finite number");
      }
      Settling gone;
      gone.run(method, cells).gauges.pop_back();
      gone.invalid("has no gauge.far.xx");
    }
  }
  Settling nothing;  // a history that vanishes has no size to compare with
  std::fill(nothing.xx("fem", 80).begin(), nothing.xx("fem", 80).end(), 0.0);
  BOOST_TEST((nothing.judged().verdict == Verdict::invalid));
  Settling broken;
  broken.run("fem", 40).status = "unstable";
  BOOST_TEST((broken.judged().verdict == Verdict::unstable));
  broken.run("fem", 40).status = "completed";
  broken.run("fem", 40).invalid = "why not";
  broken.invalid("why not");
}

BOOST_AUTO_TEST_CASE(each_history_of_a_gauge_is_its_own) {
  for (const char* quantity : {"gauge.far.yy", "gauge.far.dilatancy", "gauge.near.xx"}) {
    Settling other;
    other.c.gates[0].quantity = quantity;
    other.invalid("the same");
  }
  Settling lateral;
  lateral.c.gates[0].quantity = "gauge.far.yy";
  for (Run& run : lateral.runs) std::swap(run.gauges[1].xx, run.gauges[1].yy);
  BOOST_TEST((lateral.judged().verdict == Verdict::pass));
  lateral.c.gates[0].quantity = "gauge.far.dilatancy";
  for (Run& run : lateral.runs) std::swap(run.gauges[1].dilatancy, run.gauges[1].yy);
  BOOST_TEST((lateral.judged().verdict == Verdict::pass));
}

// Gates of kind agreement know histories of gauges, too.
BOOST_AUTO_TEST_CASE(histories_of_gauges_agree_as_those_of_a_platen_do) {
  Settling both;
  both.c.gates[0].kind = "agreement";
  auto& agreement = replace_criterion<AgreementCriterion>(both.c.gates[0]);
  agreement.max = 1;
  agreement.judged = {20, 40, 80};
  const auto result = both.judged();
  BOOST_TEST((result.verdict == Verdict::pass), result.message);
  BOOST_REQUIRE_EQUAL(result.checks.size(), 4u);
  for (std::size_t k = 0; k < 3; ++k) {
    const double h = k == 0 ? 0.05 : k == 1 ? 0.025 : 0.0125;
    BOOST_TEST(result.checks[k].value == std::abs(Settling::size(false, h) / Settling::size(true, h) - 1),
               tt::tolerance(1e-6));
  }
  for (const int cells : {10, 20, 40, 80}) both.scale("mpm-musl", cells, 1.1);
  BOOST_TEST((both.judged().verdict == Verdict::fail));
  both.run("fem", 40).gauges.clear();
  both.invalid("has no gauge.far.xx");
}

BOOST_AUTO_TEST_SUITE_END()
