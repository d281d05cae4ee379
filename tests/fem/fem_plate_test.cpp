#include <algorithm>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include "fem/cell.hpp"
#include "fem/plate.hpp"
#include "fem/sweep.hpp"
#include "tests/plate_records.hpp"

BOOST_AUTO_TEST_SUITE(fem_plate)

using namespace diptych;
using material::Plane;
using material::Tensor;
namespace tt = boost::test_tools;
namespace data = boost::unit_test::data;

namespace {

/// A plane that can be printed.
struct Either {
  Plane plane;
  operator Plane() const { return plane; }
};
std::ostream& operator<<(std::ostream& out, const Either& e) {
  return out << (e.plane == Plane::strain ? "plane strain" : "plane stress");
}
const std::vector<Either> planes{{Plane::strain}, {Plane::stress}};

/// E = 1e4, ν = 0.3, ρ = 1: wave speeds of order 100.
Plate plate_of(double width, double height, Plane plane = Plane::strain, double nu = 0.3) {
  Plate plate;
  plate.width = width;
  plate.height = height;
  plate.solid = solid::Elastic{material::PlaneElastic{1e4, nu, 1, plane}};
  return plate;
}

PlateRecord run(const Plate& plate, const Cells& cells, const Stepping& stepping) {
  return fem::run(plate, cells, stepping);
}

/// At 0.9 of the limit.
PlateRecord run(const Plate& plate, const Cells& cells, long steps, Books books = Books::lines) {
  return run(plate, cells, steps_of(0.9 * fem::critical_time_step(plate, cells), steps, books));
}

/// Something that no mesh and no side is made for, |v| ≤ 1; the same bits at x and at the point that mirrors call x.
Vector shaken(double x, double y) {
  const auto part = [](double z) { return z - std::floor(z); };
  return {2 * part(1234.5 * x + 777.7 * y + 99.9 * x * y) - 1, 2 * part(555.5 * x - 888.8 * y + 44.4 * x * x) - 1};
}

double largest(const PointField& f) {
  double most = 0;
  for (const auto& values : f.component) {
    for (const double v : values) most = std::isnan(v) ? v : std::max(most, std::abs(v));
  }
  return most;
}

void same_bits(const PointField& a, const PointField& b, std::array<double, 3> factor = {1, 1, 1}) {
  BOOST_TEST_REQUIRE(a.component.size() == b.component.size());
  for (std::size_t c = 0; c < a.component.size(); ++c) {
    BOOST_TEST_REQUIRE(a.component[c].size() == b.component[c].size());
    std::size_t different = 0;
    for (std::size_t k = 0; k < a.component[c].size(); ++k)
      different += a.component[c][k] * factor[c] != b.component[c][k];
    BOOST_TEST(different == 0U);
  }
}
void same_bits(const PlateRecord& a, const PlateRecord& b) {
  const PlateSnapshot &s = a.snapshots.at(0), &t = b.snapshots.at(0);
  same_bits(s.displacement, t.displacement);
  same_bits(s.velocity, t.velocity);
  same_bits(s.stress, t.stress);
  BOOST_TEST(s.crack_density == t.crack_density, tt::per_element());
  BOOST_TEST(a.platen == b.platen, tt::per_element());
}

/// All that a plate can be held and loaded by, at once.
Plate busy_plate(double width, double height) {
  Plate plate = plate_of(width, height);
  plate.edge(Side::bottom).support = Edge::Support::roller;
  plate.edge(Side::bottom).shear_traction = [](double from, double) { return 3 + 100 * from; };
  plate.edge(Side::left).normal_traction = [](double from, double to) { return 5 * std::sin(50 * (from + to)); };
  plate.edge(Side::top).support = Edge::Support::platen;
  plate.edge(Side::top).normal_traction = [](double, double) { return -4.0; };
  plate.edge(Side::right).support = Edge::Support::driven;
  plate.edge(Side::right).velocity = [](double, double y, double t) {
    return Vector{0.1 * std::cos(90 * t), 0.1 * y * std::sin(40 * t)};
  };
  plate.body_force = [](double x, double y, double t) { return Vector{20 * x * t, -10 * y}; };
  plate.initial_velocity = [](double x, double y) { return Vector{0.3 * shaken(x, y)[0], 0.3 * shaken(x, y)[1]}; };
  return plate;
}

void books_close(const PlateRecord& r, double tolerance = 1e-12) {
  BOOST_TEST_REQUIRE((r.outcome == Outcome::completed));
  double exchanged = 0, pushed = 0;
  for (const LedgerLine& line : r.ledger) {
    exchanged = std::max({exchanged, std::abs(line.work), line.kinetic + std::abs(line.strain)});
    pushed = std::max({pushed, std::abs(line.impulse), std::abs(line.momentum)});
  }
  BOOST_TEST_REQUIRE(exchanged > 0.0);
  BOOST_TEST(r.sums.lost <= tolerance * exchanged);
  BOOST_TEST(r.sums.momentum <= tolerance * std::max(pushed, std::sqrt(exchanged)));
}

}  // namespace

// ---- the cell ----

// Forces do the virtual work of the stresses, f·u = −Σ A σ:ε(u), and the two ways to find them agree.
BOOST_AUTO_TEST_CASE(forces_of_a_cell_do_the_work_of_its_stresses) {
  const fem::CellSize h{0.3, 0.7};
  const material::Stiffness solid = material::stiffness(7, 0.2, Plane::strain);
  fem::CellValues u, w;
  for (std::size_t k = 0; k < 5; ++k) {
    u[k] = shaken(0.1 * static_cast<double>(k), 0.3);
    w[k] = shaken(0.7, 0.2 * static_cast<double>(k));
  }
  fem::Triangles stress = fem::strains(u, h);
  for (Tensor& t : stress) t = solid.stress(t);
  const fem::CellValues f = fem::internal_forces(stress, h);
  const fem::Triangles virtual_strain = fem::strains(w, h);
  double outer = 0, inner = 0;
  for (std::size_t k = 0; k < 5; ++k) outer += f[k][0] * w[k][0] + f[k][1] * w[k][1];
  for (std::size_t t = 0; t < 4; ++t) inner += h.triangle_area() * stress[t].contract(virtual_strain[t]);
  BOOST_TEST(outer == -inner, tt::tolerance(1e-13));

  for (const bool body : {false, true}) {
    fem::CornerForces g;
    double zero[2] = {0, 0};
    double ux = u[4][0], uy = u[4][1], vx = 0, vy = 0;
    const double bx = 0.5, by = -0.25;
    const double lower_x[2] = {u[0][0], u[1][0]}, lower_y[2] = {u[0][1], u[1][1]};
    const double upper_x[2] = {u[3][0], u[2][0]}, upper_y[2] = {u[3][1], u[2][1]};
    fem::loops(body, false)
        .cells(fem::WholeCell(solid, h), 1, lower_x, lower_y, upper_x, upper_y,
               {&ux, &uy, &vx, &vy, body ? &bx : zero, body ? &by : zero}, {1, 0}, g, 0);
    for (std::size_t c = 0; c < 2; ++c) {
      BOOST_TEST(g.lower_left[c][0] == f[0][c], tt::tolerance(1e-13));
      BOOST_TEST(g.lower_right[c][1] == f[1][c], tt::tolerance(1e-13));
      BOOST_TEST(g.upper_right[c][1] == f[2][c], tt::tolerance(1e-13));
      BOOST_TEST(g.upper_left[c][0] == f[3][c], tt::tolerance(1e-13));
    }
    BOOST_TEST(vx == f[4][0] + (body ? bx : 0), tt::tolerance(1e-13));
    BOOST_TEST(vy == f[4][1] + (body ? by : 0), tt::tolerance(1e-13));
  }
}

