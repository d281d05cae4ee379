// What the plate by MPM has for shocked glass: a failure wave, artificial viscosity, a flyer's impact across a gap, and
// gauges.
#include <algorithm>
#include <array>
#include <atomic>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <string>

#include "hinge/diffusion/dilatancy.hpp"
#include "hinge/material/failure_wave_law.hpp"
#include "mpm/bar.hpp"
#include "mpm/plate.hpp"
#include "tests/plate_records.hpp"

BOOST_AUTO_TEST_SUITE(mpm_failure)

using namespace diptych;
using mpm::Scheme;
namespace tt = boost::test_tools;
namespace bdata = boost::unit_test::data;

namespace {

constexpr std::array schemes{Scheme::usf, Scheme::usl, Scheme::musl};
constexpr std::array sides{Side::left, Side::right, Side::bottom, Side::top};
const auto every_scheme = bdata::make(std::vector<int>{0, 1, 2});
Scheme scheme(int which) { return schemes[static_cast<std::size_t>(which)]; }

const material::PlaneElastic glass{72.8e9, 0.222, 2563, material::Plane::strain};
const std::vector<double> quarters{0.25, 0.75};
constexpr double infinite = std::numeric_limits<double>::infinity();
using Hold = Edge::Support;
using Spread = std::optional<diffusion::Spread>;

Plate plate(double width, double height) {
  Plate p;
  p.width = width;
  p.height = height;
  p.solid = solid::Elastic{glass};
  return p;
}

void hold(Plate& p, const std::array<Hold, 4>& supports) {
  for (const Side side : sides) p.edge(side).support = supports[static_cast<std::size_t>(side)];
}

material::Viscosity york(double c) {
  material::Viscosity v;
  v.c1 = v.c2 = c;
  return v;
}

diffusion::Spread from_face(int column, double diffusivity = 8) {
  diffusion::Spread s;
  s.diffusivity = diffusivity;
  s.face = column;
  return s;
}

/// A flyer of 3 of 8 columns, cells of 1 mm × 0.75 mm; damage starts at the face. Loaded and held in many ways.
const Cells of_scene{8, 5};
const Spread of_face = from_face(3);

PlateRecord run_spreading(const Plate& p, const Cells& cells, const std::vector<double>& xi, Scheme scheme,
                          const Stepping& how, const Spread& spread = std::nullopt) {
  Plate with = p;
  if (auto* failing = std::get_if<solid::Failing>(&with.solid); failing && spread) failing->spread = *spread;
  return mpm::run(with, cells, xi, scheme, how);
}
Plate scene(double gap) {
  Plate p = plate(8e-3, 3.75e-3);
  p.solid = solid::Failing{material::FailureWave{glass, 1e9, 0.5}};
  p.viscosity = york(0.3);
  p.impact = Impact{3e-3, 684, gap};
  hold(p, {Hold::free, Hold::fixed, Hold::roller, Hold::free});
  p.edge(Side::top).normal_traction = [](double from, double) { return from < 1e-6 ? -3e8 : -1e8; };
  p.edge(Side::top).shear_traction = [](double, double) { return 2e7; };
  p.body_force = [](double x, double y, double t) { return Vector{1e9 * y, 1e7 + 1e9 * x + 1e12 * t}; };
  p.gauges = {{4.3e-3, 2e-3}, {1.1e-3, 3e-3}};
  return p;
}

/// Steps of a part of the critical one that there would be without viscosity and damage.
Stepping stepping(Plate p, const Cells& cells, Scheme s, double part, long steps,
                  const std::vector<double>& xi = quarters) {
  p.viscosity.reset();
  p.solid = solid::Elastic{material::PlaneElastic(elastic(p))};
  Stepping how;
  how.time_step = part * mpm::critical_time_step(p, cells, xi, s);
  how.steps = steps;
  how.sample_after = {steps};
  how.books = Books::lines;
  return how;
}

std::vector<std::vector<double>> fields(const PlateRecord& r) {
  std::vector<std::vector<double>> all;
  for (const PlateSnapshot& s : r.snapshots) {
    for (const PointField* f : {&s.displacement, &s.velocity, &s.stress})
      all.insert(all.end(), f->component.begin(), f->component.end());
    for (const auto* values : {&s.volumetric_strain, &s.concentration, &s.dilatancy}) all.push_back(*values);
  }
  for (const GaugeRecord& g : r.gauges) {
    for (const auto* values : {&g.time, &g.xx, &g.yy, &g.dilatancy}) all.push_back(*values);
  }
  return all;
}

/// The particles' fields alone, which an elastic run has too.
std::vector<std::vector<double>> motion(const PlateRecord& r) {
  const PlateSnapshot& s = first(r);
  std::vector<std::vector<double>> all;
  for (const PointField* f : {&s.displacement, &s.velocity, &s.stress})
    all.insert(all.end(), f->component.begin(), f->component.end());
  return all;
}

/// Largest |difference| in units of the second's largest value.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  BOOST_REQUIRE(a.size() == b.size());
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most == 0 ? 0 : most / largest(b);
}

void the_books_close(const PlateRecord& r) {
  BOOST_TEST_CONTEXT(r.message) { BOOST_REQUIRE((r.outcome == Outcome::completed)); }
  BOOST_REQUIRE(r.sums.finite);
  double momentum = 0;
  for (const LedgerLine& line : r.ledger)
    momentum = std::max({momentum, std::abs(line.momentum), std::abs(line.impulse)});
  BOOST_TEST(r.sums.held > 0);
  BOOST_TEST(r.sums.lost <= 1e-12 * r.sums.held);
  BOOST_TEST(r.sums.momentum <= 1e-12 * momentum);
}

/// Every side is driven with one velocity gradient [1/s].
Plate strained(Plate p, double xx, double yy, double xy) {
  const auto field = [=](double x, double y) { return Vector{xx * x + xy * y, xy * x + yy * y}; };
  hold(p, {Hold::driven, Hold::driven, Hold::driven, Hold::driven});
  for (const Side side : sides) p.edge(side).velocity = [=](double x, double y, double) { return field(x, y); };
  p.initial_velocity = field;
  return p;
}

Vector ragged(double x, double y) { return {std::sin(37 * x + 11 * y * y) + 0.3, std::cos(53 * y - 17 * x * x) - 0.1}; }

}  // namespace

