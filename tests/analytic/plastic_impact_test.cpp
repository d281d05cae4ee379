// Colliding elastic, perfectly plastic bars: closed forms, conservation laws, the bar of bar_wave.hpp under the force
// of the wall, a small lumped bar that yields; and the self-test against wrong solutions.
#include "analytic/plastic_impact.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "analytic/bar_wave.hpp"
#include "tests/spoiled.hpp"

BOOST_AUTO_TEST_SUITE(plastic_impact)

namespace {

using namespace diptych::analytic;

constexpr double period = 0.01;  // 2L/c of the bars below

/// E = 1e4, ρ = 1, Y = 100, so that Y/(ρc) = 1 and V̂ = V.
PlasticImpact::Parameters parameters(double speed, double gap = 0.5, double centre = 0) {
  return {1e4, 1, 100, 0.5, gap, centre + speed, centre - speed};
}
PlasticImpact impact(double speed, double gap = 0.5, double centre = 0) {
  return PlasticImpact(parameters(speed, gap, centre));
}

void check(double value, double expected, double scale) {
  BOOST_TEST_REQUIRE(std::isfinite(value));
  BOOST_TEST(std::abs(value - expected) <= 1e-11 * scale, value << " instead of " << expected);
}

/// ∫ f(v, σ) dx over both bars by the midpoint rule between fronts, exact as the fields are constant there.
double integral(const PlasticImpact& two, double t, const std::function<double(double, double)>& f) {
  const auto& p = two.parameters();
  double sum = 0;
  for (const double begin : {0.0, p.length + p.gap}) {
    std::vector<double> cuts{begin, begin + p.length};
    for (const auto& front : two.fronts(t))
      if (front.position > begin && front.position < begin + p.length) cuts.insert(cuts.begin() + 1, front.position);
    for (std::size_t i = 1; i < cuts.size(); ++i) {
      constexpr int cells = 7;  // more than one: pieces that are not constant would show
      for (int j = 0; j < cells; ++j) {
        const double width = (cuts[i] - cuts[i - 1]) / cells, x = cuts[i - 1] + (j + 0.5) * width;
        sum += width * f(two.at(BarQuantity::velocity, x, t), two.at(BarQuantity::stress, x, t));
      }
    }
  }
  return sum;
}

using Spoiled = diptych::tests::Spoiled<PlasticImpact>;

/// Lumped linear elements, elastic and perfectly plastic, thrown at a rigid wall that does not pull.
struct Thrown {
  double release, rebound, stress_error;  ///< [s], [m/s], mean |error| of stress until after release [Pa]
};
Thrown thrown_bar(const PlasticImpact& exact, int cells) {
  const auto& p = exact.parameters();
  const double h = p.length / cells, dt = 0.9 * h / exact.wave_speed(), wall = exact.contact_begin();
  const auto n = static_cast<std::size_t>(cells);
  std::vector<double> v(n + 1, p.left_velocity), plastic(n, 0.0), u(n + 1, 0.0), sigma(n, 0.0);
  Thrown result{0, 0, 0};
  const int steps = static_cast<int>(std::ceil((exact.release_time() - wall + period) / dt));
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i <= n; ++i) {
      const double force = (i < n ? sigma[i] : 0) - (i > 0 ? sigma[i - 1] : 0);
      v[i] += dt / (p.density * h) * force * (i == 0 || i == n ? 2 : 1) * (step == 0 ? 0.5 : 1);
    }
    if (u[n] + dt * v[n] >= 0) v[n] = -u[n] / dt, result.release = (step + 1) * dt;  // the wall is at u = 0
    double error = 0;
    for (std::size_t i = 0; i <= n; ++i) u[i] += dt * v[i];
    for (std::size_t i = 0; i < n; ++i) {
      const double trial = p.youngs_modulus * ((u[i + 1] - u[i]) / h - plastic[i]);
      sigma[i] = std::clamp(trial, -p.yield_stress, p.yield_stress);
      plastic[i] += (trial - sigma[i]) / p.youngs_modulus;
      const double there = exact.at(BarQuantity::stress, h * (static_cast<double>(i) + 0.5), wall + (step + 1) * dt);
      error += std::abs(sigma[i] - there) / cells;
    }
    result.stress_error += error / steps;
  }
  for (std::size_t i = 0; i <= n; ++i) result.rebound -= v[i] / cells * (i == 0 || i == n ? 0.5 : 1);
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE(known_impacts) {
  const auto known = [](double speed, double contact, double rebound) {
    const auto two = impact(speed);
    check(two.contact_begin(), 0.25 / speed, 1);
    check(two.release_time() - two.contact_begin(), contact, 1);
    check(two.rebound_velocity(), rebound, 1);
  };
  known(0.8, 0.01, 0.8);
  known(1, 0.01, 1);
  known(1.5, 0.01, 0.5);
  known(2, 0.01, 0);
  known(3, 0.02, 1);
  known(3.1, 0.02, 0.9);
  known(4.6, 0.03, 0.6);
  known(5, 0.03, 1);
}

