// The plate by MPM: exact identities first, then orders of convergence and limits of stability.
#include <algorithm>
#include <array>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "mpm/bar.hpp"
#include "mpm/plate.hpp"
#include "tests/plate_records.hpp"

BOOST_AUTO_TEST_SUITE(mpm_plate)

using namespace diptych;
using mpm::Scheme;
namespace tt = boost::test_tools;
namespace bdata = boost::unit_test::data;

namespace {

constexpr std::array schemes{Scheme::usf, Scheme::usl, Scheme::musl};
const auto every_scheme = bdata::make(std::vector<int>{0, 1, 2});
Scheme scheme(int which) { return schemes[static_cast<std::size_t>(which)]; }

constexpr double E = 50e9, nu = 0.3, density = 2500;
const std::vector<double> quarters{0.25, 0.75};
using Hold = Edge::Support;

Plate plate(double width = 1, double height = 1, material::Plane plane = material::Plane::strain) {
  Plate p;
  p.width = width;
  p.height = height;
  p.solid = solid::Elastic{material::PlaneElastic{E, nu, density, plane}};
  return p;
}

void hold(Plate& p, const std::array<Hold, 4>& supports) {
  for (const Side side : sides) p.edge(side).support = supports[static_cast<std::size_t>(side)];
}

/// Steps of a part of the critical one, sampled at the end.
Stepping stepping(const Plate& p, const Cells& cells, const std::vector<double>& xi, Scheme s, double part,
                  long steps) {
  Stepping stepping;
  stepping.time_step = part * mpm::critical_time_step(p, cells, xi, s);
  stepping.steps = steps;
  stepping.sample_after = {steps};
  stepping.books = Books::lines;
  return stepping;
}

PlateRecord run(const Plate& p, const Cells& cells, const std::vector<double>& xi, Scheme s, double part, long steps,
                int threads = 1) {
  Stepping how = stepping(p, cells, xi, s, part, steps);
  how.threads = threads;
  return mpm::run(p, cells, xi, s, how);
}

std::vector<std::vector<double>> fields(const PlateRecord& r) {
  std::vector<std::vector<double>> all;
  for (const PlateSnapshot& s : r.snapshots) {
    for (const PointField* f : {&s.displacement, &s.velocity, &s.stress})
      all.insert(all.end(), f->component.begin(), f->component.end());
    all.push_back(s.volumetric_strain);
    all.push_back(s.crack_density);
    all.push_back(s.concentration);
  }
  all.push_back(r.platen);
  return all;
}

/// Largest |difference| in units of the second's largest value.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  BOOST_REQUIRE(a.size() == b.size());
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most / largest(b);
}

/// Something at every frequency, without any symmetry.
Vector ragged(double x, double y) { return {std::sin(37 * x + 11 * y * y) + 0.3, std::cos(53 * y - 17 * x * x) - 0.1}; }

void the_books_close(const PlateRecord& r, double tolerance = 1e-12) {
  BOOST_TEST_CONTEXT(r.message) { BOOST_REQUIRE((r.outcome == Outcome::completed)); }
  BOOST_REQUIRE(r.sums.finite);
  double momentum = 0;
  for (const LedgerLine& line : r.ledger)
    momentum = std::max({momentum, std::abs(line.momentum), std::abs(line.impulse)});
  BOOST_TEST(r.sums.held > 0);
  BOOST_TEST(r.sums.lost <= tolerance * r.sums.held);
  BOOST_TEST(r.sums.momentum <= 1e-12 * momentum);
}

}  // namespace

// --- exact
// ------------------------------------------------------------------------------------------------------------

BOOST_DATA_TEST_CASE(nothing_in_gives_exactly_nothing_out, every_scheme, which) {
  Plate p = plate();
  hold(p, {Hold::roller, Hold::free, Hold::fixed, Hold::free});
  p.edge(Side::top).normal_traction = p.edge(Side::right).shear_traction = [](double, double) { return 0.0; };
  const PlateRecord r = run(p, {5, 3}, {0.1, 0.7}, scheme(which), 0.9, 50);
  for (const auto& field : fields(r)) BOOST_TEST(largest(field) == 0);
}

// Uniform across y between rollers the plate is a bar in uniaxial strain, line by line of the books.
BOOST_DATA_TEST_CASE(between_rollers_it_is_the_bar, every_scheme* bdata::make({0, 1}), which, turned) {
  const double M = material::stiffness(E, nu, material::Plane::strain).normal, height = 0.7;
  const auto traction = [](double from, double to) { return 1e6 * (1 + std::sin(3e4 * (from + to))); };
  const auto velocity = [](double x) { return std::sin(9 * x) - 0.2; };
  for (const std::vector<double>& xi : {std::vector{0.5}, quarters, {0.1, 0.4, 0.7}, {0.0, 1.0}}) {
    if (which == 1 && xi[0] == 0.0) continue;
    Scene bar;
    bar.bars[0].length = 1;
    bar.bars[0].material = material::Elastic{M, density};
    bar.bars[0].initial_velocity = velocity;
    bar.left = diptych::Support::fixed;
    Load load;
    load.mean_traction = traction;
    bar.loads.push_back(load);
    bar.body_force = [](double x, double t) { return 1e5 * x + 1e9 * t; };
    Plate p = turned ? plate(height, 1) : plate(1, height);
    const std::size_t along = turned ? 1 : 0;
    if (turned)
      hold(p, {Hold::roller, Hold::roller, Hold::roller, Hold::free});
    else
      hold(p, {Hold::roller, Hold::free, Hold::roller, Hold::roller});
    p.edge(turned ? Side::top : Side::right).normal_traction = traction;
    p.initial_velocity = [&](double x, double y) { return turned ? Vector{0, velocity(y)} : Vector{velocity(x), 0}; };
    p.body_force = [&](double x, double y, double t) {
      return turned ? Vector{0, bar.body_force(y, t)} : Vector{bar.body_force(x, t), 0};
    };
    const Cells cells = turned ? Cells{3, 12} : Cells{12, 3};
    const Stepping how = stepping(p, cells, xi, scheme(which), 0.8, 60);
    const PlateRecord two = mpm::run(p, cells, xi, scheme(which), how);
    const Record one = mpm::run(bar, 12, xi, scheme(which), how);
    const PlateSnapshot& s = first(two);
    const std::size_t n = xi.size();
    std::vector<double> u, v, stress, lateral;
    for (std::size_t q = 0; q < s.stress.x.size(); ++q) {
      // of the row of particles nearest the start of the short side
      if ((turned ? s.stress.x[q] : s.stress.y[q]) >
          s.stress.x[0] * 0 + (turned ? s.stress.x[0] : s.stress.y[0]) + 1e-9)
        continue;
      u.push_back(s.displacement.component[along][q]);
      v.push_back(s.velocity.component[along][q]);
      stress.push_back(s.stress.component[along][q]);
      lateral.push_back(s.velocity.component[1 - along][q]);
    }
    BOOST_TEST_CONTEXT(n << " particles along a cell") {
      BOOST_TEST(difference(u, first(one).displacement.value) < 1e-11);
      BOOST_TEST(difference(v, first(one).velocity.value) < 1e-11);
      BOOST_TEST(difference(stress, first(one).stress.value) < 1e-11);
      BOOST_TEST(largest(lateral) < 1e-11);
      BOOST_TEST(s.displacement.time == first(one).displacement.time);
      BOOST_TEST(s.velocity.time == first(one).velocity.time);
      BOOST_TEST(s.stress.time == first(one).stress.time);
      BOOST_REQUIRE(two.ledger.size() == one.ledger.size());
      for (std::size_t k = 0; k < one.ledger.size(); ++k) {
        const LedgerLine &a = two.ledger[k], &b = one.ledger[k];
        const double unit = 1e-10 * (one.sums.held + std::abs(b.work));
        BOOST_TEST_REQUIRE(a.time == b.time);
        BOOST_TEST_REQUIRE(std::abs(a.kinetic / height - b.kinetic) < unit);
        BOOST_TEST_REQUIRE(std::abs(a.strain / height - b.strain) < unit);
        BOOST_TEST_REQUIRE(std::abs(a.scheme / height - b.scheme) < unit);
        BOOST_TEST_REQUIRE(std::abs(a.work / height - b.work) < unit);
        BOOST_TEST_REQUIRE(std::abs(a.momentum * std::sqrt(2) / height - b.momentum) < 1e-9 * density);
      }
    }
  }
}

