#include "hinge/diffusion/dilatancy.hpp"

#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "tests/fields.hpp"

BOOST_AUTO_TEST_SUITE(dilatancy)

using namespace diptych::diffusion;
using namespace diptych::tests;
namespace tt = boost::test_tools;

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::array every_scheme{Scheme::forward_euler, Scheme::sub_cycled, Scheme::rkl2, Scheme::backward_euler,
                                  Scheme::crank_nicolson};
constexpr std::array every_profile{Profile::falling, Profile::constant, Profile::rising};

const char* name(Scheme scheme) {
  constexpr std::array names{"forward Euler", "sub-cycled", "RKL2", "backward Euler", "Crank-Nicolson"};
  return names[static_cast<std::size_t>(scheme)];
}

bool is_implicit(Scheme scheme) { return scheme == Scheme::backward_euler || scheme == Scheme::crank_nicolson; }

/// A step that the scheme takes: below the limit of forward Euler, or ten times as long.
double step(Scheme scheme, const Grid& g, double d) {
  return (scheme == Scheme::forward_euler ? 0.9 : 9.0) * forward_euler_limit(g, d);
}

std::vector<double> get(std::span<const double> values) { return {values.begin(), values.end()}; }

/// `low` in the columns of cells before `column`, `high` from it on.
std::vector<double> columns(const Grid& g, int column, double low, double high) {
  std::vector<double> values;
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) values.push_back(i < column ? low : high);
  }
  return values;
}

/// V_d of a falling profile at V_d,max = 1 beside a face. With V_d = 1 − f′(ξ) where x/√(d0 t) = f(ξ) the equation is
/// that of Blasius' boundary layer, f‴ + f f″/2 = 0, f = f′ = 0 at the wall, f′(∞) = 1: G = 1 − V_d has
/// (G²/2)″ + η G′/2 = 0 in η = x/√(d0 t), which is what von Mises' variables make of it.
class Blasius {
 public:
  Blasius() {
    std::array<double, 3> y{0, 0, slope};
    const auto rate = [](const std::array<double, 3>& at) { return std::array{at[1], at[2], -at[0] * at[2] / 2}; };
    const auto moved = [](std::array<double, 3> from, double by, const std::array<double, 3>& r) {
      for (std::size_t k = 0; k < 3; ++k) from[k] += by * r[k];
      return from;
    };
    const double h = 1e-3;
    for (int i = 0; i < 12000; ++i) {  // Runge and Kutta's
      f_.push_back(y[0]);
      g_.push_back(y[1]);
      const auto a = rate(y), b = rate(moved(y, h / 2, a)), c = rate(moved(y, h / 2, b)), d = rate(moved(y, h, c));
      y = moved(moved(moved(moved(y, h / 6, a), h / 3, b), h / 3, c), h / 6, d);
    }
  }
  double dilatancy(double eta) const {
    const auto above = static_cast<std::size_t>(std::ranges::upper_bound(f_, eta) - f_.begin());
    if (above == f_.size()) return 0;
    const double part = (eta - f_[above - 1]) / (f_[above] - f_[above - 1]);
    return 1 - (g_[above - 1] + part * (g_[above] - g_[above - 1]));
  }
  double far() const { return g_.back(); }

  static constexpr double slope = 0.332057336215196;  ///< f″ at the wall; the content beside the face is 2 f″ √(d0 t)

 private:
  std::vector<double> f_, g_;
};

/// V_d of a rising profile at V_d,max = 1 beside a face, Boussinesq's equation of ground water:
/// (V V′)′ + η V′/2 = 0 in η = x/√(d0 t), V(0) = 1, and a front where V = V V′ = 0. If V is a solution then so is
/// V(βη)/β²: one with the front at 1 is integrated back from there, V = τ/2 − τ²/8 in τ = 1 − η.
class Boussinesq {
 public:
  Boussinesq() {
    double v = 0, flux = 0;  // −V V′
    const auto rates = [](double tau, double at, double of) {
      const double slope = tau > 0 ? of / at : 0.5;
      return std::pair(slope, (1 - tau) / 2 * slope);
    };
    for (int i = 0; i < count; ++i) {  // Runge and Kutta's
      v_.push_back(v);
      const double tau = i * step;
      if (i == 0) {
        v = step / 2 - step * step / 8;
        flux = v * (0.5 - step / 4);
        continue;
      }
      const auto [v1, f1] = rates(tau, v, flux);
      const auto [v2, f2] = rates(tau + step / 2, v + step / 2 * v1, flux + step / 2 * f1);
      const auto [v3, f3] = rates(tau + step / 2, v + step / 2 * v2, flux + step / 2 * f2);
      const auto [v4, f4] = rates(tau + step, v + step * v3, flux + step * f3);
      v += step / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
      flux += step / 6 * (f1 + 2 * f2 + 2 * f3 + f4);
    }
    v_.push_back(v);
  }
  double front() const { return 1 / std::sqrt(v_.back()); }
  double dilatancy(double eta) const {
    const double tau = 1 - eta / front();
    if (tau <= 0) return 0;
    const auto i = std::min(static_cast<std::size_t>(tau / step), v_.size() - 2);
    const double part = tau / step - static_cast<double>(i);
    return (v_[i] + part * (v_[i + 1] - v_[i])) / v_.back();
  }