// A run of cells with stresses of their own gets, several cells at once, the numbers of each cell alone.
BOOST_AUTO_TEST_CASE(cells_side_by_side_get_what_each_gets_alone) {
  constexpr std::size_t cells = 11;  // no multiple of what a register holds
  const fem::CellSize h{0.3, 0.7};
  for (const auto& [body, viscous] : {std::pair{false, false}, {true, false}, {false, true}, {true, true}}) {
    std::array<std::array<std::array<double, cells>, 4>, 4> of{};  // of each triangle xx, yy, xy and q
    fem::StressRows rows{};
    for (std::size_t t = 0; t < 4; ++t) {
      for (std::size_t c = 0; c < 4; ++c) {
        for (std::size_t i = 0; i < cells; ++i) of[t][c][i] = std::sin(1 + static_cast<double>(t + 4 * c + 16 * i));
      }
      rows.triangle[t] = {of[t][0].data(), of[t][1].data(), of[t][2].data(), viscous ? of[t][3].data() : nullptr};
    }
    std::array<double, cells> ux{}, uy{}, vx{}, vy{}, bx{}, by{};
    bx.fill(0.5);
    by.fill(-0.25);
    fem::CornerForces g;
    fem::loops(body, viscous)
        .own_cells(rows, h, cells,
                   {ux.data(), uy.data(), vx.data(), vy.data(), body ? bx.data() : nullptr, body ? by.data() : nullptr},
                   {0.5, 0.25}, g, 3);
    for (std::size_t i = 0; i < cells; ++i) {
      fem::Triangles stress;
      for (std::size_t t = 0; t < 4; ++t) {
        const double q = viscous ? of[t][3][i] : 0;
        stress[t] = {of[t][0][i] + q, of[t][1][i] + q, of[t][2][i]};
      }
      const fem::CellValues f = fem::internal_forces(stress, h);
      for (std::size_t c = 0; c < 2; ++c) {
        BOOST_TEST(g.lower_left[c][3 + i] == f[0][c]);
        BOOST_TEST(g.lower_right[c][4 + i] == f[1][c]);
        BOOST_TEST(g.upper_right[c][4 + i] == f[2][c]);
        BOOST_TEST(g.upper_left[c][3 + i] == f[3][c]);
      }
      const double fx = f[4][0] + (body ? 0.5 : 0), fy = f[4][1] + (body ? -0.25 : 0);
      BOOST_TEST((vx[i] == 0.5 * fx && vy[i] == 0.5 * fy && ux[i] == 0.25 * vx[i] && uy[i] == 0.25 * vy[i]));
    }
  }
}

BOOST_AUTO_TEST_CASE(strains_of_a_linear_field_are_its_own) {
  const fem::CellSize h{0.5, 0.25};
  const auto field = [](double x, double y) { return Vector{2 * x + 8 * y, -3 * x + 5 * y}; };
  const fem::CellValues u{field(0, 0), field(0.5, 0), field(0.5, 0.25), field(0, 0.25), field(0.25, 0.125)};
  for (const Tensor& e : fem::strains(u, h)) {
    BOOST_TEST(e.xx == 2.0);
    BOOST_TEST(e.yy == 5.0);
    BOOST_TEST(e.xy == 2.5);
  }
  BOOST_TEST(fem::mean_strain(u, h).xx == 2.0);
  BOOST_TEST(fem::mean_strain(u, h).yy == 5.0);
  BOOST_TEST(fem::mean_strain(u, h).xy == 2.5);
  fem::CellValues bent = u;
  bent[4] = {7, -9};
  Tensor mean;
  for (const Tensor& e : fem::strains(bent, h)) mean = mean + e * 0.25;
  BOOST_TEST(mean.xx == 2.0);
  BOOST_TEST(mean.yy == 5.0);
  BOOST_TEST(mean.xy == 2.5);
}

// ---- exact answers ----

// A linear velocity field given at all sides, with which the inside starts: the strain is uniform and grows with time.
BOOST_DATA_TEST_CASE(patch_test, data::make(planes) * data::make({1.0, 3.7}), plane, height) {
  Plate plate = plate_of(1, height, plane);
  const auto field = [](double x, double y) { return Vector{0.2 * x - 0.3 * y + 1, 0.5 * x + 0.7 * y - 2}; };
  for (const Side side : sides) {
    plate.edge(side).support = Edge::Support::driven;
    plate.edge(side).velocity = [field](double x, double y, double) { return field(x, y); };
  }
  plate.initial_velocity = field;
  const PlateRecord r = run(plate, {7, 5}, 2000);
  const PlateSnapshot& s = r.snapshots.at(0);
  const Tensor expected = elastic(plate).stiffness().stress(Tensor{0.2, 0.7, 0.1} * s.time);
  double off = 0;
  for (std::size_t k = 0; k < s.stress.x.size(); ++k) {
    off =
        std::max({off, std::abs(s.stress.component[0][k] - expected.xx),
                  std::abs(s.stress.component[1][k] - expected.yy), std::abs(s.stress.component[2][k] - expected.xy)});
  }
  BOOST_TEST(off < 1e-11 * expected.yy);  // displacements of order 2 s.time on cells of order 0.2, over 2000 steps
  for (const double e : s.volumetric_strain) {
    BOOST_TEST(e == 0.9 * s.time * elastic(plate).trace_factor() / 3, tt::tolerance(1e-11));
  }
  books_close(r);
}

// A plate that starts in equilibrium with the tractions on its free sides stays there: consistent nodal forces.
BOOST_DATA_TEST_CASE(a_plate_in_equilibrium_with_its_tractions_stays, data::make(planes), plane) {
  Plate plate = plate_of(2, 1.3, plane);
  const Tensor strain{0.01, -0.004, 0.003}, stress = elastic(plate).stiffness().stress(strain);
  for (const Side side : sides) {
    const bool upright = side == Side::left || side == Side::right;
    const double sign = side == Side::left || side == Side::bottom ? -1 : 1;
    plate.edge(side).normal_traction = [=](double, double) { return upright ? stress.xx : stress.yy; };
    plate.edge(side).shear_traction = [=](double, double) { return sign * stress.xy; };
  }
  plate.initial_displacement = [=](double x, double y) {
    return Vector{strain.xx * x + strain.xy * y, strain.xy * x + strain.yy * y};
  };
  const PlateRecord r = run(plate, {6, 5}, 1000);
  const PlateSnapshot& s = r.snapshots.at(0);
  BOOST_TEST(largest(s.velocity) < 1e-12);  // the load moves a wave of 1e-2 m/s per 1e-4 of strain
  for (const double sigma : s.stress.component[1]) BOOST_TEST(sigma == stress.yy, tt::tolerance(1e-11));
  for (const double sigma : s.stress.component[2]) BOOST_TEST(sigma == stress.xy, tt::tolerance(1e-11));
}

