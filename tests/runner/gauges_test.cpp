// What gauges in a struck plate tell, by hand; small runs against the lattice's own waves; their figure and page.
#include "runner/compare/gauges.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "analytic/impact_lattice.hpp"
#include "reports/page.hpp"
#include "runner/app/case_file.hpp"
#include "runner/compare/quantities.hpp"
#include "runner/input/plate_build.hpp"
#include "runner/judge/gates.hpp"
#include "runner/judge/ratio.hpp"
#include "runner/run/runner.hpp"
#include "tests/case_figures.hpp"
#include "tests/case_text.hpp"
#include "tests/criteria.hpp"
#include "tests/made_runs.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(gauges)

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;
namespace tt = boost::test_tools;

namespace {

const double nan_value = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

/// c_d = 4 km/s and ½ρ c_d v = 1 GPa; the lateral stress is a third. 16 mm of flyer, 24 mm of target.
const std::string failing = R"toml(schema = 1
id = "struck"
title = "A struck plate"
claim = "cross-code"
why = "w"
units = "SI"
)toml" + strip("40e-3") + R"toml([material]
model = "failure-wave"
E = 33333333333.333332
nu = 0.25
rho = 2500
plane = "strain"
threshold = 5e8
f_max = 0.5
[diffusion]
d0 = 8.0
profile = "constant"
[flyer]
thickness = 16e-3
velocity = 200
gap = { value = 2, unit = "cells" }
)toml" + guided() + R"toml([model]
features = ["diffusion", "failure-wave", "impact"]
[[variant]]
id = "weak"
says = "half of it is converted"
set = { "material.f_max" = 0.25 }
[[variant]]
id = "slow"
says = "below the threshold"
set = { "flyer.velocity" = 100 }
)toml" + axes({"fem", "mpm-musl"}, "40", "0.3") +
                            R"toml(variant = ["", "weak", "slow"]
[sample]
times = { unit = "s", at = [1e-6, 10e-6] }
gauges = [{ id = "near", from_face = 4e-3 }, { id = "far", from_face = 6e-3 }]
[[gate]]
id = "closure"
kind = "invariant"
quantity = "energy.closure"
max = 1e-11
reason = "round-off"
[[figure]]
id = "fig16"
kind = "gauges"
cells = 40
components = ["longitudinal", "lateral"]
bands = [
  { label = "range", speed = [1000, 2000] },
  { label = "late", speed = 4000, delay = [0.25e-6, 0.75e-6] },
]
[[figure]]
id = "one"
kind = "gauges"
cells = 40
components = ["longitudinal"]
gauges = ["far"]
variants = ["weak", ""]
time_range = [1e-6, 3e-6]
range = [-1, 2]
[[figure]]
id = "failure"
kind = "failure"
cells = 40
pictures = ["fig16", "one"]
intro = ["A glass of {rho} kg/m³."]
model = ["It fails at {threshold} GPa.", "Or not."]
statements = [
  { says = "E = {E} GPa, ν = {nu}", standing = "choice", source = "ours" },
  { says = "Part {f_max} is converted; d0 = {d0}", standing = "reconstruction", source = "σ_x = {threshold_stress} GPa" },
  { says = "Struck at {velocity} m/s", standing = "certain", source = "the paper" },
]
sections = [
  { heading = "Converted", says = "How much.", variants = ["", "weak"] },
  { heading = "Impact", says = "How hard.", variants = ["slow"] },
]
)toml";

/// The scene without what fails.
const std::string elastic_text = head("elastic", "code-verification") + strip("42e-3") + glass() + R"toml([flyer]
thickness = 18e-3
velocity = 684.0
gap = { value = 2, unit = "cells" }
)toml" + guided() + R"toml([model]
features = ["elastic", "impact"]
)toml" + axes({"fem", "mpm-usf", "mpm-usl", "mpm-musl"}, "42", "0.3") +
                                 R"toml([sample]
times = { unit = "s", at = [8e-6] }
gauges = [{ id = "near", from_face = 4.5e-3 }, { id = "far", from_face = 6.5e-3 }]
)toml" +
                                 gate("near", "constant", "gauge.near.plateau",
                                      "predict = \"impact-lattice\"\nratio = [0.999999999, 1.000000001]\n") +
                                 gate("exact", "constant", "gauge.near.ratio",
                                      "predict = \"plate-impact\"\nratio = [0.999999999999, 1.000000000001]\n") +
                                 R"toml([[gate]]
id = "none"
kind = "constant"
quantity = "gauge.near.failure"
predict = "diffusion-front"
ratio = [0.4, 2.5]
reason = "nothing fails"
)toml";

Case failing_case() { return parse_case(failing, "t.toml"); }

struct Moduli {
  double K, G, M, c;
  explicit Moduli(const material::PlaneElastic& solid) {
    const double E = solid.youngs_modulus, nu = solid.poissons_ratio;
    K = E / (3 * (1 - 2 * nu));
    G = E / (2 * (1 + nu));
    M = K + 4 * G / 3;
    c = std::sqrt(M / solid.density);
  }
};

/// −σ_yy and V_d of R1 at a uniaxial compression and a converted part f, from its energies.
struct Failed {
  double lateral, dilatancy;
};
Failed failed(const Moduli& m, double strain, double f) {
  const double p = m.K * strain, across = 2 * m.G * strain / 3;  // s_e = across · (−2, 1, 1), tension positive
  const double shear_energy = 6 * across * across / (4 * m.G);
  const double raised = std::sqrt(p * p + 2 * m.K * f * shear_energy);
  return {raised - std::sqrt(1 - f) * across, (raised - p) / m.K};
}

/// V_d over its ceiling where −σ_yy is half-way.
double half_way_level(const Moduli& m, double strain, double f_max) {
  const double half = (failed(m, strain, 0).lateral + failed(m, strain, f_max).lateral) / 2;
  double low = 0, high = f_max;
  for (int n = 0; n < 100; ++n) {
    const double f = (low + high) / 2;
    (failed(m, strain, f).lateral < half ? low : high) = f;
  }
  return failed(m, strain, low).dilatancy / failed(m, strain, f_max).dilatancy;
}