 private:
  static constexpr int count = 4096;
  static constexpr double step = 1.0 / count;
  std::vector<double> v_;
};

/// From a face at x = 0 that is set off at once, V_d,max = 1: node values of one row at d t = s.
std::vector<double> beside_a_face(Scheme scheme, Profile profile, int n, long steps, double s) {
  const Grid g{n, 1, 1.0 / n, 1e3};
  Dilatancy v({.diffusivity = 2, .profile = profile, .scheme = scheme, .face = 0}, g);
  for (long k = 0; k < steps; ++k) v.advance(std::vector<double>(g.cells(), 1), s / 2 / static_cast<double>(steps));
  BOOST_TEST(std::abs(v.total() - v.fed()) < 1e-13 * v.total());
  return get(v.of_nodes().first(static_cast<std::size_t>(n) + 1));
}

/// d Δt/h² of the schemes below, n² / (144 ratio) steps of which end at d t = 1/144.
double ratio(Scheme scheme) { return scheme == Scheme::forward_euler ? 0.4 : 0.8; }
long steps_of(Scheme scheme, int n) { return std::lround(n * n / 144.0 / ratio(scheme)); }

}  // namespace

// V_d = erfc(x/(2√s)), s = d t. Its node value at the face is 1 from the start, where the odd continuation of
// V_d − 1 has its jump: the grid sees it as h/2 cot(kh/2) = (1 − k²h²/12 …)/k. The steps take
// k² → k² (1 + k² h² (ρ/2 − 1/12)), ρ the ratio of forward Euler, minus that of backward Euler, 0 for the second order
// schemes. So V_d errs by h² (V″/12 + s (1/12 − ρ/2) V⁗) and terms of fourth order.
BOOST_AUTO_TEST_CASE(constant_profile_against_erfc_and_its_predicted_error) {
  const double s = 1.0 / 144;
  for (const Scheme scheme : every_scheme) {
    std::array<double, 2> largest{}, left{};
    for (std::size_t level = 0; level < 2; ++level) {
      const int n = level == 0 ? 48 : 96;
      const auto v = beside_a_face(scheme, Profile::constant, n, steps_of(scheme, n), s);
      const double rho = is_implicit(scheme) ? (scheme == Scheme::backward_euler ? -0.8 : 0)
                                             : (scheme == Scheme::rkl2 ? 0 : 0.4);  // sub-cycled: two parts
      double predicted_largest = 0;
      for (int i = 0; i <= n; ++i) {
        const double h = 1.0 / n, x = i * h;
        const double second = x / (2 * s * std::sqrt(pi * s)) * std::exp(-x * x / (4 * s));
        const double fourth = second * (x * x / (4 * s * s) - 3 / (2 * s));
        const double predicted = h * h * (second / 12 + s * (1.0 / 12 - rho / 2) * fourth);
        const double error = v[static_cast<std::size_t>(i)] - std::erfc(x / (2 * std::sqrt(s)));
        largest[level] = std::max(largest[level], std::abs(error));
        left[level] = std::max(left[level], std::abs(error - predicted));
        predicted_largest = std::max(predicted_largest, std::abs(predicted));
      }
      left[level] /= predicted_largest;
    }
    BOOST_TEST_CONTEXT(name(scheme)) {
      BOOST_TEST(std::log2(largest[0] / largest[1]) == 2, tt::tolerance(0.06));
      BOOST_TEST(left[1] < 0.05);  // of the predicted error
      BOOST_TEST(left[0] / left[1] > 3.8);
    }
  }
}

