// The impact of two plates: d'Alembert's solution against what it is to solve, and the schemes' lattices against plain
// steps of the same and against the solvers.
#include "analytic/plate_impact.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "analytic/impact_lattice.hpp"
#include "fem/plate.hpp"
#include "mpm/plate.hpp"
#include "tests/spoiled_plane.hpp"

BOOST_AUTO_TEST_SUITE(plate_impact)

namespace {

using namespace diptych::analytic;
using boost::test_tools::tolerance;
using Method = PlaneDiscretisation::Method;
constexpr double pi = std::numbers::pi;
const double nan_value = std::numeric_limits<double>::quiet_NaN();

const PlaneMedium glass = plane_medium(72.8e9, 0.222, 2563, false);
const PlateImpact::Parameters plates{glass, 12e-3, 3e-3, 5e-3, 684};

using Spoiled = diptych::tests::SpoiledPlane;
using At = Spoiled::At;

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  BOOST_REQUIRE(a.size() == b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(std::abs(a[i] - b[i]) <= largest)) largest = std::abs(a[i] - b[i]);
  }
  return largest;
}

// --- plain steps -----------------------------------------------------------------------------------------------------

/// Stress of every cell after each step, [step − 1][cell].
using Stresses = std::vector<std::vector<double>>;

/// A row of corners and cell middles, held by the energies of a cell's four triangles.
Stresses fem_steps(const ImpactLattice::Parameters& p, long steps) {
  const auto n = static_cast<std::size_t>(p.cells), face = static_cast<std::size_t>(p.face);
  const double h = p.scheme.hx, dt = p.scheme.time_step, M = p.medium.lambda + 2 * p.medium.mu;
  const double kappa = M / h, shear = p.medium.mu * h / (p.scheme.hy * p.scheme.hy), mass = p.medium.density * h;
  std::vector<double> u(n + 1), v(n + 1), f(n + 1), um(n), vm(n), fm(n);
  for (std::size_t i = 0; i <= n; ++i) v[i] = i < face ? p.velocity : i == face ? p.velocity / 2 : 0;
  for (std::size_t i = 0; i < n; ++i) vm[i] = i < face ? p.velocity : 0;
  Stresses stresses;
  for (long step = 0; step < steps; ++step) {
    std::fill(f.begin(), f.end(), 0);
    for (std::size_t i = 0; i < n; ++i) {
      const double to_left = um[i] - u[i], to_right = u[i + 1] - um[i], across = (u[i + 1] - u[i]) / 2;
      const double off = shear * (um[i] - (u[i] + u[i + 1]) / 2);
      f[i] += kappa * (to_left + across) + off;
      f[i + 1] += -kappa * (to_right + across) + off;
      fm[i] = kappa * (to_right - to_left) - 2 * off;
    }
    const double kick = step == 0 ? dt / 2 : dt;
    for (std::size_t i = 0; i <= n; ++i) {
      v[i] += kick * f[i] / (mass * (i == 0 || i == n ? 1 : 2) / 3);
      u[i] += dt * v[i];
    }
    std::vector<double> stress;
    for (std::size_t i = 0; i < n; ++i) {
      vm[i] += kick * fm[i] / (mass / 3);
      um[i] += dt * vm[i];
      stress.push_back(M * (u[i + 1] - u[i]) / h);
    }
    stresses.push_back(stress);
  }
  return stresses;
}