// Between rollers, under traction on top, nothing depends on x: the plate is a chain of rows, written out here anew.
BOOST_DATA_TEST_CASE(a_column_between_rollers_is_a_chain, data::make(planes), plane) {
  Plate plate = plate_of(1, 2, plane);
  for (const Side side : {Side::left, Side::right, Side::bottom}) plate.edge(side).support = Edge::Support::roller;
  plate.edge(Side::top).normal_traction = [](double from, double to) { return 7 + 1000 * (from + to); };
  constexpr std::size_t n = 9;
  const long steps = 300;
  const double h = 2.0 / n, dt = 0.9 * fem::critical_time_step(plate, {4, n});
  const PlateRecord r = run(plate, {4, n}, steps_of(dt, steps));
  const PlateSnapshot& s = r.snapshots.at(0);

  // per unit of width; M of plane strain and plane stress written out
  const double M = plane == Plane::strain ? 1e4 * 0.7 / (1.3 * 0.4) : 1e4 / (1 - 0.09), G = 1e4 / 2.6;
  std::vector<double> u(n + 1), v(n + 1), c(n), w(n);
  for (long k = 0; k < steps; ++k) {
    std::vector<double> f(n + 1), g(n);
    for (std::size_t j = 0; j < n; ++j) {
      const double lower = M * 2 * (c[j] - u[j]) / h, upper = M * 2 * (u[j + 1] - c[j]) / h;
      const double beside = M * (u[j + 1] - u[j]) / h;  // of the two triangles at the sides: half of the area
      const double shear =
          G * h * (2 * c[j] - (u[j] + u[j + 1])) / (0.25 * 0.25);  // middles between columns of corners
      f[j] += lower / 2 + beside / 2 + shear / 2;
      f[j + 1] -= upper / 2 + beside / 2 - shear / 2;
      g[j] += upper / 2 - lower / 2 - shear;
    }
    const double t = static_cast<double>(k) * dt, from = k == 0 ? 0 : t - dt / 2, to = t + dt / 2;
    f[n] += 7 + 1000 * (from + to);
    for (std::size_t j = 1; j <= n; ++j) v[j] += (to - from) * f[j] / ((j == n ? 1 : 2) * h / 3);
    for (std::size_t j = 0; j < n; ++j) w[j] += (to - from) * g[j] / (h / 3);
    for (std::size_t j = 0; j <= n; ++j) u[j] += dt * v[j];
    for (std::size_t j = 0; j < n; ++j) c[j] += dt * w[j];
  }
  const double scale = *std::max_element(u.begin(), u.end());
  BOOST_TEST_REQUIRE(scale > 1e-4);
  for (std::size_t j = 0; j <= n; ++j) {
    for (std::size_t i = 0; i <= 4; ++i) {
      BOOST_TEST(std::abs(s.displacement.component[1][j * 5 + i] - u[j]) < 1e-12 * scale);
      BOOST_TEST(std::abs(s.displacement.component[0][j * 5 + i]) < 1e-12 * scale);
    }
  }
  for (std::size_t j = 0; j < n; ++j) {
    BOOST_TEST(std::abs(s.displacement.component[1][(n + 1) * 5 + j * 4] - c[j]) < 1e-12 * scale);
    BOOST_TEST(std::abs(s.velocity.component[1][(n + 1) * 5 + j * 4] - w[j]) < 1e-12 * 100 * scale);
  }
  books_close(r);
}

// Nothing but a translation: no stress at all. An infinitesimal rotation: none but round-off.
BOOST_AUTO_TEST_CASE(rigid_motion_gives_no_stress) {
  Plate moving = plate_of(1, 1.5);
  moving.initial_velocity = [](double, double) { return Vector{3, -0.7}; };
  const PlateRecord r = run(moving, {6, 9}, 500);
  BOOST_TEST(largest(r.snapshots.at(0).stress) == 0.0);
  for (const double v : r.snapshots[0].velocity.component[0]) BOOST_TEST(v == 3.0);
  BOOST_TEST(r.ledger.back().strain == 0.0);

  Plate turned = plate_of(1, 1.5);
  turned.initial_displacement = [](double x, double y) { return Vector{-0.1 * y, 0.1 * x}; };
  turned.initial_velocity = [](double x, double y) { return Vector{-0.1 * y, 0.1 * x}; };
  BOOST_TEST(largest(run(turned, {6, 9}, 500).snapshots.at(0).stress) < 1e-12 * 1e4);
}

BOOST_AUTO_TEST_CASE(no_load_gives_exactly_nothing) {
  Plate plate = plate_of(1, 1);
  plate.edge(Side::left).support = Edge::Support::roller;
  plate.edge(Side::bottom).support = Edge::Support::fixed;
  plate.edge(Side::top).support = Edge::Support::platen;
  plate.edge(Side::right).normal_traction = [](double, double) { return 0.0; };
  plate.body_force = [](double, double, double) { return Vector{}; };
  const PlateRecord r = run(plate, {5, 4}, 300);
  BOOST_TEST((r.outcome == Outcome::completed));
  const PlateSnapshot& s = r.snapshots.at(0);
  for (const PointField* f : {&s.displacement, &s.velocity, &s.stress}) BOOST_TEST(largest(*f) == 0.0);
  BOOST_TEST(r.sums.held == 0.0);
  BOOST_TEST(r.features == (std::vector<std::string>{"body-force", "elastic", "platen"}), tt::per_element());
}

BOOST_AUTO_TEST_CASE(body_force_accelerates_a_free_plate_rigidly) {
  Plate plate = plate_of(1, 1.5);
  plate.body_force = [](double, double, double t) { return Vector{10 * t, -2}; };
  const PlateRecord r = run(plate, {5, 6}, 200);
  const PlateSnapshot& s = r.snapshots.at(0);
  for (const double v : s.velocity.component[0]) {
    BOOST_TEST(v == 5 * s.velocity.time * s.velocity.time,
               tt::tolerance(1e-12));  // the middle of each kick is its mean
  }
  for (const double u : s.displacement.component[1]) BOOST_TEST(u == -s.time * s.time, tt::tolerance(1e-12));
  BOOST_TEST(r.features == (std::vector<std::string>{"body-force", "elastic"}), tt::per_element());
  books_close(r);
}

// ---- waves ----

