#include "runner/compare/norms.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

BOOST_AUTO_TEST_SUITE(norms)

using namespace diptych;
using namespace diptych::runner;
using analytic::BarQuantity;
namespace tt = boost::test_tools;

namespace {

/// A step down from 1 to 0 at a given place.
class Step final : public analytic::ExactSolution {
 public:
  explicit Step(double front) : front_(front) {}
  std::string name() const override { return "step"; }
  double residual(double) const override { return 0; }
  double at(BarQuantity, double x, double) const override { return x < front_ ? 1 : 0; }
  std::vector<analytic::Front> fronts(double) const override { return {{front_, 1, 1, 0}}; }
  double scale(BarQuantity) const override { return 1; }

 private:
  double front_;
};

class Line final : public analytic::ExactSolution {
 public:
  std::string name() const override { return "line"; }
  double residual(double) const override { return 0; }
  double at(BarQuantity, double x, double) const override { return 2 * x; }
  std::vector<analytic::Front> fronts(double) const override { return {}; }
  double scale(BarQuantity) const override { return 1; }
};

const std::vector<Span> whole{{0, 1}};

Field constant_per_cell(std::vector<double> values) {
  Field f;
  const double n = static_cast<double>(values.size());
  for (std::size_t i = 0; i <= values.size(); ++i) f.edges.push_back(static_cast<double>(i) / n);
  for (std::size_t i = 0; i < values.size(); ++i) f.x.push_back((static_cast<double>(i) + 0.5) / n);
  f.value = std::move(values);
  return f;
}

/// Two bars of two cells each, 0 ≤ x ≤ 1 and 2 ≤ x ≤ 3.
Field two_bars(std::vector<double> values) {
  Field f;
  f.edges = {0, 0.5, 1, 2, 2.5, 3};
  f.x = {0.25, 0.75, 2.25, 2.75};
  f.value = std::move(values);
  f.first = {0, 2};
  return f;
}

}  // namespace

