// Diffusion from a held face against its equation, Blasius's function, balances and a plain difference scheme.
#include "analytic/diffusion_front.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "tests/spoiled_plane.hpp"

BOOST_AUTO_TEST_SUITE(diffusion_front)

namespace {

using namespace diptych::analytic;
using boost::test_tools::tolerance;
const double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double blasius = 0.33205733621519630;  // f″(0): Boyd, Exp. Math. 8, 1999

const DiffusionFront constant({1, FrontProfile::constant}), falling({1, FrontProfile::falling}),
    rising({1, FrontProfile::rising});
const FaceFront::Parameters plate{1, 0.3, 2, FrontProfile::falling, -0.03},
    plain_plate{1, 0.3, 2, FrontProfile::constant, -0.03}, rising_plate{1, 0.3, 2, FrontProfile::rising, -0.03};

using At = std::function<double(double, double, double)>;
using Spoiled = diptych::tests::SpoiledPlane;

/// The one value of a concentration.
Spoiled::At of(At at) {
  return [at = std::move(at)](PlaneQuantity, double x, double y, double t) {
    return std::array{at(x, y, t), 0.0, 0.0};
  };
}

/// ∫₀^∞ f dη, over √η, with Simpson's rule.
double integral(const std::function<double(double)>& f) {
  constexpr int parts = 4000;
  const double h = std::sqrt(20.0) / parts;
  double sum = 0;
  for (int i = 0; i <= parts; ++i) {
    const double s = h * i;
    sum += (i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2) * 2 * s * f(s * s);
  }
  return sum * h / 3;
}

}  // namespace

