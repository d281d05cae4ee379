// Dispersion, stability and predicted errors against independent sources: quadrature of the Airy integrals, eigenvalues
// of Bloch and free-bar amplification matrices, and small solvers written here for the purpose.
#include "analytic/discrete.hpp"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_airy.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "analytic/bar_wave.hpp"
#include "analytic/standing_mode.hpp"

BOOST_AUTO_TEST_SUITE(discrete)

namespace {

using namespace diptych::analytic;
using Complex = std::complex<double>;
using boost::test_tools::tolerance;
constexpr double pi = std::numbers::pi;

const std::vector<std::vector<double>> symmetric_sets{{0.5}, {0.25, 0.75}, {1.0 / 6, 0.5, 5.0 / 6}, {0.02, 0.98}};
const std::vector<std::vector<double>> skew_sets{{0.1}, {0.3}, {0.9, 0.6}, {0.05, 0.3, 0.9}, {0, 0.05, 0.78}};
constexpr Scheme mpm_schemes[] = {Scheme::mpm_usf, Scheme::mpm_usl, Scheme::mpm_musl};

std::vector<std::vector<double>> all_sets() {
  auto sets = symmetric_sets;
  sets.insert(sets.end(), skew_sets.begin(), skew_sets.end());
  return sets;
}

/// Eigenvalues of a complex matrix, and their conjugates: GSL has them for real matrices only, and [Re −Im; Im Re] has
/// both.
std::vector<Complex> eigenvalues(const std::vector<std::vector<Complex>>& columns) {
  const std::size_t n = columns.size();
  const std::unique_ptr<gsl_matrix, decltype(&gsl_matrix_free)> matrix(gsl_matrix_alloc(2 * n, 2 * n),
                                                                       &gsl_matrix_free);
  const std::unique_ptr<gsl_vector_complex, decltype(&gsl_vector_complex_free)> values(gsl_vector_complex_alloc(2 * n),
                                                                                       &gsl_vector_complex_free);
  const std::unique_ptr<gsl_eigen_nonsymm_workspace, decltype(&gsl_eigen_nonsymm_free)> workspace(
      gsl_eigen_nonsymm_alloc(2 * n), &gsl_eigen_nonsymm_free);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n; ++i) {
      gsl_matrix_set(matrix.get(), i, j, columns[j][i].real());
      gsl_matrix_set(matrix.get(), i + n, j + n, columns[j][i].real());
      gsl_matrix_set(matrix.get(), i + n, j, columns[j][i].imag());
      gsl_matrix_set(matrix.get(), i, j + n, -columns[j][i].imag());
    }
  }
  BOOST_TEST_REQUIRE(gsl_eigen_nonsymm(matrix.get(), values.get(), workspace.get()) == GSL_SUCCESS);
  std::vector<Complex> result;
  for (std::size_t i = 0; i < 2 * n; ++i) {
    const gsl_complex value = gsl_vector_complex_get(values.get(), i);
    result.emplace_back(GSL_REAL(value), GSL_IMAG(value));
  }
  return result;
}

double spectral_radius(const std::vector<std::vector<Complex>>& columns) {
  double radius = 0;
  for (const auto& value : eigenvalues(columns)) radius = std::max(radius, std::abs(value));
  return radius;
}

/// One step of a scheme on exp(ikx): one cell, h = E = ρ = 1, whose right node is its left node times z = exp(iθ).
std::vector<std::vector<Complex>> bloch_matrix(const Discretisation& d, double theta) {
  const Complex z = std::polar(1.0, theta), before = std::conj(z);
  const auto& xi = d.positions;
  const std::size_t n = d.scheme == Scheme::fem ? 1 : xi.size();
  std::vector<std::vector<Complex>> columns;
  for (std::size_t j = 0; j < 2 * n; ++j) {
    std::vector<Complex> state(2 * n);
    state[j] = 1;
    Complex* const v = state.data();
    Complex* const stress = v + n;
    if (d.scheme == Scheme::fem) {
      v[0] += d.courant * (stress[0] - before * stress[0]);
      stress[0] += d.courant * (z - 1.0) * v[0];
    } else {
      const double m = 1 / static_cast<double>(n);
      const auto mapped = [&] {
        Complex momentum = 0;
        for (std::size_t p = 0; p < n; ++p) momentum += m * (1 - xi[p] + xi[p] * before) * v[p];
        return momentum;  // node mass 1
      };
      const auto strain = [&](Complex node) {
        for (std::size_t p = 0; p < n; ++p) stress[p] += d.courant * (z - 1.0) * node;
      };
      const Complex node = mapped();
      if (d.scheme == Scheme::mpm_usf) strain(node);
      Complex a = 0;
      for (std::size_t p = 0; p < n; ++p) a += m * (1.0 - before) * stress[p];
      for (std::size_t p = 0; p < n; ++p) v[p] += d.courant * (1 - xi[p] + xi[p] * z) * a;
      if (d.scheme == Scheme::mpm_usl) strain(node + d.courant * a);
      if (d.scheme == Scheme::mpm_musl) strain(mapped());
    }
    columns.push_back(state);
  }
  return columns;
}

