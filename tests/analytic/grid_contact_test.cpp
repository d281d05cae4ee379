// When two bars of particles come to share a node: by hand, and against flight in small steps.
#include "analytic/grid_contact.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

BOOST_AUTO_TEST_SUITE(grid_contact)

namespace {

using diptych::analytic::Approach;
using diptych::analytic::grid_contact_time;
namespace tt = boost::test_tools;

const double infinite = std::numeric_limits<double>::infinity();

/// Cells between two particles after flight to t, each in the cell that it is heading into or, at rest, in the one it
/// is in: 1 is next to each other.
double cells_apart(const Approach& a, double t) {
  return std::floor((a.right + a.right_velocity * t) / a.cell) - std::floor((a.left + a.left_velocity * t) / a.cell);
}

}  // namespace

// Both reach the faces beside the node at once, 2h apart. Centred particles stand h/2 behind their ends: the ends are
// still h apart, a time h/(2v₀) early.
BOOST_AUTO_TEST_CASE(about_a_node_bars_touch_while_their_ends_are_a_cell_apart) {
  const double h = 0.01, v = 2, node = 0.5;
  for (const double ends : {0.03, 0.25, 1.7}) {
    const Approach a{node - ends / 2 - h / 2, node + ends / 2 + h / 2, v, -v, h};
    const double ends_meet = ends / (2 * v);
    BOOST_TEST(ends_meet - grid_contact_time(a) == h / (2 * v), tt::tolerance(1e-9));
  }
}

// About the centre of a cell they enter one and the same cell at once, h apart: just when their ends meet.
BOOST_AUTO_TEST_CASE(about_a_cell_centre_bars_touch_when_their_ends_do) {
  const double h = 0.01, v = 2, centre = 0.505;
  for (const double ends : {0.03, 0.25, 1.7}) {
    const Approach a{centre - ends / 2 - h / 2, centre + ends / 2 + h / 2, v, -v, h};
    BOOST_TEST(grid_contact_time(a) == ends / (2 * v), tt::tolerance(1e-9));
  }
}

// The one at rest waits in cell 5: the other has to reach cell 4, face 4 coming from the left; or, resting in cell 2,
// for the other to leave cell 4 through its left face.
BOOST_AUTO_TEST_CASE(with_one_bar_at_rest_the_other_crosses_one_face_too_many) {
  BOOST_TEST(grid_contact_time({0.25, 5.75, 0.5, 0, 1}) == (4 - 0.25) / 0.5, tt::tolerance(1e-12));
  BOOST_TEST(grid_contact_time({2.25, 7.5, 0, -0.25, 1}) == (7.5 - 4) / 0.25, tt::tolerance(1e-12));
  // where the one at rest stands in its cell does not matter
  BOOST_TEST(grid_contact_time({0.25, 5.05, 0.5, 0, 1}) == (4 - 0.25) / 0.5, tt::tolerance(1e-12));
  BOOST_TEST(grid_contact_time({2.95, 7.5, 0, -0.25, 1}) == (7.5 - 4) / 0.25, tt::tolerance(1e-12));
}

// Left 0.5 + 2t, right 3.25 + t. Faces: right 4 at 0.75; left 1, 2 and 3 at 0.25, 0.75 and 1.25, when right is at 4.5.
BOOST_AUTO_TEST_CASE(a_bar_that_catches_up_with_another) {
  BOOST_TEST(grid_contact_time({0.5, 3.25, 2, 1, 1}) == 1.25, tt::tolerance(1e-12));
  // and seen from behind
  BOOST_TEST(grid_contact_time({-3.25, -0.5, -1, -2, 1}) == 1.25, tt::tolerance(1e-12));
}

// At 2.5 left crosses into cell 3 while right, in cell 4 until it crosses 5 at 3.3, is next to it: the first touch
// counts, though cells drift apart again.
BOOST_AUTO_TEST_CASE(the_first_touch_counts_though_it_may_break_off_again) {
  const Approach a{0.5, 3.35, 1, 0.5, 1};  // left reaches 3 at 2.5, where right is at 4.6
  BOOST_TEST(grid_contact_time(a) == 2.5, tt::tolerance(1e-12));
  BOOST_TEST(cells_apart(a, 2.51) == 1.0);
  BOOST_TEST(cells_apart(a, 3.31) == 2.0);
}

BOOST_AUTO_TEST_CASE(bars_in_the_same_or_the_next_cell_touch_from_the_start) {
  for (const double closing : {-3.0, 0.0, 3.0}) {
    BOOST_TEST(grid_contact_time({2.1, 2.2, closing, 0, 1}) == 0.0);
    BOOST_TEST(grid_contact_time({2.1, 3.9, closing, 0, 1}) == 0.0);
  }
  BOOST_TEST(grid_contact_time({1.9, 3.1, 3, 0, 1}) > 0.0);  // nearer than that, but with a cell between them
}

