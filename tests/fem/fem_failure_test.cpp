// The failure wave, artificial viscosity, impact and gauges in the plate of finite elements.
#include <algorithm>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "fem/cell.hpp"
#include "fem/plate.hpp"
#include "hinge/material/failure_wave_law.hpp"
#include "hinge/step/viscous_step.hpp"
#include "tests/plate_records.hpp"

BOOST_AUTO_TEST_SUITE(fem_failure)

using namespace diptych;
using material::FailureWave;
using material::Plane;
using material::PlaneElastic;
using material::Tensor;
using material::Viscosity;
namespace tt = boost::test_tools;
namespace data = boost::unit_test::data;

namespace {

/// Soda-lime glass.
PlaneElastic glass() { return {72.8e9, 0.222, 2563, Plane::strain}; }

Viscosity york(double c1, double c2) {
  Viscosity v;
  v.c1 = c1;
  v.c2 = c2;
  return v;
}

/// Cells of this size, their lower and upper sides on rollers; a flyer of two fifths of the length.
Plate strip(const Cells& cells, double h, double velocity = 684) {
  Plate plate;
  plate.width = h * cells.x;
  plate.height = h * cells.y;
  plate.solid = solid::Failing{FailureWave{glass(), 2.75e9, 0.5}};
  plate.edge(Side::bottom).support = plate.edge(Side::top).support = Edge::Support::roller;
  if (velocity > 0) plate.impact = Impact{h * (2 * cells.x / 5), velocity, 0};
  return plate;
}
diffusion::Spread spread_from(int face) {
  diffusion::Spread spread;
  spread.face = face;
  return spread;
}

PlateRecord run(const Plate& plate, const Cells& cells, const Stepping& stepping,
                const std::optional<diffusion::Spread>& spread = std::nullopt) {
  Plate with = plate;
  if (spread) std::get<solid::Failing>(with.solid).spread = *spread;
  return fem::run(with, cells, stepping);
}

/// Something that no mesh and no side is made for, |v| ≤ 1.
Vector shaken(double x, double y) {
  const auto part = [](double z) { return z - std::floor(z); };
  return {2 * part(1234.5 * x + 777.7 * y + 99.9 * x * y) - 1, 2 * part(555.5 * x - 888.8 * y + 44.4 * x * x) - 1};
}

void same_bits(const PlateRecord& a, const PlateRecord& b) {
  const PlateSnapshot &s = a.snapshots.at(0), &t = b.snapshots.at(0);
  for (const auto field : {&PlateSnapshot::displacement, &PlateSnapshot::velocity, &PlateSnapshot::stress}) {
    const auto &one = (s.*field).component, &other = (t.*field).component;
    BOOST_TEST_REQUIRE(one.size() == other.size());
    for (std::size_t c = 0; c < one.size(); ++c) BOOST_TEST((one[c] == other[c]));
  }
  BOOST_TEST((s.volumetric_strain == t.volumetric_strain));
}

void books_close(const PlateRecord& r) {
  BOOST_TEST_REQUIRE((r.outcome == Outcome::completed));
  double pushed = 0;
  for (const LedgerLine& line : r.ledger) pushed = std::max(pushed, std::abs(line.momentum));
  BOOST_TEST(r.sums.held > 0.0);
  BOOST_TEST(r.sums.lost <= 1e-12 * r.sums.held);
  BOOST_TEST(r.sums.momentum <= 1e-12 * pushed);
}

/// Strain of the triangles of a cell, and their mean, from a snapshot.
struct Strains {
  fem::Triangles triangles;
  Tensor mean;
};
Strains strains_of(const PlateSnapshot& s, const Plate& plate, const Cells& cells, std::size_t cell) {
  const auto nx = static_cast<std::size_t>(cells.x), ny = static_cast<std::size_t>(cells.y);
  const std::size_t a = cell / nx * (nx + 1) + cell % nx, d = a + nx + 1;
  const auto& u = s.displacement.component;
  const auto at = [&](std::size_t k) { return Vector{u[0][k], u[1][k]}; };
  const fem::CellValues values{at(a), at(a + 1), at(d + 1), at(d), at((nx + 1) * (ny + 1) + cell)};
  const fem::CellSize h{plate.width / cells.x, plate.height / cells.y};
  return {fem::strains(values, h), fem::mean_strain(values, h)};
}

/// All sides held in a state of uniaxial compression.
Plate held(double strain, double f_max) {
  Plate plate;
  plate.width = plate.height = 1e-3;
  plate.solid = solid::Failing{FailureWave{glass(), 2.75e9, f_max}};
  plate.initial_displacement = [strain](double x, double) { return Vector{-strain * x, 0}; };
  for (const Side side : sides) plate.edge(side).support = Edge::Support::fixed;
  return plate;
}

}  // namespace

// ---- off ----

