#include <algorithm>
#include <atomic>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "fem/bar.hpp"
#include "hinge/step/ledger.hpp"
#include "tests/scenes.hpp"

BOOST_AUTO_TEST_SUITE(fem_bar)

using namespace diptych;
using namespace diptych::tests;
namespace tt = boost::test_tools;

BOOST_AUTO_TEST_CASE(critical_time_step_is_cell_over_wave_speed) {
  BOOST_TEST(fem::critical_time_step(step_scene(), 50) == 0.02 / 100, tt::tolerance(1e-15));
}

// At Courant 1 the front stands on a node after every step.
BOOST_AUTO_TEST_CASE(magic_step_carries_the_front_from_node_to_node) {
  const Record r = fem::run(step_scene(), 10, steps_at(1, 10, 4));
  BOOST_REQUIRE(r.snapshots.size() == 1U);
  const auto& s = r.snapshots[0];
  for (std::size_t e = 0; e < 10; ++e) BOOST_TEST(std::abs(s.stress.value[e] - (e < 6 ? 0 : 1)) < 1e-13);
  // u = (f/E)(ct − (L − x)) behind the front, v = f/(ρc) half a step before
  BOOST_TEST(s.displacement.value[10] == 0.4e-4, tt::tolerance(1e-12));
  BOOST_TEST(s.displacement.value[8] == 0.2e-4, tt::tolerance(1e-12));
  BOOST_TEST(s.velocity.value[10] == 0.01, tt::tolerance(1e-12));
  BOOST_TEST(s.velocity.time == 3.5 * 0.001, tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(one_element_between_supports_and_free) {
  const Record r = fem::run(step_scene(), 1, steps_at(0.5, 1, 1));
  // first kick: v = (dt/2) f/(ρh/2), stress = E v dt/h
  BOOST_TEST(r.snapshots[0].stress.value[0] == 1e4 * (0.005 / 2 * 1 / 0.5) * 0.005, tt::tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(no_load_gives_exactly_nothing) {
  Scene scene = step_scene(0);
  const Record r = fem::run(scene, 20, steps_at(0.9, 20, 500));
  for (const Field* f : {&r.snapshots[0].stress, &r.snapshots[0].velocity, &r.snapshots[0].displacement}) {
    BOOST_TEST(std::all_of(f->value.begin(), f->value.end(), [](double v) { return v == 0; }));
  }
  BOOST_TEST((r.outcome == Outcome::completed));
}

// A bar in equilibrium with its load stays there: the patch test of one dimension.
BOOST_AUTO_TEST_CASE(uniform_stress_in_equilibrium_stays) {
  Scene scene = step_scene(3);
  scene.bars[0].initial_stress = [](double) { return 3.0; };
  const Record r = fem::run(scene, 7, steps_at(0.9, 7, 1000));
  for (const double sigma : r.snapshots[0].stress.value) BOOST_TEST(sigma == 3.0);
  for (const double v : r.snapshots[0].velocity.value) BOOST_TEST(v == 0.0);
}

// Free bar under a uniform body force: rigid acceleration, v = b t at the half-step and u = b t²/2 exactly.
BOOST_AUTO_TEST_CASE(body_force_accelerates_a_free_bar_rigidly) {
  Scene scene;
  scene.bars[0].length = 1;
  scene.bars[0].material = material::Elastic{1e4, 2};
  scene.body_force = [](double, double) { return 5.0; };
  const Record r = fem::run(scene, 10, steps_at(0.9, 10, 100));
  const auto& s = r.snapshots[0];
  for (const double v : s.velocity.value) BOOST_TEST(v == 5 * s.velocity.time, tt::tolerance(1e-12));
  for (const double u : s.displacement.value) {
    BOOST_TEST(u == 2.5 * s.displacement.time * s.displacement.time, tt::tolerance(1e-12));
  }
  BOOST_TEST(r.features == (std::vector<std::string>{"body-force", "elastic"}), tt::per_element());
}

// What a scene does not list costs nothing and leaves the bits alone.
BOOST_AUTO_TEST_CASE(features_that_are_off_leave_the_bits_alone) {
  const Scene plain = step_scene();
  Scene with_null_force = plain;
  with_null_force.body_force = [](double, double) { return 0.0; };
  Scene never_yields = plain;
  never_yields.bars[0].material = material::Hardening{1e4, 1, 2500, 1e300};
  Stepping without_ledger = steps_at(0.7, 50, 300);
  without_ledger.books = Books::off;
  const Record a = fem::run(plain, 50, steps_at(0.7, 50, 300));
  const Record b = fem::run(with_null_force, 50, steps_at(0.7, 50, 300));
  const Record c = fem::run(never_yields, 50, steps_at(0.7, 50, 300));
  const Record d = fem::run(plain, 50, without_ledger);
  BOOST_TEST(a.snapshots[0].stress.value == b.snapshots[0].stress.value, tt::per_element());
  BOOST_TEST(a.snapshots[0].stress.value == c.snapshots[0].stress.value, tt::per_element());
  BOOST_TEST(a.snapshots[0].stress.value == d.snapshots[0].stress.value, tt::per_element());
  BOOST_TEST(d.ledger.empty());
  BOOST_TEST(a.ledger.size() == 300U);
  BOOST_TEST(a.work.bytes < b.work.bytes);
  BOOST_TEST(a.work.bytes < c.work.bytes);
}

BOOST_AUTO_TEST_CASE(an_unstable_run_is_detected_and_stopped) {
  const Record r = fem::run(step_scene(), 100, steps_at(1.01, 100, 5000));
  BOOST_TEST((r.outcome == Outcome::unstable));
  BOOST_TEST(r.steps < 2000);
  BOOST_TEST(!r.message.empty());
}

BOOST_AUTO_TEST_CASE(without_a_ledger_a_value_that_is_not_finite_is_detected_where_sampled) {
  Stepping stepping = steps_at(3, 20, 2000);
  stepping.books = Books::off;
  BOOST_TEST((fem::run(step_scene(), 20, stepping).outcome == Outcome::unstable));
}

BOOST_AUTO_TEST_CASE(a_request_to_stop_is_heard) {
  std::atomic<bool> cancelled{true};
  Stepping stepping = steps_at(0.5, 10, 100);
  stepping.cancelled = &cancelled;
  const Record r = fem::run(step_scene(), 10, stepping);
  BOOST_TEST((r.outcome == Outcome::cancelled));
  BOOST_TEST(r.steps == 0);
  BOOST_TEST(r.snapshots.empty());
}

BOOST_AUTO_TEST_CASE(what_the_method_has_not_is_refused) {
  Scene layer = step_scene();
  layer.loads[0].transfer = Transfer::boundary_layer;
  BOOST_CHECK_THROW(fem::run(layer, 10, steps_at(0.5, 10, 1)), std::invalid_argument);
}

// The mesh goes with the bar, whose strains are those of the reference configuration: to FEM a moving scene is no
// other.
BOOST_AUTO_TEST_CASE(a_moving_scene_has_the_bits_of_a_still_one) {
  Scene still = step_scene(50), moving = still;
  moving.convected = true;
  const Record a = fem::run(still, 30, steps_at(0.7, 30, 300)), b = fem::run(moving, 30, steps_at(0.7, 30, 300));
  BOOST_TEST(a.snapshots[0].stress.value == b.snapshots[0].stress.value, tt::per_element());
  BOOST_TEST(a.snapshots[0].displacement.value == b.snapshots[0].displacement.value, tt::per_element());
  BOOST_TEST(b.features == std::vector<std::string>{"elastic"}, tt::per_element());
}

BOOST_AUTO_TEST_CASE(a_free_bar_flies_any_distance) {
  Scene scene;
  scene.bars[0].begin = -7;
  scene.bars[0].length = 1;
  scene.bars[0].material = material::Elastic{1e4, 1};
  scene.bars[0].initial_velocity = [](double) { return 16.0; };
  scene.convected = true;
  const Record r = fem::run(scene, 10, steps_at(0.9, 10, 10000));
  const Snapshot& s = r.snapshots.at(0);
  for (const double sigma : s.stress.value) BOOST_TEST(sigma == 0.0);
  for (const double u : s.displacement.value) BOOST_TEST(u == 16 * s.displacement.time, tt::tolerance(1e-11));
  BOOST_TEST(s.displacement.x.front() == -7.0);
  BOOST_TEST(s.displacement.x.back() == -6.0);
}

// Plastic bar: held energy, heat and what the scheme takes add up to the work at every step.
BOOST_AUTO_TEST_CASE(the_books_close_with_plasticity) {
  Scene scene = step_scene(100);
  scene.bars[0].material = material::Hardening{1e4, 1, 2500, 75};
  const Record r = fem::run(scene, 100, steps_at(0.9, 100, 400));
  BOOST_REQUIRE(r.ledger.size() == 400U);
  const LedgerLine& last = r.ledger.back();
  BOOST_TEST(last.dissipated > 0);
  BOOST_TEST(r.features == std::vector<std::string>{"plasticity"}, tt::per_element());
  const LedgerLine& first = r.ledger.front();
  const double opening = first.kinetic + first.strain - first.work;  // of a start without energy of the leapfrog's own
  for (const LedgerLine& line : r.ledger) {
    const double sum = line.kinetic + line.strain + line.dissipated + line.scheme - line.work;
    BOOST_TEST_REQUIRE(std::abs(sum - opening) < 1e-12 * last.work);
    BOOST_TEST_REQUIRE(std::abs(line.lost) < 1e-12 * last.work);
  }
  BOOST_TEST(last.scheme != 0.0);
  BOOST_TEST(std::abs(last.scheme) < 0.01 * last.work);  // the trapezium over a step that yields half-way
  BOOST_TEST(std::abs(last.momentum - last.impulse) < 1e-12);
}

BOOST_AUTO_TEST_CASE(ledger_times_and_work) {
  const Record r = fem::run(step_scene(), 10, steps_at(0.5, 10, 8));
  BOOST_TEST(r.ledger[0].time == 0.5 * 0.0005, tt::tolerance(1e-12));
  BOOST_TEST(r.ledger[3].time == 3.5 * 0.0005, tt::tolerance(1e-12));
  BOOST_TEST(r.work.element_steps == 80);
  BOOST_TEST(r.work.node_steps == 88);
  BOOST_TEST(r.work.particle_steps == 0);
}

// A velocity given at a support is none from the start, in the motion and in the books.
BOOST_AUTO_TEST_CASE(a_support_holds_its_node_from_the_start) {
  Scene scene = step_scene(0);
  scene.loads.clear();
  scene.bars[0].initial_velocity = [](double) { return 1.0; };
  const Record r = fem::run(scene, 10, steps_at(0.5, 10, 20));
  for (const LedgerLine& line : r.ledger) BOOST_TEST(std::abs(line.momentum - line.impulse) < 1e-14);
}

BOOST_AUTO_TEST_CASE(two_loads_on_one_end_add_up) {
  Scene twice = step_scene(1);
  twice.loads.push_back(twice.loads[0]);
  const Record a = fem::run(twice, 10, steps_at(0.5, 10, 20)), b = fem::run(step_scene(2), 10, steps_at(0.5, 10, 20));
  BOOST_TEST(a.snapshots[0].stress.value == b.snapshots[0].stress.value, tt::per_element());
}

// A run without samples, as in a bisection, has only the ledger to tell it.
BOOST_AUTO_TEST_CASE(a_ledger_that_holds_nan_is_unstable) {
  for (const bool strain : {false, true}) {
    Ledger ledger(Books::sums, 1, 0.5, 1, 0, 0);
    ledger.close_line(strain ? 1 : std::nan(""), strain ? std::nan("") : 1, 0, 0);
    BOOST_TEST(ledger.unstable());
  }
}

BOOST_AUTO_TEST_SUITE_END()