// A linear velocity field, imposed on all sides: the same strain everywhere, growing with time. Cells are not square,
// and every one of the four gradients has its own number.
BOOST_DATA_TEST_CASE(patch_test, every_scheme, which) {
  for (const material::Plane plane : {material::Plane::strain, material::Plane::stress}) {
    for (const std::vector<double>& xi : {std::vector{0.5}, quarters, {0.2, 0.5, 0.8}}) {
      Plate p = plate(1.3, 0.8, plane);
      const auto field = [](double x, double y) { return Vector{3 * x - 5 * y + 1, 7 * x + 2 * y - 4}; };
      hold(p, {Hold::driven, Hold::driven, Hold::driven, Hold::driven});
      for (const Side side : sides) p.edge(side).velocity = [&](double x, double y, double) { return field(x, y); };
      p.initial_velocity = field;
      const PlateRecord r = run(p, {4, 3}, xi, scheme(which), 0.5, 40);
      the_books_close(r);
      const PlateSnapshot& s = first(r);
      const double t = s.stress.time;
      // by hand: λ = E ν/((1+ν)(1−2ν)), G = E/(2(1+ν)); in plane stress λ' = 2 λ G/(λ + 2 G)
      const double G = E / 2.6, lame = E * 0.3 / (1.3 * 0.4);
      const double l = plane == material::Plane::strain ? lame : 2 * lame * G / (lame + 2 * G);
      const double xx = (l * (3 + 2) + 2 * G * 3) * t, yy = (l * (3 + 2) + 2 * G * 2) * t, xy = G * (7 - 5) * t;
      for (std::size_t q = 0; q < s.stress.x.size(); ++q) {
        BOOST_TEST_REQUIRE(s.stress.component[0][q] == xx, tt::tolerance(1e-11));
        BOOST_TEST_REQUIRE(s.stress.component[1][q] == yy, tt::tolerance(1e-11));
        BOOST_TEST_REQUIRE(s.stress.component[2][q] == xy, tt::tolerance(1e-11));
        const Vector v = field(s.velocity.x[q], s.velocity.y[q]);
        for (std::size_t c = 0; c < 2; ++c) {
          BOOST_TEST_REQUIRE(std::abs(s.velocity.component[c][q] - v[c]) < 1e-10);
          BOOST_TEST_REQUIRE(std::abs(s.displacement.component[c][q] - v[c] * s.displacement.time) < 1e-10 * t);
        }
      }
      const double third = plane == material::Plane::strain ? 1.0 / 3 : (1 - 2 * nu) / (1 - nu) / 3;
      for (const double e : s.volumetric_strain) BOOST_TEST(e == 5 * t * third, tt::tolerance(1e-11));
    }
  }
}

// The same field, growing with time: what drives the sides accelerates the particles beside them, the body force the
// rest.
BOOST_DATA_TEST_CASE(driven_sides_that_speed_up, every_scheme, which) {
  Plate p = plate(1.3, 0.8);
  const auto field = [](double x, double y) { return Vector{3 * x - 5 * y + 1, 7 * x + 2 * y - 4}; };
  const auto times = [](const Vector& v, double f) { return Vector{f * v[0], f * v[1]}; };
  const double growth = 1e4;
  hold(p, {Hold::driven, Hold::driven, Hold::driven, Hold::driven});
  for (const Side side : sides)
    p.edge(side).velocity = [&](double x, double y, double t) { return times(field(x, y), 1 + growth * t); };
  p.initial_velocity = field;
  p.body_force = [&](double x, double y, double) { return times(field(x, y), growth); };
  const PlateRecord r = run(p, {4, 3}, quarters, scheme(which), 0.5, 40);
  the_books_close(r);
  const PlateSnapshot& s = first(r);
  for (std::size_t q = 0; q < s.velocity.x.size(); ++q) {
    const Vector v = times(field(s.velocity.x[q], s.velocity.y[q]), 1 + growth * s.velocity.time);
    for (std::size_t c = 0; c < 2; ++c) BOOST_TEST_REQUIRE(s.velocity.component[c][q] == v[c], tt::tolerance(1e-10));
  }
  const double t = s.time, dt = r.time / 40, grown = t + growth * t * t / 2;  // the mean of a step is its middle's
  const double strain = which == 0 ? grown - growth * dt * dt / 8 : grown;    // USF's first half-step has that of t = 0
  for (const double e : s.volumetric_strain) BOOST_TEST(e == 5 * strain / 3, tt::tolerance(1e-10));
}

// A displacement to start with has the strains of its nodal values.
BOOST_AUTO_TEST_CASE(strains_follow_from_the_initial_displacement) {
  Plate p = plate(1.5, 0.5);
  p.initial_displacement = [](double x, double y) { return Vector{1e-3 * x + 4e-3 * y, 2e-3 * x - 3e-3 * y}; };
  Stepping how = stepping(p, {4, 3}, {0.1, 0.7}, Scheme::musl, 1e-9, 1);
  const PlateRecord r = mpm::run(p, {4, 3}, {0.1, 0.7}, Scheme::musl, how);
  const material::Tensor stress = elastic(p).stiffness().stress({1e-3, -3e-3, 3e-3});
  for (std::size_t q = 0; q < first(r).stress.x.size(); ++q) {
    BOOST_TEST(first(r).stress.component[0][q] == stress.xx, tt::tolerance(1e-9));
    BOOST_TEST(first(r).stress.component[1][q] == stress.yy, tt::tolerance(1e-9));
    BOOST_TEST(first(r).stress.component[2][q] == stress.xy, tt::tolerance(1e-9));
  }
}

BOOST_DATA_TEST_CASE(rigid_motion_makes_no_stress, every_scheme, which) {
  for (const bool rotates : {false, true}) {
    for (const std::vector<double>& xi : {std::vector{0.0, 1.0}, {0.0, 0.5, 1.0}, {0.0}, {0.3, 0.9}}) {
      if (rotates && xi != std::vector{0.0, 1.0}) continue;  // the others lose some of it in mapping at the sides
      if (which == 1 && xi == std::vector{0.0}) continue;
      Plate p = plate(1.2, 0.9);
      p.initial_velocity = [&](double x, double y) { return rotates ? Vector{-8 * y, 8 * x} : Vector{3.0, -7.0}; };
      const PlateRecord r = run(p, {4, 5}, xi, scheme(which), 0.6, 30);
      const PlateSnapshot& s = first(r);
      const double strains = 8 * s.time;  // a strain of this much would be seen
      for (const auto& component : s.stress.component) BOOST_TEST(largest(component) < 1e-11 * E * strains);
      for (std::size_t q = 0; q < s.velocity.x.size(); ++q) {
        const Vector v = p.initial_velocity(s.velocity.x[q], s.velocity.y[q]);
        BOOST_TEST(std::abs(s.velocity.component[0][q] - v[0]) < 1e-11);
        BOOST_TEST(std::abs(s.velocity.component[1][q] - v[1]) < 1e-11);
      }
    }
  }
}