/// Particles that carry velocity and strain, and a grid that is forgotten after every step.
Stresses mpm_steps(const ImpactLattice::Parameters& p, long steps) {
  const auto n = static_cast<std::size_t>(p.cells), face = static_cast<std::size_t>(p.face);
  const auto& xi = p.scheme.positions;
  const std::size_t per_cell = xi.size();
  const double h = p.scheme.hx, dt = p.scheme.time_step, M = p.medium.lambda + 2 * p.medium.mu;
  const double particle = p.medium.density * h / static_cast<double>(per_cell);
  std::vector<double> v(n * per_cell), strain(n);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = i / per_cell < face ? p.velocity : 0;
  const auto mapped = [&](bool momentum) {
    std::vector<double> nodes(n + 1);
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double x = xi[i % per_cell], m = particle * (momentum ? v[i] : 1);
      nodes[i / per_cell] += m * (1 - x);
      nodes[i / per_cell + 1] += m * x;
    }
    return nodes;
  };
  const std::vector<double> mass = mapped(false);
  const auto velocity = [&] {
    auto nodes = mapped(true);
    for (std::size_t i = 0; i <= n; ++i) nodes[i] /= mass[i];
    return nodes;
  };
  const auto strain_by = [&](const std::vector<double>& nodes, double time) {
    for (std::size_t i = 0; i < n; ++i) strain[i] += time * (nodes[i + 1] - nodes[i]) / h;
  };
  const auto acceleration = [&] {
    std::vector<double> a(n + 1);
    for (std::size_t i = 0; i < n; ++i) a[i] += M * strain[i], a[i + 1] -= M * strain[i];
    for (std::size_t i = 0; i <= n; ++i) a[i] /= mass[i];
    return a;
  };
  Stresses stresses;
  for (long step = 0; step < steps; ++step) {
    if (p.scheme.method == Method::usf) strain_by(velocity(), step == 0 ? dt / 2 : dt);
    const auto a = acceleration();
    auto kicked = velocity();
    const double kick = step == 0 && p.scheme.method != Method::usf ? dt / 2 : dt;
    for (std::size_t i = 0; i <= n; ++i) kicked[i] += kick * a[i];
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double x = xi[i % per_cell];
      v[i] += kick * ((1 - x) * a[i / per_cell] + x * a[i / per_cell + 1]);
    }
    if (p.scheme.method == Method::musl) strain_by(velocity(), dt);
    if (p.scheme.method == Method::usl) strain_by(kicked, dt);
    stresses.emplace_back();
    for (const double e : strain) stresses.back().push_back(M * e);
  }
  return stresses;
}

ImpactLattice::Parameters row(Method method, double courant, int cells, int face, std::vector<double> positions = {},
                              double aspect = 1) {
  const double h = 0.25e-3;
  return {glass, {method, h, aspect * h, courant * h / glass.pressure_speed(), std::move(positions)}, cells, face, 684};
}

double plateau(const ImpactLattice::Parameters& p) {
  return p.medium.density * p.medium.pressure_speed() * p.velocity / 2;
}

diptych::mpm::Scheme scheme_of(Method method) {
  return method == Method::usf   ? diptych::mpm::Scheme::usf
         : method == Method::usl ? diptych::mpm::Scheme::usl
                                 : diptych::mpm::Scheme::musl;
}

const std::vector<double> one{0.5}, two{0.25, 0.75}, three{1.0 / 6, 0.5, 5.0 / 6}, wide{0.1, 0.9}, on_nodes{0, 1};

/// Every method, stable, the limits of some included.
const std::vector<ImpactLattice::Parameters> rows{
    row(Method::fem, 0.5, 24, 9),          row(Method::fem, 0.57, 17, 16),        row(Method::fem, 0.3, 10, 1, {}, 2),
    row(Method::fem, 0.3, 12, 5, {}, 0.6), row(Method::musl, 0.5, 24, 9, one),    row(Method::musl, 1.9, 23, 7, one),
    row(Method::musl, 1.7, 24, 12, two),   row(Method::musl, 1, 24, 9, on_nodes), row(Method::usf, 0.5, 24, 9, one),
    row(Method::usf, 1.9, 24, 23, one),    row(Method::usf, 1.2, 15, 4, three),   row(Method::usf, 0.9, 2, 1, wide),
    row(Method::usl, 0.3, 24, 9, one),     row(Method::usl, 0.7, 24, 9, one),     row(Method::usl, 0.75, 19, 8, two),
    row(Method::usl, 0.6, 24, 11, three),  row(Method::usl, 0.5, 24, 9, on_nodes)};

}  // namespace

