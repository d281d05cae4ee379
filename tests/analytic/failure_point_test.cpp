// The closed forms of the failure wave at a point, against the table of the reconstruction, energies and symmetries.
#include "analytic/failure_point.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

BOOST_AUTO_TEST_SUITE(failure_point)

namespace {

namespace analytic = diptych::analytic;
using namespace diptych::analytic;
using boost::test_tools::tolerance;
const double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double K = 43.7e9, G = 29.8e9;

/// Of the whole solid, by Hooke's law as it is usually written.
double energy(double exx, double eyy, double exy) {
  const double lambda = K - 2 * G / 3, trace = exx + eyy;
  return lambda * trace * trace / 2 + G * (exx * exx + eyy * eyy + 2 * exy * exy);
}

struct Strain {
  double xx, yy, xy;
};

/// V_d at which f of the shear energy has been converted, in tension too: there the second time that p² is what it was.
double dilatancy(const Strain& e, double f) {
  const double p = -K * (e.xx + e.yy), shear = energy(e.xx, e.yy, e.xy) - p * p / (2 * K);
  return (std::sqrt(p * p + 2 * K * f * shear) - p) / K;
}

/// Fixed ones and random ones, of the order of 0.05.
template <class F>
void for_strains(const F& f) {
  for (const Strain& e : {Strain{-0.06, 0, 0},
                          {0, -0.06, 0},
                          {-0.04, -0.04, 0},
                          {0, 0, 0.03},
                          {-0.03, 0.03, 0.01},
                          {0.05, 0.02, -0.01},
                          {-0.02, 0.08, 0}})
    f(e);
  std::mt19937 random(20021);
  std::uniform_real_distribution<double> value(-0.06, 0.06);
  for (int i = 0; i < 200; ++i) {
    const double xx = value(random), yy = value(random), xy = value(random);
    f(Strain{xx, yy, xy});
  }
}

FailurePoint at(const Strain& e, double V_d, double f_max = 1) {
  return analytic::failure_point(K, G, e.xx, e.yy, e.xy, V_d, f_max);
}

}  // namespace

BOOST_AUTO_TEST_CASE(table_of_the_reconstruction) {
  struct Line {
    double f, pressure, longitudinal, lateral, dilatancy;
  };
  const UniaxialFailure ratio(K, G);
  for (const Line& line : {Line{0.1, 1.0445, 0.9989, 1.124, 0.0445},
                           {0.3, 1.1282, 0.9893, 1.371, 0.1282},
                           {0.5, 1.2061, 0.9685, 1.622, 0.2061},
                           {0.7, 1.2792, 0.9309, 1.889, 0.2792},
                           {1.0, 1.3817, 0.7237, 2.534, 0.3817}}) {
    BOOST_TEST(std::abs(ratio.pressure(line.f) - line.pressure) < 0.51e-4);
    BOOST_TEST(std::abs(ratio.longitudinal(line.f) - line.longitudinal) < 0.51e-4);
    BOOST_TEST(std::abs(ratio.lateral(line.f) - line.lateral) < 0.51e-3);
    BOOST_TEST(std::abs(ratio.dilatancy(line.f) - line.dilatancy) < 0.51e-4);
    // and the point itself, compressed by 6 %; at f = 1 a square root takes half of the digits
    const double close = line.f == 1 ? 1e-7 : 1e-13;
    const double e = 0.06;
    const auto whole = at({-e, 0, 0}, 0), failed = at({-e, 0, 0}, e * ratio.dilatancy(line.f));
    BOOST_TEST(failed.converted == line.f, tolerance(1e-13));
    BOOST_TEST(failed.pressure / whole.pressure == ratio.pressure(line.f), tolerance(1e-14));
    BOOST_TEST(failed.xx / whole.xx == ratio.longitudinal(line.f), tolerance(close));
    BOOST_TEST(failed.yy / whole.yy == ratio.lateral(line.f), tolerance(close));
    BOOST_TEST(failed.zz == failed.yy, tolerance(1e-14));
    BOOST_TEST(failed.xy == 0);
    BOOST_TEST(at({-e, 0, 0}, 0, line.f).ceiling == e * ratio.dilatancy(line.f), tolerance(1e-14));
  }
  BOOST_TEST(ratio.elastic_ratio() == at({-0.01, 0, 0}, 0).yy / at({-0.01, 0, 0}, 0).xx, tolerance(1e-14));
  BOOST_TEST(std::abs(ratio.elastic_ratio() - 0.286) < 5e-4);
  BOOST_TEST(ratio.pressure(0) == 1);
  BOOST_TEST(ratio.longitudinal(0) == 1, tolerance(1e-15));
  BOOST_TEST(ratio.lateral(0) == 1, tolerance(1e-15));
  BOOST_TEST(ratio.dilatancy(0) == 0);
}

