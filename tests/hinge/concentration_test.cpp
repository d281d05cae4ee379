#include "hinge/diffusion/concentration.hpp"

#include <algorithm>
#include <array>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "hinge/diffusion/cholesky.hpp"
#include "tests/fields.hpp"

BOOST_AUTO_TEST_SUITE(concentration)

using namespace diptych::diffusion;
using namespace diptych::tests;
namespace tt = boost::test_tools;
namespace bdata = boost::unit_test::data;

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::array every_scheme{Scheme::forward_euler, Scheme::sub_cycled, Scheme::rkl2, Scheme::backward_euler,
                                  Scheme::crank_nicolson};

const char* name(Scheme scheme) {
  constexpr std::array names{"forward Euler", "sub-cycled", "RKL2", "backward Euler", "Crank-Nicolson"};
  return names[static_cast<std::size_t>(scheme)];
}

/// f(x, y) at every node.
template <class F>
std::vector<double> at_nodes(const Grid& g, F f) {
  std::vector<double> values;
  for (int j = 0; j <= g.ny; ++j) {
    for (int i = 0; i <= g.nx; ++i) values.push_back(f(i * g.hx, j * g.hy));
  }
  return values;
}

/// f(x, y) at the middle of every cell.
template <class F>
std::vector<double> at_cells(const Grid& g, F f) {
  std::vector<double> values;
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) values.push_back(f((i + 0.5) * g.hx, (j + 0.5) * g.hy));
  }
  return values;
}

std::vector<double> volumes(const Grid& g) {
  return at_nodes(g, [&](double x, double y) {
    const bool side = x < g.hx / 2 || x > (g.nx - 0.5) * g.hx, end = y < g.hy / 2 || y > (g.ny - 0.5) * g.hy;
    return g.hx * g.hy / ((side ? 2 : 1) * (end ? 2 : 1));
  });
}

void set(Concentration& c, const std::vector<double>& values) { std::ranges::copy(values, c.values().begin()); }

std::vector<double> get(const Concentration& c) { return {c.values().begin(), c.values().end()}; }

std::vector<double> cosine_mode(const Grid& g, int m, int n) {
  return at_nodes(g, [&](double x, double y) {
    return std::cos(m * pi * x / (g.nx * g.hx)) * std::cos(n * pi * y / (g.ny * g.hy));
  });
}

/// What the five-point operator takes from a cosine mode per unit time, divided by the mode: 4 d Σ sin²(kh/2)/h².
double decay(const Grid& g, int m, int n, double d) {
  const double sx = std::sin(m * pi / (2 * g.nx)), sy = std::sin(n * pi / (2 * g.ny));
  return 4 * d * (sx * sx / (g.hx * g.hx) + sy * sy / (g.hy * g.hy));
}

/// What a step leaves of a mode of which the operator takes z in it; of a step of ten limits of forward Euler where the
/// scheme has parts or stages.
double factor(Scheme scheme, double z) {
  switch (scheme) {
    case Scheme::forward_euler: return 1 - z;
    case Scheme::sub_cycled: return std::pow(1 - z / 10, 10);
    case Scheme::rkl2: {  // (s² + s − 2)/4 ≥ 10 asks for 7 stages; R = 1 − b + b P₇(1 − w z)
      const double b = 54.0 / 112, w = 4.0 / 54;
      const double x = 1 - w * z, p = std::legendre(7, std::clamp(x, -1.0, 1.0));
      return 1 - b + b * p;
    }
    case Scheme::backward_euler: return 1 / (1 + z);
    case Scheme::crank_nicolson: break;
  }
  return (1 - z / 2) / (1 + z / 2);
}

/// Root mean square over the nodes that `where` takes.
template <class F, class Where>
double rms_error(const Grid& g, std::span<const double> c, F exact, Where where) {
  double sum = 0;
  int count = 0;
  for (int j = 0; j <= g.ny; ++j) {
    for (int i = 0; i <= g.nx; ++i) {
      const double x = i * g.hx, y = j * g.hy;
      if (!where(x, y)) continue;
      sum += std::pow(c[static_cast<std::size_t>(j * (g.nx + 1) + i)] - exact(x, y), 2);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

const auto everywhere = [](double, double) { return true; };

}  // namespace

// Against another way to build the same operator: cell by cell, each giving half a face to each of its four edges and a
// quarter of itself to each of its nodes. Radial weights are 1/r in the middle of half a face, and exact over a
// quarter.
BOOST_AUTO_TEST_CASE(a_step_is_that_of_the_operator_put_together_cell_by_cell) {
  const Grid g{4, 3, 0.3, 0.5};
  const auto d = random_values(g.cells(), 1), before = random_values(g.nodes(), 2), s = random_values(g.nodes(), 3);
  for (const Reading reading : {Reading::isotropic, Reading::radial}) {
    const bool radial = reading == Reading::radial;
    const auto w = [&](double x, double y) { return radial ? 1 / std::sqrt(x * x + y * y) : 1; };
    const auto integral = [&](double x, double y) {  // of w, from the origin
      const double r = std::sqrt(x * x + y * y);
      const auto part = [](double a, double of) { return a > 0 ? a * std::log(of) : 0; };
      return radial ? part(y, x + r) - part(y, y) + part(x, y + r) - part(x, x) : x * y;
    };
    const double dt = 0.1 * forward_euler_limit(g, 1);
    std::vector<double> inflow(g.nodes(), 0), v(g.nodes(), 0);
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t i = 0; i < 4; ++i) {
        const double x0 = 0.3 * static_cast<double>(i), y0 = 0.5 * static_cast<double>(j), hx = g.hx, hy = g.hy;
        const std::size_t a = j * 5 + i, b = a + 1, e = a + 5, f = e + 1;
        const auto exchange = [&](std::size_t p, std::size_t q, double face) {
          inflow[p] += d[j * 4 + i] * face * (before[q] - before[p]);
          inflow[q] += d[j * 4 + i] * face * (before[p] - before[q]);
        };
        exchange(a, b, hy / 2 / hx * w(x0 + hx / 2, y0 + hy / 4));
        exchange(e, f, hy / 2 / hx * w(x0 + hx / 2, y0 + 3 * hy / 4));
        exchange(a, e, hx / 2 / hy * w(x0 + hx / 4, y0 + hy / 2));
        exchange(b, f, hx / 2 / hy * w(x0 + 3 * hx / 4, y0 + hy / 2));
        const auto quarter = [&](std::size_t node, double x, double y) {
          v[node] +=
              integral(x + hx / 2, y + hy / 2) + integral(x, y) - integral(x, y + hy / 2) - integral(x + hx / 2, y);
        };
        quarter(a, x0, y0);
        quarter(b, x0 + hx / 2, y0);
        quarter(e, x0, y0 + hy / 2);
        quarter(f, x0 + hx / 2, y0 + hy / 2);
      }
    }
    Concentration c(g, Scheme::forward_euler, reading);
    set(c, before);
    c.step(d, s, dt);
    for (std::size_t k = 0; k < g.nodes(); ++k)
      BOOST_TEST(std::abs(c.values()[k] - (before[k] + dt * (inflow[k] / v[k] + s[k]))) < 2e-15);
  }
}

