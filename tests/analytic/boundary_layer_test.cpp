#include "analytic/boundary_layer.hpp"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

BOOST_AUTO_TEST_SUITE(boundary_layer)

using diptych::analytic::end_stress_share;
namespace tt = boost::test_tools;

BOOST_AUTO_TEST_CASE(shares_by_hand) {
  BOOST_TEST(end_stress_share({0.5}, 1) == 0.5, tt::tolerance(1e-15));         // one centred particle
  BOOST_TEST(end_stress_share({0.25}, 1) == 0.75, tt::tolerance(1e-15));       // near the end
  BOOST_TEST(end_stress_share({0.25, 0.75}, 1) == 0.5, tt::tolerance(1e-15));  // ½·¾ + ½·¼
  BOOST_TEST(end_stress_share({0.5}, 2) == 0.25, tt::tolerance(1e-15));        // half the layer lies in the next cell
  BOOST_TEST(end_stress_share({0.25, 0.75}, 0.5) == 0.75, tt::tolerance(1e-15));  // the outer particle alone
  BOOST_TEST(end_stress_share({0.0}, 1) == 1.0, tt::tolerance(1e-15));            // on the end node: no error
}

BOOST_AUTO_TEST_CASE(nonsense_is_refused) {
  BOOST_CHECK_THROW(end_stress_share({}, 1), std::invalid_argument);
  BOOST_CHECK_THROW(end_stress_share({0.5}, 0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