struct Mode {
  bool roller;
  Plane plane;
  double nu;
};
std::ostream& operator<<(std::ostream& out, const Mode& m) {
  return out << (m.roller ? "roller" : "Lamé") << ' ' << (m.plane == Plane::strain ? "strain" : "stress") << ' '
             << m.nu;
}

/// L2 norm of the displacement's error after 1.3 periods, over that of the mode.
double mode_error(const Mode& mode, int n) {
  Plate plate = plate_of(1, 1, mode.plane, mode.nu);
  if (mode.roller) {
    for (const Side side : sides) plate.edge(side).support = Edge::Support::roller;
  }
  const double k = std::numbers::pi;
  const double speed = mode.roller ? elastic(plate).pressure_wave_speed() : elastic(plate).shear_wave_speed();
  const double omega = std::numbers::sqrt2 * k * speed;
  const auto shape = [=](double x, double y) {
    return mode.roller ? Vector{std::sin(k * x) * std::cos(k * y), std::cos(k * x) * std::sin(k * y)}
                       : Vector{std::cos(k * x) * std::sin(k * y), -std::sin(k * x) * std::cos(k * y)};
  };
  plate.initial_displacement = [=](double x, double y) { return Vector{1e-3 * shape(x, y)[0], 1e-3 * shape(x, y)[1]}; };
  const double end = 1.3 * 2 * std::numbers::pi / omega;
  const auto steps = static_cast<long>(std::ceil(end / (0.9 * fem::critical_time_step(plate, {n, n}))));
  const PlateRecord r = run(plate, {n, n}, steps_of(end / static_cast<double>(steps), steps, Books::off));
  const PointField& u = r.snapshots.at(0).displacement;
  double error = 0, norm = 0;
  for (std::size_t p = 0; p < u.x.size(); ++p) {
    const Vector exact = shape(u.x[p], u.y[p]);
    for (std::size_t c = 0; c < 2; ++c) {
      error += u.weight[p] * std::pow(u.component[c][p] - 1e-3 * exact[c] * std::cos(omega * end), 2);
      norm += u.weight[p] * std::pow(1e-3 * exact[c], 2);
    }
  }
  return std::sqrt(error / norm);
}

const std::vector<Mode> modes{{false, Plane::strain, 0.3},
                              {false, Plane::stress, 0.3},
                              {true, Plane::strain, 0.3},
                              {true, Plane::stress, 0.3},
                              {true, Plane::strain, 0.0}};

BOOST_DATA_TEST_CASE(standing_modes_are_of_second_order, data::make(modes), mode) {
  std::vector<double> errors;
  for (const int n : {8, 16, 32, 64}) errors.push_back(mode_error(mode, n));
  for (std::size_t k = 0; k + 1 < errors.size(); ++k) {
    const double order = std::log2(errors[k] / errors[k + 1]);
    BOOST_TEST(order > 1.85);
    BOOST_TEST(order < 2.2);
  }
  BOOST_TEST(errors.back() < 2e-3);
}

// Nearly incompressible: the isochoric mode still is found (crossed triangles do not lock).
BOOST_AUTO_TEST_CASE(nearly_incompressible) {
  const Mode mode{false, Plane::strain, 0.499};
  const double coarse = mode_error(mode, 8), fine = mode_error(mode, 16);
  BOOST_TEST(coarse < 0.1);
  BOOST_TEST(coarse / fine > 3.0);
}

// ---- stability ----

BOOST_AUTO_TEST_CASE(critical_time_step_of_square_cells) {
  for (const auto& [plane, expected, single] :
       {std::tuple{Plane::strain, 0.5785, 0.5533}, std::tuple{Plane::stress, 0.5688, 0.5469}}) {
    const Plate plate = plate_of(1, 1.5, plane);
    const double unit = 0.1 / elastic(plate).pressure_wave_speed();
    const double limit = fem::critical_time_step(plate, {10, 15}) / unit;
    BOOST_TEST(limit < expected);
    BOOST_TEST(limit > 0.999 * expected);
    BOOST_TEST(std::abs(fem::critical_time_step(plate_of(0.1, 0.1, plane), {1, 1}) / unit - single) < 5e-5);
  }
}

bool blows_up(const Plate& plate, const Cells& cells, double time_step, long steps) {
  const PlateRecord r = run(plate, cells, steps_of(time_step, steps, Books::off));
  return r.outcome != Outcome::completed || largest(r.snapshots.back().velocity) > 1e3;
}

struct Mesh {
  Cells cells;
  double width, height;
};
std::ostream& operator<<(std::ostream& out, const Mesh& m) { return out << m.cells.x << 'x' << m.cells.y; }
const std::vector<Mesh> meshes{{{10, 15}, 1, 1.5}, {{8, 8}, 1, 1},   {{1, 1}, 1, 1},  {{3, 2}, 1, 1},
                               {{1, 12}, 1, 12},   {{6, 6}, 1, 100}, {{9, 6}, 300, 1}};

// A free mesh shaken at every node is stable up to the limit, and not beyond: found by bisection.
BOOST_DATA_TEST_CASE(the_limit_is_that_of_a_free_mesh, data::make(meshes) * data::make(planes), mesh, plane) {
  Plate plate = plate_of(mesh.width, mesh.height, plane);
  plate.initial_velocity = shaken;
  const double limit = fem::critical_time_step(plate, mesh.cells);
  double stable = 0.9, unstable = 1.1;
  BOOST_TEST_REQUIRE(!blows_up(plate, mesh.cells, stable * limit, 3000));
  BOOST_TEST_REQUIRE(blows_up(plate, mesh.cells, unstable * limit, 3000));
  while (unstable - stable > 1e-4) {
    const double middle = (stable + unstable) / 2;
    (blows_up(plate, mesh.cells, middle * limit, 3000) ? unstable : stable) = middle;
  }
  BOOST_TEST(stable > 0.9998);  // a limit that lies too high would be seen here
  BOOST_TEST(unstable < 1.003);
}

BOOST_AUTO_TEST_CASE(an_unstable_run_is_detected_and_stopped) {
  Plate plate = plate_of(1, 1);
  plate.initial_velocity = shaken;
  const double limit = fem::critical_time_step(plate, {8, 8});
  const PlateRecord r = run(plate, {8, 8}, steps_of(1.02 * limit, 5000));
  BOOST_TEST((r.outcome == Outcome::unstable));
  BOOST_TEST(r.steps < 2000);
  BOOST_TEST((run(plate, {8, 8}, steps_of(3 * limit, 5000, Books::off)).outcome == Outcome::unstable));
}

// ---- books ----

// The leapfrog's own energy of a free plate does not drift at all.
BOOST_DATA_TEST_CASE(shadow_energy_stays, data::make(planes), plane) {
  Plate plate = plate_of(1, 1.2, plane);
  plate.initial_velocity = shaken;
  const PlateRecord r = run(plate, {9, 7}, 2500);
  const double start = r.ledger.front().kinetic + r.ledger.front().strain;
  double drift = 0, strain = 0;
  for (const LedgerLine& line : r.ledger) {
    drift = std::max(drift, std::abs(line.kinetic + line.strain - start));
    strain = std::max(strain, std::abs(line.strain));
  }
  BOOST_TEST(drift < 1e-12 * start);
  BOOST_TEST(strain > 0.01 * start);  // it is not all in one place
  BOOST_TEST(r.ledger.back().dissipated == 0.0);
  books_close(r);
}