BOOST_AUTO_TEST_CASE(slopes) {
  const UniaxialFailure ratio(K, G);
  BOOST_TEST(ratio.longitudinal_slope(0) == 0);
  BOOST_TEST(ratio.lateral_slope(0) == G, tolerance(1e-15));
  BOOST_TEST(std::isinf(ratio.longitudinal_slope(1)));
  // by differences of the point, Richardson twice: at f = 0 from one side, V_d of f from the pressure's table
  const double e = 0.06;
  const auto stress = [&](double f) { return at({-e, 0, 0}, e * ratio.dilatancy(f)); };
  const auto slope = [](const std::function<double(double)>& f, double at_f, double d) {
    const auto once = [&](double h) { return (-3 * f(at_f) + 4 * f(at_f + h) - f(at_f + 2 * h)) / (2 * h); };
    const auto twice = [&](double h) { return (4 * once(h / 2) - once(h)) / 3; };
    return (8 * twice(d / 2) - twice(d)) / 7;
  };
  for (const double f : {0.0, 0.2, 0.5}) {
    const double longitudinal = -slope([&](double x) { return stress(x).xx; }, f, 0.02) / e;
    const double lateral = -slope([&](double x) { return stress(x).yy; }, f, 0.02) / e;
    BOOST_TEST(std::abs(longitudinal - ratio.longitudinal_slope(f)) < 1e-7 * G, longitudinal / G);
    BOOST_TEST(lateral == ratio.lateral_slope(f), tolerance(1e-7));
  }
}

BOOST_AUTO_TEST_CASE(energy_is_kept_at_fixed_strain) {
  for_strains([](const Strain& e) {
    const double whole = energy(e.xx, e.yy, e.xy);
    BOOST_TEST(at(e, 0).stored == whole, tolerance(1e-13));
    for (const double f_max : {0.1, 0.5, 1.0}) {
      const double ceiling = dilatancy(e, f_max), p = at(e, 0).pressure, least = p < 0 ? -2 * p / K : 0;
      if (p > 0) BOOST_TEST(at(e, 0, f_max).ceiling == ceiling, tolerance(1e-13));
      if (p <= 0) BOOST_TEST(at(e, 0, f_max).ceiling == 0);
      for (const double part : {0.01, 0.5, 0.99}) {
        const auto point = at(e, least + part * (ceiling - least), f_max);
        BOOST_TEST(point.stored == whole, tolerance(1e-13));
        BOOST_TEST(point.converted > 0);
        BOOST_TEST(point.converted < f_max);
        // what the stress itself holds, by the complementary energy of all its components
        const double trace = point.xx + point.yy + point.zz;
        const double squares =
            point.xx * point.xx + point.yy * point.yy + point.zz * point.zz + 2 * point.xy * point.xy;
        BOOST_TEST((squares - trace * trace / 3) / (4 * G) + trace * trace / (18 * K) == whole, tolerance(1e-12));
        BOOST_TEST(trace / 3 == -point.pressure, tolerance(1e-12));
      }
      BOOST_TEST(at(e, ceiling, f_max).converted == f_max, tolerance(1e-12));
      BOOST_TEST(at(e, 2 * ceiling, f_max).converted == f_max);
      BOOST_TEST(at(e, 2 * ceiling, f_max).whole_equivalent == at(e, 0).whole_equivalent);
      BOOST_TEST(at(e, 2 * ceiling, f_max).stored > whole);  // nobody pays for this
      if (least > 0) {
        BOOST_TEST(at(e, least / 2, f_max).converted == 0);
        BOOST_TEST(at(e, least / 2, f_max).stored < whole);
      }
    }
  });
}