// No face to start from, nothing that may be converted, or never enough stress.
BOOST_DATA_TEST_CASE(a_wave_that_does_not_start_leaves_the_whole_solids_bits,
                     data::make({0, 1, 2}) * data::make({0, 1}), why, viscous) {
  const Cells cells{40, 2};
  Plate plate = strip(cells, 1e-4);
  if (viscous) plate.viscosity = york(0.2, 0.2);
  plate.gauges = {{2.2e-3, 1e-4}};
  Plate whole = plate;
  whole.solid = solid::Elastic{glass()};
  diffusion::Spread spread = spread_from(16);
  FailureWave wave{glass(), 2.75e9, 0.5};
  if (why == 0) spread.face.reset();
  if (why == 1) wave.most_converted = 0;
  if (why == 2) wave.threshold = 9e9;
  plate.solid = solid::Failing{wave};
  const Stepping stepping = steps_of(0.4 * fem::critical_time_step(whole, cells), 150);
  const PlateRecord a = run(whole, cells, stepping), b = run(plate, cells, stepping, spread);
  same_bits(a, b);
  BOOST_TEST((a.gauges.at(0).xx == b.gauges.at(0).xx));
  BOOST_TEST(largest(a.gauges.at(0).xx) > 4e9);
  BOOST_TEST(a.gauges[0].dilatancy.empty());
  BOOST_TEST(b.gauges[0].dilatancy == std::vector<double>(150, 0.0), tt::per_element());
  BOOST_TEST(a.snapshots[0].dilatancy.empty());
  BOOST_TEST(b.fed == 0.0);
  BOOST_TEST(a.sums.lost <= 1e-12 * a.sums.held);
  BOOST_TEST(b.sums.lost <= 1e-12 * b.sums.held);
  BOOST_TEST(std::abs(b.sums.last.dissipated) <= 1e-14 * b.sums.held);
  std::vector<std::string> features{"elastic", "impact"}, of_wave{"diffusion", "failure-wave", "impact"};
  if (viscous) features.push_back("viscosity"), of_wave.push_back("viscosity");
  BOOST_TEST(a.features == features, tt::per_element());
  BOOST_TEST(b.features == of_wave, tt::per_element());
}

BOOST_AUTO_TEST_CASE(what_is_not_asked_for_takes_no_memory) {
  const Cells cells{40, 2};
  Plate plate = strip(cells, 1e-4);
  plate.solid = solid::Elastic{glass()};
  const Stepping stepping = steps_of(1e-9, 4, Books::off);
  const std::size_t bare = run(plate, cells, stepping).work.bytes;
  plate.gauges = {{1e-3, 1e-4}};
  const std::size_t with_gauge = run(plate, cells, stepping).work.bytes;
  BOOST_TEST(with_gauge == bare + 3 * 4 * sizeof(double));
  plate.viscosity = york(1, 1);
  BOOST_TEST(run(plate, cells, stepping).work.bytes > with_gauge + 80 * 4 * sizeof(double));
  // 2 × (corners and middles) × (u and v), the rest is of the sides
  BOOST_TEST(bare < 2 * 2 * (41 * 3 + 80) * sizeof(double) + 88 * 160U + 16384U);
}

// ---- the failure wave ----

// The table of the reconstruction's fact sheet: at f = ½ the longitudinal stress is 0.9685, the lateral one 1.622 of
// the whole solid's, V_d/ε = 0.2061. At rest nothing is lost or gained on the way there.
BOOST_AUTO_TEST_CASE(a_cell_that_fails_at_fixed_strain) {
  const double strain = 0.06, dt = 1e-8;
  diffusion::Spread spread = spread_from(0);
  spread.profile = diffusion::Profile::constant;
  const Plate plate = held(strain, 0.5);
  const Stepping stepping = steps_of(dt, 400);
  const PlateRecord r = run(plate, {1, 1}, stepping, spread);
  const material::Stiffness whole = glass().stiffness();
  const PlateSnapshot& s = r.snapshots.at(0);
  BOOST_TEST(s.dilatancy.at(0) / strain == 0.2061, tt::tolerance(1e-3));
  BOOST_TEST(s.concentration.size() == 4U);
  for (const double v : s.concentration) BOOST_TEST(v == s.dilatancy[0], tt::tolerance(1e-9));
  for (const double xx : s.stress.component[0])
    BOOST_TEST(-xx / (whole.normal * strain) == 0.9685, tt::tolerance(2e-4));
  for (const double yy : s.stress.component[1]) BOOST_TEST(-yy / (whole.cross * strain) == 1.622, tt::tolerance(1e-3));
  // By the wave's formulae, from K, G and ε alone.
  const double K = 72.8e9 / (3 * (1 - 2 * 0.222)), G = 72.8e9 / (2 * 1.222), V = s.dilatancy[0];
  const double f = V * (2 * K * strain + K * V) / (4.0 / 3 * G * strain * strain), p = K * (strain + V);
  for (const double xx : s.stress.component[0])
    BOOST_TEST(xx == -p - std::sqrt(1 - f) * 4.0 / 3 * G * strain, tt::tolerance(1e-12));
  for (const double yy : s.stress.component[1])
    BOOST_TEST(yy == -p + std::sqrt(1 - f) * 2.0 / 3 * G * strain, tt::tolerance(1e-12));
  const double stored = whole.normal * strain * strain / 2 * 1e-6;
  for (const LedgerLine& line : r.ledger) {
    BOOST_TEST(line.strain == stored, tt::tolerance(1e-13));
    BOOST_TEST(line.kinetic <= 1e-20 * stored);
    BOOST_TEST(std::abs(line.dissipated) <= 1e-13 * stored);
  }
  BOOST_TEST(r.ledger.size() == 400U);
  BOOST_TEST(r.fed == V * 1e-6, tt::tolerance(1e-9));
  BOOST_TEST(r.features == (std::vector<std::string>{"diffusion", "failure-wave"}), tt::per_element());
}

