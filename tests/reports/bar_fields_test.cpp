#include "reports/bar_fields.hpp"

#include <boost/test/unit_test.hpp>

#include "reports/results.hpp"

BOOST_AUTO_TEST_SUITE(bar_fields)

using namespace diptych::reports;

BOOST_AUTO_TEST_CASE(a_line_for_each_point_and_time_with_units_above) {
  Case result;
  result.units = "SI";
  result.time_unit = "L/c";
  const BarPoints nodes{"nodes", {1, 2}, {0.0, 0.1}, {{"velocity", {1, -2.5}}, {"displacement", {0, 1e-9}}}, {}};
  const BarPoints elements{"elements", {1}, {0.05}, {{"stress", {3e6}}}, {{"stress", {2e6}}}};
  Run run;
  for (const double time : {0.5, 1.0}) {
    Sample sample;
    sample.asked = time;
    sample.bar_points = {nodes, elements};
    run.samples.push_back(sample);
  }
  BOOST_TEST(bar_fields_csv(result, run, "nodes") ==
             "t [L/c],bar,x [m],displacement [m],velocity [m/s]\n"
             "0.5,1,0,0,1\n0.5,2,0.1,1e-09,-2.5\n1,1,0,0,1\n1,2,0.1,1e-09,-2.5\n");
  result.units = "paper";
  BOOST_TEST(bar_fields_csv(result, run, "elements") ==
             "t [L/c],bar,x [paper units],stress [paper units],exact stress [paper units]\n"
             "0.5,1,0.05,3000000,2000000\n1,1,0.05,3000000,2000000\n");
}

BOOST_AUTO_TEST_SUITE_END()
