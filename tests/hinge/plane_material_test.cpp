#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "hinge/material/bifurcation.hpp"
#include "hinge/material/compression.hpp"
#include "hinge/material/plane.hpp"
#include "hinge/material/tensile_damage.hpp"

BOOST_AUTO_TEST_SUITE(plane_material)

using namespace diptych::material;
namespace tt = boost::test_tools;

namespace {

const double nan_value = std::numeric_limits<double>::quiet_NaN();

/// The paper's constants, section 4.
PlaneElastic rock(Plane plane = Plane::strain) { return {50e9, 0.3, 2500, plane}; }
TensileDamage damage_of(const PlaneElastic& elastic) {
  TensileDamage d;
  d.elastic = elastic;
  return d;
}
TensileDamage paper(Plane plane = Plane::strain) { return damage_of(rock(plane)); }

bool same(const Tensor& a, const Tensor& b) { return a.xx == b.xx && a.yy == b.yy && a.xy == b.xy; }
bool same(const Stiffness& a, const Stiffness& b) {
  return a.normal == b.normal && a.cross == b.cross && a.shear == b.shear;
}

struct Peak {
  double at, value;
};

double negative(double x, void* f) { return -(*static_cast<const std::function<double(double)>*>(f))(x); }

/// The maximum of f between a and b, from a guess between that lies above both.
Peak maximum(std::function<double(double)> f, double a, double guess, double b) {
  gsl_function minus{negative, &f};
  const std::unique_ptr<gsl_min_fminimizer, void (*)(gsl_min_fminimizer*)> solver(
      gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent), gsl_min_fminimizer_free);
  BOOST_REQUIRE(gsl_min_fminimizer_set(solver.get(), &minus, guess, a, b) == GSL_SUCCESS);
  for (int i = 0; i < 200; ++i) {
    if (gsl_min_fminimizer_iterate(solver.get()) != GSL_SUCCESS) break;
    const double low = gsl_min_fminimizer_x_lower(solver.get()), high = gsl_min_fminimizer_x_upper(solver.get());
    if (gsl_min_test_interval(low, high, 0, 1e-13) == GSL_SUCCESS) break;
  }
  return {gsl_min_fminimizer_x_minimum(solver.get()), -gsl_min_fminimizer_f_minimum(solver.get())};
}

/// The peak of the mean stress σ_m = 3 K (1 − D) ε_v under volumetric strain at a constant rate.
Peak peak_of_mean_stress(const TensileDamage& d, double rate) {
  const double scale = std::pow(rate * rate / d.crack_coefficient(), 1 / d.exponent);  // ε_v at C_d = 1
  const auto mean_stress = [&](double strain) {
    return 3 * d.elastic.bulk_modulus() * (1 - d.damage(d.crack_density(strain, rate))) * strain;
  };
  return maximum(mean_stress, 0.1 * scale, 0.7 * scale, scale);
}

/// The local law: σ(ε) at a fixed ε̇_max.
struct Local {
  TensileDamage damage;
  double rate = 100;

  double crack_density(const Tensor& strain) const { return damage.crack_density(damage.volumetric(strain), rate); }
  Tensor stress(const Tensor& strain) const {
    return damage.damaged_stiffness(crack_density(strain)).at(strain).stress(strain);
  }
  double slope(const Tensor& strain) const {
    return damage.exponent * crack_density(strain) / damage.volumetric(strain);
  }
  Bifurcation bifurcation(const Tensor& strain) const {
    return diptych::material::bifurcation(damage, strain, crack_density(strain), slope(strain));
  }
};

/// det Q(n) / det Q_whole(n) from differences of the local law's stress: nothing of the closed form.
double ratio_by_differences(const Local& local, const Tensor& strain, double angle) {
  const double size = std::sqrt(strain.contract(strain)), h = 1e-5 * size;
  const auto derivative = [&](const Tensor& along) {
    return (local.stress(strain + along * h) - local.stress(strain - along * h)) * (1 / (2 * h));
  };
  const Tensor by[2] = {derivative({1, 0, 0}), derivative({0, 1, 0})};
  const Tensor by_xy = derivative({0, 0, 1}) * 0.5;  // moves ε_xy and ε_yx at once
  const auto part = [](const Tensor& t, int i, int j) { return i != j ? t.xy : i == 0 ? t.xx : t.yy; };
  const double n[2] = {std::cos(angle), std::sin(angle)};
  double Q[2][2] = {};
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      for (int k = 0; k < 2; ++k) {
        for (int l = 0; l < 2; ++l) Q[j][k] += n[i] * part(k == l ? by[k] : by_xy, i, j) * n[l];
      }
    }
  }
  const Stiffness whole = local.damage.elastic.stiffness();
  return (Q[0][0] * Q[1][1] - Q[0][1] * Q[1][0]) / (whole.normal * whole.shear);
}