// Step by step: the dilatancy is what the mean strains of the cells at its own time make of it, and the stress of each
// triangle what its own strain and its cell's dilatancy make of it.
BOOST_DATA_TEST_CASE(a_run_does_what_its_parts_say, data::make({0, 1}), viscous) {
  const Cells cells{20, 3};
  Plate plate = strip(cells, 1e-4);
  plate.edge(Side::top).support = Edge::Support::free;
  if (viscous) plate.viscosity = york(0.2, 0.2);
  Stepping stepping = steps_of(0.9 * fem::critical_time_step(plate, cells), 60);
  stepping.sample_after.clear();
  for (long n = 1; n <= stepping.steps; ++n) stepping.sample_after.push_back(n);
  diffusion::Spread spread = spread_from(8);
  spread.start.assign(21 * 4, 0);  // a little of it, far ahead
  spread.start[18] = spread.start[39] = 1e-6;
  const PlateRecord r = run(plate, cells, stepping, spread);
  const FailureWave wave = std::get<solid::Failing>(plate.solid).law;
  diffusion::Dilatancy dilatancy(spread, {cells.x, cells.y, plate.width / cells.x, plate.height / cells.y});
  std::size_t failed = 0, whole = 0, sheared = 0;
  for (const PlateSnapshot& s : r.snapshots) {
    std::vector<double> ceiling(60);
    for (std::size_t cell = 0; cell < 60; ++cell) {
      const Tensor mean = strains_of(s, plate, cells, cell).mean;
      if (wave.equivalent_stress(mean) > wave.threshold) ceiling[cell] = wave.ceiling(mean);
    }
    dilatancy.advance(ceiling, stepping.time_step);
    std::size_t wrong = 0;
    for (std::size_t cell = 0; cell < 60; ++cell) {
      const double V = dilatancy.of_cells()[cell];
      const fem::Triangles strain = strains_of(s, plate, cells, cell).triangles;
      wrong += s.dilatancy[cell] != V;
      for (std::size_t t = 0; t < 4; ++t) {
        const Tensor by_hand = V == 0 ? glass().stiffness().stress(strain[t]) : wave.stress(strain[t], V);
        const auto& stress = s.stress.component;
        wrong += stress[0][4 * cell + t] != by_hand.xx || stress[1][4 * cell + t] != by_hand.yy ||
                 stress[2][4 * cell + t] != by_hand.xy;
        sheared += by_hand.xy != 0;
      }
      (V == 0 ? whole : failed) += 1;
    }
    BOOST_TEST(wrong == 0U);
    BOOST_TEST((s.concentration == std::vector<double>(dilatancy.of_nodes().begin(), dilatancy.of_nodes().end())));
  }
  BOOST_TEST(std::min({failed, whole, sheared}) > 100U);
  BOOST_TEST(r.fed == dilatancy.fed());
}

// Books of a wave that shears, fails, is resisted and let go at the free sides.
BOOST_AUTO_TEST_CASE(books_close_with_everything_on) {
  const Cells cells{60, 5};
  Plate plate = strip(cells, 1e-4);
  plate.edge(Side::top).support = Edge::Support::free;
  plate.viscosity = york(0.2, 0.2);
  const double dt = 0.9 * fem::critical_time_step(plate, cells);
  const PlateRecord r = run(plate, cells, steps_of(dt, 600), spread_from(24));
  books_close(r);
  BOOST_TEST(r.sums.last.viscous > 1e-3 * r.sums.held);
  BOOST_TEST(std::abs(r.sums.last.dissipated) > 1e-6 * r.sums.held);
  BOOST_TEST(largest(r.snapshots.at(0).dilatancy) > 0.005);
  BOOST_TEST(largest(r.snapshots[0].displacement.component[1]) > 1e-5);
  BOOST_TEST(r.features == (std::vector<std::string>{"diffusion", "failure-wave", "impact", "viscosity"}),
             tt::per_element());
  PlateRecord off = run(plate, cells, steps_of(dt, 600, Books::off), spread_from(24));
  same_bits(r, off);
}

BOOST_AUTO_TEST_CASE(any_number_of_threads_has_the_same_bits) {
  const Cells cells{150, 5};  // more than are looked at together
  Plate plate = strip(cells, 1e-4);
  plate.edge(Side::top).support = Edge::Support::free;
  plate.viscosity = york(0.2, 0.3);
  plate.gauges = {{6.3e-3, 2.2e-4}, {5e-3, 5e-4}};
  Stepping one = steps_of(0.9 * fem::critical_time_step(plate, cells), 300), more = one;
  more.threads = 3;
  const PlateRecord a = run(plate, cells, one, spread_from(60)), b = run(plate, cells, more, spread_from(60));
  same_bits(a, b);
  BOOST_TEST((a.snapshots[0].dilatancy == b.snapshots[0].dilatancy));
  for (const std::size_t k : {0, 1}) {
    BOOST_TEST((a.gauges.at(k).xx == b.gauges.at(k).xx));
    BOOST_TEST((a.gauges[k].yy == b.gauges[k].yy));
    BOOST_TEST((a.gauges[k].dilatancy == b.gauges[k].dilatancy));
    BOOST_TEST(largest(a.gauges[k].dilatancy) > 0.0);
  }
  for (std::size_t n = 0; n < a.ledger.size(); ++n) {
    BOOST_TEST_REQUIRE(a.ledger[n].viscous == b.ledger[n].viscous);
    BOOST_TEST_REQUIRE(a.ledger[n].dissipated == b.ledger[n].dissipated);
    BOOST_TEST_REQUIRE(a.ledger[n].strain == b.ledger[n].strain);
  }
}

