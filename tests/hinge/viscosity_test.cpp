// Artificial viscosity: the two forms by hand, then what they do in a bar of either method.
#include "hinge/material/viscosity.hpp"

#include <algorithm>
#include <array>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <optional>
#include <utility>

#include "fem/bar.hpp"
#include "mpm/bar.hpp"
#include "tests/bar_methods.hpp"
#include "tests/scenes.hpp"
#include "tests/steps.hpp"

BOOST_AUTO_TEST_SUITE(viscosity)

using namespace diptych;
using namespace diptych::tests;
using material::Viscosity;
using Form = material::Viscosity::Form;
namespace tt = boost::test_tools;
namespace bdata = boost::unit_test::data;

namespace {

const Viscosity york{Form::york, 0.5, 2, 0.75, 1.25};
const Viscosity common{Form::linear_quadratic, 0.5, 2};

/// A free bar of length 1 whose ends close in at ±1, velocity linear between.
Scene squeezed(std::optional<Viscosity> viscosity, material::Material m = material::Elastic{1e4, 2}) {
  Scene scene;
  scene.bars[0].length = 1;
  scene.bars[0].material = m;
  scene.bars[0].initial_velocity = [](double x) { return 1 - 2 * x; };
  scene.viscosity = viscosity;
  return scene;
}

void same_bits(const Record& a, const Record& b) {
  for (std::size_t k = 0; k < a.snapshots.size(); ++k) {
    for (const auto field : {&Snapshot::stress, &Snapshot::velocity, &Snapshot::displacement}) {
      BOOST_TEST((a.snapshots[k].*field).value == (b.snapshots[k].*field).value, tt::per_element());
    }
  }
}

}  // namespace

// ρ λ c g h D (c₁ + c₂ |D|/|D|max) = 3 · 0.75 · 100 · 1.25 · 0.1 · (−4) (0.5 + 2 · 4/16).
BOOST_AUTO_TEST_CASE(yorks_form_by_hand) {
  BOOST_TEST(york.stress(-4, 16, 3, 100, 0.1) == -112.5, tt::tolerance(1e-14));
  BOOST_TEST(york.stress(-16, 16, 3, 100, 0.1) == 3 * 0.75 * 100 * 1.25 * 0.1 * -16 * 2.5, tt::tolerance(1e-14));
  const Viscosity linear{Form::york, 0.5, 0, 0.75, 1.25};
  BOOST_TEST(linear.stress(-4, 0, 3, 100, 0.1) == 3 * 0.75 * 100 * 1.25 * 0.1 * -4 * 0.5, tt::tolerance(1e-14));
  BOOST_TEST((york.needs_largest() && !linear.needs_largest() && !common.needs_largest()));
}

