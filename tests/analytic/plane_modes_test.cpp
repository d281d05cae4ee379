// The standing modes of the plane against their equations, and the self-test against wrong modes.
#include "analytic/plane_modes.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "tests/spoiled_plane.hpp"

BOOST_AUTO_TEST_SUITE(plane_modes)

namespace {

using namespace diptych::analytic;
using boost::test_tools::tolerance;
using BarQuantity = PlaneQuantity;
constexpr double pi = std::numbers::pi;

using Spoiled = diptych::tests::SpoiledPlane;

const PlaneMedium strain = plane_medium(50e9, 0.3, 2500, false), stress = plane_medium(50e9, 0.3, 2500, true);

/// Calls f with every mode, its problem and the time of a period.
template <class F>
void for_all_modes(const F& f) {
  for (const auto& medium : {strain, stress}) {
    for (const bool from_rest : {true, false}) {
      for (const int n : {1, 3}) {
        const SquareMode square{medium, 1.3, n, -2e-3, from_rest};
        const RectangleMode rectangle{medium, 1.3, 0.7, n, -2e-3, from_rest};
        f(LameMode(square), LameMode(square).problem());
        f(RollerMode(square), RollerMode(square).problem());
        f(StandingPWave(rectangle), StandingPWave(rectangle).problem());
        f(StandingSWave(rectangle), StandingSWave(rectangle).problem());
      }
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(media) {
  BOOST_TEST(strain.mu == 50e9 / 2.6, tolerance(1e-15));
  BOOST_TEST(strain.lambda == 0.3 * 50e9 / (1.3 * 0.4), tolerance(1e-15));
  BOOST_TEST(stress.lambda == 2 * strain.lambda * strain.mu / (strain.lambda + 2 * strain.mu), tolerance(1e-15));
  BOOST_TEST(stress.lambda + 2 * stress.mu == 50e9 / (1 - 0.09), tolerance(1e-15));
  BOOST_TEST(std::round(strain.pressure_speed()) == 5189);
  BOOST_TEST(std::round(stress.pressure_speed()) == 4688);
  BOOST_TEST(std::round(strain.shear_speed()) == 2774);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_THROW(plane_medium(0, 0.3, 1, false), std::invalid_argument);
  BOOST_CHECK_THROW(plane_medium(1, 0.5, 1, false), std::invalid_argument);
  BOOST_CHECK_THROW(plane_medium(1, nan, 1, false), std::invalid_argument);
  BOOST_CHECK_THROW(plane_medium(1, 0.3, -1, false), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(known_values) {
  const PlaneMedium medium{1.5, 1, 2};
  const double side = 2, k = pi / side;
  const LameMode lame({medium, side, 1, 0.1, true});
  BOOST_TEST(lame.wave().frequency == std::sqrt(2.0) * k * std::sqrt(0.5), tolerance(1e-15));
  BOOST_TEST(lame.at(BarQuantity::displacement, 0, 1, 0)[0] == 0.1, tolerance(1e-15));
  BOOST_TEST(lame.at(BarQuantity::displacement, 1, 0, 0)[1] == -0.1, tolerance(1e-15));
  BOOST_TEST(lame.at(BarQuantity::stress, 1, 1, 0)[0] == -2 * 0.1 * k, tolerance(1e-15));
  BOOST_TEST(lame.at(BarQuantity::stress, 1, 1, 0)[1] == 2 * 0.1 * k, tolerance(1e-15));
  const RollerMode roller({medium, side, 1, 0.1, false});
  BOOST_TEST(roller.wave().frequency == std::sqrt(2.0) * k * std::sqrt(1.75), tolerance(1e-15));
  const double quarter = pi / 2 / roller.wave().frequency;
  BOOST_TEST(roller.at(BarQuantity::displacement, 1, 0, quarter)[0] == 0.1, tolerance(1e-14));
  BOOST_TEST(roller.at(BarQuantity::displacement, 0, 1, quarter)[1] == 0.1, tolerance(1e-14));
  BOOST_TEST(roller.at(BarQuantity::velocity, 1, 0, 0)[0] == 0.1 * roller.wave().frequency, tolerance(1e-15));
  BOOST_TEST(roller.at(BarQuantity::stress, 0, 0, quarter)[0] == (2 * 1.5 + 2) * 0.1 * k, tolerance(1e-14));
  BOOST_TEST(roller.at(BarQuantity::stress, 1, 1, quarter)[2] == -2 * 0.1 * k, tolerance(1e-14));
  const StandingPWave p({medium, side, 0.5, 3, 0.1, true});
  BOOST_TEST(p.wave().frequency == 3 * k * std::sqrt(1.75), tolerance(1e-15));
  BOOST_TEST(p.at(BarQuantity::stress, 0, 0.2, 0)[0] == 3.5 * 0.3 * k, tolerance(1e-15));
  BOOST_TEST(p.at(BarQuantity::stress, 0, 0.2, 0)[1] == 1.5 * 0.3 * k, tolerance(1e-15));
  const StandingSWave s({medium, side, 0.5, 3, 0.1, true});
  BOOST_TEST(s.wave().frequency == 3 * k * std::sqrt(0.5), tolerance(1e-15));
  BOOST_TEST(s.at(BarQuantity::displacement, 0, 0.3, 0)[1] == 0.1, tolerance(1e-15));
  BOOST_TEST(s.at(BarQuantity::stress, 1.0 / 3 * side, 0.3, 0)[2] == 0.0 - 0.3 * k * std::sin(pi), tolerance(1e-13));
  BOOST_TEST(s.at(BarQuantity::stress, side / 6, 0.3, 0)[2] == -0.3 * k, tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(scales_are_the_largest_values) {
  for_all_modes([](const PlaneMode& mode, const PlaneProblem&) {
    for (const auto q : {BarQuantity::displacement, BarQuantity::velocity, BarQuantity::stress}) {
      double largest = 0;
      for (int i = 0; i <= 12; ++i) {
        for (int j = 0; j <= 12; ++j) {
          for (const int quarter : {0, 1}) {
            const double t = quarter * pi / 2 / mode.wave().frequency;
            for (const double c : mode.at(q, mode.width() * i / 12, mode.height() * j / 12, t))
              largest = std::max(largest, std::abs(c));
          }
        }
      }
      BOOST_TEST(largest == mode.scale(q), tolerance(1e-12));
    }
    BOOST_TEST(!mode.gives(BarQuantity::concentration));
    BOOST_CHECK_THROW(mode.scale(BarQuantity::concentration), std::invalid_argument);
    BOOST_CHECK_THROW(mode.at(BarQuantity::concentration, 0, 0, 0), std::invalid_argument);
  });
}

BOOST_AUTO_TEST_CASE(lames_mode_has_no_part_of_lambda_and_no_shear) {
  const LameMode a({strain, 1, 2, 1e-3, true}), b({stress, 1, 2, 1e-3, true});
  for (int i = 0; i < 20; ++i) {
    const double x = std::fmod(0.37 * i, 1), y = std::fmod(0.71 * i, 1), t = 1e-5 * i;
    for (const auto q : {BarQuantity::displacement, BarQuantity::velocity, BarQuantity::stress}) {
      const auto one = a.at(q, x, y, t), other = b.at(q, x, y, t);
      for (const std::size_t c : {0, 1, 2}) BOOST_TEST(std::abs(one[c] - other[c]) <= 1e-14 * a.scale(q));
    }
    BOOST_TEST(a.at(BarQuantity::stress, x, y, t)[2] == 0);
  }
}

BOOST_AUTO_TEST_CASE(energy_is_constant) {
  for_all_modes([](const PlaneMode& mode, const PlaneProblem&) {
    const auto energy = [&](double t) {
      const auto [lambda, mu, density] = mode.medium();
      double sum = 0;
      for (int i = 0; i < 16; ++i) {
        for (int j = 0; j < 16; ++j) {  // the midpoint rule is exact for these trigonometric polynomials
          const double x = mode.width() * (i + 0.5) / 16, y = mode.height() * (j + 0.5) / 16;
          const auto v = mode.at(BarQuantity::velocity, x, y, t), s = mode.at(BarQuantity::stress, x, y, t);
          const double mean = (s[0] + s[1]) / 2, half = (s[0] - s[1]) / 2;
          sum += density * (v[0] * v[0] + v[1] * v[1]) / 2 + mean * mean / (2 * (lambda + mu)) +
                 (half * half + s[2] * s[2]) / (2 * mu);
        }
      }
      return sum;
    };
    for (const double t : {1e-5, 7e-5, 1e-3}) BOOST_TEST(energy(t) == energy(0), tolerance(1e-12));
  });
}

BOOST_AUTO_TEST_CASE(bad_parameters_are_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const SquareMode& p) {
    BOOST_CHECK_THROW(LameMode{p}, std::invalid_argument);
    BOOST_CHECK_THROW(RollerMode{p}, std::invalid_argument);
    BOOST_CHECK_THROW(StandingPWave({p.medium, p.side, 1, p.mode, p.amplitude}), std::invalid_argument);
    BOOST_CHECK_THROW(StandingSWave({p.medium, p.side, 1, p.mode, p.amplitude}), std::invalid_argument);
  };
  refused({{1, 0, 1}, 1, 1, 1});
  refused({{nan, 1, 1}, 1, 1, 1});
  refused({{-1, 1, 1}, 1, 1, 1});
  refused({{1, 1, 0}, 1, 1, 1});
  refused({{1, 1, 1}, 0, 1, 1});
  refused({{1, 1, 1}, 1, 0, 1});
  refused({{1, 1, 1}, 1, 1, 0});
  refused({{1, 1, 1}, 1, 1, nan});
  BOOST_CHECK_THROW(StandingPWave({{1, 1, 1}, 1, -1, 1, 1}), std::invalid_argument);
  const RollerMode mode({{1, 1, 1}, 1, 1, 1});
  BOOST_CHECK_THROW(mode.at(BarQuantity::stress, -0.1, 0.5, 0), std::domain_error);
  BOOST_CHECK_THROW(mode.at(BarQuantity::stress, 0.5, 1.1, 0), std::domain_error);
  BOOST_CHECK_THROW(mode.at(BarQuantity::stress, 0.5, nan, 0), std::domain_error);
  BOOST_CHECK_THROW(mode.at(BarQuantity::stress, 0.5, 0.5, nan), std::domain_error);
  BOOST_CHECK_THROW(self_test(mode, RollerMode({{1, 1, 1}, 1, 1, 1}).problem(), 0), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(self_test_passes_right_modes) {
  for_all_modes([](const PlaneMode& mode, const PlaneProblem& problem) {
    const auto r = self_test(mode, problem, 3 * 2 * pi / mode.wave().frequency);
    BOOST_TEST_REQUIRE(std::isfinite(r.worst()));
    BOOST_TEST(r.worst() < 1e-10, mode.name() << ' ' << r.worst());  // round-off over the step of the differences
    BOOST_TEST(r.points > 1800);
  });
}

BOOST_AUTO_TEST_CASE(s_waves_may_have_free_sides) {
  const RectangleMode p{strain, 1, 0.5, 2, 1e-3, false};
  auto problem = StandingSWave(p).problem();
  problem.left.support = problem.right.support = PlaneProblem::Support::free;
  BOOST_TEST(self_test(StandingSWave(p), problem, 1e-3).worst() < 1e-10);
  problem.bottom.support = PlaneProblem::Support::free;
  BOOST_TEST(self_test(StandingSWave(p), problem, 1e-3).boundary > 0.1);
}

BOOST_AUTO_TEST_CASE(self_test_fails_wrong_modes) {
  const SquareMode p{strain, 1, 2, 1e-3, true};
  const auto pass = [](const PlaneResidual& r) { return r.worst() < 1e-10; };
  for (const bool free : {true, false}) {
    const auto problem = free ? LameMode(p).problem() : RollerMode(p).problem();
    const LameMode lame(p);
    const RollerMode roller(p);
    const PlaneMode& mode = free ? static_cast<const PlaneMode&>(lame) : roller;
    const PlaneMode& other = free ? static_cast<const PlaneMode&>(roller) : lame;
    const double period = 2 * pi / mode.wave().frequency;
    const auto residual = [&](const PlaneSolution& wrong) { return self_test(wrong, problem, 2 * period); };
    const auto scaled = [&](BarQuantity q, std::size_t component, double factor) {
      return residual(Spoiled([=, &mode](BarQuantity asked, double x, double y, double t) {
        auto value = mode.at(asked, x, y, t);
        if (asked == q) value[component] *= factor;
        return value;
      }));
    };
    BOOST_TEST(pass(scaled(BarQuantity::stress, 0, 1)));
    for (const std::size_t c : {0, 1}) {
      BOOST_TEST(scaled(BarQuantity::stress, c, 1.01).constitutive > 1e-3);
      BOOST_TEST(scaled(BarQuantity::stress, c, 1.01).momentum > 1e-3);
      BOOST_TEST(scaled(BarQuantity::velocity, c, 1.01).compatibility > 1e-3);
      BOOST_TEST(scaled(BarQuantity::velocity, c, 1.01).momentum > 1e-3);
      BOOST_TEST(scaled(BarQuantity::displacement, c, 1.01).initial > 1e-3);
      BOOST_TEST(scaled(BarQuantity::displacement, c, 1.01).compatibility > 1e-3);
    }
    if (!free) BOOST_TEST(scaled(BarQuantity::stress, 2, 1.01).constitutive > 1e-3);  // Lamé's has no shear stress
    BOOST_TEST(residual(other).boundary > 0.1);
    BOOST_TEST(residual(other).initial > 0.1);
    const auto of = [&](SquareMode changed) {
      return free ? residual(LameMode(changed)) : residual(RollerMode(changed));
    };
    SquareMode wrong = p;
    wrong.from_rest = false;
    BOOST_TEST(of(wrong).initial > 0.1);
    wrong = p;
    wrong.mode = 3;
    BOOST_TEST(of(wrong).initial > 0.1);
    wrong = p;
    wrong.medium.mu *= 1.01;
    BOOST_TEST(of(wrong).constitutive > 1e-3);
    wrong = p;
    wrong.medium.density *= 1.01;
    BOOST_TEST(of(wrong).momentum > 1e-3);
    if (!free) {
      wrong = p;
      wrong.medium.lambda *= 1.01;
      BOOST_TEST(of(wrong).constitutive > 1e-3);
    }
    const auto turned = residual(Spoiled([&](BarQuantity q, double x, double y, double t) {
      const auto value = mode.at(q, y, x, t);  // both modes are their own mirror image in x = y, with a sign for Lamé's
      return q == BarQuantity::stress ? std::array<double, 3>{value[1], value[0], value[2]}
                                      : std::array<double, 3>{value[1], value[0], 0};
    }));
    BOOST_TEST(pass(turned) == !free);
    BOOST_TEST(std::isnan(residual(Spoiled([](BarQuantity, double, double, double) {
                            return std::array<double, 3>{std::nan(""), 0, 0};
                          })).worst()));
    auto tiny = problem;
    tiny.width = 1e-4;
    BOOST_TEST(std::isinf(self_test(mode, tiny, period).worst()));
  }
}

BOOST_AUTO_TEST_SUITE_END()