/// Values of nodes, corners and then middles, or of cells alone, turned over.
std::vector<double> turned(const std::vector<double>& values, const Cells& cells, bool left_right) {
  const auto nx = static_cast<std::size_t>(cells.x), ny = static_cast<std::size_t>(cells.y);
  const std::size_t corners = values.size() == nx * ny ? 0 : (nx + 1) * (ny + 1);
  std::vector<double> out;
  const auto turn = [&](std::size_t start, std::size_t across, std::size_t up) {
    for (std::size_t j = 0; j < up; ++j) {
      for (std::size_t i = 0; i < across; ++i)
        out.push_back(values[start + (left_right ? j : up - 1 - j) * across + (left_right ? across - 1 - i : i)]);
    }
  };
  if (corners > 0) turn(0, nx + 1, ny + 1);
  if (values.size() != corners) turn(corners, nx, ny);
  return out;
}

// Two halves that close in on each other, shaken as well, and the same seen in a mirror.
BOOST_DATA_TEST_CASE(a_mirrored_scene_has_the_mirrored_bits, data::make({true, false}), left_right) {
  const Cells cells{32, 4};
  Plate plate = strip(cells, 1.0 / 8192, 0);  // W − x is exact
  const double w = plate.width, h = plate.height;
  plate.viscosity = york(0.2, 0.2);
  plate.edge(left_right ? Side::bottom : Side::left).support = Edge::Support::free;
  plate.edge(left_right ? Side::top : Side::right).support = Edge::Support::free;
  plate.initial_velocity = [=](double x, double y) {
    const Vector s = shaken(40 * x, 70 * y);
    return Vector{(x < w / 2 ? 400 : x > w / 2 ? -400 : 0) + 30 * s[0], 30 * s[1]};
  };
  plate.gauges = {{w / 2, h / 8}, {w / 2 + w / 256, h / 8}, {w / 4, 3 * h / 8}};
  Plate other = plate;
  other.initial_velocity = [=, f = plate.initial_velocity](double x, double y) {
    const Vector v = left_right ? f(w - x, y) : f(x, h - y);
    return left_right ? Vector{-v[0], v[1]} : Vector{v[0], -v[1]};
  };
  for (Gauge& g : other.gauges) g = left_right ? Gauge{w - g.x, g.y} : Gauge{g.x, h - g.y};
  const Stepping stepping = steps_of(0.9 * fem::critical_time_step(plate, cells), 200);
  const PlateRecord a = run(plate, cells, stepping, spread_from(16)), b = run(other, cells, stepping, spread_from(16));
  for (const std::size_t c : {0, 1}) {
    auto u = turned(b.snapshots.at(0).displacement.component[c], cells, left_right);
    for (double& value : u) value *= (c == 0) == left_right ? -1 : 1;
    BOOST_TEST((a.snapshots.at(0).displacement.component[c] == u));
  }
  BOOST_TEST((a.snapshots[0].dilatancy == turned(b.snapshots[0].dilatancy, cells, left_right)));
  BOOST_TEST((a.snapshots[0].concentration == turned(b.snapshots[0].concentration, cells, left_right)));
  BOOST_TEST(largest(a.snapshots[0].dilatancy) > 0.001);
  for (const std::size_t k : {0, 1, 2}) {
    BOOST_TEST((a.gauges.at(k).xx == b.gauges.at(k).xx));
    BOOST_TEST((a.gauges[k].yy == b.gauges[k].yy));
    BOOST_TEST((a.gauges[k].dilatancy == b.gauges[k].dilatancy));
  }
  BOOST_TEST(largest(a.gauges[0].dilatancy) > 0.001);
}

BOOST_AUTO_TEST_CASE(a_strip_stays_alike_across) {
  const Cells cells{60, 4};
  Plate plate = strip(cells, 1e-4);
  plate.viscosity = york(0.2, 0.2);
  const PlateRecord r = run(plate, cells, steps_of(0.9 * fem::critical_time_step(plate, cells), 400), spread_from(24));
  const PlateSnapshot& s = r.snapshots.at(0);
  const double most = largest(s.displacement.component[0]);
  BOOST_TEST(largest(s.displacement.component[1]) <= 1e-12 * most);
  double off = 0;
  for (std::size_t k = 61; k < 61 * 5; ++k)
    off = std::max(off, std::abs(s.displacement.component[0][k] - s.displacement.component[0][k % 61]));
  BOOST_TEST(off <= 1e-12 * most);
  for (std::size_t k = 60; k < 240; ++k)
    BOOST_TEST(std::abs(s.dilatancy[k] - s.dilatancy[k % 60]) <= 1e-12 * largest(s.dilatancy));
  BOOST_TEST(largest(s.dilatancy) > 0.005);
  // of one row of cells nothing moves across at all
  Plate row = strip({60, 1}, 1e-4);
  const PlateRecord one = run(row, {60, 1}, steps_of(5e-9, 300), spread_from(24));
  for (const double v : one.snapshots.at(0).displacement.component[1]) BOOST_TEST(v == 0.0);
}