BOOST_AUTO_TEST_CASE(falling_profile_against_the_boundary_layer_of_blasius) {
  const Blasius exact;
  BOOST_TEST(exact.far() == 1, tt::tolerance(1e-12));
  const double s = 1.0 / 144;
  for (const Scheme scheme : every_scheme) {
    const auto error = [&](int n, double part) {  // at part · s
      const auto v = beside_a_face(scheme, Profile::falling, n,
                                   std::lround(part * static_cast<double>(steps_of(scheme, n))), part * s);
      double largest = 0;
      for (int i = 0; i <= n; ++i) {
        const double e = v[static_cast<std::size_t>(i)] - exact.dilatancy(1.0 * i / n / std::sqrt(part * s));
        largest = std::max(largest, std::abs(e));
      }
      return largest;
    };
    BOOST_TEST_CONTEXT(name(scheme)) {
      const double coarse = error(48, 1), fine = error(96, 1), early = error(96, 0.25);
      const double order = std::log2(coarse / fine);  // d lags by a step, which is of second order in h here
      BOOST_TEST((order > 1.65 && order < 2.05));
      BOOST_TEST(fine < 3e-3);
      BOOST_TEST(early < 4.2 * fine);  // x/√t has half as many cells
    }
  }
}

// To four fifths of the front; at the front itself, where V_d has a kink, the error is of first order.
BOOST_AUTO_TEST_CASE(rising_profile_against_the_front_of_boussinesq) {
  const Boussinesq exact;
  BOOST_TEST(exact.front() == 1.61612544681, tt::tolerance(1e-9));
  const double s = 1.0 / 144, front = exact.front() * std::sqrt(s);
  for (const Scheme scheme : every_scheme) {
    std::array<double, 2> largest{};
    double reached = 0;
    for (std::size_t level = 0; level < 2; ++level) {
      const int n = level == 0 ? 96 : 192;
      const auto v = beside_a_face(scheme, Profile::rising, n, steps_of(scheme, n), s);
      for (int i = 0; i <= n; ++i) {
        const double x = 1.0 * i / n, value = v[static_cast<std::size_t>(i)];
        if (value > 0.01) reached = x;
        if (x > 0.8 * front) continue;
        largest[level] = std::max(largest[level], std::abs(value - exact.dilatancy(x / std::sqrt(s))));
      }
    }
    BOOST_TEST_CONTEXT(name(scheme)) {
      const double order = std::log2(largest[0] / largest[1]);
      BOOST_TEST((order > 1.65 && order < 2.05));
      BOOST_TEST(largest[1] < 7e-3);
      BOOST_TEST(reached == front, tt::tolerance(0.05));
    }
  }
}

// d is that of the step before, so that the falling profile is of first order with any scheme.
BOOST_AUTO_TEST_CASE(orders_in_time) {
  for (const Profile profile : every_profile) {
    for (const Scheme scheme : every_scheme) {
      const auto after = [&](long steps) { return beside_a_face(scheme, profile, 12, steps, 1.0 / 36); };
      const auto few = after(64), many = after(128), more = after(256);
      const bool second = profile == Profile::constant && (scheme == Scheme::rkl2 || scheme == Scheme::crank_nicolson);
      BOOST_TEST_CONTEXT(name(scheme) << ", profile " << static_cast<int>(profile)) {
        const double order = std::log2(largest_difference(few, many) / largest_difference(many, more));
        BOOST_TEST(order == (second ? 2 : 1), tt::tolerance(0.1));
      }
    }
  }
}

// One row of cells is a line: forward Euler of it, written out, to the bit. The ceilings differ from cell to cell and
// step to step and some are zero.
BOOST_AUTO_TEST_CASE(a_strip_is_a_line) {
  const int n = 20;
  const double h = 0.25, d0 = 8, height = 0.125;
  for (const Profile profile : every_profile) {
    for (const bool ahead : {false, true}) {
      const Grid g{n, 1, h, height};
      const bool keeps = !ahead;
      Dilatancy strip({.diffusivity = d0,
                       .profile = profile,
                       .ahead = ahead,
                       .scheme = Scheme::forward_euler,
                       .keeps_largest = keeps,
                       .face = 0},
                      g);
      const double dt = 0.9 * forward_euler_limit(g, d0);
      std::array<double, n + 1> v{};
      double content = 0;
      for (unsigned k = 0; k < 60; ++k) {
        auto ceiling = random_values(n, k, 0.5, 1);
        for (std::size_t i = 1 + k / 3; i < n; ++i) ceiling[i] = 0;  // the front
        if (k % 7 == 3) ceiling[0] = 0;
        strip.advance(ceiling, dt);
        std::array<double, n> face{};
        for (std::size_t i = 0; i < n; ++i) {
          const double cell = 0.25 * ((v[i] + v[i + 1]) + (v[i + 1] + v[i]));
          const double part = cell / ceiling[i];
          const double varies = std::clamp(d0 * (profile == Profile::falling ? 1 - part : part), 0.0, d0);
          const double d = !(ceiling[i] > 0) ? (ahead ? d0 : 0) : profile == Profile::constant ? d0 : varies;
          face[i] = height / (2 * h) * d;
        }
        const double volume = 2 * (h * height / 4), end = h * height / 4;
        if (ceiling[0] > 0 && !(keeps && ceiling[0] <= v[0])) {
          content += 2 * end * (ceiling[0] - v[0]);
          v[0] = ceiling[0];
        }
        auto next = v;
        for (std::size_t i = 1; i < n; ++i)
          next[i] = v[i] + dt / volume * (face[i] * (v[i + 1] - v[i]) - face[i - 1] * (v[i] - v[i - 1]));
        next[n] = v[n] + dt / end * (-(face[n - 1] * (v[n] - v[n - 1])));
        content += 2 * dt * face[0] * (v[0] - v[1]);
        v = next;
        for (std::size_t i = 0; i <= n; ++i) {
          BOOST_TEST(strip.of_nodes()[i] == v[i]);
          BOOST_TEST(strip.of_nodes()[i + n + 1] == v[i]);
        }
        for (std::size_t i = 0; i < n; ++i) BOOST_TEST(strip.of_cells()[i] == 0.25 * ((v[i] + v[i + 1]) * 2));
      }
      BOOST_TEST(strip.fed() == content, tt::tolerance(1e-13));
      BOOST_TEST(v[n / 2] > 0);
    }
  }
}