double bloch_radius(const Discretisation& d) {
  double radius = 0;
  for (int i = 1; i <= 180; ++i) radius = std::max(radius, spectral_radius(bloch_matrix(d, pi * i / 180)));
  return radius;
}

/// A bar of particles that stay where they are, h = E = ρ = 1, loaded at its right end.
struct ParticleBar {
  Discretisation d;
  std::size_t cells;
  bool fixed_left = false, fixed_right = false;
  double load = 0;
  std::vector<double> v, stress, u;

  ParticleBar(Discretisation scheme, std::size_t cell_count)
      : d(std::move(scheme)), cells(cell_count), v(cells * d.positions.size()), stress(v.size()), u(v.size()) {}

  template <class F>
  void each(F f) const {
    const std::size_t n = d.positions.size();
    for (std::size_t p = 0; p < v.size(); ++p) f(p, p / n, d.positions[p % n]);
  }
  double x(std::size_t p) const {
    const std::size_t n = d.positions.size();
    return static_cast<double>(p / n) + d.positions[p % n];
  }

  void step() {
    const double dt = d.courant, mp = 1 / static_cast<double>(d.positions.size());
    std::vector<double> m(cells + 1), f(cells + 1), node(cells + 1), a(cells + 1), updated(cells + 1);
    each([&](auto, auto e, double xi) { m[e] += mp * (1 - xi), m[e + 1] += mp * xi; });
    const auto hold = [&](std::vector<double>& values) {
      if (fixed_left) values.front() = 0;
      if (fixed_right) values.back() = 0;
    };
    const auto map = [&] {
      std::fill(node.begin(), node.end(), 0);
      each([&](auto p, auto e, double xi) {
        node[e] += mp * (1 - xi) * v[p] / m[e];
        node[e + 1] += mp * xi * v[p] / m[e + 1];
      });
      hold(node);
    };
    const auto strain = [&](const std::vector<double>& w) {
      each([&](auto p, auto e, double) { stress[p] += dt * (w[e + 1] - w[e]); });
    };
    map();
    if (d.scheme == Scheme::mpm_usf) strain(node);
    each([&](auto p, auto e, double) { f[e] += mp * stress[p], f[e + 1] -= mp * stress[p]; });
    f[cells] += load;
    for (std::size_t i = 0; i <= cells; ++i) a[i] = f[i] / m[i];
    hold(a);
    for (std::size_t i = 0; i <= cells; ++i) updated[i] = node[i] + dt * a[i];
    each([&](auto p, auto e, double xi) {
      v[p] += dt * ((1 - xi) * a[e] + xi * a[e + 1]);
      u[p] += dt * ((1 - xi) * updated[e] + xi * updated[e + 1]);
    });
    if (d.scheme == Scheme::mpm_usl) strain(updated);
    if (d.scheme == Scheme::mpm_musl) {
      map();
      strain(node);
    }
  }
};

/// The same in finite elements; velocities start half a step late.
struct ElementBar {
  Discretisation d;
  std::size_t cells;
  bool fixed_left = false, fixed_right = false;
  double load = 0;
  std::vector<double> v, stress, u;

  ElementBar(Discretisation scheme, std::size_t cell_count)
      : d(std::move(scheme)), cells(cell_count), v(cells + 1), stress(cells), u(v) {}

  double x(std::size_t i) const { return static_cast<double>(i); }

  void step() {
    std::vector<double> f(cells + 1);
    for (std::size_t e = 0; e < cells; ++e) f[e] += stress[e], f[e + 1] -= stress[e];
    f[cells] += load;
    for (std::size_t i = 0; i <= cells; ++i) v[i] += d.courant * f[i] / (i == 0 || i == cells ? 0.5 : 1);
    if (fixed_left) v.front() = 0;
    if (fixed_right) v.back() = 0;
    for (std::size_t i = 0; i <= cells; ++i) u[i] += d.courant * v[i];
    for (std::size_t e = 0; e < cells; ++e) stress[e] = u[e + 1] - u[e];
  }
};

double free_bar_radius(const Discretisation& d, std::size_t cells) {
  std::vector<std::vector<Complex>> columns;
  const std::size_t n = cells * d.positions.size();
  for (std::size_t j = 0; j < 2 * n; ++j) {
    ParticleBar bar(d, cells);
    (j < n ? bar.v[j] : bar.stress[j - n]) = 1;
    bar.step();
    std::vector<Complex> column(bar.v.begin(), bar.v.end());
    column.insert(column.end(), bar.stress.begin(), bar.stress.end());
    columns.push_back(column);
  }
  return spectral_radius(columns);
}

