#include "hinge/material/material.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

using namespace diptych::material;
namespace tt = boost::test_tools;

BOOST_AUTO_TEST_SUITE(material)

BOOST_AUTO_TEST_CASE(elastic_answers_hookes_law) {
  const Elastic law{1e4, 4.0};
  Elastic::State state{2.0};
  const Response r = law.update(state, 1e-3);
  BOOST_TEST(r.stress == 12.0, tt::tolerance(1e-15));
  BOOST_TEST(state.stress == r.stress);
  BOOST_TEST(r.stored == 12.0 * 12.0 / 2e4, tt::tolerance(1e-15));
  BOOST_TEST(r.dissipated == 0.0);
  BOOST_TEST(r.wave_speed == 50.0, tt::tolerance(1e-15));
}

// E = 100, E_t = 25, σ_y = 1, strain 0.03: σ = 1 + 25·0.02 = 1.5; H = 100·25/75 = 100/3; Δε_p = 0.5/H = 0.015.
BOOST_AUTO_TEST_CASE(hardening_follows_the_bilinear_curve) {
  const Hardening law{100, 1, 25, 1};
  Hardening::State state;
  const Response r = law.update(state, 0.03);
  BOOST_TEST(r.stress == 1.5, tt::tolerance(1e-14));
  BOOST_TEST(state.hardened == 0.5, tt::tolerance(1e-13));
  BOOST_TEST(r.wave_speed == 5.0, tt::tolerance(1e-15));
  BOOST_TEST(r.stored == 1.5 * 1.5 / 200, tt::tolerance(1e-14));
  BOOST_TEST(r.dissipated == 1.25 * 0.015, tt::tolerance(1e-13));
}

// One large increment and a thousand small ones reach the same state, and stored + dissipated is the work ∫σ dε.
BOOST_AUTO_TEST_CASE(return_mapping_does_not_depend_on_the_path_length) {
  const Hardening law{1e4, 1, 2500, 75};
  Hardening::State once, often;
  const Response large = law.update(once, -0.02);
  double dissipated = 0, work = 0;
  for (int i = 0; i < 1000; ++i) {
    const double before = often.stress;
    const Response r = law.update(often, -0.02 / 1000);
    dissipated += r.dissipated;
    work += (before + r.stress) / 2 * (-0.02 / 1000);
  }
  BOOST_TEST(often.stress == once.stress, tt::tolerance(1e-11));
  BOOST_TEST(dissipated == large.dissipated, tt::tolerance(1e-11));
  BOOST_TEST(work == law.stored(often) + dissipated, tt::tolerance(1e-4));  // one trapezium straddles the yield point
}

BOOST_AUTO_TEST_CASE(unloading_is_elastic_and_reloading_meets_the_raised_yield_stress) {
  const Hardening law{1e4, 1, 2500, 75};
  Hardening::State state;
  law.update(state, 0.02);
  const double top = state.stress;
  const Response down = law.update(state, -0.001);
  BOOST_TEST(down.stress == top - 10, tt::tolerance(1e-13));
  BOOST_TEST(down.dissipated == 0.0);
  BOOST_TEST(down.wave_speed == 100.0, tt::tolerance(1e-15));
  const Response up = law.update(state, 0.001);
  BOOST_TEST(up.stress == top, tt::tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(perfect_plasticity_holds_the_yield_stress_and_has_no_wave) {
  const Hardening law{1e4, 1, 0, 75};
  Hardening::State state;
  const Response r = law.update(state, -0.05);
  BOOST_TEST(r.stress == -75.0, tt::tolerance(1e-15));
  BOOST_TEST(r.wave_speed == 0.0);
  BOOST_TEST(r.dissipated == 75 * (0.05 - 0.0075), tt::tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(stress_exactly_at_yield_is_still_elastic) {
  const Hardening law{128, 1, 32, 1};
  Hardening::State state;
  const Response r = law.update(state, 1.0 / 128);
  BOOST_TEST(r.stress == 1.0);
  BOOST_TEST(r.dissipated == 0.0);
  BOOST_TEST(r.wave_speed == law.elastic_wave_speed());
}

BOOST_AUTO_TEST_CASE(nan_is_not_swallowed) {
  Elastic::State elastic;
  Hardening::State hardening;
  BOOST_TEST(std::isnan(Elastic{1, 1}.update(elastic, std::nan("")).stress));
  BOOST_TEST(std::isnan(Hardening{1, 1, 0.5, 1}.update(hardening, std::nan("")).stress));
}

BOOST_AUTO_TEST_SUITE_END()