BOOST_AUTO_TEST_CASE(books_close_with_every_load_and_support) {
  const PlateRecord r = run(busy_plate(1, 1.5), {6, 8}, 2500);
  books_close(r);
  BOOST_TEST(std::abs(r.ledger.back().work) > 1e-3 * r.ledger.back().kinetic);
  BOOST_TEST(r.features == (std::vector<std::string>{"body-force", "elastic", "platen"}), tt::per_element());
}

BOOST_AUTO_TEST_CASE(books_leave_the_bits_alone) {
  same_bits(run(busy_plate(1, 1.5), {6, 8}, 300, Books::lines), run(busy_plate(1, 1.5), {6, 8}, 300, Books::off));
}

BOOST_AUTO_TEST_CASE(times_points_and_work) {
  const Plate plate = busy_plate(2, 1);
  const PlateRecord r = run(plate, {4, 3}, steps_of(1e-4, 8));
  const PlateSnapshot& s = r.snapshots.at(0);
  BOOST_TEST(s.time == 8e-4, tt::tolerance(1e-14));
  BOOST_TEST(s.displacement.time == 8e-4, tt::tolerance(1e-14));
  BOOST_TEST(s.stress.time == 8e-4, tt::tolerance(1e-14));
  BOOST_TEST(s.velocity.time == 7.5e-4, tt::tolerance(1e-14));
  BOOST_TEST(r.ledger[0].time == 0.5e-4, tt::tolerance(1e-14));
  BOOST_TEST(r.work.element_steps == 8 * 48);
  BOOST_TEST(r.work.node_steps == 8 * (20 + 12));
  BOOST_TEST(s.volumetric_strain.size() == 12U);
  BOOST_TEST(s.crack_density.empty());
  for (const PointField* f : {&s.displacement, &s.velocity, &s.stress}) {
    double area = 0, x = 0, y = 0;
    for (std::size_t k = 0; k < f->x.size(); ++k) {
      area += f->weight[k];
      x += f->weight[k] * f->x[k];
      y += f->weight[k] * f->y[k];
    }
    BOOST_TEST(area == 2.0, tt::tolerance(1e-14));
    BOOST_TEST(x == 2.0, tt::tolerance(1e-14));
    BOOST_TEST(y == 1.0, tt::tolerance(1e-14));
  }
  BOOST_TEST(s.stress.x[0] == 0.25, tt::tolerance(1e-14));  // bottom triangle of the first cell
  BOOST_TEST(s.stress.y[0] == 1 / 18.0, tt::tolerance(1e-14));
  BOOST_TEST(s.stress.x[3] == 0.25 / 3, tt::tolerance(1e-14));  // left one
  BOOST_TEST(s.displacement.x[6] == 0.5);
  BOOST_TEST(s.displacement.weight[6] == 2.0 / 3 / 6, tt::tolerance(1e-14));
  BOOST_TEST(s.displacement.weight[0] == 2.0 / 12 / 6, tt::tolerance(1e-14));
  BOOST_TEST(s.displacement.x[20] == 0.25);  // the first middle
}

// ---- supports ----

// All of a platen's nodes go the same way, and what pulls it is the load: on a free plate momentum is load times time.
BOOST_AUTO_TEST_CASE(a_platen_moves_as_one) {
  Plate plate = plate_of(1, 1.5);
  plate.edge(Side::top).support = Edge::Support::platen;
  plate.edge(Side::top).normal_traction = [](double, double) { return 20.0; };
  plate.initial_velocity = [](double x, double y) { return Vector{0.1 * shaken(x, y)[0], 0}; };
  const PlateRecord r = run(plate, {7, 9}, 400);
  const PlateSnapshot& s = r.snapshots.at(0);
  for (std::size_t i = 0; i < 8; ++i) {
    BOOST_TEST(s.displacement.component[1][9 * 8 + i] == s.displacement.component[1][9 * 8]);
    BOOST_TEST(s.velocity.component[1][9 * 8 + i] == s.velocity.component[1][9 * 8]);
  }
  BOOST_TEST(s.displacement.component[0][9 * 8] != s.displacement.component[0][9 * 8 + 7]);  // free along it
  BOOST_TEST_REQUIRE(r.platen.size() == 400U);
  BOOST_TEST(r.platen.back() == s.displacement.component[1][9 * 8]);
  double momentum = 0;
  for (std::size_t k = 0; k < s.velocity.x.size(); ++k) momentum += s.velocity.weight[k] * s.velocity.component[1][k];
  BOOST_TEST(momentum == 20.0 * s.velocity.time, tt::tolerance(1e-12));
  books_close(r);
}

// Where the traction would move the side as one anyway, the platen changes nothing.
BOOST_AUTO_TEST_CASE(a_platen_on_a_column_changes_nothing) {
  Plate loose = plate_of(1, 2);
  for (const Side side : {Side::left, Side::right, Side::bottom}) loose.edge(side).support = Edge::Support::roller;
  loose.edge(Side::top).normal_traction = [](double, double) { return 7.0; };
  Plate pressed = loose;
  pressed.edge(Side::top).support = Edge::Support::platen;
  const PlateRecord a = run(loose, {5, 8}, 300), b = run(pressed, {5, 8}, 300);
  const auto &u = a.snapshots.at(0).displacement.component[1], &v = b.snapshots.at(0).displacement.component[1];
  for (std::size_t k = 0; k < u.size(); ++k) BOOST_TEST(std::abs(u[k] - v[k]) < 1e-14);
  BOOST_TEST(largest(a.snapshots[0].displacement) > 1e-4);
}

BOOST_AUTO_TEST_CASE(a_platen_leaves_out_what_the_other_side_holds) {
  Plate plate = plate_of(1, 1);
  plate.edge(Side::left).support = Edge::Support::fixed;
  plate.edge(Side::top).support = Edge::Support::platen;
  plate.edge(Side::top).normal_traction = [](double, double) { return 7.0; };
  const PlateRecord r = run(plate, {4, 4}, 100);
  const auto& u = r.snapshots.at(0).displacement.component[1];
  BOOST_TEST(u[20] == 0.0);
  BOOST_TEST(u[21] > 0.0);
  BOOST_TEST(u[21] == u[24]);
  books_close(r);
}