// By hand: v = x − ½ on one cell, particles at ¼ and ¾. Nodes get ∓⅛, their own kick adds nothing to the first strain.
BOOST_DATA_TEST_CASE(one_cell_by_hand, every_scheme, which) {
  Plate p = plate();
  p.initial_velocity = [](double x, double) { return Vector{x - 0.5, 0}; };
  Stepping how = stepping(p, {1, 1}, quarters, scheme(which), 0.3, 2);
  how.sample_after = {1, 2};
  const PlateRecord r = mpm::run(p, {1, 1}, quarters, scheme(which), how);
  const double dt = how.time_step, M = elastic(p).stiffness().normal, lame = elastic(p).stiffness().cross;
  const double strain = 0.25 * dt * (which == 0 ? 0.5 : 1);
  const auto& s = first(r);
  for (std::size_t q = 0; q < 4; ++q) {
    BOOST_TEST(s.stress.component[0][q] == M * strain, tt::tolerance(1e-13));
    BOOST_TEST(s.stress.component[1][q] == lame * strain, tt::tolerance(1e-13));
  }
  // The second force: ½ σ_xx on each left node to the right, of a quarter of the mass. The particle at ¼ takes half of
  // the difference; σ_yy pushes both rows outwards alike.
  const double first = which == 0 ? 2 * strain : 0;  // USF has had a kick with its half-step's strain before
  const double kicked = dt * M * (strain + (which == 0 ? strain : 0)) / 2 / (density / 4) / 2;
  (void)first;
  if (which != 0) BOOST_TEST(r.snapshots[1].velocity.component[0][0] == -0.25 + kicked, tt::tolerance(1e-13));
}

// A free plate in a field of gravity falls as one, and the books see all of its mass.
BOOST_DATA_TEST_CASE(body_force_and_mass, every_scheme, which) {
  Plate p = plate(1.5, 2);
  p.body_force = [](double, double, double) { return Vector{5, -8}; };
  const PlateRecord r = run(p, {3, 4}, {0.3, 0.6}, scheme(which), 0.5, 100);
  const PlateSnapshot& s = first(r);
  for (std::size_t q = 0; q < s.velocity.x.size(); ++q) {
    BOOST_TEST(s.velocity.component[0][q] == 5 * s.velocity.time, tt::tolerance(1e-11));
    BOOST_TEST(s.velocity.component[1][q] == -8 * s.velocity.time, tt::tolerance(1e-11));
  }
  const LedgerLine& last = r.ledger.back();
  BOOST_TEST(last.momentum == -3 * last.time * density * 3 / std::sqrt(2), tt::tolerance(1e-11));
  BOOST_TEST(last.impulse == last.momentum, tt::tolerance(1e-11));
  BOOST_TEST(last.kinetic == 89 * last.time * last.time * density * 3 / 2, tt::tolerance(1e-11));
}

// A traction's resultant is the traction times the side, wherever the particles are, and each node has its own share.
BOOST_DATA_TEST_CASE(tractions_give_their_impulse, bdata::make({0, 1, 2, 3}), where) {
  const Side side = sides[static_cast<std::size_t>(where)];
  Plate p = plate(1.5, 2);
  p.edge(side).normal_traction = [](double from, double to) { return 3 + (from + to); };
  p.edge(side).shear_traction = [](double, double) { return 7.0; };
  const PlateRecord r = run(p, {3, 4}, {0.3, 0.6}, Scheme::musl, 0.5, 20);
  const double length = where < 2 ? 2 : 1.5, sign = where % 2 ? 1 : -1, t = first(r).velocity.time;
  Vector momentum{0, 0};
  const PointField& v = first(r).velocity;
  for (std::size_t q = 0; q < v.x.size(); ++q) {
    for (std::size_t c = 0; c < 2; ++c) momentum[c] += density * v.weight[q] * v.component[c][q];
  }
  const std::size_t across = where < 2 ? 0 : 1;
  BOOST_TEST(momentum[across] == sign * length * (3 * t + t * t), tt::tolerance(1e-11));
  BOOST_TEST(momentum[1 - across] == 7 * length * t, tt::tolerance(1e-11));
  the_books_close(r);
}

// Uniform stress in equilibrium with its tractions stays. Shear on all four sides too.
BOOST_DATA_TEST_CASE(uniform_stress_in_equilibrium_stays, every_scheme, which) {
  for (const std::vector<double>& xi : {std::vector{0.5}, quarters, {0.1, 0.2, 0.9}}) {
    Plate p = plate(1.3, 0.8);
    p.initial_displacement = [](double x, double y) { return Vector{1e-3 * x + 4e-4 * y, 2e-4 * x - 3e-4 * y}; };
    const material::Tensor stress = elastic(p).stiffness().stress({1e-3, -3e-4, 3e-4});
    for (const Side side : sides) {
      const bool across = side == Side::left || side == Side::right, out = side == Side::right || side == Side::top;
      p.edge(side).normal_traction = [=](double, double) { return across ? stress.xx : stress.yy; };
      p.edge(side).shear_traction = [=](double, double) { return out ? stress.xy : -stress.xy; };
    }
    const PlateRecord r = run(p, {4, 3}, xi, scheme(which), 0.5, 300);
    for (std::size_t q = 0; q < first(r).stress.x.size(); ++q) {
      BOOST_TEST(first(r).stress.component[0][q] == stress.xx, tt::tolerance(1e-9));
      BOOST_TEST(first(r).stress.component[1][q] == stress.yy, tt::tolerance(1e-9));
      BOOST_TEST(first(r).stress.component[2][q] == stress.xy, tt::tolerance(1e-9));
    }
  }
}

// A platen on an uneven plate: particles that stand on its nodes all move with it, and it moves as far as it says.
BOOST_DATA_TEST_CASE(a_platen_keeps_its_side_straight, every_scheme* bdata::make({0, 1, 2, 3}), which, where) {
  if (which == 1) return;  // particles on nodes: USL as well, but for its own test below
  const Side side = sides[static_cast<std::size_t>(where)];
  const bool across = where < 2;
  Plate p = plate();
  hold(p, {Hold::roller, Hold::roller, Hold::roller, Hold::roller});
  p.edge(side).support = Hold::platen;
  p.edge(side).normal_traction = [](double, double) { return 1e8; };
  p.body_force = [](double x, double y, double) { return Vector{1e5 * ragged(x, y)[0], 1e5 * ragged(y, x)[0]}; };
  const PlateRecord r = run(p, {5, 4}, {0.0, 1.0}, scheme(which), 0.8, 40);
  the_books_close(r);
  BOOST_REQUIRE(r.platen.size() == 40U);
  const PointField& u = first(r).displacement;
  const double end = where % 2 ? 1 : 0, sign = where % 2 ? 1 : -1;
  int on_it = 0;
  for (std::size_t q = 0; q < u.x.size(); ++q) {
    if (std::abs((across ? u.x : u.y)[q] - end) > 1e-9) continue;
    ++on_it;
    BOOST_TEST(sign * u.component[across ? 0 : 1][q] == r.platen.back(), tt::tolerance(1e-11));
  }
  BOOST_TEST(on_it == (across ? 8 : 10));
  BOOST_TEST(largest(u.component[across ? 1 : 0]) > 0);
  BOOST_TEST(std::abs(r.platen.back()) > 0);
}

