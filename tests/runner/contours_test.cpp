#include "runner/compare/contours.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

BOOST_AUTO_TEST_SUITE(contours)

using namespace diptych::runner;
namespace tt = boost::test_tools;

namespace {

constexpr double pi = std::numbers::pi;
const double nan_value = std::numeric_limits<double>::quiet_NaN();

using Function = std::function<double(double x, double y)>;

NodalMap sampled(int nx, int ny, double width, double height, const Function& f) {
  NodalMap map{nx, ny, width / nx, height / ny, {}};
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) map.value.push_back(f(i * map.hx, j * map.hy));
  }
  return map;
}

/// The paper's plate: 1 by 1.5, n cells across.
NodalMap plate(int n, const Function& f) { return sampled(n, 3 * n / 2, 1, 1.5, f); }

Function cone(double x0, double y0) {
  return [=](double x, double y) { return 2 - std::hypot(x - x0, y - y0); };  // level 2 − r: a circle of radius r
}

/// Quadratic, so that linear crossings are not exact.
Function bowl(double radius) {
  return [=](double x, double y) { return radius * radius - x * x - y * y; };
}

Polyline circle(double radius, int points, double turn = 0) {
  Polyline line;
  line.closed = true;
  for (int i = 0; i < points; ++i) {
    const double angle = turn + 2 * pi * i / points;
    line.x.push_back(radius * std::cos(angle));
    line.y.push_back(radius * std::sin(angle));
  }
  return line;
}

Polyline path(std::vector<double> x, std::vector<double> y) { return {std::move(x), std::move(y), false}; }

/// Largest | |p| − radius | over the points and the middles of the pieces.
double off_circle(const Polyline& line, double x0, double y0, double radius) {
  double worst = 0;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    worst = std::max(worst, std::abs(std::hypot(line.x[i] - x0, line.y[i] - y0) - radius));
    if (i + 1 == line.x.size()) break;
    const double x = (line.x[i] + line.x[i + 1]) / 2, y = (line.y[i] + line.y[i + 1]) / 2;
    worst = std::max(worst, std::abs(std::hypot(x - x0, y - y0) - radius));
  }
  return worst;
}

/// Of a closed line, > 0 if it runs counter-clockwise.
double enclosed(const Polyline& line) {
  double twice = 0;
  const std::size_t n = line.x.size();
  for (std::size_t i = 0; i < n; ++i) twice += line.x[i] * line.y[(i + 1) % n] - line.x[(i + 1) % n] * line.y[i];
  return twice / 2;
}

void is_point(const Polyline& line, std::size_t i, double x, double y) {
  BOOST_TEST(line.x[i] == x, tt::tolerance(1e-14));
  BOOST_TEST(line.y[i] == y, tt::tolerance(1e-14));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_closed_circle_runs_with_what_is_above_on_its_left) {
  const auto lines = contour(sampled(40, 60, 1, 1.5, cone(0.45, 0.7)), 1.7);
  BOOST_REQUIRE(lines.size() == 1U);
  BOOST_TEST(lines[0].closed);
  BOOST_TEST(off_circle(lines[0], 0.45, 0.7, 0.3) < 1e-3);
  BOOST_TEST(enclosed(lines[0]) == pi * 0.09, tt::tolerance(1e-2));
  for (std::size_t i = 0; i + 1 < lines[0].x.size(); ++i)
    BOOST_TEST((lines[0].x[i] != lines[0].x[i + 1] || lines[0].y[i] != lines[0].y[i + 1]));
  // A hole is gone round the other way.
  const auto hole = contour(sampled(40, 60, 1, 1.5, [](double x, double y) { return -cone(0.45, 0.7)(x, y); }), -1.7);
  BOOST_REQUIRE(hole.size() == 1U);
  BOOST_TEST(enclosed(hole[0]) == -pi * 0.09, tt::tolerance(1e-2));
}

BOOST_AUTO_TEST_CASE(a_quarter_circle_ends_on_the_walls) {
  const auto lines = contour(plate(20, bowl(0.62)), 0);
  BOOST_REQUIRE(lines.size() == 1U);
  BOOST_TEST(!lines[0].closed);
  BOOST_TEST(lines[0].y.front() == 0.0);  // above, the origin, is on the left
  BOOST_TEST(lines[0].x.back() == 0.0);
}