BOOST_AUTO_TEST_CASE(a_run_that_blows_up_says_so) {
  const Cells cells{40, 2};
  Plate plate = strip(cells, 1e-4);
  const double dt = 3 * fem::critical_time_step(plate, cells);
  const PlateRecord r = run(plate, cells, steps_of(dt, 600, Books::off), spread_from(16));
  BOOST_TEST((r.outcome == Outcome::unstable));
}

// ---- impact ----

BOOST_AUTO_TEST_CASE(a_flyer_brings_its_momentum) {
  const Cells cells{30, 3};
  Plate plate = strip(cells, 1e-4, 500);
  plate.impact->face = 0.7e-3;
  plate.edge(Side::bottom).support = Edge::Support::free;
  plate.edge(Side::top).support = Edge::Support::free;
  const double momentum = 2563 * 0.7e-3 * 3e-4 * 500;
  const PlateRecord r = run(plate, cells, steps_of(1e-9, 200), spread_from(7));
  BOOST_TEST(r.ledger.front().impulse * std::sqrt(2) == momentum, tt::tolerance(1e-14));
  BOOST_TEST(r.ledger.front().momentum * std::sqrt(2) == momentum, tt::tolerance(1e-14));
  books_close(r);
  // The first kick finds no stress.
  const PlateSnapshot first = run(plate, cells, steps_of(1e-9, 1), spread_from(7)).snapshots.at(0);
  for (std::size_t k = 0; k < first.velocity.x.size(); ++k) {
    const double cells_from_face = first.velocity.x[k] / 1e-4 - 7;
    const double expected = std::abs(cells_from_face) < 1e-6 ? 250 : cells_from_face < 0 ? 500 : 0;
    BOOST_TEST(first.velocity.component[0][k] == expected);
    BOOST_TEST(first.velocity.component[1][k] == 0.0);
  }
  // FEM has no contact: a gap is none of its business
  Plate apart = plate;
  apart.impact->gap = 1e-3;
  same_bits(r, run(apart, cells, steps_of(1e-9, 200), spread_from(7)));
}

// ½ ρ c_d v on both sides of the face, the lateral stress ν/(1 − ν) of it.
BOOST_AUTO_TEST_CASE(the_plateau_of_an_elastic_impact) {
  const Cells cells{200, 1};
  Plate plate = strip(cells, 1e-4);
  plate.solid = solid::Elastic{glass()};
  plate.viscosity = york(0.2, 0.2);
  plate.gauges = {{9e-3, 5e-5}, {7e-3, 5e-5}};
  const double dt = 0.9 * fem::critical_time_step(plate, cells);
  const PlateRecord r = run(plate, cells, steps_of(dt, std::lround(0.8e-6 / dt), Books::off));
  const double plateau = 2563 * glass().pressure_wave_speed() * 684 / 2;
  for (const GaugeRecord& g : r.gauges) {
    BOOST_TEST(g.xx.back() == -plateau, tt::tolerance(0.005));
    BOOST_TEST(g.yy.back() == -plateau * 0.222 / (1 - 0.222), tt::tolerance(0.005));
    const auto half = std::find_if(g.xx.begin(), g.xx.end(), [&](double s) { return s < -plateau / 2; });
    BOOST_TEST(g.time[static_cast<std::size_t>(half - g.xx.begin())] == 1e-3 / glass().pressure_wave_speed(),
               tt::tolerance(0.05));
  }
}

// ---- viscosity ----

// A cell of length 1 whose sides close in by D = −2. After the first step σ = M D Δt, and q = ρ λ c_d g √(h_x h_y) D
// (c₁ + c₂); the second kick takes Δt ½ (σ + q) h_y from a corner of mass ρ h_y/6. The books: q does half of its work
// on the strain that made it and half on the next.
BOOST_AUTO_TEST_CASE(two_steps_of_one_cell_by_hand) {
  Plate plate;
  plate.width = 1;
  plate.height = 0.25;
  plate.solid = solid::Elastic{PlaneElastic{1e4, 0.3, 2, Plane::strain}};
  plate.viscosity = Viscosity{Viscosity::Form::york, 0.5, 2, 0.75, 1.25};
  plate.initial_velocity = [](double x, double) { return Vector{1 - 2 * x, 0}; };
  plate.edge(Side::bottom).support = plate.edge(Side::top).support = Edge::Support::roller;
  const double dt = 1e-4, M = elastic(plate).stiffness().normal, c = std::sqrt(M / 2), sigma = M * -2 * dt;
  const double q = 2 * 0.75 * c * 1.25 * 0.5 * -2 * 2.5;
  const PlateRecord r = run(plate, {1, 1}, steps_of(dt, 2));
  const auto& v = r.snapshots.at(0).velocity.component[0];
  const double now = 1 + dt * 3 * (sigma + q) / 2;
  for (const std::size_t k : {0, 2}) BOOST_TEST(v[k] == now, tt::tolerance(1e-14));
  for (const std::size_t k : {1, 3}) BOOST_TEST(v[k] == -now, tt::tolerance(1e-14));
  BOOST_TEST(v[4] == 0.0);
  // The third kick has a q of now, the largest |D| being one of now as well.
  const double last = now + dt * 3 * (sigma * (1 + now) + q * now) / 2;
  BOOST_TEST(run(plate, {1, 1}, steps_of(dt, 3)).snapshots.at(0).velocity.component[0][0] == last,
             tt::tolerance(1e-14));
  // Snapshots are without q. The middle stayed, and the mean of the triangles is that of the cell.
  double mean = 0;
  for (const double s : r.snapshots[0].stress.component[0]) mean += s / 4;
  BOOST_TEST(mean == sigma - 2 * now * dt * M, tt::tolerance(1e-13));
  BOOST_TEST(r.ledger.at(0).viscous == 0.0);
  BOOST_TEST(r.ledger.at(1).viscous == 0.25 * q * dt * (-2 - 2 * now) / 2, tt::tolerance(1e-13));
  BOOST_TEST(r.sums.lost <= 1e-14 * r.sums.held);
  BOOST_TEST(r.features == (std::vector<std::string>{"elastic", "viscosity"}), tt::per_element());
  // drawn apart it feels nothing, unless it is asked to
  plate.initial_velocity = [](double x, double) { return Vector{2 * x - 1, 0}; };
  Plate without = plate;
  without.viscosity.reset();
  const PlateRecord a = run(plate, {1, 1}, steps_of(dt, 2)), b = run(without, {1, 1}, steps_of(dt, 2));
  same_bits(a, b);
  BOOST_TEST(a.features == std::vector<std::string>{"elastic"}, tt::per_element());
  plate.viscosity->always = true;
  for (const std::size_t k : {0, 2})
    BOOST_TEST(run(plate, {1, 1}, steps_of(dt, 2)).snapshots.at(0).velocity.component[0][k] == -now,
               tt::tolerance(1e-14));
}