BOOST_AUTO_TEST_CASE(the_recurrence_sums_up_to_the_closed_form) {
  for (int i = 1; i <= 20000; ++i) {
    const double speed = 60 * std::fmod(i * 0.6180339887498949, 1);
    const auto two = impact(speed, 0);
    const double n = std::ceil(speed / 2), once = speed - 2 * (n - 1);
    BOOST_TEST_REQUIRE(std::abs(two.release_time() - n * period) <= 1e-12);
    BOOST_TEST_REQUIRE(std::abs(two.rebound_velocity() - (once <= 1 ? once : 2 * n - speed)) <= 1e-12);
    BOOST_TEST_REQUIRE(two.rebound_velocity() <= std::min(1.0, speed));
  }
}

BOOST_AUTO_TEST_CASE(an_impact_that_yields_step_by_step) {
  const auto two = impact(3.1, 0);  // arrives at 3.1, 1.1, −0.9: flows twice, then leaves
  const auto state = [&](double depth, double t, double v, double sigma) {
    check(two.at(BarQuantity::velocity, 0.5 - depth, t), v, 1);
    check(two.at(BarQuantity::velocity, 0.5 + depth, t), depth > 0 ? -v : v, 1);
    for (const double x : {0.5 - depth, 0.5 + depth}) check(two.at(BarQuantity::stress, x, t), sigma, 100);
  };
  state(0, 0.004, 2.1, -100);  // the face flows
  state(0.39, 0.004, 2.1, -100);
  state(0.41, 0.004, 3.1, 0);
  state(0.5, 0.004, 3.1, 0);
  state(0, 0.007, 2.1, -100);
  state(0.29, 0.007, 2.1, -100);
  state(0.31, 0.007, 1.1, 0);  // the free end has sent it back
  state(0, 0.013, 0.1, -100);
  state(0.31, 0.013, 1.1, 0);
  state(0.4, 0.018, -0.9, 0);
  state(0.1, 0.018, 0.1, -100);
  for (const double depth : {0.0, 0.1, 0.3, 0.5})
    for (const double t : {0.0201, 0.0257, 0.04, 7.0}) state(depth, t, -0.9, 0);
  check(two.plastic_strain(0.005), 2.1 * 0.005, 1);
  check(two.plastic_strain(0.015), 2.1 * 0.01 + 0.1 * 0.005, 1);
  check(two.plastic_strain(1), 2.2 * 0.01, 1);
  check(two.plastic_work(1), 2 * 100 * 2.2 * 0.01, 1);
  check(two.at(BarQuantity::displacement, 0.5, 0.025), 2.2 * 0.01 - 0.9 * 0.005, 1);
  check(two.at(BarQuantity::displacement, 0, 0.025), 2.2 * 0.01 - 0.9 * 0.005, 1);  // and no strain is left elsewhere
}

