#include <algorithm>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numeric>

#include "analytic/discrete.hpp"
#include "mpm/bar.hpp"
#include "tests/bar_methods.hpp"
#include "tests/scenes.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(mpm_bar)

using namespace diptych;
using namespace diptych::tests;
using mpm::Scheme;
namespace tt = boost::test_tools;
namespace bdata = boost::unit_test::data;

namespace {

bool all_zero(const Field& f) {
  return std::all_of(f.value.begin(), f.value.end(), [](double v) { return v == 0; });
}

}  // namespace

BOOST_AUTO_TEST_CASE(critical_time_steps_are_the_closed_forms) {
  const Scene scene = step_scene();
  const auto courant = [&](const std::vector<double>& xi, Scheme s) {
    return mpm::critical_time_step(scene, 50, xi, s) * 100 * 50;
  };
  BOOST_TEST(courant({0.5}, Scheme::musl) == 2, tt::tolerance(1e-12));
  BOOST_TEST(courant({0.5}, Scheme::usf) == 2, tt::tolerance(1e-12));
  BOOST_TEST(courant({0.25, 0.75}, Scheme::musl) == std::sqrt(3), tt::tolerance(1e-12));
  BOOST_TEST(courant({0.5}, Scheme::usl) == std::sqrt(0.5), tt::tolerance(1e-12));
  BOOST_TEST(courant({0.25, 0.75}, Scheme::usl) == 1 / std::sqrt(1.75), tt::tolerance(1e-12));
  BOOST_TEST(courant({0.1}, Scheme::usl) == std::sqrt(2 * 0.1 * 0.9), tt::tolerance(1e-12));
  BOOST_TEST(courant({0.0}, Scheme::usl) == 0.0);
  BOOST_TEST(courant({0.0}, Scheme::musl) == 1, tt::tolerance(1e-12));
  Scene moving = scene;
  moving.convected = true;
  BOOST_TEST(mpm::critical_time_step(moving, 50, {0.5}, Scheme::musl) * 5000 == 1, tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(musl_at_courant_two_carries_the_front_two_cells_a_step) {
  const Record r = mpm::run(step_scene(), 20, {0.5}, Scheme::musl, steps_at(2, 20, 4));
  for (std::size_t p = 0; p < 20; ++p) BOOST_TEST(std::abs(r.snapshots[0].stress.value[p] - (p < 12 ? 0 : 1)) < 1e-13);
}

// By hand, one step of each scheme from rest: the end node's acceleration is f/(m/2); its particle takes half of it.
BOOST_DATA_TEST_CASE(first_step_by_hand, bdata::make({0, 1, 2}), which) {
  const Scheme scheme = schemes[static_cast<std::size_t>(which)];
  const double h = 0.1, dt = 0.5 * h / 100;
  const Record r = mpm::run(step_scene(), 10, {0.5}, scheme, steps_at(0.5, 10, 1));
  const auto& s = r.snapshots[0];
  const double kick = scheme == Scheme::usf ? dt : dt / 2, acceleration = 1 / (h / 2);
  BOOST_TEST(s.velocity.value[9] == kick * acceleration / 2, tt::tolerance(1e-13));
  BOOST_TEST(s.displacement.value[9] == dt * kick * acceleration / 2, tt::tolerance(1e-13));
  const double end_velocity = scheme == Scheme::usl ? kick * acceleration : kick * acceleration / 2;
  const double next_velocity = scheme == Scheme::usl ? 0 : kick * acceleration / 4;
  const double stress = scheme == Scheme::usf ? 0 : 1e4 * dt * (end_velocity - next_velocity) / h;
  BOOST_TEST(s.stress.value[9] == stress, tt::tolerance(1e-13));
}

BOOST_DATA_TEST_CASE(no_load_gives_exactly_nothing, bdata::make({0, 1, 2}), which) {
  const Record r =
      mpm::run(step_scene(0), 20, {0.3, 0.8}, schemes[static_cast<std::size_t>(which)], steps_at(0.5, 20, 300));
  BOOST_TEST(all_zero(r.snapshots[0].stress));
  BOOST_TEST(all_zero(r.snapshots[0].velocity));
  BOOST_TEST(all_zero(r.snapshots[0].displacement));
}

// The patch test for any particles, also on nodes: uniform stress in equilibrium with its load stays.
BOOST_DATA_TEST_CASE(uniform_stress_in_equilibrium_stays, bdata::make({0, 1, 2}), which) {
  for (const std::vector<double>& xi : {std::vector{0.5}, {0.2113, 0.7887}, {0.1, 0.2, 0.9}, {0.0, 0.5, 1.0}}) {
    Scene scene = step_scene(3);
    scene.bars[0].initial_stress = [](double) { return 3.0; };
    const Record r = mpm::run(scene, 7, xi, schemes[static_cast<std::size_t>(which)], steps_at(0.3, 7, 1000));
    BOOST_TEST_CONTEXT(xi.size() << " particles") {
      for (const double sigma : r.snapshots[0].stress.value) BOOST_TEST(sigma == 3.0, tt::tolerance(1e-12));
    }
  }
}

BOOST_DATA_TEST_CASE(body_force_accelerates_a_free_bar_rigidly, bdata::make({0, 1, 2}), which) {
  Scene scene;
  scene.bars[0].length = 1;
  scene.bars[0].material = material::Elastic{1e4, 2};
  scene.body_force = [](double, double) { return 5.0; };
  const Record r = mpm::run(scene, 10, {0.3, 0.6}, schemes[static_cast<std::size_t>(which)], steps_at(0.5, 10, 100));
  const auto& s = r.snapshots[0];
  for (const double v : s.velocity.value) BOOST_TEST(v == 5 * s.velocity.time, tt::tolerance(1e-11));
  // the first half-step of USF's displacement is taken with v⁰ = 0, so it stands b Δt²/8 below ½ b t²
  const double dt = 0.5 * 0.1 / 100, short_of = which == 0 ? 5 * dt * dt / 8 : 0;
  for (const double u : s.displacement.value) {
    BOOST_TEST(u == 2.5 * s.displacement.time * s.displacement.time - short_of, tt::tolerance(1e-9));
  }
}

// Rigid flight over many cells with particles on faces: no stress, no change of velocity, whatever the scheme.
BOOST_DATA_TEST_CASE(rigid_flight_with_particles_on_faces, bdata::make({0, 2}), which) {
  Scene scene;
  scene.bars[0].length = 1;
  scene.bars[0].material = material::Elastic{1e4, 1};
  scene.convected = true;
  scene.bars[0].initial_velocity = [](double) { return 16.0; };  // 0.08 of a cell each step: lands on faces
  for (const std::vector<double>& xi : {std::vector{0.0}, {1.0}, {0.0, 0.5}, {0.5, 1.0}}) {
    const Record r = mpm::run(scene, 10, xi, schemes[static_cast<std::size_t>(which)], steps_at(0.5, 10, 100));
    BOOST_TEST_CONTEXT(r.message) { BOOST_REQUIRE((r.outcome == Outcome::completed)); }
    for (const double v : r.snapshots[0].velocity.value) BOOST_TEST(v == 16.0, tt::tolerance(1e-12));
    for (const double sigma : r.snapshots[0].stress.value) BOOST_TEST(std::abs(sigma) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(a_bar_that_flies_off_the_grid_is_told) {
  Scene scene;
  scene.bars[0].length = 1;
  scene.bars[0].material = material::Elastic{1e4, 1};
  scene.convected = true;
  scene.bars[0].initial_velocity = [](double) { return 50.0; };
  const Record r = mpm::run(scene, 10, {0.5}, Scheme::musl, steps_at(0.5, 10, 1000));
  BOOST_TEST((r.outcome == Outcome::left_grid));
  BOOST_TEST(holds(r.message, "left the grid"));
}

// A bar pressed against a wall for long: particles approach the wall's node and never stop the run. Viscosity keeps
// down the noise of crossing cells, which would blow it up.
BOOST_AUTO_TEST_CASE(particles_against_a_wall_never_stop_the_run) {
  Scene scene = step_scene(-500);  // a twentieth of the modulus, compression
  scene.convected = true;
  scene.viscosity = material::Viscosity{};
  for (const std::vector<double>& xi : {std::vector{0.0}, {0.0, 0.5}, {0.1}}) {
    const Record r = mpm::run(scene, 20, xi, Scheme::musl, steps_at(0.4, 20, 2000));
    BOOST_TEST_CONTEXT(r.message) { BOOST_REQUIRE((r.outcome == Outcome::completed)); }
    BOOST_TEST(r.snapshots[0].displacement.value.back() < 0);
    for (const double u : r.snapshots[0].displacement.value)
      BOOST_TEST(u > -0.15);  // twice the equilibrium of 0.05, and what rings
  }
}

// Mass and length follow the particles: a bar stretched over twice as many cells holds the same mass and stress
// balance.
BOOST_AUTO_TEST_CASE(momentum_is_conserved_while_particles_cross_cells) {
  Scene scene;
  scene.bars[0].length = 1;
  scene.bars[0].material = material::Elastic{1e4, 1};
  scene.convected = true;
  scene.bars[0].initial_velocity = [](double x) { return 10 * x; };
  const Record r = mpm::run(scene, 20, {0.25, 0.75}, Scheme::musl, steps_at(0.4, 20, 500));
  BOOST_REQUIRE((r.outcome == Outcome::completed));
  const double start = r.ledger.front().momentum;
  for (const LedgerLine& line : r.ledger) BOOST_REQUIRE(std::abs(line.momentum - start) < 1e-12 * start);
}

BOOST_AUTO_TEST_CASE(features_that_are_off_leave_the_bits_alone_and_take_no_memory) {
  const Scene plain = step_scene();
  Scene with_null_force = plain;
  with_null_force.body_force = [](double, double) { return 0.0; };
  Scene never_yields = plain;
  never_yields.bars[0].material = material::Hardening{1e4, 1, 2500, 1e300};
  Scene moving = plain;
  moving.convected = true;
  const auto go = [](const Scene& s) { return mpm::run(s, 50, {0.25, 0.75}, Scheme::musl, steps_at(0.7, 50, 300)); };
  const Record a = go(plain), b = go(with_null_force), c = go(never_yields), d = go(moving);
  BOOST_TEST(a.snapshots[0].stress.value == b.snapshots[0].stress.value, tt::per_element());
  BOOST_TEST(a.snapshots[0].stress.value == c.snapshots[0].stress.value, tt::per_element());
  BOOST_TEST(a.work.bytes < b.work.bytes);
  BOOST_TEST(a.work.bytes < c.work.bytes);
  BOOST_TEST(a.work.bytes < d.work.bytes);
  BOOST_TEST(a.features == std::vector<std::string>{"elastic"}, tt::per_element());
  BOOST_TEST(d.features == (std::vector<std::string>{"convection", "elastic"}), tt::per_element());
}

// Eq. 16: the layer's particles together bring in the whole traction, split by their shape functions.
BOOST_AUTO_TEST_CASE(boundary_layer_brings_in_the_whole_traction) {
  for (const double cells : {0.5, 1.0, 2.0, 2.5}) {
    Scene scene = step_scene();
    scene.loads[0].transfer = Transfer::boundary_layer;
    scene.loads[0].layer_thickness = cells * 0.1;
    const Record r = mpm::run(scene, 10, {0.25, 0.75}, Scheme::musl, steps_at(0.5, 10, 1));
    BOOST_TEST(r.ledger[0].momentum == 0.5 * 0.1 * 0.5 / 100, tt::tolerance(1e-12));  // f Δt/2
    BOOST_TEST(r.features == (std::vector<std::string>{"boundary-layer", "elastic"}), tt::per_element());
  }
}

// Central differences in disguise: particles on the nodes' side of nothing, ξ → 0 recovers FEM's magic step at
// Courant 1.
BOOST_AUTO_TEST_CASE(one_particle_body_and_one_cell_run) {
  const Record r = mpm::run(step_scene(), 1, {0.5}, Scheme::musl, steps_at(0.5, 1, 10));
  BOOST_TEST((r.outcome == Outcome::completed));
  BOOST_TEST(std::isfinite(r.snapshots[0].stress.value[0]));
}

BOOST_AUTO_TEST_CASE(usl_loses_energy_and_the_others_do_not) {
  Scene scene = step_scene(0);
  scene.loads.clear();
  scene.bars[0].initial_velocity = [](double x) { return std::sin(7.853981633974483 * x); };
  const auto taken = [&](Scheme s) {
    const Record r = mpm::run(scene, 50, {0.5}, s, steps_at(0.5, 50, 400));
    const LedgerLine &first = r.ledger.front(), &last = r.ledger.back();
    BOOST_TEST(std::abs(last.lost) < 1e-13 * first.kinetic);
    const double gone = first.kinetic + first.strain - last.kinetic - last.strain;
    BOOST_TEST(std::abs(gone - last.scheme) < 1e-13 * first.kinetic);
    return last.scheme / first.kinetic;
  };
  BOOST_TEST(taken(Scheme::usf) == 0.0);
  BOOST_TEST(taken(Scheme::musl) == 0.0);
  BOOST_TEST(taken(Scheme::usl) > 1e-4);
}

// The two derivations of the limits, here and in analytic/, agree for any positions.
BOOST_AUTO_TEST_CASE(critical_time_steps_are_those_of_theory_for_any_positions) {
  using analytic::Discretisation;
  for (const std::vector<double>& xi : {std::vector{0.5},
                                        {0.3},
                                        {0.05},
                                        {0.25, 0.75},
                                        {0.1, 0.2},
                                        {0.0, 1.0},
                                        {0.05, 0.95},
                                        {0.1, 0.5, 0.6},
                                        {0.02, 0.1, 0.98},
                                        {0.125, 0.375, 0.625, 0.875}}) {
    for (const auto& [scheme, theirs] : {std::pair(Scheme::usf, analytic::Scheme::mpm_usf),
                                         {Scheme::usl, analytic::Scheme::mpm_usl},
                                         {Scheme::musl, analytic::Scheme::mpm_musl}}) {
      const double courant = mpm::critical_time_step(step_scene(), 50, xi, scheme) * 100 * 50;
      BOOST_TEST(courant == analytic::stability_limit(Discretisation{theirs, 0.02, 1, xi}), tt::tolerance(1e-12));
    }
  }
}

// A bar almost without stiffness, pulled apart by its own velocity v = Vx: x = X(1 + Vt), strain of the reference
// configuration Vt, as in FEM, and the wall takes the impulse ∫σ dt = E V t²/2. Strain of the present configuration
// would be ln(1 + Vt), 19 % less here, and particles that kept their length would press on the wall with σ/(1 + Vt).
BOOST_DATA_TEST_CASE(a_bar_that_is_pulled_apart_moves_stretches_and_thins, bdata::make({0, 1, 2}), which) {
  Scene scene;
  scene.bars[0].length = 1;
  scene.bars[0].material = material::Elastic{1e-6, 1};
  scene.left = Support::fixed;
  scene.convected = true;
  scene.bars[0].initial_velocity = [](double x) { return x; };
  Stepping stepping;
  stepping.books = Books::lines;
  stepping.time_step = 0.002;
  stepping.steps = 250;
  stepping.sample_after = {250};
  const Record r =
      mpm::run(scene, 20, {0.125, 0.375, 0.625, 0.875}, schemes[static_cast<std::size_t>(which)], stepping);
  BOOST_TEST_CONTEXT(r.message) { BOOST_REQUIRE((r.outcome == Outcome::completed)); }
  const auto& stress = r.snapshots[0].stress;
  const double mean =
      std::accumulate(stress.value.begin(), stress.value.end(), 0.0) / static_cast<double>(stress.value.size());
  BOOST_TEST(mean == 1e-6 * stress.time, tt::tolerance(0.02));
  const LedgerLine &first = r.ledger.front(), &last = r.ledger.back();
  const auto impulse = [](double t) { return t * t / 2; };
  BOOST_TEST(first.momentum - last.momentum == 1e-6 * (impulse(last.time) - impulse(first.time)), tt::tolerance(0.05));
  BOOST_TEST(std::abs(last.momentum - last.impulse) < 1e-14);
}

// A body force is a field in space: the bar meets it where it is and not where it started.
BOOST_AUTO_TEST_CASE(body_force_acts_where_the_particle_is) {
  Scene scene;
  scene.bars[0].length = 1;
  scene.bars[0].material = material::Elastic{1e-6, 1};
  scene.convected = true;
  scene.bars[0].initial_velocity = [](double) { return 1.0; };
  scene.body_force = [](double x, double) { return x > 1.25 ? 1e-3 : 0.0; };
  Stepping stepping;
  stepping.books = Books::lines;
  stepping.time_step = 0.005;
  stepping.steps = 100;
  const Record r = mpm::run(scene, 20, {0.25, 0.75}, Scheme::musl, stepping);
  // x > 1.25 holds a part t − 0.25 of the bar from t = 0.25 on
  BOOST_TEST(r.ledger.back().momentum - 1 == 1e-3 * 0.25 * 0.25 / 2, tt::tolerance(0.1));
  BOOST_TEST(r.ledger[40].momentum == 1.0, tt::tolerance(1e-12));
}

// Tractions stay with the ends of a bar that flies: a step that begins after it crossed some cells sends in its wave.
BOOST_DATA_TEST_CASE(tractions_follow_the_ends, bdata::make({false, true}), in_layer) {
  Scene scene;
  scene.bars[0].length = 1;
  scene.bars[0].material = material::Elastic{1e4, 1};
  scene.convected = true;
  scene.bars[0].initial_velocity = [](double) { return 10.0; };
  for (const End end : {End::left, End::right}) {
    Load load;
    load.end = end;
    if (in_layer) load.transfer = Transfer::boundary_layer;
    load.layer_thickness = 0.025;
    load.mean_traction = [](double from, double) { return from >= 0.003 ? 1.0 : 0.0; };  // more than a cell on
    scene.loads.push_back(load);
  }
  Stepping stepping = steps_at(0.25, 40, 71);  // to t = 0.0044: the waves are 0.14 into the bar
  stepping.sample_after = {71};
  const Record r = mpm::run(scene, 40, {0.25, 0.75}, Scheme::musl, stepping);
  BOOST_TEST_CONTEXT(r.message) { BOOST_REQUIRE((r.outcome == Outcome::completed)); }
  const auto& stress = r.snapshots[0].stress.value;
  const auto mean = [&](std::size_t from, std::size_t to) {
    return std::accumulate(stress.begin() + static_cast<long>(from), stress.begin() + static_cast<long>(to), 0.0) /
           static_cast<double>(to - from);
  };
  BOOST_TEST(mean(0, 40) == 0.28, tt::tolerance(0.2));  // 0.14 of the bar is half of half of it
  BOOST_TEST(mean(40, 80) == 0.28, tt::tolerance(0.2));
  BOOST_TEST(std::abs(mean(36, 44)) < 0.05);
}

BOOST_AUTO_TEST_CASE(particles_that_pass_one_another_are_told) {
  Scene scene;
  scene.bars[0].length = 1;
  scene.bars[0].material = material::Elastic{1e-6, 1};
  scene.convected = true;
  scene.bars[0].initial_velocity = [](double x) { return x < 0.5 ? 1.0 : -1.0; };
  Stepping stepping;
  stepping.books = Books::lines;
  stepping.time_step = 0.3;  // neighbours that close in by more than their distance in one step
  stepping.steps = 1;
  const Record r = mpm::run(scene, 10, {0.5}, Scheme::usf, stepping);
  BOOST_TEST((r.outcome == Outcome::left_grid));
  BOOST_TEST(holds(r.message, "passed one another"), r.message);
}

// Eq. 16 at the left end is the mirror image of eq. 16 at the right one, also where a particle fills the layer in part.
BOOST_AUTO_TEST_CASE(boundary_layer_is_the_same_at_either_end) {
  for (const double cells : {0.3, 1.0, 1.75, 2.5}) {
    Scene right = step_scene();
    right.loads[0].transfer = Transfer::boundary_layer;
    right.loads[0].layer_thickness = cells * 0.1;
    Scene left = right;
    left.loads[0].end = End::left;
    std::swap(left.left, left.right);
    const Record a = mpm::run(right, 10, {0.2, 0.9}, Scheme::musl, steps_at(0.3, 10, 20));
    const Record b = mpm::run(left, 10, {1 - 0.9, 1 - 0.2}, Scheme::musl, steps_at(0.3, 10, 20));
    const auto &x = a.snapshots[0].stress.value, &y = b.snapshots[0].stress.value;
    for (std::size_t p = 0; p < 20; ++p) BOOST_TEST(std::abs(x[p] - y[19 - p]) < 1e-12);
    BOOST_TEST(std::abs(b.ledger.back().momentum - b.ledger.back().impulse) < 1e-14);
  }
}

// One step by hand: a layer of three quarters of a cell takes in all of the outer of two particles and half of the
// inner.
BOOST_AUTO_TEST_CASE(boundary_layer_that_ends_within_a_particle_by_hand) {
  Scene scene = step_scene();
  scene.loads[0].transfer = Transfer::boundary_layer;
  scene.loads[0].layer_thickness = 0.075;
  const double h = 0.1, dt = 0.3 * h / 100;
  const Record r = mpm::run(scene, 10, {0.25, 0.75}, Scheme::musl, steps_at(0.3, 10, 1));
  const double end = (2.0 / 3 * 0.75 + 1.0 / 3 * 0.25) / (h / 2), inner = (2.0 / 3 * 0.25 + 1.0 / 3 * 0.75) / h;
  BOOST_TEST(r.snapshots[0].velocity.value[19] == dt / 2 * (0.75 * end + 0.25 * inner), tt::tolerance(1e-12));
  BOOST_TEST(r.snapshots[0].velocity.value[18] == dt / 2 * (0.25 * end + 0.75 * inner), tt::tolerance(1e-12));
}

BOOST_DATA_TEST_CASE(the_books_close_with_plasticity, bdata::make({0, 2}), which) {
  Scene scene = step_scene(100);
  scene.bars[0].material = material::Hardening{1e4, 1, 2500, 75};
  const Record r =
      mpm::run(scene, 100, {0.25, 0.75}, schemes[static_cast<std::size_t>(which)], steps_at(0.9, 100, 400));
  BOOST_TEST(r.features == std::vector<std::string>{"plasticity"}, tt::per_element());
  const LedgerLine& last = r.ledger.back();
  BOOST_TEST(last.dissipated > 0.1 * last.work);
  BOOST_TEST(last.scheme != 0.0);
  BOOST_TEST(std::abs(last.scheme) < 0.01 * last.work);
  for (const LedgerLine& line : r.ledger) BOOST_TEST_REQUIRE(std::abs(line.lost) < 1e-12 * last.work);
  BOOST_TEST(std::abs(last.momentum - last.impulse) < 1e-12);
}

// The books' lines stand at the times of their velocities, and the work counts what was done.
BOOST_DATA_TEST_CASE(ledger_times_and_work, bdata::make({0, 1, 2}), which) {
  const Record r =
      mpm::run(step_scene(), 10, {0.25, 0.75}, schemes[static_cast<std::size_t>(which)], steps_at(0.5, 10, 8));
  const double dt = 0.0005;
  BOOST_TEST(r.ledger[0].time == (which == 0 ? 1.0 : 0.5) * dt, tt::tolerance(1e-12));
  BOOST_TEST(r.ledger[3].time == r.ledger[0].time + 3 * dt, tt::tolerance(1e-12));
  BOOST_TEST(r.work.particle_steps == 160);
  BOOST_TEST(r.work.node_steps == 88);
  BOOST_TEST(r.work.element_steps == 0);
}

// Three particles anywhere in a cell: each one's stress holds for its third of the cell.
BOOST_AUTO_TEST_CASE(stress_is_given_over_each_particles_share) {
  const Record r = mpm::run(step_scene(), 10, {0.1, 0.5, 0.6}, Scheme::musl, steps_at(0.3, 10, 2));
  const auto& stress = r.snapshots[0].stress;
  BOOST_REQUIRE(stress.edges.size() == 31U);
  for (std::size_t i = 0; i < 31; ++i) BOOST_TEST(std::abs(stress.edges[i] - static_cast<double>(i) / 30) < 1e-14);
  BOOST_TEST(stress.x[4] == 0.15, tt::tolerance(1e-14));
}

BOOST_AUTO_TEST_SUITE_END()
