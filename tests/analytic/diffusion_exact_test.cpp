// Diffusion's exact solutions against their equation, known values and a plain difference scheme.
#include "analytic/diffusion_exact.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

BOOST_AUTO_TEST_SUITE(diffusion_exact)

namespace {

using namespace diptych::analytic;
using boost::test_tools::tolerance;
constexpr double pi = std::numbers::pi;

/// A solution with something wrong.
class Spoiled final : public DiffusionSolution {
 public:
  using Field = std::function<double(double, double, double)>;
  explicit Spoiled(Field field) : field_(std::move(field)) {}
  std::string name() const override { return "spoiled"; }
  double residual(const PlaneWindow&) const override { return std::nan(""); }
  double concentration(double x, double y, double t) const override { return field_(x, y, t); }
  double diffusivity(double, double) const override { return 1; }

 private:
  double size() const override { return 1; }
  Field field_;
};

DiffusionProblem quarter_plane(double d) {
  DiffusionProblem p{};
  p.width = p.height = 1;
  p.diffusivity = [=](double, double) { return d; };
  p.scale = 1;
  p.smooth_length = 0.2;
  return p;
}

DiffusionProblem rectangle(const DiffusionSolution& s, double width, double height) {
  DiffusionProblem p{};
  p.width = width;
  p.height = height;
  p.right_wall = p.top_wall = true;
  p.diffusivity = [&](double x, double y) { return s.diffusivity(x, y); };
  p.scale = s.scale(PlaneQuantity::concentration);
  p.smooth_length = std::min(width, height) / pi;
  return p;
}

const ManufacturedVariable::Parameters manufactured{1, 1.5, -0.7, 2e-3, 500, 0.006, 0.01};

}  // namespace