/// What the two gauges of the case have seen: times in µs, compression positive in GPa.
PlateRecord seen(const History& longitudinal, const History& lateral, double far_later = 0) {
  PlateRecord record;
  for (const double later : {0.0, far_later}) {
    GaugeRecord gauge;
    for (std::size_t n = 0; n < longitudinal.time.size(); ++n) {
      gauge.time.push_back((longitudinal.time[n] + later) * 1e-6);
      gauge.xx.push_back(-longitudinal.value[n] * 1e9);
      gauge.yy.push_back(-lateral.value[n] * 1e9);
      gauge.dilatancy.push_back(0.001);
    }
    record.gauges.push_back(gauge);
  }
  return record;
}

/// A front at 1 µs that overshoots by a fifth, and a release at 9 µs.
const History step{{0, 0.9, 1.1, 1.2, 1.3, 2, 4, 8.9, 9.1, 10}, {0, 0, 1, 1.2, 1, 1, 1, 1, 0, 0}};

reports::Run measured(const Case& c, const PlateRecord& record, const std::string& method = "fem") {
  reports::Run run;
  run.cell_size = 1e-3;
  Leaf leaf;
  leaf.method = method;
  leaf.cells = 40;
  leaf.courant = 0.3;
  if (method != "fem") leaf.particles = {0.25, 0.75};
  measure_gauges(c, leaf, grid_of(*c.plate, leaf.cells), record, 7.5e-8, run);
  return run;
}

/// As it is without a failure wave.
Case whole_solid() {
  Case c = failing_case();
  c.plate->solid = solid::Elastic{elastic_of(*c.plate)};
  return c;
}

}  // namespace

// ---- histories ------------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(a_passage_lies_on_the_line_between_two_samples) {
  const History h{{1, 2, 4, 5}, {0, 1, 3, 0}};
  BOOST_TEST(first_passage(h, 0.25) == 1.25);
  BOOST_TEST(first_passage(h, 2) == 3.0);
  BOOST_TEST(first_passage(h, 1) == 2.0);  // exactly at a sample
  BOOST_TEST(first_passage(h, 3) == 4.0);  // at the top
  BOOST_TEST(first_passage(h, 0) == 1.0);  // there from the start
  BOOST_TEST(first_passage(h, -7) == 1.0);
  BOOST_TEST(std::isnan(first_passage(h, 3.0000001)));
  BOOST_TEST(std::isnan(first_passage({}, 1)));
  // The first of two.
  BOOST_TEST(first_passage({{0, 1, 2, 3}, {0, 2, 0, 2}}, 1) == 0.5);
}

BOOST_AUTO_TEST_CASE(a_passage_next_to_what_is_no_number_is_none) {
  BOOST_TEST(std::isnan(first_passage({{0, 1, 2}, {0, nan_value, nan_value}}, 1)));
  BOOST_TEST(std::isnan(first_passage({{0, 1, 2}, {0, nan_value, 2}}, 1)));  // nobody knows when
  BOOST_TEST(first_passage({{0, 1, 2}, {0, 2, nan_value}}, 1) == 0.5);
  BOOST_TEST(std::isnan(first_passage({{0, 1}, {0, 2}}, nan_value)));
}

BOOST_AUTO_TEST_CASE(a_mean_is_of_the_line_through_the_samples) {
  const History h{{1, 2, 4, 5}, {0, 1, 3, 0}};
  BOOST_TEST(mean_over(h, 1, 5) == (0.5 + 4 + 1.5) / 4, tt::tolerance(1e-15));  // exactly what they cover
  BOOST_TEST(mean_over(h, 2, 4) == 2.0);                                        // between samples
  BOOST_TEST(mean_over(h, 2.5, 3.5) == 2.0, tt::tolerance(1e-15));              // within one stretch
  BOOST_TEST(mean_over(h, 1.5, 3) == (0.5 * 0.75 + 1 * 1.5) / 1.5, tt::tolerance(1e-15));
  BOOST_TEST(std::isnan(mean_over(h, 0.999, 3)));  // beyond them
  BOOST_TEST(std::isnan(mean_over(h, 2, 5.001)));
  BOOST_TEST(std::isnan(mean_over(h, 3, 3)));
  BOOST_TEST(std::isnan(mean_over(h, 4, 3)));
  BOOST_TEST(std::isnan(mean_over({}, 1, 2)));
  BOOST_TEST(std::isnan(mean_over(h, nan_value, 3)));
  BOOST_TEST(std::isnan(mean_over(h, 2, nan_value)));
  BOOST_TEST(std::isnan(mean_over({{0, 1, 2, 3}, {1, nan_value, 1, 1}}, 0, 3)));
  BOOST_TEST(mean_over({{0, 1, 2, 3}, {nan_value, 1, 1, 1}}, 1, 3) == 1.0);  // not in the window
}

// ---- theory ---------------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(theory_is_that_of_two_plates_of_one_solid) {
  Case c = failing_case();
  const ImpactTheory theory = impact_theory(*c.plate, 4e-3);
  BOOST_TEST(theory.plateau == 1e9, tt::tolerance(1e-13));
  BOOST_TEST(theory.lateral_ratio == 1.0 / 3, tt::tolerance(1e-13));
  BOOST_TEST(theory.arrival == 1e-6, tt::tolerance(1e-13));
  BOOST_TEST(theory.release == 9e-6, tt::tolerance(1e-13));  // (16 + 16 + 4) mm: the flyer's
  BOOST_TEST(impact_theory(*c.plate, 10e-3).release == 9.5e-6,
             tt::tolerance(1e-13));  // (24 + 24 − 10) mm: the target's
  c.plate->flyer->thickness = 4e-3;
  BOOST_TEST(impact_theory(*c.plate, 4e-3).release == 3e-6, tt::tolerance(1e-13));
  c.plate->flyer->thickness = 30e-3;
  BOOST_TEST(impact_theory(*c.plate, 4e-3).release == 4e-6, tt::tolerance(1e-13));

  // Glass, from its own numbers.
  const Case glass = parse_case(elastic_text, "t.toml");
  const Moduli m(elastic_of(*glass.plate));
  const ImpactTheory other = impact_theory(*glass.plate, 4.5e-3);
  BOOST_TEST(other.plateau == 0.5 * 2563 * m.c * 684, tt::tolerance(1e-13));
  BOOST_TEST(other.plateau == 5.0e9, tt::tolerance(1e-3));  // as the case says
  BOOST_TEST(other.lateral_ratio == 0.222 / 0.778, tt::tolerance(1e-13));
  BOOST_TEST(other.arrival == 4.5e-3 / m.c, tt::tolerance(1e-13));
  BOOST_TEST(other.release == (2 * 18e-3 + 4.5e-3) / m.c, tt::tolerance(1e-13));
  BOOST_TEST((std::isnan(other.failed_lateral) && std::isnan(other.failure)));
}