// --- the failure wave
// -------------------------------------------------------------------------------------------------

BOOST_DATA_TEST_CASE(a_failure_wave_that_does_not_begin_leaves_the_bits_alone, every_scheme* bdata::make({0, 1, 2}),
                     which, kind) {
  Plate p = plate(1, 0.7);
  hold(p, {Hold::roller, Hold::free, Hold::fixed, Hold::free});
  p.initial_displacement = [](double x, double y) { return Vector{-1e-2 * x, -2e-3 * y}; };
  p.initial_velocity = ragged;
  Plate failing = p;
  Spread spread = from_face(2);
  material::FailureWave wave{glass, 0, 0.5};
  if (kind == 0) wave.threshold = infinite;
  if (kind == 1) wave.most_converted = 0;  // pressed everywhere
  if (kind == 2) spread->face.reset();
  failing.solid = solid::Failing{wave};
  const Stepping how = stepping(p, {6, 5}, scheme(which), 0.4, 6);
  const PlateRecord a = run_spreading(p, {6, 5}, quarters, scheme(which), how);
  const PlateRecord b = run_spreading(failing, {6, 5}, quarters, scheme(which), how, spread);
  BOOST_TEST((motion(a) == motion(b)));
  BOOST_TEST(largest(first(b).dilatancy) == 0);
  BOOST_TEST(first(b).dilatancy.size() == 30U);
  BOOST_TEST(first(b).concentration.size() == 42U);
  BOOST_TEST(first(a).dilatancy.empty());
  BOOST_TEST(b.fed == 0);
  BOOST_TEST(a.work.bytes < b.work.bytes);
  the_books_close(b);
  BOOST_TEST(b.features == (std::vector<std::string>{"diffusion", "failure-wave"}), tt::per_element());
}

namespace {

/// Sixty steps so quick that stress has no time to move anything: every strain is that of the driven sides, which ends
/// at this one.
struct Quick {
  Plate plate;
  Stepping how;
  diffusion::Spread spread;
  material::Tensor rate;

  Quick(const material::FailureWave& wave, const Cells& cells, int which, const material::Tensor& end) {
    plate = mpm_failure::plate(1, 0.6);
    plate.solid = solid::Failing{wave};
    how = stepping(plate, cells, scheme(which), 1e-7, 60);
    const double all = 60 * how.time_step;
    rate = end * (1 / all);
    plate = strained(plate, rate.xx, rate.yy, rate.xy);
    spread = from_face(2, 0.02 / all);
  }
};

}  // namespace

// All strain alike and known; so the cells' dilatancy is what the diffusion makes of that strain's ceiling at the
// strain's own times, and every particle's stress is that of its strain and its cell.
BOOST_DATA_TEST_CASE(stress_follows_from_strain_and_dilatancy, every_scheme* bdata::make({0.0, 1e8}), which,
                     threshold) {
  const Cells cells{6, 3};
  const material::FailureWave wave{glass, threshold, 0.5};
  auto [p, how, spread, rate] = Quick(wave, cells, which, {-0.06, 0.01, 0.02});
  how.sample_after = {1, 20, 60};
  const PlateRecord r = run_spreading(p, cells, quarters, scheme(which), how, spread);
  diffusion::Dilatancy oracle(spread, {cells.x, cells.y, 1.0 / 6, 0.2});
  double time = 0;
  auto s = r.snapshots.begin();
  BOOST_REQUIRE(r.snapshots.size() == 3U);
  for (long n = 1; n <= how.steps; ++n) {
    const double dt = which == 0 && n == 1 ? how.time_step / 2 : how.time_step;
    time += dt;
    const material::Tensor strain = rate * time;
    const double ceiling = wave.equivalent_stress(strain) <= wave.threshold ? 0 : wave.ceiling(strain);
    oracle.advance(std::vector<double>(18, ceiling), dt);
    if (s == r.snapshots.end() || s->step != n) continue;
    BOOST_TEST(s->time == time, tt::tolerance(1e-12));
    BOOST_REQUIRE(s->dilatancy.size() == 18U);
    for (std::size_t c = 0; c < 18; ++c) {
      const double V = oracle.of_cells()[c];
      BOOST_TEST_REQUIRE(std::abs(s->dilatancy[c] - V) <= 1e-9 * ceiling);
      const material::Tensor stress = wave.stress(strain, V);
      for (std::size_t q = 4 * c; q < 4 * c + 4; ++q) {
        BOOST_TEST_REQUIRE(s->stress.component[0][q] == stress.xx, tt::tolerance(1e-8));
        BOOST_TEST_REQUIRE(s->stress.component[1][q] == stress.yy, tt::tolerance(1e-8));
        BOOST_TEST_REQUIRE(s->stress.component[2][q] == stress.xy, tt::tolerance(1e-8));
      }
    }
    for (std::size_t k = 0; k < s->concentration.size(); ++k)
      BOOST_TEST_REQUIRE(std::abs(s->concentration[k] - oracle.of_nodes()[k]) <= 1e-9 * ceiling);
    ++s;
  }
  BOOST_TEST((r.snapshots[0].dilatancy[2] > 0) == (threshold == 0));  // else it is yet to come
  BOOST_TEST(r.snapshots[2].dilatancy[2] > r.snapshots[1].dilatancy[2]);
  BOOST_TEST(r.snapshots[2].dilatancy[2] > 2 * r.snapshots[2].dilatancy[5]);
  BOOST_TEST(r.fed == oracle.fed(), tt::tolerance(1e-9));
  BOOST_TEST(r.fed > 0);
  the_books_close(r);
}