// The mean of the positive ceilings beside a node, never lowered; a node that has none beside it is an ordinary one.
BOOST_AUTO_TEST_CASE(the_face_holds_the_mean_ceiling_beside_it) {
  const Grid g{2, 4, 1, 2};
  for (const Scheme scheme : every_scheme) {
    Dilatancy v({.diffusivity = 1, .profile = Profile::constant, .scheme = scheme, .keeps_largest = true, .face = 1},
                g);
    const auto at = [&](std::size_t j) { return v.of_nodes()[3 * j + 1]; };
    v.advance(std::vector<double>{0.5, 0, 0.25, 0.75, 0, 0, 0, 0}, 0.1);  // rows of two from the bottom
    BOOST_TEST(at(0) == 0.5);
    BOOST_TEST(at(1) == 0.5);  // (0.5 + 0.25 + 0.75)/3
    BOOST_TEST(at(2) == 0.5);  // (0.25 + 0.75)/2
    BOOST_TEST(at(3) == 0);
    BOOST_TEST(at(4) == 0);
    v.advance(std::vector<double>{0.25, 0, 0.75, 0.75, 0, 0, 0, 0.125}, 0.1);
    BOOST_TEST(at(0) == 0.5);
    BOOST_TEST(at(1) == 1.75 / 3);
    BOOST_TEST(at(2) == 0.75);
    BOOST_TEST(at(3) == 0.125);
    BOOST_TEST(at(4) == 0.125);
    v.advance(std::vector<double>(8, 0.0), 0.1);
    BOOST_TEST(at(0) == 0.5);
    BOOST_TEST(at(4) == 0.125);
    // following the present strain it comes down again, but where there is no ceiling any more it keeps what it holds
    Dilatancy present({.diffusivity = 1, .profile = Profile::constant, .scheme = scheme, .face = 1}, g);
    present.advance(std::vector<double>(8, 0.5), 0.1);
    present.advance(std::vector<double>(8, 0.25), 0.1);
    BOOST_TEST(present.of_nodes()[4] == 0.25);
    BOOST_TEST(std::abs(present.total() - present.fed()) < 1e-14);
    present.advance(std::vector<double>(8, 0.0), 0.1);
    BOOST_TEST(present.of_nodes()[4] == 0.25);
    // where the rest conducts too, a node of the face that is not set off fills up like any other
    Dilatancy open({.diffusivity = 1,
                    .profile = Profile::constant,
                    .ahead = true,
                    .scheme = scheme,
                    .keeps_largest = true,
                    .face = 1},
                   g);
    open.advance(std::vector<double>{0.5, 0, 0, 0, 0, 0, 0, 0}, 0.1);
    open.advance(std::vector<double>{0.5, 0, 0, 0, 0, 0, 0, 0}, 0.1);
    BOOST_TEST(open.of_nodes()[4] == 0.5);
    BOOST_TEST((open.of_nodes()[7] > 0 && open.of_nodes()[7] < 0.1));
    // no face: nothing sets it off; the right-hand wall is a column, too
    Dilatancy none({.scheme = scheme}, g);
    none.advance(std::vector<double>(8, 1), 1e-3);
    BOOST_TEST(none.total() == 0);
    Dilatancy wall({.scheme = scheme, .keeps_largest = true, .face = 2}, g);
    wall.advance(std::vector<double>(8, 0.5), 1e-3);
    for (std::size_t j = 0; j < 5; ++j) BOOST_TEST(wall.of_nodes()[3 * j + 2] == 0.5);
  }
}