BOOST_AUTO_TEST_CASE(no_damage_is_hookes_law) {
  const double lambda = K - 2 * G / 3;
  for_strains([&](const Strain& e) {
    for (const double f_max : {0.0, 1.0}) {
      const auto point = at(e, 0, f_max);
      const double trace = e.xx + e.yy, size = std::abs(point.whole_equivalent) + std::abs(point.pressure);
      BOOST_TEST(std::abs(point.xx - (lambda * trace + 2 * G * e.xx)) < 1e-14 * size);
      BOOST_TEST(std::abs(point.yy - (lambda * trace + 2 * G * e.yy)) < 1e-14 * size);
      BOOST_TEST(std::abs(point.zz - lambda * trace) < 1e-14 * size);
      BOOST_TEST(std::abs(point.xy - 2 * G * e.xy) < 1e-14 * size);
      BOOST_TEST(point.converted == 0);
      const double a = point.xx - point.yy, b = point.yy - point.zz, c = point.zz - point.xx;  // von Mises
      BOOST_TEST(point.whole_equivalent == std::sqrt((a * a + b * b + c * c) / 2 + 3 * point.xy * point.xy),
                 tolerance(1e-13));
    }
    // nothing may be converted: all that dilatancy does is press
    const auto whole = at(e, 0, 0), pressed = at(e, 0.01, 0);
    const double size = whole.whole_equivalent + 0.01 * K + std::abs(whole.pressure);
    BOOST_TEST(pressed.converted == 0);
    BOOST_TEST(pressed.whole_equivalent == whole.whole_equivalent);
    BOOST_TEST(pressed.pressure - whole.pressure == 0.01 * K, tolerance(1e-12));
    BOOST_TEST(std::abs(pressed.xx - whole.xx + 0.01 * K) < 1e-14 * size);
    BOOST_TEST(std::abs(pressed.xy - whole.xy) < 1e-14 * size);
    BOOST_TEST(whole.ceiling == 0);
  });
}

BOOST_AUTO_TEST_CASE(axes_do_not_matter) {
  for_strains([](const Strain& e) {
    const auto point = at(e, 0.013, 0.6);
    const double size = point.whole_equivalent + std::abs(point.pressure);
    for (const double angle : {0.3, std::numbers::pi / 2, 2.0}) {
      const double c = std::cos(angle), s = std::sin(angle);
      const auto turned = [&](double xx, double yy, double xy) {
        return Strain{c * c * xx + s * s * yy + 2 * c * s * xy, s * s * xx + c * c * yy - 2 * c * s * xy,
                      (yy - xx) * c * s + (c * c - s * s) * xy};
      };
      const auto other = at(turned(e.xx, e.yy, e.xy), 0.013, 0.6);
      const Strain expected = turned(point.xx, point.yy, point.xy);
      BOOST_TEST(std::abs(other.xx - expected.xx) < 1e-13 * size);
      BOOST_TEST(std::abs(other.yy - expected.yy) < 1e-13 * size);
      BOOST_TEST(std::abs(other.xy - expected.xy) < 1e-13 * size);
      BOOST_TEST(std::abs(other.zz - point.zz) < 1e-13 * size);
      BOOST_TEST(std::abs(other.converted - point.converted) < 1e-13);
      BOOST_TEST(other.ceiling == point.ceiling, tolerance(1e-12));
    }
    const auto mirrored = at({e.xx, e.yy, -e.xy}, 0.013, 0.6), exchanged = at({e.yy, e.xx, e.xy}, 0.013, 0.6);
    BOOST_TEST(mirrored.xx == point.xx);
    BOOST_TEST(mirrored.yy == point.yy);
    BOOST_TEST(mirrored.xy == -point.xy);
    BOOST_TEST(exchanged.xx == point.yy, tolerance(1e-14));
    BOOST_TEST(exchanged.xy == point.xy, tolerance(1e-14));
  });
}