// The front inside a cell counts with its exact place: error ½ over the whole cell of length ¼.
BOOST_AUTO_TEST_CASE(a_front_inside_a_cell) {
  const Norms n = error_norms(constant_per_cell({1, 1, 0.5, 0}), Step(0.6), BarQuantity::stress, whole);
  BOOST_TEST(n.l1 == 0.125, tt::tolerance(1e-13));
  BOOST_TEST(n.l2 == 0.25, tt::tolerance(1e-13));
  BOOST_TEST(n.linf == 0.5, tt::tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(a_front_on_an_edge_but_for_round_off_has_no_error) {
  for (const double off : {-1e-16, 0.0, 1e-16}) {
    const Norms n = error_norms(constant_per_cell({1, 1, 0, 0}), Step(0.5 + off), BarQuantity::stress, whole);
    BOOST_TEST(n.linf == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(a_front_one_part_in_a_million_off_is_seen) {
  BOOST_TEST(error_norms(constant_per_cell({1, 1, 0, 0}), Step(0.5 + 1e-6), BarQuantity::stress, whole).linf == 1.0);
}

// Constant on quarters against 2x: |e| ≤ ¼ linear in each, so L1 = 1/8 and L2 = (1/4)/√3.
BOOST_AUTO_TEST_CASE(the_field_is_not_projected) {
  const Norms n = error_norms(constant_per_cell({0.25, 0.75, 1.25, 1.75}), Line(), BarQuantity::stress, whole);
  BOOST_TEST(n.l2 == 0.25 / std::sqrt(3.0), tt::tolerance(1e-13));
  BOOST_TEST(n.l1 == 0.125, tt::tolerance(0.05));  // |e| has a kink inside each cell
  BOOST_TEST((n.l1 <= n.l2 && n.l2 <= n.linf));
}

BOOST_AUTO_TEST_CASE(linear_fields_are_continued_to_the_ends) {
  Field f;
  f.x = {0.25, 0.75};
  f.value = {0.5, 1.5};
  BOOST_TEST(error_norms(f, Line(), BarQuantity::velocity, whole).linf < 1e-15);
  BOOST_TEST(value_at(f, 0) == 0.0);
  BOOST_TEST(value_at(f, 1) == 2.0, tt::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(each_bar_has_its_part_of_a_field) {
  const Field cells = two_bars({1, 2, 3, 4});
  const Field left = cells.of_bar(0), right = cells.of_bar(1);
  BOOST_TEST(left.value == (std::vector<double>{1, 2}), tt::per_element());
  BOOST_TEST(left.edges == (std::vector<double>{0, 0.5, 1}), tt::per_element());
  BOOST_TEST(right.x == (std::vector<double>{2.25, 2.75}), tt::per_element());
  BOOST_TEST(right.value == (std::vector<double>{3, 4}), tt::per_element());
  BOOST_TEST(right.edges == (std::vector<double>{2, 2.5, 3}), tt::per_element());
  Field nodes;
  nodes.x = {0, 0.5, 1, 2, 3};
  nodes.value = {0, 1, 2, 10, 20};
  nodes.first = {0, 3};
  nodes.time = 7;
  BOOST_TEST(nodes.of_bar(1).value == (std::vector<double>{10, 20}), tt::per_element());
  BOOST_TEST(nodes.of_bar(1).edges.empty());
  BOOST_TEST(nodes.of_bar(1).time == 7.0);
  BOOST_TEST(value_at(nodes.of_bar(0), 1.5) == 3.0);  // a bar's line does not lead to the next bar
  BOOST_TEST(value_at(nodes.of_bar(1), 1.5) == 5.0);
}

// Error ½ over the half cell before the front at 2.25, of a length of 2 in all; the gap counts nowhere.
BOOST_AUTO_TEST_CASE(norms_are_means_over_all_bars_and_over_nothing_between_them) {
  const std::vector<Span> bars{{0, 1}, {2, 3}};
  const Norms n = error_norms(two_bars({1, 1, 0.5, 0}), Step(2.25), BarQuantity::stress, bars);
  BOOST_TEST(n.l1 == 0.125, tt::tolerance(1e-13));  // ½ · (¼ + ¼)/2
  BOOST_TEST(n.l2 == 0.25, tt::tolerance(1e-13));   // √(¼ · ½/2)
  BOOST_TEST(n.linf == 0.5, tt::tolerance(1e-13));
  for (const double front : {1.0, 1.3, 2.0}) {
    BOOST_TEST(error_norms(two_bars({1, 1, 0, 0}), Step(front), BarQuantity::stress, bars).linf == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(a_mean_between_fronts_takes_each_piece_by_its_length) {
  BOOST_TEST(mean_between_fronts(Step(0.3), BarQuantity::velocity, {0, 1}, 0) == 0.3, tt::tolerance(1e-14));
  BOOST_TEST(mean_between_fronts(Step(2.25), BarQuantity::velocity, {2, 3}, 0) == 0.25, tt::tolerance(1e-14));
  BOOST_TEST(mean_between_fronts(Step(1.5), BarQuantity::velocity, {0, 1}, 0) == 1.0, tt::tolerance(1e-14));
  BOOST_TEST(mean_between_fronts(Step(1.5), BarQuantity::velocity, {2, 3}, 0) == 0.0);
}

BOOST_AUTO_TEST_CASE(nan_anywhere_makes_every_norm_nan) {
  for (std::size_t bad = 0; bad < 4; ++bad) {
    std::vector<double> values{1, 1, 0, 0};
    values[bad] = std::numeric_limits<double>::quiet_NaN();
    const Norms n = error_norms(constant_per_cell(values), Step(0.5), BarQuantity::stress, whole);
    BOOST_TEST((std::isnan(n.l1) && std::isnan(n.l2) && std::isnan(n.linf)));
  }
}

BOOST_AUTO_TEST_SUITE_END()