BOOST_AUTO_TEST_CASE(supports_hold) {
  Plate plate = busy_plate(1, 1);
  plate.edge(Side::left) = {};
  plate.edge(Side::left).support = Edge::Support::fixed;
  plate.edge(Side::top) = {};
  plate.edge(Side::top).support = Edge::Support::roller;
  const double dt = 1e-4;
  const PlateRecord r = run(plate, {4, 4}, steps_of(dt, 50));
  const PlateSnapshot& s = r.snapshots.at(0);
  const auto &u = s.displacement.component, &v = s.velocity.component;
  for (std::size_t j = 0; j <= 4; ++j) {
    BOOST_TEST(u[0][5 * j] == 0.0);
    BOOST_TEST(u[1][5 * j] == 0.0);
    BOOST_TEST(v[0][5 * j + 4] == 0.1 * std::cos(90 * 49.5 * dt));  // exactly what drives it, at its own time
  }
  for (std::size_t i = 1; i < 4; ++i) {
    BOOST_TEST(u[1][i] == 0.0);
    BOOST_TEST(u[0][i] != 0.0);
    BOOST_TEST(u[1][20 + i] == 0.0);
    BOOST_TEST(u[0][20 + i] != 0.0);
  }
  BOOST_TEST(v[1][14] == 0.1 * 0.5 * std::sin(40 * 49.5 * dt));
  BOOST_TEST(u[1][4] == 0.0);  // the corner is held by the rollers of the other side
  books_close(r);
}

// ---- bits ----

BOOST_DATA_TEST_CASE(any_number_of_threads_has_the_same_bits, data::make({2, 3, 7}), threads) {
  const Plate plate = busy_plate(1.5, 1);
  Stepping one = steps_of(0.9 * fem::critical_time_step(plate, {150, 5}), 200), more = one;
  more.threads = threads;
  const PlateRecord a = run(plate, {150, 5}, one), b = run(plate, {150, 5}, more);
  same_bits(a, b);
  BOOST_TEST(a.ledger.back().lost == b.ledger.back().lost);
  BOOST_TEST(a.ledger.back().strain == b.ledger.back().strain);
}

/// Values of a field of `row` points a row turned over: the first `rows` rows, then others.
std::vector<double> turned(const std::vector<double>& values, std::size_t nx, std::size_t ny, bool left_right) {
  std::vector<double> out;
  for (const bool middle : {false, true}) {
    const std::size_t across = nx + (middle ? 0 : 1), up = ny + (middle ? 0 : 1),
                      start = middle ? (nx + 1) * (ny + 1) : 0;
    for (std::size_t j = 0; j < up; ++j) {
      for (std::size_t i = 0; i < across; ++i) {
        out.push_back(values[start + (left_right ? j : up - 1 - j) * across + (left_right ? across - 1 - i : i)]);
      }
    }
  }
  return out;
}

/// The scene seen in a mirror. The plate's size is a power of two, so that W − x is exact.
Plate mirrored(const Plate& plate, bool left_right) {
  Plate other = plate;
  const Side from = left_right ? Side::left : Side::bottom, to = left_right ? Side::right : Side::top;
  std::swap(other.edge(from), other.edge(to));
  const auto at = [=, w = plate.width, h = plate.height](double x, double y) {
    return left_right ? Vector{w - x, y} : Vector{x, h - y};
  };
  const auto flip = [=](const Vector& v) { return left_right ? Vector{-v[0], v[1]} : Vector{v[0], -v[1]}; };
  for (const Side side : sides) {
    Edge& edge = other.edge(side);
    const bool upright = side == Side::left || side == Side::right;
    if (edge.shear_traction && upright != left_right) {
      edge.shear_traction = [f = edge.shear_traction](double a, double b) { return -f(a, b); };
    }
    if (edge.velocity) {
      edge.velocity = [=, f = edge.velocity](double x, double y, double t) {
        const Vector p = at(x, y);
        return flip(f(p[0], p[1], t));
      };
    }
  }
  if (plate.body_force) {
    other.body_force = [=, f = plate.body_force](double x, double y, double t) {
      const Vector p = at(x, y);
      return flip(f(p[0], p[1], t));
    };
  }
  other.initial_velocity = [=, f = plate.initial_velocity](double x, double y) {
    const Vector p = at(x, y);
    return flip(f(p[0], p[1]));
  };
  return other;
}

void has_mirrored_bits(const PlateRecord& a, const PlateRecord& b, std::size_t nx, std::size_t ny, bool left_right) {
  for (std::size_t c = 0; c < 2; ++c) {
    const double sign = (c == 0) == left_right ? -1 : 1;
    const auto& u = a.snapshots.at(0).displacement.component[c];
    const auto v = turned(b.snapshots.at(0).displacement.component[c], nx, ny, left_right);
    std::size_t different = 0;
    for (std::size_t k = 0; k < u.size(); ++k) different += u[k] != sign * v[k];
    BOOST_TEST(different == 0U);
    BOOST_TEST(largest(a.snapshots[0].displacement) > 0.0);
  }
}

BOOST_DATA_TEST_CASE(a_mirrored_scene_has_the_mirrored_bits, data::make({true, false}), left_right) {
  const Plate plate = busy_plate(1.25, 0.125);  // cells of 2⁻⁷ and 2⁻⁵, more of them than are looked at together
  const Plate other = mirrored(plate, left_right);
  const PlateRecord a = run(plate, {160, 4}, 300, Books::off), b = run(other, {160, 4}, 300, Books::off);
  has_mirrored_bits(a, b, 160, 4, left_right);
}

// Units of a power of two: the same digits.
BOOST_AUTO_TEST_CASE(powers_of_two_scale_exactly) {
  const auto scene = [](double stiffer, double denser, double longer, double stronger) {
    Plate plate = plate_of(longer, 1.5 * longer);
    plate.solid = solid::Elastic{material::PlaneElastic{1e4 * stiffer, 0.3, denser, Plane::strain}};
    plate.edge(Side::left).support = plate.edge(Side::bottom).support = Edge::Support::roller;
    plate.edge(Side::top).support = Edge::Support::platen;
    plate.edge(Side::top).normal_traction = [=](double, double) { return 7 * stronger; };
    return plate;
  };
  const double dt = 0.8 * fem::critical_time_step(scene(1, 1, 1, 1), {6, 9});
  // c' = c √(4/64) = c/4, h' = 8 h: Δt' = 32 Δt; u' = u (p'/E') 8 = 4 u
  const PlateRecord a = run(scene(1, 1, 1, 1), {6, 9}, steps_of(dt, 300));
  const PlateRecord b = run(scene(4, 64, 8, 2), {6, 9}, steps_of(32 * dt, 300));
  same_bits(a.snapshots.at(0).displacement, b.snapshots.at(0).displacement, {4, 4, 0});
  same_bits(a.snapshots.at(0).velocity, b.snapshots.at(0).velocity, {0.125, 0.125, 0});
  same_bits(a.snapshots.at(0).stress, b.snapshots.at(0).stress, {2, 2, 2});
}

// ---- damage ----

/// 1e21 1/s² of the paper's constants. Its speeds are thousands of metres a second.
material::TensileDamage rock() {
  material::TensileDamage damage;
  damage.elastic = {50e9, 0.3, 2500, Plane::strain};
  return damage;
}

