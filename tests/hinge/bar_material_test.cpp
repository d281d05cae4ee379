#include <boost/test/unit_test.hpp>
#include <cmath>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "hinge/material/bar_update.hpp"
#include "hinge/material/material.hpp"

BOOST_AUTO_TEST_SUITE(bar_material)

using namespace diptych::material;
using namespace std::string_literals;
namespace tt = boost::test_tools;

namespace {

/// A law of which the program knows nothing: σ = E ε (1 − |ε|/2), whose curve is not bilinear.
struct Softening {
  double youngs_modulus, density;
  struct State {
    double stress = 0, strain = 0;
  };
  static constexpr const char* model = "softening";
  static constexpr const char* feature = "softening";
  static constexpr bool yields = false;
  static Softening of_elastic(const Elastic& e) { return {e.youngs_modulus, e.density}; }
  std::vector<Parameter> parameters() const { return {}; }
  Softening scaled(const Factors& by) const { return {youngs_modulus * by.modulus, density * by.density}; }
  double elastic_wave_speed() const { return std::sqrt(youngs_modulus / density); }
  double stored(const State& s) const { return youngs_modulus * s.strain * s.strain / 2; }
  Response update(State& s, double strain_increment) const {
    s.strain += strain_increment;
    s.stress = youngs_modulus * s.strain * (1 - std::abs(s.strain) / 2);
    return {s.stress, stored(s), 0, elastic_wave_speed()};
  }
};
using Three = std::variant<Elastic, Hardening, Softening>;

}  // namespace

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

BOOST_AUTO_TEST_CASE(bodies_beside_one_another_have_one_law) {
  const std::vector<Material> alone{Elastic{1e4, 1}, Elastic{2e4, 2}};
  BOOST_TEST(std::get<std::vector<Elastic>>(laws(alone)).at(1).youngs_modulus == 2e4);
  const std::vector<Material> mixed{Elastic{1e4, 3}, Hardening{2e4, 2, 1e3, 75}};
  const auto both = std::get<std::vector<Hardening>>(laws(mixed));
  BOOST_TEST((both.at(0).youngs_modulus == 1e4 && both[0].density == 3 && std::isinf(both[0].yield_stress)));
  BOOST_TEST((both.at(1).yield_stress == 75 && both[1].tangent_modulus == 1e3));
}

// A third law is none of the two that there are: it takes elastic bodies beside it, and no other law.
BOOST_AUTO_TEST_CASE(a_third_law_is_a_law_of_its_own) {
  const std::vector<Three> mixed{Elastic{1e4, 3}, Softening{2e4, 2}};
  const auto both = std::get<std::vector<Softening>>(laws(mixed));
  BOOST_TEST((both.at(0).youngs_modulus == 1e4 && both[0].density == 3 && both.at(1).youngs_modulus == 2e4));
  BOOST_CHECK_THROW(laws(std::vector<Three>{Hardening{1e4, 1, 0, 75}, Softening{2e4, 2}}), std::invalid_argument);
  BOOST_CHECK_THROW(laws(std::vector<Three>{Softening{2e4, 2}, Elastic{1, 1}, Hardening{1e4, 1, 0, 75}}),
                    std::invalid_argument);
  BOOST_TEST(!bilinear(Three(Softening{1, 1})).has_value());
}

BOOST_AUTO_TEST_CASE(a_law_says_what_it_is) {
  const Material elastic = Elastic{1e4, 1}, hardening = Hardening{1e4, 2, 2500, 75};
  BOOST_TEST((model(elastic) == "elastic"s && feature(elastic) == "elastic"s && !yields(elastic)));
  BOOST_TEST((model(hardening) == "hardening"s && feature(hardening) == "plasticity"s && yields(hardening)));
  BOOST_TEST(parameters(elastic).empty());
  BOOST_REQUIRE_EQUAL(parameters(hardening).size(), 2u);
  BOOST_TEST((parameters(hardening)[0].value == 2500 && parameters(hardening)[1].value == 75));
  BOOST_TEST((std::isinf(bilinear(elastic)->yield_stress) && bilinear(hardening)->tangent_modulus == 2500));
  const auto other = std::get<Hardening>(scaled(hardening, {4, 32, 16}));
  BOOST_TEST((other.youngs_modulus == 4e4 && other.tangent_modulus == 1e4));
  BOOST_TEST((other.yield_stress == 2400 && other.density == 32));
}

BOOST_AUTO_TEST_CASE(nan_is_not_swallowed) {
  Elastic::State elastic;
  Hardening::State hardening;
  BOOST_TEST(std::isnan(Elastic{1, 1}.update(elastic, std::nan("")).stress));
  BOOST_TEST(std::isnan(Hardening{1, 1, 0.5, 1}.update(hardening, std::nan("")).stress));
}

BOOST_AUTO_TEST_SUITE_END()
