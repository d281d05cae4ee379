// The books: each line by hand, and nothing lost beyond round-off, whatever the scene.
#include "hinge/step/ledger.hpp"

#include <algorithm>
#include <array>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "fem/bar.hpp"
#include "mpm/bar.hpp"
#include "tests/bar_methods.hpp"
#include "tests/scenes.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(ledger)

using namespace diptych;
using namespace diptych::tests;
namespace tt = boost::test_tools;
namespace bdata = boost::unit_test::data;

namespace {

const std::array methods{"fem", "usf", "usl", "musl"};
constexpr int fem_method = 0, usf = 1, usl = 2, musl = 3;

Stepping stepping(double time_step, long steps) {
  Stepping s;
  s.time_step = time_step;
  s.steps = steps;
  s.books = Books::lines;
  return s;
}

/// What of a scene is varied. Stresses reach some hundred, strains some per cent.
struct Kind {
  material::Material material;
  bool moving, viscous;
  int scene;  ///< 0: two bars meet; 1: held, loaded and heavy; 2: free, loaded at both ends; 3: pre-stressed
};

const material::Material elastic = material::Elastic{1e4, 1}, hardening = material::Hardening{1e4, 1, 2500, 60},
                         perfect = material::Hardening{1e4, 1, 0, 60};

Load load(End end, double traction) {
  Load l;
  l.end = end;
  l.mean_traction = [traction](double from, double to) { return traction * std::cos(150 * (from + to)); };
  return l;
}

Scene scene_of(const Kind& kind) {
  Scene scene;
  Bar& bar = scene.bars[0];
  bar.length = 0.5;
  bar.material = kind.material;
  scene.convected = kind.moving;
  if (kind.viscous) scene.viscosity = material::Viscosity{material::Viscosity::Form::york, 0.2, 0.2};
  switch (kind.scene) {
    case 0:
      scene.bars.push_back(bar);
      scene.bars[1].begin = kind.moving ? 0.52 : 0.5;
      scene.bars[1].length = 0.3;
      scene.bars[1].material = material::Elastic{2e4, 2};
      scene.bars[0].initial_velocity = [](double) { return 2.0; };
      scene.bars[1].initial_velocity = [](double) { return -1.0; };
      break;
    case 1:
      scene.left = Support::fixed;
      scene.loads = {load(End::right, 50)};
      scene.body_force = [](double x, double t) { return 400 * x * std::sin(200 * t); };
      break;
    case 2:
      scene.loads = {load(End::left, -60), load(End::right, 40)};
      bar.initial_velocity = [](double x) { return 3 * x; };
      break;
    default:
      scene.left = scene.right = Support::fixed;
      bar.initial_stress = [](double x) { return 30 * std::sin(5 * x); };
      bar.initial_velocity = [](double x) { return std::sin(2 * 3.14159265358979 * x); };
  }
  return scene;
}

std::string name_of(int method, const Kind& kind) {
  const char* law = std::get_if<material::Elastic>(&kind.material) ? "elastic" : "plastic";
  return std::string(methods[static_cast<std::size_t>(method)]) + ", scene " + std::to_string(kind.scene) + ", " + law +
         (kind.moving ? ", moving" : "") + (kind.viscous ? ", viscous" : "");
}

double held(const LedgerLine& l) { return l.kinetic + std::abs(l.strain) + l.dissipated + std::abs(l.viscous); }

/// Every line: nothing lost, and momentum is what came in.
void books_close(const Record& r, double mass) {
  double most = 0, kinetic = 0;
  for (const LedgerLine& line : r.ledger) {
    most = std::max(most, held(line));
    kinetic = std::max(kinetic, line.kinetic);
  }
  BOOST_REQUIRE(most > 0);
  for (const LedgerLine& line : r.ledger) {
    BOOST_TEST_REQUIRE(std::abs(line.lost) <= 1e-12 * most, "lost " << line.lost / most << " at " << line.time);
    BOOST_TEST_REQUIRE(std::abs(line.momentum - line.impulse) <= 1e-12 * std::sqrt(2 * mass * kinetic), line.time);
    // `lost` is what the other entries leave, so that no entry is left out of it
    const LedgerLine& first = r.ledger.front();
    const auto sum = [](const LedgerLine& l) {
      return l.kinetic + l.strain + l.dissipated + l.viscous + l.contact + l.scheme - l.work;
    };
    BOOST_TEST_REQUIRE(std::abs(sum(line) - sum(first) + line.lost) <= 1e-13 * most, line.time);
  }
}

}  // namespace