BOOST_AUTO_TEST_CASE(known_values) {
  const PlateImpact s(plates);
  const double c = glass.pressure_speed(), x = 8e-3;
  BOOST_TEST(s.plateau() == -2563 * c * 342, tolerance(1e-15));
  BOOST_TEST(std::abs(s.plateau() / 5e9 + 1) < 2e-3);  // 684 m/s is 5 GPa in this glass
  BOOST_TEST(s.lateral_ratio() == 0.222 / 0.778, tolerance(1e-14));
  BOOST_TEST(s.arrival(x) == 3e-3 / c, tolerance(1e-14));
  BOOST_TEST(s.release(x) == 11e-3 / c, tolerance(1e-14));  // 7 mm to the back and 4 mm on the way back from it
  BOOST_TEST(s.release(4e-3) == 9e-3 / c, tolerance(1e-14));
  BOOST_TEST(s.arrival(12e-3) == s.release(12e-3), tolerance(1e-14));
  BOOST_TEST(s.arrival(0) == s.release(0), tolerance(1e-14));
  const double before = 0.999 * s.arrival(x), after = 1.001 * s.arrival(x), late = 0.999 * s.release(x);
  BOOST_TEST(s.at(PlaneQuantity::stress, x, 0, before)[0] == 0);
  for (const double t : {after, late}) {
    BOOST_TEST(s.at(PlaneQuantity::stress, x, 1e-3, t)[0] == s.plateau(), tolerance(1e-15));
    BOOST_TEST(s.at(PlaneQuantity::stress, x, 1e-3, t)[1] == s.plateau() * s.lateral_ratio(), tolerance(1e-15));
    BOOST_TEST(s.at(PlaneQuantity::stress, x, 1e-3, t)[2] == 0);
    BOOST_TEST(s.at(PlaneQuantity::velocity, x, 0, t)[0] == 342, tolerance(1e-15));
  }
  BOOST_TEST(s.at(PlaneQuantity::stress, x, 0, 1.001 * s.release(x))[0] == 0);
  BOOST_TEST(s.at(PlaneQuantity::displacement, x, 0, late)[0] == 342 * (late - s.arrival(x)), tolerance(1e-13));
  // after 2 width/c everything is as it was, a little way on
  const double period = 24e-3 / c;
  BOOST_TEST(s.at(PlaneQuantity::displacement, x, 0, 3 * period + late)[0] ==
                 342 * (late - s.arrival(x)) + 3 * 684 * 10e-3 / c,
             tolerance(1e-13));
  BOOST_TEST(s.at(PlaneQuantity::velocity, 1e-3, 0, 5 * period)[0] == 684);
  BOOST_TEST(s.scale(PlaneQuantity::stress) == -s.plateau());
  BOOST_TEST(s.scale(PlaneQuantity::velocity) == 684);
  BOOST_TEST(s.scale(PlaneQuantity::displacement) == 684 * 5e-3 / c, tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(plateaus_lie_between_arrival_and_release) {
  for (const double face : {2e-3, 6e-3, 9e-3}) {
    auto p = plates;
    p.face = face;
    const PlateImpact s(p);
    for (int i = 0; i <= 60; ++i) {
      const double x = p.width * i / 60, from = s.arrival(x), to = s.release(x), little = 1e-6 * p.width / 6000;
      BOOST_TEST(from <= to * (1 + 1e-14));
      if (from > little) BOOST_TEST(s.at(PlaneQuantity::stress, x, 0, from - little)[0] == 0);
      if (to - from < 1e-3 * to) continue;
      for (const double part : {1e-4, 0.3, 0.9999})
        BOOST_TEST(s.at(PlaneQuantity::stress, x, 0, from + part * (to - from))[0] == s.plateau());
      // none is left, or tension where both ends answer at once
      BOOST_TEST(s.at(PlaneQuantity::stress, x, 0, to + little)[0] >= 0);
    }
  }
}

BOOST_AUTO_TEST_CASE(fronts_go_to_and_fro) {
  const PlateImpact s(plates);
  const double c = glass.pressure_speed();
  for (int i = 1; i <= 97; ++i) {
    const double t = 70e-3 / c * i / 97;
    const auto fronts = s.fronts(t);
    BOOST_REQUIRE(fronts.size() == 2);
    BOOST_TEST(fronts[0].position <= fronts[1].position);
    for (const Front& f : fronts) {
      BOOST_TEST(f.travelled == c * t);
      const double other = fronts[0].position == f.position ? fronts[1].position : fronts[0].position;
      const double d = 1e-6;
      if (std::min({f.position, plates.width - f.position, std::abs(f.position - other)}) < 2 * d) continue;
      const double jump = s.at(PlaneQuantity::stress, f.position - f.direction * d, 0, t)[0] -
                          s.at(PlaneQuantity::stress, f.position + f.direction * d, 0, t)[0];
      BOOST_TEST(jump == f.stress_jump, tolerance(1e-14));
      const auto later = s.fronts(t + 1e-7 / c);  // it moves the way it says
      const double moved = std::min(std::abs(later[0].position - f.position - f.direction * 1e-7),
                                    std::abs(later[1].position - f.position - f.direction * 1e-7));
      BOOST_TEST(moved < 1e-15);
    }
  }
  const auto met = s.fronts(3e-3 / c);
  BOOST_TEST(met[0].position == 2e-3, tolerance(1e-13));
  BOOST_TEST(met[1].position == 8e-3, tolerance(1e-13));
  const double mean = s.at(PlaneQuantity::stress, met[1].position, 0, 3e-3 / c)[0];
  BOOST_TEST(mean == s.plateau() / 2, tolerance(1e-14));  // on a front the mean of both sides
  BOOST_TEST(s.at(PlaneQuantity::velocity, met[1].position, 0, 3e-3 / c)[0] == 171, tolerance(1e-14));
  BOOST_TEST(s.at(PlaneQuantity::velocity, 5e-3, 0, 0)[0] == 342);
}

BOOST_AUTO_TEST_CASE(solves_its_equations) {
  for (const double face : {0.3e-3, 5e-3, 6e-3, 11.9e-3}) {
    for (const bool plane_stress : {false, true}) {
      auto p = plates;
      p.face = face;
      p.medium = plane_medium(72.8e9, 0.222, 2563, plane_stress);
      const auto r = self_test(PlateImpact(p), p, 9 * p.width / p.medium.pressure_speed());
      BOOST_TEST(r.worst() < 1e-9, r.motion << ' ' << r.jump << ' ' << r.boundary << ' ' << r.initial << ' '
                                            << r.momentum << ' ' << r.energy);
      BOOST_TEST(r.points > 3000);
      BOOST_TEST(r.fronts > 500);
    }
  }
}

BOOST_AUTO_TEST_CASE(self_test_sees_wrong_solutions) {
  const PlateImpact s(plates);
  const double t_end = 40e-3 / glass.pressure_speed();
  const auto spoil = [&](At at) { return self_test(Spoiled(std::move(at)), plates, t_end); };
  const auto as = [&](const PlateImpact& other) {
    return spoil([&](PlaneQuantity q, double x, double y, double t) { return other.at(q, x, y, t); });
  };
  BOOST_TEST(as(s).worst() < 1e-9);
  auto other = plates;
  other.velocity *= 1.01;
  BOOST_TEST(as(PlateImpact(other)).momentum > 1e-3);
  BOOST_TEST(as(PlateImpact(other)).energy > 1e-3);
  BOOST_TEST(as(PlateImpact(other)).initial > 1e-3);
  BOOST_TEST(as(PlateImpact(other)).jump > 1e-3);
  other = plates;
  other.face *= 1.01;
  BOOST_TEST(as(PlateImpact(other)).motion > 1e-3);
  other = plates;
  other.medium.density *= 1.01;
  BOOST_TEST(as(PlateImpact(other)).motion > 1e-3);
  other = plates;
  other.medium.lambda *= 0.99;
  other.medium.mu = (glass.lambda + 2 * glass.mu - other.medium.lambda) / 2;  // another ratio, the same wave
  BOOST_TEST(as(PlateImpact(other)).motion > 1e-3);
  BOOST_TEST(as(PlateImpact(other)).jump < 1e-9);
  other = plates;
  other.width *= 1.01;
  const PlateImpact longer(other);
  BOOST_TEST(as(longer).boundary > 1e-3);
  BOOST_TEST(spoil([&](PlaneQuantity q, double x, double y, double t) {
               auto value = s.at(q, x, y, t);
               if (q == PlaneQuantity::displacement) value[0] *= 1.001;
               return value;
             }).motion > 1e-4);
  BOOST_TEST(spoil([&](PlaneQuantity q, double x, double y, double t) {
               auto value = s.at(q, x, y, t);
               if (q == PlaneQuantity::displacement) value[0] += 1e-3 * s.scale(q);
               return value;
             }).initial > 1e-4);
  BOOST_TEST(spoil([&](PlaneQuantity q, double x, double y, double t) {
               return q == PlaneQuantity::velocity && t > 0 ? std::array{0.99 * s.at(q, x, y, t)[0], 0.0, 0.0}
                                                            : s.at(q, x, y, t);
             }).jump > 1e-3);
  BOOST_TEST(std::isnan(spoil([](PlaneQuantity, double, double, double) {
                          return std::array{nan_value, nan_value, nan_value};
                        }).worst()));
  BOOST_TEST(std::isinf(self_test(s, plates, 1e-12).worst()));  // nothing to look at
  BOOST_CHECK_THROW(self_test(s, plates, 0), std::invalid_argument);
  BOOST_CHECK_THROW(self_test(s, plates, nan_value), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(mirrored_and_in_other_units) {
  const PlateImpact s(plates);
  auto p = plates;
  p.face = p.width - p.face;
  const PlateImpact mirrored(p);  // seen by one who moves with the flyer, with left and right exchanged
  p = plates;
  p.velocity *= 4;
  p.medium.density *= 2;
  p.medium.lambda *= 32;
  p.medium.mu *= 32;  // c × 4
  const PlateImpact scaled(p);
  for (int i = 1; i <= 50; ++i) {
    const double x = plates.width * std::fmod(i * 0.7548776662466927, 1), t = 8e-6 * std::fmod(i * 0.569840290998, 1);
    BOOST_TEST(mirrored.at(PlaneQuantity::stress, plates.width - x, 0, t)[0] == s.at(PlaneQuantity::stress, x, 0, t)[0],
               tolerance(1e-14));
    BOOST_TEST(684 - mirrored.at(PlaneQuantity::velocity, plates.width - x, 0, t)[0] ==
                   s.at(PlaneQuantity::velocity, x, 0, t)[0],
               tolerance(1e-13));
    BOOST_TEST(684 * t - mirrored.at(PlaneQuantity::displacement, plates.width - x, 0, t)[0] ==
                   s.at(PlaneQuantity::displacement, x, 0, t)[0],
               tolerance(1e-11));
    BOOST_TEST(scaled.at(PlaneQuantity::stress, x, 0, t / 4)[0] == 32 * s.at(PlaneQuantity::stress, x, 0, t)[0]);
    BOOST_TEST(scaled.at(PlaneQuantity::displacement, x, 0, t / 4)[0] == s.at(PlaneQuantity::displacement, x, 0, t)[0]);
  }
}

BOOST_AUTO_TEST_CASE(parameters_out_of_range) {
  const auto wrong = [](const std::function<void(PlateImpact::Parameters&)>& change) {
    auto p = plates;
    change(p);
    BOOST_CHECK_THROW(PlateImpact{p}, std::invalid_argument);
  };
  wrong([](auto& p) { p.width = 0; });
  wrong([](auto& p) { p.height = nan_value; });
  wrong([](auto& p) { p.face = 0; });
  wrong([](auto& p) { p.face = p.width; });
  wrong([](auto& p) { p.face = nan_value; });
  wrong([](auto& p) { p.velocity = -1; });
  wrong([](auto& p) { p.medium.density = 0; });
  wrong([](auto& p) { p.medium.mu = 0; });
  wrong([](auto& p) { p.medium.lambda = -p.medium.mu; });
  const PlateImpact s(plates);
  BOOST_CHECK_THROW(s.at(PlaneQuantity::stress, -1e-3, 0, 0), std::domain_error);
  BOOST_CHECK_THROW(s.at(PlaneQuantity::stress, 0, 4e-3, 0), std::domain_error);
  BOOST_CHECK_THROW(s.at(PlaneQuantity::stress, 0, 0, -1), std::domain_error);
  BOOST_CHECK_THROW(s.at(PlaneQuantity::stress, nan_value, 0, 0), std::domain_error);
  BOOST_CHECK_THROW(s.at(PlaneQuantity::concentration, 0, 0, 0), std::invalid_argument);
  BOOST_CHECK_THROW(s.scale(PlaneQuantity::concentration), std::invalid_argument);
  BOOST_CHECK_THROW(s.arrival(13e-3), std::domain_error);
  BOOST_CHECK_THROW(s.release(-1e-3), std::domain_error);
  BOOST_TEST(!s.gives(PlaneQuantity::concentration));
}

// --- the lattice -----------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(lattice_is_what_plain_steps_give) {
  for (const auto& p : rows) {
    const ImpactLattice lattice(p);
    const long steps = 400;  // some reflections
    const auto plain = p.scheme.method == Method::fem ? fem_steps(p, steps) : mpm_steps(p, steps);
    double worst = 0, largest = 0;
    for (long n = 1; n <= steps; n += n < 30 ? 1 : 37) {
      for (int i = 0; i < p.cells; ++i) {
        const double expected = plain[static_cast<std::size_t>(n - 1)][static_cast<std::size_t>(i)];
        const double difference = std::abs(lattice.cell_stress(i, n) - expected);
        if (!(difference <= worst)) worst = difference;
        largest = std::max(largest, std::abs(expected));
      }
    }
    BOOST_TEST(worst < 1e-10 * plateau(p),
               "method " << static_cast<int>(p.scheme.method) << ", " << p.cells << " cells: " << worst / plateau(p));
    BOOST_TEST(largest > 0.5 * plateau(p));
  }
}

BOOST_AUTO_TEST_CASE(lattice_at_its_limit) {
  // one centred particle at C = 2: exact, each front passes two cells a step
  for (const Method method : {Method::musl, Method::usf}) {
    const auto p = row(method, 2, 40, 20, one);
    const ImpactLattice lattice(p);
    const auto plain = mpm_steps(p, 9);
    for (const long n : {1L, 2L, 5L, 9L}) {
      for (int i = 0; i < p.cells; ++i) {
        BOOST_TEST(std::abs(lattice.cell_stress(i, n) -
                            plain[static_cast<std::size_t>(n - 1)][static_cast<std::size_t>(i)]) < 1e-8 * plateau(p));
      }
    }
  }
  // USL where both factors are real, and where they coincide
  for (const double courant : {0.02, std::sqrt(0.5), 1e-4}) {
    const auto p = row(Method::usl, courant, 12, 5, one);
    const ImpactLattice lattice(p);
    const auto plain = mpm_steps(p, 60);
    for (const long n : {1L, 2L, 17L, 60L}) {
      for (int i = 0; i < p.cells; ++i) {
        BOOST_TEST(std::abs(lattice.cell_stress(i, n) -
                            plain[static_cast<std::size_t>(n - 1)][static_cast<std::size_t>(i)]) < 1e-10 * plateau(p));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(gauges_and_histories) {
  for (const auto& p : rows) {
    const ImpactLattice lattice(p);
    const double h = p.scheme.hx, width = p.cells * h;
    const double x = 1.3 * h;
    const auto history = lattice.history(x, 50);
    BOOST_TEST(history.size() == 50);
    for (const long n : {1L, 7L, 50L}) {
      const auto cell = [&](int i) { return lattice.cell_stress(i, n); };
      BOOST_TEST(history[static_cast<std::size_t>(n - 1)] == lattice.gauge(x, n));
      const double tiny = 1e-12 * plateau(p);
      BOOST_TEST(std::abs(lattice.gauge(x, n) - (0.2 * cell(0) + 0.8 * cell(1))) < tiny);
      BOOST_TEST(std::abs(lattice.gauge(0.5 * h, n) - cell(0)) < tiny);
      BOOST_TEST(lattice.gauge(0, n) == lattice.gauge(0.4 * h, n));
      BOOST_TEST(lattice.gauge(width, n) == lattice.gauge(width - 0.3 * h, n));
      BOOST_TEST(std::abs(lattice.gauge(width, n) - cell(p.cells - 1)) < tiny);
    }
    const double dt = p.scheme.time_step;
    BOOST_TEST(lattice.stress_time(3) == (p.scheme.method == Method::usf ? 2.5 : 3) * dt);
  }
}

BOOST_AUTO_TEST_CASE(lattice_is_mirrored_with_its_face) {
  for (const auto& p : rows) {
    auto q = p;
    q.face = p.cells - p.face;
    const ImpactLattice a(p), b(q);
    for (const long n : {1L, 12L, 133L}) {
      for (int i = 0; i < p.cells; ++i)
        BOOST_TEST(std::abs(a.cell_stress(i, n) - b.cell_stress(p.cells - 1 - i, n)) < 1e-11 * plateau(p));
    }
  }
}

BOOST_AUTO_TEST_CASE(long_waves_have_the_dispersion_that_is_said) {
  for (const auto& p : rows) {
    if (p.scheme.method == Method::usl) {
      BOOST_CHECK_THROW(impact_dispersion(p.medium, p.scheme), std::invalid_argument);
      continue;
    }
    auto fine = p;
    fine.cells = 800;
    fine.face = 400;
    const ImpactLattice lattice(fine);
    const double C = p.medium.pressure_speed() * p.scheme.time_step / p.scheme.hx,
                 D = impact_dispersion(p.medium, p.scheme);
    for (const int k : {4, 8}) {
      const double theta = k * pi / 800, slow = 1 - lattice.phase(k) / (C * theta);
      BOOST_TEST(std::abs(slow / (theta * theta / 24) - D) < 2 * theta * theta + 1e-8, slow / (theta * theta / 24)
                                                                                           << ' ' << D);
    }
  }
  // a row of crossed squares at its limit
  const double gamma = glass.mu / (glass.lambda + 2 * glass.mu), limit = 2 / (3 * std::sqrt(1 + gamma));
  BOOST_TEST(impact_dispersion(glass, row(Method::fem, limit, 2, 1).scheme) == 2 / (9 * (1 + gamma)), tolerance(1e-13));
  BOOST_CHECK_NO_THROW(ImpactLattice(row(Method::fem, limit * 0.9999, 400, 200)));
  BOOST_CHECK_THROW(ImpactLattice(row(Method::fem, limit * 1.001, 400, 200)), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(front_is_airys) {
  // Half level, overshoot and rise at a gauge that the front reaches after some 400 of 1600 cells. With one particle a
  // cell neighbouring cells have it half a cell early and late by turns: there the gauge stands between two.
  struct Of {
    Method method;
    double courant;
    std::vector<double> positions;
  };
  for (const auto& [method, courant, positions] :
       {Of{Method::fem, 0.25, {}}, {Method::musl, 0.5, one}, {Method::musl, 1, two}, {Method::usf, 0.5, two}}) {
    const auto p = row(method, courant, 1600, 800, positions);
    const ImpactLattice lattice(p);
    const double cells = positions == one ? 400 : 400.5, travelled = cells * p.scheme.hx, c = p.medium.pressure_speed();
    const double x = 800 * p.scheme.hx + travelled;
    const auto history = lattice.history(x, static_cast<long>(560 / courant));
    const auto passes = [&](double level) {
      for (std::size_t i = 1; i < history.size(); ++i) {
        const double before = -history[i - 1] / plateau(p), after = -history[i] / plateau(p);
        if (before < level && after >= level)
          return lattice.stress_time(static_cast<long>(i)) + (level - before) / (after - before) * p.scheme.time_step;
      }
      return nan_value;
    };
    const double w = front_width(p.medium, p.scheme, travelled), late = passes(0.5) - travelled / c;
    BOOST_TEST(late * c / w == 0.409603, tolerance(0.02));
    BOOST_TEST((passes(0.9) - passes(0.1)) * c / w == 2.167643, tolerance(0.01));
    BOOST_TEST(-*std::min_element(history.begin(), history.end()) / plateau(p) - 1 == 0.27435, tolerance(0.03));
  }
}

BOOST_AUTO_TEST_CASE(lattice_is_what_the_solvers_do) {
  const diptych::material::PlaneElastic solid{72.8e9, 0.222, 2563};
  for (const auto& p : rows) {
    diptych::Plate plate;
    plate.width = p.cells * p.scheme.hx;
    plate.height = 3 * p.scheme.hy;
    plate.solid = diptych::solid::Elastic{solid};
    const double face = plate.width * p.face / p.cells;
    plate.initial_velocity = [&](double x, double) -> diptych::Vector {
      return {x < face ? p.velocity : x == face ? p.velocity / 2 : 0, 0};
    };
    for (const auto side : {diptych::Side::bottom, diptych::Side::top})
      plate.edge(side).support = diptych::Edge::Support::roller;
    const bool fem = p.scheme.method == Method::fem;
    if (!fem && p.scheme.positions == on_nodes) continue;  // the solver would ask for the velocity on the face
    diptych::Stepping stepping;
    stepping.time_step = p.scheme.time_step;
    stepping.steps = 150;
    stepping.sample_after = {1, 2, 3, 40, 150};
    const auto record =
        fem ? diptych::fem::run(plate, {p.cells, 3}, stepping)
            : diptych::mpm::run(plate, {p.cells, 3}, p.scheme.positions, scheme_of(p.scheme.method), stepping);
    const ImpactLattice lattice(p);
    const double ratio = glass.lambda / (glass.lambda + 2 * glass.mu);
    BOOST_REQUIRE(record.snapshots.size() == 5);
    for (const auto& snapshot : record.snapshots) {
      BOOST_TEST(snapshot.stress.time == lattice.stress_time(snapshot.step), tolerance(1e-13));
      const std::size_t cells = static_cast<std::size_t>(3 * p.cells), per_cell = snapshot.stress.x.size() / cells;
      std::vector<double> xx(cells), yy(cells), expected(cells), lateral(cells);
      for (std::size_t k = 0; k < snapshot.stress.x.size(); ++k) {
        const auto i = static_cast<std::size_t>(snapshot.stress.x[k] / p.scheme.hx);
        const auto j = static_cast<std::size_t>(snapshot.stress.y[k] / p.scheme.hy);
        const std::size_t cell = j * static_cast<std::size_t>(p.cells) + i;
        xx[cell] += snapshot.stress.component[0][k] / static_cast<double>(per_cell);
        yy[cell] += snapshot.stress.component[1][k] / static_cast<double>(per_cell);
      }
      for (std::size_t cell = 0; cell < cells; ++cell) {
        expected[cell] = lattice.cell_stress(static_cast<int>(cell) % p.cells, snapshot.step);
        lateral[cell] = ratio * expected[cell];
      }
      BOOST_TEST(largest_difference(xx, expected) < 1e-9 * plateau(p),
                 "method " << static_cast<int>(p.scheme.method) << " after " << snapshot.step);
      BOOST_TEST(largest_difference(yy, lateral) < 1e-9 * plateau(p));
    }
  }
}

BOOST_AUTO_TEST_CASE(gauges_of_the_solvers) {
  for (const auto& p : rows) {
    const bool fem = p.scheme.method == Method::fem;
    if (!fem && p.scheme.positions == on_nodes) continue;
    diptych::Plate plate;
    plate.width = p.cells * p.scheme.hx;
    plate.height = 2 * p.scheme.hy;
    plate.solid = diptych::solid::Elastic{{72.8e9, 0.222, 2563}};
    for (const auto side : {diptych::Side::bottom, diptych::Side::top})
      plate.edge(side).support = diptych::Edge::Support::roller;
    plate.impact = diptych::Impact{plate.width * p.face / p.cells, p.velocity, 0};
    plate.gauges = {{1.3 * p.scheme.hx, 0.5 * p.scheme.hy}, {plate.width - 0.2 * p.scheme.hx, 1.2 * p.scheme.hy}};
    diptych::Stepping stepping;
    stepping.time_step = p.scheme.time_step;
    stepping.steps = 150;
    const auto record =
        fem ? diptych::fem::run(plate, {p.cells, 2}, stepping)
            : diptych::mpm::run(plate, {p.cells, 2}, p.scheme.positions, scheme_of(p.scheme.method), stepping);
    const ImpactLattice lattice(p);
    BOOST_REQUIRE(record.gauges.size() == 2);
    for (std::size_t g = 0; g < 2; ++g) {
      const auto& gauge = record.gauges[g];
      const auto expected = lattice.history(plate.gauges[g].x, 150);
      BOOST_TEST(largest_difference(gauge.xx, expected) < 1e-9 * plateau(p));
      BOOST_TEST(gauge.time.back() == lattice.stress_time(150), tolerance(1e-13));
    }
  }
}

BOOST_AUTO_TEST_CASE(lattices_out_of_range) {
  const auto good = row(Method::musl, 1, 24, 9, two);
  const auto wrong = [&](const std::function<void(ImpactLattice::Parameters&)>& change) {
    auto p = good;
    change(p);
    BOOST_CHECK_THROW(ImpactLattice{p}, std::invalid_argument);
  };
  wrong([](auto& p) { p.cells = 1; });
  wrong([](auto& p) { p.face = 0; });
  wrong([](auto& p) { p.face = 24; });
  wrong([](auto& p) { p.velocity = 0; });
  wrong([](auto& p) { p.scheme.hx = nan_value; });
  wrong([](auto& p) { p.scheme.hy = 0; });
  wrong([](auto& p) { p.scheme.time_step = -1; });
  wrong([](auto& p) { p.scheme.positions = {}; });
  wrong([](auto& p) { p.scheme.positions = {0.2, 0.7}; });
  wrong([](auto& p) { p.scheme.positions = {-0.1, 1.1}; });
  wrong([](auto& p) { p.medium.mu = 0; });
  wrong([](auto& p) { p.scheme.time_step *= 1.74; });  // the limit is √3
  for (const double over : {0.72, 1.2}) {              // 1/√2
    BOOST_CHECK_THROW(ImpactLattice(row(Method::usl, over, 24, 9, one)), std::invalid_argument);
  }
  BOOST_CHECK_THROW(ImpactLattice(row(Method::fem, 0.75, 24, 9)), std::invalid_argument);
  const ImpactLattice lattice(good);
  BOOST_CHECK_THROW(lattice.cell_stress(24, 1), std::domain_error);
  BOOST_CHECK_THROW(lattice.cell_stress(0, 0), std::domain_error);
  BOOST_CHECK_THROW(lattice.gauge(-1e-3, 1), std::domain_error);
  BOOST_CHECK_THROW(lattice.gauge(nan_value, 1), std::domain_error);
  BOOST_CHECK_THROW(lattice.phase(24), std::domain_error);
  BOOST_CHECK_THROW(front_width(glass, good.scheme, -1), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
