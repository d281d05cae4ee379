// FEM beside MPM where theory says exactly how they are related.
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "fem/bar.hpp"
#include "mpm/bar.hpp"
#include "tests/scenes.hpp"

BOOST_AUTO_TEST_SUITE(fem_beside_mpm)

using namespace diptych;
using namespace diptych::tests;
namespace bdata = boost::unit_test::data;

// One centred particle a cell sees the grid through the average of its two nodes: C² s² (1 − s²) = (C/2)² sin² kh, the
// dispersion of FEM with elements twice as long at half the Courant number. A wave that enters at an end node keeps the
// particles of each pair of cells together, so the stresses themselves are those of FEM.
BOOST_DATA_TEST_CASE(musl_on_two_cells_is_fem_on_one, bdata::make({0.5, 0.95, 1.9}), courant) {
  const int elements = 60;
  for (const long steps : {20L, 300L, 1000L}) {
    const Record m =
        mpm::run(step_scene(), 2 * elements, {0.5}, mpm::Scheme::musl, steps_at(courant, 2 * elements, steps));
    const Record f = fem::run(step_scene(), elements, steps_at(courant / 2, elements, steps));
    const auto &particles = m.snapshots.at(0).stress.value, &bars = f.snapshots.at(0).stress.value;
    double largest = 0;
    for (std::size_t e = 0; e < bars.size(); ++e) {
      BOOST_REQUIRE(std::isfinite(bars[e]));
      largest = std::max({largest, std::abs(particles[2 * e] - bars[e]), std::abs(particles[2 * e + 1] - bars[e])});
    }
    BOOST_TEST(largest < 1e-11, "after " << steps << " steps " << largest);
  }
}

// On one grid at one Courant number they are two methods: their difference is of the size of their errors.
BOOST_AUTO_TEST_CASE(on_one_grid_they_differ) {
  const Record m = mpm::run(step_scene(), 100, {0.5}, mpm::Scheme::musl, steps_at(0.5, 100, 100));
  const Record f = fem::run(step_scene(), 100, steps_at(0.5, 100, 100));
  double largest = 0;
  for (std::size_t e = 0; e < 100; ++e) {
    largest = std::max(largest, std::abs(m.snapshots[0].stress.value[e] - f.snapshots[0].stress.value[e]));
  }
  BOOST_TEST(largest > 0.05);
  BOOST_TEST(largest < 1);
}

BOOST_AUTO_TEST_SUITE_END()