BOOST_AUTO_TEST_CASE(content_changes_by_what_is_fed) {
  for (const Grid& g : {Grid{7, 5, 0.1, 0.1}, Grid{1, 1, 2, 3}, Grid{9, 4, 1e-2, 1}, Grid{1, 12, 0.3, 0.2}}) {
    for (const Scheme scheme : every_scheme) {
      Concentration c(g, scheme);
      set(c, random_values(g.nodes(), 4));
      const double before = c.total(), step = scheme == Scheme::forward_euler ? 0.9 : 40;
      const double dt = step * forward_euler_limit(g, 3);
      const auto s = random_values(g.nodes(), 5, -1 / dt, 2 / dt), v = volumes(g);
      double given = 0, size = before;
      for (int n = 0; n < 50; ++n) {
        c.step(random_values(g.cells(), 10 + static_cast<unsigned>(n), 0, 3), s, dt);
        for (std::size_t k = 0; k < g.nodes(); ++k) {
          given += dt * s[k] * v[k];
          size += std::abs(dt * s[k] * v[k]);
        }
      }
      BOOST_TEST_CONTEXT(name(scheme) << " on " << g.nx << " x " << g.ny) {
        BOOST_TEST(std::abs(c.total() - before - given) < 2e-14 * size);
        BOOST_TEST(std::abs(c.fed() - given) < 2e-14 * size);
      }
    }
  }
}

// The direct solve alone loses several times the whole content at dt d/h² = 1e15.
BOOST_DATA_TEST_CASE(implicit_steps_of_any_length_keep_the_content,
                     bdata::make({1e4, 1e7, 1e8, 1e12, 1e15, 1e18, 1e30}), ratio) {
  for (const Scheme scheme : {Scheme::backward_euler, Scheme::crank_nicolson}) {
    const Grid g{20, 30, 0.05, 0.05};
    Concentration c(g, scheme);
    set(c, random_values(g.nodes(), 6, 0, 2));
    const auto d = random_values(g.cells(), 7, 0.5, 1);
    const double mean = c.total() / 1.5, dt = ratio * 0.05 * 0.05;
    std::vector<double> s(g.nodes(), 0);
    s[0] = 4 / (dt * 0.05 * 0.05);  // adds one to ∫C dA at each step
    BOOST_TEST_CONTEXT(name(scheme)) {
      for (int n = 1; n <= 10; ++n) {
        c.step(d, s, dt);
        BOOST_TEST(c.total() == 1.5 * mean + n, tt::tolerance(1e-13));
        if (scheme == Scheme::backward_euler && ratio > 1e6) {  // all differences are gone but for a part of 1/ratio
          const auto [low, high] = std::ranges::minmax(c.values());
          BOOST_TEST(high - low < 1e-12 + 1e4 / ratio);
        }
      }
    }
  }
}

// Cells of no diffusivity cut off a node, which must then keep its own even where the rest is mixed at once.
BOOST_AUTO_TEST_CASE(a_node_that_is_cut_off_keeps_its_content) {
  const Grid g{8, 8, 1, 1};
  for (const double dt : {1e3, 1e12}) {
    Concentration c(g, Scheme::backward_euler);
    std::vector<double> d(g.cells(), 1), s(g.nodes(), 0);
    for (const std::size_t cell : {0U, 27U, 28U, 35U, 36U}) d[cell] = 0;  // around the corner and around the middle
    set(c, random_values(g.nodes(), 8));
    const double corner = c.values()[0], middle = c.values()[40];
    s[0] = 1 / dt;
    c.step(d, s, dt);
    BOOST_TEST(c.values()[0] == corner + 1, tt::tolerance(1e-13));
    BOOST_TEST(c.values()[40] == middle, tt::tolerance(1e-13));
  }
}

