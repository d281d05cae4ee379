#include "hinge/step/touches.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

BOOST_AUTO_TEST_SUITE(touches)

using namespace diptych;

BOOST_AUTO_TEST_CASE(each_pair_of_bars_touches_and_parts_on_its_own) {
  Touches touches;
  BOOST_TEST(!touches.last(0));
  touches.begin(0, 1);
  touches.begin(1, 2);
  BOOST_TEST((touches.last(0) && touches.last(1) && !touches.last(2)));
  touches.end(0, 3);
  touches.begin(0, 4);
  touches.end(2, 5);  // never began
  BOOST_REQUIRE_EQUAL(touches.all().size(), 3u);
  const auto &first = touches.all()[0], &other = touches.all()[1], &again = touches.all()[2];
  BOOST_TEST((first.left == 0 && first.from == 1 && first.to == 3));
  BOOST_TEST((other.left == 1 && other.from == 2 && std::isinf(other.to)));
  BOOST_TEST((again.left == 0 && again.from == 4 && std::isinf(again.to)));
  touches.end(0, 6);
  BOOST_TEST((touches.all()[0].to == 3 && touches.all()[2].to == 6 && !touches.last(0)));
}

BOOST_AUTO_TEST_SUITE_END()
