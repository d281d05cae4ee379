// The standing mode of the oracle against its equations, and its self-test against wrong modes.
#include "analytic/standing_mode.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "tests/spoiled.hpp"

BOOST_AUTO_TEST_SUITE(standing_mode)

namespace {

using namespace diptych::analytic;
constexpr double pi = std::numbers::pi;

constexpr std::pair<bool, bool> supports[] = {{true, false}, {false, true}, {true, true}, {false, false}};

using Spoiled = diptych::tests::Spoiled<StandingMode>;

}  // namespace

BOOST_AUTO_TEST_CASE(known_values) {
  const StandingMode mode({1e4, 1, 2, true, false, 1, -0.01});  // c = 100, kL = π/2, period 4L/c = 0.08
  BOOST_TEST(mode.wave_number() == pi / 4, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(mode.at(BarQuantity::displacement, 2, 0.02) == -0.01, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(mode.at(BarQuantity::stress, 0, 0.02) == -1e4 * 0.01 * pi / 4, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(mode.at(BarQuantity::velocity, 2, 0) == -100 * pi / 4 * 0.01, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(std::abs(mode.at(BarQuantity::displacement, 2, 0.04)) < 1e-14 * 0.01 * 10);
  BOOST_TEST(mode.scale(BarQuantity::displacement) == 0.01);
  BOOST_TEST(mode.scale(BarQuantity::stress) == 1e4 * 0.01 * pi / 4, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(mode.scale(BarQuantity::velocity) == 100 * 0.01 * pi / 4, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(mode.fronts(0.01).empty());
}

BOOST_AUTO_TEST_CASE(wave_numbers_and_ends) {
  for (const auto& [left, right] : supports) {
    for (const int m : {1, 2, 7}) {
      const StandingMode mode({2e9, 7.8e3, 0.3, left, right, m, 1e-5});
      BOOST_TEST(mode.wave_number() * 0.3 == (left == right ? m * pi : (m - 0.5) * pi),
                 boost::test_tools::tolerance(1e-14));
      for (const double t : {1e-6, 3.3e-5, 1e-3}) {
        for (const auto& [x, fixed] : {std::pair{0.0, left}, {0.3, right}}) {
          const auto vanishing = fixed ? BarQuantity::displacement : BarQuantity::stress;
          BOOST_TEST(std::abs(mode.at(vanishing, x, t)) <= 1e-13 * mode.scale(vanishing));
          if (fixed)
            BOOST_TEST(std::abs(mode.at(BarQuantity::velocity, x, t)) <= 1e-13 * mode.scale(BarQuantity::velocity));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(energy_is_constant) {
  const StandingMode mode({2e9, 7.8e3, 0.3, false, true, 3, 1e-5});
  const double whole = 2e9 * std::pow(1e-5 * mode.wave_number(), 2) * 0.3 / 4;
  for (const double t : {0.0, 1e-5, 7e-5, 1e-3}) {
    double sum = 0;
    for (int i = 0; i < 50; ++i) {  // the midpoint rule is exact for these trigonometric polynomials
      const double x = 0.3 * (i + 0.5) / 50, v = mode.at(BarQuantity::velocity, x, t),
                   s = mode.at(BarQuantity::stress, x, t);
      sum += (7.8e3 * v * v + s * s / 2e9) / 2 * 0.3 / 50;
    }
    BOOST_TEST(sum == whole, boost::test_tools::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(bad_parameters_are_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](StandingMode::Parameters p) { BOOST_CHECK_THROW(StandingMode{p}, std::invalid_argument); };
  refused({0, 1, 1, true, true, 1, 1});
  refused({1, nan, 1, true, true, 1, 1});
  refused({1, 1, -1, true, true, 1, 1});
  refused({1, 1, 1, true, true, 0, 1});
  refused({1, 1, 1, true, true, 1, 0});
  const StandingMode mode({1, 1, 1, true, true, 1, 1});
  BOOST_CHECK_THROW(mode.at(BarQuantity::stress, -0.1, 0), std::domain_error);
  BOOST_CHECK_THROW(mode.at(BarQuantity::stress, 0.5, nan), std::domain_error);
  BOOST_CHECK_THROW(self_test(mode, -1), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(self_test_passes_right_modes) {
  for (const auto& [left, right] : supports) {
    for (const int m : {1, 4}) {
      const StandingMode mode({2e9, 7.8e3, 0.3, left, right, m, -2e-5});
      const auto r = self_test(mode, 3e-3);
      BOOST_TEST_REQUIRE(std::isfinite(r.worst()));
      BOOST_TEST(r.worst() < 1e-9);
      BOOST_TEST(r.points > 3000);
      BOOST_TEST(r.fronts == 0);
    }
  }
}

BOOST_AUTO_TEST_CASE(self_test_fails_wrong_modes) {
  const StandingMode::Parameters p{1e4, 1, 1, true, false, 2, 1e-3};
  const StandingMode mode(p);
  const auto residual = [&](const ExactSolution& wrong) { return self_test(wrong, problem(p), 0.1); };
  const auto of = [&](const Spoiled::At& at) { return residual(Spoiled(mode, at)); };
  const auto same = [=](BarQuantity q, double x, double t) { return mode.at(q, x, t); };
  BOOST_TEST(of(same).worst() < 1e-9);

  const double late = pi / 2 / (mode.wave_number() * mode.wave_speed());
  const auto released = of([=](BarQuantity q, double x, double t) { return mode.at(q, x, t + late); });  // u ~ cos(ωt)
  BOOST_TEST(released.initial > 0.1);
  BOOST_TEST(released.momentum < 1e-9);
  BOOST_TEST(of([=](BarQuantity q, double x, double t) {
               return (q == BarQuantity::velocity ? -1 : 1) * mode.at(q, x, t);
             }).compatibility > 0.1);
  const auto soft_stress =
      of([=](BarQuantity q, double x, double t) { return (q == BarQuantity::stress ? 0.99 : 1) * mode.at(q, x, t); });
  BOOST_TEST(soft_stress.momentum > 1e-3);
  BOOST_TEST(soft_stress.compatibility > 1e-3);
  BOOST_TEST(residual(StandingMode({1.01e4, 1, 1, true, false, 2, 1e-3})).compatibility > 1e-3);
  BOOST_TEST(residual(StandingMode({1e4, 1.01, 1, true, false, 2, 1e-3})).momentum > 1e-3);
  BOOST_TEST(residual(StandingMode({1e4, 1, 1, true, true, 2, 1e-3})).boundary > 0.1);
  BOOST_TEST(residual(StandingMode({1e4, 1, 1, false, false, 2, 1e-3})).boundary > 0.1);
  BOOST_TEST(residual(StandingMode({1e4, 1, 1, true, false, 3, 1e-3})).initial > 0.1);
  BOOST_TEST(residual(StandingMode({1e4, 1, 1, true, false, 2, 1.01e-3})).initial > 1e-3);
  BOOST_TEST(of([](BarQuantity, double, double) { return 0.0; }).initial > 0.1);
  BOOST_TEST(std::isnan(of([](BarQuantity, double, double) { return std::nan(""); }).worst()));

  Spoiled with_front(mode, same);
  with_front.spoil_fronts = [](std::vector<Front>) { return std::vector<Front>{{0.5, 1, 1.0, 0.5}}; };
  BOOST_TEST(residual(with_front).jump > 1);
}

BOOST_AUTO_TEST_SUITE_END()