/// All sides, and the inside at the start, move with a velocity gradient.
Plate stretched(Plate plate, const Tensor& rate) {
  const auto field = [rate](double x, double y) {
    return Vector{rate.xx * x + rate.xy * y, rate.xy * x + rate.yy * y};
  };
  for (const Side side : sides) {
    plate.edge(side) = {};
    plate.edge(side).support = Edge::Support::driven;
    plate.edge(side).velocity = [field](double x, double y, double) { return field(x, y); };
  }
  plate.initial_velocity = field;
  return plate;
}

void has_stress(const PlateSnapshot& s, const Tensor& stress, double tolerance) {
  const double scale = std::max({std::abs(stress.xx), std::abs(stress.yy), std::abs(stress.xy)});
  double off = 0;
  for (std::size_t k = 0; k < s.stress.x.size(); ++k) {
    off = std::max({off, std::abs(s.stress.component[0][k] - stress.xx), std::abs(s.stress.component[1][k] - stress.yy),
                    std::abs(s.stress.component[2][k] - stress.xy)});
  }
  BOOST_TEST(off < tolerance * scale);
}

// At a given rate of stretch the crack density and the stress are those of the strain at the same time (eqs. 23). One
// cell: of several, softening makes the round-off between them grow.
BOOST_AUTO_TEST_CASE(damage_is_that_of_the_strain_at_its_time) {
  const material::TensileDamage damage = rock();
  Plate plate;
  plate.width = 1;
  plate.height = 1.5;
  plate.solid = solid::Cracking{damage};
  const Tensor rate{60, 180, 40};
  plate = stretched(plate, rate);
  const double dt = 1e-6;
  Stepping stepping = steps_of(dt, 40);
  stepping.sample_after = {20, 35, 40};
  const PlateRecord r = fem::run(plate, {1, 1}, stepping);
  BOOST_TEST_REQUIRE(r.snapshots.size() == 3U);
  for (const PlateSnapshot& s : r.snapshots) {
    const Tensor strain = rate * s.time;
    const double mean = damage.volumetric(strain);
    const double crack_density = mean >= 0.002 ? damage.crack_density(mean, 100) : 0;
    for (const double C_d : s.crack_density) BOOST_TEST(C_d == crack_density, tt::tolerance(1e-10));
    for (const double e : s.volumetric_strain) BOOST_TEST(e == mean, tt::tolerance(1e-12));
    has_stress(s, damage.damaged_stiffness(crack_density).at(strain).stress(strain), 1e-10);
    BOOST_TEST(s.strain.size() == 1U);
  }
  BOOST_TEST(r.snapshots[0].crack_density[0] == 0.0);
  BOOST_TEST(r.snapshots[1].crack_density[0] > 0.0);
  BOOST_TEST(r.snapshots[2].crack_density[0] > 0.2);
  BOOST_TEST(r.features == std::vector<std::string>{"damage"}, tt::per_element());
  books_close(r);
  BOOST_TEST(r.ledger.back().dissipated > 0.0);
}

// A plate that starts strained starts with the cracks of these strains.
BOOST_AUTO_TEST_CASE(initial_strains_crack_the_plate_before_its_first_step) {
  const material::TensileDamage damage = rock();
  Plate plate;
  plate.width = plate.height = 1;
  plate.solid = solid::Cracking{damage};
  const Tensor strain{0.003, 0.0045, 0};
  plate.initial_displacement = [=](double x, double y) { return Vector{strain.xx * x, strain.yy * y}; };
  for (const Side side : sides) plate.edge(side).support = Edge::Support::fixed;
  const PlateRecord r = fem::run(plate, {1, 1}, steps_of(1e-6, 1));
  const double crack_density = damage.crack_density(damage.volumetric(strain), 100);
  BOOST_TEST_REQUIRE(crack_density > 0.02);
  const Tensor stress = damage.damaged_stiffness(crack_density).at(strain).stress(strain);
  BOOST_TEST(r.ledger.at(0).strain == stress.contract(strain) / 2, tt::tolerance(1e-12));
  BOOST_TEST(r.ledger[0].dissipated == 0.0);
}

// The cracked solid pressed: cracks are closed, K is the whole one's, G and the crack density stay.
BOOST_AUTO_TEST_CASE(cracks_close_in_compression) {
  const material::TensileDamage damage = rock();
  Plate plate;
  plate.width = plate.height = 1;
  plate.solid = solid::Cracking{damage};
  const Tensor rate{100, 150, 0};
  plate = stretched(plate, rate);
  const double dt = 1e-6;
  const auto factor = [dt](double t) { return t < 40 * dt ? 1.0 : -1.0; };
  for (const Side side : sides) {
    plate.edge(side).velocity = [=](double x, double y, double t) {
      return Vector{factor(t) * rate.xx * x, factor(t) * rate.yy * y};
    };
  }
  plate.body_force = [=](double x, double y, double t) {  // turns the inside about with the sides, in one kick
    const double a = std::abs(t - 40 * dt) < dt / 4 ? -2 / dt : 0;
    return Vector{a * rate.xx * x, a * rate.yy * y};
  };
  Stepping stepping = steps_of(dt, 120);
  stepping.sample_after = {40, 60, 120};
  const PlateRecord r = fem::run(plate, {1, 1}, stepping);
  BOOST_TEST_REQUIRE(r.snapshots.size() == 3U);
  const double cracked = damage.crack_density(damage.volumetric(rate * (40 * dt)), 100);
  const double shown = std::min(cracked, 9.0 / 16);
  BOOST_TEST_REQUIRE(shown > 0.1);
  for (const PlateSnapshot& s : r.snapshots) {
    for (const double C_d : s.crack_density) BOOST_TEST(C_d == shown, tt::tolerance(1e-9));
    const double now = s.time < 40.5 * dt ? s.time : 80 * dt - s.time;
    has_stress(s, damage.damaged_stiffness(shown).at(rate * now).stress(rate * now), 1e-8);
  }
  books_close(r, 1e-11);
}

// Damage that never begins leaves the bits of the elastic plate alone; so does plasticity that never begins.
BOOST_AUTO_TEST_CASE(what_does_not_happen_leaves_the_bits_alone) {
  Plate plain = busy_plate(1.5, 1);
  Plate whole = plain, strong = plain;
  material::TensileDamage damage;
  damage.elastic = elastic(plain);
  whole.solid = solid::Cracking{damage};
  compression(strong) = material::Compression{1e9, 1};
  const double dt = 0.9 * fem::critical_time_step(plain, {140, 4});
  std::get<solid::Cracking>(whole.solid).evolution.critical_strain = 1e9;
  const PlateRecord a = run(plain, {140, 4}, steps_of(dt, 200));
  const PlateRecord b = fem::run(whole, {140, 4}, steps_of(dt, 200));
  const PlateRecord c = run(strong, {140, 4}, steps_of(dt, 200));
  same_bits(a.snapshots.at(0).displacement, b.snapshots.at(0).displacement);
  same_bits(a.snapshots.at(0).stress, b.snapshots.at(0).stress);
  same_bits(a.snapshots.at(0).displacement, c.snapshots.at(0).displacement);
  BOOST_TEST(b.ledger.back().dissipated == 0.0);
  BOOST_TEST(c.ledger.back().dissipated == 0.0);
  BOOST_TEST(a.work.bytes < b.work.bytes);
  BOOST_TEST(a.work.bytes < c.work.bytes);
  BOOST_TEST(c.features == (std::vector<std::string>{"body-force", "compression-plasticity", "elastic", "platen"}),
             tt::per_element());
}