// A platen over a uniform plate is a bar's end with its load: what moves it is traction times length, whatever shares
// the nodes have.
BOOST_DATA_TEST_CASE(a_platen_carries_the_whole_load, every_scheme, which) {
  const auto pull = [](double, double) { return 1e7; };
  Plate with = plate(1, 1.5), without = plate(1, 1.5);
  hold(with, {Hold::roller, Hold::roller, Hold::roller, Hold::platen});
  hold(without, {Hold::roller, Hold::roller, Hold::roller, Hold::free});
  with.edge(Side::top).normal_traction = without.edge(Side::top).normal_traction = pull;
  const PlateRecord a = run(with, {4, 6}, quarters, scheme(which), 0.5, 50);
  const Stepping how = [&] {
    Stepping s = stepping(with, {4, 6}, quarters, scheme(which), 0.5, 50);
    return s;
  }();
  const PlateRecord b = mpm::run(without, {4, 6}, quarters, scheme(which), how);
  BOOST_TEST(difference(first(a).displacement.component[1], first(b).displacement.component[1]) < 1e-11);
  BOOST_TEST(difference(first(a).stress.component[1], first(b).stress.component[1]) < 1e-11);
  the_books_close(a);
  const std::vector<double>& u = first(a).displacement.component[1];  // linear across the last cell
  BOOST_TEST(1.5 * u.back() - 0.5 * u[u.size() - 3] == a.platen.back(), tt::tolerance(1e-11));
  BOOST_TEST(a.features == (std::vector<std::string>{"elastic", "platen"}), tt::per_element());
}

BOOST_DATA_TEST_CASE(powers_of_two_scale_every_bit, every_scheme, which) {
  Plate p = plate();
  hold(p, {Hold::roller, Hold::free, Hold::fixed, Hold::free});
  p.initial_velocity = ragged;
  p.edge(Side::top).normal_traction = [](double, double) { return 1e6; };
  Plate larger = p;
  larger.initial_velocity = [](double x, double y) { return Vector{8 * ragged(x, y)[0], 8 * ragged(x, y)[1]}; };
  larger.edge(Side::top).normal_traction = [](double, double) { return 8e6; };
  const PlateRecord a = run(p, {5, 4}, {0.2, 0.9}, scheme(which), 0.8, 30);
  const PlateRecord b = run(larger, {5, 4}, {0.2, 0.9}, scheme(which), 0.8, 30);
  for (std::size_t f = 0; f < fields(a).size(); ++f) {
    std::vector<double> scaled = fields(a)[f];
    for (double& v : scaled) v *= 8;
    BOOST_TEST(scaled == fields(b)[f], tt::per_element());
  }
}

// A mirrored plate gives the mirrored bits.
BOOST_DATA_TEST_CASE(mirrored_scenes_give_mirrored_bits, every_scheme* bdata::make({0, 1}), which, axis) {
  for (const std::vector<double>& xi : {std::vector{0.5}, quarters, {0.25, 0.5, 0.75}}) {
    const int nx = 4, ny = 8;  // powers of two: places mirror exactly
    Plate p = plate(1, 1), m;
    p.initial_velocity = ragged;
    hold(p, {Hold::roller, Hold::free, Hold::fixed, Hold::free});
    p.edge(Side::top).normal_traction = [](double, double) { return 1e6; };
    p.edge(Side::right).shear_traction = [](double, double) { return 3e6; };
    m = p;
    const Side near = axis == 0 ? Side::left : Side::bottom, far = axis == 0 ? Side::right : Side::top;
    std::swap(m.edge(near), m.edge(far));
    for (Edge& e : m.edges) {  // a shear along the mirrored axis turns round
      const Side side = static_cast<Side>(&e - m.edges.data());
      const bool along_x = side == Side::bottom || side == Side::top;
      if (e.shear_traction && along_x == (axis == 0)) e.shear_traction = [](double, double) { return -3e6; };
    }
    m.initial_velocity = [axis](double x, double y) {
      Vector v = axis == 0 ? ragged(1 - x, y) : ragged(x, 1 - y);
      v[static_cast<std::size_t>(axis)] = -v[static_cast<std::size_t>(axis)];
      return v;
    };
    const Stepping how = stepping(p, {nx, ny}, xi, scheme(which), 0.7, 25);
    const PlateRecord a = mpm::run(p, {nx, ny}, xi, scheme(which), how);
    const PlateRecord b = mpm::run(m, {nx, ny}, xi, scheme(which), how);
    const std::size_t n = xi.size();
    const auto mirrored = [&](std::size_t q) {
      std::size_t k = q % (n * n), i = q / (n * n) % nx, j = q / (n * n) / nx, ka = k % n, kb = k / n;
      if (axis == 0) {
        i = nx - 1 - i;
        ka = n - 1 - ka;
      } else {
        j = ny - 1 - j;
        kb = n - 1 - kb;
      }
      return (j * nx + i) * n * n + kb * n + ka;
    };
    const auto compare = [&](const std::vector<double>& x, const std::vector<double>& y, double sign) {
      int wrong = 0;
      for (std::size_t q = 0; q < x.size(); ++q) wrong += x[q] != sign * y[mirrored(q)];
      BOOST_TEST(wrong == 0);
      BOOST_TEST(largest(x) > 0);
    };
    const PlateSnapshot &s = first(a), &t = first(b);
    for (std::size_t c = 0; c < 2; ++c) {
      const double sign = static_cast<int>(c) == axis ? -1 : 1;
      compare(s.velocity.component[c], t.velocity.component[c], sign);
      compare(s.displacement.component[c], t.displacement.component[c], sign);
      compare(s.stress.component[c], t.stress.component[c], 1);
    }
    compare(s.stress.component[2], t.stress.component[2], -1);
  }
}

namespace {

/// Everything at once that stands still.
Plate busy() {
  Plate p = plate(1, 1.5);
  hold(p, {Hold::roller, Hold::free, Hold::roller, Hold::platen});
  p.initial_velocity = ragged;
  p.initial_displacement = [](double x, double y) { return Vector{1e-5 * x * y, 1e-5 * y * y}; };
  p.edge(Side::top).normal_traction = [](double from, double) { return from < 1e-4 ? 1e8 : 5e7; };
  p.edge(Side::right).shear_traction = [](double, double to) { return 1e10 * to; };
  p.body_force = [](double x, double y, double t) { return Vector{1e5 * y, 1e5 * std::sin(3 * x) + 1e9 * t}; };
  return p;
}

diffusion::Evolution evolution() {
  diffusion::Evolution e;
  e.critical_strain = 0;
  return e;
}

}  // namespace

