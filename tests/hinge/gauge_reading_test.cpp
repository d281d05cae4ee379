#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "fem/plate.hpp"
#include "hinge/scene/gauges.hpp"
#include "mpm/plate.hpp"
#include "tests/plate_records.hpp"

BOOST_AUTO_TEST_SUITE(gauge_reading)

using namespace diptych;
namespace tt = boost::test_tools;

namespace {

Plate plate(double width = 7, double height = 4) {
  Plate p;
  p.width = width;
  p.height = height;
  p.solid = solid::Elastic{{1e4, 0.3, 1, material::Plane::strain}};
  return p;
}

/// What a gauge reads of cells that are numbered.
double number_at(double x, double y, const Cells& cells) {
  return reading_of({x, y}, plate(), cells).read([&](std::size_t i, std::size_t j) {
    return static_cast<double>(i) + 100 * static_cast<double>(j);
  });
}

/// Upside down.
Plate turned(const Plate& p) {
  Plate out = p;
  const double height = p.height;
  for (Gauge& gauge : out.gauges) gauge.y = height - gauge.y;
  out.initial_displacement = [f = p.initial_displacement, height](double x, double y) {
    const Vector u = f(x, height - y);
    return Vector{u[0], -u[1]};
  };
  return out;
}

std::vector<GaugeRecord> seen(const Plate& p, bool fem) {
  const Cells cells{7, 4};
  const Stepping stepping = steps_of(1e-4, 20);
  return fem ? fem::run(p, cells, stepping).gauges
             : mpm::run(p, cells, {0.25, 0.75}, mpm::Scheme::musl, stepping).gauges;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_gauge_reads_between_two_middles_and_on_an_edge_both_rows) {
  const Cells cells{7, 4};  // of 1 × 1 m
  BOOST_TEST(number_at(2.5, 0.5, cells) == 2.0);
  BOOST_TEST(number_at(3, 0.5, cells) == 2.5);
  BOOST_TEST(number_at(2.75, 0.5, cells) == 2.25, tt::tolerance(1e-12));
  BOOST_TEST(number_at(2.5, 1.01, cells) == 102.0);
  BOOST_TEST(number_at(2.5, 1, cells) == 52.0);  // the mean of the rows 0 and 1
  BOOST_TEST(number_at(2.5, 3, cells) == 252.0);
  BOOST_TEST(number_at(0, 0, cells) == 0.0);  // beyond the last middle that cell alone
  BOOST_TEST(number_at(7, 4, cells) == 306.0);
  BOOST_TEST(number_at(3.5, 2, {1, 1}) == 0.0);
}

BOOST_AUTO_TEST_CASE(a_mirrored_gauge_has_the_mirrored_weights) {
  const Cells cells{7, 4};
  for (int i = 0; i <= 14; ++i) {  // middles and edges
    const double x = 0.05 * i, back = 0.7 - x;
    const GaugeReading a = reading_of({x, 0.3}, plate(0.7, 0.6), cells),
                       b = reading_of({back, 0.3}, plate(0.7, 0.6), cells);
    const auto mirrored = [&](std::size_t column, std::size_t row) {
      return std::sin(static_cast<double>(6 - column)) + static_cast<double>(row);
    };
    const auto as_it_is = [&](std::size_t column, std::size_t row) {
      return std::sin(static_cast<double>(column)) + static_cast<double>(row);
    };
    BOOST_TEST(a.read(as_it_is) == b.read(mirrored));
  }
}

// FEM read the row below.
BOOST_AUTO_TEST_CASE(on_an_edge_between_rows_both_panels_read_the_mean_and_mirror_exactly) {
  for (const bool fem : {true, false}) {
    Plate p = plate();
    p.initial_displacement = [](double x, double y) { return Vector{1e-3 * x * y * y, 1e-3 * std::sin(3 * x + y)}; };
    p.gauges = {{3, 1}, {3, 0.5}, {3, 1.5}, {4.5, 2}};
    const std::vector<GaugeRecord> r = seen(p, fem), t = seen(turned(p), fem);
    for (std::size_t n = 0; n < 20; ++n) {
      BOOST_TEST(r[0].yy[n] == (r[1].yy[n] + r[2].yy[n]) / 2);
      BOOST_TEST(r[0].xx[n] == (r[1].xx[n] + r[2].xx[n]) / 2);
      BOOST_TEST(r[1].xx[n] != r[2].xx[n]);
      for (const std::size_t g : {0, 3}) BOOST_TEST((r[g].xx[n] == t[g].xx[n] && r[g].yy[n] == t[g].yy[n]));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