/// The paper's plate, smaller loads apart: pulled by a platen, rollers on x = 0 and y = 0.
Plate pulled_rock() {
  Plate plate;
  plate.width = 1;
  plate.height = 1.5;
  plate.solid = solid::Cracking{rock()};
  plate.edge(Side::left).support = plate.edge(Side::bottom).support = Edge::Support::roller;
  plate.edge(Side::top).support = Edge::Support::platen;
  plate.edge(Side::top).normal_traction = [](double from, double to) {  // 700 MPa in 50 µs
    return 7e8 * std::min(1.0, (from + to) / 2 / 50e-6);
  };
  return plate;
}

BOOST_AUTO_TEST_CASE(books_close_while_the_plate_cracks_and_for_any_number_of_threads) {
  Plate plate = pulled_rock();
  std::get<solid::Cracking>(plate.solid).evolution.diffusion.emplace();
  Stepping stepping = steps_of(0.9 * fem::critical_time_step(plate, {10, 15}), 55);
  const PlateRecord r = fem::run(plate, {10, 15}, stepping);
  books_close(r);
  const PlateSnapshot& s = r.snapshots.at(0);
  BOOST_TEST(s.crack_density[0] > 0.02);
  BOOST_TEST(s.crack_density[0] > s.crack_density.back());
  BOOST_TEST(s.concentration.size() == 11U * 16U);
  BOOST_TEST(r.ledger.back().dissipated > 0.0);
  BOOST_TEST(r.fed > 0.0);
  BOOST_TEST(r.features == (std::vector<std::string>{"damage", "diffusion", "platen"}), tt::per_element());
  stepping.threads = 3;
  const PlateRecord other = fem::run(plate, {10, 15}, stepping);
  same_bits(r, other);
  BOOST_TEST(r.ledger.back().dissipated == other.ledger.back().dissipated);
}

BOOST_AUTO_TEST_CASE(a_cracked_plate_has_mirrored_bits) {
  Plate plate = pulled_rock();
  plate.edge(Side::left) = {};
  plate.width = 1;
  plate.height = 2;
  plate.initial_velocity = [](double x, double y) { return Vector{2 * shaken(x, y)[0], 2 * shaken(x, y)[1]}; };
  const Plate other = mirrored(plate, true);
  const double dt = 0.9 * fem::critical_time_step(plate, {8, 16});
  const PlateRecord a = fem::run(plate, {8, 16}, steps_of(dt, 250));
  const PlateRecord b = fem::run(other, {8, 16}, steps_of(dt, 250));
  BOOST_TEST(*std::max_element(a.snapshots.at(0).crack_density.begin(), a.snapshots[0].crack_density.end()) > 0.0);
  has_mirrored_bits(a, b, 8, 16, true);
}

// ---- plasticity in compression ----

BOOST_AUTO_TEST_CASE(stress_of_a_plate_that_flows_is_the_points) {
  Plate plate = plate_of(1, 1);
  compression(plate) = material::Compression{50, 0.3};
  const Tensor rate{-2, -0.5, 0.7};
  plate = stretched(plate, rate);
  const double dt = 1e-4;
  const PlateRecord r = run(plate, {3, 2}, steps_of(dt, 300));
  material::PlasticStrain state;
  Tensor stress;
  for (int n = 1; n <= 300; ++n) {
    stress = compression(plate)->stress(elastic(plate), rate * (n * dt), state);
  }
  BOOST_TEST_REQUIRE(std::abs(state.xx) > 1e-3);
  has_stress(r.snapshots.at(0), stress, 1e-10);
  books_close(r);
  BOOST_TEST(r.ledger.back().dissipated > 0.1 * r.ledger.back().strain);
}

// Waves that flow in compression and crack in tension: nothing is lost, and heat only grows without cracks.
BOOST_AUTO_TEST_CASE(books_close_with_plasticity) {
  Plate plate = busy_plate(1, 1);
  compression(plate) = material::Compression{5, 0.2};
  const PlateRecord r = run(plate, {8, 8}, 1000);
  books_close(r);
  BOOST_TEST(r.ledger.back().dissipated > 0.0);
  double before = 0;
  bool falls = false;
  for (const LedgerLine& line : r.ledger) {
    falls = falls || line.dissipated < before;
    before = line.dissipated;
  }
  BOOST_TEST(!falls);

  Plate both = pulled_rock();
  compression(both) = material::Compression{1e8, 0.5};
  both.edge(Side::right).normal_traction = [](double, double) { return -3e8; };
  const double dt = 0.9 * fem::critical_time_step(both, {6, 9});
  const PlateRecord cracked = fem::run(both, {6, 9}, steps_of(dt, 300));
  books_close(cracked);
  BOOST_TEST(
      *std::max_element(cracked.snapshots.at(0).crack_density.begin(), cracked.snapshots[0].crack_density.end()) > 0);
  BOOST_TEST(cracked.features == (std::vector<std::string>{"compression-plasticity", "damage", "platen"}),
             tt::per_element());
}

// ---- refusals ----

BOOST_AUTO_TEST_CASE(what_does_not_act_or_cannot_be_is_refused) {
  const Stepping stepping = steps_of(1e-5, 1);
  const auto refused = [&](auto change) {
    Plate plate = plate_of(1, 1);
    change(plate);
    BOOST_CHECK_THROW(run(plate, {2, 2}, stepping), std::invalid_argument);
  };
  const auto push = [](double, double) { return 1.0; };
  refused([](Plate& p) {
    p.solid = solid::Elastic{material::PlaneElastic{1, 0.3, 1, Plane::stress}};
    compression(p).emplace();
  });
  refused([](Plate& p) { p.edge(Side::top).support = Edge::Support::driven; });
  refused([&](Plate& p) {
    p.edge(Side::top).support = Edge::Support::fixed;
    p.edge(Side::top).shear_traction = push;
  });
  refused([&](Plate& p) {
    p.edge(Side::top).support = Edge::Support::roller;
    p.edge(Side::top).normal_traction = push;
  });
  refused([&](Plate& p) {
    p.edge(Side::top).support = Edge::Support::platen;
    p.edge(Side::top).shear_traction = push;
  });
  refused([&](Plate& p) {
    p.edge(Side::top).support = Edge::Support::platen;
    p.initial_displacement = [](double x, double) { return Vector{0, x}; };
  });
  refused([](Plate& p) {
    material::TensileDamage damage = rock();
    damage.flaw_density = -1;
    p.solid = solid::Cracking{damage};
  });
  BOOST_CHECK_THROW(run(plate_of(1, 1), {0, 2}, stepping), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
