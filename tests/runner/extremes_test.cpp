// Extreme numbers: each scene ends with the errors of the ordinary one, of which only the units differ, or is refused
// in words.
#include <fmt/core.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "runner/app/case_file.hpp"
#include "runner/input/leaf.hpp"
#include "runner/run/run_leaf.hpp"
#include "tests/case_text.hpp"
#include "tests/messages.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(extremes)

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;
namespace tt = boost::test_tools;

namespace {

const std::vector<std::string> methods{"fem", "mpm-usf", "mpm-usl", "mpm-musl"};

/// The bar that is pulled at its end by `strain` times E.
std::string bar_text(double E, double rho, double strain, const std::string& cells) {
  std::string text = head("x", "robustness", "paper") + pulled_bar + axes(methods, cells, "0.5") + sampled("0.5, 1.7") +
                     gate("closed", "invariant", "energy.closure", "max = 1.0\n");
  text = replaced(text, "E = 1e4", fmt::format("E = {}", E));
  text = replaced(text, "rho = 1.0", fmt::format("rho = {}", rho));
  return replaced(text, "traction = 1.0", fmt::format("traction = {}", strain * E));
}

/// The standing wave of a square on rollers, after a third of its period in units of L/c.
std::string plate_text(double E, double nu, double rho, double amplitude) {
  const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  const double time = 1.4 / std::sqrt((lambda + 2 * mu) / rho);
  return head("x", "robustness") + plate("1.0", "1.0") +
         elastic(fmt::format("{}", E), fmt::format("{}", nu), fmt::format("{}", rho)) +
         supports("roller", "roller", "roller", "roller") +
         "[model]\nfeatures = [\"elastic\"]\n[exact]\nsolution = \"roller-mode\"\nmode = 1\namplitude = " +
         fmt::format("{}", amplitude) + "\nstart = \"moving\"\n" + axes(methods, "4", "0.5") +
         fmt::format("[sample]\ntimes = {{ unit = \"s\", at = [{}] }}\n", time) +
         gate("closed", "invariant", "energy.closure", "max = 1.0\n");
}

std::vector<reports::Run> runs_of(const std::string& text) {
  const Case c = parse_case(text, "x.toml");
  std::vector<reports::Run> runs;
  for (const Leaf& leaf : leaves(c)) runs.push_back(run_leaf(c, leaf));
  return runs;
}

/// Errors and energies are parts of the scene's own size: those of the ordinary scene, but for round-off.
void expect_the_same(const std::string& text, const std::string& ordinary, double tolerance, const std::string& what) {
  const auto found = runs_of(text), expected = runs_of(ordinary);
  BOOST_REQUIRE(found.size() == methods.size());
  for (std::size_t r = 0; r < found.size(); ++r) {
    const std::string name = what + " " + found[r].label();
    BOOST_REQUIRE_MESSAGE(found[r].status == "completed", name << ": " << found[r].status << ": " << found[r].message);
    BOOST_TEST(found[r].invalid.empty(), name << ": " << found[r].invalid);
    BOOST_TEST(found[r].steps == expected[r].steps, name);
    BOOST_TEST(std::abs(found[r].measures.at("energy.closure")) < 1e-12, name);
    BOOST_REQUIRE(found[r].samples.size() == expected[r].samples.size());
    std::size_t compared = 0;
    for (std::size_t s = 0; s < found[r].samples.size(); ++s) {
      BOOST_REQUIRE(found[r].samples[s].errors.size() == expected[r].samples[s].errors.size());
      for (std::size_t e = 0; e < found[r].samples[s].errors.size(); ++e, ++compared) {
        const auto &own = found[r].samples[s].errors[e], &other = expected[r].samples[s].errors[e];
        BOOST_TEST(own.l2 > 0, name);
        BOOST_TEST(own.l2 == other.l2, tt::tolerance(tolerance));
        BOOST_TEST(own.linf == other.linf, tt::tolerance(tolerance));
      }
    }
    BOOST_TEST(compared > 0u, name);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(bars_of_any_modulus_density_and_strain_have_the_errors_of_the_ordinary_one) {
  const std::string ordinary = bar_text(1e4, 1, 1e-4, "20");
  for (const double E : {1e-12, 1e12})
    for (const double rho : {1e-12, 1e12})
      expect_the_same(bar_text(E, rho, 1e-4, "20"), ordinary, 1e-9, fmt::format("E={} rho={}", E, rho));
  for (const double strain : {1e-16, 1e-150})
    expect_the_same(bar_text(1e4, 1, strain, "20"), ordinary, 1e-9, fmt::format("strain={}", strain));
}

BOOST_AUTO_TEST_CASE(plates_of_any_modulus_density_and_strain_have_the_errors_of_the_ordinary_one) {
  const std::string ordinary = plate_text(1e4, 0.3, 1, 1e-3);
  for (const double E : {1e-12, 1e12})
    for (const double rho : {1e-12, 1e12})
      expect_the_same(plate_text(E, 0.3, rho, 1e-3), ordinary, 1e-9, fmt::format("E={} rho={}", E, rho));
  expect_the_same(plate_text(1e4, 0.3, 1, 1e-16), ordinary, 1e-9, "strain=1e-16");
}

// From auxetic to all but incompressible: the steps are those of the pressure wave, so that their number keeps its
// bound.
BOOST_AUTO_TEST_CASE(plates_of_any_poissons_ratio_take_no_more_steps) {
  for (const double nu : {-0.9999, 0.0, 0.4999999999}) {
    for (const reports::Run& run : runs_of(plate_text(1e4, nu, 1, 1e-3))) {
      const std::string name = fmt::format("nu={} {}", nu, run.label());
      BOOST_REQUIRE_MESSAGE(run.status == "completed", name << ": " << run.message);
      BOOST_TEST(run.steps < 30, name);
      BOOST_TEST(std::abs(run.measures.at("energy.closure")) < 1e-12, name);
      for (const auto& error : run.samples.at(0).errors) BOOST_TEST(error.l2 < 1, name << " " << error.field);
    }
  }
}

BOOST_AUTO_TEST_CASE(what_is_no_solid_is_refused_with_what_is_allowed) {
  for (const auto& [E, nu, rho] :
       {std::array{0.0, 0.3, 1.0}, {-1.0, 0.3, 1.0}, {1e4, 0.5, 1.0}, {1e4, -1.0, 1.0}, {1e4, 0.3, 0.0}})
    BOOST_CHECK_EXCEPTION(parse_case(plate_text(E, nu, rho, 1e-3), "x.toml"), InputError, says({"found", "allowed"}));
  for (const auto& [E, rho] : {std::array{0.0, 1.0}, {1e4, 0.0}, {-1e4, 1.0}})
    BOOST_CHECK_EXCEPTION(parse_case(bar_text(E, rho, 1e-4, "20"), "x.toml"), InputError, says({"found", "allowed"}));
}

BOOST_AUTO_TEST_CASE(one_cell_of_one_particle_runs) {
  for (const reports::Run& run : runs_of(bar_text(1e4, 1, 1e-4, "1"))) {
    BOOST_REQUIRE_MESSAGE(run.status == "completed", run.label() << ": " << run.message);
    BOOST_TEST(run.unknowns == 1, run.label());
    BOOST_TEST(std::abs(run.measures.at("energy.closure")) < 1e-13, run.label());
  }
}

// Ten million steps: round-off walks, and energy does not.
BOOST_AUTO_TEST_CASE(ten_million_steps_keep_the_energy) {
  const std::string text = replaced(
      replaced(replaced(bar_text(1e4, 1, 1e-4, "1"), "[[load]]\nat = \"right\"\nhistory = \"step\"\ntraction = 1\n",
                        "[initial]\nvelocity = \"1\"\n"),
               "[exact]\nsolution = \"bar-wave\"\n", ""),
      "0.5, 1.7", "5000000.0");
  const Case c = parse_case(replaced(text, "energy.closure", "energy.drift"), "x.toml");
  for (const Leaf& leaf : leaves(c)) {
    if (leaf.method == "mpm-usl") continue;  // it damps: nothing is left to look at
    const reports::Run run = run_leaf(c, leaf);
    BOOST_REQUIRE_MESSAGE(run.status == "completed", run.label() << ": " << run.message);
    BOOST_TEST(run.steps == 10'000'000, run.label());
    BOOST_TEST(run.measures.at("energy.drift") < 1e-9, run.label());
  }
}

BOOST_AUTO_TEST_SUITE_END()
