// The bar of the oracle against known values, conservation laws and symmetries; its self-test against wrong bars.
#include "analytic/bar_wave.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/spoiled.hpp"

BOOST_AUTO_TEST_SUITE(bar_wave)

namespace {

using namespace diptych::analytic;

const BarEnd held{true, {}};
const BarEnd free_end{};
BarEnd loaded(Traction traction) { return {false, std::move(traction)}; }

BarWave fixed_free() { return BarWave({1e4, 1, 1, held, loaded(Traction::step(1))}); }  // c = 100
BarWave both_loaded(const Traction& f) { return BarWave({1e4, 1, 1, loaded(f), loaded(f)}); }

/// Compares on the scale of the solution: a tolerance relative to an expected zero would be none.
void check(const BarWave& bar, BarQuantity quantity, double x, double t, double expected) {
  const double value = bar.at(quantity, x, t);
  BOOST_TEST_REQUIRE(std::isfinite(value));
  BOOST_TEST(std::abs(value - expected) <= 1e-12 * bar.scale(quantity),
             "at x = " << x << ", t = " << t << ": " << value << " instead of " << expected);
}

void check_whole_bar(const BarWave& bar, BarQuantity quantity, double t, double expected) {
  for (int i = 0; i < 20; ++i) check(bar, quantity, bar.parameters().length * (i + 0.5) / 20, t, expected);
}

using Spoiled = diptych::tests::Spoiled<BarWave>;

Residual residual_of(const ExactSolution& wrong) { return self_test(wrong, problem(fixed_free().parameters()), 0.07); }

/// Kinetic and strain energy by the midpoint rule, exact for constant pieces that end between cells.
double energy(const BarWave& bar, double t, int cells) {
  const auto& p = bar.parameters();
  double sum = 0;
  for (int i = 0; i < cells; ++i) {
    const double x = p.length * (i + 0.5) / cells;
    const double v = bar.at(BarQuantity::velocity, x, t), sigma = bar.at(BarQuantity::stress, x, t);
    sum += (p.density * v * v + sigma * sigma / p.youngs_modulus) / 2 * p.length / cells;
  }
  return sum;
}

/// ∫ f v dt at both ends by the midpoint rule.
double work(const BarWave& bar, double t, int steps) {
  const auto& p = bar.parameters();
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double s = t * (i + 0.5) / steps;
    sum += p.right.traction.value(s) * bar.at(BarQuantity::velocity, p.length, s) * t / steps;
    sum -= p.left.traction.value(s) * bar.at(BarQuantity::velocity, 0, s) * t / steps;
  }
  return sum;
}

}  // namespace