// c₂ counts by the largest |D| of all triangles: a slow part beside a fast one.
BOOST_AUTO_TEST_CASE(the_quadratic_part_is_relative_to_the_fastest) {
  Plate plate;
  plate.width = plate.height = 4;
  plate.solid = solid::Elastic{PlaneElastic{1e4, 0.3, 2, Plane::strain}};
  plate.viscosity = Viscosity{Viscosity::Form::york, 0, 2, 0.75, 1.25};
  // From below y = 1 to above y = 2 nothing moves; D = −1 below and −4 above.
  plate.initial_velocity = [](double x, double y) { return Vector{y <= 1 ? -x : y >= 3 ? -4 * x : 0, 0}; };
  const double dt = 1e-4, M = elastic(plate).stiffness().normal, c = std::sqrt(M / 2);
  for (const bool fast : {true, false}) {
    Plate p = plate;
    if (!fast)
      p.initial_velocity = [f = plate.initial_velocity](double x, double y) { return y <= 1 ? f(x, y) : Vector{}; };
    const double before = p.initial_velocity(4, 0)[0];
    Plate without = p;
    without.viscosity.reset();
    const auto velocity = [&](const Plate& of) {
      return run(of, {1, 4}, steps_of(dt, 2)).snapshots.at(0).velocity.component[0][1];
    };
    BOOST_TEST(before == -4.0);
    // The lower right corner has the bottom and the right triangle of the lowest cell: D = −1 in both.
    const double q = 2 * 0.75 * c * 1.25 * 2 * -1 * 2 * (fast ? 0.25 : 1.0);  // √(4 · 1) = 2
    const double kick = -dt * (1.0 / 2) * q / (2.0 * 4 * 1 / 6);
    BOOST_TEST(velocity(p) - velocity(without) == kick, tt::tolerance(1e-9));
  }
}

BOOST_AUTO_TEST_CASE(viscosity_is_refused_beside_damage_and_plasticity) {
  Plate plate;
  plate.width = plate.height = 1;
  material::TensileDamage rock;
  rock.elastic = {50e9, 0.3, 2500, Plane::strain};
  plate.viscosity = york(0.2, 0.2);
  plate.solid = solid::Cracking{rock};
  BOOST_CHECK_THROW(run(plate, {2, 2}, steps_of(1e-6, 1)), std::invalid_argument);
  plate.solid = solid::Elastic{rock.elastic, material::Compression{5e7, 0.3}};
  BOOST_CHECK_THROW(run(plate, {2, 2}, steps_of(1e-6, 1)), std::invalid_argument);
}

// Where nothing else limits it, √(h_x h_y) is the length and plane stress has its own c_d.
BOOST_AUTO_TEST_CASE(the_time_step_that_viscosity_leaves_in_closed_form) {
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    const PlaneElastic solid{72.8e9, 0.222, 2563, plane};
    const double M = solid.stiffness().normal, A = 1e-4;
    const auto limit = [&](const PlaneElastic& s) { return A / s.pressure_wave_speed(); };
    for (const double viscosity : {1e-6, 1.0, 300.0, 1e3, 1e4}) {
      // Δt² (M + 2ρν/Δt) = ρ A²
      const double exact = A * A * 2563 / (viscosity + std::sqrt(viscosity * viscosity + M * A * A * 2563));
      const double found = material::viscous_time_step(solid, viscosity, limit);
      BOOST_TEST(found == exact, tt::tolerance(3e-12));
      BOOST_TEST(found <= exact);
    }
    BOOST_TEST(material::viscous_time_step(solid, 0, limit) == limit(solid));
    BOOST_TEST(std::isnan(material::viscous_time_step(solid, std::nan(""), limit)));
    const material::Stiffness before = solid.stiffness(), after = material::stiffened(solid, 5e11).stiffness();
    BOOST_TEST(after.shear == before.shear, tt::tolerance(1e-13));
    BOOST_TEST(after.cross == before.cross + 5e11, tt::tolerance(1e-13));
    BOOST_TEST(after.normal == before.normal + 5e11, tt::tolerance(1e-13));
  }
}