BOOST_DATA_TEST_CASE(any_number_of_threads_gives_the_same_bits, every_scheme* bdata::make({0, 1, 2}), which, kind) {
  Plate p = busy();
  if (kind == 1) {
    solid::Cracking cracking{material::TensileDamage{elastic(p)}, evolution()};
    cracking.evolution.diffusion.emplace();
    p.solid = cracking;
    p.edge(Side::top).normal_traction = [](double, double) { return 7e8; };
  }
  if (kind == 2) {
    for (Edge& e : p.edges) e = Edge{};
    p.body_force = {};
    p.convected = true;
    p.solid = solid::Elastic{material::PlaneElastic{1e7, nu, density, material::Plane::strain}};
    p.initial_velocity = [](double x, double y) { return Vector{40 + ragged(x, y)[0], 90 + ragged(x, y)[1]}; };
  }
  Stepping how = stepping(p, {6, 7}, quarters, scheme(which), 0.6, 60);
  if (kind == 2) how.time_step = 1e-4;  // half a unit in all
  how.sample_after = {30, 60};
  const PlateRecord one = mpm::run(p, {6, 7}, quarters, scheme(which), how);
  BOOST_REQUIRE((one.outcome == Outcome::completed));
  if (kind == 1) BOOST_TEST(largest(one.snapshots[1].crack_density) > 0);
  for (const int threads : {2, 3, 20}) {
    how.threads = threads;
    const PlateRecord many = mpm::run(p, {6, 7}, quarters, scheme(which), how);
    BOOST_TEST((fields(one) == fields(many)));
    BOOST_REQUIRE(one.ledger.size() == many.ledger.size());
    for (std::size_t k = 0; k < one.ledger.size(); ++k) {
      BOOST_TEST_REQUIRE(one.ledger[k].lost == many.ledger[k].lost);
      BOOST_TEST_REQUIRE(one.ledger[k].strain == many.ledger[k].strain);
    }
  }
}

// --- books
// ------------------------------------------------------------------------------------------------------------

BOOST_DATA_TEST_CASE(the_books_close_whatever_acts, every_scheme* bdata::make({0.0, 0.3, 1.0}), which, pic) {
  for (const std::vector<double>& xi : {std::vector{0.5}, quarters, {0.1, 0.4, 0.7}}) {
    Plate p = busy();
    p.pic = pic;
    const PlateRecord r = run(p, {5, 7}, xi, scheme(which), 0.8, 200);
    the_books_close(r);
    if (pic == 0 && which != 1) BOOST_TEST(r.ledger.back().scheme == 0);
    if (pic > 0) BOOST_TEST(r.ledger.back().scheme > 0);
  }
}

BOOST_DATA_TEST_CASE(the_books_close_with_driven_sides, every_scheme, which) {
  Plate p = plate(1, 1.5);
  hold(p, {Hold::driven, Hold::free, Hold::roller, Hold::driven});
  p.initial_velocity = ragged;
  p.edge(Side::left).velocity = [](double, double y, double t) { return Vector{50 * y * std::sin(2e4 * t), 3.0}; };
  p.edge(Side::top).velocity = [](double x, double, double t) { return Vector{x, -3 * std::cos(1e4 * t)}; };
  p.edge(Side::right).normal_traction = [](double, double) { return 1e6; };
  the_books_close(run(p, {5, 7}, quarters, scheme(which), 0.8, 200));
}

// Two platens, and a corner that a fixed side keeps from one of them.
BOOST_DATA_TEST_CASE(the_books_close_with_two_platens, every_scheme, which) {
  Plate p = plate(1, 1.5);
  hold(p, {Hold::fixed, Hold::platen, Hold::roller, Hold::platen});
  p.initial_velocity = ragged;
  p.edge(Side::top).normal_traction = [](double, double) { return 1e7; };
  p.edge(Side::right).normal_traction = [](double from, double) { return from < 1e-4 ? -1e7 : 3e7; };
  const PlateRecord r = run(p, {5, 7}, quarters, scheme(which), 0.8, 200);
  the_books_close(r);
  // the first one by side, on the right: linear across the last cell
  const auto& u = first(r).displacement.component[0];
  const std::size_t last = u.size() / 7 - 1;
  BOOST_TEST(1.5 * u[last] - 0.5 * u[last - 1] == r.platen.back(), tt::tolerance(1e-9));
}

// The leapfrog's own energy does not drift.
BOOST_DATA_TEST_CASE(the_shadow_energy_stays, bdata::make({0, 2}), which) {
  Plate p = plate();
  hold(p, {Hold::roller, Hold::free, Hold::free, Hold::free});
  p.initial_velocity = ragged;
  const PlateRecord r = run(p, {6, 6}, quarters, scheme(which), 0.9, 5000);
  const double start = r.ledger.front().kinetic + r.ledger.front().strain;
  for (const LedgerLine& line : r.ledger)
    BOOST_TEST_REQUIRE(std::abs(line.kinetic + line.strain - start) < 1e-12 * start);
  BOOST_TEST(r.ledger.back().scheme == 0);
}

// --- waves
// ------------------------------------------------------------------------------------------------------------

namespace {

/// L2 norm of the error of the displacement after about 0.7 of a period.
double mode_error(bool lame, material::Plane plane, Scheme s, int n) {
  Plate p = plate(1, 1, plane);
  const double k = M_PI, A = 1e-4;
  const double omega = std::sqrt(2) * k * (lame ? elastic(p).shear_wave_speed() : elastic(p).pressure_wave_speed());
  if (!lame) hold(p, {Hold::roller, Hold::roller, Hold::roller, Hold::roller});
  const auto mode = [=](double x, double y) {
    return lame ? Vector{A * std::cos(k * x) * std::sin(k * y), -A * std::sin(k * x) * std::cos(k * y)}
                : Vector{A * std::sin(k * x) * std::cos(k * y), A * std::cos(k * x) * std::sin(k * y)};
  };
  p.initial_displacement = mode;
  Stepping how;
  how.books = Books::off;
  how.time_step = 0.5 / n / elastic(p).pressure_wave_speed();
  how.steps = std::lround(0.7 * 2 * M_PI / omega / how.time_step);
  how.sample_after = {how.steps};
  const PlateRecord r = mpm::run(p, {n, n}, quarters, s, how);
  const PointField& u = first(r).displacement;
  double error = 0, size = 0;
  for (std::size_t q = 0; q < u.x.size(); ++q) {
    const Vector exact = mode(u.x[q], u.y[q]);
    for (std::size_t c = 0; c < 2; ++c) {
      const double e = u.component[c][q] - exact[c] * std::cos(omega * u.time);
      error += u.weight[q] * e * e;
      size += u.weight[q] * exact[c] * exact[c];
    }
  }
  return std::sqrt(error / size);
}

}  // namespace

BOOST_DATA_TEST_CASE(modes_converge_with_order_two, every_scheme* bdata::make({0, 1, 2, 3}), which, kind) {
  const bool lame = kind % 2 == 0;
  const material::Plane plane = kind < 2 ? material::Plane::strain : material::Plane::stress;
  std::vector<double> error;
  for (const int n : {16, 32, 64}) error.push_back(mode_error(lame, plane, scheme(which), n));
  BOOST_TEST_CONTEXT(error[0] << " " << error[1] << " " << error[2]) {
    BOOST_TEST(error[2] < 0.005);
    for (std::size_t k = 0; k < 2; ++k) BOOST_TEST(std::abs(std::log2(error[k] / error[k + 1]) - 2) < 0.2);
  }
}