/// Weighted-mean norms of samples.
struct Norms {
  double sum1 = 0, sum2 = 0, weight = 0, largest = 0;
  void add(double error, double w = 1) {
    sum1 += w * std::abs(error);
    sum2 += w * error * error;
    weight += w;
    largest = std::max(largest, std::abs(error));
  }
  double operator()(Norm norm) const {
    return norm == Norm::l1 ? sum1 / weight : norm == Norm::l2 ? std::sqrt(sum2 / weight) : largest;
  }
};

/// Integrals of the error over pieces between `breaks` by Gauss's two points, exact for squares of linear pieces.
template <class Field>
Norms integrated(std::vector<double> breaks, double length, const Field& field, const ExactSolution& exact,
                 BarQuantity quantity, double t) {
  for (const auto& front : exact.fronts(t)) breaks.push_back(front.position);
  breaks.insert(breaks.end(), {0, length});
  std::sort(breaks.begin(), breaks.end());
  Norms norms;
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double middle = (breaks[i - 1] + breaks[i]) / 2, half = (breaks[i] - breaks[i - 1]) / 2;
    if (half < 1e-9) continue;
    for (const double x : {middle - half / std::sqrt(3), middle + half / std::sqrt(3)})
      norms.add(field(x) - exact.at(quantity, x, t), half);
  }
  return norms;
}

double on_line(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, at);
  const auto i = static_cast<std::size_t>(above - x.begin());
  return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
}

template <class Bar>
Norms error(const Bar& bar, const ExactSolution& exact, BarQuantity quantity, double t) {
  const double length = static_cast<double>(bar.cells);
  std::vector<double> breaks;
  if (quantity == BarQuantity::stress) {
    const std::size_t per_cell = bar.stress.size() / bar.cells;  // equal within a cell
    for (std::size_t e = 0; e < bar.cells; ++e) breaks.push_back(static_cast<double>(e));
    const auto field = [&](double x) { return bar.stress[static_cast<std::size_t>(x) * per_cell]; };
    return integrated(breaks, length, field, exact, quantity, t);
  }
  for (std::size_t i = 0; i < bar.u.size(); ++i) breaks.push_back(bar.x(i));
  const auto& values = quantity == BarQuantity::velocity ? bar.v : bar.u;
  return integrated(
      breaks, length, [&](double x) { return on_line(breaks, values, x); }, exact, quantity, t);
}

BarWave step_bar(double length) { return BarWave({1, 1, length, {true, {}}, {false, Traction::step(1)}}); }

/// Runs a step load and compares measured with predicted errors.
template <class Bar>
void check_step(Bar bar, double within, double displacement_within) {
  const double length = static_cast<double>(bar.cells), dt = bar.d.courant;
  const bool usf = bar.d.scheme == Scheme::mpm_usf;
  const auto exact = step_bar(length);
  bar.fixed_left = true;
  bar.load = usf ? 1 : 0.5;  // half a kick where the first velocity belongs to half a step
  int looked_at = 0;
  long n = 0;
  for (const double ct : {0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.5, 3.25}) {
    for (; n < std::lround(ct * length / dt); ++n, bar.load = 1) bar.step();
    const double now = static_cast<double>(n) * dt;
    const auto check = [&](BarQuantity quantity, Norm norm, double t, double low, double high) {
      const auto predicted = predicted_error(exact, bar.d, quantity, norm, t);
      BOOST_TEST_REQUIRE(predicted.has_value());
      const double ratio = error(bar, exact, quantity, t)(norm) / *predicted;
      BOOST_TEST((ratio > low && ratio < high), "ratio " << ratio << " at ct = " << ct << " L, quantity "
                                                         << static_cast<int>(quantity) << ", norm "
                                                         << static_cast<int>(norm));
      ++looked_at;
    };
    const double displaced = usf ? now + dt / 2 : now;
    check(BarQuantity::stress, Norm::l2, usf ? now - dt / 2 : now, 1 - within, 1 + within);
    check(BarQuantity::displacement, Norm::l2, displaced, 1 - displacement_within, 1 + displacement_within);
    if (bar.d.scheme != Scheme::mpm_usl && ct != 1) check(BarQuantity::displacement, Norm::linf, displaced, 0.86, 1.07);
  }
  BOOST_TEST(looked_at == (bar.d.scheme == Scheme::mpm_usl ? 16 : 23));
}

const Discretisation fem(double cell, double courant) { return {Scheme::fem, cell, courant, {}}; }