BOOST_AUTO_TEST_CASE(constant_diffusivity) {
  const DiffusionFront front({8, FrontProfile::constant});
  BOOST_TEST(front.value(2 * std::sqrt(8e-6 * 3), 3e-6) == 0.1572992070502851, tolerance(1e-14));  // erfc(1)
  BOOST_TEST(front.value(0, 0) == 1);
  BOOST_TEST(front.value(1e-3, 0) == 0);
  BOOST_TEST(front.level(0.5) == 2 * 0.4769362762044699, tolerance(1e-14));
  BOOST_TEST(front.face_flux() == 1 / std::sqrt(std::numbers::pi), tolerance(1e-15));
  // half of it at 4.5 mm after 2.8 µs, at 6.5 mm (6.5/4.5)² later
  BOOST_TEST(std::abs(front.arrival(4.5e-3, 0.5) - 2.78e-6) < 0.01e-6);
  BOOST_TEST(front.arrival(6.5e-3, 0.5) / front.arrival(4.5e-3, 0.5) == (6.5 / 4.5) * (6.5 / 4.5), tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(falling_diffusivity_is_blasiuss_function) {
  BOOST_TEST(falling.face_flux() == blasius, tolerance(1e-13));
  double f = 0, slope = 0, bend = blasius, worst = 0;
  constexpr double h = 1e-3;
  for (int i = 1; i <= 12000; ++i) {  // classical Runge–Kutta; f‴ = −½ f f″
    const auto third = [](double a, double b) { return -a * b / 2; };
    const double f1 = slope, s1 = bend, b1 = third(f, bend);
    const double f2 = slope + h / 2 * s1, s2 = bend + h / 2 * b1, b2 = third(f + h / 2 * f1, s2);
    const double f3 = slope + h / 2 * s2, s3 = bend + h / 2 * b2, b3 = third(f + h / 2 * f2, s3);
    const double f4 = slope + h * s3, s4 = bend + h * b3, b4 = third(f + h * f3, s4);
    f += h / 6 * (f1 + 2 * f2 + 2 * f3 + f4);
    slope += h / 6 * (s1 + 2 * s2 + 2 * s3 + s4);
    bend += h / 6 * (b1 + 2 * b2 + 2 * b3 + b4);
    const double difference = std::abs(falling.value(f, 1) - (1 - slope));
    if (!(difference <= worst)) worst = difference;
  }
  BOOST_TEST(slope == 1, tolerance(1e-12));
  BOOST_TEST(worst < 1e-12, worst);
}

BOOST_AUTO_TEST_CASE(similarity_equation) {
  for (const DiffusionFront* front : {&constant, &falling}) {
    const bool falls = front->parameters().profile == FrontProfile::falling;
    const auto u = [&](double eta) { return front->value(eta, 1); };
    const auto potential = [&](double eta) { return falls ? u(eta) - u(eta) * u(eta) / 2 : u(eta); };  // ∫d du
    for (int i = 1; i <= 200; ++i) {
      const double eta = 0.02 + 6 * i / 200.0, d = 2e-2 * std::min(1.0, eta);
      const auto first = [&](const auto& f) {
        return (45 * (f(eta + d) - f(eta - d)) - 9 * (f(eta + 2 * d) - f(eta - 2 * d)) + f(eta + 3 * d) -
                f(eta - 3 * d)) /
               (60 * d);
      };
      const double bend =
          (270 * (potential(eta + d) + potential(eta - d)) - 27 * (potential(eta + 2 * d) + potential(eta - 2 * d)) +
           2 * (potential(eta + 3 * d) + potential(eta - 3 * d)) - 490 * potential(eta)) /
          (180 * d * d);
      BOOST_TEST(std::abs(bend + eta / 2 * first(u)) < 1e-7);
    }
    BOOST_TEST(u(0) == 1);
    BOOST_TEST(u(12) < 1e-12);
    // the flux at the face, from ∫d du beside it: (1 − u)²/2 falling, u constant
    const auto flux = [&](double eta) { return ((falls ? 0.5 : 1) - potential(eta)) / eta; };
    BOOST_TEST(flux(1e-5) == front->face_flux(), tolerance(1e-6));
    // what has come in, ∂/∂t ∫u dx = flux: ∫u dη = 2 flux; and ∂/∂t ∫u x dx = ∫d du at the face
    BOOST_TEST(integral(u) == 2 * front->face_flux(), tolerance(1e-10));
    BOOST_TEST(integral([&](double eta) { return eta * u(eta); }) == (falls ? 0.5 : 1), tolerance(1e-10));
  }
}

/// Boussinesq's front: its edge and its flux are in every text on groundwater; beyond the edge there is nothing.
BOOST_AUTO_TEST_CASE(rising_diffusivity_has_an_edge) {
  const double edge = rising.level(1e-9);
  BOOST_TEST(edge == 1.616125447, tolerance(1e-8));
  BOOST_TEST(rising.value(1.61613, 1) == 0);
  BOOST_TEST(rising.value(0, 1) == 1, tolerance(1e-13));
  const auto u = [](double eta) { return rising.value(eta, 1); };
  BOOST_TEST((1 - u(1e-5) * u(1e-5)) / 2e-5 == rising.face_flux(), tolerance(1e-5));
  BOOST_TEST(integral(u) == 2 * rising.face_flux(), tolerance(1e-6));  // the edge is a kink
  BOOST_TEST(integral([&](double eta) { return eta * u(eta); }) == 0.5, tolerance(1e-5));
  for (int i = 1; i < 100; ++i) {  // at the edge −u′ = η_f/2
    const double level = rising.level(i / 100.0);
    BOOST_TEST(u(level) == i / 100.0, tolerance(1e-12));
  }
  BOOST_TEST((u(edge - 1e-5) - u(edge)) / 1e-5 == edge / 2, tolerance(1e-4));
}

BOOST_AUTO_TEST_CASE(plain_differences_come_to_it) {
  const auto worst_of = [](bool falls, int cells) {
    const double h = 6.0 / cells, dt = 0.4 * h * h;
    std::vector<double> u(static_cast<std::size_t>(cells) + 1), flux(u.size());
    u[0] = 1;
    const long steps = std::lround(1 / dt);
    for (long n = 0; n < steps; ++n) {
      for (std::size_t i = 0; i + 1 < u.size(); ++i)
        flux[i] = (falls ? 1 - (u[i] + u[i + 1]) / 2 : 1) * (u[i] - u[i + 1]) / h;
      for (std::size_t i = 1; i + 1 < u.size(); ++i) u[i] += dt / h * (flux[i - 1] - flux[i]);
    }
    const double t = static_cast<double>(steps) * dt;
    double worst = 0;
    for (std::size_t i = 0; i < u.size(); ++i)
      worst = std::max(worst, std::abs(u[i] - (falls ? falling : constant).value(h * static_cast<double>(i), t)));
    return worst;
  };
  for (const bool falls : {false, true}) {
    const double coarse = worst_of(falls, 60), fine = worst_of(falls, 240);
    BOOST_TEST(fine < 0.4 * coarse, coarse << ' ' << fine);
    BOOST_TEST(fine < (falls ? 1e-2 : 1e-4), fine);
  }
}

BOOST_AUTO_TEST_CASE(levels) {
  for (const bool falls : {false, true}) {
    const DiffusionFront front({8, falls ? FrontProfile::falling : FrontProfile::constant});
    double before = 1e9;
    for (const double u : {1e-9, 1e-6, 1e-3, 0.01, 0.1, 0.37, 0.5, 0.9, 0.99, 0.9999, 1 - 1e-9}) {
      const double eta = front.level(u);
      BOOST_TEST(eta < before);
      BOOST_TEST(eta > 0);
      before = eta;
      BOOST_TEST(std::abs(front.value(eta * std::sqrt(8e-6), 1e-6) - u) < 1e-13);
      BOOST_TEST(front.reach(1e-6, u) == eta * std::sqrt(8e-6), tolerance(1e-15));
      BOOST_TEST(front.arrival(front.reach(3e-6, u), u) == 3e-6, tolerance(1e-13));
    }
    BOOST_TEST(front.level(1) == 0);
    BOOST_TEST(front.reach(0, 0.5) == 0);
    BOOST_TEST(front.arrival(0, 0.5) == 0);
    BOOST_TEST(std::isinf(front.arrival(1e-3, 1)));
    double last = 1;
    for (int i = 1; i <= 1000; ++i) {  // it falls all the way, and depends on x/√t alone
      const double x = 2e-5 * i, u = front.value(x, 1e-6);
      BOOST_TEST(u < last);
      BOOST_TEST(u == front.value(4 * x, 16e-6), tolerance(1e-14));
      last = u;
    }
  }
  BOOST_TEST(falling.level(1e-3) == 4.291, tolerance(1e-4));
  BOOST_TEST(constant.level(1e-3) == 4.654, tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(of_a_plate) {
  const FaceFront front(plate);
  BOOST_TEST(front.gives(PlaneQuantity::concentration));
  BOOST_TEST(!front.gives(PlaneQuantity::stress));
  BOOST_TEST(front.scale(PlaneQuantity::concentration) == 0.03);
  const auto value = front.at(PlaneQuantity::concentration, 0.1, 0.2, 1e-2);
  BOOST_TEST(value[0] == -0.03 * DiffusionFront({2, FrontProfile::falling}).value(0.1, 1e-2));
  BOOST_TEST(value[1] == 0);
  BOOST_TEST(front.at(PlaneQuantity::concentration, 0, 0, 1)[0] == -0.03);
  BOOST_TEST(front.reach(1e-2, 0.1) == DiffusionFront({2, FrontProfile::falling}).level(0.1) * std::sqrt(2e-2),
             tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(solves_its_equations) {
  for (const auto& p : {plate, plain_plate}) {
    const auto r = self_test(FaceFront(p), p, 1e-4, 5e-3);
    BOOST_TEST(r.worst() < 1e-7, r.balance << ' ' << r.face << ' ' << r.moment);
    BOOST_TEST(r.points > 1500);
  }
}

BOOST_AUTO_TEST_CASE(the_edge_solves_its_equations) {  // but where the differences reach across it
  const auto r = self_test(FaceFront(rising_plate), rising_plate, 1e-4, 5e-3);
  BOOST_TEST(r.moment < 1e-5);
  BOOST_TEST(r.face < 1e-12);
  BOOST_TEST(r.balance < 0.2, r.balance);
  auto other = rising_plate;
  other.profile = FrontProfile::falling;
  BOOST_TEST(self_test(FaceFront(rising_plate), other, 1e-4, 5e-3).balance > 0.3);
}

BOOST_AUTO_TEST_CASE(self_test_sees_wrong_solutions) {
  for (const auto& p : {plate, plain_plate}) {
    const FaceFront right(p);
    const auto u = [&](double x, double t) {
      return right.at(PlaneQuantity::concentration, std::min(x, 1.0), 0, t)[0];
    };
    const auto spoil = [&](At at) { return self_test(Spoiled(of(std::move(at))), p, 1e-4, 5e-3); };
    BOOST_TEST(spoil([&](double x, double, double t) { return u(x, t); }).worst() < 1e-7);
    BOOST_TEST(spoil([&](double x, double, double t) { return u(x, 1.01 * t); }).moment > 1e-3);
    BOOST_TEST(spoil([&](double x, double, double t) { return u(x, 1.01 * t); }).balance > 1e-4);
    BOOST_TEST(spoil([&](double x, double, double t) { return 0.99 * u(x, t); }).face > 1e-3);
    BOOST_TEST(spoil([&](double x, double y, double t) { return u(x, t) * (1 + 1e-3 * y); }).balance > 1e-5);
    auto other = p;
    other.profile = p.profile == FrontProfile::falling ? FrontProfile::constant : FrontProfile::falling;
    const FaceFront wrong(other);
    const auto r =
        spoil([&](double x, double, double t) { return wrong.at(PlaneQuantity::concentration, x, 0, t)[0]; });
    BOOST_TEST(r.balance > 1e-2);
    BOOST_TEST(r.moment > 0.1);
    BOOST_TEST(std::isnan(spoil([](double, double, double) { return nan_value; }).worst()));
    BOOST_TEST(std::isinf(self_test(right, p, 1e9, 1e9).worst()));  // beyond the plate long since
    BOOST_CHECK_THROW(self_test(right, p, 0, 1), std::invalid_argument);
    BOOST_CHECK_THROW(self_test(right, p, 1, 0.5), std::invalid_argument);
    BOOST_CHECK_THROW(self_test(right, p, nan_value, 1), std::invalid_argument);
  }
}

BOOST_AUTO_TEST_CASE(parameters_out_of_range) {
  BOOST_CHECK_THROW(DiffusionFront({0, FrontProfile::falling}), std::invalid_argument);
  BOOST_CHECK_THROW(DiffusionFront({nan_value, FrontProfile::constant}), std::invalid_argument);
  for (const DiffusionFront* front : {&constant, &falling}) {
    BOOST_CHECK_THROW(front->value(-1, 1), std::domain_error);
    BOOST_CHECK_THROW(front->value(1, -1), std::domain_error);
    BOOST_CHECK_THROW(front->value(nan_value, 1), std::domain_error);
    BOOST_CHECK_THROW(front->value(1, nan_value), std::domain_error);
    BOOST_CHECK_THROW(front->level(0), std::domain_error);
    BOOST_CHECK_THROW(front->level(1.1), std::domain_error);
    BOOST_CHECK_THROW(front->level(nan_value), std::domain_error);
    BOOST_CHECK_THROW(front->reach(-1, 0.5), std::domain_error);
    BOOST_CHECK_THROW(front->arrival(-1, 0.5), std::domain_error);
    BOOST_CHECK_THROW(front->arrival(1, 0), std::domain_error);
  }
  const auto wrong = [](const std::function<void(FaceFront::Parameters&)>& change) {
    auto p = plate;
    change(p);
    BOOST_CHECK_THROW(FaceFront{p}, std::invalid_argument);
  };
  wrong([](auto& p) { p.width = 0; });
  wrong([](auto& p) { p.height = -1; });
  wrong([](auto& p) { p.diffusivity = 0; });
  wrong([](auto& p) { p.value = 0; });
  wrong([](auto& p) { p.value = nan_value; });
  const FaceFront front(plate);
  BOOST_CHECK_THROW(front.at(PlaneQuantity::concentration, 1.1, 0, 0), std::domain_error);
  BOOST_CHECK_THROW(front.at(PlaneQuantity::concentration, 0, 0.4, 0), std::domain_error);
  BOOST_CHECK_THROW(front.at(PlaneQuantity::concentration, 0, 0, nan_value), std::domain_error);
  BOOST_CHECK_THROW(front.at(PlaneQuantity::velocity, 0, 0, 0), std::invalid_argument);
  BOOST_CHECK_THROW(front.scale(PlaneQuantity::stress), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