// A column that is set off node by node: those that are not yet fill up from their neighbours until then.
BOOST_AUTO_TEST_CASE(what_the_face_and_the_start_have_fed_is_there) {
  const Grid g{9, 6, 0.1, 0.07};
  for (const Profile profile : every_profile) {
    for (const auto& [scheme, drift] : {std::pair{Scheme::forward_euler, 0.0},
                                        {Scheme::sub_cycled, 0.0},
                                        {Scheme::rkl2, 0.0},
                                        {Scheme::backward_euler, 0.0},
                                        {Scheme::backward_euler, 0.3},
                                        {Scheme::crank_nicolson, 0.0}}) {
      Dilatancy v({.diffusivity = 5,
                   .profile = profile,
                   .ahead = true,
                   .scheme = scheme,
                   .drift = drift,
                   .start = random_values(g.nodes(), 3, 0, 0.1),
                   .keeps_largest = true,
                   .face = 4},
                  g);
      const double begin = v.total();
      double before = 0;
      for (unsigned n = 0; n < 60; ++n) {
        auto ceiling = random_values(g.cells(), n, 0.4, 0.8);
        for (std::size_t cell = 0; cell < ceiling.size(); ++cell) {
          if (cell / 9 > n / 8 || cell % 5 == n % 5) ceiling[cell] = 0;
        }
        v.advance(ceiling, step(scheme, g, 5));
        BOOST_TEST_CONTEXT(name(scheme) << ", drift " << drift << ", step " << n) {
          BOOST_TEST(std::abs(v.total() - v.fed()) < 2e-14 * v.total());
          if (n == 0) BOOST_TEST(v.fed() > begin);
        }
        if (scheme != Scheme::crank_nicolson && scheme != Scheme::rkl2) BOOST_TEST(v.total() > before);
        before = v.total();
      }
      BOOST_TEST(v.total() > 5 * begin);
    }
  }
}

// With the face in the middle, left to right and upside down.
BOOST_AUTO_TEST_CASE(mirrored_ceilings_give_mirrored_bits) {
  const Grid g{8, 5, 0.1, 0.2};
  const auto map = [](const std::vector<double>& values, std::size_t width, bool sideways) {
    std::vector<double> out(values.size());
    const std::size_t height = values.size() / width;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const std::size_t i = k % width, j = k / width;
      out[sideways ? j * width + (width - 1 - i) : (height - 1 - j) * width + i] = values[k];
    }
    return out;
  };
  for (const Scheme scheme : every_scheme) {
    for (const bool sideways : {true, false}) {
      const Spread spread{.diffusivity = 3, .scheme = scheme, .face = 4};
      Dilatancy plain(spread, g), mirrored(spread, g);
      for (unsigned n = 0; n < 20; ++n) {
        auto ceiling = random_values(g.cells(), n, -0.2, 1);
        for (double& c : ceiling) c = std::max(c, 0.0);
        plain.advance(ceiling, step(scheme, g, 3));
        mirrored.advance(map(ceiling, 8, sideways), step(scheme, g, 3));
      }
      BOOST_TEST_CONTEXT(name(scheme) << (sideways ? ", sideways" : ", upside down")) {
        const double allowed = is_implicit(scheme) ? 1e-14 : 0;  // CHOLMOD's order of elimination is not mirrored
        BOOST_TEST(largest_difference(map(get(plain.of_nodes()), 9, sideways), mirrored.of_nodes()) <= allowed);
        BOOST_TEST(largest_difference(map(get(plain.of_cells()), 8, sideways), mirrored.of_cells()) <= allowed);
        BOOST_TEST(plain.of_nodes()[0] > 0);
      }
    }
  }
}

