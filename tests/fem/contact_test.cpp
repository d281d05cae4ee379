// Bars that meet. FEM: a pair of end nodes by hand, then whole bars at Courant number 1, where every element carries
// the exact state. MPM: what the grid makes of two bars.
#include "fem/contact.hpp"

#include <algorithm>
#include <array>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>
#include <utility>

#include "analytic/grid_contact.hpp"
#include "fem/bar.hpp"
#include "mpm/bar.hpp"
#include "tests/bar_methods.hpp"
#include "tests/messages.hpp"
#include "tests/scenes.hpp"
#include "tests/steps.hpp"

BOOST_AUTO_TEST_SUITE(contact)

using namespace diptych;
using namespace diptych::tests;
using fem::Face;
using fem::Pair;
namespace tt = boost::test_tools;
namespace bdata = boost::unit_test::data;

namespace {

const double infinite = std::numeric_limits<double>::infinity();
/// A bar of the paper's material, c = 100, ρc = 100.
Bar flying(double begin, double length, double velocity, material::Material m = material::Elastic{1e4, 1}) {
  Bar bar;
  bar.begin = begin;
  bar.length = length;
  bar.material = m;
  bar.initial_velocity = [velocity](double) { return velocity; };
  return bar;
}

Scene row(std::vector<Bar> bars) {
  Scene scene;
  scene.bars = std::move(bars);
  return scene;
}

/// Two bars of half a length that close in at ±1.
Scene closing(double gap) { return row({flying(0, 0.5, 1), flying(0.5 + gap, 0.5, -1)}); }

Load pull(End end, double traction) {
  Load load;
  load.end = end;
  load.mean_traction = [traction](double, double) { return traction; };
  return load;
}

void all_near(const std::vector<double>& values, double expected, double tolerance) {
  for (const double v : values) BOOST_TEST_REQUIRE(std::abs(v - expected) <= tolerance, v << " is not " << expected);
}

void momentum_is_kept(const Record& r, double scale) {
  BOOST_REQUIRE(!r.ledger.empty());
  for (const LedgerLine& line : r.ledger) {
    BOOST_TEST_REQUIRE(std::abs(line.momentum - r.ledger.front().momentum) <= 1e-12 * scale, line.time);
    BOOST_TEST_REQUIRE(std::abs(line.momentum - line.impulse) <= 1e-12 * scale, line.time);
  }
}

/// After contact of equal bars at ±1.
void velocities_are_exchanged(const Record& r) {
  const Snapshot& s = r.snapshots.back();
  all_near(s.velocity.of_bar(0).value, -1, 1e-12);
  all_near(s.velocity.of_bar(1).value, 1, 1e-12);
  all_near(s.stress.value, 0, 1e-10);  // 1e-12 of ρcv
}

/// Two unlike bars that meet, and the same seen from behind.
Scene unlike_bars(bool mirror) {
  const auto soft = material::Elastic{1e4, 1};
  const auto hard = material::Hardening{3e4, 2, 2500, 90};
  return mirror ? row({flying(-1.3125, 0.75, 2, hard), flying(-0.5, 0.5, -3, soft)})
                : row({flying(0, 0.5, 3, soft), flying(0.5625, 0.75, -2, hard)});
}

void has_mirrored_bits(const Record& a, const Record& b) {
  for (std::size_t s = 0; s < 3; ++s) {
    std::vector<double> stress = b.snapshots[s].stress.value, velocity = b.snapshots[s].velocity.value;
    std::reverse(stress.begin(), stress.end());
    std::reverse(velocity.begin(), velocity.end());
    for (double& v : velocity) v = -v;
    BOOST_TEST(a.snapshots[s].stress.value == stress, tt::per_element());
    BOOST_TEST(a.snapshots[s].velocity.value == velocity, tt::per_element());
  }
}

/// The face after a kick and a step.
Face moved(Face f, double force, double kick, double step) {
  f.velocity += kick * (f.force + force) / f.mass;
  f.displacement += step * f.velocity;
  return f;
}

}  // namespace

// --- a pair of end nodes
// ------------------------------------------------------------------------------------------------

// Masses 2 and 3 at 5 and −1: they go on together at (10 − 3)/5 = 1.4, after an impulse of 2 · 3.6 = 7.2.
BOOST_AUTO_TEST_CASE(impact_of_two_end_masses_is_perfectly_plastic) {
  Pair pair(0, 0, Contact::node_to_node);
  const Face a{2, 0, 5, 0}, b{3, 0, -1, 0};
  const double force = pair.force(a, b, 0.5, 0.25);
  BOOST_TEST(force == 7.2 / 0.5, tt::tolerance(1e-14));
  BOOST_TEST(pair.force() == force);
  BOOST_TEST((pair.closed() && !pair.opened()));
  BOOST_TEST(pair.share_of_step() == 0.0);
  const Face after_a = moved(a, -force, 0.5, 0.25), after_b = moved(b, force, 0.5, 0.25);
  BOOST_TEST(after_a.velocity == 1.4, tt::tolerance(1e-14));
  BOOST_TEST(after_b.velocity == 1.4, tt::tolerance(1e-14));
  BOOST_TEST(after_a.displacement == after_b.displacement, tt::tolerance(1e-14));
}

