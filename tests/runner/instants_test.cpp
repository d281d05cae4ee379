// Sample times: the steps that meet them, and what is read between two steps.
#include "runner/run/instants.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

BOOST_AUTO_TEST_SUITE(instants)

using namespace diptych;
using namespace diptych::runner;
namespace tt = boost::test_tools;

namespace {

Plan plan(const std::vector<double>& instants, double asked, Meet meet = Meet::all, Read read = Read::all) {
  return plan_steps(instants, {asked, 1, 1}, meet, read, Books::off);
}

/// A bar of one point that stands at f at its own times: leapfrog's, or USF's.
std::vector<Snapshot> snapshots(long last, double dt, bool usf, double (*stress)(double), double (*velocity)(double),
                                double (*displacement)(double)) {
  std::vector<Snapshot> all;
  for (long n = 0; n <= last; ++n) {
    const double time = static_cast<double>(n) * dt, half = dt / 2;
    Snapshot s;
    s.step = n;
    s.stress.time = usf ? std::max(time - half, half) : time;
    s.velocity.time = usf ? time : std::max(time - half, 0.0);
    s.displacement.time = usf ? time + half : time;
    s.stress.value = {stress(s.stress.time)};
    s.velocity.value = {velocity(s.velocity.time)};
    s.displacement.value = {displacement(s.displacement.time)};
    all.push_back(s);
  }
  return all;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_step_meets_all_instants_where_a_little_less_does) {
  const Plan met = plan({0.4, 0.6, 0.8}, 0.0097);  // 82.5 steps; 84 meet all
  BOOST_TEST(met.stepping.steps == 84);
  BOOST_TEST(met.nearest == (std::vector<long>{42, 63, 84}), tt::per_element());
  BOOST_TEST(plan({0.4, 0.6, 0.8}, 0.0097, Meet::last).stepping.steps == 83);
  BOOST_TEST(plan({0.37, 1.0}, 0.0097).stepping.steps == 104);  // of 100 parts: too many
  BOOST_TEST(plan({0.35, 1.0}, 0.01).stepping.steps == 100);    // fits as it is
  BOOST_TEST(plan({0.355, 1.0}, 0.01).stepping.steps == 100);   // fits the end, and so it stays
  BOOST_TEST(plan({0.355, 1.0}, 0.0101).stepping.steps == 100);
  BOOST_TEST(plan({1.0 / 3, 1.0}, 0.001).stepping.steps == 1000);
  BOOST_TEST(plan({1.0 / 3, 1.0}, 0.00101).stepping.steps == 993);  // 991 are needed
  BOOST_TEST(plan({2.0}, 0.3).stepping.steps == 7);
}

BOOST_AUTO_TEST_CASE(samples_stand_around_every_instant) {
  const Plan p = plan({0.2, 3.2, 3.7, 10.0}, 1);
  BOOST_TEST(p.stepping.steps == 10);
  BOOST_TEST(p.nearest == (std::vector<long>{1, 3, 4, 10}), tt::per_element());
  BOOST_TEST(p.stepping.sample_after == (std::vector<long>{0, 1, 2, 3, 4, 5, 9, 10, 11}), tt::per_element());
  const Plan whole = plan({0.2, 3.2, 3.7, 10.0}, 1, Meet::all, Read::whole);
  BOOST_TEST(whole.stepping.sample_after == (std::vector<long>{0, 1, 3, 4, 10}), tt::per_element());
  const Plan close = plan({4.0, 4.1, 10.0}, 1);  // two on one step
  BOOST_TEST(close.nearest == (std::vector<long>{4, 4, 10}), tt::per_element());
  BOOST_TEST(close.own_steps() == (std::vector<long>{4, 10}), tt::per_element());
}

BOOST_AUTO_TEST_CASE(what_stands_at_an_instant_is_read_to_the_bit) {
  const auto all = snapshots(4, 0.1, false, std::exp, std::sin, std::cos);
  const Snapshot at = at_instant(all, 2, 0.1, 0.2);
  BOOST_TEST(at.stress.value[0] == all[2].stress.value[0]);
  BOOST_TEST(at.displacement.value[0] == all[2].displacement.value[0]);
  BOOST_TEST(at.velocity.value[0] == (std::sin(0.15) + std::sin(0.25)) / 2, tt::tolerance(1e-14));
  for (const Field* field : {&at.stress, &at.velocity, &at.displacement}) BOOST_TEST(field->time == 0.2);
}

BOOST_AUTO_TEST_CASE(between_steps_what_grows_evenly_is_exact) {
  for (const bool usf : {false, true}) {
    const auto all = snapshots(
        9, 0.1, usf, [](double t) { return 3 * t - 1; }, [](double t) { return 2 - 9 * t; },
        [](double t) { return 5 + 2 * t; });
    for (const double t : {0.02, 0.05, 0.13, 0.17, 0.2, 0.249, 0.8}) {
      const Snapshot at = at_instant(all, std::max(1L, std::lround(t / 0.1)), 0.1, t);
      BOOST_TEST_CONTEXT("t = " << t << (usf ? ", USF" : "")) {
        BOOST_TEST(at.stress.value[0] == 3 * t - 1, tt::tolerance(1e-12));
        BOOST_TEST(at.velocity.value[0] == 2 - 9 * t, tt::tolerance(1e-12));
      }
    }
  }
}

// u = ½bt² is met at whole steps by the leapfrog, and half a step beside them by USF with ⅛bΔt² too little.
BOOST_AUTO_TEST_CASE(a_falling_body_is_where_it_should_be) {
  for (const bool usf : {false, true}) {
    const auto all = snapshots(
        9, 0.1, usf, [](double) { return 0.0; }, [](double t) { return 9 * t; }, [](double t) { return 4.5 * t * t; });
    for (const double t : {0.02, 0.05, 0.1, 0.13, 0.17, 0.249, 0.8}) {
      auto those = all;
      for (Snapshot& s : those) s.displacement.value[0] -= usf ? 9 * 0.01 / 8 : 0;
      const Snapshot at = at_instant(those, std::max(1L, std::lround(t / 0.1)), 0.1, t);
      BOOST_TEST(at.displacement.value[0] == 4.5 * t * t, tt::tolerance(1e-12));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_plate_is_read_likewise) {
  std::vector<PlateSnapshot> all;
  for (const long n : {1, 2, 3}) {
    const double time = 0.1 * static_cast<double>(n);
    PlateSnapshot s;
    s.step = n;
    s.time = s.stress.time = s.displacement.time = time;
    s.velocity.time = time - 0.05;
    s.displacement.component = {{4.5 * time * time}, {0}};
    s.velocity.component = {{9 * s.velocity.time}, {0}};
    s.stress.component = {{time}, {2 * time}, {3 * time}};
    s.crack_density = {time};
    s.concentration = {10 * time};
    s.volumetric_strain = {-time};
    s.strain = {{time, 0, 2 * time}};
    all.push_back(s);
  }
  const PlateSnapshot at = at_instant(all, 2, 0.1, 0.23);
  BOOST_TEST(at.time == 0.23);
  BOOST_TEST(at.displacement.component[0][0] == 4.5 * 0.23 * 0.23, tt::tolerance(1e-12));
  BOOST_TEST(at.velocity.component[0][0] == 9 * 0.23, tt::tolerance(1e-12));
  BOOST_TEST(at.stress.component[2][0] == 0.69, tt::tolerance(1e-12));
  BOOST_TEST(at.crack_density[0] == 0.23, tt::tolerance(1e-12));
  BOOST_TEST(at.concentration[0] == 2.3, tt::tolerance(1e-12));
  BOOST_TEST(at.volumetric_strain[0] == -0.23, tt::tolerance(1e-12));
  BOOST_TEST(at.strain[0].xy == 0.46, tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_history_is_read_between_its_times) {
  BOOST_TEST(at_instant({1, 2, 4}, {10, 20, 60}, 3) == 40);
  BOOST_TEST(at_instant({1, 2, 4}, {10, 20, 60}, 2) == 20);
  BOOST_TEST(std::isnan(at_instant({}, {}, 2)));
}

BOOST_AUTO_TEST_SUITE_END()