BOOST_AUTO_TEST_CASE(theory_of_what_fails_is_the_closed_form) {
  const Case c = failing_case();
  for (const double f_max : {0.01, 0.5, 1.0}) {
    Case other = c;
    other.plate->failing()->law.most_converted = f_max;
    const Moduli m(elastic_of(*other.plate));
    const double strain = 1e9 / m.M;
    const ImpactTheory theory = impact_theory(*other.plate, 4e-3);
    BOOST_TEST(theory.failed_lateral == failed(m, strain, f_max).lateral, tt::tolerance(1e-12));
    BOOST_TEST((theory.failed_lateral > 1e9 / 3));
    // A constant d makes erfc.
    const double level = half_way_level(m, strain, f_max);
    BOOST_TEST((level > 0.4 && level < 0.7), level);
    BOOST_TEST(std::erfc(4e-3 / (2 * std::sqrt(8 * theory.failure))) == level, tt::tolerance(1e-9));
  }
  // Whatever the profile, as x²/d0.
  for (const auto profile : {diffusion::Profile::falling, diffusion::Profile::constant, diffusion::Profile::rising}) {
    Case other = c;
    other.plate->failing()->spread.profile = profile;
    const double once = impact_theory(*other.plate, 4e-3).failure;
    BOOST_TEST(impact_theory(*other.plate, 8e-3).failure == 4 * once, tt::tolerance(1e-10));
    other.plate->failing()->spread.diffusivity = 2;
    BOOST_TEST(impact_theory(*other.plate, 4e-3).failure == 4 * once, tt::tolerance(1e-10));
    if (profile != diffusion::Profile::constant) BOOST_TEST(once != impact_theory(*c.plate, 4e-3).failure);
  }
}

BOOST_AUTO_TEST_CASE(what_does_not_fail_has_no_time_of_failure) {
  const auto with = [](double f_max, double d0, double velocity) {
    Case c = failing_case();
    c.plate->failing()->law.most_converted = f_max;
    c.plate->failing()->spread.diffusivity = d0;
    c.plate->flyer->velocity = velocity;
    return impact_theory(*c.plate, 4e-3);
  };
  BOOST_TEST((std::isfinite(with(0.5, 8, 200).failed_lateral) && std::isfinite(with(0.5, 8, 200).failure)));
  BOOST_TEST((std::isnan(with(0, 8, 200).failed_lateral) && std::isnan(with(0, 8, 200).failure)));
  BOOST_TEST((std::isfinite(with(0.5, 0, 200).failed_lateral) && std::isnan(with(0.5, 0, 200).failure)));
  // The equivalent stress in uniaxial strain is 2G ε, two thirds of σ_x here: the threshold of 0.5 GPa is at 150 m/s.
  BOOST_TEST((std::isnan(with(0.5, 8, 149.9).failed_lateral) && std::isnan(with(0.5, 8, 149.9).failure)));
  BOOST_TEST((std::isfinite(with(0.5, 8, 150.1).failed_lateral) && std::isfinite(with(0.5, 8, 150.1).failure)));
  const ImpactTheory whole = impact_theory(*whole_solid().plate, 4e-3);
  BOOST_TEST((std::isnan(whole.failed_lateral) && std::isnan(whole.failure) && whole.plateau > 0));
}

// ---- measures by hand -----------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(a_step_is_measured_as_it_was_made) {
  const Case c = failing_case();
  const double elastic = 1.0 / 3, full = impact_theory(*c.plate, 4e-3).failed_lateral / 1e9;
  // Half-way at 3 µs.
  const History lateral{step.time, {0, 0, elastic, elastic, elastic, elastic, full, full, 0, 0}};
  const auto run = measured(c, seen(step, lateral, 1));
  const auto measure = [&](const std::string& name) { return run.measures.at(name); };
  const auto near = [&](const std::string& name) { return measure("gauge.near." + name); };
  BOOST_TEST(near("arrival") == 1e-6, tt::tolerance(1e-12));
  BOOST_TEST(near("rise") == 0.16e-6, tt::tolerance(1e-11));
  BOOST_TEST(near("overshoot") == 0.2, tt::tolerance(1e-12));
  BOOST_TEST(near("plateau") == 1e9, tt::tolerance(1e-12));  // from 3 to 7 µs
  // A tenth of the 8 µs, a fifth of them before the release: 6.6 to 7.4 µs.
  BOOST_TEST(near("longitudinal") == 1.0, tt::tolerance(1e-12));
  BOOST_TEST(near("lateral") == full / elastic, tt::tolerance(1e-12));
  const double half = (elastic + full) / 2;  // at 3 µs, where the middle begins
  BOOST_TEST(near("ratio") == (1 * (half + full) / 2 + 3 * full) / 4, tt::tolerance(1e-10));
  BOOST_TEST(near("failure") == 3e-6, tt::tolerance(1e-11));
  BOOST_TEST(near("release") == 9e-6, tt::tolerance(1e-12));
  // Beside them what the solid's own theory knows.
  BOOST_TEST(near("arrival.exact") == 1e-6, tt::tolerance(1e-12));
  BOOST_TEST(near("plateau.exact") == 1e9, tt::tolerance(1e-12));
  BOOST_TEST(near("release.exact") == 9e-6, tt::tolerance(1e-12));
  BOOST_TEST(near("ratio.exact") == elastic, tt::tolerance(1e-12));
  BOOST_TEST(near("failure.exact") == impact_theory(*c.plate, 4e-3).failure);
  for (const char* name : {"rise", "overshoot", "longitudinal", "lateral"})
    BOOST_TEST(!run.measures.contains("gauge.near." + std::string(name) + ".exact"));
  BOOST_TEST(!run.measures.contains("gauge.near.prediction"));
  // Between the gauges: 2 mm in 1 µs, and back to the face.
  BOOST_TEST(measure("gauge.far.arrival") == 2e-6, tt::tolerance(1e-12));
  BOOST_TEST(measure("failure.speed") == 2000.0, tt::tolerance(1e-9));
  BOOST_TEST(measure("failure.delay") == 1e-6, tt::tolerance(1e-9));
  BOOST_TEST(measure("failure.slowing") == 4.0 / 3, tt::tolerance(1e-9));
  // And the histories as they are.
  BOOST_REQUIRE_EQUAL(run.gauges.size(), 2u);
  BOOST_TEST((run.gauges[0].id == "near" && run.gauges[1].id == "far" && run.gauges[1].from_face == 6e-3));
  BOOST_TEST((run.gauges[0].xx.at(3) == -1.2e9 && run.gauges[0].yy.size() == step.time.size()));
  BOOST_TEST((run.gauges[0].dilatancy.at(0) == 0.001 && run.gauges[0].time.at(9) == 10 * 1e-6));
  for (const std::string& name :
       quantity_names(failing_case(), {Quantity::Sort::gauge_reading, Quantity::Sort::failure}))
    BOOST_TEST(run.measures.contains(name), name);
}