// Ceilings that stay: the front of the diffusion only ever moves on, and what it brings comes from the face.
BOOST_AUTO_TEST_CASE(dilatancy_never_falls_nor_exceeds_the_face) {
  const Grid g{12, 6, 0.1, 0.1};
  for (const Profile profile : every_profile) {
    for (const Scheme scheme : {Scheme::forward_euler, Scheme::sub_cycled, Scheme::backward_euler}) {
      // constant: what fills up at different heights; falling: one ceiling, or the cells of a low one would shut
      auto ceiling = profile == Profile::constant ? random_values(g.cells(), 5, 0.4, 0.8) : columns(g, 12, 0.75, 0);
      if (profile == Profile::constant) ceiling[17] = ceiling[30] = ceiling[31] = 0;
      Dilatancy v({.diffusivity = 2, .profile = profile, .scheme = scheme, .face = 3}, g);
      auto before = get(v.of_nodes());
      // At a longer step the d of the step before, d0 at first, lets through more than the falling one then keeps.
      const double dt = step(profile == Profile::falling ? Scheme::forward_euler : scheme, g, 2);
      for (int n = 0; n < 150; ++n) {
        v.advance(ceiling, dt);
        const auto now = get(v.of_nodes());
        double face = 0;
        for (std::size_t j = 0; j <= 6; ++j) face = std::max(face, now[13 * j + 3]);
        BOOST_TEST_CONTEXT(name(scheme) << ", profile " << static_cast<int>(profile) << ", step " << n) {
          for (std::size_t k = 0; k < now.size(); ++k) {
            BOOST_TEST(now[k] >= before[k] - 1e-15);
            BOOST_TEST(now[k] <= face + 1e-15);
          }
        }
        before = now;
      }
      BOOST_TEST(before[12] > 0.05);
    }
  }
}

// The shock has passed the columns of cells before `front`. The nodes up to its own column may have something, those
// beyond it exactly nothing; so has every cell ahead but those beside the front, which show half of their two nodes.
BOOST_AUTO_TEST_CASE(nothing_is_ahead_of_the_shock) {
  const Grid g{16, 3, 0.1, 0.1};
  for (const Profile profile : every_profile) {
    for (const Scheme scheme : every_scheme) {
      Dilatancy v({.diffusivity = 2, .profile = profile, .scheme = scheme, .face = 0}, g);
      for (int front = 1; front < 16; ++front) {
        auto ceiling = columns(g, front, 0.75, 0);
        for (int k = 0; k < 3; ++k) v.advance(ceiling, step(scheme, g, 2));
        for (std::size_t k = 0; k < g.nodes(); ++k) {
          const double value = v.of_nodes()[k];
          if (static_cast<int>(k % 17) > front) BOOST_TEST((value == 0 && !std::signbit(value)));
          if (static_cast<int>(k % 17) == front && profile == Profile::constant) BOOST_TEST(value != 0);
        }
        for (std::size_t cell = 0; cell < g.cells(); ++cell) {
          const int i = static_cast<int>(cell % 16);
          if (i > front) BOOST_TEST(v.of_cells()[cell] == 0);
          if (i != front) continue;
          const std::size_t left = cell + cell / 16;
          BOOST_TEST(v.of_cells()[cell] == 0.25 * (v.of_nodes()[left] + v.of_nodes()[left + 17]));
        }
      }
    }
  }
}

// Where the ceilings fall to zero what is there stays, to the bit; between cells that keep theirs it goes on spreading.
BOOST_AUTO_TEST_CASE(what_is_there_stays_at_release) {
  const Grid g{10, 4, 0.1, 0.1};
  for (const Profile profile : every_profile) {
    for (const Scheme scheme : every_scheme) {
      Dilatancy v({.diffusivity = 2, .profile = profile, .scheme = scheme, .face = 0}, g);
      const double dt = step(scheme, g, 2);
      for (int n = 0; n < (profile == Profile::rising ? 100 : 40); ++n) v.advance(columns(g, 10, 0.75, 0), dt);
      const auto before = get(v.of_nodes());
      for (int n = 0; n < 5; ++n) v.advance(columns(g, 6, 0.75, 0), dt);
      double moved = 0;
      for (std::size_t k = 0; k < before.size(); ++k) {
        if (k % 11 > 6) BOOST_TEST(v.of_nodes()[k] == before[k]);
        if (k % 11 > 0 && k % 11 <= 6) moved = std::max(moved, v.of_nodes()[k] - before[k]);
      }
      BOOST_TEST(moved > 1e-4);
      BOOST_TEST(before[7] > 1e-3);
      const auto all = get(v.of_nodes());
      const long updates = v.node_updates();
      for (int n = 0; n < 5; ++n) v.advance(columns(g, 10, 0, 0), dt);
      BOOST_TEST(get(v.of_nodes()) == all, tt::per_element());
      BOOST_TEST(v.node_updates() == updates);
    }
  }
}