// --- one line by hand
// ---------------------------------------------------------------------------------------------------

// Two kicks of length 2 under forces that do work at 3 then 5, and 7 then 9: 2 (3 + 5)/2 + 2 (7 + 9)/2 = 24, of which 8
// come before the books open.
BOOST_AUTO_TEST_CASE(work_is_the_mean_power_of_each_kick) {
  Ledger books(Books::lines, 2, 1, 10, 4, 0);
  books.before_kick(3, 11, 2);
  books.after_kick(5, 2);
  books.close_line(100, 10, 0, 26);
  books.before_kick(7, -1, 2);
  books.after_kick(9, 2);
  books.take_by_contact(1);
  books.take_by_viscosity(2);
  books.take_by_scheme(4);
  books.close_line(101, 15, 3, 24);
  books.close_line(101, 15, 0, 24);
  const auto lines = books.take_lines();
  BOOST_REQUIRE(lines.size() == 3U);
  BOOST_TEST(lines[0].time == 1.0);
  BOOST_TEST(lines[2].time == 5.0);
  BOOST_TEST(lines[0].work == 8.0);
  BOOST_TEST(lines[0].lost == 0.0);
  BOOST_TEST(lines[0].impulse == 4.0 + 22);
  BOOST_TEST(lines[1].work == 24.0);
  BOOST_TEST(lines[1].impulse == 4.0 + 22 - 2);
  BOOST_TEST(lines[1].contact == 1.0);
  BOOST_TEST(lines[1].viscous == 2.0);
  BOOST_TEST(lines[1].scheme == 4.0);
  BOOST_TEST(lines[1].dissipated == 0.0);                   // of steps before
  BOOST_TEST(lines[1].lost == 16.0 - (1 + 5 + 2 + 1 + 4));  // work − what is held more − what was taken
  BOOST_TEST(lines[2].dissipated == 3.0);
  BOOST_TEST(lines[2].lost == 0.0);
}

