// The failure wave's law at a point against the closed forms that come from the energies.
#include "hinge/material/failure_wave.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "analytic/failure_point.hpp"
#include "hinge/material/failure_wave_law.hpp"

BOOST_AUTO_TEST_SUITE(failure_wave)

namespace {

using boost::test_tools::tolerance;
using diptych::analytic::failure_point;
using diptych::analytic::FailurePoint;
using diptych::material::FailureWave;
using diptych::material::PlaneElastic;
using diptych::material::Tensor;
const double nan_value = std::numeric_limits<double>::quiet_NaN();

FailureWave glass(double most_converted = 1) { return {PlaneElastic{72.8e9, 0.222, 2563}, 2e9, most_converted}; }
double K(const FailureWave& wave) { return wave.elastic.bulk_modulus(); }
double G(const FailureWave& wave) { return wave.elastic.stiffness().shear; }

FailurePoint exact(const FailureWave& wave, const Tensor& e, double V_d) {
  return failure_point(K(wave), G(wave), e.xx, e.yy, e.xy, V_d, wave.most_converted);
}

bool same(const Tensor& a, const Tensor& b) { return a.xx == b.xx && a.yy == b.yy && a.xy == b.xy; }

/// Random strains of up to 6 %, and as many times one of the two that no random number meets.
template <class F>
void for_strains(const F& f) {
  std::mt19937 random(20022);
  std::uniform_real_distribution<double> value(-0.06, 0.06);
  for (int i = 0; i < 300; ++i) {
    const double xx = value(random), yy = value(random), xy = value(random);
    f(Tensor{xx, yy, xy});
    f(Tensor{-std::abs(xx), 0, 0});  // uniaxial compression
    f(Tensor{xx, xx, 0});
  }
}

/// V_d at which f of the shear energy has been converted, in tension too: there the second time that p² is what it was.
double dilatancy(const FailureWave& wave, const Tensor& e, double f) {
  const double p = wave.pressure(e), k = K(wave);
  return (std::sqrt(p * p + 2 * k * f * wave.shear_energy(e)) - p) / k;
}

/// Natural size of the stress.
double size(const FailurePoint& p) { return p.whole_equivalent + std::abs(p.pressure); }

}  // namespace

BOOST_AUTO_TEST_CASE(is_the_closed_form) {
  for (const double f_max : {0.0, 0.3, 1.0}) {
    const FailureWave wave = glass(f_max);
    for_strains([&](const Tensor& e) {
      BOOST_TEST(std::abs(wave.ceiling(e) - exact(wave, e, 0).ceiling) < 1e-15 + 1e-13 * exact(wave, e, 0).ceiling);
      const double ceiling = dilatancy(wave, e, f_max);
      for (const double V_d : {1e-6, 0.2 * ceiling, 0.9 * ceiling, 1.5 * ceiling, 0.02}) {
        const FailurePoint p = exact(wave, e, V_d);
        const Tensor stress = wave.stress(e, V_d);
        const double all = size(p) + size(exact(wave, e, 0));
        BOOST_TEST(std::abs(stress.xx - p.xx) < 1e-12 * all);
        BOOST_TEST(std::abs(stress.yy - p.yy) < 1e-12 * all);
        BOOST_TEST(std::abs(stress.xy - p.xy) < 1e-12 * all);
        BOOST_TEST(std::abs(wave.converted(e, V_d) - p.converted) < 1e-12);
        BOOST_TEST(wave.stored(e, V_d) == p.stored, tolerance(1e-12));
        BOOST_TEST(std::abs(wave.pressure(e) + K(wave) * V_d - p.pressure) < 1e-14 * all);
        // zz, which the plane does not show: the mean stress is −p
        BOOST_TEST(std::abs(-3 * (wave.pressure(e) + K(wave) * V_d) - stress.xx - stress.yy - p.zz) < 1e-12 * all);
      }
    });
  }
}

BOOST_AUTO_TEST_CASE(whole_without_dilatancy_to_the_bit) {
  const FailureWave wave = glass(0.5);
  for_strains([&](const Tensor& e) {
    BOOST_TEST(same(wave.stress(e, 0), wave.elastic.stiffness().stress(e)));
    BOOST_TEST(wave.converted(e, 0) == 0);
    const Tensor tiny = wave.stress(e, 1e-18), whole = wave.stress(e, 0);  // and nothing jumps beside it
    const double all = size(exact(wave, e, 0));
    BOOST_TEST(std::abs(tiny.xx - whole.xx) < 1e-13 * all);
    BOOST_TEST(std::abs(tiny.yy - whole.yy) < 1e-13 * all);
    BOOST_TEST(std::abs(tiny.xy - whole.xy) < 1e-13 * all);
  });
  BOOST_TEST(wave.converted({0, 0, 0}, 0) == 0);
  BOOST_TEST(same(wave.stress({0, 0, 0}, 0), {0, 0, 0}));
  BOOST_TEST(wave.ceiling({0, 0, 0}) == 0);
}