// They close in by 6 · 0.25 = 1.5 a step. A gap of 0.3 is gone after a fifth of it; the force leaves them just enough
// approach, 1.2, to use it up: 2 · 3/(2 + 3) (6 − 1.2)/0.5.
BOOST_AUTO_TEST_CASE(a_gap_is_closed_at_the_end_of_the_step_and_no_further) {
  Pair pair(7, 0.3, Contact::node_to_node);
  const Face a{2, 0, 5, 10}, b{3, 0, -1, 10};
  const double force = pair.force(a, b, 0.5, 0.25);
  BOOST_TEST(force == 1.2 * 4.8 / 0.5, tt::tolerance(1e-13));
  BOOST_TEST(pair.left() == 7U);
  BOOST_TEST(pair.closed());
  BOOST_TEST(pair.share_of_step() == 0.2, tt::tolerance(1e-13));
  const Face after_a = moved(a, -force, 0.5, 0.25), after_b = moved(b, force, 0.5, 0.25);
  BOOST_TEST(std::abs(0.3 + after_b.displacement - after_a.displacement) < 1e-14);
  // what is left of the approach is stopped in the next kick
  const double second = pair.force(after_a, after_b, 0.5, 0.25);
  BOOST_TEST(!pair.closed());
  BOOST_TEST(moved(after_a, -second, 0.5, 0.25).velocity == 1.4, tt::tolerance(1e-13));
  BOOST_TEST(moved(after_b, second, 0.5, 0.25).velocity == 1.4, tt::tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(faces_that_do_not_reach_each_other_feel_exactly_nothing) {
  Pair pair(0, 0.3, Contact::node_to_node);
  BOOST_TEST(pair.force({2, 0, 1, 0}, {3, 0, 0, 0}, 0.5, 0.25) == 0.0);     // 0.25 of 0.3
  BOOST_TEST(pair.force({2, 0, -1, 0}, {3, 0, 1, 0}, 0.5, 0.25) == 0.0);    // apart
  BOOST_TEST(pair.force({2, -8, 1, 0}, {3, 0, 0, 0}, 0.5, 0.25) == 0.0);    // pulled back
  BOOST_TEST(pair.force({2, 0, 0, 0.05}, {3, 0, 0, 0}, 0.5, 0.25) == 0.0);  // at rest
  BOOST_TEST((!pair.closed() && !pair.opened()));
  // moved nearer by 0.1, 0.25 is enough for the 0.2 left
  BOOST_TEST(pair.force({2, 0, 1, 0.06}, {3, 0, 0, -0.04}, 0.5, 0.25) == 1.2 * 0.2 / 0.5, tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(touching_faces_without_approach_feel_exactly_nothing) {
  for (const double v : {0.0, 1.0, -0.1}) {
    Pair pair(0, 0, Contact::node_to_node);
    for (int k = 0; k < 3; ++k) BOOST_TEST(pair.force({2, 0, v, 0.7}, {3, 0, v, 0.7}, 0.5, 0.25) == 0.0);
    BOOST_TEST((!pair.closed() && !pair.opened()));
  }
}

// Without approach the bars press with what makes both nodes accelerate alike: a = (4 − F)/2 = (−6 + F)/3, F = 4.8.
BOOST_AUTO_TEST_CASE(sustained_contact_passes_on_what_presses) {
  Pair pair(0, 0, Contact::node_to_node);
  double v = 0.3;
  for (int k = 0; k < 4; ++k) {
    const double force = pair.force({2, 4, v, 0}, {3, -6, v, 0}, 0.5, 0.25);
    BOOST_TEST(force == 4.8, tt::tolerance(1e-14));
    BOOST_TEST(pair.closed() == (k == 0));
    BOOST_TEST(!pair.opened());
    const Face a = moved({2, 4, v, 0}, -force, 0.5, 0.25), b = moved({3, -6, v, 0}, force, 0.5, 0.25);
    BOOST_TEST(a.velocity == b.velocity, tt::tolerance(1e-14));
    v = a.velocity;
  }
}

// The pressure of 4.8 is gone with the next wave. It stood for the first half of that kick; then nothing holds.
BOOST_AUTO_TEST_CASE(the_opening_kick_feels_half_of_the_last_pressure) {
  Pair pair(0, 0, Contact::node_to_node);
  pair.force({2, 4, 0, 0}, {3, -6, 0, 0}, 0.5, 0.25);
  BOOST_TEST(pair.force({2, 0, 0, 0}, {3, 0, 0, 0}, 0.5, 0.25) == 2.4, tt::tolerance(1e-14));
  BOOST_TEST((pair.opened() && !pair.closed()));
  BOOST_TEST(pair.force({2, 0, -1, 0}, {3, 0, 1, 0}, 0.5, 0.25) == 0.0);
  BOOST_TEST(!pair.opened());
  // they may meet again
  BOOST_TEST(pair.force({2, 0, 5, 0}, {3, 0, -1, 0}, 0.5, 0.25) == 14.4, tt::tolerance(1e-14));
  BOOST_TEST(pair.closed());
}

// Half of the last pressure and a little more still holds, a little less no longer. To hold 2.4: a.force = 2, b.force =
// −3.
BOOST_AUTO_TEST_CASE(contact_ends_where_the_pressure_after_it_would_pull) {
  for (const double beside : {-1e-9, 1e-9}) {
    Pair pair(0, 0, Contact::node_to_node);
    pair.force({2, 4, 0, 0}, {3, -6, 0, 0}, 0.5, 0.25);
    pair.force({2, 2 + beside, 0, 0}, {3, -3 - beside, 0, 0}, 0.5, 0.25);
    BOOST_TEST(pair.opened() == (beside < 0));
  }
}

// A front that arrived in the last kick had passed half of its change by the middle of it: a pressure of 4.8 and then
// one of 3.6 tell that it left 2.4 behind, and half of that is felt in the opening kick. A rise tells nothing; below
// nothing there is no pressure.
BOOST_AUTO_TEST_CASE(the_opening_kick_feels_what_a_front_left_behind) {
  const auto opening = [](const std::vector<double>& pressures, double last) {
    Pair pair(0, 0, Contact::node_to_node);
    const auto press = [&](double p) { return pair.force({2, p / 1.2, 0, 0}, {3, -p / 0.8, 0, 0}, 0.5, 0.25); };
    for (const double p : pressures) BOOST_TEST(press(p) == p, tt::tolerance(1e-14));
    BOOST_TEST(!pair.opened());
    const double force = press(last);
    BOOST_TEST(pair.opened());
    return force;
  };
  BOOST_TEST(opening({4.8, 4.8, 3.6}, 0) == 1.2, tt::tolerance(1e-13));
  BOOST_TEST(opening({4.8, 4.8, 3.6}, 1.2 - 1e-9) == 1.2, tt::tolerance(1e-13));
  BOOST_TEST(opening({4.8, 4.8, 3.6, 3.6}, 0) == 1.8, tt::tolerance(1e-13));
  BOOST_TEST(opening({3.6, 4.8}, 0) == 2.4, tt::tolerance(1e-13));
  BOOST_TEST(opening({4.8, 4.8, 2.4}, -1e-9) == 0.0);
}

BOOST_AUTO_TEST_CASE(a_bonded_pair_pulls_once_it_has_met) {
  Pair pair(0, 0.3, Contact::bonded);
  BOOST_TEST(pair.force({2, -4, 0, 0}, {3, 6, 0, 0}, 0.5, 0.25) == 0.0);  // not yet
  BOOST_TEST(pair.force({2, 0, 5, 0}, {3, 0, -1, 0}, 0.5, 0.25) > 0);
  BOOST_TEST(pair.closed());
  BOOST_TEST(pair.force({2, -4, 0, 0.3}, {3, 6, 0, 0}, 0.5, 0.25) == -4.8, tt::tolerance(1e-14));
  BOOST_TEST(pair.force({2, 0, 0, 0.3}, {3, 0, 1, 0}, 0.5, 0.25) == -1.2 / 0.5, tt::tolerance(1e-14));
  BOOST_TEST(!pair.opened());
}

// The faces also give way to what presses on them: they close in by 6 + 0.5 (4/2 + 6/3) = 8 per unit of time, 2 a step.
BOOST_AUTO_TEST_CASE(the_time_of_closing_counts_the_forces_on_the_faces) {
  Pair pair(0, 0.5, Contact::node_to_node);
  pair.force({2, 4, 5, 0}, {3, -6, -1, 0}, 0.5, 0.25);
  BOOST_TEST(pair.closed());
  BOOST_TEST(pair.share_of_step() == 0.25, tt::tolerance(1e-13));
}

// Any faces, any history: never a pull, and while they touch the gap is nothing after each step.
BOOST_AUTO_TEST_CASE(contact_never_pulls_and_never_overlaps) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> mass(0.1, 10), any(-5, 5);
  int closed = 0, opened = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double gap = std::abs(any(random)) / 50, step = 0.02;
    Pair pair(0, gap, Contact::node_to_node);
    Face a{mass(random), 0, any(random), 0}, b{mass(random), 0, any(random), 0};
    for (int n = 0; n < 60; ++n) {
      a.force = 20 * any(random);
      b.force = 20 * any(random);
      const double kick = n == 0 ? step / 2 : step, force = pair.force(a, b, kick, step);
      BOOST_TEST_REQUIRE(force >= 0);
      closed += pair.closed();
      opened += pair.opened();
      const double momentum = a.mass * a.velocity + b.mass * b.velocity + kick * (a.force + b.force);
      a = moved(a, -force, kick, step);
      b = moved(b, force, kick, step);
      BOOST_TEST_REQUIRE(std::abs(a.mass * a.velocity + b.mass * b.velocity - momentum) < 1e-11);
      BOOST_TEST_REQUIRE(gap + b.displacement - a.displacement >= -1e-12);
    }
  }
  BOOST_TEST(closed > 300);
  BOOST_TEST(opened > 300);
}

// --- FEM
// ----------------------------------------------------------------------------------------------------------------

// By symmetry the contact stands still: σ = −ρc v₀ behind fronts at ±c, which come back from the free ends after 2L/c.
BOOST_AUTO_TEST_CASE(equal_bars_that_touch_at_the_start) {
  const Record r = fem::run(closing(0), 50, steps_of(1e-4, 260, {20, 50, 80, 101, 260}));
  const auto& stress = r.snapshots[0].stress.value;  // fronts 20 elements from the contact
  for (std::size_t e = 0; e < 100; ++e) {
    BOOST_TEST(std::abs(stress[e] - (e >= 30 && e < 70 ? -100 : 0)) <= 1e-10, e << ": " << stress[e]);
  }
  all_near(r.snapshots[1].stress.value, -100, 1e-10);
  const auto& back = r.snapshots[2].stress.value;  // unloaded 30 elements from the free ends
  for (std::size_t e = 0; e < 100; ++e) {
    BOOST_TEST(std::abs(back[e] - (e >= 30 && e < 70 ? -100 : 0)) <= 1e-10, e << ": " << back[e]);
  }
  BOOST_REQUIRE(r.touches.size() == 1U);
  BOOST_TEST(r.touches[0].left == 0U);
  BOOST_TEST(r.touches[0].from == 0.0);
  BOOST_TEST(r.touches[0].to == 0.01, tt::tolerance(1e-12));
  velocities_are_exchanged(r);
  momentum_is_kept(r, 0.5);
  BOOST_TEST(r.features == (std::vector<std::string>{"contact", "elastic"}), tt::per_element());
}

// After rigid flight over whole steps, and whole cells among them, all is as if they had touched at the start.
BOOST_AUTO_TEST_CASE(equal_bars_that_meet_at_a_whole_step) {
  for (const double steps : {1.0, 7.0, 50.0}) {
    const Record r = fem::run(closing(steps * 2e-4), 50, steps_of(1e-4, 300, {300}));
    BOOST_TEST_CONTEXT("gap closes after " << steps << " steps") {
      BOOST_REQUIRE(r.touches.size() == 1U);
      BOOST_TEST(r.touches[0].from == steps * 1e-4, tt::tolerance(1e-9));
      BOOST_TEST(r.touches[0].to - r.touches[0].from == 0.01, tt::tolerance(1e-9));
      velocities_are_exchanged(r);
      momentum_is_kept(r, 0.5);
    }
  }
}

// Where the gap closes within a step the approach is stopped in two kicks. The touch begins when rigid flight says and
// ends to a step; the bars carry away a little less, what the impact of two end masses of ½ρh may take at most.
BOOST_AUTO_TEST_CASE(equal_bars_that_meet_within_a_step) {
  for (const double steps : {0.25, 0.5, 0.75, 3.5, 12.9}) {
    const Record r = fem::run(closing(steps * 2e-4), 50, steps_of(1e-4, 300, {300}));
    BOOST_TEST_CONTEXT("gap closes after " << steps << " steps") {
      BOOST_REQUIRE(r.touches.size() == 1U);
      BOOST_TEST(r.touches[0].from == steps * 1e-4, tt::tolerance(1e-9));
      BOOST_TEST(std::abs(r.touches[0].to - r.touches[0].from - 0.01) <= 1e-4);
      BOOST_TEST(r.ledger.back().contact >= 0);
      BOOST_TEST(r.ledger.back().contact <= 0.01);
      double mean = 0;
      const auto right = r.snapshots[0].velocity.of_bar(1).value;
      for (std::size_t i = 0; i <= 50; ++i) mean += right[i] * (i == 0 || i == 50 ? 0.5 : 1) / 50;
      BOOST_TEST(mean == 1.0, tt::tolerance(0.0102));
      momentum_is_kept(r, 0.5);
    }
  }
}

// The contact stress of impedances Z₁ and Z₂ = 4 Z₁ (E and ρ fourfold, the same c): v* = (Z₁v₁ + Z₂v₂)/(Z₁ + Z₂),
// σ* = −Z₁Z₂ (v₁ − v₂)/(Z₁ + Z₂). The heavier bar is longer, so no wave comes back from its end during the contact.
BOOST_AUTO_TEST_CASE(bars_of_unequal_impedance) {
  for (const double ratio : {0.25, 4.0, 1e6, 1e-6}) {
    const double z1 = 100, z2 = 100 * ratio, v1 = 3, v2 = -1;
    const double v = (z1 * v1 + z2 * v2) / (z1 + z2), sigma = -z1 * z2 * (v1 - v2) / (z1 + z2);
    const Record r = fem::run(row({flying(0, 0.5, v1), flying(0.5, 1, v2, material::Elastic{1e4 * ratio, ratio})}), 50,
                              steps_of(1e-4, 130, {40}));
    BOOST_TEST_CONTEXT("ratio " << ratio) {
      const Field left = r.snapshots[0].stress.of_bar(0), right = r.snapshots[0].stress.of_bar(1);
      BOOST_REQUIRE(right.value.size() == 100U);
      for (std::size_t e = 0; e < 50; ++e) {
        BOOST_TEST(std::abs(left.value[e] - (e >= 10 ? sigma : 0)) <= 1e-12 * z1 * (v1 - v2), e);
      }
      for (std::size_t e = 0; e < 100; ++e) {
        BOOST_TEST(std::abs(right.value[e] - (e < 40 ? sigma : 0)) <= 1e-12 * z2 * (v1 - v2), e);
      }
      const Field speeds = r.snapshots[0].velocity.of_bar(1);
      for (std::size_t i = 0; i < 39; ++i) BOOST_TEST(std::abs(speeds.value[i] - v) <= 1e-12 * 4, i);
      const Field before = r.snapshots[0].velocity.of_bar(0);
      for (std::size_t i = 12; i <= 50; ++i) BOOST_TEST(std::abs(before.value[i] - v) <= 1e-12 * 4, i);
      momentum_is_kept(r, 0.5 * 3 + ratio);
    }
  }
}

// A bar strikes one that is twice as long: after 2L/c it lies still, and all of its momentum is in the other.
BOOST_AUTO_TEST_CASE(a_bar_gives_all_of_its_momentum_to_a_longer_one) {
  const Record r = fem::run(row({flying(0, 0.5, 1), flying(0.5, 1, 0)}), 50, steps_of(1e-4, 1000, {60, 160, 1000}));
  const auto& half_way = r.snapshots[0].stress.value;  // fronts 40 elements in, past the end and back, and 60 in
  for (std::size_t e = 0; e < 150; ++e) {
    BOOST_TEST(std::abs(half_way[e] - (e >= 10 && e < 110 ? -50 : 0)) <= 1e-10, e << ": " << half_way[e]);
  }
  for (const std::size_t s : {1U, 2U}) all_near(r.snapshots[s].velocity.of_bar(0).value, 0, 1e-11);
  const LedgerLine& last = r.ledger.back();
  BOOST_TEST(last.momentum == 0.5, tt::tolerance(1e-12));
  // half of the energy flies on and half of it swings, but for the one element in which a front stands
  BOOST_TEST(last.kinetic + last.strain == 0.25, tt::tolerance(0.0051));
  momentum_is_kept(r, 0.5);
}

// Newton's cradle: the momentum of the first goes through the second, which touches the third, or flies to it.
BOOST_AUTO_TEST_CASE(three_bars_pass_momentum_on) {
  for (const double gap : {0.0, 0.005}) {
    const Record r = fem::run(row({flying(0, 0.5, 1), flying(0.5, 0.5, 0), flying(1 + gap, 0.5, 0)}), 50,
                              steps_of(1e-4, 400, {400}));
    BOOST_TEST_CONTEXT("gap " << gap) {
      all_near(r.snapshots[0].velocity.of_bar(0).value, 0, 1e-11);
      all_near(r.snapshots[0].velocity.of_bar(1).value, 0, 1e-11);
      all_near(r.snapshots[0].velocity.of_bar(2).value, 1, 1e-11);
      all_near(r.snapshots[0].stress.value, 0, 1e-10);
      momentum_is_kept(r, 0.5);
      BOOST_REQUIRE(r.touches.size() == 2U);
      BOOST_TEST(r.touches[0].left == 0U);
      BOOST_TEST(r.touches[0].from == 0.0);
      BOOST_TEST(r.touches[1].left == 1U);
      if (gap == 0) {
        BOOST_TEST(r.touches[1].from == 0.005, tt::tolerance(0.021));  // the wave comes to it after L/c
        BOOST_TEST(r.touches[1].to == 0.015, tt::tolerance(1e-9));
      } else {
        BOOST_TEST(r.touches[0].to == 0.01, tt::tolerance(1e-9));
        BOOST_TEST(r.touches[1].from == 0.005 + 0.005, tt::tolerance(0.011));  // its end flies at 1 from L/c on
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(bars_at_rest_or_in_one_flight_never_feel_each_other) {
  for (const double gap : {0.0, 0.01, 0.0037}) {
    for (const double speed : {0.0, 1.0, -2.0}) {
      const Record r =
          fem::run(row({flying(0, 0.5, speed), flying(0.5 + gap, 0.5, speed)}), 50, steps_of(0.7e-4, 200, {200}));
      for (const double stress : r.snapshots[0].stress.value) BOOST_TEST_REQUIRE(stress == 0.0);
      for (const double v : r.snapshots[0].velocity.value) BOOST_TEST_REQUIRE(v == speed);
      BOOST_TEST(r.touches.empty());
    }
  }
}

// One element a bar: two steps of stress −ρc v₀ at Courant number 1.
BOOST_AUTO_TEST_CASE(bars_of_one_element) {
  const Record r = fem::run(closing(0), 1, steps_of(0.005, 6, {1, 2, 6}));
  all_near(r.snapshots[0].stress.value, -100, 1e-11);
  BOOST_TEST(r.touches.at(0).to == 0.01, tt::tolerance(1e-12));
  velocities_are_exchanged(r);
  momentum_is_kept(r, 0.5);
}

// Elements of bars whose lengths do not fit are as near to one size as may be, and never none.
BOOST_AUTO_TEST_CASE(other_bars_take_elements_of_the_first_ones_size) {
  const Record r =
      fem::run(row({flying(0, 0.5, 0), flying(0.5, 0.124, 0), flying(1, 0.004, 0)}), 50, steps_of(1e-5, 1, {1}));
  const Field& stress = r.snapshots[0].stress;
  BOOST_TEST(stress.of_bar(0).value.size() == 50U);
  BOOST_TEST(stress.of_bar(1).value.size() == 12U);
  BOOST_TEST(stress.of_bar(2).value.size() == 1U);
  BOOST_TEST(stress.of_bar(1).edges.front() == 0.5);
  BOOST_TEST(stress.of_bar(1).edges.back() == 0.624, tt::tolerance(1e-14));
  BOOST_TEST(r.snapshots[0].velocity.of_bar(2).x == (std::vector<double>{1, 1.004}), tt::per_element());
  BOOST_TEST(r.work.element_steps == 63);
  BOOST_TEST(r.work.node_steps == 66);
  const Scene narrow = row({flying(0, 0.5, 0), flying(1, 0.004, 0, material::Elastic{4e4, 1})});
  BOOST_TEST(fem::critical_time_step(narrow, 50) == 0.004 / 200, tt::tolerance(1e-14));
}

// Momentum at every step, and no more energy than at the start, away from Courant number 1 and for bars that do not
// fit.
BOOST_AUTO_TEST_CASE(momentum_is_kept_for_any_bars) {
  const Scene scene = row({flying(0, 0.5, 3), flying(0.503, 0.31, -1, material::Elastic{2e4, 3}),
                           flying(0.83, 0.7, -4, material::Hardening{1e4, 2, 2500, 90})});
  for (const double courant : {0.3, 0.9}) {
    const double step = courant * fem::critical_time_step(scene, 40);
    const Record r = fem::run(scene, 40, steps_of(step, 1500, {1500}));
    BOOST_TEST((r.outcome == Outcome::completed));
    BOOST_TEST(r.touches.size() >= 2U);
    momentum_is_kept(r, 0.5 * 3 + 0.31 * 3 + 0.7 * 2 * 4);
    const LedgerLine &first = r.ledger.front(), &last = r.ledger.back();
    BOOST_TEST(last.contact >= -1e-3 * first.kinetic);
    BOOST_TEST(last.kinetic + last.strain + last.dissipated <= 1.001 * first.kinetic);
  }
}

BOOST_AUTO_TEST_CASE(a_mirrored_impact_has_the_same_bits) {
  // bars of 32 and 48 elements from either end
  const Record a = fem::run(unlike_bars(false), 32, steps_of(0.9e-4, 500, {100, 250, 500}));
  const Record b = fem::run(unlike_bars(true), 48, steps_of(0.9e-4, 500, {100, 250, 500}));
  BOOST_TEST(!a.touches.empty());
  has_mirrored_bits(a, b);
}

// Lengths twofold, moduli 4, densities 16: c is half, times are 4, velocities ½ (strains are as before, for gaps are
// lengths), stresses 4.
BOOST_AUTO_TEST_CASE(powers_of_two_scale_every_bit) {
  const Scene one = row({flying(0, 0.5, 3), flying(0.57, 0.31, -1, material::Hardening{2e4, 3, 2500, 150})});
  const Scene scaled = row({flying(0, 1, 1.5, material::Elastic{4e4, 16}),
                            flying(1.14, 0.62, -0.5, material::Hardening{8e4, 48, 1e4, 600})});
  const Record a = fem::run(one, 40, steps_of(0.7e-4, 900, {300, 900}));
  const Record b = fem::run(scaled, 40, steps_of(2.8e-4, 900, {300, 900}));
  BOOST_REQUIRE(!a.touches.empty());
  BOOST_TEST(a.ledger.back().dissipated > 0);
  BOOST_TEST(b.touches.at(0).from == 4 * a.touches.at(0).from);
  BOOST_TEST(b.touches.at(0).to == 4 * a.touches.at(0).to);
  for (std::size_t s = 0; s < 2; ++s) {
    std::vector<double> stress = a.snapshots[s].stress.value, velocity = a.snapshots[s].velocity.value;
    for (double& v : stress) v *= 4;
    for (double& v : velocity) v /= 2;
    BOOST_TEST(b.snapshots[s].stress.value == stress, tt::per_element());
    BOOST_TEST(b.snapshots[s].velocity.value == velocity, tt::per_element());
  }
}

// After 2L/c the bond pulls. A bonded pair is one bar of both lengths, at any Courant number; its middle node, one of
// two that met, starts with their mean velocity.
BOOST_AUTO_TEST_CASE(bonded_bars_are_one_bar) {
  Scene bonded = row({flying(0, 0.5, 3), flying(0.5, 0.5, -1)});
  bonded.contact = Contact::bonded;
  Scene whole = row({flying(0, 1, 0)});
  whole.bars[0].initial_velocity = [](double x) { return x < 0.4999 ? 3 : x > 0.5001 ? -1 : 1.0; };
  for (const double courant : {1.0, 0.7}) {
    const std::vector<long> samples{30, 130, 400, 1000};
    const Record two = fem::run(bonded, 50, steps_of(courant * 1e-4, 1000, samples));
    const Record one = fem::run(whole, 100, steps_of(courant * 1e-4, 1000, samples));
    for (std::size_t s = 0; s < samples.size(); ++s) {
      for (std::size_t e = 0; e < 100; ++e) {
        BOOST_TEST(std::abs(two.snapshots[s].stress.value[e] - one.snapshots[s].stress.value[e]) <= 1e-9, e);
      }
    }
    if (courant == 1) {  // the whole middle in tension ρcΔv/2 where unbonded bars have parted
      const auto& stress = two.snapshots[1].stress.value;
      for (std::size_t e = 21; e < 79; ++e) BOOST_TEST(stress[e] == 200.0, tt::tolerance(1e-11));
    }
    BOOST_REQUIRE(two.touches.size() == 1U);
    BOOST_TEST(two.touches[0].to == infinite);
    momentum_is_kept(two, 2);
  }
}

// Pressed from both ends, or from one against a wall, bars that touch are one bar: their faces press with 0, 200, 0,
// 200,
// ... for 2L/c each, or with 0, 100, 200, 100, 0, ...
BOOST_DATA_TEST_CASE(bars_that_are_pressed_together_are_one_bar, bdata::make({0, 1, 2}), which) {
  Scene two = row({flying(0, 0.5, 0), flying(0.5, 0.5, 0)}), one = row({flying(0, 1, 0)});
  if (which != 1) two.loads.push_back(pull(End::left, -100));
  if (which != 2) two.loads.push_back(pull(End::right, -100));
  if (which == 1) two.left = Support::fixed;
  if (which == 2) two.right = Support::fixed;
  one.loads = two.loads;
  one.left = two.left;
  one.right = two.right;
  const std::vector<long> samples{40, 90, 120, 180, 290, 330};
  const Record a = fem::run(two, 50, steps_of(1e-4, 400, samples)),
               b = fem::run(one, 100, steps_of(1e-4, 400, samples));
  for (std::size_t s = 0; s < samples.size(); ++s) {
    for (std::size_t e = 0; e < 100; ++e) {
      BOOST_TEST(std::abs(a.snapshots[s].stress.value[e] - b.snapshots[s].stress.value[e]) <= 1e-9, e);
    }
  }
  for (const LedgerLine& line : a.ledger)
    BOOST_TEST_REQUIRE(std::abs(line.momentum - line.impulse) <= 1e-12, line.time);
  BOOST_REQUIRE(!a.touches.empty());
  BOOST_TEST(std::abs(a.touches[0].from - 0.005) <= 1e-4);  // the wave is at the faces after L/c, to a step
}

// A bar that falls at 8 by its weight through a gap of ½ · 8 · (3.5 Δt)²: the step in which it lands starts with a gap
// of 49/4 − 9 = 13/4 quarters and would end with 49/4 − 16; linear between, it lands after 13/28 of it.
BOOST_AUTO_TEST_CASE(a_bar_that_falls_on_another_touches_it_when_it_lands) {
  const double step = 1e-4, gap = 4 * 3.5 * 3.5 * step * step;
  Scene scene = row({flying(0, 0.5, 0), flying(0.5 + gap, 0.5, 0)});
  scene.body_force = [](double x, double) { return x <= 0.5 ? 8.0 : 0.0; };
  const Record r = fem::run(scene, 10, steps_of(step, 6, {6}));
  BOOST_REQUIRE(!r.touches.empty());
  BOOST_TEST(r.touches[0].from == (3 + 13.0 / 28) * step, tt::tolerance(1e-6));
}

// --- MPM
// ----------------------------------------------------------------------------------------------------------------

// With an empty cell between them no node hears of both: each bar answers with the bits that it has alone, though
// another density, another law and another load are in the grid with it.
BOOST_DATA_TEST_CASE(bars_apart_by_an_empty_cell_have_the_bits_of_each_alone,
                     bdata::make({0, 1, 2}) * bdata::make({false, true}), which, in_layer) {
  const mpm::Scheme scheme = schemes[static_cast<std::size_t>(which)];
  const double h = 1.0 / 64;
  for (const std::vector<double>& xi : {std::vector{0.5}, {0.3, 0.8}, {0.25, 0.75}, {0.0, 0.5, 1.0}}) {
    Scene left = row({flying(0, 0.5, 0)}), right = row({flying(0, 0.75, 0, material::Hardening{4e4, 2, 1e4, 1})});
    left.bars[0].initial_velocity = [](double x) { return 0.01 * x; };
    right.bars[0].initial_velocity = nullptr;
    left.loads = {pull(End::left, 1.5)};
    right.loads = {pull(End::right, -3)};
    for (Load* load : {&left.loads[0], &right.loads[0]}) {
      if (in_layer) load->transfer = Transfer::boundary_layer;
      load->layer_thickness = 1.75 * h;
    }
    Scene both = row({left.bars[0], right.bars[0]});
    both.bars[1].begin = 0.5 + h;
    both.loads = {left.loads[0], right.loads[0]};
    const Stepping s = steps_of(2e-5, 400, {150, 400});
    const Record a = mpm::run(left, 32, xi, scheme, s), b = mpm::run(right, 48, xi, scheme, s),
                 ab = mpm::run(both, 32, xi, scheme, s);
    BOOST_REQUIRE((ab.outcome == Outcome::completed));
    BOOST_TEST(ab.touches.empty());
    std::vector<std::string> features{"contact", "plasticity"};
    if (in_layer) features.insert(features.begin(), "boundary-layer");
    BOOST_TEST(ab.features == features, tt::per_element());
    BOOST_TEST(b.ledger.back().dissipated > 0);
    for (std::size_t k = 0; k < 2; ++k) {
      for (const auto field : {&Snapshot::stress, &Snapshot::velocity, &Snapshot::displacement}) {
        BOOST_TEST((ab.snapshots[k].*field).of_bar(0).value == (a.snapshots[k].*field).value, tt::per_element());
        BOOST_TEST((ab.snapshots[k].*field).of_bar(1).value == (b.snapshots[k].*field).value, tt::per_element());
      }
    }
  }
}

// A bar that begins half a cell on has its particles at other natural coordinates and is otherwise a bar alone.
BOOST_DATA_TEST_CASE(a_bar_may_begin_within_a_cell, bdata::make({0, 1, 2}), which) {
  const mpm::Scheme scheme = schemes[static_cast<std::size_t>(which)];
  const double h = 1.0 / 64;
  const auto compare = [&](const std::vector<double>& xi, double shift) {
    std::vector<double> moved_on = xi;
    for (double& x : moved_on) x += shift;
    Scene right = row({flying(0, 0.75, 0, material::Elastic{4e4, 2})});
    right.loads = {pull(End::right, -3)};
    Scene both = row({flying(0, 0.5, 0), right.bars[0]});
    both.bars[1].begin = 0.5 + (1 + shift) * h;
    both.loads = {pull(End::left, 1), right.loads[0]};
    const Stepping s = steps_of(1e-5, 400, {400});
    const Record alone = mpm::run(right, 48, moved_on, scheme, s), ab = mpm::run(both, 32, xi, scheme, s);
    const Field stress = ab.snapshots[0].stress.of_bar(1);
    BOOST_TEST(*std::max_element(stress.value.begin(), stress.value.end()) < 0);
    BOOST_TEST(stress.value == alone.snapshots[0].stress.value, tt::per_element());
    BOOST_TEST(ab.snapshots[0].velocity.of_bar(1).value == alone.snapshots[0].velocity.value, tt::per_element());
    // it is told where it stands, not where its cells do
    BOOST_TEST(stress.edges.front() == 0.5 + (1 + shift) * h, tt::tolerance(1e-14));
    BOOST_TEST(stress.edges.back() == 1.25 + (1 + shift) * h, tt::tolerance(1e-14));
    BOOST_TEST(stress.x.front() == 0.5 + (1 + shift + xi[0]) * h, tt::tolerance(1e-14));
  };
  compare({0.25}, 0.5);
  compare({0.125, 0.375}, 0.5);
  compare({0.5}, 0.25);
  compare({0.5}, 0.375);
}

// Bars that share a node from the start move as one, to the bit: the grid has no other contact.
BOOST_DATA_TEST_CASE(bars_that_share_a_node_are_one_bar, bdata::make({0, 1, 2}), which) {
  const mpm::Scheme scheme = schemes[static_cast<std::size_t>(which)];
  Scene one = step_scene(), two = step_scene();
  two.bars = {two.bars[0], two.bars[0]};
  two.bars[0].length = two.bars[1].length = two.bars[1].begin = 0.5;
  const Record a = mpm::run(one, 64, {0.25, 0.75}, scheme, steps_at(0.4, 64, 500));
  const Record b = mpm::run(two, 32, {0.25, 0.75}, scheme, steps_at(0.4, 64, 500));
  BOOST_TEST(a.snapshots[0].stress.value == b.snapshots[0].stress.value, tt::per_element());
  BOOST_TEST(a.snapshots[0].velocity.value == b.snapshots[0].velocity.value, tt::per_element());
  BOOST_TEST(a.ledger.back().momentum == b.ledger.back().momentum);
  BOOST_REQUIRE(b.touches.size() == 1U);
  BOOST_TEST(b.touches[0].from == 0.0);
  BOOST_TEST(b.touches[0].to == infinite);
  BOOST_TEST(a.work.bytes < b.work.bytes);  // its particles need not know their cell
  // one bar of infinite yield stress is no other than an elastic one
  two.bars[1].material = material::Hardening{1e4, 1, 2500, infinite};
  BOOST_TEST(mpm::run(two, 32, {0.25, 0.75}, scheme, steps_at(0.4, 64, 500)).snapshots[0].stress.value ==
                 a.snapshots[0].stress.value,
             tt::per_element());
}

// Flight at one speed of each bar over many cells, then the first node that both reach: to one step when rigid flight
// says, for bars that begin anywhere in a cell.
BOOST_DATA_TEST_CASE(touch_begins_when_rigid_flight_says, bdata::make({0, 2}), which) {
  const double h = 0.01, step = 1e-5;
  int at = 0;
  for (const std::vector<double>& xi : {std::vector{0.5}, {0.25, 0.75}, {0.3}}) {
    for (const double gap : {0.02, 0.0271, 0.0313}) {
      for (const auto& [v1, v2] : {std::pair(5.0, -5.0), {7.0, 0.0}, {0.0, -7.0}, {2.0, -6.0}, {9.0, 2.0}}) {
        Scene scene = row({flying(0, 0.3, v1), flying(0.3 + gap, 0.3, v2)});
        scene.convected = true;
        const double predicted =
            analytic::grid_contact_time({0.3 - (1 - xi.back()) * h, 0.3 + gap + xi.front() * h, v1, v2, h});
        const long steps = std::lround(predicted / step) + 3;
        const Record r =
            mpm::run(scene, 30, xi, schemes[static_cast<std::size_t>(which)], steps_of(step, steps, {steps - 5}));
        BOOST_TEST_CONTEXT("gap " << gap << ", velocities " << v1 << ", " << v2 << ", xi " << xi[0]) {
          BOOST_REQUIRE(r.touches.size() == 1U);
          BOOST_TEST(std::abs(r.touches[0].from - predicted) <= 1.001 * step,
                     r.touches[0].from << " is not " << predicted);
          all_near(r.snapshots[0].velocity.of_bar(0).value, v1, 1e-12);
          all_near(r.snapshots[0].velocity.of_bar(1).value, v2, 1e-12);
          momentum_is_kept(r, 0.3 * 10);
          ++at;
        }
      }
    }
  }
  BOOST_TEST(at == 45);
}

// Bars that meet about a node: contact lasts 2L/c and a little for what the grid adds, and they part with what they
// came with.
BOOST_AUTO_TEST_CASE(contact_of_particles_lasts_twice_the_length_over_the_wave_speed) {
  for (const double gap : {0.01, 0.02, 0.03}) {
    Scene scene = closing(gap);
    scene.convected = true;
    const Record r = mpm::run(scene, 100, {0.5}, mpm::Scheme::musl, steps_of(5e-6, 6000, {6000}));
    BOOST_TEST_CONTEXT("gap " << gap << " " << r.message) {
      BOOST_REQUIRE((r.outcome == Outcome::completed));
      BOOST_REQUIRE(r.touches.size() == 1U);
      BOOST_TEST(r.touches[0].from == gap / 2 - 0.0025, tt::tolerance(2e-3));  // h/(2v₀) early
      BOOST_TEST(r.touches.back().to - r.touches.front().from == 0.01, tt::tolerance(0.05));
      momentum_is_kept(r, 0.5);
      const auto mean = [&](std::size_t b) {
        double sum = 0;
        for (const double v : r.snapshots[0].velocity.of_bar(b).value) sum += v / 100;
        return sum;
      };
      BOOST_TEST(mean(0) == -1.0, tt::tolerance(0.05));
      BOOST_TEST(mean(1) == 1.0, tt::tolerance(0.05));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_mirrored_impact_of_particles_has_the_same_bits) {
  const auto go = [](bool mirror) {
    Scene scene = unlike_bars(mirror);
    scene.convected = true;
    return mpm::run(scene, mirror ? 48 : 32, mirror ? std::vector{0.125, 0.75} : std::vector{0.25, 0.875},
                    mpm::Scheme::musl, steps_of(2e-5, 1500, {400, 800, 1500}));
  };
  const Record a = go(false), b = go(true);
  BOOST_REQUIRE((a.outcome == Outcome::completed));
  BOOST_REQUIRE(!a.touches.empty());
  has_mirrored_bits(a, b);
}

BOOST_AUTO_TEST_CASE(a_bar_that_is_not_a_whole_number_of_cells_long_is_refused) {
  const auto go = [](double length) {
    return mpm::run(row({flying(0, 0.5, 0), flying(1, length, 0)}), 50, {0.5}, mpm::Scheme::musl,
                    steps_of(1e-5, 1, {1}));
  };
  BOOST_CHECK_EXCEPTION(go(0.305), std::invalid_argument, tests::says({"bar 2"}));
  BOOST_CHECK_THROW(go(0.004), std::invalid_argument);
  BOOST_CHECK_THROW(go(0.3000001), std::invalid_argument);
  BOOST_TEST(go(0.3).snapshots[0].stress.of_bar(1).value.size() == 30U);
  BOOST_TEST(go(0.07).snapshots[0].stress.of_bar(1).value.size() == 7U);  // but for round-off
}

// A wall stands on a face of the grid and holds the bar before it. Where the row ends within a cell no particle need
// reach the last node, and a wall there would hold nothing: it is refused.
BOOST_AUTO_TEST_CASE(a_wall_holds_the_last_bar_or_is_refused) {
  const auto go = [](double begin) {
    Scene scene = row({flying(0, 0.5, 0), flying(begin, 0.5, 0)});
    scene.right = Support::fixed;
    scene.body_force = [](double x, double) { return x > 0.507 ? -1.0 : 0.0; };
    return mpm::run(scene, 50, {0.25}, mpm::Scheme::musl, steps_of(2e-5, 2000, {2000}));
  };
  // two periods 4L/c on, the held bar is where it was; in free flight it would have a momentum of 0.02
  BOOST_TEST(std::abs(go(0.51).ledger.back().momentum) < 0.001);
  for (const double begin : {0.515, 0.5175}) BOOST_CHECK_THROW(go(begin), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