/// ∫ from 0 to end.
template <class F>
double quadrature(F f, double end) {
  const std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)> workspace(
      gsl_integration_workspace_alloc(20000), &gsl_integration_workspace_free);
  gsl_function integrand{[](double x, void* g) { return (*static_cast<F*>(g))(x); }, &f};
  double result = 0, estimate = 0;
  BOOST_TEST_REQUIRE(gsl_integration_qag(&integrand, 0, end, 0, 1e-10, 20000, GSL_INTEG_GAUSS61, workspace.get(),
                                         &result, &estimate) == GSL_SUCCESS);
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE(filters) {
  BOOST_TEST(particle_filter(fem(1, 0.5)) == 0);
  BOOST_TEST(particle_filter({Scheme::mpm_usl, 1, 0.5, {0.5}}) == 1);
  BOOST_TEST(particle_filter({Scheme::mpm_musl, 1, 0.5, {0.25, 0.75}}) == 0.75, tolerance(1e-15));
  BOOST_TEST(particle_filter({Scheme::mpm_usf, 1, 0.5, {0, 1}}) == 0);
}

BOOST_AUTO_TEST_CASE(bad_discretisations_are_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto usl = [](std::vector<double> positions) {
    return Discretisation{Scheme::mpm_usl, 1, 0.5, std::move(positions)};
  };
  for (const auto& d : {fem(0, 0.5), fem(nan, 0.5), fem(1, 0), usl({}), usl({1.1}), usl({0.5, nan})}) {
    BOOST_CHECK_THROW(particle_filter(d), std::invalid_argument);
    BOOST_CHECK_THROW(stability_limit(d), std::invalid_argument);
    BOOST_CHECK_THROW(step_factor(d, 1), std::invalid_argument);
    BOOST_CHECK_THROW(front_width(d, 1), std::invalid_argument);
    BOOST_CHECK_THROW(predicted_error(step_bar(1), d, BarQuantity::stress, Norm::l2, 1), std::invalid_argument);
  }
  BOOST_CHECK_THROW(step_factor(fem(1, 1), 4), std::invalid_argument);
  BOOST_CHECK_THROW(front_width(fem(1, 1), -1), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(step_factor_is_an_eigenvalue_of_the_bloch_matrix) {
  int looked_at = 0;
  const auto check = [&](const Discretisation& d) {
    for (const double theta : {1e-3, 0.3, 1.1, 2.0, 2.7, pi}) {
      const auto factor = step_factor(d, theta);
      BOOST_TEST_REQUIRE(std::isfinite(factor.phase));
      BOOST_TEST((factor.phase >= 0 && factor.phase <= pi));
      const auto lambda = std::polar(std::exp(-factor.damping), factor.phase);
      double nearest = 1, radius = 0;
      for (const auto& value : eigenvalues(bloch_matrix(d, theta))) {
        nearest = std::min(nearest, std::abs(value - lambda));
        radius = std::max(radius, std::abs(value));
      }
      BOOST_TEST(nearest < 1e-6, "C = " << d.courant << ", theta = " << theta);  // double eigenvalues at the limits
      if (factor.damping < 0) BOOST_TEST(radius == std::exp(-factor.damping), tolerance(1e-6));  // the one that grows
      ++looked_at;
    }
  };
  for (const double courant : {0.2, 0.5, 0.8, 1.0, 1.3}) {
    check(fem(1, courant));
    for (const auto& positions : all_sets())
      for (const auto scheme : mpm_schemes) check({scheme, 1, courant, positions});
  }
  BOOST_TEST(looked_at == 5 * 6 * (1 + 3 * 9));
}

BOOST_AUTO_TEST_CASE(step_factor_at_its_ends) {
  for (const auto& d : {fem(1, 0.5), Discretisation{Scheme::mpm_usl, 1, 0.5, {0.5}}}) {
    const auto still = step_factor(d, 0);
    BOOST_TEST(still.phase == 0);
    BOOST_TEST(still.damping == 0);
    BOOST_TEST(step_factor(d, 1e-9).phase == 0.5e-9, tolerance(1e-12));  // no cancellation
  }
  BOOST_TEST(step_factor(fem(1, 1), 1.7).phase == 1.7, tolerance(1e-14));  // the magic step
  BOOST_TEST(step_factor(fem(1, 1), pi).phase == pi, tolerance(1e-7));
  BOOST_TEST(step_factor(fem(1, 1.1), pi).phase == pi);
  BOOST_TEST(step_factor(fem(1, 1.1), pi).damping == -2 * std::acosh(1.1), tolerance(1e-12));
  BOOST_TEST(step_factor({Scheme::mpm_usl, 1, 0.8, {0.5}}, pi).damping < 0);
  // modified equation: ω_h/ω = 1 − (kh)²(1 + 3a − C²)/24
  for (const auto& d : {fem(1, 0.7), Discretisation{Scheme::mpm_usl, 1, 0.4, {0.3}},
                        Discretisation{Scheme::mpm_musl, 1, 1.1, {0.25, 0.75}}}) {
    const double theta = 0.01, a = particle_filter(d), c = d.courant;
    const double lag = 1 - step_factor(d, theta).phase / (c * theta);
    BOOST_TEST(lag == theta * theta * (1 + 3 * a - c * c) / 24, tolerance(1e-3));
  }
  const double theta = 0.02;
  BOOST_TEST(step_factor({Scheme::mpm_usl, 1, 0.4, {0.5}}, theta).damping == 2 * 0.16 * std::pow(theta / 2, 4),
             tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(limits_in_closed_form) {
  const auto limit = [](Scheme scheme, std::vector<double> xi) {
    return stability_limit({scheme, 1, 0.5, std::move(xi)});
  };
  BOOST_TEST(stability_limit(fem(1, 0.5)) == 1);
  for (const auto scheme : {Scheme::mpm_usf, Scheme::mpm_musl}) {
    BOOST_TEST(limit(scheme, {0.5}) == 2, tolerance(1e-14));
    BOOST_TEST(limit(scheme, {0.25, 0.75}) == std::sqrt(3), tolerance(1e-14));
    BOOST_TEST(limit(scheme, {0.01}) == 1 / std::sqrt(1 - 0.0396), tolerance(1e-14));
  }
  BOOST_TEST(limit(Scheme::mpm_usl, {0.5}) == std::sqrt(0.5), tolerance(1e-14));
  BOOST_TEST(limit(Scheme::mpm_usl, {0.25, 0.75}) == 1 / std::sqrt(1.75), tolerance(1e-14));
  BOOST_TEST(limit(Scheme::mpm_usl, {0}) == 0);
  for (const double xi : {0.01, 0.05, 0.1, 0.3, 0.8})
    BOOST_TEST(limit(Scheme::mpm_usl, {xi}) == std::sqrt(2 * xi * (1 - xi)), tolerance(1e-14));
  for (const auto& xi : symmetric_sets) {
    const double a = particle_filter({Scheme::mpm_usl, 1, 0.5, xi});
    BOOST_TEST(limit(Scheme::mpm_usl, xi) == 1 / std::sqrt(1 + a), tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_CASE(limits_against_amplification_matrices) {
  BOOST_TEST(bloch_radius(fem(1, 0.999)) < 1 + 1e-6);
  BOOST_TEST(bloch_radius(fem(1, 1.01)) > 1.01);
  for (const auto& positions : all_sets()) {
    for (const auto scheme : mpm_schemes) {
      Discretisation d{scheme, 1, 1, positions};
      const double limit = stability_limit(d);
      BOOST_TEST_REQUIRE(limit > 0);
      BOOST_TEST_CONTEXT("scheme " << static_cast<int>(scheme) << ", " << positions.size() << " particles from "
                                   << positions.front() << ", limit " << limit) {
        d.courant = 0.999 * limit;
        BOOST_TEST(bloch_radius(d) < 1 + 1e-6);
        for (const std::size_t cells : {1u, 2u, 7u}) BOOST_TEST(free_bar_radius(d, cells) < 1 + 1e-6);
        d.courant = 1.01 * limit;
        BOOST_TEST(std::max(bloch_radius(d), free_bar_radius(d, 1)) > 1.001);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(airy_constants) {
  // ∫ sin²(κ³/6) κ⁻² dκ beyond K is 1/(2K), and that with κ⁻⁴ is 1/(6K³), but for terms of order K⁻⁴ and K⁻⁶
  const double end = 60;
  const double stress = quadrature([](double k) { return std::pow(std::sin(k * k * k / 6) / k, 2); }, end);
  const double displacement = quadrature([](double k) { return std::pow(std::sin(k * k * k / 6) / (k * k), 2); }, end);
  const double step_square = 4 / pi * (stress + 1 / (2 * end));
  const double kink_square = 4 / pi * (displacement + 1 / (6 * end * end * end));
  BOOST_TEST(step_square == 0.5176388, tolerance(1e-6));
  BOOST_TEST(step_square == std::pow(3, 1.0 / 6) * std::tgamma(2.0 / 3) / pi, tolerance(1e-6));
  BOOST_TEST(kink_square == 1.0 / 9, tolerance(1e-7));
  const double kink_sup = -gsl_sf_airy_Ai_deriv(0, GSL_PREC_DOUBLE);
  BOOST_TEST(kink_sup == 0.2588194, tolerance(1e-7));

  // what predictions tend to as h → 0; next is (h/w)² ~ N^(−2/3), and the tails meeting at the end
  for (const double cells : {2e3, 1.6e4}) {
    for (const auto& d : {fem(1, 0.5), Discretisation{Scheme::mpm_musl, 1, 0.9, {0.25, 0.75}}}) {
      const auto bar = step_bar(cells);
      const double t = 0.5 * cells, w = front_width(d, t), next = std::pow(cells, -2.0 / 3);
      const auto predicted = [&](BarQuantity q, Norm norm) { return predicted_error(bar, d, q, norm, t).value(); };
      BOOST_TEST(predicted(BarQuantity::stress, Norm::l2) == std::sqrt(step_square * w / cells), tolerance(0.01));
      BOOST_TEST(predicted(BarQuantity::displacement, Norm::l2) == std::pow(w, 1.5) / 3 / std::sqrt(cells),
                 tolerance(5 * next));
      BOOST_TEST(predicted(BarQuantity::displacement, Norm::linf) == kink_sup * w, tolerance(1e-12));
      const auto airy = [&](BarQuantity q, Norm norm) { return airy_step_error(bar, d, q, norm, t).value(); };
      BOOST_TEST(airy(BarQuantity::stress, Norm::l2) == std::sqrt(step_square * w / cells), tolerance(1e-6));
      BOOST_TEST(airy(BarQuantity::displacement, Norm::l2) == std::pow(w, 1.5) / 3 / std::sqrt(cells), tolerance(1e-6));
    }
  }
}

BOOST_AUTO_TEST_CASE(front_widths) {
  BOOST_TEST(front_width(fem(0.01, 0.5), 0.5) == std::cbrt(0.75 * 0.5 * 1e-4 / 8), tolerance(1e-14));
  BOOST_TEST(front_width({Scheme::mpm_musl, 0.01, 0.5, {0.5}}, 0.5) == std::cbrt(3.75 * 0.5 * 1e-4 / 8),
             tolerance(1e-14));
  BOOST_TEST(front_width(fem(0.01, 1), 0.5) == 0);
}

BOOST_AUTO_TEST_CASE(step_errors_of_elements) {
  for (const std::size_t cells : {200u, 400u, 800u}) check_step(ElementBar(fem(1, 0.5), cells), 1e-8, 1e-8);
  check_step(ElementBar(fem(1, 0.7), 200), 1e-8, 0.035);  // fronts between nodes
}

BOOST_AUTO_TEST_CASE(step_errors_of_particles) {
  for (const auto scheme : mpm_schemes) {
    for (const std::vector<double>& positions : {std::vector{0.5}, {0.25, 0.75}}) {
      for (const std::size_t cells : {200u, 400u}) {
        BOOST_TEST_CONTEXT("scheme " << static_cast<int>(scheme) << ", " << cells << " cells, " << positions.size()) {
          const bool dissipative = scheme == Scheme::mpm_usl;
          check_step(ParticleBar({scheme, 1, 0.5, positions}, cells), dissipative ? 0.002 : 1e-8, 0.035);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(step_errors_of_a_free_bar) {
  // an impulse on the right end, none on the left; times when fronts meet and are at the ends included
  const std::size_t cells = 100;
  const double length = static_cast<double>(cells);
  const auto check = [&](auto bar, double within, double displacement_within) {
    const BarWave exact({1, 1, length, {}, {false, Traction::impulse(-2, 60)}});
    const auto steps = [&](double t) { return std::lround(t / bar.d.courant); };
    long n = 0;
    for (const double t : {30, 60, 100, 130, 236, 400}) {
      for (; n < steps(t); ++n) {
        bar.load = n == 0 || n == steps(60) ? -1 : n < steps(60) ? -2 : 0;  // half a kick at either end of it
        bar.step();
      }
      for (const auto q : {BarQuantity::stress, BarQuantity::displacement}) {
        const double predicted = predicted_error(exact, bar.d, q, Norm::l2, t).value();
        BOOST_TEST_REQUIRE(predicted > 1e-4 * exact.scale(q));
        BOOST_TEST(error(bar, exact, q, t)(Norm::l2) == predicted,
                   tolerance(q == BarQuantity::stress ? within : displacement_within));
      }
    }
  };
  for (const double courant : {0.4, 0.5}) check(ElementBar(fem(1, courant), cells), 1e-8, 1e-8);
  check(ParticleBar({Scheme::mpm_musl, 1, 0.5, {0.25, 0.75}}, cells), 1e-8, 0.015);
  check(ParticleBar({Scheme::mpm_usl, 1, 0.5, {0.5}}, cells), 0.005, 0.06);
}

BOOST_AUTO_TEST_CASE(step_errors_of_a_bar_loaded_at_both_ends) {
  // Equal loads: each half is a bar held in the middle. A load on the other end: the mirror image.
  const auto f = Traction::step(1);
  const auto d = fem(1, 0.5);
  const BarWave both({1, 1, 400, {false, f}, {false, f}}), mirrored({1, 1, 200, {false, f}, {true, {}}});
  for (const double t : {50.0, 100.0, 200.0, 270.0, 1000.0}) {
    for (const auto q : {BarQuantity::stress, BarQuantity::displacement}) {
      const double half = predicted_error(step_bar(200), d, q, Norm::l2, t).value();
      BOOST_TEST(predicted_error(both, d, q, Norm::l2, t).value() == half, tolerance(1e-9));
      BOOST_TEST(predicted_error(mirrored, d, q, Norm::l2, t).value() == half, tolerance(1e-9));
    }
  }
}

BOOST_AUTO_TEST_CASE(predictions_in_units) {
  // The same bar in other units: errors scale with stress and displacement.
  const double length = 0.3, f = 4e6, modulus = 2e9;
  const BarWave bar({modulus, 7.8e3, length, {true, {}}, {false, Traction::step(f)}}), plain = step_bar(400);
  for (const auto q : {BarQuantity::stress, BarQuantity::displacement})
    BOOST_TEST(predicted_error(bar, fem(length / 400, 0.5), q, Norm::l2, 0.5 * length / bar.wave_speed()).value() /
                       bar.scale(q) ==
                   predicted_error(plain, fem(1, 0.5), q, Norm::l2, 200).value() / plain.scale(q),
               tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(no_prediction_without_theory) {
  const auto d = fem(1, 0.5);
  const auto bar = step_bar(400);
  const auto predicts = [&](const ExactSolution& s, const Discretisation& scheme, BarQuantity q, Norm norm, double t) {
    return predicted_error(s, scheme, q, norm, t).has_value();
  };
  BOOST_TEST(predicts(bar, d, BarQuantity::stress, Norm::l2, 200));
  BOOST_TEST(!predicts(bar, d, BarQuantity::stress, Norm::l1, 200));
  BOOST_TEST(!predicts(bar, d, BarQuantity::stress, Norm::linf, 200));
  BOOST_TEST(!predicts(bar, d, BarQuantity::velocity, Norm::l2, 200));
  BOOST_TEST(!predicts(bar, d, BarQuantity::displacement, Norm::l1, 200));
  BOOST_TEST(!predicts(bar, {Scheme::mpm_usl, 1, 0.5, {0.5}}, BarQuantity::displacement, Norm::linf, 200));
  BOOST_TEST(!predicts(bar, fem(0.7, 0.5), BarQuantity::stress, Norm::l2, 200));  // no whole number of cells
  const BarWave ramp({1, 1, 400, {true, {}}, {false, Traction::ramp(1, 10)}});
  BOOST_TEST(!predicts(ramp, d, BarQuantity::stress, Norm::l2, 200));

  const auto sup = [&](const BarWave& wave, double t) {
    return predicts(wave, d, BarQuantity::displacement, Norm::linf, t);
  };
  BOOST_TEST(sup(bar, 200));
  BOOST_TEST(!sup(bar, 5));    // just entered
  BOOST_TEST(!sup(bar, 395));  // about to be reflected
  BOOST_TEST(!sup(bar, 400));  // on the end, where no front is listed
  BOOST_TEST(!sup(bar, 405));
  BOOST_TEST(!predicts(bar, fem(1, 1), BarQuantity::displacement, Norm::linf, 200));  // exact: no width
  BOOST_TEST(predicted_error(bar, fem(1, 1), BarQuantity::stress, Norm::l2, 200).value() < 1e-10);
  const auto f = Traction::step(1);
  const BarWave meeting({1, 1, 400, {false, f}, {false, f}});
  BOOST_TEST(!sup(meeting, 200));
  BOOST_TEST(sup(meeting, 100));
  const auto impulse = [](double duration) {
    return BarWave({1, 1, 400, {true, {}}, {false, Traction::impulse(1, duration)}});
  };
  BOOST_TEST(!sup(impulse(10), 200));  // two fronts in one another's tail
  BOOST_TEST(sup(impulse(300), 200));  // the second still to come
}

BOOST_AUTO_TEST_CASE(standing_mode_errors) {
  const std::size_t cells = 40;
  const double length = static_cast<double>(cells);
  int looked_at = 0;
  for (const double left : {0, 1}) {
    const StandingMode mode({1, 1, length, left == 1, true, 1, 0.1});
    const double k = mode.wave_number();
    const double half_period = pi / k;  // sin(ωt) = 0 at 80 and 40: whole steps
    const auto check = [&](auto bar, auto position) {
      bar.fixed_left = left == 1;
      bar.fixed_right = true;
      for (std::size_t i = 0; i < bar.v.size(); ++i) bar.v[i] = mode.at(BarQuantity::velocity, position(i), 0);
      const int steps = static_cast<int>(std::lround(6 * half_period / bar.d.courant));
      for (int i = 0; i < steps; ++i) bar.step();
      const double t = steps * bar.d.courant;
      for (const auto q : {BarQuantity::stress, BarQuantity::displacement}) {
        if (q == BarQuantity::stress && bar.d.scheme == Scheme::mpm_usf) continue;  // belongs to the step before
        for (const auto norm : {Norm::l1, Norm::l2, Norm::linf}) {
          const double predicted = predicted_error(mode, bar.d, q, norm, t).value();
          BOOST_TEST(predicted > 1e-4 * mode.scale(q));
          BOOST_TEST(error(bar, mode, q, t)(norm) == predicted, tolerance(0.02));
          ++looked_at;
        }
      }
    };
    check(ElementBar(fem(1, 0.5), cells), [](std::size_t i) { return static_cast<double>(i); });
    for (const auto scheme : mpm_schemes) {
      const ParticleBar bar({scheme, 1, 0.5, {0.25, 0.75}}, cells);
      check(bar, [&bar](std::size_t p) { return bar.x(p); });
    }
  }
  BOOST_TEST(looked_at == 2 * (6 + 3 + 6 + 6));
}

BOOST_AUTO_TEST_CASE(standing_mode_predictions_in_the_limit) {
  const StandingMode mode({1e4, 1, 1, true, false, 2, 1e-3});
  const double k = mode.wave_number(), omega = 100 * k, t = 3 * pi / omega;
  for (const auto& d : {fem(1e-3, 0.5), Discretisation{Scheme::mpm_musl, 1e-3, 0.9, {0.25, 0.75}},
                        Discretisation{Scheme::mpm_usl, 1e-3, 0.5, {0.5}}}) {
    const double a = particle_filter(d), c = d.courant;
    const double phase = omega * t * std::pow(k * d.cell, 2) * (1 + 3 * a - c * c) / 24;
    const auto predicted = [&](BarQuantity q, Norm norm, double time) {
      return predicted_error(mode, d, q, norm, time).value();
    };
    for (const auto q : {BarQuantity::stress, BarQuantity::displacement}) {
      BOOST_TEST(predicted(q, Norm::l2, t) == mode.scale(q) * phase / std::numbers::sqrt2, tolerance(1e-4));
      BOOST_TEST(predicted(q, Norm::l1, t) == mode.scale(q) * phase * 2 / pi, tolerance(1e-4));
      BOOST_TEST(predicted(q, Norm::linf, t) == mode.scale(q) * phase, tolerance(1e-4));
    }
    const double quarter = 3.5 * pi / omega;  // cos(ωt) = 0
    BOOST_TEST(
        predicted(BarQuantity::velocity, Norm::linf, quarter) == mode.scale(BarQuantity::velocity) * phase * 3.5 / 3,
        tolerance(1e-4));
  }
}

BOOST_AUTO_TEST_CASE(orders) {
  const auto bar = step_bar(1);
  const StandingMode mode({1, 1, 1, true, false, 1, 1});
  const BarWave ramp({1, 1, 1, {true, {}}, {false, Traction::ramp(1, 1)}});
  BOOST_TEST(expected_order(bar, Scheme::fem, BarQuantity::stress, Norm::l1).value() == 0.5);
  BOOST_TEST(expected_order(bar, Scheme::mpm_usl, BarQuantity::stress, Norm::l1).value() == 0.625);
  BOOST_TEST(expected_order(bar, Scheme::mpm_musl, BarQuantity::stress, Norm::l2).value() == 1.0 / 3);
  BOOST_TEST(expected_order(bar, Scheme::mpm_usf, BarQuantity::stress, Norm::linf).value() == 0);
  BOOST_TEST(expected_order(bar, Scheme::fem, BarQuantity::displacement, Norm::l1).value() == 4.0 / 3);
  BOOST_TEST(expected_order(bar, Scheme::fem, BarQuantity::displacement, Norm::l2).value() == 1);
  BOOST_TEST(expected_order(bar, Scheme::fem, BarQuantity::displacement, Norm::linf).value() == 2.0 / 3);
  BOOST_TEST(!expected_order(bar, Scheme::fem, BarQuantity::velocity, Norm::l2).has_value());
  BOOST_TEST(!expected_order(ramp, Scheme::fem, BarQuantity::stress, Norm::l2).has_value());
  BOOST_TEST(expected_order(mode, Scheme::fem, BarQuantity::velocity, Norm::l2).value() == 2);

  // predictions fall off at the expected orders
  for (const auto scheme : {Scheme::fem, Scheme::mpm_usl}) {
    for (const auto q : {BarQuantity::stress, BarQuantity::displacement}) {
      const auto at = [&](double cells) {
        return predicted_error(bar, {scheme, 1 / cells, 0.5, {0.5}}, q, Norm::l2, 0.5).value();
      };
      const double order = std::log2(at(8000) / at(16000));
      BOOST_TEST(std::abs(order - expected_order(bar, scheme, q, Norm::l2).value()) < 0.02);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