double shorter_way(double a, double b) {
  const double d = std::abs(a - b);
  return std::min(d, std::numbers::pi - d);
}

/// K = 10, G = 6, λ = 6.
PlaneElastic easy() { return {15, 0.25, 1, Plane::strain}; }

/// √(3 J₂) with the stress across the plane from three-dimensional Hooke's law.
double equivalent(const PlaneElastic& e, const Tensor& stress, const Tensor& strain, const PlasticStrain& plastic) {
  const Stiffness c = e.stiffness();
  const double zz = c.cross * (strain.xx + strain.yy) + 2 * c.shear * (plastic.xx + plastic.yy);
  const double mean = (stress.xx + stress.yy + zz) / 3;
  const double a = stress.xx - mean, b = stress.yy - mean, d = zz - mean;
  return std::sqrt(1.5 * (a * a + b * b + d * d + 2 * stress.xy * stress.xy));
}

double mean_stress(const PlaneElastic& e, const Tensor& stress, const Tensor& strain, const PlasticStrain& plastic) {
  const Stiffness c = e.stiffness();
  const double zz = c.cross * (strain.xx + strain.yy) + 2 * c.shear * (plastic.xx + plastic.yy);
  return (stress.xx + stress.yy + zz) / 3;
}

}  // namespace

// E = 15, ν = ¼: λ = G = 6. Plane strain: σ_xx = (λ + 2G) ε_xx + λ ε_yy. Plane stress: E/(1 − ν²) = 16, ν times it = 4.
BOOST_AUTO_TEST_CASE(hookes_law_in_the_plane) {
  const Stiffness strain = stiffness(15, 0.25, Plane::strain), stress = stiffness(15, 0.25, Plane::stress);
  BOOST_TEST((same(strain, {18, 6, 6})));
  BOOST_TEST((same(stress, {16, 4, 6})));
  BOOST_TEST((same(strain.stress({1, 2, 3}), {30, 42, 36})));
  BOOST_TEST((same(stress.stress({1, 2, 3}), {24, 36, 36})));
  BOOST_TEST((Tensor{1, 2, 3}.contract({4, 5, 6}) == 4 + 10 + 2 * 18));
}

// Three-dimensional Hooke's law with σ_zz = 0 and with ε_zz = 0 must give the same stress as the plane's.
BOOST_AUTO_TEST_CASE(plane_laws_are_hookes_law_in_space) {
  const double E = 50e9, nu = 0.3, G = E / (2 * (1 + nu)), lame = E * nu / ((1 + nu) * (1 - 2 * nu));
  const Tensor e{1e-3, -4e-4, 2e-4};
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    const PlaneElastic law = rock(plane);
    const double trace = law.trace_factor() * (e.xx + e.yy), zz = trace - e.xx - e.yy;
    const Tensor s = law.stiffness().stress(e);
    BOOST_TEST(s.xx == lame * trace + 2 * G * e.xx, tt::tolerance(1e-13));
    BOOST_TEST(s.yy == lame * trace + 2 * G * e.yy, tt::tolerance(1e-13));
    BOOST_TEST(s.xy == 2 * G * e.xy, tt::tolerance(1e-15));
    if (plane == Plane::strain) {
      BOOST_TEST(std::abs(zz) < 1e-18);
    } else {
      BOOST_TEST(std::abs(lame * trace + 2 * G * zz) < 1e-9 * std::abs(s.xx));
    }
  }
}