// What the scheme took before the first line belongs to a start that has no energy of its own; contact is kept.
BOOST_AUTO_TEST_CASE(the_books_open_with_the_first_line) {
  Ledger books(Books::lines, 1, 0.5, 1, 0, 0);
  books.take_by_scheme(5);
  books.take_by_contact(3);
  books.close_line(7, 1, 0, 0);
  books.close_line(7, 1, 0, 0);
  const auto lines = books.take_lines();
  for (const LedgerLine& line : lines) {
    BOOST_TEST(line.scheme == 0.0);
    BOOST_TEST(line.contact == 3.0);
    BOOST_TEST(line.lost == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(sums_are_the_largest_of_all_lines) {
  Ledger books(Books::sums, 1, 0.5, 10, 2, 0);
  books.close_line(10, -1, 0, 2);
  books.take_by_viscosity(-2);
  books.close_line(9, -4, 1, 5);
  books.take_by_viscosity(3);
  books.take_by_scheme(1);
  books.close_line(6, 0, 0, 2);
  const LedgerSums& sums = books.sums();
  BOOST_TEST(sums.lines == 3);
  BOOST_TEST(sums.kinetic == 10.0);
  BOOST_TEST(sums.held == 9.0 + 4 + 2);
  BOOST_TEST(sums.lost == 6.0);  // 9 at the start, 3 after two lines, 8 + 1 after three
  BOOST_TEST(sums.taken == 6.0);
  BOOST_TEST(sums.momentum == 3.0);
  BOOST_TEST(sums.last.scheme == 1.0);
  BOOST_TEST(sums.finite);
  BOOST_TEST(books.take_lines().empty());
  books.take_by_contact(std::nan(""));
  books.close_line(6, 0, 0, 2);
  BOOST_TEST(!books.sums().finite);
}

// --- the watch
// ---------------------------------------------------------------------------------------------------------------------

// What the material has taken comes back: 4 − 1.5, of 11 held at the most.
BOOST_AUTO_TEST_CASE(what_the_material_gives_back_is_its_largest_fall) {
  Ledger books(Books::sums, 1, 0.5, 10, 0, 0);
  for (const double taken : {1.0, 3.0, -2.5, 2.0, -1.0, 0.0}) books.close_line(10, 0, taken, 0);
  BOOST_TEST(books.sums().given_back == 2.5);
  BOOST_TEST(books.sums().last.dissipated == 2.5);
}

// 10 J at the start and 2 J of work: 12.2 J are 1.7 % too much and borne, 12.3 J are not.
BOOST_AUTO_TEST_CASE(more_than_was_put_in_is_unstable) {
  for (const Books kept : {Books::off, Books::sums}) {
    Ledger books(kept, 1, 0.5, 10, 0, 0);
    books.close_line(6, 4, 0, 0);
    books.before_kick(1, 0, 2);
    books.after_kick(1, 2);
    books.close_line(8.2, 4, 0, 0);
    BOOST_TEST(!books.unstable());
    books.close_line(8.3, 4, 0, 0);
    BOOST_TEST(books.unstable());
    const std::string words = books.trouble("J");
    BOOST_TEST_CONTEXT(words) {
      BOOST_TEST(words.starts_with(
          "more energy than was put in: 12.3 J held or spent, 12 J put in at the most; given by the "));
      BOOST_TEST(holds(words, "the books were not kept") == (kept == Books::off));
    }
    if (kept == Books::sums) BOOST_TEST(books.sums().put_in == 12.0, tt::tolerance(1e-8));
    books.close_line(std::nan(""), 4, 0, 0);
    BOOST_TEST(books.unstable());
  }
}

BOOST_AUTO_TEST_CASE(the_part_that_gave_too_much_is_named) {
  Ledger material(Books::sums, 1, 0.5, 10, 0, 0), scheme(Books::sums, 1, 0.5, 10, 0, 0);
  for (Ledger* books : {&material, &scheme}) books->close_line(10, 0, books == &material ? -2 : 0, 0);
  scheme.take_by_scheme(-2);
  for (Ledger* books : {&material, &scheme}) {
    books->close_line(12, 0, 0, 0);
    BOOST_TEST(books->unstable());
    BOOST_TEST(books->trouble("J").ends_with(books == &material ? "; given by the material: 2 J"
                                                                : "; given by the scheme: 2 J"));
    BOOST_TEST(books->sums().lost <= 1e-15);
  }
}

// A step of r = 0.8 of the limit: kinetic + |strain| up to 2 (1 + r²)/(1 − r²) = 9.11 times what was put in.
BOOST_AUTO_TEST_CASE(a_leapfrog_may_hold_less_strain_energy_than_none) {
  Allowed allowed;
  allowed.step_ratio = 0.8;
  Ledger books(Books::off, 1, 0.5, 1, 0, 0, allowed);
  books.close_line(1, 0, 0, 0);
  books.close_line(5.0, -4.0, 0, 0);
  BOOST_TEST(!books.unstable());
  books.close_line(5.1, -4.1, 0, 0);
  BOOST_TEST(books.unstable());
  BOOST_TEST(holds(books.trouble("J"), "holds up to 9.11: it grows with the steps"));
}

// A body in flight is looked at from its centre of mass: 2 kg at 5 m/s carry 25 J and have been given nothing inside.
BOOST_AUTO_TEST_CASE(flight_hides_nothing) {
  for (const double inside : {0.0, 0.1}) {
    Ledger books(Books::off, 1, 0.5, 25, 10, 2);
    books.close_line(25, 0, 0, 10);
    books.close_line(25 + inside, 0, 0, 10);
    BOOST_TEST(books.unstable() == (inside > 0));
  }
}

// Without books energies are asked for now and then, and an instability is found all the same.
BOOST_AUTO_TEST_CASE(an_unstable_run_is_found_without_books) {
  for (const int method : {fem_method, usf, usl, musl}) {
    for (const Books kept : {Books::off, Books::sums}) {
      Stepping how = stepping(2.5e-4, 3000);  // Courant number 1.25
      how.books = kept;
      const Record r = run_bars(method, scene_of({elastic, false, false, 1}), 50, how);
      BOOST_TEST((r.outcome == Outcome::unstable));
      BOOST_TEST(r.steps < 200);
      BOOST_TEST(r.message.ends_with(", at step " + std::to_string(r.steps)));
      BOOST_TEST((r.sums.lines > 0) == (kept == Books::sums));  // the lines up to there are kept
    }
  }
}

// And at its end, however short it is.
BOOST_AUTO_TEST_CASE(a_short_run_is_looked_at_in_the_end) {
  for (const int method : {fem_method, usf, usl, musl}) {
    Stepping how = stepping(4e-4, 40);  // Courant number 2
    how.books = Books::off;
    const Record r = run_bars(method, scene_of({elastic, false, false, 1}), 50, how);
    BOOST_TEST((r.outcome == Outcome::unstable));
    BOOST_TEST(r.steps == 40);
    BOOST_TEST(r.message.starts_with("more energy than was put in: "));
  }
}

// --- runs
// ---------------------------------------------------------------------------------------------------------------

BOOST_DATA_TEST_CASE(nothing_is_lost_in_any_scene, bdata::make({0, 1, 2, 3}) * bdata::make({0, 1, 2, 3}), method,
                     which) {
  for (const material::Material& m : {elastic, hardening, perfect}) {
    for (const bool moving : {false, true}) {
      if (method == fem_method && moving && which != 0) continue;  // its mesh always goes with the bar
      for (const bool viscous : {false, true}) {
        const Kind kind{m, moving, viscous, which};
        Stepping how = stepping(2e-5, 1500);
        if (method == usf && moving) how.gains = 0.1;  // where its particles cross cells
        const Record r = run_bars(method, scene_of(kind), 50, how);
        BOOST_TEST_CONTEXT(name_of(method, kind) << ": " << r.message) {
          books_close(r, which == 0 ? 1.1 : 0.5);
          if (method == usl && moving) continue;  // never stable, but its books are kept while it lasts
          BOOST_TEST((r.outcome == Outcome::completed));
          BOOST_TEST(r.ledger.size() == (method == usf ? 1499U : 1500U));
          if (viscous) BOOST_TEST(r.ledger.back().viscous > 0);
          if (m.index() == 1) BOOST_TEST(r.ledger.back().dissipated > 0);
          if (which == 0) BOOST_TEST(!r.touches.empty());
        }
      }
    }
  }
}

// Leapfrog on a linear bar keeps its own energy, and so do particles that stay and get back what they give (USF, MUSL).
BOOST_DATA_TEST_CASE(the_scheme_takes_exactly_nothing_where_theory_says_so, bdata::make({fem_method, usf, musl}),
                     method) {
  for (const int which : {1, 2, 3}) {
    for (const bool viscous : {false, true}) {
      const Record r = run_bars(method, scene_of({elastic, false, viscous, which}), 50, stepping(2e-5, 1500));
      for (const LedgerLine& line : r.ledger) BOOST_TEST_REQUIRE(line.scheme == 0.0);
    }
  }
  if (method == fem_method) {  // also in flight
    for (const LedgerLine& line : fem::run(scene_of({elastic, true, true, 0}), 50, stepping(2e-5, 1500)).ledger) {
      BOOST_TEST_REQUIRE(line.scheme == 0.0);
    }
  }
}

// USL damps a wave by 4 C² a s⁴ of its energy a step, s = sin(kh/2) and a = 1 for one centred particle.
BOOST_AUTO_TEST_CASE(usl_takes_what_theory_says) {
  const double pi = std::acos(-1.0);
  for (const int mode : {1, 4}) {
    Scene scene;
    scene.bars[0].length = 1;
    scene.bars[0].material = elastic;
    scene.left = scene.right = Support::fixed;
    scene.bars[0].initial_velocity = [=](double x) { return std::sin(mode * pi * x); };
    const Record r = run_bars(usl, scene, 50, stepping(1e-4, 400), {0.5});  // C = ½
    const double s = std::sin(mode * pi / 100), kept = std::pow(1 - s * s * s * s, 400);
    const double start = r.ledger.front().kinetic + r.ledger.front().strain;
    BOOST_TEST(r.ledger.back().scheme / start == 1 - kept, tt::tolerance(0.01));
    double most = 0;
    for (std::size_t n = 1; n < r.ledger.size(); ++n)
      most = std::max(most, r.ledger[n].scheme - r.ledger[n - 1].scheme);
    for (std::size_t n = 1; n < r.ledger.size(); ++n)
      BOOST_TEST_REQUIRE(r.ledger[n].scheme - r.ledger[n - 1].scheme >= -0.01 * most, n);
    // the momentum that a wall takes up is no energy, and nothing else is at work
    BOOST_TEST(r.ledger.back().contact == 0.0);
    BOOST_TEST(r.ledger.back().viscous == 0.0);
    BOOST_TEST(r.ledger.back().work == 0.0);
  }
}

// Yield within a step: the trapezium of the leapfrog misses what lies between it and the path of the law, a little in
// all and nothing in the limit.
BOOST_AUTO_TEST_CASE(yield_within_a_step_takes_less_the_shorter_the_step) {
  const auto taken = [](double step, long steps) {
    const Record r = fem::run(scene_of({hardening, false, false, 1}), 50, stepping(step, steps));
    BOOST_TEST(r.ledger.back().dissipated > 0.01 * r.ledger.back().work);
    return std::abs(r.ledger.back().scheme) / r.ledger.back().work;
  };
  const double coarse = taken(8e-5, 250), fine = taken(1e-5, 2000);
  BOOST_TEST(coarse < 0.02);
  BOOST_TEST(fine < coarse / 3);
  BOOST_TEST(fine > 0);
}

// The impact of end masses ½ρh at ±v₀ takes their kinetic energy, ρ h v₀²/2 in all; at Courant number 1 the release
// gives it back.
BOOST_AUTO_TEST_CASE(an_impact_takes_the_end_masses_energy_and_the_release_gives_it_back) {
  for (const int cells : {10, 50}) {
    for (const double gap : {0.0, 0.01}) {
      const double h = 0.5 / cells, dt = h / 100;
      Scene scene;
      scene.bars[0].length = 0.5;
      scene.bars[0].material = elastic;
      scene.bars.push_back(scene.bars[0]);
      scene.bars[1].begin = 0.5 + gap;
      scene.bars[0].initial_velocity = [](double) { return 1.0; };
      scene.bars[1].initial_velocity = [](double) { return -1.0; };
      const long before = std::lround(gap / 2 / dt), last = before + 2L * cells;
      const Record r = fem::run(scene, cells, stepping(dt, last + 5));
      const auto at = [&](long n) { return r.ledger[static_cast<std::size_t>(n)]; };
      BOOST_TEST_CONTEXT(cells << " cells, gap " << gap) {
        if (before > 0) BOOST_TEST(std::abs(at(before - 1).contact) < 1e-12);
        for (const long n : {before, before + 1, last - 1}) BOOST_TEST(at(n).contact == h / 2, tt::tolerance(1e-10));
        for (const long n : {last, last + 4}) BOOST_TEST(std::abs(at(n).contact) < 1e-12);
      }
    }
  }
}

// A perfectly plastic bar on a wall of its kind: what it turns to heat is what the books say it has no more.
BOOST_AUTO_TEST_CASE(heat_is_what_motion_lacks) {
  Scene scene;
  scene.bars[0].length = 0.5;
  scene.bars[0].material = material::Hardening{1e4, 1, 0, 75};
  scene.bars[0].initial_velocity = [](double) { return 1.0; };
  scene.right = Support::fixed;
  const Record r = fem::run(scene, 200, stepping(0.9 * 0.5 / 200 / 100, 4000));
  // v_y = 0.75 ≤ v₀ ≤ 2 v_y: it rebounds at 2 v_y − v₀ = ½, so ¾ of ½ · ½ · 1² is gone
  BOOST_TEST(r.ledger.back().dissipated == 0.75 * 0.25, tt::tolerance(0.05));
}

BOOST_AUTO_TEST_SUITE_END()