struct Mesh {
  Cells cells;
  double width, height, c1;
};
std::ostream& operator<<(std::ostream& out, const Mesh& m) {
  return out << m.cells.x << 'x' << m.cells.y << ", c1 = " << m.c1;
}

// A free mesh that is shaken at every node, where expansion is resisted as well: linear theory is exact.
BOOST_DATA_TEST_CASE(the_limit_with_viscosity_is_that_of_a_free_mesh,
                     data::make(std::vector<Mesh>{{{8, 8}, 1, 1, 0.2}, {{3, 2}, 1, 1, 1}, {{10, 15}, 1, 3, 1}}) *
                         data::make({true, false}),
                     mesh, in_strain) {
  Plate plate;
  plate.width = mesh.width;
  plate.height = mesh.height;
  plate.solid = solid::Elastic{PlaneElastic{1e4, 0.3, 1, in_strain ? Plane::strain : Plane::stress}};
  const double without = fem::critical_time_step(plate, mesh.cells);
  plate.viscosity = york(mesh.c1, 0);
  plate.viscosity->always = true;
  plate.initial_velocity = shaken;
  const double limit = fem::critical_time_step(plate, mesh.cells);
  BOOST_TEST(limit < 0.9 * without);
  const auto blows_up = [&](double dt) {
    const PlateRecord r = run(plate, mesh.cells, steps_of(dt, 4000, Books::off));
    return r.outcome != Outcome::completed || largest(r.snapshots.back().velocity.component[0]) > 1e3;
  };
  BOOST_TEST(!blows_up(0.99 * limit));
  BOOST_TEST(blows_up(1.01 * limit));
}

// c₂ counts in full where |D| is largest.
BOOST_AUTO_TEST_CASE(the_limit_counts_both_constants) {
  const Cells cells{8, 8};
  Plate plate = strip(cells, 1e-4);
  plate.solid = solid::Elastic{glass()};
  plate.viscosity = york(0.5, 0.5);
  const double both = fem::critical_time_step(plate, cells);
  plate.viscosity = york(1, 0);
  BOOST_TEST(both == fem::critical_time_step(plate, cells), tt::tolerance(1e-12));
}

// The stiffest tangent over all r = V_d/ε, by differences of the stress itself.
BOOST_DATA_TEST_CASE(the_limit_of_a_failure_wave_is_that_of_its_stiffest_tangent, data::make({0.0, 0.3, 0.5, 0.9, 1.0}),
                     f_max) {
  const FailureWave wave{glass(), 0, f_max};
  double worst = 1;
  for (int k = 1; k <= 2000; ++k) {
    const double strain = -0.01, V = wave.ceiling({strain, 0, 0}) * k / 2000.0, step = 1e-8;
    if (wave.converted({strain, 0, 0}, V) > 0.899) continue;
    const double above = wave.stress({strain + step, 0, 0}, V).xx, below = wave.stress({strain - step, 0, 0}, V).xx;
    if (wave.converted({strain + step, 0, 0}, V) >= f_max) continue;  // clipped on one side: no tangent
    worst = std::max(worst, (above - below) / (2 * step) / glass().stiffness().normal);
  }
  BOOST_TEST(wave.stiffening() == worst, tt::tolerance(0.005));
  BOOST_TEST(wave.stiffening() >= worst * (1 - 1e-6));
  Plate plate = strip({8, 8}, 1e-4);
  plate.solid = solid::Elastic{glass()};
  const double whole = fem::critical_time_step(plate, {8, 8});
  plate.solid = solid::Failing{wave};
  BOOST_TEST(fem::critical_time_step(plate, {8, 8}) == whole / std::sqrt(wave.stiffening()), tt::tolerance(1e-12));
  if (f_max == 0) BOOST_TEST(fem::critical_time_step(plate, {8, 8}) == whole);
}

// ---- gauges ----