BOOST_AUTO_TEST_CASE(an_overshoot_after_the_release_is_none) {
  History late = step;
  late.value.back() = 5;
  const auto run = measured(failing_case(), seen(late, step));
  BOOST_TEST(run.measures.at("gauge.near.overshoot") == 0.2, tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(what_the_run_does_not_reach_is_no_number) {
  // It ends before the front has come.
  const History before{{0, 0.1, 0.5}, {0, 0, 0}};
  const auto run = measured(failing_case(), seen(before, before));
  for (const char* name : {"arrival", "rise", "plateau", "ratio", "longitudinal", "lateral", "failure", "release"})
    BOOST_TEST(std::isnan(run.measures.at("gauge.near." + std::string(name))), name);
  BOOST_TEST(!run.measures.contains("failure.speed"));
  // It ends on the plateau, at 5 µs: the middle half is that of 1 to 5, the late tenth 3.8 to 4.2.
  const History on{{0, 0.9, 1.1, 2, 4, 5}, {0, 0, 1, 1, 3, 3}};
  const auto short_run = measured(failing_case(), seen(on, on));
  BOOST_TEST(short_run.measures.at("gauge.near.plateau") == 2e9, tt::tolerance(1e-12));
  BOOST_TEST(short_run.measures.at("gauge.near.longitudinal") == (2.9 + 3) / 2, tt::tolerance(1e-12));
  BOOST_TEST(short_run.measures.at("gauge.near.lateral") == 3 * (2.9 + 3) / 2, tt::tolerance(1e-12));
  BOOST_TEST(std::isnan(short_run.measures.at("gauge.near.release")));
}

BOOST_AUTO_TEST_CASE(what_is_no_number_stays_none) {
  for (std::size_t n = 1; n < step.time.size() - 2; ++n) {
    History broken = step;
    broken.value[n] = nan_value;
    const auto run = measured(failing_case(), seen(broken, step));
    BOOST_TEST(std::isnan(run.measures.at("gauge.near.overshoot")), "sample " << n << " is forgotten");
    const auto elastic = measured(whole_solid(), seen(broken, step));
    BOOST_TEST(std::isnan(elastic.measures.at("gauge.near.prediction")), "sample " << n << " is forgotten");
  }
}

BOOST_AUTO_TEST_CASE(a_front_has_a_speed_where_it_is_seen_twice) {
  const Case c = failing_case();
  const double elastic = 1.0 / 3, full = impact_theory(*c.plate, 4e-3).failed_lateral / 1e9;
  const History lateral{step.time, {0, 0, elastic, elastic, elastic, elastic, full, full, 0, 0}};
  const auto speeds = [](const reports::Run& run) {
    return run.measures.count("failure.speed") + run.measures.count("failure.delay") +
           run.measures.count("failure.slowing");
  };
  BOOST_TEST(speeds(measured(c, seen(step, lateral, 1))) == 3u);
  BOOST_TEST(speeds(measured(c, seen(step, lateral, 0))) == 0u);  // at both at once
  PlateRecord once = seen(step, lateral, 1);
  once.gauges[1].yy.assign(step.time.size(), 0);
  BOOST_TEST(speeds(measured(c, once)) == 0u);
  Case alone = c;
  alone.gauges.resize(1);
  BOOST_TEST(speeds(measured(alone, seen(step, lateral, 1))) == 0u);
  BOOST_TEST(speeds(measured(whole_solid(), seen(step, lateral, 1))) == 0u);
  // Of the first and the last, whatever stands between.
  Case three = c;
  three.gauges = {c.gauges[0], {"middle", 5e-3}, c.gauges[1]};
  PlateRecord record = seen(step, lateral, 1);
  record.gauges.insert(record.gauges.begin() + 1, once.gauges[1]);
  BOOST_TEST(measured(three, record).measures.at("failure.speed") == 2000.0, tt::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(dilatancy_is_ahead_in_front_of_the_shock_and_three_nodes) {
  const Case c = failing_case();
  // At 1 µs the shocks are 4 nodes from the face at node 16.
  const auto ahead = [&](std::vector<std::pair<std::size_t, double>> values, double time = 1e-6) {
    PlateRecord record = seen(step, step);
    PlateSnapshot snapshot;
    snapshot.time = time;
    snapshot.concentration.assign(2 * 41, 0.0);
    for (const auto& [node, value] : values) snapshot.concentration.at(node) = value;
    record.snapshots.push_back(snapshot);
    const auto run = measured(c, record);
    return run.measures.contains("dilatancy.ahead") ? run.measures.at("dilatancy.ahead") : -1;
  };
  BOOST_TEST(ahead({{16, 0.01}, {22, 0.004}, {10, 0.004}}) == 0.0);
  BOOST_TEST(ahead({{16, 0.01}, {24, 0.001}}) == 0.1, tt::tolerance(1e-14));
  BOOST_TEST(ahead({{16, 0.01}, {8, 0.001}}) == 0.1, tt::tolerance(1e-14));        // in the flyer
  BOOST_TEST(ahead({{16, 0.01}, {41 + 24, 0.001}}) == 0.1, tt::tolerance(1e-14));  // in the upper row of nodes
  BOOST_TEST(ahead({{16, 0.01}, {41 + 22, 0.001}}) == 0.0);
  BOOST_TEST(ahead({{16, 0.01}, {24, -0.002}}) == 0.2, tt::tolerance(1e-14));
  BOOST_TEST(ahead({{16, 0.01}, {24, 0.001}}, 2e-6) == 0.0);  // it has passed there
  BOOST_TEST(ahead({}) == -1.0);                              // of nothing there is no part
  BOOST_TEST(!measured(c, seen(step, step)).measures.contains("dilatancy.ahead"));
  BOOST_TEST(!(ahead({{16, 0.01}, {30, nan_value}}) == 0.0), "what is no number is not taken for nothing");
}

// ½ erfc((x − ct)/√(2νt)): a tenth and nine tenths of it are at ±0.906194 √(2νt).
BOOST_AUTO_TEST_CASE(a_linear_viscosity_has_a_rise_of_its_own) {
  Case c = failing_case();
  const auto rise = [&](const char* gauge) {
    const auto run = measured(c, seen(step, step));
    const auto found = run.measures.find("gauge." + std::string(gauge) + ".rise.exact");
    return found == run.measures.end() ? nan_value : found->second;
  };
  BOOST_TEST(std::isnan(rise("near")));
  c.plate->viscosity = material::Viscosity{material::Viscosity::Form::york, 0.2, 0, 0.5, 2, true};
  const double nu = 0.2 * 0.5 * 2 * 4000 * 1e-3, z = std::sqrt(0.5) * 1.2815515655446004;
  BOOST_TEST(std::erfc(z) / 2 == 0.1, tt::tolerance(1e-12));
  BOOST_TEST(rise("near") == 2 * z * std::sqrt(2 * nu * 1e-6) / 4000, tt::tolerance(1e-6));
  BOOST_TEST(rise("far") == 2 * z * std::sqrt(2 * nu * 1.5e-6) / 4000, tt::tolerance(1e-6));
  c.plate->viscosity->always = false;
  BOOST_TEST(std::isnan(rise("near")));
  c.plate->viscosity->always = true;
  c.plate->viscosity->c2 = 0.1;
  BOOST_TEST(std::isnan(rise("near")));
}

BOOST_AUTO_TEST_CASE(what_is_left_of_a_gap_is_measured_in_cells_with_particles_alone) {
  PlateRecord record = seen(step, step);
  record.left_over = 2e-5;
  Case c = failing_case();
  BOOST_TEST(measured(c, record, "mpm-musl").measures.at("impact.left-over") == 0.02, tt::tolerance(1e-14));
  BOOST_TEST(!measured(c, record, "fem").measures.contains("impact.left-over"));
  c.plate->flyer->gap = 0;
  BOOST_TEST(!measured(c, record, "mpm-musl").measures.contains("impact.left-over"));
  c.plate->flyer.reset();
  const auto none = measured(c, record, "mpm-musl");
  BOOST_TEST((none.measures.empty() && none.gauges.empty()));
}

BOOST_AUTO_TEST_CASE(the_lattice_predicts_the_elastic_plate_alone) {
  const auto predicts = [](const Case& c) {
    return measured(c, seen(step, step)).measures.contains("gauge.far.prediction");
  };
  BOOST_TEST(predicts(whole_solid()));
  BOOST_TEST(!predicts(failing_case()));
  Case viscous = whole_solid();
  viscous.plate->viscosity = material::Viscosity{};
  BOOST_TEST(!predicts(viscous));
  Case smoothed = whole_solid();
  smoothed.plate->pic = 0.1;
  BOOST_TEST(!predicts(smoothed));

  // The largest difference, over the plateau.
  const Case c = whole_solid();
  Leaf leaf;
  leaf.method = "fem";
  leaf.cells = 40;
  const analytic::ImpactLattice lattice(*impact_lattice(*c.plate, leaf, 7.5e-8));
  PlateRecord record = seen(step, step);
  for (GaugeRecord& gauge : record.gauges) {
    gauge.time.clear();
    for (long n = 1; n <= 130; ++n) gauge.time.push_back(lattice.stress_time(n));
    gauge.yy.assign(130, -1.0);
  }
  record.gauges[0].xx = lattice.history(20e-3, 130);
  record.gauges[1].xx = lattice.history(22e-3, 130);
  record.gauges[1].xx[70] += 2e7;
  record.gauges[1].xx[90] -= 3e7;
  const auto run = measured(c, record);
  BOOST_TEST(run.measures.at("gauge.near.prediction") == 0.0);
  BOOST_TEST(run.measures.at("gauge.far.prediction") == 0.03, tt::tolerance(1e-12));
  for (const char* name : {"arrival", "rise", "overshoot", "plateau", "release"}) {
    const std::string all = "gauge.near." + std::string(name);
    BOOST_TEST(run.measures.at(all) == run.measures.at(all + ".predicted"), name);
  }
}

// ---- measures of runs -----------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(the_lattice_predicts_small_runs_to_round_off) {
  const Case c = parse_case(elastic_text, "t.toml");
  const auto runs = run_cases({c}, {}).at(0).runs;
  BOOST_REQUIRE_EQUAL(runs.size(), 4u);
  for (const auto& run : runs) {
    BOOST_REQUIRE_EQUAL(run.status, "completed");
    BOOST_TEST(run.invalid == "", run.label() << ": " << run.invalid);
    const auto measure = [&](const std::string& name) { return run.measures.at(name); };
    for (const std::string gauge : {"gauge.near.", "gauge.far."}) {
      BOOST_TEST(measure(gauge + "prediction") <= 1e-9, run.label());
      for (const char* name : {"arrival", "rise", "overshoot", "plateau", "release"}) {
        BOOST_TEST(std::isfinite(measure(gauge + name)), run.label() << ": " << gauge << name);
        BOOST_TEST(measure(gauge + name) == measure(gauge + name + ".predicted"), tt::tolerance(1e-8));
      }
      BOOST_TEST(measure(gauge + "ratio") == measure(gauge + "ratio.exact"), tt::tolerance(1e-12));
      BOOST_TEST(measure(gauge + "plateau") == measure(gauge + "plateau.exact"), tt::tolerance(0.02));
      BOOST_TEST(measure(gauge + "arrival") == measure(gauge + "arrival.exact"), tt::tolerance(0.15));
      BOOST_TEST(measure(gauge + "release") == measure(gauge + "release.exact"), tt::tolerance(0.05));
      BOOST_TEST(std::isnan(measure(gauge + "failure")));
    }
    BOOST_TEST(run.measures.contains("impact.left-over") == (run.method != "fem"));
    if (run.method != "fem") BOOST_TEST(std::abs(measure("impact.left-over")) <= 0.04);
    BOOST_REQUIRE_EQUAL(run.gauges.size(), 2u);
    BOOST_TEST(run.gauges[0].time.size() == static_cast<std::size_t>(run.steps));
    BOOST_TEST(run.gauges[0].dilatancy.empty());
  }
  using reports::Verdict;
  const auto verdict = [&](std::size_t gate) { return judge(c, c.gates.at(gate), runs).verdict; };
  BOOST_TEST((verdict(0) == Verdict::pass));
  BOOST_TEST((verdict(1) == Verdict::pass));
  BOOST_TEST((verdict(2) != Verdict::pass));  // of no failure
  // Each is held against its own theory.
  auto other = runs;
  for (auto& run : other) run.measures["gauge.near.plateau.predicted"] *= 1.001;
  BOOST_TEST((judge(c, c.gates[0], other).verdict == Verdict::fail));
  Case exact = c;
  auto& measured = replace_criterion<RatioCriterion>(exact.gates[0]);
  measured.theory = "plate-impact";
  measured.ratio = {0.97, 1.03};
  BOOST_TEST((judge(exact, exact.gates[0], other).verdict == Verdict::pass));
  for (auto& run : other) run.measures.erase("gauge.near.plateau.exact");
  BOOST_TEST((judge(exact, exact.gates[0], other).verdict == Verdict::invalid));
}

BOOST_AUTO_TEST_CASE(a_strip_has_square_cells_on_every_mesh) {
  const Case c = failing_case();
  for (const int cells : {5, 40, 80}) {
    Leaf leaf;
    leaf.method = "fem";
    leaf.cells = cells;
    const Case run = with_parameters(c, leaf);
    const auto grid = grid_of(*run.plate, cells);
    BOOST_TEST((grid.nx == cells && grid.ny == 1 && grid.hx == 40e-3 / cells));
    BOOST_TEST(grid.hy == grid.hx, tt::tolerance(1e-15));
    const Plate plate = make_plate(run, cells);
    BOOST_REQUIRE(plate.impact.has_value());
    BOOST_TEST((plate.impact->face == 16e-3 && plate.impact->velocity == 200));
    BOOST_TEST(plate.impact->gap == 2 * grid.hx, tt::tolerance(1e-15));
    BOOST_REQUIRE_EQUAL(plate.gauges.size(), 2u);
    BOOST_TEST((plate.gauges[1].x == 16e-3 + 6e-3 && plate.gauges[1].y == run.plate->height / 2));
    const diffusion::Spread spread = std::get<solid::Failing>(solid_of(run, cells)).spread;
    BOOST_TEST((spread.face == cells * 2 / 5 && spread.start.empty()));
  }
}

// ---- figure and page ------------------------------------------------------------------------------------------------

namespace {

/// A run of each method and of two variants; of the third there is none.
std::vector<reports::Run> made_runs() {
  std::vector<reports::Run> runs;
  for (const char* method : {"fem", "mpm-musl"}) {
    for (const char* variant : {"", "weak"}) {
      const bool fem = std::string(method) == "fem";
      reports::Run run = made_run(method, 40, 0.3);
      run.parameters = variant;
      run.steps = 100;
      for (const double from_face : {4e-3, 6e-3}) {
        const std::string id = from_face < 5e-3 ? "near" : "far";
        run.gauges.push_back({id, from_face, {1e-6, 2e-6}, {0, fem ? -1.1e9 : -1.2e9}, {0, -0.3e9}, {0, 0}});
        run.measures["gauge." + id + ".overshoot"] = fem ? 0.1 : 0.2;
        run.measures["gauge." + id + ".rise"] = 50e-9;
        run.measures["gauge." + id + ".failure"] = from_face < 5e-3 ? 2.5e-6 : 3.5e-6;
      }
      run.measures["failure.speed"] = fem ? 2000 : 2100;
      run.measures["failure.delay"] = 0.5e-6;
      runs.push_back(run);
    }
  }
  return runs;
}

const reports::Figure::Series& series(const reports::Figure::Panel& panel, const std::string& label) {
  const auto found =
      std::find_if(panel.series.begin(), panel.series.end(), [&](const auto& s) { return s.label == label; });
  BOOST_REQUIRE_MESSAGE(found != panel.series.end(), "no series '" << label << "'");
  return *found;
}

/// Whether the page says that a run is.
bool missing(const reports::Page::Row& row) {
  return std::count(row.values.begin(), row.values.end(), "did not complete") == 1;
}

/// What a row holds under a head that has `part` in it.
std::string under(const reports::Page::Section& section, std::size_t row, const std::string& part) {
  for (std::size_t k = 0; k < section.columns.size(); ++k)
    if (holds(section.columns[k], part)) return section.rows.at(row).values.at(k);
  return "no such column";
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_figure_of_gauges_has_a_panel_for_each_of_them) {
  const Case c = failing_case();
  const auto figure = drawn_figure(c, "fig16", made_runs());
  BOOST_TEST(figure.id == "fig16");
  BOOST_TEST(figure.title == "Fig. 16. A struck plate");
  BOOST_REQUIRE_EQUAL(figure.panels.size(), 2u);
  BOOST_TEST(holds(figure.panels[0].label, "4 mm from the impact face"));
  BOOST_TEST(holds(figure.panels[1].label, "6 mm from the impact face"));
  BOOST_TEST((figure.x_min == 0 && figure.x_max == 10));
  BOOST_TEST((figure.y_min < 0 && figure.y_max > 1.2));
  for (std::size_t p = 0; p < 2; ++p) {
    const auto& panel = figure.panels[p];
    BOOST_REQUIRE_EQUAL(panel.series.size(), 6u);  // two components: exact and two methods
    const double from_face = p == 0 ? 4e-3 : 6e-3, arrival = from_face / 4000 * 1e6;
    // The exact one lies lowest: a step at its arrival.
    BOOST_TEST((panel.series[0].kind == "exact" && panel.series[1].kind == "exact"));
    for (std::size_t k = 0; k < 2; ++k) {
      const auto& curve = panel.series[k].curve;
      BOOST_REQUIRE_EQUAL(curve.x.size(), curve.y.size());
      BOOST_TEST(curve.x.at(1) == arrival, tt::tolerance(1e-12));
      BOOST_TEST(curve.x.at(2) == arrival, tt::tolerance(1e-12));
      BOOST_TEST((curve.x[0] == 0 && curve.y[0] == 0 && curve.y[1] == 0));
      BOOST_TEST(curve.y.at(2) == (k == 0 ? 1 : 1.0 / 3), tt::tolerance(1e-12));
      BOOST_TEST(std::is_sorted(curve.x.begin(), curve.x.end()));
    }
    const auto &fem = series(panel, "FEM, −σ_x"), &mpm = series(panel, "MPM, MUSL, −σ_x"),
               &across = series(panel, "MPM, MUSL, −σ_y");
    BOOST_TEST((fem.kind == "fem" && mpm.kind == "mpm" && across.kind == "mpm-thin"));
    BOOST_TEST(series(panel, "FEM, −σ_y").kind == "fem-thin");
    BOOST_TEST(fem.curve.x.at(1) == 2.0, tt::tolerance(1e-14));
    BOOST_TEST(fem.curve.y.at(1) == 1.1, tt::tolerance(1e-14));
    BOOST_TEST(mpm.curve.y.at(1) == 1.2, tt::tolerance(1e-14));
    BOOST_TEST(across.curve.y.at(1) == 0.3, tt::tolerance(1e-14));
    // Published fronts: between the fastest, which sets off first, and the slowest.
    BOOST_REQUIRE_EQUAL(panel.spans.size(), 2u);
    BOOST_TEST((panel.spans[0].label == "range" && panel.spans[1].label == "late"));
    BOOST_TEST(panel.spans[0].from == from_face / 2000 * 1e6, tt::tolerance(1e-12));
    BOOST_TEST(panel.spans[0].to == from_face / 1000 * 1e6, tt::tolerance(1e-12));
    BOOST_TEST(panel.spans[1].from == from_face / 4000 * 1e6 + 0.25, tt::tolerance(1e-12));
    BOOST_TEST(panel.spans[1].to == from_face / 4000 * 1e6 + 0.75, tt::tolerance(1e-12));
    const ImpactTheory theory = impact_theory(*c.plate, from_face);
    BOOST_REQUIRE_EQUAL(panel.marks.size(), 2u);
    BOOST_TEST((!panel.marks[0].vertical && panel.marks[1].vertical));
    BOOST_TEST(panel.marks[0].at == theory.failed_lateral / 1e9, tt::tolerance(1e-14));
    BOOST_TEST(panel.marks[1].at == theory.failure * 1e6, tt::tolerance(1e-14));
  }
  std::string notes;
  for (const auto& note : figure.notes) notes += note + '\n';
  for (const char* part : {"σ_x = ½ρc_L v = 1.000 GPa", "16 mm at 200 m/s", "d = d0,", "d0 = 8 m²/s", "f_max = 0.5",
                           "threshold 0.5 GPa", "no artificial viscosity", "Courant number 0.3", "40 cells of 1 mm"})
    BOOST_TEST(holds(notes, part), part << " in\n" << notes);
}

BOOST_AUTO_TEST_CASE(a_figure_of_gauges_shows_what_is_asked_for) {
  const Case c = failing_case();
  const auto figure = drawn_figure(c, "one", made_runs());
  BOOST_REQUIRE_EQUAL(figure.panels.size(), 2u);  // of one gauge and two variants
  for (const auto& panel : figure.panels) {
    BOOST_TEST(holds(panel.label, "6 mm"));
    BOOST_TEST(holds(panel.label, "FEM overshoot 10.0 %, 10–90 % in 50 ns"), panel.label);
    BOOST_TEST(holds(panel.label, "MPM overshoot 20.0 %"), panel.label);
    BOOST_REQUIRE_EQUAL(panel.series.size(), 3u);
    BOOST_TEST((panel.series[0].label == "elastic, exact" && panel.series[1].label == "FEM"));
    BOOST_TEST(panel.series[2].label == "MPM, MUSL");
    BOOST_TEST((panel.spans.empty() && panel.marks.empty()));  // no bands asked for; a lateral level says nothing here
  }
  BOOST_TEST(figure.x_min == 1.0, tt::tolerance(1e-14));
  BOOST_TEST(figure.x_max == 3.0, tt::tolerance(1e-14));
  BOOST_TEST((figure.y_min == -1 && figure.y_max == 2));
  BOOST_TEST(figure.y_label == "−σ_x [GPa]");
  // What fails in one of them is marked with that one's level.
  const std::string along = "components = [\"longitudinal\"]\n";
  std::string lateral = failing;
  lateral.replace(lateral.find(along), along.size(), "components = [\"lateral\"]\n");
  const auto across = drawn_figure(parse_case(lateral, "t.toml"), "one", made_runs());
  BOOST_TEST(across.y_label == "−σ_y [GPa]");
  Leaf weak;
  weak.cells = 40;
  weak.variant = "weak";
  BOOST_REQUIRE(!across.panels.at(0).marks.empty());
  BOOST_TEST(across.panels[0].marks[0].at == impact_theory(*with_parameters(c, weak).plate, 6e-3).failed_lateral / 1e9,
             tt::tolerance(1e-14));
  BOOST_TEST(across.panels[0].marks[0].at < across.panels.at(1).marks.at(0).at);
}

BOOST_AUTO_TEST_CASE(a_label_does_not_take_what_is_no_number_for_nothing) {
  const Case c = failing_case();
  auto runs = made_runs();
  for (auto& run : runs) run.measures["gauge.far.overshoot"] = nan_value;
  for (const auto& panel : drawn_figure(c, "one", runs).panels)
    BOOST_TEST(!holds(panel.label, "overshoot 0.0 %"), panel.label);
}

BOOST_AUTO_TEST_CASE(a_figure_says_what_is_missing_and_draws_no_line_backwards) {
  Case c = failing_case();
  auto runs = made_runs();
  std::erase_if(runs, [](const auto& run) { return run.method == "mpm-musl"; });
  const auto figure = drawn_figure(c, "fig16", runs);
  BOOST_TEST(figure.panels.at(0).series.size() == 4u);
  BOOST_TEST(holds(figure.notes.back(), "mpm-musl is missing"), figure.notes.back());
  // A run that ends before the front has come to the gauge.
  c.times = {0.5e-6};
  const auto early = drawn_figure(c, "fig16", runs);
  for (const auto& one : early.panels.at(0).series)
    if (one.kind == "exact") BOOST_TEST(std::is_sorted(one.curve.x.begin(), one.curve.x.end()));
}

BOOST_AUTO_TEST_CASE(the_page_shows_every_variant_of_its_sections) {
  const Case c = failing_case();
  const reports::Case result = drawn_case(c, made_runs());
  BOOST_REQUIRE_EQUAL(result.pages.size(), 1u);
  BOOST_TEST(result.pages[0].first == "failure");
  const reports::Page& page = result.pages[0].second;
  BOOST_TEST(page.title == "A struck plate");
  BOOST_REQUIRE_EQUAL(page.sections.size(), 5u);  // the model, two pictures, two tables
  // Each statement of the model has its standing and its source.
  BOOST_TEST(!page.sections[0].rows.empty());
  for (const auto& row : page.sections[0].rows) {
    BOOST_REQUIRE_EQUAL(row.values.size(), 2u);
    BOOST_TEST((!row.name.empty() && !row.values[1].empty()));
    BOOST_TEST((row.values[0] == "certain" || row.values[0] == "reconstruction" || row.values[0] == "choice"));
  }
  // Their numbers, and those of the prose, are the case's own.
  BOOST_TEST((page.intro.at(0) == "w" && page.intro.at(1) == "A glass of 2500 kg/m³."), page.intro.at(1));
  BOOST_TEST((page.sections[0].text == std::vector<std::string>{"It fails at 0.5 GPa.", "Or not."}));
  BOOST_REQUIRE_EQUAL(page.sections[0].rows.size(), 3u);
  BOOST_TEST(page.sections[0].rows[0].name == "E = 33.3333 GPa, ν = 0.25");
  BOOST_TEST(page.sections[0].rows[1].name == "Part 0.5 is converted; d0 = 8");
  BOOST_TEST(page.sections[0].rows[1].values[1] == "σ_x = 0.75 GPa");  // of which the lateral stress is a third
  BOOST_TEST(page.sections[0].rows[2].name == "Struck at 200 m/s");
  BOOST_TEST((page.sections[1].picture == "fig16.svg" && page.sections[2].picture == "one.svg"));
  BOOST_TEST(page.sections[1].heading == "Fig. 16. A struck plate");
  const auto &converted = page.sections[3], &impact = page.sections[4];
  BOOST_TEST((converted.heading == "Converted" && converted.text.at(0) == "How much."));
  BOOST_REQUIRE_EQUAL(converted.rows.size(), 4u);
  BOOST_TEST((holds(converted.rows[0].name, "FEM") && holds(converted.rows[1].name, "MPM, MUSL")));
  BOOST_TEST((converted.rows[0].reference && !converted.rows[2].reference));
  BOOST_TEST((holds(converted.rows[2].name, "half of it is converted") && holds(converted.rows[2].name, "FEM")));
  for (const auto& row : converted.rows) BOOST_TEST(row.values.size() == converted.columns.size());
  const auto value = [&](std::size_t row, const std::string& head) { return under(converted, row, head); };
  BOOST_TEST(value(0, "failure at 4 mm [µs]") == "2.5");
  BOOST_TEST(value(0, "failure at 6 mm [µs]") == "3.5");
  BOOST_TEST(value(0, "speed [km/s]") == "2");
  BOOST_TEST(value(1, "speed [km/s]") == "2.1");
  BOOST_TEST(value(1, "delay [µs]") == "0.5");
  BOOST_TEST(value(0, "ratio of arrivals") == "–");  // not measured
  // Not run: said, not left out.
  BOOST_REQUIRE_EQUAL(impact.rows.size(), 2u);
  for (const auto& row : impact.rows) {
    BOOST_TEST(holds(row.name, "below the threshold"), row.name);
    BOOST_TEST(missing(row));
    BOOST_TEST(row.values.front() == "–");
  }
  for (const auto& row : converted.rows) BOOST_TEST(!missing(row));
  BOOST_TEST(holds(reports::page_html(page), "half of it is converted"));
  // A run that blew up did not complete either.
  auto unstable = made_runs();
  for (auto& run : unstable) run.status = "unstable";
  const reports::Case broken = drawn_case(c, unstable);
  for (const auto& row : broken.pages.at(0).second.sections.at(3).rows) BOOST_TEST(missing(row));
}

// The sum of what the steps of the diffusion have cost is a number of the run, not a dash.
BOOST_AUTO_TEST_CASE(the_page_tells_what_the_diffusion_costs) {
  Case c = failing_case();
  c.times = {1e-6};
  c.axes[0].method = {"fem"};
  c.axes[0].variant = {""};
  c.figures[2].methods = {"fem"};
  const reports::Case result = drawn_case(c, run_cases({c}, {}).at(0).runs);
  BOOST_REQUIRE_EQUAL(result.runs.size(), 1u);
  BOOST_REQUIRE_EQUAL(result.runs[0].status, "completed");
  BOOST_TEST(result.runs[0].invalid == "", result.runs[0].invalid);
  const auto& section = result.pages.at(0).second.sections.at(3);
  const std::string updates = under(section, 0, "node updates");
  BOOST_REQUIRE_MESSAGE(updates != "no such column" && updates != "–", updates);
  BOOST_TEST(std::stod(updates) >= 41 * 2);  // each node at least once a step
}

BOOST_AUTO_TEST_SUITE_END()