BOOST_AUTO_TEST_CASE(powers_of_two_scale_to_the_bit) {
  for_strains([](const Strain& e) {
    const auto point = at(e, 0.013, 0.6), stiffer = analytic::failure_point(8 * K, 8 * G, e.xx, e.yy, e.xy, 0.013, 0.6),
               larger = at({4 * e.xx, 4 * e.yy, 4 * e.xy}, 4 * 0.013, 0.6);
    BOOST_TEST(stiffer.xx == 8 * point.xx);
    BOOST_TEST(stiffer.stored == 8 * point.stored);
    BOOST_TEST(stiffer.converted == point.converted);
    BOOST_TEST(larger.yy == 4 * point.yy);
    BOOST_TEST(larger.zz == 4 * point.zz);
    BOOST_TEST(larger.stored == 16 * point.stored);
    BOOST_TEST(larger.converted == point.converted);
    BOOST_TEST(larger.ceiling == 4 * point.ceiling, tolerance(1e-14));
  });
}

BOOST_AUTO_TEST_CASE(no_strain) {
  const auto nothing = at({0, 0, 0}, 0, 0.5);
  BOOST_TEST(nothing.pressure == 0);
  BOOST_TEST(nothing.xx == 0);
  BOOST_TEST(nothing.converted == 0);
  BOOST_TEST(nothing.ceiling == 0);
  BOOST_TEST(nothing.stored == 0);
  const auto pressed = at({0, 0, 0}, 0.01, 0.5);  // no shear energy: whatever there is of it has been converted
  BOOST_TEST(pressed.pressure == 0.01 * K);
  BOOST_TEST(pressed.xx == -0.01 * K);
  BOOST_TEST(pressed.yy == -0.01 * K);
  BOOST_TEST(pressed.zz == -0.01 * K);
  BOOST_TEST(pressed.xy == 0);
  BOOST_TEST(pressed.converted == 0.5);
}

BOOST_AUTO_TEST_CASE(arguments_out_of_range) {
  const double infinity = std::numeric_limits<double>::infinity();
  BOOST_CHECK_THROW(analytic::failure_point(0, G, 0, 0, 0, 0, 1), std::invalid_argument);
  BOOST_CHECK_THROW(analytic::failure_point(K, nan_value, 0, 0, 0, 0, 1), std::invalid_argument);
  BOOST_CHECK_THROW(analytic::failure_point(K, G, nan_value, 0, 0, 0, 1), std::invalid_argument);
  BOOST_CHECK_THROW(analytic::failure_point(K, G, 0, infinity, 0, 0, 1), std::invalid_argument);
  BOOST_CHECK_THROW(analytic::failure_point(K, G, 0, 0, nan_value, 0, 1), std::invalid_argument);
  BOOST_CHECK_THROW(analytic::failure_point(K, G, 0, 0, 0, -1e-9, 1), std::invalid_argument);
  BOOST_CHECK_THROW(analytic::failure_point(K, G, 0, 0, 0, nan_value, 1), std::invalid_argument);
  BOOST_CHECK_THROW(analytic::failure_point(K, G, 0, 0, 0, 0, 1.01), std::invalid_argument);
  BOOST_CHECK_THROW(analytic::failure_point(K, G, 0, 0, 0, 0, -0.01), std::invalid_argument);
  BOOST_CHECK_THROW(UniaxialFailure(K, -1), std::invalid_argument);
  BOOST_CHECK_THROW(UniaxialFailure(1, 1.5), std::invalid_argument);
  BOOST_CHECK_THROW(UniaxialFailure(K, G).pressure(1.1), std::domain_error);
  BOOST_CHECK_THROW(UniaxialFailure(K, G).lateral(nan_value), std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()