BOOST_AUTO_TEST_CASE(the_papers_moduli_and_speeds) {
  const PlaneElastic strain = rock(), stress = rock(Plane::stress);
  BOOST_TEST(std::abs(strain.bulk_modulus() - 41.67e9) < 0.005e9);
  BOOST_TEST(std::abs(strain.stiffness().shear - 19.23e9) < 0.005e9);
  BOOST_TEST(std::abs(strain.stiffness().normal - 67.31e9) < 0.005e9);
  BOOST_TEST(std::abs(strain.pressure_wave_speed() - 5189) < 0.5);
  BOOST_TEST(std::abs(stress.pressure_wave_speed() - 4688) < 0.5);
  BOOST_TEST(std::abs(strain.shear_wave_speed() - 2774) < 0.5);
  BOOST_TEST(stress.shear_wave_speed() == strain.shear_wave_speed());
  BOOST_TEST(std::abs(strain.uniaxial_wave_speed() - 4472) < 0.5);
}

// (5k/2) (K_IC/(ρ c))² = 1.25e23 · (1e6)²/(2500 · 50e9) = 1e21.
BOOST_AUTO_TEST_CASE(the_crack_density_of_the_papers_constants) {
  const TensileDamage d = paper();
  BOOST_TEST(d.crack_coefficient() == 1e21, tt::tolerance(1e-14));
  BOOST_TEST(d.crack_density(2e-3, 100) == 1e21 * 128e-21 / 1e4, tt::tolerance(1e-13));
  BOOST_TEST(d.crack_density(0, 100) == 0.0);
  BOOST_TEST(d.crack_density(-2e-3, 100) == 0.0);
}

BOOST_AUTO_TEST_CASE(damage_of_a_crack_density) {
  const TensileDamage d = paper();
  const double known[][2] = {{0.1, 0.330}, {0.2, 0.558}, {0.3, 0.726}, {0.4, 0.854}, {0.5, 0.951}};
  for (const auto& [crack_density, D] : known) BOOST_TEST(std::abs(d.damage(crack_density) - D) < 0.0005);
  BOOST_TEST(d.damage(0) == 0.0);
  BOOST_TEST(std::abs(d.damage(0.5625) - 1) <= std::numeric_limits<double>::epsilon());  // ν̄ = 0, D = (16/9)(9/16)
  BOOST_TEST(d.damaged_poissons_ratio(0.28125) == 0.15, tt::tolerance(1e-15));
  TensileDamage virgin_unloading = d;
  virgin_unloading.beta = 0;
  BOOST_TEST(virgin_unloading.alpha() == 0.0);
  BOOST_TEST(virgin_unloading.damaged_poissons_ratio(0.2) == 0.3);
  BOOST_TEST(virgin_unloading.damage(0.1) == 16 * 0.91 / (9 * 0.4) * 0.1, tt::tolerance(1e-14));
  BOOST_TEST(std::abs(virgin_unloading.damage(0.2472) - 1) < 5e-4);
  BOOST_TEST(virgin_unloading.damage(0.2473) == 1.0);
  TensileDamage half = d;
  half.beta = 0.5;
  BOOST_TEST(half.alpha() == 8.0 / 9, tt::tolerance(1e-15));
  BOOST_TEST(half.damaged_poissons_ratio(0.5) == 0.3 * (5.0 / 9), tt::tolerance(1e-14));
}

// Without the hold on ν̄, C_d = 3 has ν̄ = −1.3 and D = −0.99: a solid stiffer than the whole one.
BOOST_AUTO_TEST_CASE(what_has_ruptured_stays_ruptured) {
  for (const double beta : {1.0, 0.5, 0.0}) {
    for (const double nu : {0.3, 0.0, -0.3}) {
      TensileDamage d = paper();
      d.beta = beta;
      d.elastic.poissons_ratio = nu;
      double before = 0;
      for (const double crack_density : {0.05, 0.2, 0.5, 0.6, 0.9, 1.2, 2.0, 3.0, 30.0, 1e9}) {
        const double D = d.damage(crack_density);
        BOOST_TEST(D >= before);
        before = D;
        const Stiffness c = d.damaged_stiffness(crack_density).open;
        BOOST_TEST(c.shear > 0);
        BOOST_TEST(c.normal > std::abs(c.cross));
        BOOST_TEST(c.normal < d.elastic.stiffness().normal);
      }
      BOOST_TEST(before == 1.0);
    }
  }
}

