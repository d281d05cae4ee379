#include "hinge/scene/plate_check.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>
#include <stdexcept>
#include <string>

#include "fem/plate.hpp"
#include "mpm/plate.hpp"
#include "tests/plate_records.hpp"

BOOST_AUTO_TEST_SUITE(plate_check)

using namespace diptych;

namespace {

const double not_a_number = std::numeric_limits<double>::quiet_NaN(),
             infinite = std::numeric_limits<double>::infinity();
const Cells cells{4, 2};

Plate plate() {
  Plate p;
  p.width = 4;
  p.height = 2;
  p.solid = solid::Elastic{{1e4, 0.3, 1, material::Plane::strain}};
  return p;
}

/// By the check and by both panels, in the same words.
template <class Change>
void refused(Change&& change, const std::string& words, const Cells& n = cells) {
  Plate p = plate();
  change(p);
  const Stepping stepping = steps_of(1e-6, 1);
  const auto says = [&](const std::invalid_argument& e) {
    return std::string(e.what()).find(words) != std::string::npos;
  };
  BOOST_CHECK_EXCEPTION(check(p, n), std::invalid_argument, says);
  BOOST_CHECK_EXCEPTION(fem::run(p, n, stepping), std::invalid_argument, says);
  BOOST_CHECK_EXCEPTION(mpm::run(p, n, {0.5}, mpm::Scheme::musl, stepping), std::invalid_argument, says);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_good_plate_passes) {
  BOOST_CHECK_NO_THROW(check(plate(), cells));
  Plate p = plate();
  p.impact = Impact{1, 3, 0.5};
  p.gauges = {{0, 0}, {4, 2}};
  p.edge(Side::top).normal_traction = [](double, double) { return 1.0; };
  BOOST_CHECK_NO_THROW(check(p, cells));
}

BOOST_AUTO_TEST_CASE(solids_that_contradict_themselves) {
  const material::PlaneElastic thin{1e4, 0.3, 1, material::Plane::stress}, thick{1e4, 0.3, 1};
  refused([&](Plate& p) { p.solid = solid::Elastic{thin, material::Compression{1, 1}}; }, "for plane strain only");
  refused([&](Plate& p) { p.solid = solid::Cracking{{thin}, {}, material::Compression{1, 1}}; }, "plane strain only");
  refused([&](Plate& p) { p.solid = solid::Failing{{thin, 0, 1}}; }, "plane strain only");
  for (const double threshold : {-1.0, not_a_number})
    refused([&](Plate& p) { p.solid = solid::Failing{{thick, threshold, 1}}; }, "threshold of a failure wave");
  for (const double part : {-0.1, 1.1, not_a_number})
    refused([&](Plate& p) { p.solid = solid::Failing{{thick, 0, part}}; }, "between 0 and 1");
  material::TensileDamage damage{thick};
  damage.flaw_density = -1;
  refused([&](Plate& p) { p.solid = solid::Cracking{damage}; }, "crack coefficient");
}

BOOST_AUTO_TEST_CASE(viscosity_beside_what_it_is_not_for) {
  const material::PlaneElastic thick{1e4, 0.3, 1};
  refused([](Plate& p) { p.viscosity = material::Viscosity{material::Viscosity::Form::linear_quadratic}; }, "eq. 21");
  refused(
      [&](Plate& p) {
        p.viscosity.emplace();
        p.solid = solid::Cracking{{thick}};
      },
      "not beside tensile damage");
  refused(
      [&](Plate& p) {
        p.viscosity.emplace();
        p.solid = solid::Elastic{thick, material::Compression{1, 1}};
      },
      "not beside tensile damage or plasticity");
}

BOOST_AUTO_TEST_CASE(impacts) {
  for (const double face : {0.0, 4.0, -1.0, 5.0, not_a_number, infinite})
    refused([=](Plate& p) { p.impact = Impact{face, 1, 0}; }, "inside the plate");
  for (const double face : {1.5, 1 + 1e-6}) refused([=](Plate& p) { p.impact = Impact{face, 1, 0}; }, "1 to 3 cells");
  for (const double v : {0.0, -1.0, not_a_number, infinite})
    refused([=](Plate& p) { p.impact = Impact{1, v, 0}; }, "the flyer's velocity");
  for (const double gap : {-1e-9, not_a_number, infinite})
    refused([=](Plate& p) { p.impact = Impact{1, 1, gap}; }, "gap");
  refused(
      [](Plate& p) {
        p.impact = Impact{1, 1, 0};
        p.initial_velocity = [](double, double) { return Vector{}; };
      },
      "beside an initial velocity");
}

BOOST_AUTO_TEST_CASE(gauges_cells_and_sides) {
  for (const Gauge& g : {Gauge{-0.1, 1}, {4.1, 1}, {1, -0.1}, {1, 2.1}, {not_a_number, 1}, {1, not_a_number}})
    refused([=](Plate& p) { p.gauges = {{1, 1}, g}; }, "a gauge stands in the plate");
  refused([](Plate&) {}, "at least one cell", {0, 2});
  refused([](Plate& p) { p.edge(Side::top).support = Edge::Support::driven; }, "a driven side needs its velocity");
  refused(
      [](Plate& p) {
        p.edge(Side::left).support = p.edge(Side::right).support = Edge::Support::fixed;
        p.edge(Side::top).support = Edge::Support::platen;
      },
      "a platen whose nodes are all held", {1, 2});
}

BOOST_AUTO_TEST_CASE(sides_and_components) {
  BOOST_TEST(
      (across(Side::left) == 0 && across(Side::right) == 0 && across(Side::bottom) == 1 && across(Side::top) == 1));
  BOOST_TEST((outward(Side::left) == -1 && outward(Side::bottom) == -1));
  BOOST_TEST((outward(Side::right) == 1 && outward(Side::top) == 1));
}

BOOST_AUTO_TEST_SUITE_END()