BOOST_AUTO_TEST_CASE(bars_that_do_not_close_in_never_touch) {
  BOOST_TEST(grid_contact_time({0.5, 3.5, 0, 0, 1}) == infinite);
  BOOST_TEST(grid_contact_time({0.5, 3.5, 2, 2, 1}) == infinite);
  BOOST_TEST(grid_contact_time({0.5, 3.5, -1, 1, 1}) == infinite);
  BOOST_TEST(grid_contact_time({0.5, 3.5, 1, 1.5, 1}) == infinite);
}

// Such an approach once was looked for without end.
BOOST_AUTO_TEST_CASE(faces_that_doubles_do_not_tell_apart) {
  for (const Approach& lost : {Approach{0, 1e30, 1, 0, 1}, Approach{0, 1e302, 1, -1, 1},
                               Approach{0, 4, std::numeric_limits<double>::denorm_min(), 0, 1}})
    BOOST_CHECK_THROW(grid_contact_time(lost), std::domain_error);
}

// Faces are those of the grid, so a shift by whole cells and a change of units leave the time alone.
BOOST_AUTO_TEST_CASE(shifts_by_whole_cells_and_units_do_not_matter) {
  const Approach a{0.3, 7.2, 1.25, -0.5, 1};
  const double t = grid_contact_time(a);
  BOOST_TEST(grid_contact_time({a.left + 64, a.right + 64, 1.25, -0.5, 1}) == t, tt::tolerance(1e-9));
  BOOST_TEST(grid_contact_time({a.left - 64, a.right - 64, 1.25, -0.5, 1}) == t, tt::tolerance(1e-9));
  BOOST_TEST(grid_contact_time({a.left / 8, a.right / 8, 1.25, -0.5, 0.125}) == t / 8, tt::tolerance(1e-12));
  BOOST_TEST(grid_contact_time({a.left, a.right, 5, -2, 1}) == t / 4, tt::tolerance(1e-12));
}

// Flight in small steps over many random cases: cells are never next to each other at any step before the time found,
// and they are just after it.
BOOST_AUTO_TEST_CASE(flight_in_small_steps_agrees) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> cell(0.05, 2), place(-20, 20), gap(0.1, 12), speed(-3, 3);
  int approached = 0, at_once = 0, nearer_than_two = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Approach a{};
    a.cell = cell(random);
    a.left = place(random) * a.cell;
    a.right = a.left + gap(random) * a.cell;
    a.left_velocity = speed(random);
    a.right_velocity = trial % 5 == 0 ? 0 : speed(random);
    const double t = grid_contact_time(a), closing = a.left_velocity - a.right_velocity;
    BOOST_TEST_CONTEXT("left " << a.left << " at " << a.left_velocity << ", right " << a.right << " at "
                               << a.right_velocity << ", cell " << a.cell << ", found " << t) {
      if (cells_apart(a, 0) <= 1) {
        BOOST_TEST(t == 0.0);
        ++at_once;
        continue;
      }
      if (closing <= 0) {
        BOOST_TEST(t == infinite);
        continue;
      }
      ++approached;
      BOOST_REQUIRE(t > 0);
      const double meet = (a.right - a.left) / closing;
      BOOST_REQUIRE(t <= meet);
      const double step = meet / 2000, eps = 1e-7 * meet;
      for (double at = 0; at < t - eps; at += step) BOOST_REQUIRE(cells_apart(a, at) > 1);
      BOOST_TEST(cells_apart(a, t + eps) <= 1);
      const double distance = a.right - a.left - closing * t;
      BOOST_TEST(distance <= 2 * a.cell * (1 + 1e-9));
      if (distance < 1.99 * a.cell) ++nearer_than_two;
    }
  }
  BOOST_TEST(approached > 500);
  BOOST_TEST(at_once > 50);
  BOOST_TEST(nearer_than_two > 200);
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense_is_refused) {
  const double nan = std::nan("");
  BOOST_CHECK_THROW(grid_contact_time({2, 1, 1, 0, 1}), std::invalid_argument);
  BOOST_CHECK_THROW(grid_contact_time({1, 1, 1, 0, 1}), std::invalid_argument);
  BOOST_CHECK_THROW(grid_contact_time({nan, 1, 1, 0, 1}), std::invalid_argument);
  BOOST_CHECK_THROW(grid_contact_time({1, 2, 1, 0, 0}), std::invalid_argument);
  BOOST_CHECK_THROW(grid_contact_time({1, 2, 1, 0, -1}), std::invalid_argument);
  BOOST_CHECK_THROW(grid_contact_time({1, 2, 1, 0, nan}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