BOOST_AUTO_TEST_CASE(equivalent_stress_is_of_the_whole_solid) {
  for (const double f_max : {0.0, 1.0}) {
    const FailureWave wave = glass(f_max);
    for_strains([&](const Tensor& e) {
      BOOST_TEST(wave.equivalent_stress(e) == exact(wave, e, 0).whole_equivalent, tolerance(1e-13));
      // √(3/2 s:s) of its stress, all four components
      const Tensor s = wave.elastic.stiffness().stress(e);
      const double zz = wave.elastic.stiffness().cross * (e.xx + e.yy), mean = (s.xx + s.yy + zz) / 3;
      const double xx = s.xx - mean, yy = s.yy - mean, rest = zz - mean;
      BOOST_TEST(wave.equivalent_stress(e) == std::sqrt(1.5 * (xx * xx + yy * yy + rest * rest + 2 * s.xy * s.xy)),
                 tolerance(1e-12));
    });
  }
  // in uniaxial strain σ_x − σ_y
  const FailureWave wave = glass();
  const Tensor stress = wave.stress({-0.06, 0, 0}, 0);
  BOOST_TEST(wave.equivalent_stress({-0.06, 0, 0}) == stress.yy - stress.xx, tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(ceiling_and_converted_undo_each_other) {
  for (const double f_max : {0.05, 0.5, 1.0}) {
    const FailureWave wave = glass(f_max), open = glass(1);
    for_strains([&](const Tensor& e) {
      const double ceiling = wave.ceiling(e);
      if (e.xx + e.yy >= 0) {  // not compressed
        BOOST_TEST(ceiling == 0);
        return;
      }
      BOOST_TEST(open.converted(e, ceiling) == f_max, tolerance(1e-12));
      BOOST_TEST(wave.converted(e, ceiling * (1 + 1e-9)) == f_max);  // beyond it nothing more
      BOOST_TEST(wave.converted(e, 3 * ceiling) == f_max);
      BOOST_TEST(wave.converted(e, 0.999 * ceiling) < f_max);
      BOOST_TEST(wave.stored(e, 0.999 * ceiling) <= wave.stored(e, 0) * (1 + 1e-12));
      BOOST_TEST(wave.stored(e, 1.01 * ceiling) > wave.stored(e, 0) * (1 + 1e-6));
    });
  }
}

BOOST_AUTO_TEST_CASE(conversion_keeps_the_energy) {
  const FailureWave wave = glass(0.5);
  for_strains([&](const Tensor& e) {
    const double p = wave.pressure(e), least = p < 0 ? -2 * p / K(wave) : 0, ceiling = dilatancy(wave, e, 0.5);
    for (const double part : {0.1, 0.6, 0.99}) {
      const double V_d = least + part * (ceiling - least);
      BOOST_TEST(wave.stored(e, V_d) == wave.stored(e, 0), tolerance(1e-12));
      // held by the stress itself: what is stored cannot be right and the stress wrong
      const Tensor s = wave.stress(e, V_d);
      const double mean = -(p + K(wave) * V_d), zz = 3 * mean - s.xx - s.yy;
      const double xx = s.xx - mean, yy = s.yy - mean, rest = zz - mean;
      const double held =
          (xx * xx + yy * yy + rest * rest + 2 * s.xy * s.xy) / (4 * G(wave)) + mean * mean / (2 * K(wave));
      BOOST_TEST(held == wave.stored(e, 0), tolerance(1e-12));
    }
  });
}

BOOST_AUTO_TEST_CASE(nothing_is_taken_back_in_tension) {
  const FailureWave wave = glass(0.5);
  const Tensor e{0.02, 0.01, 0.005};
  const double least = 2 * 0.03;  // V_d at which the pressure is −p_e: from there on energy is gained
  BOOST_TEST(wave.converted(e, 0.3 * least) == 0);
  BOOST_TEST(wave.converted(e, 0.999 * least) == 0);
  BOOST_TEST(wave.converted(e, 1.001 * least) > 0);
  const Tensor whole = wave.stress(e, 0), open = wave.stress(e, 0.3 * least);
  BOOST_TEST(whole.xx - open.xx == K(wave) * 0.3 * least, tolerance(1e-12));
  BOOST_TEST(open.xy == whole.xy, tolerance(1e-15));
  // no strain, no shear energy: only pressure
  const Tensor pressed = wave.stress({0, 0, 0}, 0.01);
  BOOST_TEST(pressed.xx == -K(wave) * 0.01, tolerance(1e-15));
  BOOST_TEST(pressed.yy == pressed.xx);
  BOOST_TEST(pressed.xy == 0);
  BOOST_TEST(wave.converted({0, 0, 0}, 0.01) == 0.5);
}

BOOST_AUTO_TEST_CASE(mirrored_exchanged_and_in_other_units) {
  const FailureWave wave = glass(0.4);
  FailureWave stiffer = wave;
  stiffer.elastic.youngs_modulus *= 4;
  for_strains([&](const Tensor& e) {
    const double V_d = 0.011;
    const Tensor s = wave.stress(e, V_d);
    BOOST_TEST(same(wave.stress({e.xx, e.yy, -e.xy}, V_d), {s.xx, s.yy, -s.xy}));
    BOOST_TEST(same(wave.stress({e.yy, e.xx, e.xy}, V_d), {s.yy, s.xx, s.xy}));
    BOOST_TEST(same(stiffer.stress(e, V_d), s * 4));
    BOOST_TEST(same(wave.stress(e * 2, 2 * V_d), s * 2));
    BOOST_TEST(wave.ceiling(e * 2) == 2 * wave.ceiling(e));
    BOOST_TEST(stiffer.stored(e, V_d) == 4 * wave.stored(e, V_d));
  });
}

BOOST_AUTO_TEST_CASE(stiffening_is_the_tangent) {
  // dσ_xx/dε_xx at fixed V_d in uniaxial strain, by differences of the closed form, is largest at f_max
  for (const double f_max : {0.0, 0.1, 0.3, 0.6, 0.89}) {
    const FailureWave wave = glass(f_max), open = glass(1);
    const double e = -0.06, whole = wave.elastic.stiffness().normal;
    const auto tangent = [&](double f) {
      const double V_d = dilatancy(open, {e, 0, 0}, f), d = 1e-3 * (1 - f) * std::abs(e);
      const auto xx = [&](double at) { return failure_point(K(wave), G(wave), at, 0, 0, V_d, 1).xx; };
      return (8 * (xx(e + d) - xx(e - d)) - (xx(e + 2 * d) - xx(e - 2 * d))) / (12 * d) / whole;
    };
    BOOST_TEST(wave.stiffening() == tangent(f_max), tolerance(1e-7));
    for (const double part : {0.0, 0.4, 0.9}) BOOST_TEST(tangent(part * f_max) <= wave.stiffening() * (1 + 1e-7));
  }
  BOOST_TEST(glass(1).stiffening() == glass(0.9).stiffening());  // no further
  BOOST_TEST(std::isnan(glass(nan_value).stiffening()));
}

BOOST_AUTO_TEST_CASE(nan_stays_nan) {
  const FailureWave wave = glass(0.5);
  const auto lost = [](const Tensor& t) { return std::isnan(t.xx) && std::isnan(t.yy); };
  const Tensor e{-0.02, 0.01, 0.003};
  for (const double V_d : {0.0, 0.01}) {
    BOOST_TEST(lost(wave.stress({nan_value, 0, 0}, V_d)));
    BOOST_TEST(lost(wave.stress({0, nan_value, 0}, V_d)));
    BOOST_TEST(std::isnan(wave.stress({0, 0, nan_value}, V_d).xy));
    BOOST_TEST(std::isnan(wave.stored({0, nan_value, 0}, V_d)));
  }
  BOOST_TEST(lost(wave.stress(e, nan_value)));
  BOOST_TEST(std::isnan(wave.stress(e, nan_value).xy));
  BOOST_TEST(std::isnan(wave.converted(e, nan_value)));
  BOOST_TEST(std::isnan(wave.converted({nan_value, 0, 0}, 0.01)));
  BOOST_TEST(std::isnan(wave.stored(e, nan_value)));
  for (const double xx : {-0.02, 0.0, 0.02}) BOOST_TEST(std::isnan(wave.ceiling({xx, 0, nan_value})));
  BOOST_TEST(std::isnan(wave.ceiling({nan_value, 0, 0})));
  BOOST_TEST(std::isnan(wave.equivalent_stress({0, nan_value, 0})));
  BOOST_TEST(std::isnan(glass(nan_value).ceiling(e)));
}

BOOST_AUTO_TEST_SUITE_END()