// At uniform strain, by hand: Σ [ψ_{n−1} − ψ_n + ½ (σ_{n−1} + σ_n) : Δε] over cells, V_d of the snapshots. While the
// strain grows, and while it falls from there, so that at the face the ceiling falls below V_d and f is cut off.
BOOST_DATA_TEST_CASE(what_the_failure_wave_takes, bdata::make({0, 1}), falls) {
  const Cells cells{4, 2};
  const material::FailureWave wave{glass, 1e8, 0.5};
  const material::Tensor most{-0.06, 0.01, 0.02}, start = most * falls;
  auto [p, how, spread, rate] = Quick(wave, cells, 2, most * (falls == 1 ? -0.9 : 1));
  if (falls == 1) {
    spread.keeps_largest = true;
    p.initial_displacement = [&](double x, double y) {
      return Vector{start.xx * x + start.xy * y, start.xy * x + start.yy * y};
    };
  }
  for (how.sample_after.clear(); how.sample_after.size() < 60;)
    how.sample_after.push_back(static_cast<long>(how.sample_after.size()) + 1);
  const PlateRecord r = run_spreading(p, cells, quarters, Scheme::musl, how, spread);
  double taken = 0;
  material::Tensor before = start;
  bool cut_off = false;
  std::vector<double> dilatancy(8, 0);
  const double area = 0.6 / 8;
  for (std::size_t n = 0; n + 1 < 60; ++n) {  // a line holds what was dissipated before the step that it ends
    const material::Tensor strain = start + rate * r.snapshots[n].time;
    for (std::size_t c = 0; c < 8; ++c) {
      const double V = r.snapshots[n].dilatancy[c];
      cut_off |= V > wave.ceiling(strain);
      const material::Tensor mean = (wave.stress(before, dilatancy[c]) + wave.stress(strain, V)) * 0.5;
      taken += area * (wave.stored(before, dilatancy[c]) - wave.stored(strain, V) + mean.contract(strain - before));
      dilatancy[c] = V;
    }
    before = strain;
  }
  BOOST_TEST(cut_off == (falls == 1));
  BOOST_TEST(std::abs(taken) > 1e-3 * r.ledger.back().strain);
  BOOST_TEST(r.ledger.back().dissipated == taken, tt::tolerance(1e-6));
}

// Damage that is there at the start pushes from the first force on, in the cells that have it.
BOOST_DATA_TEST_CASE(damage_may_be_there_at_the_start, every_scheme, which) {
  const material::FailureWave wave{glass, infinite, 0.5};
  Plate p = plate(1, 0.7);
  p.solid = solid::Failing{wave};
  p.initial_displacement = [](double x, double y) { return Vector{-1e-2 * x, -2e-3 * y}; };
  diffusion::Spread spread;
  spread.diffusivity = 0;
  spread.start.assign(42, 0);
  for (const std::size_t node : {0, 1, 7, 8}) spread.start[node] = 1e-3;
  Stepping how = stepping(p, {6, 5}, scheme(which), 1e-6, 2);
  how.sample_after = {1, 2};
  const PlateRecord r = run_spreading(p, {6, 5}, quarters, scheme(which), how, spread);
  BOOST_REQUIRE(r.snapshots.size() == 2U);
  const std::array<double, 4> dilatancy{1e-3, 5e-4, 0, 0};
  for (std::size_t q = 0; q < 16; ++q) {
    const material::Tensor stress = wave.stress({-1e-2, -2e-3, 0}, dilatancy[q / 4]);
    BOOST_TEST_REQUIRE(first(r).stress.component[0][q] == stress.xx, tt::tolerance(1e-6));
    BOOST_TEST_REQUIRE(first(r).stress.component[1][q] == stress.yy, tt::tolerance(1e-6));
  }
  BOOST_TEST(r.fed == 1e-3 * (1.0 / 6) * 0.14 * 2.25, tt::tolerance(1e-12));
  // The same force twice: half a kick and a whole one, or with USF two whole ones.
  const std::vector<double>&once = r.snapshots[0].velocity.component[0], &twice = r.snapshots[1].velocity.component[0];
  for (std::size_t q = 0; q < once.size(); ++q)
    BOOST_TEST_REQUIRE(std::abs(twice[q] - (which == 0 ? 2 : 3) * once[q]) < 1e-6 * largest(once));
}

// --- artificial viscosity
// ---------------------------------------------------------------------------------------------

// Uniform across y between rollers the plate is the bar in uniaxial strain, line by line of the books.
BOOST_DATA_TEST_CASE(between_rollers_viscosity_is_the_bars, every_scheme* bdata::make({0, 1, 2}), which, kind) {
  material::Viscosity viscosity = york(0.4);
  if (kind == 1) viscosity.c2 = 0;
  if (kind == 2) viscosity.always = true;
  const auto velocity = [](double x) { return 30 * std::sin(9 * x) - 5; };
  Scene bar;
  bar.bars[0].length = 1;
  bar.bars[0].material = material::Elastic{glass.stiffness().normal, glass.density};
  bar.bars[0].initial_velocity = velocity;
  bar.left = diptych::Support::fixed;
  bar.viscosity = viscosity;
  Plate p = plate(1, 0.25);
  hold(p, {Hold::roller, Hold::free, Hold::roller, Hold::roller});
  p.initial_velocity = [&](double x, double) { return Vector{velocity(x), 0}; };
  p.viscosity = viscosity;
  const Stepping how = stepping(p, {12, 3}, scheme(which), 0.3, 90);
  const PlateRecord two = run_spreading(p, {12, 3}, quarters, scheme(which), how);
  const Record one = mpm::run(bar, 12, quarters, scheme(which), how);
  std::vector<double> v, stress;
  const PlateSnapshot& s = first(two);
  for (std::size_t q = 0; q < 48; q += q % 2 == 0 ? 1 : 3) {  // the bottom row of particles
    v.push_back(s.velocity.component[0][q]);
    stress.push_back(s.stress.component[0][q]);
  }
  BOOST_TEST(difference(v, first(one).velocity.value) < 1e-11);
  BOOST_TEST(difference(stress, first(one).stress.value) < 1e-11);
  BOOST_REQUIRE(two.ledger.size() == one.ledger.size());
  for (std::size_t k = 0; k < one.ledger.size(); ++k) {
    const LedgerLine &a = two.ledger[k], &b = one.ledger[k];
    const double unit = 1e-10 * one.sums.held;
    BOOST_TEST_REQUIRE(std::abs(a.kinetic / 0.25 - b.kinetic) < unit);
    BOOST_TEST_REQUIRE(std::abs(a.strain / 0.25 - b.strain) < unit);
    BOOST_TEST_REQUIRE(std::abs(a.viscous / 0.25 - b.viscous) < unit);
    BOOST_TEST_REQUIRE(std::abs(a.scheme / 0.25 - b.scheme) < unit);
  }
  BOOST_TEST(two.ledger.back().viscous > 0.01 * two.sums.held);
  the_books_close(two);
  BOOST_TEST(two.features == (std::vector<std::string>{"elastic", "viscosity"}), tt::per_element());
}