// --- stability
// --------------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(critical_time_steps_in_the_interior) {
  // Rollers mirror the plate to and fro: as many cells as there are waves, and no free side, but free ones are looked
  // at as well; a block that is nothing but interior would have these limits.
  const Plate p = plate(30, 30);
  const double c = elastic(p).pressure_wave_speed();
  const auto courant = [&](const std::vector<double>& xi, Scheme s) {
    return mpm::critical_time_step(p, {30, 30}, xi, s) * c;
  };
  // interior: √3 and 0.756; sides and corners ask for at most 4 % less
  BOOST_TEST(courant(quarters, Scheme::musl) <= std::sqrt(3) * (1 + 1e-12));
  BOOST_TEST(courant(quarters, Scheme::musl) > std::sqrt(3) * 0.95);
  BOOST_TEST(courant(quarters, Scheme::usl) <= 0.756);
  BOOST_TEST(courant(quarters, Scheme::usl) > 0.756 * 0.95);
  BOOST_TEST(courant({0.5}, Scheme::musl) <= 2);
  BOOST_TEST(courant({0.5}, Scheme::musl) > 1.9);
  BOOST_TEST(courant({0.5}, Scheme::usl) <= std::sqrt(0.5) * (1 + 1e-12));
  BOOST_TEST(courant({0.0}, Scheme::usl) < 1e-6);
  BOOST_TEST(courant({0.0, 1.0}, Scheme::usl) == courant({0.0, 1.0}, Scheme::musl), tt::tolerance(1e-9));
  Plate moving = p;
  moving.convected = true;  // all particles on nodes: 8 M/(ρ h²)
  for (const Scheme s : {Scheme::usf, Scheme::musl})
    BOOST_TEST(mpm::critical_time_step(moving, {30, 30}, quarters, s) * c == std::sqrt(0.5), tt::tolerance(1e-9));
}

// Cells much thinner than high: waves along x alone, Δt² = 2(1 + f)/(w λ) with f = 1 − part (1 − w), w = 1 − ¾ s² and
// λ = 4 s² c²/h²; with USL 2(1 + f)/((1 + f − w) λ).
BOOST_DATA_TEST_CASE(critical_time_steps_with_a_part_of_pic, every_scheme* bdata::make({0.0, 0.5, 1.0}), which, pic) {
  Plate p = plate(1, 1000);
  p.pic = pic;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 1; k <= 1000; ++k) {
    const double s2 = k / 1000.0, w = 1 - 0.75 * s2, f = 1 - pic * (1 - w);
    least = std::min(least, 2 * (1 + f) / ((which == 1 ? 1 + f - w : w) * 4 * s2));
  }
  const double limit = mpm::critical_time_step(p, {30, 30}, quarters, scheme(which));
  BOOST_TEST(limit * elastic(p).pressure_wave_speed() * 30 == std::sqrt(least), tt::tolerance(1e-3));
}

namespace {

bool stable(const Plate& p, const Cells& cells, const std::vector<double>& xi, Scheme s, double dt) {
  Stepping how;
  how.time_step = dt;
  how.steps = 1500;
  how.books = Books::off;
  how.sample_after = {how.steps};
  const PlateRecord r = mpm::run(p, cells, xi, s, how);
  return r.outcome == Outcome::completed && largest(first(r).velocity.component[0]) < 1e3 &&
         largest(first(r).velocity.component[1]) < 1e3;
}

}  // namespace

// Runs just below the limit stay, runs just above it blow up; up to eight cells the limit is that of the plate itself.
BOOST_DATA_TEST_CASE(critical_time_steps_are_the_runs_own, every_scheme* bdata::make({0, 1, 2, 3, 4, 5, 6, 7}), which,
                     kind) {
  Plate p = plate(1, 1);
  p.initial_velocity = ragged;
  Cells cells{6, 6};
  std::vector<double> xi = quarters;
  double above = 1.005;
  if (kind == 1) xi = {0.5};
  if (kind == 2) xi = {0.1, 0.4, 0.9};
  if (kind == 3) {
    p = plate(1, 2, material::Plane::stress);
    cells = {6, 5};
    above = 1.03;  // the interior of a larger one limits first
  }
  if (kind == 4) {
    hold(p, {Hold::roller, Hold::free, Hold::roller, Hold::platen});
    p.edge(Side::bottom).support = Hold::fixed;
  }
  if (kind == 5) p.pic = 0.3;
  if (kind == 6) {
    hold(p, {Hold::fixed, Hold::fixed, Hold::fixed, Hold::fixed});
    p.pic = 1;
    cells = {11, 10};
    above = 1.03;  // held all round; the limit is that of free plates
  }
  if (kind == 7) {
    cells = {14, 13};
    above = 1.01;
  }
  p.initial_velocity = ragged;
  const double limit = mpm::critical_time_step(p, cells, xi, scheme(which));
  BOOST_TEST(stable(p, cells, xi, scheme(which), 0.998 * limit));
  if (kind != 6 && kind != 4) BOOST_TEST(!stable(p, cells, xi, scheme(which), above * limit));
}

// --- damage and yield
// -------------------------------------------------------------------------------------------------

namespace {

/// Stretched by its driven sides at these rates, 1/s.
Plate stretched(double xx, double yy, double xy) {
  Plate p = plate();
  const auto field = [=](double x, double y) { return Vector{xx * x + xy * y, xy * x + yy * y}; };
  hold(p, {Hold::driven, Hold::driven, Hold::driven, Hold::driven});
  for (const Side side : sides) p.edge(side).velocity = [=](double x, double y, double) { return field(x, y); };
  p.initial_velocity = field;
  return p;
}

}  // namespace

// Local damage under a constant rate: at every time the crack density of the strain at that time, and its stress.
BOOST_DATA_TEST_CASE(damage_stands_at_the_strains_time, every_scheme* bdata::make({1.0, -1.0}), which, sign) {
  Plate p = stretched(sign * 100, sign * 50, 30);
  const material::TensileDamage material{elastic(p)};
  p.solid = solid::Cracking{material, evolution()};
  Stepping how = stepping(p, {3, 2}, quarters, scheme(which), 0.01, 1);
  how.steps = std::lround(2e-3 / 50 / how.time_step);
  how.sample_after = {how.steps / 2, how.steps};
  const PlateRecord r = mpm::run(p, {3, 2}, quarters, scheme(which), how);
  BOOST_REQUIRE(r.snapshots.size() == 2U);
  for (const PlateSnapshot& s : r.snapshots) {
    const double volumetric = sign * 50 * s.time;
    const double cracks = material.crack_density(volumetric, 100);
    const material::Tensor strain{sign * 100 * s.time, sign * 50 * s.time, 30 * s.time};
    const material::Tensor stress = material.damaged_stiffness(cracks).at(strain).stress(strain);
    for (const double c : s.crack_density) {
      if (sign > 0)
        BOOST_TEST(c == cracks, tt::tolerance(1e-9));
      else
        BOOST_TEST(c == 0);
    }
    for (const double e : s.volumetric_strain) BOOST_TEST(e == volumetric, tt::tolerance(1e-10));
    BOOST_TEST(s.strain.size() == 6U);
    for (std::size_t q = 0; q < s.stress.x.size(); ++q) {
      BOOST_TEST(s.stress.component[0][q] == stress.xx, tt::tolerance(1e-9));
      BOOST_TEST(s.stress.component[1][q] == stress.yy, tt::tolerance(1e-9));
      BOOST_TEST(s.stress.component[2][q] == stress.xy, tt::tolerance(1e-9));
    }
  }
  if (sign > 0) {
    BOOST_TEST(largest(r.snapshots[1].crack_density) > 0.01);
    BOOST_TEST(r.ledger.back().dissipated > 0);
  }
  the_books_close(r);
  BOOST_TEST(r.features == std::vector<std::string>{"damage"}, tt::per_element());
}