BOOST_AUTO_TEST_CASE(known_values) {
  const CornerSource corner({pi * 3, 3});                                                          // C = E₁
  BOOST_TEST(corner.concentration(std::sqrt(12.0), 0, 1) == 0.219383934395520, tolerance(1e-14));  // E₁(1)
  BOOST_TEST(corner.concentration(0, std::sqrt(6.0), 1) == 0.559773594776160, tolerance(1e-14));   // E₁(1/2)
  BOOST_TEST(corner.concentration(std::sqrt(30.0), std::sqrt(30.0), 1) == 0.001148295591275,
             tolerance(1e-11));                           // E₁(5)
  BOOST_TEST(corner.concentration(1e3, 1e3, 1e-3) == 0);  // far below the smallest number
  BOOST_TEST(corner.concentration(0.1, 0, 0) == 0);
  BOOST_TEST(std::isinf(corner.concentration(0, 0, 1)));
  const InstantSource instant({2, 0.5, 1});
  BOOST_TEST(instant.concentration(0, 0, 1) == 2 / (pi * 0.5), tolerance(1e-15));
  BOOST_TEST(instant.concentration(1, 1, 1) == 2 / (pi * 0.5) * std::exp(-1.0), tolerance(1e-15));
  BOOST_TEST(instant.scale(PlaneQuantity::concentration) == 2 / (pi * 0.5), tolerance(1e-15));
  const RadialPulse pulse({2, 0.5, 1, 3});
  BOOST_TEST(pulse.concentration(0, 0, 1) == 2 / std::sqrt(pi * 2), tolerance(1e-15));
  BOOST_TEST(pulse.concentration(2, 2, 1) == 2 / std::sqrt(pi * 2) * std::exp(-1.0), tolerance(1e-15));
  const CosineMode mode({2, 4, 1, 2, 0.25, 0.5, 3});
  BOOST_TEST(mode.decay_rate() == 3 * pi * pi / 2, tolerance(1e-15));
  BOOST_TEST(mode.concentration(0, 0, 0) == 0.75, tolerance(1e-15));
  BOOST_TEST(mode.concentration(2, 2, 0.1) == 0.25 + 0.5 * std::exp(-0.15 * pi * pi), tolerance(1e-15));
  const ManufacturedVariable variable(manufactured);
  BOOST_TEST(variable.strain(0, 0) == 0.006, tolerance(1e-15));
  BOOST_TEST(variable.diffusivity(0, 0) == 200, tolerance(1e-14));
  BOOST_TEST(variable.diffusivity(1, 0) == 500, tolerance(1e-14));
  BOOST_TEST(ftcs_factor(0.25, 1, 1) == -1);
  BOOST_TEST(ftcs_factor(0.1, 0.5, 0.25) == 0.7, tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(only_the_concentration_is_given) {
  const CosineMode mode({1, 1, 1, 1, 0, 1, 1});
  BOOST_TEST(mode.gives(PlaneQuantity::concentration));
  BOOST_TEST(!mode.gives(PlaneQuantity::stress));
  BOOST_TEST(mode.at(PlaneQuantity::concentration, 0.1, 0.2, 0.3)[0] == mode.concentration(0.1, 0.2, 0.3));
  BOOST_CHECK_THROW(mode.at(PlaneQuantity::velocity, 0, 0, 0), std::invalid_argument);
  BOOST_CHECK_THROW(mode.scale(PlaneQuantity::displacement), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(instant_source) {
  const InstantSource s({0.3, 0.5, 0.01, 0.002});
  auto p = quarter_plane(0.5);
  p.smooth_length = 0.05;
  p.scale = s.scale(PlaneQuantity::concentration);
  p.amount = [](double) { return 0.3; };
  const auto r = self_test(s, p, 1e-3, 0.02);  // all but exp(−22) of it is within the unit square
  BOOST_TEST(r.worst() < 1e-7, r.balance << ' ' << r.boundary << ' ' << r.amount);
  BOOST_TEST(r.points > 1500);
  p.diffusivity = [](double, double) { return 0.505; };
  BOOST_TEST(self_test(s, p, 1e-3, 0.02).balance > 1e-3);
  p.amount = [](double) { return 0.303; };
  BOOST_TEST(self_test(s, p, 1e-3, 0.02).amount > 1e-3);
}

BOOST_AUTO_TEST_CASE(corner_source) {
  const CornerSource s({0.7, 0.5});
  auto p = quarter_plane(0.5);
  p.core = 0.05;
  p.scale = s.scale(PlaneQuantity::concentration);
  p.smooth_length = 0.1;
  p.amount = [](double t) { return 0.7 * t; };
  const auto r = self_test(s, p, 5e-3, 0.02);
  BOOST_TEST(r.balance < 1e-6, r.balance);
  BOOST_TEST(r.boundary < 1e-6, r.boundary);
  BOOST_TEST(r.amount < 1e-5, r.amount);  // the quadrature towards the singular corner
  BOOST_TEST(r.points > 1500);
  BOOST_TEST(self_test(CornerSource({0.707, 0.5}), p, 5e-3, 0.02).amount > 5e-3);
  BOOST_TEST(self_test(CornerSource({0.7, 0.505}), p, 5e-3, 0.02).balance > 1e-3);
}

BOOST_AUTO_TEST_CASE(cosine_modes) {
  for (const auto& [m, n] : {std::pair{1, 0}, {0, 1}, {1, 1}, {2, 3}}) {
    const CosineMode s({1, 1.5, m, n, 0.3, -0.2, 0.5});
    auto p = rectangle(s, 1, 1.5);
    p.smooth_length /= 3;
    p.amount = [](double) { return 0.3 * 1.5; };
    const auto r = self_test(s, p, 0.01, 0.3);
    BOOST_TEST(r.worst() < 1e-7, r.balance << ' ' << r.boundary << ' ' << r.amount);
    BOOST_TEST(r.points > 1500);
  }
  const CosineMode right({1, 1.5, 1, 1, 0.3, -0.2, 0.5}), wrong({1.02, 1.5, 1, 1, 0.3, -0.2, 0.5});
  const auto p = rectangle(right, 1, 1.5);
  BOOST_TEST(self_test(wrong, p, 0.01, 0.1).boundary > 1e-3);
  const Spoiled late([&](double x, double y, double t) { return right.concentration(x, y, 1.01 * t); });
  BOOST_TEST(self_test(late, p, 0.01, 0.1).balance > 1e-3);
  BOOST_TEST(std::isnan(self_test(Spoiled([](double, double, double) { return std::nan(""); }), p, 0.01, 0.1).worst()));
  auto empty = p;
  empty.core = 10;
  BOOST_TEST(std::isinf(self_test(right, empty, 0.01, 0.1).worst()));
  BOOST_CHECK_THROW(self_test(right, p, 0, 1), std::invalid_argument);
  BOOST_CHECK_THROW(self_test(right, p, 1, 0.5), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(manufactured_with_variable_diffusivity) {
  for (const double strain : {0.0, 0.006, 0.01}) {
    auto parameters = manufactured;
    parameters.strain = strain;
    const ManufacturedVariable s(parameters);
    auto p = rectangle(s, 1, 1.5);
    p.source = [&](double x, double y, double t) { return s.source(x, y, t); };
    const auto r = self_test(s, p, 1e-4, 4e-3);
    BOOST_TEST(r.worst() < 1e-6, r.balance << ' ' << r.boundary);
    BOOST_TEST(r.points > 1500);
    p.source = {};
    BOOST_TEST(self_test(s, p, 1e-4, 4e-3).balance > 0.1);
  }
  const ManufacturedVariable s(manufactured);
  auto p = rectangle(s, 1, 1.5);
  p.source = [&](double x, double y, double t) { return s.source(x, y, t); };
  p.diffusivity = [](double, double) { return 350.0; };  // the mean: the gradient of d must matter
  BOOST_TEST(self_test(s, p, 1e-4, 4e-3).balance > 0.05);
}

BOOST_AUTO_TEST_CASE(radial_pulse) {
  const RadialPulse s({0.3, 0.5, 0.01, 0.002});
  auto p = quarter_plane(0.5);
  p.radial = true;
  p.smooth_length = 0.05;
  p.scale = s.scale(PlaneQuantity::concentration);
  p.amount = [](double) { return 0.3; };
  const auto r = self_test(s, p, 1e-3, 0.02);
  BOOST_TEST(r.worst() < 1e-7, r.balance << ' ' << r.amount);
  p.radial = false;
  p.amount = {};
  BOOST_TEST(self_test(s, p, 1e-3, 0.02).balance > 0.1);  // it does not solve the isotropic reading
  const InstantSource isotropic({0.3, 0.5, 0.01, 0.002});
  p.radial = true;
  p.scale = isotropic.scale(PlaneQuantity::concentration);
  BOOST_TEST(self_test(isotropic, p, 1e-3, 0.02).balance > 0.1);  // nor the other way round
}

BOOST_AUTO_TEST_CASE(central_differences_multiply_a_mode_by_the_factor) {
  constexpr int n = 8;
  const double h = 1.0 / n, d = 2, dt = 0.2 * h * h / d;
  std::vector<std::vector<double>> c(n + 1, std::vector<double>(n + 1));
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j)
      c[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = std::cos(2 * pi * i * h) * std::cos(3 * pi * j * h);
  }
  const auto value = [&](int i, int j) {  // mirrored at the walls
    i = std::abs(i);
    j = std::abs(j);
    return c[static_cast<std::size_t>(i > n ? 2 * n - i : i)][static_cast<std::size_t>(j > n ? 2 * n - j : j)];
  };
  const double sx = std::sin(pi * h), sy = std::sin(1.5 * pi * h),
               factor = ftcs_factor(d * dt / (h * h), sx * sx, sy * sy);
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const double sum = value(i + 1, j) + value(i - 1, j) + value(i, j + 1) + value(i, j - 1) - 4 * value(i, j);
      BOOST_TEST(std::abs(value(i, j) + d * dt / (h * h) * sum - factor * value(i, j)) < 1e-14);
    }
  }
}

BOOST_AUTO_TEST_CASE(bad_parameters_are_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_THROW(InstantSource({0, 1, 1}), std::invalid_argument);
  BOOST_CHECK_THROW(InstantSource({1, 0, 1}), std::invalid_argument);
  BOOST_CHECK_THROW(InstantSource({1, 1, nan}), std::invalid_argument);
  BOOST_CHECK_THROW(InstantSource({1, 1, 1, -1}), std::invalid_argument);
  BOOST_CHECK_THROW(RadialPulse({1, -1, 1}), std::invalid_argument);
  BOOST_CHECK_THROW(CornerSource({0, 1}), std::invalid_argument);
  BOOST_CHECK_THROW(CornerSource({1, nan}), std::invalid_argument);
  BOOST_CHECK_THROW(CosineMode({1, 1, -1, 0, 0, 1, 1}), std::invalid_argument);
  BOOST_CHECK_THROW(CosineMode({1, 0, 1, 0, 0, 1, 1}), std::invalid_argument);
  auto p = manufactured;
  p.strain = 0.011;
  BOOST_CHECK_THROW(ManufacturedVariable{p}, std::invalid_argument);
  p.strain = nan;
  BOOST_CHECK_THROW(ManufacturedVariable{p}, std::invalid_argument);
  const InstantSource instant({1, 1, 1});
  BOOST_CHECK_THROW(instant.concentration(0, 0, 0), std::domain_error);
  BOOST_CHECK_THROW(instant.concentration(-1, 0, 1), std::domain_error);
  const CosineMode mode({1, 1, 1, 1, 0, 1, 1});
  BOOST_CHECK_THROW(mode.concentration(1.1, 0, 1), std::domain_error);
  BOOST_CHECK_THROW(mode.concentration(0.1, nan, 1), std::domain_error);
  BOOST_CHECK_THROW(mode.concentration(0.1, 0, -1), std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()