BOOST_AUTO_TEST_CASE(tractions) {
  const auto step = Traction::step(3, 2), ramp = Traction::ramp(3, 4, 2), impulse = Traction::impulse(3, 4, 2);
  BOOST_TEST(step.value(1.999) == 0);
  BOOST_TEST(step.value(2) == 3);
  BOOST_TEST(step.integral(4) == 6);
  BOOST_TEST(ramp.value(2) == 0);
  BOOST_TEST(ramp.value(4) == 1.5);
  BOOST_TEST(ramp.value(60) == 3);
  BOOST_TEST(ramp.integral(4) == 1.5);
  BOOST_TEST(ramp.integral(10) == 18);
  BOOST_TEST(impulse.value(5.999) == 3);
  BOOST_TEST(impulse.value(6) == 0);
  BOOST_TEST(impulse.integral(100) == 12);
  BOOST_CHECK_THROW(Traction::ramp(1, 0), std::invalid_argument);
  BOOST_CHECK_THROW(Traction::impulse(1, -1), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(step_on_fixed_free_bar) {
  const auto bar = fixed_free();
  BOOST_TEST(bar.wave_speed() == 100);
  for (const double period : {0.0, 0.04, 0.08}) {  // 4L/c
    check_whole_bar(bar, BarQuantity::stress, period + 1e-9, 0);
    check(bar, BarQuantity::stress, 0, period + 0.0099, 0);
    check(bar, BarQuantity::stress, 0, period + 0.0101, 2);  // doubles at the wall at ct = L
    check(bar, BarQuantity::stress, 0.25, period + 0.0101, 1);
    check_whole_bar(bar, BarQuantity::stress, period + 0.02 - 1e-9, 2);
    check(bar, BarQuantity::displacement, 1, period + 0.02, 2e-4);  // 2fL/E
    check(bar, BarQuantity::displacement, 1, period + 0.03, 1e-4);
    check(bar, BarQuantity::displacement, 1, period + 0.04, 0);
    check_whole_bar(bar, BarQuantity::velocity, period + 0.01 - 1e-9, 0.01);  // f/(ρc)
    check(bar, BarQuantity::displacement, 0.5, period + 0.01, 0.5e-4);
    check(bar, BarQuantity::stress, 1, period + 0.033, 1);
  }
}

BOOST_AUTO_TEST_CASE(steps_on_both_ends) {
  const auto bar = both_loaded(Traction::step(1));
  const double lc = 0.01;
  for (const double period : {0.0, 2 * lc, 4 * lc}) {
    check(bar, BarQuantity::stress, 0.5, period + 0.499 * lc, 0);
    check(bar, BarQuantity::stress, 0.5, period + 0.501 * lc, 2);
    check(bar, BarQuantity::stress, 0.5, period + 1.499 * lc, 2);
    check(bar, BarQuantity::stress, 0.5, period + 1.501 * lc, 0);
    for (const double t : {0.1 * lc, 0.7 * lc, 1.3 * lc, 1.9 * lc})
      for (const double x : {0.0, 1.0}) check(bar, BarQuantity::stress, x, period + t, 1);
    for (const double t : {0.3 * lc, 0.9 * lc, 1.7 * lc}) check(bar, BarQuantity::displacement, 0.5, period + t, 0);
  }
}

BOOST_AUTO_TEST_CASE(compressive_impulse_returns_as_tension) {
  const double lc = 0.01;
  const auto bar = both_loaded(Traction::impulse(-1, lc));
  check(bar, BarQuantity::stress, 0.5, 0.8 * lc, -2);
  for (const double period : {0.0, 2 * lc, 4 * lc}) {
    check_whole_bar(bar, BarQuantity::stress, period + 1.5 * lc, 0);
    check(bar, BarQuantity::stress, 0.5, period + 1.6 * lc, 2);
    check_whole_bar(bar, BarQuantity::stress, period + 2 * lc - 1e-9, 2);
    check_whole_bar(bar, BarQuantity::stress, period + 2.5 * lc, 0);
    check_whole_bar(bar, BarQuantity::stress, period + 3 * lc - 1e-9, -2);
  }
  check_whole_bar(bar, BarQuantity::stress, lc - 1e-9, -2);
}

BOOST_AUTO_TEST_CASE(free_body_moves_as_a_rigid_one_in_the_mean) {
  const BarWave bar({2e9, 7.8e3, 0.3, loaded(Traction::impulse(5e6, 1e-4)), free_end});
  const double c = bar.wave_speed(), t = 6 * 0.3 / c;
  BOOST_TEST_REQUIRE(t > 1e-4);
  double momentum = 0;
  for (int i = 0; i < 6000; ++i)
    momentum += 7.8e3 * bar.at(BarQuantity::velocity, 0.3 * (i + 0.5) / 6000, t) * 0.3 / 6000;
  BOOST_TEST(momentum == -5e6 * 1e-4, boost::test_tools::tolerance(1e-3));  // two jumps, each within one of 6000 cells
}

BOOST_AUTO_TEST_CASE(fronts_are_listed) {
  const auto bar = fixed_free();
  BOOST_TEST(bar.fronts(0).empty());
  const auto check_front = [&](double t, double position, int direction, double jump, double travelled) {
    const auto fronts = bar.fronts(t);
    BOOST_TEST_REQUIRE(fronts.size() == 1);
    BOOST_TEST(fronts[0].position == position, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(fronts[0].direction == direction);
    BOOST_TEST(fronts[0].stress_jump == jump);
    BOOST_TEST(fronts[0].travelled == travelled, boost::test_tools::tolerance(1e-12));
  };
  check_front(0.0025, 0.75, -1, 1, 0.25);
  check_front(0.0125, 0.25, +1, 1, 1.25);
  check_front(0.0225, 0.75, -1, -1, 2.25);
  check_front(0.0325, 0.25, +1, -1, 3.25);
  check_front(0.0425, 0.75, -1, 1, 4.25);

  const auto meeting = both_loaded(Traction::step(1)).fronts(0.005);
  BOOST_TEST_REQUIRE(meeting.size() == 2);
  for (const auto& front : meeting) {
    BOOST_TEST(front.position == 0.5, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(front.stress_jump == 1);
  }
  BOOST_TEST(meeting[0].direction + meeting[1].direction == 0);

  const auto impulse = both_loaded(Traction::impulse(-1, 0.002)).fronts(0.003);
  BOOST_TEST_REQUIRE(impulse.size() == 4);
  for (std::size_t i = 1; i < impulse.size(); ++i) BOOST_TEST(impulse[i - 1].position <= impulse[i].position);
  BOOST_TEST(impulse[0].stress_jump == 1);
  BOOST_TEST(impulse[1].stress_jump == -1);
  BOOST_TEST(both_loaded(Traction::ramp(1, 0.002)).fronts(0.003).empty());
}

BOOST_AUTO_TEST_CASE(mirror_images) {
  const auto f = Traction::impulse(3, 0.004, 0.001);
  const BarWave right({1e4, 1, 1, held, loaded(f)}), left({1e4, 1, 1, loaded(f), held});
  for (int i = 1; i < 400; ++i) {
    const double t = 0.001 * i * 0.2137, x = std::fmod(i * 0.618034, 1);
    for (const auto& [quantity, sign] :
         {std::pair{BarQuantity::stress, 1}, {BarQuantity::velocity, -1}, {BarQuantity::displacement, -1}})
      check(left, quantity, 1 - x, t, sign * right.at(quantity, x, t));
  }
}

BOOST_AUTO_TEST_CASE(units_scale_exactly) {
  // With powers of two nothing rounds: c doubles, lengths × 8, times × 4, stresses × 1/2, densities × 2.
  const auto load = [](double f, double t) {
    auto traction = Traction::ramp(0.7 * f, 0.13 * t, 0.05 * t);
    traction.kinks.push_back({0.4 * t, -1.1 * f, 0});
    return loaded(traction);
  };
  const BarWave one({1.3, 0.9, 1.7, load(1, 1), loaded(Traction::step(0.3))});
  const BarWave other({1.3 * 8, 0.9 * 2, 1.7 * 8, load(0.5, 4), loaded(Traction::step(0.15))});
  for (int i = 0; i < 300; ++i) {
    const double x = 1.7 * std::fmod(i * 0.618034, 1), t = 0.03 * i;
    BOOST_TEST(other.at(BarQuantity::stress, 8 * x, 4 * t) == 0.5 * one.at(BarQuantity::stress, x, t));
    BOOST_TEST(other.at(BarQuantity::velocity, 8 * x, 4 * t) == 0.125 * one.at(BarQuantity::velocity, x, t));
    BOOST_TEST(other.at(BarQuantity::displacement, 8 * x, 4 * t) == 0.5 * one.at(BarQuantity::displacement, x, t));
  }
  BOOST_TEST(other.scale(BarQuantity::displacement) == 0.5 * one.scale(BarQuantity::displacement));
}

BOOST_AUTO_TEST_CASE(work_of_the_tractions_becomes_energy) {
  for (const auto& [left, right] : {std::pair{held, loaded(Traction::step(3e5))},
                                    {loaded(Traction::step(-2e5)), loaded(Traction::step(3e5))},
                                    {free_end, loaded(Traction::step(1e5))}}) {
    const BarWave bar({2e9, 7.8e3, 0.3, left, right});
    const double scale = 9e10 / 2e9 * 0.3;
    for (const double ct : {0.15, 0.45, 0.75, 1.05, 1.95}) {  // fronts between the cells of the quadrature
      const double t = ct * 0.3 / bar.wave_speed();
      const double moved = right.traction.value(t) * bar.at(BarQuantity::displacement, 0.3, t) -
                           left.traction.value(t) * bar.at(BarQuantity::displacement, 0, t);
      const double stored = energy(bar, t, 100);
      BOOST_TEST_REQUIRE(stored > 0);
      BOOST_TEST(std::abs(moved - stored) <= 1e-9 * scale);
    }
  }
  const double rise = 3e-4;
  const BarWave ramp({2e9, 7.8e3, 0.3, held, loaded(Traction::ramp(3e5, rise))});
  for (const double t : {0.5 * rise, 1.5 * rise, 4 * rise, 9 * rise})
    BOOST_TEST(work(ramp, t, 20000) == energy(ramp, t, 4000), boost::test_tools::tolerance(1e-5));
}

BOOST_AUTO_TEST_CASE(scales) {
  const BarWave bar({4, 1, 3, loaded(Traction::impulse(-5, 1)), loaded(Traction::ramp(2, 1))});
  BOOST_TEST(bar.scale(BarQuantity::stress) == 5);
  BOOST_TEST(bar.scale(BarQuantity::velocity) == 2.5);
  BOOST_TEST(bar.scale(BarQuantity::displacement) == 3.75);
  Traction sawtooth{{{0, 0, 2}, {3, -6, -2}}};  // sup on the near side of a jump
  BOOST_TEST(BarWave({4, 1, 3, held, loaded(sawtooth)}).scale(BarQuantity::stress) == 6);
}

BOOST_AUTO_TEST_CASE(bad_parameters_are_refused) {
  const auto f = loaded(Traction::step(1));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](BarWave::Parameters p) { BOOST_CHECK_THROW(BarWave{std::move(p)}, std::invalid_argument); };
  refused({0, 1, 1, held, f});
  refused({1, -1, 1, held, f});
  refused({1, 1, nan, held, f});
  refused({1, 1, 1, held, held});
  refused({1, 1, 1, held, free_end});
  refused({1, 1, 1, held, loaded(Traction::step(0))});
  refused({1, 1, 1, BarEnd{true, Traction::step(1)}, f});
  refused({1, 1, 1, held, loaded(Traction::step(1, -1))});
  refused({1, 1, 1, held, loaded(Traction::step(nan))});
  refused({1, 1, 1, held, loaded({{{0, 0, 1}}})});
  const auto bar = fixed_free();
  BOOST_CHECK_THROW(bar.at(BarQuantity::stress, 1.1, 0), std::domain_error);
  BOOST_CHECK_THROW(bar.at(BarQuantity::stress, nan, 0), std::domain_error);
  BOOST_CHECK_THROW(bar.at(BarQuantity::stress, 0.5, nan), std::domain_error);
  BOOST_CHECK_THROW(self_test(bar, 0), std::invalid_argument);
  BOOST_CHECK_THROW(self_test(bar, nan), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(self_test_passes_right_solutions) {
  const auto right = [](const BarWave& bar, double crossings, bool has_fronts) {
    const auto r = self_test(bar, crossings * bar.parameters().length / bar.wave_speed());
    BOOST_TEST_REQUIRE(std::isfinite(r.worst()));
    BOOST_TEST(r.worst() < 1e-9);
    BOOST_TEST(r.points > 2000);
    BOOST_TEST((r.fronts > 400) == has_fronts);
  };
  right(fixed_free(), 7, true);
  right(both_loaded(Traction::step(1)), 7, true);
  right(both_loaded(Traction::impulse(-1, 0.003)), 7, true);
  right(BarWave({2e9, 7.8e3, 0.3, loaded(Traction::step(-4e6, 1e-4)), held}), 11, true);
  right(BarWave({2e9, 7.8e3, 0.3, loaded(Traction::ramp(4e6, 2e-4)), free_end}), 5, false);
  auto mixed = Traction::ramp(2, 0.7);
  mixed.kinks.push_back({0.3, 5, 0});
  right(BarWave({1, 1, 1, loaded(mixed), loaded(Traction::impulse(1, 0.45))}), 6, true);
}

BOOST_AUTO_TEST_CASE(self_test_fails_wrong_solutions) {
  const auto bar = fixed_free();
  const auto same = [bar](BarQuantity q, double x, double t) { return bar.at(q, x, t); };
  BOOST_TEST(residual_of(Spoiled(bar, same)).worst() < 1e-9);  // what follows is not the wrapper's fault

  const auto of = [&](const Spoiled::At& at) { return residual_of(Spoiled(bar, at)); };
  const auto times = [bar](BarQuantity which, double factor) {
    return [=](BarQuantity q, double x, double t) { return (q == which ? factor : 1) * bar.at(q, x, t); };
  };
  const auto velocity_reversed = of(times(BarQuantity::velocity, -1));
  BOOST_TEST(velocity_reversed.jump > 0.1);
  BOOST_TEST(velocity_reversed.compatibility > 0.1);
  BOOST_TEST(velocity_reversed.boundary < 1e-9);
  BOOST_TEST(of(times(BarQuantity::stress, 1.01)).boundary > 1e-3);
  BOOST_TEST(of(times(BarQuantity::stress, 1.01)).compatibility > 1e-3);
  BOOST_TEST(of(times(BarQuantity::displacement, 0.99)).compatibility > 1e-3);
  BOOST_TEST(of([=](BarQuantity q, double x, double t) {
               return bar.at(q, x, t) + (q == BarQuantity::displacement ? 1e-6 : 0);
             }).initial > 1e-3);
  BOOST_TEST(of([](BarQuantity, double, double) { return 0.0; }).boundary == 1);

  // a wrong modulus, a wrong end, a late load, a missing reflection: each a right solution of another problem
  const auto other = [](const BarWave& wrong) { return residual_of(wrong); };
  const BarWave stiff({1.01e4, 1, 1, held, loaded(Traction::step(1))});
  BOOST_TEST(other(stiff).jump > 1e-3);
  BOOST_TEST(other(stiff).compatibility > 1e-3);
  BOOST_TEST(other(BarWave({1e4, 1, 1, free_end, loaded(Traction::step(1))})).boundary > 0.1);
  BOOST_TEST(other(BarWave({1e4, 1, 1, held, loaded(Traction::step(1, 1e-4))})).jump > 0.1);
  BOOST_TEST(other(BarWave({1e4, 1, 1, held, loaded(Traction::step(1.01))})).boundary > 1e-3);
  BOOST_TEST(other(BarWave({1e4, 1, 1, loaded(Traction::step(1)), held})).boundary > 0.1);
  const BarWave long_bar({1e4, 1, 2, held, loaded(Traction::step(1))});
  BOOST_TEST(of([=](BarQuantity q, double x, double t) { return long_bar.at(q, x + 1, t); }).boundary > 0.1);

  const auto mutated = [&](std::function<std::vector<Front>(std::vector<Front>)> spoil) {
    Spoiled wrong(bar, same);
    wrong.spoil_fronts = std::move(spoil);
    return residual_of(wrong).jump;
  };
  const auto each = [](void (*change)(Front&)) {
    return [change](std::vector<Front> fronts) {
      for (auto& front : fronts) change(front);
      return fronts;
    };
  };
  BOOST_TEST(mutated([](std::vector<Front>) { return std::vector<Front>{}; }) > 1);
  BOOST_TEST(mutated([](std::vector<Front> f) {
               f.push_back({0.5, 1, 0, 0.5});
               return f;
             }) > 1);
  BOOST_TEST(mutated(each([](Front& f) { f.stress_jump = -f.stress_jump; })) > 0.1);
  BOOST_TEST(mutated(each([](Front& f) { f.direction = -f.direction; })) > 0.1);
  BOOST_TEST(mutated(each([](Front& f) { f.travelled += 1e-3; })) > 0.1);
  BOOST_TEST(mutated(each([](Front& f) { f.position += 1e-3; })) > 0.1);
}

BOOST_AUTO_TEST_CASE(self_test_reports_what_it_could_not_see) {
  const auto bar = fixed_free();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto late_nan = [=](BarQuantity q, double x, double t) { return t > 0.06 ? nan : bar.at(q, x, t); };
  const auto r = residual_of(Spoiled(bar, late_nan));
  for (const double value : {r.momentum, r.compatibility, r.jump, r.boundary, r.worst()}) BOOST_TEST(std::isnan(value));
  const auto blind = self_test(bar, 1e-9);  // too short to difference, no front inside
  BOOST_TEST(blind.points == 0);
  for (const double value : {blind.momentum, blind.compatibility, blind.worst()}) BOOST_TEST(value > 1);
  Traction twice = Traction::step(1);
  twice.kinks.push_back(twice.kinks.front());
  const auto never_alone = self_test(BarWave({1e4, 1, 1, held, loaded(twice)}), 0.07);
  BOOST_TEST(never_alone.fronts == 0);
  BOOST_TEST(never_alone.jump > 1);
  BOOST_TEST(Residual{}.worst() > 1);
}

BOOST_AUTO_TEST_SUITE_END()
