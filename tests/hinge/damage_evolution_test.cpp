#include "hinge/diffusion/damage_evolution.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "hinge/material/tensile_damage.hpp"

BOOST_AUTO_TEST_SUITE(damage_evolution)

using namespace diptych::diffusion;
namespace tt = boost::test_tools;

namespace {

constexpr double pi = std::numbers::pi;

/// The paper's constants: C_d = 1e21 ε⁷/ε̇².
const CrackGrowth growth = [](double strain, double rate) { return 1e21 * std::pow(strain, 7) / (rate * rate); };

Evolution paper_local() { return {}; }

Evolution paper() {
  Evolution e = paper_local();
  e.diffusion.emplace();
  return e;
}

std::vector<double> uniform(const Grid& g, double strain) { return std::vector<double>(g.cells(), strain); }

std::vector<double> random_strains(const Grid& g, unsigned seed, double low, double high) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> draw(low, high);
  std::vector<double> strains(g.cells());
  for (double& e : strains) e = draw(generator);
  return strains;
}

constexpr Grid one_cell{1, 1, 0.1, 0.1};

double one(const DamageEvolution& evolution) { return evolution.crack_density()[0]; }

}  // namespace

BOOST_AUTO_TEST_CASE(paper_constants_give_the_coefficient) {
  diptych::material::TensileDamage material;
  material.elastic = {50e9, 0.3, 2500, diptych::material::Plane::strain};
  BOOST_TEST(material.crack_coefficient() == 1e21, tt::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(diffusivity_falls_to_its_floor_at_rupture) {
  Diffusion d;
  BOOST_TEST(diffusivity(d, 0.0025) == 375.0, tt::tolerance(1e-15));
  BOOST_TEST(diffusivity(d, 0.0081) == 100.0);  // 0.2 of 500, where eq. 25 gives 95
  BOOST_TEST(diffusivity(d, 0.02) == 100.0);
  BOOST_TEST(std::isnan(diffusivity(d, std::nan(""))));
  d.floor = 1;
  for (const double strain : {-0.003, 0.0, 0.0025, 0.02}) BOOST_TEST(diffusivity(d, strain) == 500.0);
}

BOOST_AUTO_TEST_CASE(diffusivity_as_printed_falls_to_nothing_at_rupture) {
  Diffusion d;
  d.floor = 0;
  BOOST_TEST(diffusivity(d, 0) == 500.0);
  BOOST_TEST(diffusivity(d, 0.0025) == 375.0, tt::tolerance(1e-15));
  BOOST_TEST(diffusivity(d, 0.01) == 0.0);
  BOOST_TEST(diffusivity(d, 0.02) == 0.0);
  BOOST_TEST(diffusivity(d, -0.003) == 500.0);
  BOOST_TEST(std::isnan(diffusivity(d, std::nan(""))));
}

// Eq. 23a by hand: 1e21 · 0.003⁷/100² = 0.2187, 0.002⁷: 0.0128, 0.0025⁷: 0.06103515625.
BOOST_AUTO_TEST_CASE(local_damage_by_hand_never_heals) {
  DamageEvolution e(paper_local(), growth, one_cell);
  BOOST_TEST(one(e) == 0.0);
  for (const auto& [strain, density] : {std::pair{0.0019, 0.0},
                                        {0.002, 0.0128},
                                        {0.003, 0.2187},
                                        {0.0025, 0.2187},
                                        {-0.01, 0.2187},
                                        {0.0, 0.2187},
                                        {0.0031, 0.27512614111},
                                        {0.004, 0.5625}}) {
    e.advance(uniform(one_cell, strain), 1e-6);
    BOOST_TEST(one(e) == density, tt::tolerance(1e-12));
  }
  BOOST_TEST(e.concentration().empty());
  BOOST_TEST(e.total() == 0.0);
  BOOST_TEST(e.fed() == 0.0);
  BOOST_TEST(e.node_updates() == 0);
}

BOOST_AUTO_TEST_CASE(local_damage_shows_everywhere_on_request) {
  Evolution evolution = paper_local();
  evolution.damage_everywhere = true;
  DamageEvolution e(evolution, growth, one_cell);
  e.advance(uniform(one_cell, 0.001), 1e-6);
  BOOST_TEST(one(e) == 1e-4, tt::tolerance(1e-13));
  e.advance(uniform(one_cell, -0.001), 1e-6);
  BOOST_TEST(one(e) == 1e-4, tt::tolerance(1e-13));
}

// What the floor of the rate made large below the critical strain is still there when that is reached.
BOOST_AUTO_TEST_CASE(local_damage_keeps_what_it_had_before_the_critical_state) {
  Evolution evolution = paper_local();
  evolution.rate = Rate::tracked;
  DamageEvolution e(evolution, growth, one_cell);
  e.advance(uniform(one_cell, 5e-4), 1e-4);  // 5 per second: 1e21 · 5e-4⁷/5² = 3.125e-4
  BOOST_TEST(one(e) == 0.0);
  e.advance(uniform(one_cell, 0.002), 1e-6);  // 1500 per second: 5.7e-5 by itself
  BOOST_TEST(one(e) == 3.125e-4, tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(tracked_rate_is_the_largest_so_far) {
  Evolution evolution = paper_local();
  evolution.rate = Rate::tracked;
  DamageEvolution e(evolution, growth, one_cell);
  e.advance(uniform(one_cell, 0.002), 1e-5);  // 200 per second, from zero
  BOOST_TEST(one(e) == 0.0128 / 4, tt::tolerance(1e-12));
  e.advance(uniform(one_cell, 0.002), 1e-5);
  BOOST_TEST(one(e) == 0.0128 / 4, tt::tolerance(1e-12));
  e.advance(uniform(one_cell, 0.0015), 1e-8);  // unloading is no rate
  e.advance(uniform(one_cell, 0.002), 1e-5);
  e.advance(uniform(one_cell, 0.003), 1e-5);  // 100 per second
  BOOST_TEST(one(e) == 0.2187 / 4, tt::tolerance(1e-12));
  e.advance(uniform(one_cell, 0.004), 1e-6);  // 1000 per second
  BOOST_TEST(one(e) == 0.2187 / 4, tt::tolerance(1e-12));
  e.advance(uniform(one_cell, 0.007), 1e-2);  // still 1000
  BOOST_TEST(one(e) == std::min(9.0 / 16, 0.823543), tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(rate_has_a_floor) {
  Evolution evolution = paper_local();
  evolution.rate = Rate::tracked;
  evolution.rate_floor = 50;
  evolution.cap = std::numeric_limits<double>::infinity();
  DamageEvolution e(evolution, growth, one_cell);
  e.advance(uniform(one_cell, 0.002), 1);
  BOOST_TEST(one(e) == 0.0512, tt::tolerance(1e-12));
  e.advance(uniform(one_cell, 0.01), 1);  // 1e21 · 1e-14/2500, and no cap
  BOOST_TEST(one(e) == 4000.0, tt::tolerance(1e-12));
}

// Fed everywhere and strained evenly, C = Q t: per step of 1 ms C_d grows by C_d(23a) · 1e-3/0.01.
BOOST_AUTO_TEST_CASE(source_by_hand) {
  const Grid g{3, 4, 0.1, 0.1};
  for (const bool per_volume : {true, false}) {
    Evolution evolution = paper();
    evolution.diffusion->source = Source::everywhere;
    evolution.diffusion->per_crack_volume = per_volume;
    DamageEvolution e(evolution, growth, g);
    const double part = per_volume ? 1 : 0.01;
    e.advance(uniform(g, 0.003), 1e-3);
    for (const double c : e.concentration()) BOOST_TEST(c == part * 2.187, tt::tolerance(1e-12));
    for (const double c : e.crack_density()) BOOST_TEST(c == part * 0.02187, tt::tolerance(1e-12));
    e.advance(uniform(g, 0.0019), 1e-3);  // below the critical strain nothing is fed, and nothing heals
    for (const double c : e.crack_density()) BOOST_TEST(c == part * 0.02187, tt::tolerance(1e-12));
    e.advance(uniform(g, 0.002), 1e-3);
    for (const double c : e.crack_density()) BOOST_TEST(c == part * (0.02187 + 0.00128), tt::tolerance(1e-12));
    BOOST_TEST(e.total() == part * 2.315 * 0.12, tt::tolerance(1e-12));
    BOOST_TEST(e.fed() == e.total(), tt::tolerance(1e-13));
  }
}

BOOST_AUTO_TEST_CASE(strain_is_clipped_in_the_source_and_density_capped) {
  Evolution evolution = paper();
  evolution.diffusion->source = Source::everywhere;
  evolution.diffusion->saturates = false;
  for (const bool clipped : {true, false}) {
    evolution.diffusion->clip_strain = clipped;
    DamageEvolution e(evolution, growth, one_cell);
    e.advance(uniform(one_cell, 0.02), 1e-6);  // d = 0; 1e21 · 0.01⁷/1e4 = 1000
    BOOST_TEST(e.concentration()[0] == (clipped ? 1 : 128) * 1000 / 0.01 / 0.01 * 1e-6, tt::tolerance(1e-12));
    BOOST_TEST(one(e) == (clipped ? 0.1 : 0.5625), tt::tolerance(1e-12));
  }
  evolution.cap = 3;
  DamageEvolution e(evolution, growth, one_cell);
  e.advance(uniform(one_cell, 0.02), 1e-6);
  BOOST_TEST(one(e) == 3.0);
}

BOOST_AUTO_TEST_CASE(the_source_fills_up_to_the_cap_and_no_further) {
  Evolution evolution = paper();
  evolution.diffusion->source = Source::everywhere;
  DamageEvolution e(evolution, growth, one_cell);
  for (int step = 1; step <= 9; ++step) {
    e.advance(uniform(one_cell, 0.02), 1e-6);  // 0.1 a step while there is room
    BOOST_TEST(e.concentration()[0] == std::min(0.1 * step, 0.5625) / 0.01, tt::tolerance(1e-12));
    BOOST_TEST(e.fed() == e.total(), tt::tolerance(1e-12));
  }
  evolution.cap = std::numeric_limits<double>::infinity();  // nothing to fill up to
  DamageEvolution uncapped(evolution, growth, one_cell);
  for (int step = 0; step < 9; ++step) uncapped.advance(uniform(one_cell, 0.02), 1e-6);
  BOOST_TEST(uncapped.concentration()[0] == 90.0, tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(tracked_rate_in_the_source) {
  Evolution evolution = paper();
  evolution.diffusion->source = Source::everywhere;
  evolution.rate = Rate::tracked;
  DamageEvolution e(evolution, growth, one_cell);
  e.advance(uniform(one_cell, 0.003), 1e-5);  // 300 per second
  BOOST_TEST(one(e) == 0.2187 / 9 * 1e-3, tt::tolerance(1e-12));
  e.advance(uniform(one_cell, 0.003), 1e-5);
  BOOST_TEST(one(e) == 2 * 0.2187 / 9 * 1e-3, tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(critical_state_is_remembered_cell_by_cell) {
  const Grid g{6, 6, 0.1, 0.1};
  Evolution evolution = paper();
  DamageEvolution shown(evolution, growth, g);
  evolution.damage_everywhere = true;
  DamageEvolution everywhere(evolution, growth, g);
  std::vector<double> strain = uniform(g, 0.001);
  strain[0] = 0.003;
  strain[14] = 0.0025;
  for (int n = 0; n < 30; ++n) {
    shown.advance(strain, 1e-5);
    everywhere.advance(strain, 1e-5);
    strain[14] = -0.001;
  }
  for (std::size_t cell = 0; cell < g.cells(); ++cell) {
    BOOST_TEST(everywhere.crack_density()[cell] > 0);
    BOOST_TEST(shown.crack_density()[cell] == (cell == 0 || cell == 14 ? everywhere.crack_density()[cell] : 0));
  }
}

BOOST_AUTO_TEST_CASE(density_of_a_cell_is_the_mean_of_its_nodes) {
  const Grid g{5, 7, 0.02, 0.03};
  Evolution evolution = paper();
  evolution.damage_everywhere = true;
  evolution.cap = std::numeric_limits<double>::infinity();
  DamageEvolution e(evolution, growth, g);
  for (int n = 0; n < 4; ++n) e.advance(random_strains(g, 1, 0.001, 0.006), 1e-6);
  const auto c = e.concentration();
  for (std::size_t j = 0; j < 7; ++j) {
    for (std::size_t i = 0; i < 5; ++i) {
      const std::size_t a = j * 6 + i;
      BOOST_TEST(e.crack_density()[j * 5 + i] == 0.01 * (c[a] + c[a + 1] + c[a + 6] + c[a + 7]) / 4,
                 tt::tolerance(1e-13));
    }
  }
}

BOOST_AUTO_TEST_CASE(area_of_a_rectangle_within_a_circle) {
  BOOST_TEST(area_within(2, 0, 1, 0, 1) == 1.0);
  BOOST_TEST(area_within(1, 1, 2, 0, 1) == 0.0);
  BOOST_TEST(area_within(0, 0, 1, 0, 1) == 0.0);
  BOOST_TEST(area_within(1, 0, 1, 0, 1) == pi / 4, tt::tolerance(1e-15));
  BOOST_TEST(area_within(1, 0, 3, 0, 5) == pi / 4, tt::tolerance(1e-15));
  const double half = (0.5 * std::sqrt(0.75) + pi / 6) / 2;  // ∫₀^½ √(1 − y²) dy
  BOOST_TEST(area_within(1, 0, 2, 0, 0.5) == half, tt::tolerance(1e-15));
  BOOST_TEST(area_within(1, 0, 2, 0.5, 2) == pi / 4 - half, tt::tolerance(1e-15));
  BOOST_TEST(area_within(1, 0.5, 2, 0.5, 2) == pi / 4 - 2 * half + 0.25, tt::tolerance(1e-14));
  BOOST_TEST(area_within(1, 0.5, 0.6, 0, 0.9) == area_within(1, 0, 0.9, 0.5, 0.6));  // to the bit
  BOOST_TEST(area_within(1, 0.2, 0.7, 0.3, 0.9) == area_within(1, 0.3, 0.9, 0.2, 0.7));
}

BOOST_AUTO_TEST_CASE(parts_of_the_zone_add_up_to_a_quarter_circle) {
  for (const int n : {1, 2, 7, 10, 16, 20, 33, 160}) {
    for (const double ratio : {1.0, 0.37, 3.0}) {
      for (const double radius : {0.01, 0.1, 1.0 / 3, 0.73, 0.99999}) {
        const double hx = 1.0 / n, hy = ratio / n;
        const int rows = static_cast<int>(std::ceil(radius / hy)) + 1;
        long double sum = 0;  // of up to 7e4 parts: their own round-off is asked for, not the sum's
        for (int j = 0; j < rows; ++j) {
          for (int i = 0; i < n; ++i) sum += area_within(radius, i * hx, (i + 1) * hx, j * hy, (j + 1) * hy);
        }
        BOOST_TEST_CONTEXT(n << " cells of ratio " << ratio << ", radius " << radius) {
          BOOST_TEST(static_cast<double>(sum) == pi * radius * radius / 4, tt::tolerance(1e-14));
        }
      }
    }
  }
}

// A zone of fixed size takes the same on every grid.
BOOST_AUTO_TEST_CASE(zone_is_fed_by_its_area) {
  const double q = 0.2187 / 0.01 / 0.01;
  for (const Grid& g : {Grid{10, 15, 0.1, 0.1}, Grid{16, 24, 0.0625, 0.0625}, Grid{20, 30, 0.05, 0.05},
                        Grid{3, 7, 0.3, 0.2}, Grid{40, 60, 0.025, 0.025}}) {
    DamageEvolution e(paper(), growth, g);
    for (int n = 0; n < 10; ++n) e.advance(uniform(g, 0.003), 1e-6);
    BOOST_TEST(e.fed() == q * pi * 0.01 / 4 * 1e-5, tt::tolerance(1e-13));
    BOOST_TEST(e.total() == e.fed(), tt::tolerance(1e-13));
  }
  Evolution evolution = paper();
  evolution.diffusion->radius = 10;
  DamageEvolution all(evolution, growth, {3, 7, 0.3, 0.2});
  all.advance(uniform({3, 7, 0.3, 0.2}, 0.003), 1e-6);
  BOOST_TEST(all.fed() == q * 0.9 * 1.4 * 1e-6, tt::tolerance(1e-13));
  evolution.diffusion->radius = 0;
  DamageEvolution none(evolution, growth, {3, 7, 0.3, 0.2});
  none.advance(uniform({3, 7, 0.3, 0.2}, 0.003), 1e-6);
  BOOST_TEST(none.fed() == 0.0);
}

BOOST_AUTO_TEST_CASE(single_node_is_fed_by_its_cell) {
  const Grid g{4, 4, 0.1, 0.2};
  Evolution evolution = paper();
  evolution.diffusion->source = Source::node;
  DamageEvolution e(evolution, growth, g);
  std::vector<double> strain = uniform(g, 0.0099);
  strain[0] = 0.003;
  e.advance(strain, 1e-6);
  BOOST_TEST(e.fed() == 0.2187 / 0.01 / 0.01 * 0.1 * 0.2 / 4 * 1e-6, tt::tolerance(1e-12));
  BOOST_TEST(e.total() == e.fed(), tt::tolerance(1e-13));
}

// The same by hand with a source that is worked out node by node, diffusing from the first step on: strains at the end
// of a step are those of its source and diffusivity, and what is left out before anything is fed does not change a bit.
BOOST_AUTO_TEST_CASE(staggered_step_by_hand) {
  const Grid g{6, 5, 0.04, 0.05};
  for (const Scheme scheme : {Scheme::sub_cycled, Scheme::rkl2, Scheme::backward_euler}) {
    Evolution evolution = paper();
    evolution.diffusion->scheme = scheme;
    DamageEvolution e(evolution, growth, g);
    Concentration by_hand(g, scheme);
    const Diffusion& d = *evolution.diffusion;
    for (unsigned n = 0; n < 12; ++n) {
      const auto strain = n < 4 ? random_strains(g, n, -0.001, 0.0019) : random_strains(g, n, 0.001, 0.012);
      std::vector<double> diffusivities, s(g.nodes(), 0);
      for (const double v : strain) diffusivities.push_back(diffusivity(d, v));
      for (int j = 0; j <= g.ny; ++j) {
        for (int i = 0; i <= g.nx; ++i) {
          double given = 0, volume = 0;
          for (const int up : {-1, 0}) {
            for (const int right : {-1, 0}) {
              const int ci = i + right, cj = j + up;
              if (ci < 0 || ci >= g.nx || cj < 0 || cj >= g.ny) continue;
              const double v = strain[static_cast<std::size_t>(cj * g.nx + ci)];
              const double q = v >= 0.002 ? 1e21 * std::pow(std::min(v, 0.01), 7) / 1e4 / 0.01 / 0.01 : 0;
              const double x = (i + right / 2.0) * g.hx, y = (j + up / 2.0) * g.hy;
              given += q * area_within(0.1, x, x + g.hx / 2, y, y + g.hy / 2);
              volume += g.hx * g.hy / 4;
            }
          }
          s[static_cast<std::size_t>(j * (g.nx + 1) + i)] = given / volume;
        }
      }
      e.advance(strain, 2e-6);
      by_hand.step(diffusivities, s, 2e-6);
      double largest = 0;
      for (const double c : by_hand.values()) largest = std::max(largest, std::abs(c));
      for (std::size_t k = 0; k < g.nodes(); ++k)
        BOOST_TEST(std::abs(e.concentration()[k] - by_hand.values()[k]) <= 1e-13 * largest);
      BOOST_TEST((n < 4 ? e.node_updates() == 0 : e.node_updates() > 0));
      BOOST_TEST(e.total() == e.fed(), tt::tolerance(1e-13));
    }
  }
}

// Where C flows away the density that stiffness sees stays what it was, or falls with C on request; C is the same.
BOOST_AUTO_TEST_CASE(damage_heals_on_request_alone) {
  const Grid g{4, 4, 0.1, 0.1};
  Evolution evolution = paper();
  evolution.diffusion->source = Source::node;
  DamageEvolution keeps(evolution, growth, g);
  evolution.heals = true;
  DamageEvolution heals(evolution, growth, g);
  std::vector<double> strain = uniform(g, 0.003);
  keeps.advance(strain, 1e-5);
  heals.advance(strain, 1e-5);
  const double first = one(keeps);
  BOOST_TEST(first > 0);
  BOOST_TEST(one(heals) == first);
  for (double& e : strain) e = 0;  // nothing is fed any more, and C spreads as fast as it can
  for (int n = 0; n < 3; ++n) {
    keeps.advance(strain, 1e-5);
    heals.advance(strain, 1e-5);
  }
  BOOST_TEST(one(keeps) >= first);
  const double largest = one(keeps);
  for (int n = 0; n < 30; ++n) {
    keeps.advance(strain, 1e-5);
    heals.advance(strain, 1e-5);
    BOOST_TEST(one(keeps) == largest);
  }
  BOOST_TEST(one(heals) < first);
  const std::vector<double> a(keeps.concentration().begin(), keeps.concentration().end()),
      b(heals.concentration().begin(), heals.concentration().end());
  BOOST_TEST(a == b, tt::per_element());
}

// Uniform d and Q within r₀ in the plane: C(0, t) = Q [t (1 − e^{−a/t}) + a E₁(a/t)] with a = r₀²/4d.
BOOST_AUTO_TEST_CASE(zone_against_the_disc_in_the_plane) {
  const double strain = 0.003, d = 350, q = 0.2187 / 0.01 / 0.01, end = 5e-5, a = 0.01 / (4 * d);
  const double exact = q * (end * (1 - std::exp(-a / end)) - a * std::expint(-a / end));
  const auto error = [&](int n, Source source) {
    const Grid g{n, n, 1.0 / n, 1.0 / n};
    Evolution evolution = paper();
    evolution.diffusion->source = source;
    DamageEvolution e(evolution, growth, g);
    for (int k = 0; k < 4 * n; ++k) e.advance(uniform(g, strain), end / (4 * n));
    return std::abs(e.concentration()[0] / exact - 1);
  };
  BOOST_TEST(error(20, Source::zone) < 0.02);
  BOOST_TEST(error(40, Source::zone) < 0.005);
  BOOST_TEST(error(80, Source::zone) < 0.0015);
  BOOST_TEST(error(40, Source::node) > 0.5);  // a single node is not a zone
}

// A square strained alike along both axes cracks alike, to the bit.
BOOST_AUTO_TEST_CASE(transposed_strains_give_transposed_bits) {
  const Grid g{9, 9, 0.012, 0.012};
  Evolution evolution = paper();
  evolution.cap = std::numeric_limits<double>::infinity();
  DamageEvolution e(evolution, growth, g), f(evolution, growth, g);
  for (unsigned n = 0; n < 6; ++n) {
    const auto strain = random_strains(g, n, 0.001, 0.0099);
    std::vector<double> transposed(strain.size());
    for (std::size_t j = 0; j < 9; ++j) {
      for (std::size_t i = 0; i < 9; ++i) transposed[i * 9 + j] = strain[j * 9 + i];
    }
    e.advance(strain, 3e-6);
    f.advance(transposed, 3e-6);
    for (std::size_t j = 0; j < 9; ++j) {
      for (std::size_t i = 0; i < 9; ++i) BOOST_TEST(e.crack_density()[j * 9 + i] == f.crack_density()[i * 9 + j]);
    }
  }
}

BOOST_AUTO_TEST_CASE(what_is_fed_is_there_with_every_scheme_and_reading) {
  const Grid g{12, 10, 0.05, 0.05};
  for (const Scheme scheme :
       {Scheme::forward_euler, Scheme::sub_cycled, Scheme::rkl2, Scheme::backward_euler, Scheme::crank_nicolson}) {
    for (const Reading reading : {Reading::isotropic, Reading::radial}) {
      Evolution evolution = paper();
      evolution.rate = Rate::tracked;
      evolution.diffusion->scheme = scheme;
      evolution.diffusion->reading = reading;
      DamageEvolution e(evolution, growth, g);
      for (unsigned n = 0; n < 40; ++n)
        e.advance(random_strains(g, n, 0.001, 0.012), scheme == Scheme::forward_euler ? 5e-7 : 1e-5);
      BOOST_TEST(e.total() > 0);
      BOOST_TEST(e.total() == e.fed(), tt::tolerance(1e-13));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_strain_that_is_not_a_number_shows) {
  const Grid g{8, 8, 0.1, 0.1};
  std::vector<double> strain = uniform(g, 0.001);
  strain[60] = std::nan("");
  DamageEvolution with(paper(), growth, g);
  with.advance(strain, 1e-6);
  BOOST_TEST(std::isnan(with.crack_density()[60]));
  BOOST_TEST(std::isnan(with.concentration()[0]));
  DamageEvolution local(paper_local(), growth, g);
  local.advance(strain, 1e-6);
  local.advance(uniform(g, 0.003), 1e-6);
  BOOST_TEST(std::isnan(local.crack_density()[60]));
  BOOST_TEST(local.crack_density()[59] == 0.2187, tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(what_cannot_be_is_refused) {
  const auto refused = [](auto change) {
    Evolution evolution = paper();
    change(evolution);
    BOOST_CHECK_THROW(DamageEvolution(evolution, growth, one_cell), std::invalid_argument);
  };
  refused([](Evolution& e) { e.cap = -1; });
  refused([](Evolution& e) { e.reference_rate = 0; });
  refused([](Evolution& e) { e.rate = Rate::tracked, e.rate_floor = 0; });
  refused([](Evolution& e) { e.diffusion->characteristic_time = 0; });
  refused([](Evolution& e) { e.diffusion->crack_volume = 0; });
  refused([](Evolution& e) { e.diffusion->rupture_strain = 0; });
  refused([](Evolution& e) { e.diffusion->mobility = -1; });
  refused([](Evolution& e) { e.diffusion->radius = std::nan(""); });
  DamageEvolution e(paper(), growth, one_cell);
  BOOST_CHECK_THROW(e.advance(std::vector<double>(2, 0), 1), std::invalid_argument);
  BOOST_CHECK_THROW(e.advance(std::vector<double>(1, 0), 0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