// A start that is above, at and below its ceiling: d is zero, zero and half of d0; by hand for two cells.
BOOST_AUTO_TEST_CASE(the_start_gives_the_first_diffusivity) {
  const Grid g{2, 1, 1, 1};
  const std::vector<double> start{0.5, 0.0, 0.5, 0.5, 0.0, 0.5};  // 1/4 in both cells
  Dilatancy v({.diffusivity = 0.25, .scheme = Scheme::forward_euler, .start = start}, g);
  BOOST_TEST(get(v.of_cells()) == (std::vector{0.25, 0.25}), tt::per_element());
  BOOST_TEST(v.fed() == 0.5);
  v.advance(std::vector<double>{0.125, 0.5}, 0.5);
  // the right cell conducts: face d/2 = 1/16, quarter of a cell at the end and half of one in the middle
  const std::array expected{0.5, 0.0 + 0.5 / 0.5 / 16 * 0.5, 0.5 - 0.5 / 0.25 / 16 * 0.5};
  for (std::size_t k = 0; k < 6; ++k) BOOST_TEST(v.of_nodes()[k] == expected[k % 3]);
  BOOST_TEST(v.of_cells()[0] == (expected[0] + expected[1]) / 2);
  BOOST_TEST(v.total() == v.fed(), tt::tolerance(1e-15));
  Dilatancy ahead({.diffusivity = 0.25, .ahead = true, .scheme = Scheme::forward_euler, .start = start}, g);
  ahead.advance(std::vector<double>{0, 0.25}, 0.5);  // all of d0, and none
  // below zero, where a scheme that is not positive may end up, d is d0 and no more
  const Spread below{.diffusivity = 0.25, .scheme = Scheme::forward_euler, .start = {-0.5, 0.0, 0.0, -0.5, 0.0, 0.0}};
  Dilatancy under(below, g);
  under.advance(std::vector<double>{0.5, 0.5}, 0.5);
  BOOST_TEST(under.of_nodes()[0] == -0.5 + 0.5 / 0.25 / 8 * 0.5);
  const std::array left{0.5 - 0.5 / 0.25 / 8 * 0.5, 0.5 / 0.5 / 8 * 0.5, 0.5};
  for (std::size_t k = 0; k < 6; ++k) BOOST_TEST(ahead.of_nodes()[k] == left[k % 3]);
}

BOOST_AUTO_TEST_CASE(a_ceiling_that_is_not_a_number_shows) {
  const Grid g{6, 3, 0.1, 0.1};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Profile profile : every_profile) {
    for (const Scheme scheme : every_scheme) {
      for (const int healthy : {0, 4}) {
        for (const std::size_t at : {0U, 17U}) {  // beside the face and away from it
          Dilatancy v({.diffusivity = 2, .profile = profile, .scheme = scheme, .face = 0}, g);
          for (int n = 0; n < healthy; ++n) v.advance(columns(g, 3, 0.5, 0), step(scheme, g, 2));
          auto ceiling = columns(g, 3, 0.5, 0);
          ceiling[at] = nan;
          for (int n = 0; n < 2; ++n) {
            v.advance(ceiling, step(scheme, g, 2));
            for (const double value : v.of_nodes()) BOOST_TEST(std::isnan(value));
            for (const double value : v.of_cells()) BOOST_TEST(std::isnan(value));
            ceiling[at] = 0.75;  // it stays so
          }
          BOOST_TEST(std::isnan(v.total()));
        }
      }
      Dilatancy idle({.diffusivity = 2, .profile = profile, .scheme = scheme}, g);  // with nothing to diffuse
      auto ceiling = columns(g, 6, 0, 0);
      ceiling[7] = nan;
      idle.advance(ceiling, step(scheme, g, 2));
      ceiling[7] = 0;
      idle.advance(ceiling, step(scheme, g, 2));
      for (const double value : idle.of_cells()) BOOST_TEST(std::isnan(value));
    }
  }
}

BOOST_AUTO_TEST_CASE(nothing_costs_nothing) {
  const Grid g{6, 3, 0.1, 0.1};
  for (const Scheme scheme : every_scheme) {
    Dilatancy v({.diffusivity = 2, .scheme = scheme, .face = 0}, g);
    for (int n = 0; n < 5; ++n) v.advance(columns(g, 6, 0, 0), 1);
    v.advance(columns(g, 3, 0, 0.5), 1);  // away from the face: nothing to spread
    BOOST_TEST(v.node_updates() == 0);
    BOOST_TEST(v.total() == 0);
    BOOST_TEST(v.fed() == 0);
    for (const double value : v.of_cells()) BOOST_TEST((value == 0 && !std::signbit(value)));
    v.advance(columns(g, 1, 0.5, 0), step(scheme, g, 2));
    BOOST_TEST(v.node_updates() > 0);
    // without diffusivity the face alone has it
    Dilatancy still({.diffusivity = 0, .scheme = scheme, .face = 0}, g);
    for (int n = 0; n < 5; ++n) still.advance(columns(g, 6, 0.5, 0), 1);
    BOOST_TEST(still.node_updates() == 0);
    for (std::size_t k = 0; k < g.nodes(); ++k) BOOST_TEST(still.of_nodes()[k] == (k % 7 == 0 ? 0.5 : 0));
    BOOST_TEST(still.fed() == still.total());
    BOOST_TEST(still.total() == 0.5 * 0.05 * 0.3, tt::tolerance(1e-15));
  }
}