// A gauge on a face reads the mean of two cells, one between the middles of cells what stands in between, one beyond
// the last middle that cell; on a row's edge the row below.
BOOST_AUTO_TEST_CASE(gauges_read_cells_and_what_is_between_them) {
  const Cells cells{20, 3};
  Plate plate = strip(cells, 1e-4);
  plate.edge(Side::top).support = Edge::Support::free;
  plate.viscosity = york(1, 1);
  struct Expected {
    Gauge gauge;
    std::size_t left, right;
    double of_left;
  };
  const std::vector<Expected> expected{{{1e-3, 1.5e-4}, 29, 30, 0.5},
                                       {{0.9e-3, 2.9e-4}, 48, 49, 0.5},
                                       {{0.975e-3, 0.5e-4}, 9, 10, 0.75},
                                       {{0.95e-3, 1e-4}, 9, 29, 0.5},  // on an edge between two rows
                                       {{0, 0}, 0, 0, 1},
                                       {{2e-3, 3e-4}, 59, 59, 1},
                                       {{1.98e-3, 2e-4}, 39, 59, 0.5}};
  for (const Expected& e : expected) plate.gauges.push_back(e.gauge);
  Stepping stepping = steps_of(0.9 * fem::critical_time_step(plate, cells), 200);
  stepping.sample_after = {1, 100, 200};
  const PlateRecord r = run(plate, cells, stepping, spread_from(8));
  BOOST_TEST_REQUIRE(r.gauges.size() == expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const Expected& e = expected[k];
    const GaugeRecord& g = r.gauges[k];
    BOOST_TEST((g.time.size() == 200U && g.xx.size() == 200U && g.yy.size() == 200U && g.dilatancy.size() == 200U));
    for (std::size_t at = 0; at < 3; ++at) {
      const PlateSnapshot& s = r.snapshots.at(at);
      const auto n = static_cast<std::size_t>(s.step - 1);
      const auto between = [&](double left, double right) { return e.of_left * left + (1 - e.of_left) * right; };
      const auto mean = [&](std::size_t c, std::size_t cell) {
        const double* triangle = &s.stress.component[c][4 * cell];
        return (triangle[0] + triangle[1] + triangle[2] + triangle[3]) / 4;
      };
      BOOST_TEST(g.time[n] == s.time);
      BOOST_TEST(g.xx[n] == between(mean(0, e.left), mean(0, e.right)), tt::tolerance(1e-12));
      BOOST_TEST(g.yy[n] == between(mean(1, e.left), mean(1, e.right)), tt::tolerance(1e-12));
      BOOST_TEST(g.dilatancy[n] == between(s.dilatancy[e.left], s.dilatancy[e.right]), tt::tolerance(1e-12));
    }
    BOOST_TEST(largest(g.xx) > 1e6);
  }
  BOOST_TEST(largest(r.gauges[0].dilatancy) > 1e-4);
  plate.gauges.clear();
  BOOST_TEST(run(plate, cells, stepping, spread_from(8)).gauges.empty());
}

// Every step has its time, and a run that is stopped has no more than it took.
BOOST_AUTO_TEST_CASE(gauges_tell_the_time_of_every_step) {
  Plate plate = strip({20, 1}, 1e-4);
  plate.solid = solid::Elastic{glass()};
  plate.gauges = {{1e-3, 5e-5}};
  const PlateRecord r = run(plate, {20, 1}, steps_of(1e-9, 50, Books::off));
  for (std::size_t n = 0; n < 50; ++n) BOOST_TEST(r.gauges.at(0).time[n] == static_cast<double>(n + 1) * 1e-9);
}

// ---- refusals ----

BOOST_AUTO_TEST_CASE(what_cannot_be_is_refused) {
  const Cells cells{10, 2};
  const Plate good = strip(cells, 1e-4);
  const Stepping stepping = steps_of(1e-9, 1);
  const auto says = [](const std::string& words) {
    return [=](const std::invalid_argument& e) { return std::string(e.what()).find(words) != std::string::npos; };
  };
  const auto refused = [&](const auto& change, const std::string& words) {
    Plate plate = good;
    std::get<solid::Failing>(plate.solid).spread = spread_from(4);
    change(plate);
    BOOST_CHECK_EXCEPTION(run(plate, cells, stepping), std::invalid_argument, says(words));
  };
  BOOST_CHECK_NO_THROW(run(good, cells, stepping, spread_from(4)));
  refused(
      [](Plate& p) {
        p.solid = solid::Failing{FailureWave{{72.8e9, 0.222, 2563, Plane::stress}, 0, 0.5}};
      },
      "plane strain");
  for (const double part : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()})
    refused([=](Plate& p) { p.solid = solid::Failing{FailureWave{glass(), 1e9, part}}; }, "between 0 and 1");
  for (const double threshold : {-1.0, std::numeric_limits<double>::quiet_NaN()})
    refused([=](Plate& p) { p.solid = solid::Failing{FailureWave{glass(), threshold, 0.5}}; }, "threshold");
  for (const double gap : {-1e-9, std::numeric_limits<double>::infinity()})
    refused([=](Plate& p) { p.impact->gap = gap; }, "gap");
  refused([](Plate& p) { p.viscosity = Viscosity{Viscosity::Form::linear_quadratic}; },
          "in a plate the artificial viscosity is that of eq. 21");
  refused([](Plate& p) { p.initial_velocity = [](double, double) { return Vector{}; }; }, "impact beside an initial");
  refused([](Plate& p) { p.initial_displacement = [](double, double) { return Vector{}; }; },
          "impact beside an initial");
  for (const double v : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    refused([=](Plate& p) { p.impact->velocity = v; }, "the flyer's velocity");
  for (const double cells_across : {0.0, 10.0, -1.0, 11.0, std::numeric_limits<double>::quiet_NaN()})
    refused([=](Plate& p) { p.impact->face = 1e-4 * cells_across; }, "inside the plate");
  for (const double cells_across : {4.5, 4 + 1e-6})
    refused([=](Plate& p) { p.impact->face = 1e-4 * cells_across; }, "1 to 9 cells");
  Plate nearly = good;
  nearly.impact->face = 4e-4 * (1 + 1e-11);
  BOOST_CHECK_NO_THROW(run(nearly, cells, stepping, spread_from(4)));
  for (const Gauge& g : {Gauge{-1e-9, 0}, Gauge{0, 3e-4}, Gauge{std::numeric_limits<double>::quiet_NaN(), 0}})
    refused([=](Plate& p) { p.gauges = {g}; }, "a gauge stands in the plate");
}

BOOST_AUTO_TEST_SUITE_END()