// By hand at C_d = 0.1: ν̄ = 0.3 (1 − 8/45) = 0.3 · 37/45, K̄ from D, μ̄ = 3K̄(1 − 2ν̄)/(2(1 + ν̄)), λ̄ = K̄ − 2μ̄/3.
BOOST_AUTO_TEST_CASE(the_cracked_solids_stiffness_by_hand) {
  const double nu = 0.3 * 37 / 45;
  const double D = 16.0 / 9 * (1 - nu * nu) / (1 - 2 * nu) * 0.1;
  const double K = 125e9 / 3 * (1 - D), G = 3 * K * (1 - 2 * nu) / (2 * (1 + nu));
  BOOST_TEST(std::abs(G - 17.03e9) < 0.005e9);
  const Stiffness strain = paper().damaged_stiffness(0.1).open,
                  stress = paper(Plane::stress).damaged_stiffness(0.1).open;
  BOOST_TEST(strain.shear == G, tt::tolerance(1e-14));
  BOOST_TEST(strain.cross == K - 2 * G / 3, tt::tolerance(1e-13));
  BOOST_TEST(strain.normal == K + 4 * G / 3, tt::tolerance(1e-14));
  BOOST_TEST(stress.shear == G, tt::tolerance(1e-14));
  BOOST_TEST(stress.normal == 2 * G / (1 - nu), tt::tolerance(1e-14));
  BOOST_TEST(stress.cross == nu * stress.normal, tt::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(without_cracks_the_solid_is_whole_to_the_bit) {
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    for (int i = 0; i < 50; ++i) {  // round-off differs with ν: one alone may agree by chance
      TensileDamage d = paper(plane);
      d.elastic.poissons_ratio = -0.3 + 0.0157 * i;
      BOOST_TEST(same(d.damaged_stiffness(0).open, d.elastic.stiffness()));
      BOOST_TEST(same(d.damaged_stiffness(0).closed, d.elastic.stiffness()));
    }
    const auto cracked = paper(plane).damaged_stiffness(1e-300);
    const Stiffness whole = paper(plane).elastic.stiffness();
    for (const Stiffness& nearly : {cracked.open, cracked.closed}) {
      BOOST_TEST(nearly.normal == whole.normal, tt::tolerance(1e-14));  // and nothing jumps there
      BOOST_TEST(nearly.cross == whole.cross, tt::tolerance(1e-14));
      BOOST_TEST(nearly.shear == whole.shear, tt::tolerance(1e-14));
    }
  }
}

// At D = 1 a thousandth of K and of G: of E, with the whole solid's ν.
BOOST_AUTO_TEST_CASE(a_residual_stiffness_is_left) {
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    for (const double crack_density : {0.5625, 0.6, 5.0}) {
      const Stiffness c = paper(plane).damaged_stiffness(crack_density).open, whole = paper(plane).elastic.stiffness();
      BOOST_TEST(c.normal == 1e-3 * whole.normal, tt::tolerance(1e-12));
      BOOST_TEST(c.cross == 1e-3 * whole.cross, tt::tolerance(1e-12));
      BOOST_TEST(c.shear == 1e-3 * whole.shear, tt::tolerance(1e-12));
    }
  }
  TensileDamage none = paper();
  none.residual_stiffness = 0;
  BOOST_TEST(none.damaged_stiffness(0.6).open.normal == 0.0);
}