// D is the trace alone, and a cell that is not square counts by the root of its area: at one and the same D everywhere
// q = ρ λ c_d g √(hx hy) D (c1 + c2). A line holds the work on whole steps before it.
BOOST_DATA_TEST_CASE(viscosity_takes_what_it_should, every_scheme* bdata::make({1, -1}), which, sign) {
  Plate p = plate(1, 0.6);
  p.viscosity = york(1);
  p.viscosity->c2 = 0.5;
  p = strained(p, -90 * sign, 20 * sign, 70);
  const Stepping how = stepping(p, {4, 7}, scheme(which), 0.05, 40);
  const PlateRecord r = run_spreading(p, {4, 7}, quarters, scheme(which), how);
  const double D = -70, h = std::sqrt(0.25 * (0.6 / 7));
  const double q = glass.density * 0.75 * glass.pressure_wave_speed() * std::sqrt(2) * h * D * 1.5;
  if (sign > 0)
    BOOST_TEST(r.ledger.back().viscous == 0.6 * q * D * how.time_step * (which == 0 ? 38.5 : 39), tt::tolerance(1e-9));
  else
    BOOST_TEST(r.ledger.back().viscous == 0);
  const material::Tensor stress =
      glass.stiffness().stress({-90 * sign * first(r).time, 20 * sign * first(r).time, 70 * first(r).time});
  for (const double xx : first(r).stress.component[0]) BOOST_TEST_REQUIRE(xx == stress.xx, tt::tolerance(1e-9));
  BOOST_TEST((r.features.back() == "viscosity") == (sign > 0));
  the_books_close(r);
}

BOOST_DATA_TEST_CASE(viscosity_of_nothing_leaves_the_bits_alone, every_scheme, which) {
  Plate p = plate(1, 0.7);
  hold(p, {Hold::roller, Hold::free, Hold::fixed, Hold::free});
  p.initial_velocity = ragged;
  p.edge(Side::top).normal_traction = [](double, double) { return 1e6; };
  Plate none = p;
  none.viscosity = york(0);
  const Stepping how = stepping(p, {6, 5}, scheme(which), 0.4, 50);
  const PlateRecord a = run_spreading(p, {6, 5}, quarters, scheme(which), how);
  const PlateRecord b = run_spreading(none, {6, 5}, quarters, scheme(which), how);
  BOOST_TEST((motion(a) == motion(b)));
  BOOST_TEST(a.work.bytes == b.work.bytes);
  BOOST_TEST(mpm::critical_time_step(p, {6, 5}, quarters, scheme(which)) ==
             mpm::critical_time_step(none, {6, 5}, quarters, scheme(which)));
}

namespace {

bool stable(const Plate& p, const Cells& cells, const std::vector<double>& xi, Scheme s, double dt) {
  Stepping how;
  how.time_step = dt;
  how.steps = 3000;
  how.books = Books::off;
  how.sample_after = {how.steps};
  const PlateRecord r = run_spreading(p, cells, xi, s, how);
  return r.outcome == Outcome::completed && largest(first(r).velocity.component[0]) < 1e3 &&
         largest(first(r).velocity.component[1]) < 1e3;
}

}  // namespace

// Where viscosity acts always and is linear, runs 1 % below the limit stay and those 1 % above it blow up.
BOOST_DATA_TEST_CASE(viscous_time_steps_are_the_runs_own, every_scheme* bdata::make({0, 1, 2, 3, 4, 5}), which, kind) {
  Plate p = plate(1, 1);
  p.viscosity = york(kind == 1 ? 1 : 0.2);
  p.viscosity->c2 = 0;
  p.viscosity->always = true;
  Cells cells{6, 6};
  std::vector<double> xi = quarters;
  if (kind == 2) {
    p.height = 2;
    cells = {6, 5};
  }
  if (kind == 3) xi = {0.1, 0.4, 0.9};
  if (kind == 4) p.pic = 0.3;
  if (kind == 5) std::get<solid::Elastic>(p.solid).law.plane = material::Plane::stress;
  p.initial_velocity = ragged;
  const double limit = mpm::critical_time_step(p, cells, xi, scheme(which));
  Plate without = p;
  without.viscosity.reset();
  BOOST_TEST(limit < 0.9 * mpm::critical_time_step(without, cells, xi, scheme(which)));
  BOOST_TEST(stable(p, cells, xi, scheme(which), 0.99 * limit));
  BOOST_TEST(!stable(p, cells, xi, scheme(which), 1.01 * limit));
}

// York's form knows no larger strength than c1 + c2, so its own limit is safe.
BOOST_DATA_TEST_CASE(yorks_time_step_is_safe, every_scheme, which) {
  Plate p = plate(1, 1);
  p.viscosity = york(1);
  p.initial_velocity = ragged;
  const double limit = mpm::critical_time_step(p, {6, 6}, quarters, scheme(which));
  BOOST_TEST(stable(p, {6, 6}, quarters, scheme(which), 0.99 * limit));
  Plate linear = p;
  linear.viscosity->c1 = 2;
  linear.viscosity->c2 = 0;
  BOOST_TEST(limit == mpm::critical_time_step(linear, {6, 6}, quarters, scheme(which)));
}

// The stiffest tangent of a failure wave: the step falls by its root.
BOOST_DATA_TEST_CASE(a_failure_wave_lowers_the_time_step, every_scheme, which) {
  Plate p = plate(1, 1);
  const double whole = mpm::critical_time_step(p, {6, 6}, quarters, scheme(which));
  const material::FailureWave wave{glass, 1e9, 0.5};
  p.solid = solid::Failing{wave};
  BOOST_TEST(mpm::critical_time_step(p, {6, 6}, quarters, scheme(which)) == whole / std::sqrt(wave.stiffening()),
             tt::tolerance(1e-12));
  BOOST_TEST(wave.stiffening() > 1);
}

// --- impact
// -----------------------------------------------------------------------------------------------------------