// Cracked in tension, then pressed together: the cracks stay, and close.
BOOST_DATA_TEST_CASE(closed_cracks_carry_load, every_scheme, which) {
  Plate p = stretched(-100, -50, 30);
  p.initial_displacement = [](double x, double y) { return Vector{4e-3 * x, 2e-3 * y}; };  // mean strain 2e-3
  const material::TensileDamage material{elastic(p)};
  p.solid = solid::Cracking{material, evolution()};
  Stepping how = stepping(p, {3, 2}, quarters, scheme(which), 0.01, 1);
  how.steps = std::lround(8e-5 / how.time_step);
  how.sample_after = {how.steps / 4, how.steps};
  const PlateRecord r = mpm::run(p, {3, 2}, quarters, scheme(which), how);
  const double t0 = (which == 0 ? 0.5 : 1) * how.time_step, cracks = material.crack_density(2e-3 - 50 * t0, 100);
  BOOST_TEST(cracks > 0.01);
  for (const PlateSnapshot& s : r.snapshots) {
    const material::Tensor strain{4e-3 - 100 * s.time, 2e-3 - 50 * s.time, 30 * s.time};
    const bool open = strain.xx + strain.yy >= 0;
    BOOST_TEST(open == (&s == &r.snapshots.front()));
    const auto stiffness = material.damaged_stiffness(cracks);
    const material::Tensor stress = (open ? stiffness.open : stiffness.closed).stress(strain);
    for (const double c : s.crack_density) BOOST_TEST(c == cracks, tt::tolerance(1e-9));
    for (std::size_t q = 0; q < s.stress.x.size(); ++q) {
      BOOST_TEST_REQUIRE(s.stress.component[0][q] == stress.xx, tt::tolerance(1e-9));
      BOOST_TEST_REQUIRE(s.stress.component[1][q] == stress.yy, tt::tolerance(1e-9));
      BOOST_TEST_REQUIRE(s.stress.component[2][q] == stress.xy, tt::tolerance(1e-9));
    }
  }
  the_books_close(r);
}

// What damage takes at the least, by hand for the uniform plate: Σ ½ ε_{n−1} : (C_{n−1} − C_n) : ε_{n−1}.
BOOST_AUTO_TEST_CASE(damage_dissipates_what_it_should) {
  Plate p = stretched(100, 50, 30);
  const material::TensileDamage material{elastic(p)};
  p.solid = solid::Cracking{material, evolution()};
  Stepping how = stepping(p, {3, 2}, quarters, Scheme::musl, 0.01, 1);
  how.steps = std::lround(2e-3 / 50 / how.time_step);
  const PlateRecord r = mpm::run(p, {3, 2}, quarters, Scheme::musl, how);
  double dissipated = 0;
  material::Stiffness before = material.elastic.stiffness();
  for (long n = 1; n < how.steps; ++n) {
    const double t = static_cast<double>(n) * how.time_step, s = t - how.time_step;
    const material::Stiffness now = material.damaged_stiffness(material.crack_density(50 * t, 100)).open;
    const material::Tensor strain{100 * s, 50 * s, 30 * s};
    dissipated += (before.stress(strain) - now.stress(strain)).contract(strain) / 2;
    before = now;
  }
  BOOST_TEST(r.ledger.back().dissipated == dissipated, tt::tolerance(1e-6));
}

// A crack density that is a step late in the force is work that nobody accounts for; waves and a kink at zero strain
// too.
BOOST_DATA_TEST_CASE(the_books_close_with_damage, every_scheme* bdata::make({0, 1}), which, diffuses) {
  Plate p = busy();
  const material::TensileDamage material{elastic(p)};
  p.solid = solid::Cracking{material, evolution()};
  p.edge(Side::top).normal_traction = [](double, double) { return 7e8; };
  if (diffuses) std::get<solid::Cracking>(p.solid).evolution.diffusion.emplace();
  const PlateRecord r =
      mpm::run(p, {6, 9}, quarters, scheme(which), stepping(p, {6, 9}, quarters, scheme(which), 0.5, 150));
  the_books_close(r);
  BOOST_TEST(r.ledger.back().dissipated > 0);
  BOOST_TEST((r.fed > 0) == (diffuses == 1));
  BOOST_TEST((std::find(r.features.begin(), r.features.end(), "diffusion") != r.features.end()) == (diffuses == 1));
}

BOOST_DATA_TEST_CASE(yield_in_compression, every_scheme, which) {
  Plate p = stretched(-100, 30, 40);
  compression(p) = material::Compression{2e7, 0.5};
  Stepping how = stepping(p, {2, 3}, quarters, scheme(which), 0.3, 60);
  const PlateRecord r = mpm::run(p, {2, 3}, quarters, scheme(which), how);
  const PlateSnapshot& s = first(r);
  material::PlasticStrain state;
  material::Tensor stress;
  for (long n = 1; n <= how.steps; ++n) {
    const double t = (static_cast<double>(n) - (which == 0 ? 0.5 : 0)) * how.time_step;
    stress = compression(p)->stress(elastic(p), {-100 * t, 30 * t, 40 * t}, state);
  }
  BOOST_TEST(std::abs(state.xx) > 0.1 * 100 * s.time);
  for (std::size_t q = 0; q < s.stress.x.size(); ++q) {
    BOOST_TEST(s.stress.component[0][q] == stress.xx, tt::tolerance(1e-8));
    BOOST_TEST(s.stress.component[1][q] == stress.yy, tt::tolerance(1e-8));
    BOOST_TEST(s.stress.component[2][q] == stress.xy, tt::tolerance(1e-8));
  }
  BOOST_TEST(r.ledger.back().dissipated > 0);
  the_books_close(r);
  BOOST_TEST(r.features == (std::vector<std::string>{"compression-plasticity", "elastic"}), tt::per_element());
}

// --- features that are off
// --------------------------------------------------------------------------------------------

BOOST_DATA_TEST_CASE(features_that_are_off_leave_the_bits_alone, every_scheme, which) {
  Plate p = busy();
  p.body_force = {};
  Plate null_force = p, never_yields = p, never_cracks = p, small_pic = p;
  null_force.body_force = [](double, double, double) { return Vector{0, 0}; };
  compression(never_yields) = material::Compression{1e300, 0};
  material::TensileDamage without_flaws{elastic(p)};
  without_flaws.flaw_density = 0;
  never_cracks.solid = solid::Cracking{without_flaws, evolution()};
  const Stepping how = stepping(p, {5, 4}, quarters, scheme(which), 0.7, 40);
  const auto go = [&](const Plate& q) { return mpm::run(q, {5, 4}, quarters, scheme(which), how); };
  const PlateRecord a = go(p), b = go(null_force), c = go(never_yields), d = go(never_cracks);
  const auto same = [](const PlateRecord& x, const PlateRecord& y) {
    return first(x).stress.component == first(y).stress.component &&
           first(x).displacement.component == first(y).displacement.component && x.platen == y.platen;
  };
  BOOST_TEST(same(a, b));
  BOOST_TEST(same(a, c));
  BOOST_TEST(same(a, d));
  for (const PlateRecord* r : {&b, &c, &d}) BOOST_TEST(a.work.bytes < r->work.bytes);
  small_pic.pic = 0.1;
  BOOST_TEST(!same(a, go(small_pic)));
  Stepping without = how;
  without.books = Books::off;
  BOOST_TEST(same(a, mpm::run(p, {5, 4}, quarters, scheme(which), without)));
}