// ρ (c₁ c h |D| + c₂ h² D²) = 3 (0.5 · 100 · 0.1 · 4 + 2 · 0.01 · 16), as a pressure.
BOOST_AUTO_TEST_CASE(linear_and_quadratic_form_by_hand) {
  BOOST_TEST(common.stress(-4, 1e9, 3, 100, 0.1) == -3 * (20 + 0.32), tt::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(expansion_and_rest_feel_exactly_nothing) {
  for (const Viscosity& v : {york, common}) {
    for (const double D : {0.0, 1e-300, 1e-3, 4.0, 1e6}) BOOST_TEST(v.stress(D, 16, 3, 100, 0.1) == 0.0);
    BOOST_TEST(v.stress(-1e-6, 16, 3, 100, 0.1) < 0);
  }
}

// Where it acts in expansion as well it is odd in D, and rest is still rest.
BOOST_AUTO_TEST_CASE(it_may_act_always) {
  for (Viscosity v : {york, common}) {
    BOOST_TEST((v.acts(-1) && !v.acts(0) && !v.acts(1)));
    v.always = true;
    BOOST_TEST((v.acts(-1) && !v.acts(0) && v.acts(1)));
    BOOST_TEST(v.stress(0, 16, 3, 100, 0.1) == 0.0);
    BOOST_TEST(v.stress(4, 16, 3, 100, 0.1) == -v.stress(-4, 16, 3, 100, 0.1));
    BOOST_TEST(v.stress(4, 16, 3, 100, 0.1) > 0);
  }
}

// York's form is linear in ρ, c, h and, at a given part of the largest, in D; the other has h D for a velocity beside
// c.
BOOST_AUTO_TEST_CASE(both_forms_scale_as_they_say) {
  const double q = york.stress(-4, 16, 3, 100, 0.1);
  BOOST_TEST(york.stress(-4, 16, 6, 100, 0.1) == 2 * q, tt::tolerance(1e-14));
  BOOST_TEST(york.stress(-4, 16, 3, 200, 0.1) == 2 * q, tt::tolerance(1e-14));
  BOOST_TEST(york.stress(-4, 16, 3, 100, 0.2) == 2 * q, tt::tolerance(1e-14));
  BOOST_TEST(york.stress(-8, 32, 3, 100, 0.1) == 2 * q, tt::tolerance(1e-14));
  const double p = common.stress(-4, 16, 3, 100, 0.1);
  BOOST_TEST(common.stress(-4, 16, 6, 100, 0.1) == 2 * p, tt::tolerance(1e-14));
  BOOST_TEST(common.stress(-2, 16, 3, 100, 0.2) == p, tt::tolerance(1e-14));        // the same h D
  BOOST_TEST(common.stress(-8, 16, 3, 200, 0.1) == 4 * p, tt::tolerance(1e-14));    // all velocities twofold
  BOOST_TEST(common.stress(-4, 16, 3, 200, 0.1) - p == -60, tt::tolerance(1e-13));  // c alone: c₁ ρ c h |D|
}

BOOST_AUTO_TEST_CASE(strength_by_hand) {
  BOOST_TEST(york.strength(100, 7) == 0.75 * 1.25 * 2.5, tt::tolerance(1e-14));
  BOOST_TEST(common.strength(100, 7) == 0.5 + 2 * 0.07, tt::tolerance(1e-14));
  // ν = q/(ρD) at the largest D is strength · c · h
  BOOST_TEST(york.stress(-16, 16, 3, 100, 0.1) / (3.0 * -16) == york.strength(100, 7) * 100 * 0.1,
             tt::tolerance(1e-14));
  BOOST_TEST(common.stress(-70, 16, 3, 100, 0.1) / (3.0 * -70) == common.strength(100, 7) * 100 * 0.1,
             tt::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(the_time_step_that_is_left_by_hand) {
  // n = 0.75: C = √(1 + 9/16) − 3/4 = 1/2
  const Viscosity n{Form::linear_quadratic, 0.75, 0};
  Scene scene = step_scene();
  scene.viscosity = n;
  BOOST_TEST(fem::critical_time_step(scene, 50) == 0.5 * 0.02 / 100, tt::tolerance(1e-13));
  // MUSL with one centred particle: the limit 2 becomes √(4 + n²) − n; n = 1.5: 1
  scene.viscosity = Viscosity{Form::linear_quadratic, 1.5, 0};
  BOOST_TEST(mpm::critical_time_step(scene, 50, {0.5}, mpm::Scheme::musl) == 0.02 / 100, tt::tolerance(1e-13));
  // the quadratic term by the largest difference of velocities at the start, 2: n = 0.5 + 12.5 · 2/100
  scene.bars[0].initial_velocity = [](double x) { return 1 - 2 * x; };
  scene.viscosity = Viscosity{Form::linear_quadratic, 0.5, 12.5};
  BOOST_TEST(fem::critical_time_step(scene, 50) == 0.5 * 0.02 / 100, tt::tolerance(1e-13));
  // York's c is that of the fastest bar, so in one half as fast the same n counts twice
  scene = step_scene();
  scene.bars.push_back(scene.bars[0]);
  scene.bars[1].begin = 1;
  scene.bars[1].material = material::Elastic{4e4, 1};
  scene.viscosity = Viscosity{Form::york, 1, 0, 0.375, 1};
  const double fast = (std::sqrt(1 + 0.375 * 0.375) - 0.375) * 0.02 / 200, slow = 0.5 * 0.02 / 100;
  BOOST_TEST(fem::critical_time_step(scene, 50) == std::min(fast, slow), tt::tolerance(1e-13));
}

// One element of length 1 and end masses ρ/2 = 1, closing in by D = −2: after the first step σ = E D Δt and q; the
// second kick takes Δt (σ + q)/1 from each end.
BOOST_AUTO_TEST_CASE(two_steps_of_one_element_by_hand) {
  const double dt = 1e-4, c = std::sqrt(5e3), sigma = 1e4 * -2 * dt;
  for (const Viscosity& v : {york, common}) {
    const double q = v.form == Form::york ? 2 * 0.75 * c * 1.25 * -2 * 2.5 : 2 * (0.5 * c * -2 - 2 * 4);
    const Record r = fem::run(squeezed(v), 1, steps_of(dt, 2));
    const auto& velocity = r.snapshots[0].velocity.value;
    BOOST_TEST(velocity[0] == 1 + dt * (sigma + q), tt::tolerance(1e-14));
    BOOST_TEST(velocity[1] == -1 - dt * (sigma + q), tt::tolerance(1e-14));
    BOOST_TEST(r.snapshots[0].stress.value[0] == sigma - 2 * velocity[0] * dt * 1e4,
               tt::tolerance(1e-13));  // without q
    // the books: q does half of its work on the strain that made it and half on the next
    BOOST_TEST(r.ledger[0].viscous == 0.0);
    BOOST_TEST(r.ledger[1].viscous == q * dt * (-2 - 2 * velocity[0]) / 2, tt::tolerance(1e-13));
  }
}

// One cell of length 1 with two particles of mass 1, at ±½ at first. The nodes get ±(¾ · ½ − ¼ · ½)/1 = ±¼, D = −½; q
// and σ stand at the end of the first step and take Δt (¾ − ¼)(σ + q)/1 from each particle in the second.
BOOST_AUTO_TEST_CASE(two_steps_of_one_cell_by_hand) {
  const double dt = 1e-4, c = std::sqrt(5e3), sigma = 1e4 * -0.5 * dt;
  for (const Viscosity& v : {york, common}) {
    const double q = v.form == Form::york ? 2 * 0.75 * c * 1.25 * -0.5 * 2.5 : 2 * (0.5 * c * -0.5 - 2 * 0.25);
    const Record r = mpm::run(squeezed(v), 1, {0.25, 0.75}, mpm::Scheme::musl, steps_of(dt, 2));
    const auto& velocity = r.snapshots[0].velocity.value;
    BOOST_TEST(velocity[0] == 0.5 + dt * (sigma + q) / 2, tt::tolerance(1e-14));
    BOOST_TEST(velocity[1] == -0.5 - dt * (sigma + q) / 2, tt::tolerance(1e-14));
  }
}

// Two bars, each squeezed in one step, the first at half the rate: York's form takes c of the fastest bar and the
// largest rate of all of them, the other what is at hand.
BOOST_DATA_TEST_CASE(bars_share_the_fastest_wave_and_the_largest_rate, bdata::make({0, 3}), method) {
  for (const Viscosity& v : {york, common}) {
    Scene scene = squeezed(v);
    scene.bars[0].initial_velocity = [](double x) { return 0.5 - x; };
    scene.bars.push_back(scene.bars[0]);
    scene.bars[1].begin = 2;
    scene.bars[1].material = material::Elastic{8e4, 1};
    scene.bars[1].initial_velocity = [](double x) { return 1 - 2 * (x - 2); };
    const double dt = 1e-5, c1 = std::sqrt(5e3), c2 = std::sqrt(8e4);
    const Record r = run_bars(method, scene, 1, steps_of(dt, 2), {0.25, 0.75});
    // FEM sees rates of −1 and −2; half of a particle's speed is lost to the grid's: −¼ and −½
    const double rate = method == 0 ? 1 : 0.25, sigma = -1e4 * rate * dt, sigma2 = -8e4 * 2 * rate * dt;
    const double q1 = v.form == Form::york ? -2 * 0.75 * c2 * 1.25 * rate * (0.5 + 2 * 0.5)
                                           : -2 * (0.5 * c1 * rate + 2 * rate * rate);
    const double q2 = v.form == Form::york ? -1 * 0.75 * c2 * 1.25 * 2 * rate * (0.5 + 2)
                                           : -1 * (0.5 * c2 * 2 * rate + 2 * 4 * rate * rate);
    const double share = method == 0 ? 1 : 0.5, start = method == 0 ? 1 : 0.5;  // of Δt (σ + q)/(ρ/2); speeds
    const auto left = r.snapshots[0].velocity.of_bar(0).value, right = r.snapshots[0].velocity.of_bar(1).value;
    BOOST_TEST(left[0] == start / 2 + share * dt * (sigma + q1) / 1, tt::tolerance(1e-13));
    BOOST_TEST(right[0] == start + share * dt * (sigma2 + q2) / 0.5, tt::tolerance(1e-13));
  }
}

BOOST_DATA_TEST_CASE(without_constants_it_changes_no_bit, bdata::make({0, 1, 2, 3}), method) {
  for (const Form form : {Form::york, Form::linear_quadratic}) {
    for (const bool moving : {false, true}) {
      Scene with = squeezed(Viscosity{form, 0, 0}), without = squeezed({});
      with.convected = without.convected = moving;
      same_bits(run_bars(method, without, 20, steps_of(2e-4, 300)), run_bars(method, with, 20, steps_of(2e-4, 300)));
    }
  }
}

// Acting always, it makes of a bar that is pulled apart what it makes of one that is squeezed, to the bit and reversed.
BOOST_DATA_TEST_CASE(acting_always_it_knows_no_sign, bdata::make({0, 1, 2, 3}), method) {
  for (Viscosity v : {york, common}) {
    v.always = true;
    const Scene squeeze = squeezed(v);
    Scene pull = squeeze;
    pull.bars[0].initial_velocity = [](double x) { return 2 * x - 1; };
    const Record a = run_bars(method, squeeze, 16, steps_of(2e-5, 500)),
                 b = run_bars(method, pull, 16, steps_of(2e-5, 500));
    BOOST_REQUIRE((a.outcome == Outcome::completed));
    std::vector<double> stress = a.snapshots[0].stress.value, velocity = a.snapshots[0].velocity.value;
    for (double& x : stress) x = -x;
    for (double& x : velocity) x = -x;
    BOOST_TEST(b.snapshots[0].stress.value == stress, tt::per_element());
    BOOST_TEST(b.snapshots[0].velocity.value == velocity, tt::per_element());
    BOOST_TEST(a.ledger.back().viscous == b.ledger.back().viscous);
    BOOST_TEST(a.ledger.back().viscous > 0);
    BOOST_TEST(std::abs(a.ledger.back().lost) < 1e-12 * a.ledger.front().kinetic);
  }
}

// A tensile front whose every number is a power of two: it passes each element in one step and leaves nothing that
// compresses, so viscosity never acts. In compression it does.
BOOST_AUTO_TEST_CASE(a_tensile_front_never_feels_it) {
  for (const double traction : {1.0, -1.0}) {
    Scene without = step_scene(traction);
    without.bars[0].material = material::Elastic{16384, 1};
    Scene with = without;
    with.viscosity = york;
    Stepping s = steps_of(1.0 / 8192, traction > 0 ? 60 : 3);  // in compression Courant number 1 is too much
    s.gains = 1e3;
    const Record a = fem::run(without, 64, s), b = fem::run(with, 64, s);
    if (traction > 0) {
      same_bits(a, b);
      BOOST_TEST(b.ledger.back().viscous == 0.0);
    } else {
      BOOST_TEST(a.snapshots.at(0).stress.value[62] != b.snapshots.at(0).stress.value[62]);
    }
  }
}

BOOST_DATA_TEST_CASE(it_is_told_among_the_features_and_takes_memory_only_where_it_is, bdata::make({0, 1, 2, 3}),
                     method) {
  const Record without = run_bars(method, squeezed({}), 20, steps_of(1e-5, 10)),
               with = run_bars(method, squeezed(common), 20, steps_of(1e-5, 10));
  BOOST_TEST(without.features == std::vector<std::string>{"elastic"}, tt::per_element());
  BOOST_TEST(with.features == (std::vector<std::string>{"elastic", "viscosity"}), tt::per_element());
  const std::size_t points = method == 0 ? 20 : 40;
  BOOST_TEST(with.work.bytes == without.work.bytes + points * sizeof(double));
}

BOOST_DATA_TEST_CASE(of_coefficients_that_give_no_stress_it_is_none, bdata::make({0, 1, 2, 3}), method) {
  Viscosity of_no_bulk = york;
  of_no_bulk.bulk = 0;
  for (const Viscosity& nothing :
       {Viscosity{Viscosity::Form::york, 0, 0}, of_no_bulk, Viscosity{Viscosity::Form::linear_quadratic, 0, 0}}) {
    const Record without = run_bars(method, squeezed({}), 20, steps_of(1e-5, 10)),
                 with = run_bars(method, squeezed(nothing), 20, steps_of(1e-5, 10));
    same_bits(without, with);
    BOOST_TEST(with.features == without.features, tt::per_element());
    BOOST_TEST(with.work.bytes == without.work.bytes);
  }
  Viscosity quadratic_alone = common;
  quadratic_alone.c1 = 0;
  quadratic_alone.c2 = 1;
  BOOST_TEST(material::acting(quadratic_alone) != nullptr);
  BOOST_TEST(material::acting({}) == nullptr);
}

// Work of a pressure on compression: each step adds to it, and the motion has as much less.
BOOST_DATA_TEST_CASE(its_work_is_heat_and_stands_in_the_books, bdata::make({0, 1, 3}), method) {
  for (const Viscosity& v : {york, common}) {
    const Record r = run_bars(method, squeezed(v), 20, steps_of(2e-5, 4000));
    BOOST_REQUIRE((r.outcome == Outcome::completed));
    const double start = r.ledger[0].kinetic + r.ledger[0].strain + r.ledger[0].viscous;
    double before = r.ledger[0].viscous;
    for (const LedgerLine& line : r.ledger) {
      BOOST_TEST_REQUIRE(line.viscous >= before - 1e-4 * start);  // the trapezium may go back where D turns
      BOOST_TEST_REQUIRE(std::abs(line.kinetic + line.strain + line.viscous - start) < 1e-12 * start, line.time);
      BOOST_TEST_REQUIRE(std::abs(line.lost) < 1e-12 * start, line.time);
      before = line.viscous;
    }
    BOOST_TEST(r.ledger.back().viscous > 0.3 * start);
    BOOST_TEST(r.ledger.back().viscous < start);
  }
}

// What it is for: a compressive front without ringing, spread over some cells. 27 % above the step without, after
// theory.
BOOST_DATA_TEST_CASE(a_compressive_front_does_not_ring, bdata::make({0, 3}), method) {
  const auto peak = [&](std::optional<Viscosity> v) {
    Scene scene = step_scene(-1);
    scene.viscosity = v;
    const Record r = run_bars(method, scene, 100, steps_of(0.2 * 1e-4, 250));
    double largest = 0;
    for (const double stress : r.snapshots[0].stress.value) largest = std::max(largest, -stress);
    return largest;
  };
  BOOST_TEST(peak({}) > 1.2);
  BOOST_TEST(peak(Viscosity{Form::linear_quadratic, 0.5, 0}) < 1.01);
  BOOST_TEST(peak(Viscosity{}) < 1.01);
}

BOOST_AUTO_TEST_SUITE_END()