// Plateau ½ ρ c_d v of equal halves, particle velocity ½ v, before anything comes back from the free ends.
BOOST_DATA_TEST_CASE(an_impact_has_its_plateau, every_scheme* bdata::make({0.0, 2e-4}), which, gap) {
  Plate p = plate(40e-3, 1e-4);
  hold(p, {Hold::free, Hold::free, Hold::roller, Hold::roller});
  p.impact = Impact{20e-3, 684, gap};
  p.viscosity = york(0.2);
  p.gauges = {{24.5e-3, 5e-5}};
  Stepping how = stepping(p, {400, 1}, scheme(which), 0.5, 1);
  how.steps = std::lround(2e-6 / how.time_step);
  how.sample_after = {how.steps};
  const PlateRecord r = run_spreading(p, {400, 1}, quarters, scheme(which), how);
  const double plateau = glass.density * glass.pressure_wave_speed() * 684 / 2;
  BOOST_TEST(r.gauges[0].xx.back() == -plateau, tt::tolerance(1e-4));
  BOOST_TEST(r.gauges[0].yy.back() == -plateau * 0.222 / 0.778, tt::tolerance(1e-4));
  BOOST_TEST(r.gauges[0].dilatancy.empty());
  const auto arrival =
      std::find_if(r.gauges[0].xx.begin(), r.gauges[0].xx.end(), [&](double xx) { return xx < -plateau / 2; });
  const auto step = static_cast<std::size_t>(arrival - r.gauges[0].xx.begin());
  BOOST_TEST(r.gauges[0].time[step] * glass.pressure_wave_speed() == 4.5e-3, tt::tolerance(0.05));
  const PlateSnapshot& s = first(r);
  for (std::size_t q = 0; q < s.velocity.x.size(); ++q) {
    // At the face itself the particles keep some of the first step's jump, of which the grid sees nothing.
    const double from_face = std::abs(s.velocity.x[q] - 20e-3);
    if (from_face > 1e-3 && from_face < 5e-3)
      BOOST_TEST_REQUIRE(s.velocity.component[0][q] == 342, tt::tolerance(1e-3));
    BOOST_TEST_REQUIRE(s.velocity.component[1][q] == 0);
    BOOST_TEST_REQUIRE(s.displacement.component[1][q] == 0);
  }
  the_books_close(r);
}

// The two columns of nodes that meet are the one that a plate without a gap has there; loads and supports too.
BOOST_DATA_TEST_CASE(once_closed_a_gap_makes_no_difference, every_scheme* bdata::make({0.0, 0.3}), which, pic) {
  for (const std::vector<double>& xi : {quarters, std::vector{0.1, 0.4, 0.7}, {0.6}}) {
    Plate with = scene(2e-4), without = scene(0);
    with.pic = without.pic = pic;
    const Stepping how = stepping(with, of_scene, scheme(which), 0.3, 60, xi);
    const PlateRecord a = run_spreading(with, of_scene, xi, scheme(which), how, of_face);
    const PlateRecord b = run_spreading(without, of_scene, xi, scheme(which), how, of_face);
    the_books_close(a);
    const auto fa = fields(a), fb = fields(b);
    BOOST_REQUIRE(fa.size() == fb.size());
    for (std::size_t f = 0; f < fa.size(); ++f) BOOST_TEST(difference(fa[f], fb[f]) < 1e-12);
    BOOST_TEST(largest(first(a).dilatancy) > 1e-3);
    BOOST_REQUIRE(a.ledger.size() == b.ledger.size());
    for (std::size_t k = 0; k < b.ledger.size(); ++k) {
      const auto alike = [&](double x, double y) { return std::abs(x - y) <= 1e-12 * b.sums.held; };
      const LedgerLine &x = a.ledger[k], &y = b.ledger[k];
      BOOST_TEST_REQUIRE(x.time == y.time);
      BOOST_TEST_REQUIRE((alike(x.kinetic, y.kinetic) && alike(x.strain, y.strain) && alike(x.viscous, y.viscous)));
      BOOST_TEST_REQUIRE((alike(x.scheme, y.scheme) && alike(x.work, y.work) && alike(x.dissipated, y.dissipated)));
    }
    BOOST_TEST(a.approach > 0);
    BOOST_TEST(b.approach == 0);
    BOOST_TEST(b.left_over == 0);
    BOOST_TEST(a.work.bytes > b.work.bytes);
    BOOST_TEST(a.work.node_steps == b.work.node_steps + 6 * how.steps);
    BOOST_TEST(a.work.particle_steps == b.work.particle_steps);
  }
}

// Plain shared nodes: a step in the initial velocity.
BOOST_DATA_TEST_CASE(without_a_gap_an_impact_is_a_step_in_velocity, every_scheme* bdata::make({0, 1}), which, pushed) {
  Plate p = plate(8e-3, 3e-3);
  if (pushed == 1) {
    p.edge(Side::left).support = Hold::driven;
    p.edge(Side::left).velocity = [](double, double, double) { return Vector{684, 0}; };
  }
  Plate q = p;
  p.impact = Impact{3e-3, 684, 0};
  q.initial_velocity = [](double x, double) { return Vector{x < 3e-3 ? 684.0 : 0.0, 0}; };
  const Stepping how = stepping(p, {8, 3}, scheme(which), 0.5, 40);
  const PlateRecord a = run_spreading(p, {8, 3}, quarters, scheme(which), how);
  const PlateRecord b = run_spreading(q, {8, 3}, quarters, scheme(which), how);
  BOOST_TEST((fields(a) == fields(b)));
  BOOST_TEST(a.work.bytes == b.work.bytes);
  the_books_close(a);
  BOOST_TEST(a.features == (std::vector<std::string>{"elastic", "impact"}), tt::per_element());
  BOOST_TEST(b.features == std::vector<std::string>{"elastic"}, tt::per_element());
}

// Whole steps of flight; what is left is at most half a step's travel, whichever sign.
BOOST_DATA_TEST_CASE(the_flight_takes_whole_steps, every_scheme* bdata::make({0.1, 0.6, 1.3, 7.8, 250.4}), which,
                     travels) {
  Plate p = plate(8e-3, 3e-3);
  p.impact = Impact{3e-3, 684, 1};
  const Stepping how = stepping(p, {8, 3}, scheme(which), 0.5, 1);
  const double travel = 684 * how.time_step;
  p.impact->gap = travels * travel;
  const PlateRecord r = run_spreading(p, {8, 3}, quarters, scheme(which), how);
  BOOST_TEST(r.approach == std::round(travels) * how.time_step);
  BOOST_TEST(std::abs(r.left_over) <= travel / 2);
  BOOST_TEST(std::abs(r.left_over - (travels - std::round(travels)) * travel) < 1e-11 * p.impact->gap);
  BOOST_TEST(r.steps == 1);
  BOOST_TEST(r.time == how.time_step);
}