BOOST_AUTO_TEST_CASE(fronts_are_listed) {
  const auto two = impact(1.5, 0.5);
  const double begin = two.contact_begin();
  const auto check_front = [](const Front& front, double position, int direction, double jump, double travelled) {
    check(front.position, position, 1);
    BOOST_TEST(front.direction == direction);
    check(front.stress_jump, jump, 100);
    check(front.travelled, travelled, 1);
  };
  BOOST_TEST(two.fronts(begin - 1e-6).empty());
  const auto out = two.fronts(begin + 0.002), back = two.fronts(begin + 0.008);
  BOOST_TEST_REQUIRE(out.size() == 2);
  check_front(out[0], 0.3, -1, -100, 0.2);
  check_front(out[1], 1.2, +1, -100, 0.2);
  BOOST_TEST_REQUIRE(back.size() == 2);
  check_front(back[0], 0.3, +1, 100, 0.8);
  check_front(back[1], 1.2, -1, 100, 0.8);
  BOOST_TEST(two.fronts(begin + 0.0101).empty());
  BOOST_TEST(two.fronts(begin + 0.013).empty());
  check_front(impact(2.4, 0).fronts(0.013).at(0), 0.2, -1, -40, 0.3);  // arrives with 0.4: elastic contact
}

BOOST_AUTO_TEST_CASE(energy_and_momentum_are_conserved) {
  for (const double speed : {0.3, 0.8, 1.0, 1.5, 2.0, 3.1, 4.6, 5.0, 17.3}) {
    const PlasticImpact two({2e11, 7800, 3e8, 0.2, 1e-3, 9.1 + speed * 7.59, 9.1 - speed * 7.59});
    const auto& p = two.parameters();
    const double mass = p.density * p.length,
                 start = mass / 2 * (std::pow(p.left_velocity, 2) + std::pow(p.right_velocity, 2));
    const double until = 1.4 * two.release_time();
    for (int i = 0; i < 300; ++i) {
      const double t = until * std::fmod(i * 0.6180339887498949, 1);
      const double energy = integral(
          two, t, [&](double v, double sigma) { return p.density * v * v / 2 + sigma * sigma / p.youngs_modulus / 2; });
      check(energy + two.plastic_work(t), start, start);
      check(integral(two, t, [&](double v, double) { return p.density * v; }), 2 * mass * 9.1,
            2 * mass * (9.1 + speed * 7.59));
    }
    // what is not plastic work is the motion of the two bars as rigid ones
    const double r = two.rebound_velocity();
    check(mass * (9.1 * 9.1 + r * r) + two.plastic_work(until), start, start);
    BOOST_TEST((two.plastic_work(until) > 0) == (speed > 1));
  }
}

BOOST_AUTO_TEST_CASE(plastic_strain_is_what_flowed_through_the_face) {
  for (const double speed : {0.7, 1.5, 3.1, 4.6, 5.0, 8.8}) {
    const auto two = impact(speed, 0.5, 0.25);
    const double begin = two.contact_begin();
    double flowed = 0;
    constexpr int per_period = 100;
    for (int i = 0; i < 8 * per_period; ++i) {
      const double dt = period / per_period, t = begin + (i + 0.5) * dt;
      const double closing = (two.at(BarQuantity::velocity, 0.5, t) - two.at(BarQuantity::velocity, 1, t)) / 2;
      if (t < two.release_time()) flowed += closing * dt;
      check(two.plastic_strain(begin + (i + 1) * dt), flowed, speed * period);
      // in contact the face is at the wall, 0.25 from where it started, and the material next to it ahead by the strain
      if (t >= two.release_time()) continue;
      const double ahead = two.at(BarQuantity::displacement, 0.5, t) - 0.25 * t - 0.25;
      check(two.plastic_strain(t), ahead, speed * period);
    }
    BOOST_TEST(two.plastic_strain(begin - 0.01) == 0);
    BOOST_TEST((flowed > 0.001) == (speed > 1));
  }
}

BOOST_AUTO_TEST_CASE(it_is_an_elastic_bar_under_the_force_of_the_wall) {
  for (const double speed : {0.7, 1.5, 2.4, 3.1, 5.0}) {
    const auto two = impact(speed, 0);
    Traction wall;
    double last = 0;
    for (int k = 0; k < 6; ++k) {
      const double stress = two.at(BarQuantity::stress, 0.5, (k + 0.5) * period);
      wall.kinks.push_back({k * period, stress - last, 0});
      last = stress;
    }
    BOOST_TEST(last == 0);
    const BarWave bar({1e4, 1, 0.5, {}, {false, wall}});
    for (int i = 1; i < 1000; ++i) {
      const double x = 0.5 * std::fmod(i * 0.7548776662466927, 1),
                   t = 8 * period * std::fmod(i * 0.5698402909980532, 1);
      check(two.at(BarQuantity::stress, x, t), bar.at(BarQuantity::stress, x, t), 100);
      check(two.at(BarQuantity::velocity, x, t), speed + bar.at(BarQuantity::velocity, x, t), speed);
      check(two.at(BarQuantity::displacement, x, t), speed * t + bar.at(BarQuantity::displacement, x, t),
            speed * period);
    }
  }
}