// Every cosine mode of the rectangle, walls included, is an eigenvector of the step; its factor is known for each
// scheme.
BOOST_AUTO_TEST_CASE(a_cosine_mode_shrinks_by_its_factor) {
  for (const Grid& g : {Grid{6, 9, 0.2, 0.2}, Grid{5, 3, 0.2, 0.7}, Grid{1, 1, 1, 1}, Grid{10, 10, 1, 100}}) {
    const double d = 2.5;
    for (const Scheme scheme : every_scheme) {
      const double dt = forward_euler_limit(g, d) * (scheme == Scheme::forward_euler ? 1 : 10);
      for (const auto& [m, n] : {std::pair{0, 0}, {1, 0}, {0, 1}, {g.nx, g.ny}, {g.nx / 2, g.ny - 1}}) {
        const double z = dt * decay(g, m, n, d);
        const double f = factor(scheme, z);
        Concentration c(g, scheme);
        const auto mode = cosine_mode(g, m, n);
        set(c, mode);
        c.step(std::vector<double>(g.cells(), d), std::vector<double>(g.nodes(), 0), dt);
        BOOST_TEST_CONTEXT(name(scheme) << ", mode " << m << ", " << n << " of " << g.nx << " x " << g.ny) {
          for (std::size_t k = 0; k < g.nodes(); ++k) BOOST_TEST(std::abs(c.values()[k] - f * mode[k]) < 2e-14);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_uniform_field_stays_to_the_bit) {
  const Grid g{6, 4, 0.01, 1};
  for (const Scheme scheme : every_scheme) {
    for (const Reading reading : {Reading::isotropic, Reading::radial}) {
      Concentration c(g, scheme, reading);
      set(c, std::vector<double>(g.nodes(), 0.3));
      for (int n = 0; n < 3; ++n) {
        c.step(random_values(g.cells(), 9), std::vector<double>(g.nodes(), 0), 1e-6);
        for (const double v : c.values()) BOOST_TEST(v == 0.3);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(nothing_stays_exactly_nothing) {
  const Grid g{5, 5, 0.1, 0.1};
  for (const Scheme scheme : every_scheme) {
    Concentration c(g, scheme);
    for (int n = 0; n < 3; ++n) c.step(random_values(g.cells(), 9), std::vector<double>(g.nodes(), 0), 1e-3);
    for (const double v : c.values()) BOOST_TEST((v == 0 && !std::signbit(v)));
    BOOST_TEST(c.fed() == 0);
  }
}

BOOST_AUTO_TEST_CASE(without_diffusivity_the_source_alone_acts) {
  const Grid g{5, 4, 0.1, 0.1};
  const auto before = random_values(g.nodes(), 1), s = random_values(g.nodes(), 2);
  for (const Scheme scheme : every_scheme) {
    Concentration c(g, scheme);
    set(c, before);
    c.step(std::vector<double>(g.cells(), 0), std::vector<double>(g.nodes(), 0), 7);
    BOOST_TEST(get(c) == before, tt::per_element());
    c.step(std::vector<double>(g.cells(), 0), s, 7);
    for (std::size_t k = 0; k < g.nodes(); ++k) BOOST_TEST(c.values()[k] == before[k] + 7 * s[k]);
  }
}

// A scene that is mirrored, upside down or on its side gives the same bits there. CHOLMOD's elimination order is none
// of these, so the implicit schemes keep this to round-off only.
BOOST_AUTO_TEST_CASE(mirrored_fields_give_mirrored_bits) {
  const Grid g{6, 6, 0.1, 0.1};
  const auto map = [](const std::vector<double>& values, std::size_t n, int how) {
    std::vector<double> out(values.size());
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t to = how == 0 ? j * n + (n - 1 - i) : how == 1 ? (n - 1 - j) * n + i : i * n + j;
        out[to] = values[j * n + i];
      }
    }
    return out;
  };
  const auto d = random_values(g.cells(), 3), before = random_values(g.nodes(), 4), s = random_values(g.nodes(), 5);
  for (const Scheme scheme : every_scheme) {
    const bool exact = scheme != Scheme::backward_euler && scheme != Scheme::crank_nicolson;
    for (int how = 0; how < 3; ++how) {
      Concentration plain(g, scheme), mirrored(g, scheme);
      set(plain, before);
      set(mirrored, map(before, 7, how));
      for (int n = 0; n < 5; ++n) {
        const double dt = (scheme == Scheme::forward_euler ? 0.7 : 9.3) * forward_euler_limit(g, 1);
        plain.step(d, s, dt);
        mirrored.step(map(d, 6, how), map(s, 7, how), dt);
      }
      BOOST_TEST_CONTEXT(name(scheme) << ", mirror " << how) {
        BOOST_TEST(largest_difference(map(get(plain), 7, how), mirrored.values()) <= (exact ? 0 : 1e-14));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(forward_euler_is_positive_up_to_its_limit_and_refused_above) {
  const Grid g{10, 10, 0.1, 0.1};
  BOOST_TEST(forward_euler_limit(g, 2) == 0.25 * 0.01 / 2, tt::tolerance(1e-15));
  BOOST_TEST(forward_euler_limit({1, 1, 0.1, 10}, 2) == 0.5 * 0.01 / 2 / 1.0001, tt::tolerance(1e-15));
  BOOST_TEST(std::isinf(forward_euler_limit(g, 0)));
  auto d = random_values(g.cells(), 6, 0, 2);
  d[17] = 2;
  const std::vector<double> none(g.nodes(), 0);
  for (const std::size_t at : {0U, 5U, 60U, 120U}) {
    Concentration c(g, Scheme::forward_euler);
    c.values()[at] = 1;
    for (int n = 0; n < 100; ++n) {
      c.step(d, none, 0.25 * 0.01 / 2);
      BOOST_TEST(std::ranges::all_of(c.values(), [](double v) { return v >= 0; }));
    }
    const auto kept = get(c);
    BOOST_CHECK_EXCEPTION(c.step(d, none, 0.2525 * 0.01 / 2), std::invalid_argument, [](const std::exception& e) {
      return std::strstr(e.what(), "0.0012625") && std::strstr(e.what(), "0.00125 ");
    });
    BOOST_TEST(get(c) == kept, tt::per_element());
    BOOST_CHECK_NO_THROW(c.step(d, none, 0.2475 * 0.01 / 2));
  }
  // at the limit the checkerboard swings for ever
  Concentration c(g, Scheme::forward_euler);
  set(c, cosine_mode(g, 10, 10));
  for (int n = 0; n < 1000; ++n) c.step(std::vector<double>(g.cells(), 2), none, 0.25 * 0.01 / 2);
  BOOST_TEST(c.values()[0] == 1.0, tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(sub_cycling_and_rkl2_take_as_many_parts_as_they_must) {
  const Grid g{4, 4, 1, 1};
  const auto nodes = static_cast<long>(g.nodes());
  const std::vector<double> d(g.cells(), 1), none(g.nodes(), 0);
  const double limit = forward_euler_limit(g, 1);
  for (const auto& [ratio, parts, stages] : {std::tuple{0.2, 1, 3},
                                             {1.0, 1, 3},
                                             {1.01, 2, 3},
                                             {2.5, 3, 3},
                                             {2.51, 3, 5},
                                             {7.0, 7, 5},
                                             {7.01, 8, 7},
                                             {124.0, 124, 23}}) {
    Concentration c(g, Scheme::sub_cycled), r(g, Scheme::rkl2);
    c.values()[12] = r.values()[12] = 1;
    c.step(d, none, ratio * limit);
    r.step(d, none, ratio * limit);
    BOOST_TEST(c.node_updates() == parts * nodes);
    BOOST_TEST(r.node_updates() == stages * nodes);
    BOOST_TEST(std::ranges::all_of(c.values(), [](double v) { return v >= 0; }));
  }
}

// r = dΔt/h²: at 1/6 the error of time cancels that of space.
BOOST_AUTO_TEST_CASE(forward_euler_is_of_fourth_order_at_one_sixth) {
  const auto error = [](int n, double r) {
    const Grid g{n, 1, 1.0 / n, 1};
    Concentration c(g, Scheme::forward_euler);
    set(c, at_nodes(g, [](double x, double) { return std::cos(pi * x) + 0.5 * std::cos(2 * pi * x); }));
    const double dt = r / (n * n), end = 0.05;
    const long steps = std::lround(end / dt);
    for (long k = 0; k < steps; ++k) c.step(std::vector<double>(g.cells(), 1), std::vector<double>(g.nodes(), 0), dt);
    const double first = std::exp(-pi * pi * end), second = 0.5 * std::exp(-4 * pi * pi * end);
    return rms_error(
        g, c.values(), [&](double x, double) { return first * std::cos(pi * x) + second * std::cos(2 * pi * x); },
        everywhere);
  };
  BOOST_TEST(std::log2(error(20, 1.0 / 6) / error(40, 1.0 / 6)) == 4, tt::tolerance(0.02));
  BOOST_TEST(std::log2(error(20, 0.2) / error(40, 0.2)) == 2, tt::tolerance(0.02));
}

// In time alone, against the exponential of the operator, which on a cosine mode is a number.
BOOST_AUTO_TEST_CASE(orders_in_time) {
  const Grid g{16, 24, 1.0 / 16, 1.0 / 16};
  const auto mode = cosine_mode(g, 2, 1);
  const double rate = decay(g, 2, 1, 1), end = 0.08;
  const auto error = [&](Scheme scheme, int steps) {
    Concentration c(g, scheme);
    set(c, mode);
    for (int n = 0; n < steps; ++n)
      c.step(std::vector<double>(g.cells(), 1), std::vector<double>(g.nodes(), 0), end / steps);
    return std::abs(c.values()[0] - std::exp(-rate * end));
  };
  for (const auto& [scheme, order] : {std::pair{Scheme::backward_euler, 1.0}, {Scheme::crank_nicolson, 2.0}}) {
    BOOST_TEST_CONTEXT(name(scheme)) {
      BOOST_TEST(std::log2(error(scheme, 64) / error(scheme, 128)) == order, tt::tolerance(0.02));
    }
  }
  // sub-cycling is as fine as its parts; at a whole number of them the order is that of forward Euler
  BOOST_TEST(error(Scheme::sub_cycled, 10) / error(Scheme::sub_cycled, 160) > 1.0);
  // RKL2's error constant depends on the stages: three of them from 2.5 limits of forward Euler down
  const double few = error(Scheme::rkl2, 40), many = error(Scheme::rkl2, 80), more = error(Scheme::rkl2, 160);
  BOOST_TEST(std::log2(few / many) == 2, tt::tolerance(0.03));
  BOOST_TEST(std::log2(many / more) == 2, tt::tolerance(0.03));
}

// A source of q per time in the corner of a quarter plane stands for one of 4q in the whole plane: C = q/(πd)
// E₁(r²/4dt).
BOOST_AUTO_TEST_CASE(corner_source_against_the_exponential_integral) {
  const double d = 2, q = 3, end = 0.01;
  const auto exact = [&](double x, double y) { return -q / (pi * d) * std::expint(-(x * x + y * y) / (4 * d * end)); };
  const auto outside = [](double x, double y) { return x * x + y * y > 0.01; };
  const auto run = [&](int n, Scheme scheme) {
    const Grid g{n, n, 1.0 / n, 1.0 / n};
    Concentration c(g, scheme);
    std::vector<double> s(g.nodes(), 0);
    s[0] = q / (g.hx * g.hy / 4);
    const long steps = n * n / 10;  // r = 0.2
    for (long k = 0; k < steps; ++k) c.step(std::vector<double>(g.cells(), d), s, end / static_cast<double>(steps));
    BOOST_TEST(c.total() == q * end, tt::tolerance(1e-12));
    return rms_error(g, c.values(), exact, outside);
  };
  const double size = rms_error({40, 40, 0.025, 0.025}, std::vector<double>(41 * 41, 0), exact, outside);
  for (const Scheme scheme : {Scheme::forward_euler, Scheme::rkl2}) {
    const double coarse = run(32, scheme), middle = run(64, scheme), fine = run(128, scheme);
    BOOST_TEST_CONTEXT(name(scheme)) {
      BOOST_TEST(std::log2(coarse / middle) == 2, tt::tolerance(0.05));
      BOOST_TEST(std::log2(middle / fine) == 2, tt::tolerance(0.05));
      BOOST_TEST(fine < 1e-3 * size);  // a quarter of the source, or four times it, would be 75 % or 300 % off
    }
  }
}

// C = 1 + cos πx cos πy e⁻ᵗ under a diffusivity that varies in space and time and whose gradient meets the walls.
BOOST_AUTO_TEST_CASE(manufactured_solution_with_varying_diffusivity) {
  const auto diffusivity = [](double x, double y, double t) { return 1 + 0.4 * std::sin(2 * x + y) * std::cos(3 * t); };
  const auto exact = [](double x, double y, double t) {
    return 1 + std::cos(pi * x) * std::cos(pi * y) * std::exp(-t);
  };
  const auto source = [&](double x, double y, double t) {
    const double cx = std::cos(pi * x), cy = std::cos(pi * y), sx = std::sin(pi * x), sy = std::sin(pi * y);
    const double slope = 0.4 * std::cos(2 * x + y) * std::cos(3 * t);  // ∂d/∂(2x + y)
    return std::exp(-t) *
           (-cx * cy + pi * slope * (2 * sx * cy + cx * sy) + 2 * pi * pi * diffusivity(x, y, t) * cx * cy);
  };
  const auto error = [&](int n, Scheme scheme, double ratio) {
    const Grid g{n, n, 1.0 / n, 1.0 / n};
    const double end = 0.1;
    const long steps = std::lround(end * n * n / ratio);
    const double dt = end / static_cast<double>(steps);
    Concentration c(g, scheme);
    set(c, at_nodes(g, [&](double x, double y) { return exact(x, y, 0); }));
    for (long k = 0; k < steps; ++k) {
      const double half = (static_cast<double>(k) + 0.5) * dt;
      c.step(at_cells(g, [&](double x, double y) { return diffusivity(x, y, half); }),
             at_nodes(g, [&](double x, double y) { return source(x, y, half); }), dt);
    }
    return rms_error(
        g, c.values(), [&](double x, double y) { return exact(x, y, end); }, everywhere);
  };
  for (const auto& [scheme, ratio] : {std::pair{Scheme::forward_euler, 0.16},
                                      {Scheme::sub_cycled, 1.0},
                                      {Scheme::rkl2, 1.0},
                                      {Scheme::crank_nicolson, 1.0}}) {
    BOOST_TEST_CONTEXT(name(scheme)) {
      const double coarse = error(10, scheme, ratio), middle = error(20, scheme, ratio),
                   fine = error(40, scheme, ratio);
      BOOST_TEST(std::log2(coarse / middle) == 2, tt::tolerance(0.08));
      BOOST_TEST(std::log2(middle / fine) == 2, tt::tolerance(0.04));
      BOOST_TEST(fine < 5e-3);
    }
  }
}

BOOST_AUTO_TEST_CASE(all_schemes_meet_as_the_step_shrinks) {
  const Grid g{8, 12, 0.125, 0.125};
  const auto d = at_cells(g, [](double x, double y) { return 1 + 0.9 * std::sin(5 * x) * std::cos(4 * y); });
  const auto s = at_nodes(g, [](double x, double y) { return 10 * std::exp(-20 * (x * x + y * y)); });
  const auto start = random_values(g.nodes(), 11);
  const double end = 0.05;
  const auto after = [&](Scheme scheme, int steps) {
    Concentration c(g, scheme);
    set(c, start);
    for (int n = 0; n < steps; ++n) c.step(d, s, end / steps);
    return get(c);
  };
  const auto reference = after(Scheme::crank_nicolson, 8000);  // itself a hundredth as wrong as the schemes of order 2
  for (const auto& [scheme, steps, allowed] : {std::tuple{Scheme::forward_euler, 800, 1e-3},
                                               {Scheme::sub_cycled, 800, 1e-3},
                                               {Scheme::backward_euler, 800, 1e-3},
                                               {Scheme::rkl2, 800, 1e-6},
                                               {Scheme::crank_nicolson, 800, 1e-6}}) {
    const double once = largest_difference(after(scheme, steps), reference);
    const double twice = largest_difference(after(scheme, 2 * steps), reference);
    BOOST_TEST_CONTEXT(name(scheme)) {
      BOOST_TEST(once < allowed);
      BOOST_TEST(std::log2(once / twice) == (allowed < 1e-5 ? 2 : 1), tt::tolerance(0.15));
    }
  }
}

// x = 0 is held at a value of its own and the right end is a wall: quarter waves of the sine are eigenvectors.
BOOST_AUTO_TEST_CASE(a_mode_beside_a_held_side_shrinks_by_its_factor) {
  for (const Grid& g : {Grid{6, 9, 0.2, 0.2}, Grid{5, 3, 0.2, 0.7}, Grid{1, 1, 1, 1}, Grid{40, 1, 0.1, 0.1}}) {
    std::vector<std::size_t> side;
    for (int j = 0; j <= g.ny; ++j) side.push_back(static_cast<std::size_t>(j * (g.nx + 1)));
    const double d = 2.5, h = 0.7;
    for (const Scheme scheme : every_scheme) {
      const double dt = forward_euler_limit(g, d) * (scheme == Scheme::forward_euler ? 1 : 10);
      for (const auto& [m, n] : {std::pair{0, 0}, {0, 1}, {g.nx - 1, g.ny}, {g.nx / 2, g.ny - 1}}) {
        const auto mode = at_nodes(g, [&, m = m, n = n](double x, double y) {
          return std::sin((m + 0.5) * pi * x / (g.nx * g.hx)) * std::cos(n * pi * y / (g.ny * g.hy));
        });
        const double sx = std::sin((m + 0.5) * pi / (2 * g.nx)), sy = std::sin(n * pi / (2 * g.ny));
        const double f = factor(scheme, dt * 4 * d * (sx * sx / (g.hx * g.hx) + sy * sy / (g.hy * g.hy)));
        Concentration c(g, scheme);
        auto start = mode;
        for (double& v : start) v += h;
        set(c, start);
        c.hold(side);
        c.step(std::vector<double>(g.cells(), d), std::vector<double>(g.nodes(), 0), dt);
        BOOST_TEST_CONTEXT(name(scheme) << ", mode " << m << ", " << n << " of " << g.nx << " x " << g.ny) {
          for (std::size_t k = 0; k < g.nodes(); ++k) BOOST_TEST(std::abs(c.values()[k] - h - f * mode[k]) < 4e-14);
        }
      }
    }
  }
}

// Any set of held nodes, any diffusivity: the operator is asked of a forward Euler that holds nothing, which gives
// z u = dt L u, held nodes left out; every scheme is a polynomial or an equation in z.
BOOST_AUTO_TEST_CASE(beside_held_nodes_a_step_is_that_of_the_operator) {
  const Grid g{7, 6, 0.3, 0.2};
  const std::vector<double> none(g.nodes(), 0);
  const std::vector<std::size_t> held{0, 20, 21, 29, 37, 38, 40, 55};  // two corners, pairs side by side and above
  const auto d = random_values(g.cells(), 21), before = random_values(g.nodes(), 22);
  for (const Reading reading : {Reading::isotropic, Reading::radial}) {
    const double small = (reading == Reading::radial ? 0.6 : 1) * forward_euler_limit(g, 1), ratio = 2.4;
    const auto z = [&](const std::vector<double>& u) {
      Concentration c(g, Scheme::forward_euler, reading);
      set(c, u);
      c.step(d, none, small);
      std::vector<double> out(g.nodes(), 0);
      for (std::size_t k = 0; k < out.size(); ++k) {
        if (!std::ranges::binary_search(held, k)) out[k] = ratio * (c.values()[k] - u[k]);
      }
      return out;
    };
    const auto plus = [](std::vector<double> a, double factor, const std::vector<double>& b) {
      for (std::size_t k = 0; k < a.size(); ++k) a[k] += factor * b[k];
      return a;
    };
    const auto after = [&](Scheme scheme, double dt) {
      Concentration c(g, scheme, reading);
      set(c, before);
      c.hold(held);
      c.step(d, none, dt);
      return get(c);
    };
    const double step = ratio * small;
    BOOST_TEST_CONTEXT((reading == Reading::radial ? "radial" : "isotropic")) {
      BOOST_TEST(largest_difference(after(Scheme::forward_euler, small), plus(before, 1 / ratio, z(before))) < 1e-15);
      Concentration parts(g, Scheme::sub_cycled, reading);  // as many as it takes, then those by hand
      set(parts, before);
      parts.hold(held);
      parts.step(d, none, step);
      const double count = static_cast<double>(parts.node_updates()) / static_cast<double>(g.nodes());
      auto by_hand = before;
      for (int i = 0; i < count; ++i) by_hand = plus(by_hand, 1 / count, z(by_hand));
      BOOST_TEST(count > 1);
      BOOST_TEST(largest_difference(get(parts), by_hand) < 2e-15);
      // three stages: R = 1 − b + b P₃(1 + w z)
      const double b = 10.0 / 24, w = 4.0 / 10;
      const auto m = [&](const std::vector<double>& u) { return plus(u, w, z(u)); };
      const auto once = m(before), p = plus(plus(before, -1, before), 2.5, m(m(once)));
      const auto stages = plus(plus(before, -b, before), b, plus(p, -1.5, once));
      BOOST_TEST(largest_difference(after(Scheme::rkl2, step), stages) < 1e-14);
      const auto backward = after(Scheme::backward_euler, step), middle = after(Scheme::crank_nicolson, step);
      BOOST_TEST(largest_difference(backward, plus(before, 1, z(backward))) < 2e-15);
      BOOST_TEST(largest_difference(middle, plus(plus(before, 0.5, z(before)), 0.5, z(middle))) < 2e-15);
    }
  }
}

// Fluxes out of the held nodes against what the others have gained; what the caller changes is the caller's.
BOOST_AUTO_TEST_CASE(held_nodes_feed_what_flows_out_of_them) {
  for (const Reading reading : {Reading::isotropic, Reading::radial}) {
    for (const Grid& g : {Grid{7, 5, 0.1, 0.1}, Grid{1, 1, 2, 3}, Grid{40, 1, 0.1, 0.1}, Grid{9, 4, 1e-2, 1}}) {
      for (const auto& [scheme, drift] : {std::pair{Scheme::forward_euler, 0.0},
                                          {Scheme::sub_cycled, 0.0},
                                          {Scheme::rkl2, 0.0},
                                          {Scheme::backward_euler, 0.0},
                                          {Scheme::backward_euler, 0.2},
                                          {Scheme::crank_nicolson, 0.0}}) {
        Concentration c(g, scheme, reading, drift);
        set(c, random_values(g.nodes(), 4));
        const double dt = (scheme == Scheme::forward_euler ? 0.2 : 10) * forward_euler_limit(g, 3);
        const auto s = random_values(g.nodes(), 5, -1 / dt, 2 / dt);
        const std::vector<std::size_t> held{0, g.nodes() / 2, g.nodes() / 2 + 1};
        c.hold(held);
        double own = c.total(), size = own;
        for (unsigned n = 0; n < 50; ++n) {
          const double before = c.total();
          const auto given = random_values(held.size(), 100 + n, 0, 5);
          for (std::size_t i = 0; i < held.size(); ++i) c.values()[held[i]] = given[i];
          own += c.total() - before;
          const double fed = c.fed(), drawn = c.drawn();
          c.step(random_values(g.cells(), 10 + n, 2.8, 3), s, dt);
          size += std::abs(c.fed() - fed) + std::abs(c.drawn() - drawn);
          for (std::size_t i = 0; i < held.size(); ++i) BOOST_TEST(c.values()[held[i]] == given[i]);
        }
        BOOST_TEST_CONTEXT(name(scheme) << ", drift " << drift << ", " << g.nx << " x " << g.ny) {
          BOOST_TEST(std::abs(c.total() - own - c.fed()) < 3e-14 * size);
          BOOST_TEST(std::abs(c.drawn()) > 1e-3 * size);
          if (drift > 0) BOOST_TEST(c.factorisations() == 1);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(held_nodes_bound_the_others) {
  const Grid g{10, 10, 0.1, 0.1};
  const std::vector<double> none(g.nodes(), 0);
  std::vector<std::size_t> held{12, 13, 60, 120};
  for (const Scheme scheme : {Scheme::forward_euler, Scheme::sub_cycled, Scheme::backward_euler}) {
    Concentration c(g, scheme);
    set(c, std::vector<double>(g.nodes(), 0.5));
    c.hold(held);
    c.values()[12] = 1;
    c.values()[60] = 0;
    const double dt = (scheme == Scheme::forward_euler ? 1 : 9) * forward_euler_limit(g, 2);
    for (unsigned n = 0; n < 200; ++n) {
      auto d = random_values(g.cells(), n, 0, 2);
      d[n % 100] = 2;
      c.step(d, none, dt);
      const auto [low, high] = std::ranges::minmax(c.values());
      BOOST_TEST((low == 0 && high == 1));
    }
    BOOST_TEST(c.values()[1] > 0.6);
    BOOST_TEST(c.values()[61] < 0.4);
  }
}

// Columns of cells without diffusivity cut the grid in two. The left part is held by its side and takes its value as
// the step grows; the right one, which conducts less, keeps its content, and so does an island of one slow cell in
// between; nodes that are cut off keep their bits.
BOOST_DATA_TEST_CASE(implicit_steps_of_any_length_beside_held_nodes,
                     bdata::make({1e2, 1e4, 1e7, 1e8, 1e12, 1e15, 1e18, 1e30}), ratio) {
  for (const Scheme scheme : {Scheme::backward_euler, Scheme::crank_nicolson}) {
    const Grid g{24, 30, 0.05, 0.05};
    Concentration c(g, scheme);
    auto d = random_values(g.cells(), 7, 0.5, 1);
    for (std::size_t cell = 0; cell < d.size(); ++cell) {
      if (cell % 24 > 12) d[cell] /= 2;
      if ((cell % 24 >= 10 && cell % 24 <= 12) || cell == 23) d[cell] = 0;
    }
    d[24 * 5 + 11] = 1 / ratio;
    std::vector<std::size_t> side;
    for (std::size_t j = 0; j <= 30; ++j) side.push_back(25 * j);
    c.hold(side);
    const auto start = random_values(g.nodes(), 6, 0, 2), v = volumes(g);
    set(c, start);
    for (const std::size_t k : side) c.values()[k] = 3;
    const double dt = ratio * 0.05 * 0.05;
    std::vector<double> s(g.nodes(), 0);
    s[100] = 7;                      // is held
    s[25 * 4 + 3] = 1 / dt;          // flows out at the side
    s[25 * 2 + 20] = 4 / (dt * 25);  // adds 4/25 h² to the right part at each step
    const auto is_island = [](std::size_t k) { return (k % 25 == 11 || k % 25 == 12) && (k / 25 == 5 || k / 25 == 6); };
    const auto content = [&](auto of) {
      double sum = 0;
      for (std::size_t k = 0; k < g.nodes(); ++k) {
        if (of(k)) sum += v[k] * c.values()[k];
      }
      return sum;
    };
    const auto is_right = [](std::size_t k) { return k % 25 > 12; };
    const double right = content(is_right), island = content(is_island);
    const double shared =
        ratio > 1e8 ? 1e-13 : 1e-13 + 1e-16 * ratio;  // up to there round-off comes back evenly to both
    BOOST_TEST_CONTEXT(name(scheme)) {
      for (int n = 1; n <= 10; ++n) {
        c.step(d, s, dt);
        BOOST_TEST(content(is_right) == right + n * 4e-4, tt::tolerance(shared));
        BOOST_TEST(content(is_island) == island, tt::tolerance(shared));
        for (std::size_t k = 0; k < g.nodes(); ++k) {
          if (k % 25 == 0) BOOST_TEST(c.values()[k] == 3);
          if (((k % 25 == 11 || k % 25 == 12) && !is_island(k)) || k == 24) BOOST_TEST(c.values()[k] == start[k]);
          if (k % 25 < 11 && scheme == Scheme::backward_euler)
            BOOST_TEST(std::abs(c.values()[k] - 3) < 1e-12 + 1e3 / ratio);
        }
      }
    }
  }
}

// Also how a factor is kept or not: what is loose hangs on the cells that conduct.
BOOST_AUTO_TEST_CASE(a_hold_can_be_changed_and_ended) {
  const Grid g{6, 6, 0.1, 0.1};
  const std::vector<double> none(g.nodes(), 0);
  const auto d = random_values(g.cells(), 12, 0.5, 1);
  for (const Scheme scheme : every_scheme) {
    const double dt = (scheme == Scheme::forward_euler ? 0.9 : 7) * forward_euler_limit(g, 1);
    Concentration changed(g, scheme), fresh(g, scheme), never(g, scheme);
    set(changed, random_values(g.nodes(), 13));
    const double begin = changed.total();
    for (const std::size_t node : {24U, 3U}) {
      changed.hold({40, node, 40, 17, node});
      changed.step(d, none, dt);
    }
    BOOST_TEST(std::abs(changed.total() - begin - changed.drawn()) < 1e-14);
    set(fresh, get(changed));
    fresh.hold({3, 17, 40});
    changed.step(d, none, dt);
    fresh.step(d, none, dt);
    BOOST_TEST(get(changed) == get(fresh), tt::per_element());
    set(never, get(changed));
    changed.hold({});
    changed.step(d, none, dt);
    never.step(d, none, dt);
    BOOST_TEST(get(changed) == get(never), tt::per_element());
    BOOST_TEST(never.drawn() == 0);
    BOOST_CHECK_THROW(changed.hold({3, g.nodes()}), std::invalid_argument);
  }
  Concentration kept(g, Scheme::backward_euler, Reading::isotropic, 0.5);
  kept.hold({0});
  for (const double least : {1e-3, 2e-3, 0.0, 1e-3}) {
    auto open = d;
    open[20] = least;
    kept.step(open, none, 0.1);
  }
  BOOST_TEST(kept.factorisations() == 3);
}

BOOST_AUTO_TEST_CASE(factors_are_kept_while_they_serve) {
  const Grid g{6, 6, 0.1, 0.1};
  const std::vector<double> none(g.nodes(), 0);
  auto d = random_values(g.cells(), 12, 0.5, 1);
  d[20] = 1;
  Concentration exact(g, Scheme::backward_euler), kept(g, Scheme::backward_euler, Reading::isotropic, 0.05);
  for (int n = 0; n < 4; ++n) {
    exact.step(d, none, 0.1);
    kept.step(d, none, 0.1);
  }
  BOOST_TEST(exact.factorisations() == 1);
  BOOST_TEST(kept.factorisations() == 1);
  d[3] += 0.04;
  exact.step(d, none, 0.1);
  kept.step(d, none, 0.1);
  BOOST_TEST(exact.factorisations() == 2);
  BOOST_TEST(kept.factorisations() == 1);
  d[3] += 0.02;  // measured from what was factorised, not from the step before
  kept.step(d, none, 0.1);
  BOOST_TEST(kept.factorisations() == 2);
  kept.step(d, none, 0.2);
  BOOST_TEST(kept.factorisations() == 3);
  BOOST_CHECK_THROW(Concentration(g, Scheme::crank_nicolson, Reading::isotropic, 0.05), std::invalid_argument);
}

// A cell that was cut off and opens by less than the drift would make a stale factor unstable at a long step.
BOOST_AUTO_TEST_CASE(a_stale_factor_stays_stable) {
  const Grid g{10, 10, 0.1, 0.1};
  const std::vector<double> none(g.nodes(), 0);
  std::vector<double> closed(g.cells(), 1), open(g.cells(), 1);
  for (std::size_t cell = 50; cell < 100; ++cell) {
    closed[cell] = 0;
    open[cell] = 0.04;
  }
  Concentration c(g, Scheme::backward_euler, Reading::isotropic, 0.05);
  c.step(closed, none, 10);
  set(c, random_values(g.nodes(), 13));
  for (int n = 0; n < 50; ++n) {
    c.step(open, none, 10);
    const auto [low, high] = std::ranges::minmax(c.values());
    BOOST_TEST((low > -1e-12 && high < 1 + 1e-12));
  }
}

// What a stale factor costs: dt (K − K_f) δ a step, a small part of what backward Euler errs itself.
BOOST_AUTO_TEST_CASE(error_of_a_stale_factor) {
  const Grid g{16, 16, 1.0 / 16, 1.0 / 16};
  const auto start = cosine_mode(g, 1, 2);
  const auto run = [&](Scheme scheme, double drift, int steps) {
    Concentration c(g, scheme, Reading::isotropic, drift);
    set(c, start);
    for (int n = 0; n < steps; ++n) {
      const double t = (n + 1.0) / steps;
      c.step(at_cells(g, [&](double x, double y) { return 1 - 0.5 * t * std::sin(2 * x + y); }),
             std::vector<double>(g.nodes(), 0), 0.04 / steps);
    }
    return std::pair(get(c), c.factorisations());
  };
  const auto truth = run(Scheme::rkl2, 0, 4000).first;
  const auto fresh = run(Scheme::backward_euler, 0, 40);
  const double own = largest_difference(fresh.first, truth);
  BOOST_TEST(fresh.second == 40);
  for (const auto& [drift, most] : {std::pair{0.01, 40L}, {0.05, 11L}}) {
    const auto stale = run(Scheme::backward_euler, drift, 40);
    BOOST_TEST(stale.second <= most);
    BOOST_TEST(largest_difference(stale.first, fresh.first) < drift * own);
  }
  const double coarse = largest_difference(run(Scheme::backward_euler, 0.05, 40).first, fresh.first);
  const double fine =
      largest_difference(run(Scheme::backward_euler, 0.05, 160).first, run(Scheme::backward_euler, 0, 160).first);
  BOOST_TEST(coarse / fine > 3.0);  // of first order in the step, like the scheme
}

BOOST_AUTO_TEST_CASE(what_cannot_be_is_refused) {
  const Grid g{3, 3, 1, 1};
  const std::vector<double> d(g.cells(), 1), s(g.nodes(), 0);
  Concentration c(g, Scheme::sub_cycled);
  auto negative = d;
  negative[4] = -1e-9;
  BOOST_CHECK_THROW(c.step(negative, s, 1), std::invalid_argument);
  BOOST_CHECK_THROW(c.step(std::vector<double>(8, 1), s, 1), std::invalid_argument);
  BOOST_CHECK_THROW(c.step(d, std::vector<double>(9, 1), 1), std::invalid_argument);
  BOOST_CHECK_THROW(c.step(d, s, -1), std::invalid_argument);
  BOOST_CHECK_THROW(c.step(d, s, std::nan("")), std::invalid_argument);
  BOOST_CHECK_THROW(c.step(d, s, 1e30), std::invalid_argument);  // 4e30 parts
  BOOST_CHECK_THROW(Concentration({0, 3, 1, 1}, Scheme::sub_cycled), std::invalid_argument);
  BOOST_CHECK_THROW(Concentration({3, 3, 1, 0}, Scheme::sub_cycled), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(a_diffusivity_that_is_not_a_number_shows) {
  const Grid g{3, 3, 1, 1};
  std::vector<double> d(g.cells(), 1), s(g.nodes(), 0);
  d[8] = std::nan("");
  for (const Scheme scheme : every_scheme) {
    Concentration c(g, scheme);
    c.step(d, s, 0.1);
    BOOST_TEST(std::isnan(c.values()[0]));
    c.step(std::vector<double>(g.cells(), 1), s, 0.1);
    BOOST_TEST(std::isnan(c.values()[0]));
  }
}

BOOST_AUTO_TEST_CASE(cholesky_refuses_an_indefinite_matrix) {
  Cholesky a({0, 2, 3}, {0, 1, 1});
  const auto put = [&](double p, double q, double r) { std::ranges::copy(std::array{p, q, r}, a.entries().begin()); };
  put(4, 2, 5);
  a.factorise();
  const std::array right{2.0, 9.0};
  const auto x = a.solve(right);
  BOOST_TEST(x[0] == -0.5, tt::tolerance(1e-15));
  BOOST_TEST(x[1] == 2.0, tt::tolerance(1e-15));
  put(1, 2, 1);
  BOOST_CHECK_THROW(a.factorise(), std::runtime_error);
  put(4, 2, 5);
  BOOST_CHECK_NO_THROW(a.factorise());
}

// ∂C/∂t = ∂/∂r(d ∂C/∂r): a Gaussian pulse at r₀ spreads as on a line, and is reflected at r = 0.
BOOST_AUTO_TEST_CASE(radial_reading_is_one_dimensional_along_every_ray) {
  const double d = 1, width = 0.08, end = 1.5e-3;
  const auto pulse = [&](double r, double t) {
    const double w = std::sqrt(width * width + 2 * d * t);
    return width / w * std::exp(-r * r / (2 * w * w));
  };
  const auto error = [&](int n, double r0, double from, Reading reading) {
    const Grid g{n, n, 1.0 / n, 1.0 / n};
    Concentration c(g, Scheme::rkl2, reading);
    const auto exact = [&](double x, double y, double t) {
      const double r = std::hypot(x, y);
      return pulse(r - r0, t) + pulse(r + r0, t);
    };
    set(c, at_nodes(g, [&](double x, double y) { return exact(x, y, 0); }));
    const double before = c.total();
    const int steps = n;
    for (int k = 0; k < steps; ++k)
      c.step(std::vector<double>(g.cells(), d), std::vector<double>(g.nodes(), 0), end / steps);
    BOOST_TEST(c.total() == before, tt::tolerance(1e-13));
    return rms_error(
        g, c.values(), [&](double x, double y) { return exact(x, y, end); },
        [&](double x, double y) { return std::hypot(x, y) > from && std::hypot(x, y) < 0.9; });
  };
  for (const auto& [r0, from] : {std::pair{0.5, 0.0}, {0.15, 0.1}}) {
    const double coarse = error(32, r0, from, Reading::radial), middle = error(64, r0, from, Reading::radial),
                 fine = error(128, r0, from, Reading::radial);
    BOOST_TEST_CONTEXT("pulse at " << r0) {
      BOOST_TEST(std::log2(coarse / middle) == 2, tt::tolerance(0.1));
      BOOST_TEST(std::log2(middle / fine) == 2, tt::tolerance(0.05));
      BOOST_TEST(error(64, r0, from, Reading::isotropic) > 20 * middle);  // the readings are not the same
    }
  }
}

BOOST_AUTO_TEST_CASE(radial_content_is_the_integral_over_r) {
  const Grid g{9, 5, 0.1, 0.3};
  Concentration c(g, Scheme::sub_cycled, Reading::radial);
  set(c, std::vector<double>(g.nodes(), 1));
  BOOST_TEST(c.total() == 0.9 * std::asinh(1.5 / 0.9) + 1.5 * std::asinh(0.9 / 1.5), tt::tolerance(1e-13));
  const double before = c.total();
  const auto s = random_values(g.nodes(), 14);
  for (int n = 0; n < 20; ++n) c.step(random_values(g.cells(), 15), s, 0.05);
  BOOST_TEST(c.total() - before == c.fed(), tt::tolerance(1e-13));
  BOOST_TEST(std::ranges::all_of(c.values(), [](double v) { return v > 0; }));
}

BOOST_AUTO_TEST_CASE(parts_that_roll_over_the_rows_have_the_bits_of_parts_one_by_one) {
  for (const Grid& g : {Grid{300, 45, 0.1, 0.2}, Grid{2600, 5, 0.1, 0.1}, Grid{7, 5, 1, 1}, Grid{1, 1, 1, 1}}) {
    const auto d = random_values(g.cells(), 21), everywhere = random_values(g.nodes(), 22);
    std::vector<double> here_and_there = everywhere;
    for (std::size_t k = 0; k < here_and_there.size(); ++k)
      if (k % 11 > 3) here_and_there[k] = 0;
    const double limit = forward_euler_limit(g, *std::ranges::max_element(d));
    for (const auto& source : {std::vector<double>(g.nodes(), 0), here_and_there, everywhere}) {
      for (const long parts : {1L, 2L, 7L, 30L}) {
        for (const bool holds : {false, true}) {
          Concentration rolled(g, Scheme::sub_cycled), one_by_one(g, Scheme::forward_euler);
          const double dt = (static_cast<double>(parts) - 0.5) * limit;
          for (Concentration* c : {&rolled, &one_by_one}) {
            set(*c, random_values(g.nodes(), 23));
            if (holds) c->hold({0, g.nodes() / 2, g.nodes() - 1});
          }
          for (int n = 0; n < 2; ++n) {
            rolled.step(d, source, dt);
            for (long i = 0; i < parts; ++i) one_by_one.step(d, source, dt / static_cast<double>(parts));
          }
          BOOST_TEST(rolled.node_updates() == one_by_one.node_updates());
          BOOST_TEST(rolled.drawn() == one_by_one.drawn());
          BOOST_TEST(std::ranges::equal(std::as_const(rolled).values(), std::as_const(one_by_one).values()),
                     g.nx << " x " << g.ny << " cells, " << parts << " parts");
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(memory_is_counted) {
  const Grid g{40, 60, 1, 1};
  const auto nodes = g.nodes() * sizeof(double);
  const Concentration explicit_one(g, Scheme::sub_cycled);
  BOOST_TEST(explicit_one.bytes() > 6 * nodes);
  BOOST_TEST(explicit_one.bytes() < 10 * nodes);  // 48 numbers to a row of 41 nodes where parts roll
  Concentration implicit_one(g, Scheme::backward_euler);
  implicit_one.step(std::vector<double>(g.cells(), 1), std::vector<double>(g.nodes(), 0), 1);
  BOOST_TEST(implicit_one.bytes() > 20 * nodes);
}

BOOST_AUTO_TEST_SUITE_END()