// After one step the wave has gone no further than the map carries it; all else is as in flight, and to the bit: no
// strain, the flyer's speed, and a displacement that counts from the contact.
BOOST_DATA_TEST_CASE(flight_leaves_no_trace, every_scheme, which) {
  Plate p = plate(16e-3, 4e-3);
  p.impact = Impact{8e-3, 684, 3e-3};
  const Stepping how = stepping(p, {16, 4}, scheme(which), 0.3, 1);
  const PlateRecord r = run_spreading(p, {16, 4}, quarters, scheme(which), how);
  const PlateSnapshot& s = first(r);
  BOOST_TEST(r.approach > 10 * how.time_step);
  int near = 0;
  for (std::size_t q = 0; q < s.stress.x.size(); ++q) {
    const bool left = s.stress.x[q] < 8e-3;
    if (std::abs(s.stress.x[q] - 8e-3) < 2e-3) {
      ++near;
      continue;
    }
    for (const auto& component : s.stress.component) BOOST_TEST_REQUIRE(component[q] == 0);
    BOOST_TEST_REQUIRE(s.velocity.component[0][q] == (left ? 684 : 0));
    BOOST_TEST_REQUIRE(s.velocity.component[1][q] == 0);
    BOOST_TEST_REQUIRE(s.displacement.component[0][q] == (left ? 684 * s.displacement.time : 0), tt::tolerance(1e-14));
  }
  BOOST_TEST(near == 4 * 4 * 4);
  BOOST_TEST(largest(s.stress.component[0]) > 0);
}

// ρ · face · height · velocity before, during and after.
BOOST_DATA_TEST_CASE(momentum_is_the_flyers, every_scheme* bdata::make({0.0, 2e-4}), which, gap) {
  Plate p = plate(8e-3, 3.75e-3);
  p.solid = solid::Failing{material::FailureWave{glass, 1e9, 0.5}};
  p.viscosity = york(0.3);
  p.impact = Impact{3e-3, 684, gap};
  Stepping how = stepping(p, of_scene, scheme(which), 0.3, 200);
  how.sample_after = {1, 2, 100, 200};
  const PlateRecord r = run_spreading(p, of_scene, quarters, scheme(which), how, of_face);
  const double momentum = glass.density * 3e-3 * 3.75e-3 * 684;
  for (const PlateSnapshot& s : r.snapshots) {
    Vector sum{};
    for (std::size_t q = 0; q < s.velocity.x.size(); ++q) {
      for (std::size_t c = 0; c < 2; ++c) sum[c] += glass.density * s.velocity.weight[q] * s.velocity.component[c][q];
    }
    BOOST_TEST(sum[0] == momentum, tt::tolerance(1e-12));
    BOOST_TEST(std::abs(sum[1]) < 1e-12 * momentum);
  }
  for (const LedgerLine& line : r.ledger)
    BOOST_TEST_REQUIRE(line.momentum * std::sqrt(2) == momentum, tt::tolerance(1e-12));
  the_books_close(r);
}

BOOST_AUTO_TEST_CASE(a_run_stopped_in_flight) {
  const Plate p = scene(1e-3);
  Stepping how = stepping(p, of_scene, Scheme::musl, 0.3, 10);
  const std::atomic<bool> stop{true};
  how.cancelled = &stop;
  const PlateRecord r = run_spreading(p, of_scene, quarters, Scheme::musl, how, of_face);
  BOOST_TEST((r.outcome == Outcome::cancelled));
  BOOST_TEST(r.approach == 0);
  BOOST_TEST(r.steps == 0);
}

// --- all together
// -----------------------------------------------------------------------------------------------------

BOOST_DATA_TEST_CASE(the_books_close_with_everything, every_scheme* bdata::make({0.0, 0.3}) * bdata::make({0.0, 3e-4}),
                     which, pic, gap) {
  for (const std::vector<double>& xi : {quarters, std::vector{0.1, 0.4, 0.7}}) {
    Plate p = scene(gap);
    p.pic = pic;
    const PlateRecord r =
        run_spreading(p, of_scene, xi, scheme(which), stepping(p, of_scene, scheme(which), 0.3, 200, xi), of_face);
    the_books_close(r);
    BOOST_TEST(r.ledger.back().viscous > 0.01 * r.sums.held);
    BOOST_TEST(std::abs(r.ledger.back().dissipated) > 1e-4 * r.sums.held);
    BOOST_TEST(r.fed > 0);
    std::vector<std::string> active{"body-force", "diffusion", "failure-wave", "impact", "pic", "viscosity"};
    if (pic == 0) active.erase(active.begin() + 4);
    BOOST_TEST(r.features == active, tt::per_element());
  }
}

BOOST_DATA_TEST_CASE(any_number_of_threads_gives_the_same_bits, every_scheme* bdata::make({0.0, 3e-4}), which, gap) {
  Plate p = scene(gap);
  p.pic = 0.2;
  Stepping how = stepping(p, of_scene, scheme(which), 0.3, 60);
  how.sample_after = {1, 30, 60};
  const PlateRecord one = run_spreading(p, of_scene, quarters, scheme(which), how, of_face);
  BOOST_REQUIRE((one.outcome == Outcome::completed));
  for (const int threads : {2, 3, 20}) {
    how.threads = threads;
    const PlateRecord many = run_spreading(p, of_scene, quarters, scheme(which), how, of_face);
    BOOST_TEST((fields(one) == fields(many)));
    BOOST_TEST(one.left_over == many.left_over);
    BOOST_TEST(one.fed == many.fed);
    BOOST_REQUIRE(one.ledger.size() == many.ledger.size());
    for (std::size_t k = 0; k < one.ledger.size(); ++k) {
      BOOST_TEST_REQUIRE(one.ledger[k].lost == many.ledger[k].lost);
      BOOST_TEST_REQUIRE(one.ledger[k].viscous == many.ledger[k].viscous);
    }
  }
}