// Errors of contour, area and radius fall by four when cells are halved.
BOOST_AUTO_TEST_CASE(circles_are_second_order) {
  const double radius = 0.6180339887;
  std::vector<double> line, area, along;
  for (const int n : {10, 20, 40, 80, 160}) {
    const NodalMap map = plate(n, bowl(radius));
    double worst = 0;
    for (int degrees = 0; degrees <= 90; ++degrees)
      worst = std::max(worst, std::abs(radius_along(map, 0, degrees) - radius));
    const auto lines = contour(map, 0);
    BOOST_REQUIRE(lines.size() == 1U);
    line.push_back(off_circle(lines[0], 0, 0, radius));
    area.push_back(std::abs(area_above(map, 0) - pi * radius * radius / 4));
    along.push_back(worst);
  }
  for (const auto* errors : {&line, &area, &along}) {
    BOOST_TEST(errors->front() < 0.01);
    BOOST_TEST(std::log(errors->front() / errors->back()) / std::log(16.0) == 2.0, tt::tolerance(0.1));
  }
}

BOOST_AUTO_TEST_CASE(a_saddle_follows_its_centre) {
  // Above at the lower left and the upper right; the centre is ½.
  const NodalMap map{1, 1, 1, 1, {1, 0, 0, 1}};
  const auto bridged = contour(map, 0.4);  // the two below are cut off
  BOOST_REQUIRE(bridged.size() == 2U);
  is_point(bridged[0], 0, 0.6, 0);
  is_point(bridged[0], 1, 1, 0.4);
  is_point(bridged[1], 0, 0.4, 1);
  is_point(bridged[1], 1, 0, 0.6);
  const auto apart = contour(map, 0.6);  // the two above are
  BOOST_REQUIRE(apart.size() == 2U);
  is_point(apart[0], 0, 0.4, 0);
  is_point(apart[0], 1, 0, 0.4);
  is_point(apart[1], 0, 0.6, 1);
  is_point(apart[1], 1, 1, 0.6);
  BOOST_TEST(contour(map, 0.5).size() == 2U);
  // The other diagonal.
  const auto other = contour(NodalMap{1, 1, 1, 1, {0, 1, 1, 0}}, 0.4);
  BOOST_REQUIRE(other.size() == 2U);
  is_point(other[0], 0, 0, 0.4);
  is_point(other[0], 1, 0.4, 0);
  is_point(other[1], 0, 1, 0.6);
  is_point(other[1], 1, 0.6, 1);
  BOOST_TEST(area_above(map, 0.5) == 0.5, tt::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(a_level_that_nodes_have_exactly) {
  const auto straight = contour(sampled(4, 2, 1, 1, [](double x, double) { return x; }), 0.5);
  BOOST_REQUIRE(straight.size() == 1U);
  BOOST_TEST(straight[0].x == (std::vector<double>{0.5, 0.5, 0.5}), tt::per_element());
  BOOST_TEST(straight[0].y == (std::vector<double>{1, 0.5, 0}), tt::per_element());
  const auto diagonal = contour(sampled(4, 4, 1, 1, [](double x, double y) { return x + y; }), 0.5);
  BOOST_REQUIRE(diagonal.size() == 1U);
  BOOST_TEST(diagonal[0].x == (std::vector<double>{0, 0.25, 0.5}), tt::per_element());
  BOOST_TEST(diagonal[0].y == (std::vector<double>{0.5, 0.25, 0}), tt::per_element());
  // One node at the level, all others on one side of it: a point is no line.
  NodalMap node = sampled(4, 4, 1, 1, [](double, double) { return 1.0; });
  node.value[12] = 0;
  BOOST_TEST(contour(node, 0).empty());
  node.value[12] = 2;
  BOOST_TEST(contour(node, 2).empty());
  BOOST_TEST(contour(node, 1).size() == 1U);  // round the node through its neighbours, where the plateau ends
}

BOOST_AUTO_TEST_CASE(no_contour_where_nothing_or_everything_is_above) {
  const NodalMap map = plate(10, bowl(0.5));
  BOOST_TEST(contour(map, 1).empty());
  BOOST_TEST(contour(map, -9).empty());
  BOOST_TEST(area_above(map, 1) == 0.0);
  BOOST_TEST(area_above(map, -9) == 1.5, tt::tolerance(1e-14));
  BOOST_TEST(std::isnan(radius_along(map, 1, 30)));   // the origin is below
  BOOST_TEST(std::isnan(radius_along(map, -9, 30)));  // leaves the plate
}

// A circle of radius 1.2 is cut by the right side: it meets y = 0 nowhere.
BOOST_AUTO_TEST_CASE(contours_leave_the_plate) {
  const double r = 1.2, wall = std::sqrt(r * r - 1);
  const NodalMap map = plate(80, bowl(r));
  const auto lines = contour(map, 0);
  BOOST_REQUIRE(lines.size() == 1U);
  BOOST_TEST(lines[0].x.front() == 1.0);
  BOOST_TEST(lines[0].y.front() == wall, tt::tolerance(1e-3));
  BOOST_TEST(lines[0].x.back() == 0.0);
  const double corner = std::atan2(wall, 1.0) * 180 / pi;
  BOOST_TEST(std::isnan(radius_along(map, 0, 0)));
  BOOST_TEST(std::isnan(radius_along(map, 0, corner - 1)));
  BOOST_TEST(radius_along(map, 0, corner + 1) == r, tt::tolerance(1e-3));
  BOOST_TEST(radius_along(map, 0, 90) == r, tt::tolerance(1e-3));
  // The circle's part with x < 1, y > 0: its triangle, and its sector.
  BOOST_TEST(area_above(map, 0) == wall / 2 + r * r / 2 * (pi / 2 - std::atan(wall)), tt::tolerance(1e-3));
  for (const double outside : {-1.0, 91.0, nan_value}) BOOST_TEST(std::isnan(radius_along(map, 0, outside)));
}

BOOST_AUTO_TEST_CASE(the_area_above_a_plane_is_exact) {
  const NodalMap map = sampled(7, 5, 1, 1.5, [](double x, double y) { return 3 * x + 2 * y; });
  // Below the level 2: the triangle 3x + 2y < 2 with legs 2/3 and 1.
  BOOST_TEST(area_above(map, 2) == 1.5 - 1.0 / 3, tt::tolerance(1e-14));
  // Below 4 the tip beyond x = 1 is missing: legs 4/3 and 2; tips beyond x = 1 (1/3, 1/2) and y = 3/2 (1/3, 1/2).
  BOOST_TEST(area_above(map, 4) == 1.5 - (4.0 / 3 - 2 * (1.0 / 12)), tt::tolerance(1e-14));
  // A plateau at the level is not above it.
  BOOST_TEST(area_above(sampled(3, 3, 1, 1, [](double, double) { return 2.0; }), 2) == 0.0);
}

BOOST_AUTO_TEST_CASE(the_trapezium_rule_is_exact_for_bilinear_fields) {
  BOOST_TEST(integral(plate(8, [](double, double) { return 2.0; })) == 3.0, tt::tolerance(1e-14));
  BOOST_TEST(integral(plate(8, [](double x, double y) { return x * y; })) == 1.125 / 2, tt::tolerance(1e-14));
  NodalMap corner{2, 2, 0.5, 0.25, std::vector<double>(9, 0.0)};
  corner.value[0] = 1;
  BOOST_TEST(integral(corner) == 0.5 * 0.25 / 4);  // a corner stands for a quarter of a cell
  corner.value[4] = 1;
  BOOST_TEST(integral(corner) == 0.5 * 0.25 * 5 / 4);
}

// Between nodes the field is bilinear and its root along a ray is that of a quadratic.
BOOST_AUTO_TEST_CASE(the_radius_is_exact_for_bilinear_fields) {
  const NodalMap map = sampled(3, 5, 3, 3, [](double x, double y) { return 1 - x * y; });
  BOOST_TEST(radius_along(map, 0.5, 45) == 1.0, tt::tolerance(1e-14));
  BOOST_TEST(radius_along(map, -3, 45) == std::sqrt(8.0), tt::tolerance(1e-14));
  BOOST_TEST(radius_along(map, 0.5, 30) == std::sqrt(0.5 / (std::sqrt(3.0) / 4)), tt::tolerance(1e-13));
  BOOST_TEST(std::isnan(radius_along(map, 0.5, 0)));
  BOOST_TEST(std::isnan(radius_along(map, 1, 45)));  // the origin is at the level, not above it
  const NodalMap plane = sampled(3, 5, 3, 3, [](double x, double y) { return 5 - x - 2 * y; });
  for (const double degrees : {0.0, 10.0, 45.0, 63.0, 90.0}) {
    const double slope = std::cos(degrees * pi / 180) + 2 * std::sin(degrees * pi / 180);
    BOOST_TEST(radius_along(plane, 3, degrees) == 2 / slope, tt::tolerance(1e-14));
    BOOST_TEST(std::isnan(radius_along(plane, 5, degrees)));
  }
}

BOOST_AUTO_TEST_CASE(the_first_fall_counts) {
  const NodalMap waves{6, 1, 1, 1, {2, 3, 0, 3, 0, 0, 0, 2, 3, 0, 3, 0, 0, 0}};
  BOOST_TEST(radius_along(waves, 1, 0) == 1 + 2.0 / 3, tt::tolerance(1e-14));
  BOOST_TEST(radius_along(waves, 0, 0) == 2.0, tt::tolerance(1e-14));  // where it meets the level, below it or not
  BOOST_TEST(std::isnan(radius_along(waves, 2.5, 0)));  // the origin is below, though later nodes are not
}

BOOST_AUTO_TEST_CASE(distances_between_circles_are_differences_of_radii) {
  const std::vector<Polyline> small{circle(0.5, 90)}, large{circle(0.8, 90)};
  BOOST_TEST(hausdorff(small, large) == 0.3, tt::tolerance(1e-8));
  BOOST_TEST(hausdorff(large, small) == hausdorff(small, large));
  BOOST_TEST(hausdorff(small, small) < 1e-15);
  BOOST_TEST(mean_distance(small, large) == 0.3, tt::tolerance(2e-3));
  BOOST_TEST(mean_distance(small, small) < 1e-15);
  // Turned by half a piece the corners face the middles: their sagitta.
  BOOST_TEST(hausdorff({circle(1, 20)}, {circle(1, 20, pi / 20)}) == std::sin(pi / 20) * std::tan(pi / 40),
             tt::tolerance(0.05));
}

BOOST_AUTO_TEST_CASE(distances_by_hand) {
  const std::vector<Polyline> line{path({0, 1}, {0, 0})};
  // The farthest point of the line from its two ends is its middle, which is none of its corners.
  BOOST_TEST(hausdorff(line, {path({0}, {0}), path({1}, {0})}) == 0.5, tt::tolerance(1e-8));
  for (const double third : {0.4, 0.6})  // in either half
    BOOST_TEST(hausdorff(line, {path({0}, {0}), path({third}, {0}), path({1}, {0})}) == 0.3, tt::tolerance(1e-8));
  BOOST_TEST(hausdorff(line, {path({0}, {0}), path({0.3, 0.3}, {-1, 0})}) == 1.0, tt::tolerance(1e-8));
  BOOST_TEST(hausdorff(line, {path({0, 0.6}, {0.25, 0.25})}) == std::hypot(0.4, 0.25), tt::tolerance(1e-8));
  // One set may lie in the other: both ways count.
  BOOST_TEST(hausdorff(line, {path({0, 3}, {0, 0})}) == 2.0, tt::tolerance(1e-8));
  BOOST_TEST(hausdorff({path({0, 3}, {0, 0})}, line) == 2.0, tt::tolerance(1e-8));
  BOOST_TEST(mean_distance(line, {path({0, 1}, {0.25, 0.25})}) == 0.25, tt::tolerance(1e-14));
  // A closed square's last side is part of it.
  const Polyline square{{0, 1, 1, 0}, {0, 0, 1, 1}, true};
  BOOST_TEST(hausdorff({square}, {path({0, 1, 1, 0, 0}, {0, 0, 1, 1, 0})}) == 0.0);
  Polyline open = square;
  open.closed = false;
  BOOST_TEST(hausdorff({square}, {open}) == 0.5, tt::tolerance(1e-8));
}

// Against the largest distance over a fine sampling of both.
BOOST_AUTO_TEST_CASE(the_farthest_point_is_that_of_a_fine_sampling) {
  Polyline wave, other;
  for (int i = 0; i <= 30; ++i) {
    const double x = i / 30.0;
    wave.x.push_back(x);
    wave.y.push_back(0.1 * std::sin(9 * x));
    other.x.push_back(1.1 * x * x);
    other.y.push_back(0.05 + 0.2 * std::cos(5 * x));
  }
  double sampled_distance = 0;
  for (const auto& [from, to] : {std::pair{wave, other}, std::pair{other, wave}}) {
    for (std::size_t i = 0; i + 1 < from.x.size(); ++i) {
      for (int k = 0; k <= 50; ++k) {
        const double s = k / 50.0;
        const Polyline point =
            path({from.x[i] + s * (from.x[i + 1] - from.x[i])}, {from.y[i] + s * (from.y[i + 1] - from.y[i])});
        double least = 9;
        for (std::size_t l = 0; l + 1 < to.x.size(); ++l) {
          for (int m = 0; m <= 50; ++m) {
            const double t = m / 50.0;
            least = std::min(least, std::hypot(point.x[0] - to.x[l] - t * (to.x[l + 1] - to.x[l]),
                                               point.y[0] - to.y[l] - t * (to.y[l + 1] - to.y[l])));
          }
        }
        sampled_distance = std::max(sampled_distance, least);
      }
    }
  }
  BOOST_TEST(hausdorff({wave}, {other}) == sampled_distance, tt::tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(nothing_has_no_distance) {
  const std::vector<Polyline> some{circle(1, 8)};
  BOOST_TEST(std::isnan(hausdorff({}, some)));
  BOOST_TEST(std::isnan(hausdorff(some, {})));
  BOOST_TEST(std::isnan(mean_distance({}, {})));
  BOOST_TEST(std::isnan(hausdorff(some, {Polyline{}})));
  std::vector<Polyline> bad = some;
  bad[0].y[3] = nan_value;
  BOOST_TEST(std::isnan(hausdorff(some, bad)));
  BOOST_TEST(std::isnan(mean_distance(bad, some)));
}

BOOST_AUTO_TEST_CASE(nan_stays_nan) {
  const NodalMap good = plate(10, bowl(0.5));
  for (const std::size_t bad : {0U, 13U, 40U, 175U}) {
    NodalMap map = good;
    map.value[bad] = nan_value;
    BOOST_TEST(contour(map, 0).empty());
    for (const double level : {-9.0, 0.0, 9.0}) BOOST_TEST(std::isnan(area_above(map, level)));
    BOOST_TEST(std::isnan(integral(map)));
    BOOST_TEST(std::isnan(difference(good, map).value[bad]));
  }
  NodalMap map = good;
  map.value[3] = nan_value;
  BOOST_TEST(std::isnan(radius_along(map, 0, 0)));
  BOOST_TEST(!std::isnan(radius_along(map, 0, 80)));  // not in its way
  BOOST_TEST(contour(good, nan_value).empty());
  BOOST_TEST(std::isnan(area_above(good, nan_value)));
  BOOST_TEST(std::isnan(radius_along(good, nan_value, 30)));
}

BOOST_AUTO_TEST_CASE(maps_are_subtracted_on_the_same_grid_only) {
  const NodalMap a{1, 1, 1, 2, {1, 2, 3, 4}}, b{1, 1, 1, 2, {0, 5, 1, 4}};
  BOOST_TEST(difference(a, b).value == (std::vector<double>{1, -3, 2, 0}), tt::per_element());
  BOOST_CHECK_THROW(difference(a, NodalMap{1, 1, 1, 1, {1, 2, 3, 4}}), std::invalid_argument);
  BOOST_CHECK_THROW(difference(a, plate(2, bowl(1))), std::invalid_argument);
  for (const NodalMap& wrong : {NodalMap{1, 1, 1, 1, {1, 2, 3}}, NodalMap{0, 1, 1, 1, {1, 2}},
                                NodalMap{1, 1, 0, 1, {1, 2, 3, 4}}, NodalMap{1, 1, 1, nan_value, {1, 2, 3, 4}}}) {
    BOOST_CHECK_THROW(contour(wrong, 0), std::invalid_argument);
    BOOST_CHECK_THROW(area_above(wrong, 0), std::invalid_argument);
    BOOST_CHECK_THROW(integral(wrong), std::invalid_argument);
    BOOST_CHECK_THROW(radius_along(wrong, 0, 0), std::invalid_argument);
  }
}

BOOST_AUTO_TEST_SUITE_END()