BOOST_AUTO_TEST_CASE(memory_and_work) {
  const Plate p = plate();
  Stepping how = stepping(p, {100, 100}, quarters, Scheme::musl, 0.5, 3);
  how.books = Books::off;
  const PlateRecord r = mpm::run(p, {100, 100}, quarters, Scheme::musl, how);
  BOOST_TEST(r.work.particle_steps == 120000);
  BOOST_TEST(r.work.node_steps == 3 * 101 * 101);
  BOOST_TEST(static_cast<double>(r.work.bytes) / 40000 < 120);
  const PointField& f = first(r).stress;
  double area = 0;
  for (const double w : f.weight) area += w;
  BOOST_TEST(area == 1, tt::tolerance(1e-11));
}

// --- particles that move
// ----------------------------------------------------------------------------------------------

// USL has no limit above zero where particles come near a face, so that round-off grows: it is left out, as on the bar.
BOOST_DATA_TEST_CASE(rigid_flight_across_cells, bdata::make({0, 2}), which) {
  for (const std::vector<double>& xi : {quarters, std::vector{0.0, 0.5}, {0.5}, {1.0}}) {
    Plate p = plate();
    p.convected = true;
    p.initial_velocity = [](double, double) { return Vector{300, -375}; };
    Stepping how = stepping(p, {10, 8}, quarters, Scheme::musl, 0.5, 150);
    how.time_step = 1.0 / 90000;  // 30 steps a cell in x and y, so that particles land on faces and corners
    const PlateRecord r = mpm::run(p, {10, 8}, xi, scheme(which), how);
    BOOST_TEST_CONTEXT(r.message) { BOOST_REQUIRE((r.outcome == Outcome::completed)); }
    const PlateSnapshot& s = first(r);
    for (std::size_t q = 0; q < s.velocity.x.size(); ++q) {
      BOOST_TEST_REQUIRE(s.velocity.component[0][q] == 300.0, tt::tolerance(1e-11));
      BOOST_TEST_REQUIRE(s.velocity.component[1][q] == -375.0, tt::tolerance(1e-11));
      BOOST_TEST_REQUIRE(s.displacement.component[0][q] == 300 * s.displacement.time, tt::tolerance(1e-11));
    }
    for (const auto& component : s.stress.component) BOOST_TEST(largest(component) < 1e-10 * E);
    BOOST_TEST(r.features == (std::vector<std::string>{"convection", "elastic"}), tt::per_element());
  }
}

// So small a motion that nobody notices the places.
BOOST_DATA_TEST_CASE(small_motions_are_infinitesimal, every_scheme, which) {
  Plate p = plate(1, 1.5);
  hold(p, {Hold::roller, Hold::free, Hold::fixed, Hold::free});
  p.initial_velocity = [](double x, double y) { return Vector{1e-6 * ragged(x, y)[0], 1e-6 * ragged(x, y)[1]}; };
  p.initial_displacement = [](double x, double y) { return Vector{1e-10 * x * y, 1e-10 * y * y}; };
  p.body_force = [](double x, double, double) { return Vector{1e-2 * x, 1e-2}; };
  Plate moving = p;
  moving.convected = true;
  const Stepping how = stepping(p, {5, 7}, quarters, scheme(which), 0.3, 100);
  const PlateRecord a = mpm::run(p, {5, 7}, quarters, scheme(which), how);
  const PlateRecord b = mpm::run(moving, {5, 7}, quarters, scheme(which), how);
  for (std::size_t c = 0; c < 2; ++c) {
    BOOST_TEST(difference(first(b).displacement.component[c], first(a).displacement.component[c]) < 1e-6);
    BOOST_TEST(difference(first(b).velocity.component[c], first(a).velocity.component[c]) < 1e-6);
  }
  for (std::size_t c = 0; c < 3; ++c)
    BOOST_TEST(difference(first(b).stress.component[c], first(a).stress.component[c]) < 1e-6);
}

// Crossing takes and gives energy, and the books tell how much.
BOOST_DATA_TEST_CASE(the_books_close_while_particles_cross, every_scheme* bdata::make({0.0, 0.2}), which, pic) {
  Plate p = plate(1, 1.5);
  hold(p, {Hold::roller, Hold::free, Hold::roller, Hold::free});
  p.convected = true;
  p.pic = pic;
  p.initial_velocity = [](double x, double y) { return Vector{60 * x + 5 * y, 40 * y}; };
  p.body_force = [](double x, double, double) { return Vector{1e3 * x, 1e3}; };
  p.solid = solid::Elastic{
      material::PlaneElastic{1e6, nu, density, material::Plane::strain}};  // little, or crossing blows it up
  Stepping how = stepping(p, {6, 8}, quarters, scheme(which), 0.2, 100);
  how.time_step = 5e-5;
  const PlateRecord r = mpm::run(p, {6, 8}, quarters, scheme(which), how);
  the_books_close(r);
  BOOST_TEST(std::abs(r.ledger.back().scheme) > 1e-6 * r.ledger.back().strain);
  BOOST_TEST(largest(first(r).displacement.component[0]) > 1.0 / 6);
}

BOOST_AUTO_TEST_CASE(particles_that_leave_the_grid_are_told) {
  for (const double sign : {1.0, -1.0}) {
    Plate p = plate();
    p.convected = true;
    p.initial_velocity = [=](double, double) { return Vector{0, sign * 5000}; };
    const PlateRecord r = run(p, {4, 4}, quarters, Scheme::musl, 0.5, 2000);
    BOOST_TEST((r.outcome == Outcome::left_grid));
    BOOST_TEST(r.message.find("left the grid") != std::string::npos);
    BOOST_TEST(r.steps < 2000);
  }
}

// --- refusals
// ---------------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(what_cannot_be_is_refused) {
  const auto refused = [](const Plate& p, const std::vector<double>& xi = quarters, const Cells& cells = {2, 2}) {
    Stepping how;
    how.time_step = 1e-9;
    how.steps = 1;
    BOOST_CHECK_THROW(mpm::run(p, cells, xi, Scheme::musl, how), std::invalid_argument);
  };
  const auto none = [](double, double) { return 0.0; };
  refused(plate(), {});
  refused(plate(), {0.75, 0.25});
  refused(plate(), {0.5, 1.5});
  refused(plate(), std::vector<double>(9, 0.5));
  refused(plate(), quarters, {0, 2});
  Plate p = plate();
  p.solid = solid::Cracking{material::TensileDamage{elastic(p)}};
  p.convected = true;
  refused(p);
  p = plate(1, 1, material::Plane::stress);
  compression(p) = material::Compression{1, 1};
  refused(p);
  p = plate();
  p.pic = 1.1;
  refused(p);
  p.pic = std::numeric_limits<double>::quiet_NaN();
  refused(p);
  p = plate();
  p.convected = true;
  p.edge(Side::left).shear_traction = none;
  refused(p);
  p = plate();
  p.edge(Side::left).support = Hold::driven;
  refused(p);
  p = plate();
  hold(p, {Hold::fixed, Hold::fixed, Hold::free, Hold::platen});
  refused(p, quarters, {1, 2});
  const auto loaded = [&](Hold support, bool normal) {
    p = plate();
    p.edge(Side::top).support = support;
    if (support == Hold::driven) p.edge(Side::top).velocity = [](double, double, double) { return Vector{}; };
    (normal ? p.edge(Side::top).normal_traction : p.edge(Side::top).shear_traction) = none;
    refused(p);
  };
  loaded(Hold::fixed, true);
  loaded(Hold::fixed, false);
  loaded(Hold::driven, true);
  loaded(Hold::roller, true);
  loaded(Hold::platen, false);
  p = plate();
  hold(p, {Hold::free, Hold::free, Hold::free, Hold::platen});
  p.convected = true;
  refused(p);
}

BOOST_AUTO_TEST_SUITE_END()