BOOST_AUTO_TEST_CASE(displacement_is_continuous_where_waves_start_and_return) {
  for (const double speed : {0.7, 3.1, 11.7}) {
    const auto two = impact(speed, 0);
    for (const double halves : {1.0, 2.0, 3.0, 4.0, 6.0, 12.0, 14.0})
      for (const double x : {0.0, 0.25, 0.5}) {
        const double t = halves * period / 2, before = two.at(BarQuantity::displacement, x, t - 1e-9);
        BOOST_TEST(std::abs(two.at(BarQuantity::displacement, x, t) - before) <= 1.01e-9 * speed);
      }
  }
}

BOOST_AUTO_TEST_CASE(a_lumped_bar_that_yields_comes_to_it) {
  for (const double speed : {0.8, 1.5, 3.1, 4.6, 5.0}) {
    const auto two = impact(speed);
    const auto coarse = thrown_bar(two, 200), fine = thrown_bar(two, 1600);
    const double contact = two.release_time() - two.contact_begin();
    BOOST_TEST_MESSAGE(speed << ": " << fine.release << " " << fine.rebound << " " << coarse.stress_error << " "
                             << fine.stress_error);
    BOOST_TEST(std::abs(fine.release - contact) < 0.01 * contact);
    BOOST_TEST(std::abs(fine.rebound - two.rebound_velocity()) < 0.02);
    BOOST_TEST(fine.stress_error < 0.55 * coarse.stress_error);
    BOOST_TEST(fine.stress_error < 0.02 * two.scale(BarQuantity::stress));
  }
}

BOOST_AUTO_TEST_CASE(only_relative_motion_matters) {
  const auto still = impact(3.1), moving = impact(3.1, 0.5, -40);
  for (int i = 0; i < 400; ++i) {
    const double t = 0.15 * std::fmod(i * 0.5698402909980532, 1), depth = 0.5 * std::fmod(i * 0.7548776662466927, 1);
    for (const double x : {0.5 - depth, 1 + depth}) {
      check(moving.at(BarQuantity::stress, x, t), still.at(BarQuantity::stress, x, t), 100);
      check(moving.at(BarQuantity::velocity, x, t), still.at(BarQuantity::velocity, x, t) - 40, 40);
      check(moving.at(BarQuantity::displacement, x, t), still.at(BarQuantity::displacement, x, t) - 40 * t, 6);
    }
    // the right bar is the mirror image of the left one
    check(still.at(BarQuantity::velocity, 1 + depth, t), -still.at(BarQuantity::velocity, 0.5 - depth, t), 3.1);
    check(still.at(BarQuantity::stress, 1 + depth, t), still.at(BarQuantity::stress, 0.5 - depth, t), 100);
  }
}

BOOST_AUTO_TEST_CASE(units_scale_exactly) {
  // With powers of two nothing rounds: c doubles, lengths × 8, times × 4, stresses × 1/2, densities × 1/8, velocities
  // × 2.
  const PlasticImpact one({1.3, 0.9, 0.11, 1.7, 0.3, 0.3, -0.21});
  const PlasticImpact other({1.3 / 2, 0.9 / 8, 0.11 / 2, 1.7 * 8, 0.3 * 8, 0.6, -0.42});
  for (int i = 0; i < 300; ++i) {
    const double x = 1.7 * std::fmod(i * 0.618034, 1) + (i % 2 == 0 ? 2 : 0), t = 0.06 * i;
    BOOST_TEST(other.at(BarQuantity::stress, 8 * x, 4 * t) == 0.5 * one.at(BarQuantity::stress, x, t));
    BOOST_TEST(other.at(BarQuantity::velocity, 8 * x, 4 * t) == 2 * one.at(BarQuantity::velocity, x, t));
    BOOST_TEST(other.at(BarQuantity::displacement, 8 * x, 4 * t) == 8 * one.at(BarQuantity::displacement, x, t));
  }
  BOOST_TEST(one.release_time() > one.contact_begin());
  BOOST_TEST(other.release_time() == 4 * one.release_time());
  BOOST_TEST(other.rebound_velocity() == 2 * one.rebound_velocity());
  BOOST_TEST(other.plastic_work(40) == 4 * one.plastic_work(10));
  BOOST_TEST(one.plastic_work(10) > 0);
}