// Two equal halves that meet, with the face between them; mirrored left to right, and top to bottom.
BOOST_DATA_TEST_CASE(mirrored_scenes_give_mirrored_bits, every_scheme* bdata::make({0, 1}), which, axis) {
  for (const std::vector<double>& xi : {quarters, std::vector{0.25, 0.5, 0.75}}) {
    const int nx = 8, ny = 4;  // powers of two: places mirror exactly
    Plate p = plate(1, 1);
    p.solid = solid::Failing{material::FailureWave{glass, 1e9, 0.5}};
    p.viscosity = york(0.3);
    p.initial_velocity = [](double x, double y) {
      const Vector v = ragged(x, y);
      return Vector{(x < 0.5 ? 342 : -342) + 10 * v[0], 30 * v[1]};
    };
    p.gauges = {{0.25, 0.5}, {0.0625, 0.125}, {0.375, 0.25}, {0.9375, 0.875}};  // middles and faces
    Plate m = p;
    m.initial_velocity = [&](double x, double y) {
      Vector v = axis == 0 ? p.initial_velocity(1 - x, y) : p.initial_velocity(x, 1 - y);
      v[static_cast<std::size_t>(axis)] = -v[static_cast<std::size_t>(axis)];
      return v;
    };
    for (Gauge& g : m.gauges) (axis == 0 ? g.x : g.y) = 1 - (axis == 0 ? g.x : g.y);
    const Spread spread = from_face(4, 500);
    const Stepping how = stepping(p, {nx, ny}, scheme(which), 0.3, 60, xi);
    const PlateRecord a = run_spreading(p, {nx, ny}, xi, scheme(which), how, spread);
    const PlateRecord b = run_spreading(m, {nx, ny}, xi, scheme(which), how, spread);
    const std::size_t n = xi.size();
    const auto turned = [&](std::size_t i, std::size_t j) {
      return axis == 0 ? std::pair{nx - 1 - i, j} : std::pair{i, ny - 1 - j};
    };
    const auto mirrored = [&](std::size_t q) {
      const std::size_t k = q % (n * n), c = q / (n * n);
      const auto [i, j] = turned(c % nx, c / nx);
      const std::size_t ka = axis == 0 ? n - 1 - k % n : k % n, kb = axis == 0 ? k / n : n - 1 - k / n;
      return (j * nx + i) * n * n + kb * n + ka;
    };
    const auto compare = [&](const std::vector<double>& x, const std::vector<double>& y, double sign, auto&& other) {
      int wrong = 0;
      for (std::size_t q = 0; q < x.size(); ++q) wrong += x[q] != sign * y[other(q)];
      BOOST_TEST(wrong == 0);
      BOOST_TEST(largest(x) > 0);
    };
    const PlateSnapshot &s = first(a), &t = first(b);
    for (std::size_t c = 0; c < 2; ++c) {
      const double sign = static_cast<int>(c) == axis ? -1 : 1;
      compare(s.velocity.component[c], t.velocity.component[c], sign, mirrored);
      compare(s.stress.component[c], t.stress.component[c], 1, mirrored);
    }
    compare(s.dilatancy, t.dilatancy, 1, [&](std::size_t c) {
      const auto [i, j] = turned(c % nx, c / nx);
      return j * nx + i;
    });
    for (std::size_t g = 0; g < 4; ++g) {
      BOOST_TEST((a.gauges[g].xx == b.gauges[g].xx));
      BOOST_TEST((a.gauges[g].yy == b.gauges[g].yy));
      BOOST_TEST((a.gauges[g].dilatancy == b.gauges[g].dilatancy));
    }
  }
}

// Between rollers nothing moves across, and all rows are alike.
BOOST_DATA_TEST_CASE(between_rollers_an_impact_is_uniform_across, every_scheme, which) {
  Plate p = plate(8e-3, 3.75e-3);
  p.solid = solid::Failing{material::FailureWave{glass, 1e9, 0.5}};
  p.viscosity = york(0.3);
  p.impact = Impact{3e-3, 684, 3e-4};
  hold(p, {Hold::free, Hold::free, Hold::roller, Hold::roller});
  const PlateRecord r =
      run_spreading(p, of_scene, quarters, scheme(which), stepping(p, of_scene, scheme(which), 0.3, 60), of_face);
  const PlateSnapshot& s = first(r);
  for (const double u : s.displacement.component[1]) BOOST_TEST_REQUIRE(u == 0);
  for (const auto* f :
       {&s.displacement.component[0], &s.velocity.component[0], &s.stress.component[0], &s.stress.component[1]}) {
    for (std::size_t q = 0; q < f->size(); ++q) {
      const std::size_t in_row = q % 2 + 4 * (q / 4 % 8);  // the same place of the bottom row of particles
      BOOST_TEST_REQUIRE(std::abs((*f)[q] - (*f)[in_row]) < 1e-12 * largest(*f));
    }
  }
  BOOST_TEST(largest(s.dilatancy) > 1e-3);
}

// --- gauges
// -----------------------------------------------------------------------------------------------------------