// K closes, G does not: at ε_v = 0 the two stresses are the same, whatever the shear, and neither modulus ever rises.
BOOST_AUTO_TEST_CASE(cracks_close_in_volume_only) {
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    for (const double beta : {1.0, 0.5, 0.0}) {
      for (const double nu : {-0.3, 0.0, 0.3, 0.45}) {  // beyond 0.395 eqs. 23c and d would raise G at first
        TensileDamage d = paper(plane);
        d.beta = beta;
        d.elastic.poissons_ratio = nu;
        const double K = d.elastic.bulk_modulus(), G = d.elastic.shear_modulus();
        double bulk = K, shear = G;
        for (const double crack_density : {1e-4, 1e-3, 0.01, 0.05, 0.1, 0.2, 0.4, 0.5, 0.6, 3.0}) {
          const auto c = d.damaged_stiffness(crack_density);
          BOOST_TEST(c.closed.shear == c.open.shear);
          BOOST_TEST(d.damaged_bulk_modulus(crack_density) <= bulk);
          BOOST_TEST(c.open.shear <= shear);
          bulk = d.damaged_bulk_modulus(crack_density);
          shear = c.open.shear;
          const Tensor sheared{2e-3, -2e-3, 3e-3};
          const Tensor open = c.open.stress(sheared), closed = c.closed.stress(sheared);
          BOOST_TEST(std::abs(open.xx - closed.xx) <= 1e-12 * K * 2e-3);
          BOOST_TEST(std::abs(open.yy - closed.yy) <= 1e-12 * K * 2e-3);
          BOOST_TEST(open.xy == closed.xy);
          if (plane == Plane::strain) {  // in plane stress ε_zz is another
            const Tensor pressed = c.closed.stress({-1e-3, -1e-3, 0});
            BOOST_TEST(pressed.xx == -2e-3 * (K + shear / 3), tt::tolerance(1e-12));
          }
          BOOST_TEST(&c.at({1e-3, -0.9e-3, 5}) == &c.open);
          BOOST_TEST(&c.at({1e-3, -1e-3, 5}) == &c.open);
          BOOST_TEST(&c.at({1e-3, -1.1e-3, 5}) == &c.closed);
          TensileDamage literal = d;
          literal.closure = diptych::material::Closure::whole;
          BOOST_TEST(same(literal.damaged_stiffness(crack_density).closed, d.elastic.stiffness()));
          BOOST_TEST(same(literal.damaged_stiffness(crack_density).open, c.open));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(how_volumetric_strain_is_read) {
  TensileDamage d = paper();
  const Tensor strain{1e-3, 2e-3, 5e-3};
  BOOST_TEST(d.volumetric(strain) == 1e-3, tt::tolerance(1e-15));
  d.trace = true;
  BOOST_TEST(d.volumetric(strain) == 3e-3, tt::tolerance(1e-15));
  d.elastic.plane = Plane::stress;  // (1 − 2ν)/(1 − ν) = 4/7
  BOOST_TEST(d.volumetric(strain) == 3e-3 * 4 / 7, tt::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(nan_stays_nan) {
  const TensileDamage d = paper();
  BOOST_TEST(std::isnan(d.crack_density(nan_value, 100)));
  BOOST_TEST(std::isnan(d.damage(nan_value)));
  for (const Stiffness& c : {d.damaged_stiffness(nan_value).open, d.damaged_stiffness(nan_value).closed}) {
    BOOST_TEST((std::isnan(c.normal) && std::isnan(c.cross) && std::isnan(c.shear)));
  }
  BOOST_TEST(std::isnan(bifurcation(d, {nan_value, 0, 0}, 0.1, 1).least_ratio));
  BOOST_TEST(std::isnan(bifurcation(d, {1e-3, 0, 0}, nan_value, 1).least_ratio));
  PlasticStrain state;
  BOOST_TEST(std::isnan(Compression{1, 0}.stress(easy(), {nan_value, 0, 0}, state).xx));
}

// C_d at the peak of (1 − D(C_d)) C_d^(1/m) does not know the rate, so stress and strain there go as rate^(2/m).
BOOST_AUTO_TEST_CASE(peaks_at_a_constant_rate) {
  const TensileDamage d = paper();
  const double known[][3] = {
      {10, 130, 0.00120}, {30, 178, 0.00164}, {100, 251, 0.00232}, {300, 343, 0.00317}, {1000, 484, 0.00447}};
  const Peak unit = peak_of_mean_stress(d, 1);
  for (const auto& [rate, stress, strain] : known) {
    const Peak peak = peak_of_mean_stress(d, rate);
    BOOST_TEST(std::abs(peak.value - stress * 1e6) < 0.5e6);
    BOOST_TEST(std::abs(peak.at - strain) < 0.5e-5);
    BOOST_TEST(peak.value / unit.value == std::pow(rate, 2.0 / 7), tt::tolerance(1e-13));
    // A maximum is flat: its place is known to the root of round-off only.
    BOOST_TEST(peak.at / unit.at == std::pow(rate, 2.0 / 7), tt::tolerance(1e-7));
    BOOST_TEST(d.crack_density(peak.at, rate) == d.crack_density(unit.at, 1), tt::tolerance(1e-6));
  }
  // There m C_d dD/dC_d = 1 − D; dD/dC_d by differences.
  const double c = d.crack_density(unit.at, 1), h = 1e-6;
  BOOST_TEST(7 * c * (d.damage(c + h) - d.damage(c - h)) / (2 * h) == 1 - d.damage(c), tt::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(the_rate_of_the_damaged_stiffness) {
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    for (const double beta : {1.0, 0.5, 0.0}) {
      TensileDamage d = paper(plane);
      d.beta = beta;
      for (const double c : {1e-3, 0.05, 0.2, 0.4, 0.7}) {
        const double h = 1e-6;
        const Stiffness high = d.damaged_stiffness(c + h).open, low = d.damaged_stiffness(c - h).open;
        const Stiffness rate = damaged_stiffness_rate(d, c);
        const double size = 1e-9 * d.elastic.stiffness().normal;  // of the differences' round-off, 1e-16/h, tenfold
        BOOST_TEST(std::abs(rate.normal - (high.normal - low.normal) / (2 * h)) < size);
        BOOST_TEST(std::abs(rate.cross - (high.cross - low.cross) / (2 * h)) < size);
        BOOST_TEST(std::abs(rate.shear - (high.shear - low.shear) / (2 * h)) < size);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_whole_solid_does_not_localise) {
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    for (const Tensor& strain : {Tensor{1e-3, 0, 0}, Tensor{1e-3, -2e-4, 3e-4}, Tensor{0, 0, 0}}) {
      const Bifurcation b = bifurcation(paper(plane), strain, 0, 0);
      BOOST_TEST(b.least_ratio == 1.0);
      BOOST_TEST(b.angle == 0.0);
    }
    // Closed in compression cracks do not grow: an isotropic solid, whose shear modulus is the cracked one.
    const auto closed = paper(plane).damaged_stiffness(0.4).closed;
    const Stiffness whole = paper(plane).elastic.stiffness();
    BOOST_TEST(bifurcation(paper(plane), {-1e-3, 0, 0}, 0.4, 1e4).least_ratio ==
                   closed.normal * closed.shear / (whole.normal * whole.shear),
               tt::tolerance(1e-14));
    TensileDamage literal = paper(plane);
    literal.closure = diptych::material::Closure::whole;
    BOOST_TEST(bifurcation(literal, {-1e-3, 0, 0}, 0.4, 1e4).least_ratio == 1.0);
  }
}

// A crack density that does not follow the strain leaves an isotropic solid: every direction alike, never singular.
BOOST_AUTO_TEST_CASE(the_secant_stiffness_does_not_localise) {
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    const TensileDamage d = paper(plane);
    for (const double c : {0.01, 0.1, 0.3, 0.5, 0.5625, 2.0}) {
      const Bifurcation b = bifurcation(d, {2e-3, -1e-3, 5e-4}, c, 0);
      const Stiffness cracked = d.damaged_stiffness(c).open, whole = d.elastic.stiffness();
      BOOST_TEST(b.least_ratio == cracked.normal * cracked.shear / (whole.normal * whole.shear), tt::tolerance(1e-15));
      BOOST_TEST(b.least_ratio > 0);
      BOOST_TEST(b.angle == 0.0);
    }
  }
}

// The closed form against a scan of determinants of a tangent by differences, both planes, all choices.
BOOST_AUTO_TEST_CASE(the_least_determinant_is_that_of_a_scan) {
  const int directions = 720;
  int localised = 0;
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    for (const bool trace : {false, true}) {
      for (const double beta : {1.0, 0.3}) {
        Local local{paper(plane), 100};
        local.damage.trace = trace;
        local.damage.beta = beta;
        for (const Tensor& shape : {Tensor{1, 0, 0}, Tensor{0.2, 1, 0}, Tensor{1, -0.3, 0.4}, Tensor{0.5, 0.4, -0.8}}) {
          for (const double volume : {1e-3, 2e-3, 2.5e-3}) {
            const Tensor strain = shape * (volume / local.damage.volumetric(shape));
            double least = std::numeric_limits<double>::infinity(), at = 0;
            for (int i = 0; i < directions; ++i) {
              const double angle = i * std::numbers::pi / directions;
              const double ratio = ratio_by_differences(local, strain, angle);
              if (ratio < least) {
                least = ratio;
                at = angle;
              }
            }
            const Bifurcation b = local.bifurcation(strain);
            // The scan meets the minimum within half its step, where the ratio is flat.
            BOOST_TEST(std::abs(b.least_ratio - least) < 2e-5);
            BOOST_TEST(shorter_way(b.angle, at) < 0.02);
            BOOST_TEST((b.angle >= 0 && b.angle < std::numbers::pi));
            BOOST_TEST(ratio_by_differences(local, strain, b.angle) == b.least_ratio, tt::tolerance(1e-6));
            localised += b.least_ratio <= 0;
          }
        }
      }
    }
  }
  BOOST_TEST(localised > 0);
}

// Uniaxial strain: det Q(n) of n along the load is μ̄ dσ/dε, so localisation begins at the peak of the curve, not
// before.
BOOST_AUTO_TEST_CASE(uniaxial_strain_localises_at_its_peak) {
  for (const double rate : {10.0, 100.0}) {
    for (const bool trace : {false, true}) {
      Local local{paper(), rate};
      local.damage.trace = trace;
      const double scale = (trace ? 1 : 3) * std::pow(rate * rate / local.damage.crack_coefficient(), 1.0 / 7);
      const auto stress = [&](double e) { return local.stress({e, 0, 0}).xx; };
      const Peak peak = maximum(stress, 0.3 * scale, 0.7 * scale, 0.9 * scale);
      BOOST_TEST(std::abs(local.bifurcation({peak.at, 0, 0}).least_ratio) < 1e-6);
      BOOST_TEST(local.bifurcation({peak.at * (1 - 1e-6), 0, 0}).least_ratio > 0);
      BOOST_TEST(local.bifurcation({peak.at * (1 + 1e-6), 0, 0}).least_ratio < 0);
      for (int i = 1; i < 100; ++i) BOOST_TEST(local.bifurcation({peak.at * i / 100, 0, 0}).least_ratio > 0);
      const double e = 1.02 * peak.at, pi = std::numbers::pi;
      BOOST_TEST(local.bifurcation({e, 0, 0}).angle == 0.0);
      BOOST_TEST(local.bifurcation({0, e, 0}).angle == pi / 2, tt::tolerance(1e-15));
      BOOST_TEST(local.bifurcation({e / 2, e / 2, e / 2}).angle == pi / 4, tt::tolerance(1e-12));
      BOOST_TEST(local.bifurcation({e / 2, e / 2, -e / 2}).angle == 3 * pi / 4, tt::tolerance(1e-12));
    }
  }
}

BOOST_AUTO_TEST_CASE(inside_the_cone_the_solid_is_elastic_to_the_bit) {
  const PlaneElastic e = rock();
  const Compression cone{1e8, 0.6};
  for (const Tensor& strain : {Tensor{-1e-3, -2e-4, 1e-4}, Tensor{-1e-3, -1e-3, 0}, Tensor{1e-3, 2e-3, 8e-2},
                               Tensor{1e-2, -1e-2, 3e-2}, Tensor{0, 0, 0}}) {
    PlasticStrain state;
    double dissipated = 1;
    const Tensor stress = cone.stress(e.stiffness(), strain, state, dissipated);
    BOOST_TEST(same(stress, e.stiffness().stress(strain)));
    BOOST_TEST(same(state, {}));
    BOOST_TEST(dissipated == 0.0);
  }
}

// tr ε = −0.2: p = 2. Trial deviator 12 (−1/30, −1/30, 0.2), zz 12/15: (−0.4, −0.4, 2.4), zz 0.8; 3 J₂ = 18.72.
BOOST_AUTO_TEST_CASE(the_return_to_the_cone_by_hand) {
  const PlaneElastic e = easy();
  const Compression cone{1, 0.5};  // √(3 J₂) ≤ 2 at p = 2
  const Tensor strain{-0.1, -0.1, 0.2};
  PlasticStrain state;
  double dissipated = 0;
  const Tensor stress = cone.stress(e.stiffness(), strain, state, dissipated);
  const double kept = 2 / std::sqrt(18.72);
  BOOST_TEST(stress.xx == -2 - 0.4 * kept, tt::tolerance(1e-14));
  BOOST_TEST(stress.yy == -2 - 0.4 * kept, tt::tolerance(1e-14));
  BOOST_TEST(stress.xy == 2.4 * kept, tt::tolerance(1e-14));
  BOOST_TEST(state.xx == -0.4 * (1 - kept) / 12, tt::tolerance(1e-13));
  BOOST_TEST(state.xy == 2.4 * (1 - kept) / 12, tt::tolerance(1e-13));
  BOOST_TEST(equivalent(e, stress, strain, state) == 2.0, tt::tolerance(1e-14));
  BOOST_TEST(mean_stress(e, stress, strain, state) == -2.0, tt::tolerance(1e-14));
  // σ : Δε_p with zz: kept s : s (1 − kept)/(2G), s : s = 12.48.
  BOOST_TEST(dissipated == 12.48 * kept * (1 - kept) / 12, tt::tolerance(1e-13));
  PlasticStrain other;
  BOOST_TEST(same(cone.stress(e, strain, other), stress));
  BOOST_TEST(same(other, state));
}

BOOST_AUTO_TEST_CASE(the_return_is_onto_the_cone_from_anywhere) {
  const PlaneElastic e = rock();
  const Stiffness c = e.stiffness();
  const Compression cone{5e7, 0.4};
  PlasticStrain state;
  int returned = 0;
  for (int i = 0; i < 500; ++i) {
    const Tensor strain{-4e-3 + 5e-3 * std::sin(0.7 * i), -2e-3 + 4e-3 * std::cos(1.1 * i), 4e-3 * std::sin(0.3 * i)};
    const PlasticStrain before = state;
    double dissipated = 0;
    const Tensor stress = cone.stress(c, strain, state, dissipated);
    const double p = -e.bulk_modulus() * (strain.xx + strain.yy), size = std::abs(p) + 1e6;
    BOOST_TEST(std::abs(mean_stress(e, stress, strain, state) + p) < 1e-13 * c.normal);
    BOOST_TEST(dissipated >= 0);
    if (p <= 0) {
      BOOST_TEST(same(state, before));
      BOOST_TEST(same(stress, c.stress(strain) - state * (2 * c.shear)));
    } else {
      BOOST_TEST(equivalent(e, stress, strain, state) <= cone.strength + cone.slope * p + 1e-13 * c.normal);
    }
    if (same(state, before)) continue;
    ++returned;
    BOOST_TEST(equivalent(e, stress, strain, state) == cone.strength + cone.slope * p, tt::tolerance(1e-10));
    const Tensor flow = state - before;
    const double zz = -3 * p - stress.xx - stress.yy;
    const double work = stress.contract(flow) + zz * -(flow.xx + flow.yy);
    BOOST_TEST(std::abs(dissipated - work) < 1e-13 * size);
    // On the cone nothing more happens but round-off.
    PlasticStrain again = state;
    double more = 0;
    const Tensor still = cone.stress(c, strain, again, more);
    BOOST_TEST(std::abs(still.xy - stress.xy) < 1e-13 * c.normal);
    BOOST_TEST(more < 1e-12 * (dissipated + 1));
  }
  BOOST_TEST(returned > 100);
}

// What is put in is stored or dissipated; the return takes the stress at the end of each increment, so the balance
// closes with the first power of its size.
BOOST_AUTO_TEST_CASE(work_is_stored_or_dissipated) {
  const PlaneElastic e = rock();
  const Stiffness c = e.stiffness();
  const Compression cone{5e7, 0.4};
  const auto imbalance = [&](int steps) {
    PlasticStrain state;
    Tensor strain, stress;
    double work = 0, dissipated = 0, total = 0;
    for (int i = 1; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      const Tensor next{-4e-3 * t, -1e-3 * t, 3e-3 * t * t};
      double step = 0;
      const Tensor after = cone.stress(c, next, state, step);
      work += ((stress + after) * 0.5).contract(next - strain);
      dissipated += step;
      strain = next;
      stress = after;
    }
    total = Compression::stored(c, strain, state) + dissipated;
    BOOST_TEST(dissipated > 0.05 * work);
    return (work - total) / work;
  };
  BOOST_TEST(std::abs(imbalance(1000)) < 1e-3);
  BOOST_TEST(imbalance(1000) / imbalance(2000) == 2.0, tt::tolerance(0.02));
  // Elastic: ½ σ : ε.
  const Tensor strain{-1e-4, 2e-4, 5e-5};
  BOOST_TEST(Compression::stored(c, strain, {}) == c.stress(strain).contract(strain) / 2, tt::tolerance(1e-13));
}

BOOST_AUTO_TEST_SUITE_END()