BOOST_AUTO_TEST_CASE(scales) {
  BOOST_TEST(impact(0.5).scale(BarQuantity::stress) == 50);
  BOOST_TEST(impact(4, 0.5, 7).scale(BarQuantity::stress) == 100);
  BOOST_TEST(impact(4, 0.5, 7).scale(BarQuantity::velocity) == 4);
  BOOST_TEST(impact(4, 0.5, 7).scale(BarQuantity::displacement) == 0.02);
}

BOOST_AUTO_TEST_CASE(bad_parameters_are_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const PlasticImpact::Parameters& p) {
    BOOST_CHECK_THROW(PlasticImpact{p}, std::invalid_argument);
  };
  refused({0, 1, 1, 1, 1, 1, 0});
  refused({1, -1, 1, 1, 1, 1, 0});
  refused({1, 1, 0, 1, 1, 1, 0});
  refused({1, 1, 1, nan, 1, 1, 0});
  refused({1, 1, 1, 1, -1e-9, 1, 0});
  refused({1, 1, 1, 1, 1, 0, 0});
  refused({1, 1, 1, 1, 1, 0, 1});
  refused({1, 1, 1, 1, 1, nan, 1});
  refused({1, 1, 1, 1, 1, 20001, -20001});
  const auto two = impact(1.5);
  for (const double x : {-0.01, 0.51, 0.75, 0.99, 1.51, nan})
    BOOST_CHECK_THROW(two.at(BarQuantity::stress, x, 0), std::domain_error);
  for (const double x : {0.0, 0.5, 1.0, 1.5}) BOOST_CHECK_NO_THROW(two.at(BarQuantity::stress, x, 0));
  BOOST_CHECK_THROW(two.at(BarQuantity::stress, 0.5, nan), std::domain_error);
  BOOST_CHECK_THROW(two.plastic_work(nan), std::domain_error);
  BOOST_CHECK_THROW(self_test(two, 0), std::invalid_argument);
  BOOST_CHECK_THROW(self_test(two, nan), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(self_test_passes_right_solutions) {
  for (const double gap : {0.0, 0.5})
    for (const double speed : {0.4, 0.8, 1.5, 2.0, 2.4, 3.1, 4.6, 5.0, 11.7}) {
      const auto two = impact(speed, gap, 3);
      const auto r = self_test(two, two.release_time() + 2 * period);
      BOOST_TEST_REQUIRE(std::isfinite(r.worst()));
      BOOST_TEST(r.worst() < 1e-9);
      BOOST_TEST(r.points > 3000);
      BOOST_TEST(r.fronts > 10);
    }
}

BOOST_AUTO_TEST_CASE(self_test_fails_wrong_solutions) {
  const auto two = impact(3.1);
  const double end = two.release_time() + 2 * period;
  const auto same = [two](BarQuantity q, double x, double t) { return two.at(q, x, t); };
  const auto of = [&](const Spoiled::At& at) { return self_test(Spoiled(two, at), two.parameters(), end); };
  BOOST_TEST(of(same).worst() < 1e-9);  // what follows is not the wrapper's fault
  const auto times = [two](BarQuantity which, double factor) {
    return [=](BarQuantity q, double x, double t) { return (q == which ? factor : 1) * two.at(q, x, t); };
  };
  BOOST_TEST(of(times(BarQuantity::velocity, 1.01)).initial > 1e-3);
  BOOST_TEST(of(times(BarQuantity::stress, 1.01)).boundary > 1e-3);
  BOOST_TEST(of(times(BarQuantity::stress, 0.99)).compatibility > 1e-3);
  BOOST_TEST(of(times(BarQuantity::displacement, 1.01)).compatibility > 1e-3);
  BOOST_TEST(of([](BarQuantity, double, double) { return 0.0; }).initial > 0.1);

  Spoiled ghosts(two, [two](BarQuantity q, double x, double t) {  // they pass through each other
    const double v = x < 0.75 ? 3.1 : -3.1;
    return q == BarQuantity::stress ? 0 : q == BarQuantity::velocity ? v : v * t;
  });
  ghosts.spoil_fronts = [](std::vector<Front>) { return std::vector<Front>{}; };
  BOOST_TEST(self_test(ghosts, two.parameters(), end).boundary > 0.1);

  // right solutions of other problems
  const auto other = [&](double speed, double yield, double gap, double length) {
    auto p = two.parameters();
    p.left_velocity *= speed, p.right_velocity *= speed, p.yield_stress *= yield, p.gap *= gap, p.length *= length;
    return self_test(PlasticImpact(p), two.parameters(), end);
  };
  BOOST_TEST(other(1, 1, 1, 1).worst() < 1e-9);
  BOOST_TEST(other(1.01, 1, 1, 1).initial > 1e-3);
  BOOST_TEST(other(1, 1.01, 1, 1).boundary > 1e-3);
  BOOST_TEST(other(1, 100, 1, 1).boundary > 0.1);  // elastic
  auto heavy = two.parameters();
  heavy.density *= 1.01;
  BOOST_TEST(self_test(PlasticImpact(heavy), two.parameters(), end).jump > 1e-3);

  // rings on after release, or is let go too early: what the wall would do is then wrong
  const auto continued = [two, end](double at_release) {
    return [=](BarQuantity q, double x, double t) {
      const double stop = two.release_time() - at_release;
      return t < stop ? two.at(q, x, t) : two.at(q, x, stop - 2 * period + std::fmod(t - stop, 2 * period));
    };
  };
  BOOST_TEST(of(continued(0)).worst() > 0.1);
  BOOST_TEST(of(continued(period)).worst() > 0.1);

  const auto mutated = [&](std::function<std::vector<Front>(std::vector<Front>)> spoil) {
    Spoiled wrong(two, same);
    wrong.spoil_fronts = std::move(spoil);
    return self_test(wrong, two.parameters(), end).jump;
  };
  const auto each = [](void (*change)(Front&)) {
    return [change](std::vector<Front> fronts) {
      for (auto& front : fronts) change(front);
      return fronts;
    };
  };
  BOOST_TEST(mutated(each([](Front&) {})) < 1e-9);
  BOOST_TEST(mutated([](std::vector<Front>) { return std::vector<Front>{}; }) > 0.1);
  BOOST_TEST(mutated([](std::vector<Front> f) {
               f.push_back({0.25, 1, 0, 0.5});
               return f;
             }) > 1);
  BOOST_TEST(mutated(each([](Front& f) { f.stress_jump *= 1.01; })) > 1e-3);
  BOOST_TEST(mutated(each([](Front& f) { f.direction = -f.direction; })) > 0.1);
  BOOST_TEST(mutated(each([](Front& f) { f.travelled += 1e-3; })) > 0.1);
  BOOST_TEST(mutated(each([](Front& f) { f.position += 1e-3; })) > 0.1);
}

BOOST_AUTO_TEST_CASE(self_test_reports_what_it_could_not_see) {
  const auto two = impact(3.1, 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Spoiled late(two, [=](BarQuantity q, double x, double t) { return t > 0.03 ? nan : two.at(q, x, t); });
  const auto r = self_test(late, two.parameters(), 0.04);
  for (const double value : {r.momentum, r.compatibility, r.jump, r.boundary, r.worst()}) BOOST_TEST(std::isnan(value));
  const auto blind = self_test(two, 1e-9);  // too short to difference, no front inside
  BOOST_TEST(blind.points == 0);
  for (const double value : {blind.momentum, blind.compatibility, blind.worst()}) BOOST_TEST(value > 1);
}

BOOST_AUTO_TEST_SUITE_END()