// Against the particles of the snapshots of every step; the viscosity is no part of it.
BOOST_DATA_TEST_CASE(gauges_read_the_cells_beside_them, every_scheme* bdata::make({0.0, 3e-4}), which, gap) {
  Plate p = scene(gap);
  struct Reading {
    double x, y;
    std::array<std::size_t, 4> cell;  // left and right below, left and right above
    double right;
  };
  const double h = 1e-3, height = 0.75e-3;
  const std::vector<Reading> readings{
      {4.5 * h, 2.5 * height, {20, 21, 20, 21}, 0},                                     // the middle of cell (4, 2)
      {4.75 * h, 2.1 * height, {20, 21, 20, 21}, 0.25}, {3 * h, 0, {2, 3, 2, 3}, 0.5},  // on the face, at the bottom
      {0.1 * h, 5 * height, {32, 33, 32, 33}, 0},                                       // before the first middle
      {8 * h, 4.5 * height, {39, 39, 39, 39}, 0},                                       // beyond the last
      {6 * h, 3 * height, {21, 22, 29, 30}, 0.5},                                       // where four cells meet
  };
  p.gauges.clear();
  for (const Reading& g : readings) p.gauges.push_back({g.x, g.y});
  Stepping how = stepping(p, of_scene, scheme(which), 0.3, 40);
  for (how.sample_after.clear(); how.sample_after.size() < 40;)
    how.sample_after.push_back(static_cast<long>(how.sample_after.size()) + 1);
  const PlateRecord r = run_spreading(p, of_scene, quarters, scheme(which), how, of_face);
  BOOST_REQUIRE(r.gauges.size() == readings.size());
  BOOST_REQUIRE(r.snapshots.size() == 40U);
  for (std::size_t g = 0; g < readings.size(); ++g) {
    const GaugeRecord& gauge = r.gauges[g];
    for (const auto* values : {&gauge.time, &gauge.xx, &gauge.yy, &gauge.dilatancy})
      BOOST_REQUIRE(values->size() == 40U);
    BOOST_TEST_CONTEXT("gauge " << g) {
      for (std::size_t n = 0; n < 40; ++n) {
        const PlateSnapshot& s = r.snapshots[n];
        const auto read = [&](auto&& of_cell) {
          const auto& c = readings[g].cell;
          const double w = readings[g].right;
          return ((1 - w) * of_cell(c[0]) + w * of_cell(c[1]) + (1 - w) * of_cell(c[2]) + w * of_cell(c[3])) / 2;
        };
        const auto mean = [&](std::size_t component) {
          return read([&](std::size_t c) {
            double sum = 0;
            for (std::size_t q = 4 * c; q < 4 * c + 4; ++q) sum += s.stress.component[component][q];
            return sum / 4;
          });
        };
        BOOST_TEST_REQUIRE(gauge.time[n] == s.stress.time);
        const double unit = 1e-12 * (largest(s.stress.component[0]) + largest(s.stress.component[1]));
        BOOST_TEST_REQUIRE(std::abs(gauge.xx[n] - mean(0)) <= unit);
        BOOST_TEST_REQUIRE(std::abs(gauge.yy[n] - mean(1)) <= unit);
        BOOST_TEST_REQUIRE(gauge.dilatancy[n] == read([&](std::size_t c) { return s.dilatancy[c]; }),
                           tt::tolerance(1e-12));
      }
    }
  }
  BOOST_TEST(r.gauges[2].dilatancy.back() > 0);
  Plate silent = p;
  silent.gauges.clear();
  const PlateRecord without = run_spreading(silent, of_scene, quarters, scheme(which), how, of_face);
  BOOST_TEST(without.gauges.empty());
  BOOST_TEST((motion(without) == motion(r)));
}

// --- refusals
// ---------------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(what_cannot_be_is_refused) {
  const auto refused = [](const Plate& p, const Spread& spread, const std::string& words) {
    Stepping how;
    how.time_step = 1e-9;
    how.steps = 1;
    BOOST_CHECK_EXCEPTION(
        run_spreading(p, {8, 2}, quarters, Scheme::musl, how, spread), std::invalid_argument,
        [&](const std::invalid_argument& e) { return std::string(e.what()).find(words) != std::string::npos; });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const material::FailureWave wave{glass, 1e9, 0.5};
  Plate p = plate(8, 2);
  p.solid = solid::Failing{wave};
  refused(p, from_face(9), "face");
  p = plate(8, 2);
  p.solid = solid::Failing{wave};
  p.convected = true;
  refused(p, diffusion::Spread{}, "convected with a failure wave");
  p = plate(8, 2);
  p.solid = solid::Failing{material::FailureWave{{72.8e9, 0.222, 2563, material::Plane::stress}, 1e9, 0.5}};
  refused(p, diffusion::Spread{}, "plane strain");
  for (const double part : {-0.1, 1.1, nan}) {
    p.solid = solid::Failing{material::FailureWave{glass, 1e9, part}};
    refused(p, diffusion::Spread{}, "between 0 and 1");
  }
  for (const double threshold : {-1.0, nan}) {
    p.solid = solid::Failing{material::FailureWave{glass, threshold, 0.5}};
    refused(p, diffusion::Spread{}, "threshold");
  }

  p = plate(8, 2);
  p.viscosity.emplace();
  p.viscosity->form = material::Viscosity::Form::linear_quadratic;
  refused(p, std::nullopt, "in a plate the artificial viscosity is that of eq. 21");
  p.viscosity = york(1);
  p.convected = true;
  refused(p, std::nullopt, "convected with viscosity");

  for (const Gauge& g : {Gauge{-0.1, 1}, {8.1, 1}, {1, -0.1}, {1, 2.1}, {nan, 1}, {1, nan}}) {
    p = plate(8, 2);
    p.gauges = {{1, 1}, g};
    refused(p, std::nullopt, "a gauge stands in the plate");
  }

  const auto with_impact = [&](const Impact& impact) {
    p = plate(8, 2);
    p.impact = impact;
    return p;
  };
  for (const double face : {0.0, 8.0, -3.0, 9.0, nan, infinite}) refused(with_impact({face, 1, 0}), {}, "inside");
  for (const double face : {2.5, 3 + 1e-8, 3 - 1e-8})
    refused(with_impact({face, 1, 0}), {}, "column of the cells' nodes");
  for (const double v : {0.0, -1.0, nan, infinite}) refused(with_impact({3, v, 0}), {}, "velocity");
  for (const double gap : {-1e-9, nan, infinite}) refused(with_impact({3, 1, gap}), {}, "gap");
  refused(with_impact({3, 1, 1.1e-2}), {}, "time steps");  // 1e-9 m a step
  refused(with_impact({3, 684, 1e9}), {}, "10000000");
  p = with_impact({3, 1, 0});
  p.convected = true;
  refused(p, {}, "convected");
  p = with_impact({3, 1, 0});
  p.initial_velocity = ragged;
  refused(p, {}, "initial");
  p = with_impact({3, 1, 0});
  p.initial_displacement = ragged;
  refused(p, {}, "initial");
  for (const Side side : {Side::bottom, Side::top}) {
    for (const Hold support : {Hold::driven, Hold::platen}) {
      p = with_impact({3, 1, 0});
      p.edge(side).support = support;
      p.edge(side).velocity = [](double, double, double) { return Vector{}; };
      refused(p, {}, "tie the flyer to the target");
    }
    p = with_impact({3, 1, 1e-9});
    p.edge(side).support = Hold::fixed;
    refused(p, {}, "the flyer flies by itself");
  }
  for (const Hold support : {Hold::roller, Hold::fixed, Hold::driven, Hold::platen}) {
    p = with_impact({3, 1, 1e-9});
    p.edge(Side::left).support = support;
    p.edge(Side::left).velocity = [](double, double, double) { return Vector{}; };
    refused(p, {}, "the flyer flies by itself");
  }
}

BOOST_AUTO_TEST_SUITE_END()
