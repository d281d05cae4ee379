// What the table of exact solutions of bars says of what it does not know.
#include "analytic/bar_solutions.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(bar_solutions)

using namespace diptych::analytic;

/// Whatever a law is called: what counts is the curve that the fronts run on.
BOOST_AUTO_TEST_CASE(bars_of_impacts_have_a_straight_or_bilinear_curve) {
  BarSetting setting;
  setting.bars = {{0, 1, 1e4, 1, 0.5}, {1, 1, 1e4, 1, -0.5}};
  setting.laws = {"new", "new"};
  setting.flies = true;
  for (const BarSolution& row : diptych::analytic::bar_solutions()) {
    if (row.name != "impact") continue;
    BOOST_TEST(row.misfits(setting).empty());
    setting.curved = {"new"};
    BOOST_REQUIRE_EQUAL(row.misfits(setting).size(), 1u);
    BOOST_TEST(row.misfits(setting)[0].find("together with material.model = \"new\"; allowed: ") == 0u);
  }
}

/// That of one bar at rest is elastic, and a new law is not that.
BOOST_AUTO_TEST_CASE(waves_of_one_bar_are_elastic) {
  BarSetting setting;
  setting.bars = {{0, 1, 1e4, 1, 0}};
  setting.laws = {"new"};
  long refused = 0;
  for (const BarSolution& row : diptych::analytic::bar_solutions()) {
    const std::vector<std::string> found = row.misfits(setting);
    refused += std::count_if(found.begin(), found.end(), [](const std::string& misfit) {
      return misfit.find("material.model = \"new\"; its waves are elastic") != std::string::npos;
    });
  }
  BOOST_TEST(refused == 2);  // bar-wave and standing-mode
}

BOOST_AUTO_TEST_SUITE_END()