// Twice the lengths and four times the diffusivity, or a quarter of it and four times the time: the same bits.
BOOST_AUTO_TEST_CASE(scales_with_powers_of_two) {
  for (const Profile profile : every_profile) {
    for (const Scheme scheme : every_scheme) {
      const auto run = [&](double length, double diffusivity, double time) {
        const Grid g{9, 4, 0.1 * length, 0.07 * length};
        Dilatancy v({.diffusivity = 2 * diffusivity, .profile = profile, .scheme = scheme, .face = 2}, g);
        const double dt = step(scheme, {9, 4, 0.1, 0.07}, 2) * time;
        for (unsigned n = 0; n < 10; ++n) v.advance(random_values(g.cells(), n, 0.3, 0.9), dt);
        return std::pair(get(v.of_nodes()), v.fed() / (length * length));
      };
      const auto once = run(1, 1, 1);
      BOOST_TEST((run(2, 4, 1) == once));
      BOOST_TEST((run(1, 0.25, 4) == once));
      BOOST_TEST(once.first[9] > 0);
    }
  }
}

// Twice as much of everything is twice as much: only V_d/V_d,max matters.
BOOST_AUTO_TEST_CASE(scales_with_the_ceiling) {
  const Grid g{9, 4, 0.1, 0.07};
  for (const Scheme scheme : every_scheme) {
    const auto run = [&](double scale) {
      Dilatancy v({.diffusivity = 2, .scheme = scheme, .face = 2}, g);
      for (unsigned n = 0; n < 10; ++n)
        v.advance(random_values(g.cells(), n, 0.3 * scale, 0.9 * scale), step(scheme, g, 2));
      return get(v.of_nodes());
    };
    auto twice = run(1);
    for (double& v : twice) v *= 0.0078125;
    BOOST_TEST(run(0.0078125) == twice, tt::per_element());
  }
}

BOOST_AUTO_TEST_CASE(what_cannot_be_is_refused) {
  const Grid g{3, 2, 1, 1};
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double d : {-1.0, infinity, std::nan("")})
    BOOST_CHECK_THROW(Dilatancy({.diffusivity = d}, g), std::invalid_argument);
  for (const int face : {-1, 4}) BOOST_CHECK_THROW(Dilatancy({.face = face}, g), std::invalid_argument);
  BOOST_CHECK_NO_THROW(Dilatancy({.face = 3}, g));
  BOOST_CHECK_THROW(Dilatancy({.scheme = Scheme::crank_nicolson, .drift = 0.1}, g), std::invalid_argument);
  BOOST_CHECK_THROW(Dilatancy({.start = std::vector<double>(11, 0.5)}, g), std::invalid_argument);
  Dilatancy v({.diffusivity = 1, .scheme = Scheme::forward_euler, .face = 0}, g);
  BOOST_CHECK_THROW(v.advance(std::vector<double>(5, 1), 0.1), std::invalid_argument);
  BOOST_CHECK_THROW(v.advance(std::vector<double>{1, 1, 1, 1, 1, -1e-9}, 0.1), std::invalid_argument);
  BOOST_CHECK_THROW(v.advance(std::vector<double>(6, 1), 0.3), std::invalid_argument);  // the limit is 1/4
  BOOST_CHECK_THROW(v.advance(std::vector<double>(6, 1), -1), std::invalid_argument);
  BOOST_CHECK_NO_THROW(v.advance(std::vector<double>(6, 1), 0.2));
}

// The largest d counts, which is that of the cells and not d0.
BOOST_AUTO_TEST_CASE(sub_cycling_takes_as_many_parts_as_the_largest_diffusivity_asks_for) {
  const Grid g{6, 1, 1, 1};
  Dilatancy v({.diffusivity = 4, .scheme = Scheme::sub_cycled, .start = std::vector<double>(14, 0.75)}, g);
  v.advance(std::vector<double>(6, 1), 3.9 / 4);  // d = 1: 3.9 limits of forward Euler
  BOOST_TEST(v.node_updates() == 4 * 14);
}

BOOST_AUTO_TEST_CASE(memory_is_counted) {
  const Grid g{40, 60, 1, 1};
  const Dilatancy v({.face = 0}, g);
  const Concentration c(g, Scheme::sub_cycled);
  const std::size_t own = (2 * g.cells() + g.nodes()) * sizeof(double) + 61;
  BOOST_TEST(v.bytes() == c.bytes() + own);
}

BOOST_AUTO_TEST_SUITE_END()
