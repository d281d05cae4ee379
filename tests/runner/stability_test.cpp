// Stability about rest: growth by a fit, limits by bisection, the scene that is looked at, and what is said of it.
#include "runner/stability/stability.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "reports/stability_table.hpp"
#include "runner/app/case_file.hpp"
#include "runner/app/catalogue.hpp"
#include "runner/input/leaf.hpp"
#include "runner/panel.hpp"
#include "runner/stability/about_rest.hpp"
#include "runner/stability/at_rest.hpp"
#include "runner/stability/bracket.hpp"
#include "runner/stability/stability_figure.hpp"
#include "tests/case_text.hpp"
#include "tests/messages.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(stability)

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;
using reports::StabilityLimit;
using reports::StabilityMap;
namespace tt = boost::test_tools;

namespace {

std::vector<double> series(int count, double (*value)(double)) {
  std::vector<double> all;
  for (int n = 0; n < count; ++n) all.push_back(value(n));
  return all;
}

Case bar_case(const std::vector<std::string>& methods, const std::string& cells) {
  return parse_case(head("s", "robustness", "paper") + pulled_bar + axes(methods, cells, "0.5") + sampled("0.5") +
                        gate("near", "exact", "displacement.L2", "max = 1.0\n"),
                    "s.toml");
}

Case plate_case(const std::string& sides, const std::string& more = "") {
  return parse_case(head("s", "robustness") + plate("1.0", "1.0") + elastic("1e4", "0.3", "1.0") +
                        supports(sides, sides, sides, sides) + "[model]\nfeatures = [\"elastic\"]\n" + more +
                        axes({"fem"}, "6", "0.5") + "[sample]\ntimes = { unit = \"s\", at = [0.01] }\n" +
                        gate("closed", "invariant", "energy.closure", "max = 1.0\n"),
                    "s.toml");
}

Case diffusion_case(const std::string& scheme) {
  return parse_case(head("s", "robustness") + plate("1.0", "1.0") + "[diffusion]\ndiffusivity = \"2\"\nscheme = \"" +
                        scheme + "\"\n[initial]\nconcentration = \"1 + x\"\n[model]\nfeatures = [\"diffusion\"]\n" +
                        axes({"diffusion"}, "8", "0.2") + "[sample]\ntimes = { unit = \"s\", at = [0.01] }\n" +
                        gate("kept", "invariant", "concentration.balance", "max = 1.0\n"),
                    "s.toml");
}

StabilityMap found(const Case& c, const std::vector<std::string>& over = {}) {
  StabilityPlan plan;
  plan.over = over;
  return stability_map(c, plan);
}

StabilityLimit made(double at, double limit, std::optional<double> theory) {
  StabilityLimit one;
  one.label = "fem N=8 material.nu=" + std::to_string(at);
  one.setting = "fem N=8";
  one.method = "fem";
  one.at = at;
  one.stable = 0.9995 * limit;
  one.unstable = 1.0005 * limit;
  one.growth_below = 1e-6;
  one.growth_above = 0.01;
  one.theory = theory;
  return one;
}

StabilityMap made_map() {
  StabilityMap map{"c", "A title", "Courant number c Δt/h", "material.nu", "2000 steps", "motions", "10-fold", 1e-3,
                   8,   {}};
  map.limits = {made(0.3, 0.5, 0.5), made(0.49999, 0.6, 0.6)};
  return map;
}

}  // namespace

// ---- growth ----

BOOST_AUTO_TEST_CASE(growth_is_the_slope_of_the_log_of_amplitudes) {
  const Growth growing =
      growth_of(series(2000, [](double n) { return std::exp(0.01 * n) * (1.5 + std::sin(0.7 * n)); }), 1, 2000);
  BOOST_TEST(growing.unstable);
  BOOST_TEST(*growing.rate == 0.005, tt::tolerance(1e-2));
  // Samples ten steps apart are of the same growth.
  const Growth sampled = growth_of(series(200, [](double n) { return std::exp(0.1 * n); }), 10, 2000);
  BOOST_TEST(*sampled.rate == 0.005, tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(what_keeps_its_bound_or_fades_is_stable) {
  const Growth exchanged = growth_of(series(2000, [](double n) { return 5 + 4.9 * std::sin(0.05 * n); }), 1, 2000);
  BOOST_TEST(!exchanged.unstable);
  BOOST_TEST(std::abs(*exchanged.rate) < 1e-4);
  const Growth fading = growth_of(series(2000, [](double n) { return std::exp(-0.02 * n); }), 1, 2000);
  BOOST_TEST(!fading.unstable);
  BOOST_TEST(*fading.rate == -0.01, tt::tolerance(1e-6));
  const Growth faded = growth_of(std::vector<double>(100, 0.0), 1, 100);
  BOOST_TEST(!faded.unstable);
  BOOST_TEST(!faded.rate);
}

BOOST_AUTO_TEST_CASE(growth_is_unstable_beyond_tenfold_over_the_look_ahead) {
  const auto rising = [](double per_step) {
    std::vector<double> energies;
    for (int n = 0; n < 1000; ++n) energies.push_back(std::exp(per_step * n));
    return energies;
  };
  const double edge = std::log(growth_of_instability) / 1000;
  BOOST_TEST(!growth_of(rising(0.99 * edge), 1, 1000).unstable);
  BOOST_TEST(growth_of(rising(1.01 * edge), 1, 1000).unstable);
  // It is the second half that counts: what has come to rest no longer grows.
  BOOST_TEST(!growth_of(series(1000, [](double n) { return std::exp(0.1 * std::min(n, 400.0)); }), 1, 1000).unstable);
}

// ---- bisection ----

BOOST_AUTO_TEST_CASE(a_limit_is_bracketed_to_one_part_in_a_thousand_wherever_it_lies) {
  for (const double limit : {0.0011, 0.0312, 0.25, 0.2500001, 0.7071, 1.0, 3.9, 7.99}) {
    const Bracket found = bracket_limit([&](double number) { return number <= limit; }, 1e-3, 8);
    BOOST_REQUIRE((found.stable && found.unstable));
    BOOST_TEST(*found.stable <= limit);
    BOOST_TEST(*found.unstable > limit);
    BOOST_TEST(*found.unstable <= 1.0011 * *found.stable);
  }
}

BOOST_AUTO_TEST_CASE(where_there_is_no_limit_in_the_range_it_is_said_and_nothing_beyond_is_tried) {
  std::vector<double> tried;
  const auto trying = [&](bool stable) {
    return [&tried, stable](double number) {
      tried.push_back(number);
      return stable;
    };
  };
  const Bracket always = bracket_limit(trying(true), 1e-3, 8);
  BOOST_TEST((always.stable == 8 && !always.unstable));
  BOOST_TEST(*std::max_element(tried.begin(), tried.end()) == 8);
  const Bracket never = bracket_limit(trying(false), 1e-3, 8);
  BOOST_TEST((!never.stable && never.unstable == 1e-3));
  BOOST_TEST(*std::min_element(tried.begin(), tried.end()) == 1e-3);
}

// ---- the scene ----

BOOST_AUTO_TEST_CASE(noise_is_the_same_for_a_place_and_of_no_wave) {
  double sum = 0, squares = 0, neighbours = 0;
  const int count = 4000;
  for (int i = 0; i < count; ++i) {
    const double x = i / 4000.0, here = noise_at(x, 0.5, 0), next = noise_at((i + 1) / 4000.0, 0.5, 0);
    BOOST_TEST((here >= -1 && here < 1));
    BOOST_TEST(here == noise_at(x, 0.5, 0));
    sum += here;
    squares += here * here;
    neighbours += here * next;
  }
  BOOST_TEST(std::abs(sum / count) < 0.05);
  BOOST_TEST(squares / count == 1.0 / 3, tt::tolerance(0.05));  // evenly spread
  BOOST_TEST(std::abs(neighbours / count) < 0.03);
  BOOST_TEST(noise_at(0.1, 0.2, 0) != noise_at(0.1, 0.2, 1));
  BOOST_TEST(noise_at(0.1, 0.2, 0) != noise_at(0.2, 0.1, 0));
}

BOOST_AUTO_TEST_CASE(a_scene_at_rest_has_no_loads_and_the_smallest_motions) {
  Plate plate;
  plate.solid = solid::Elastic{{1e4, 0.3, 1.0, material::Plane::strain}};
  plate.edge(Side::left).support = Edge::Support::driven;
  plate.edge(Side::left).velocity = [](double, double, double) { return Vector{1, 1}; };
  plate.edge(Side::top).normal_traction = [](double, double) { return 1.0; };
  plate.body_force = [](double, double, double) { return Vector{1, 1}; };
  plate.initial_displacement = [](double, double) { return Vector{1, 1}; };
  plate.impact = Impact{0.5, 1, 0};
  const Plate rest = at_rest(plate);
  BOOST_TEST((rest.edge(Side::left).support == Edge::Support::fixed && !rest.edge(Side::left).velocity));
  BOOST_TEST((!rest.edge(Side::top).normal_traction && !rest.body_force && !rest.initial_displacement && !rest.impact));
  const double c = elastic(rest).pressure_wave_speed();
  const Vector v = rest.initial_velocity(0.3, 0.7);
  BOOST_TEST((std::abs(v[0]) <= 1e-10 * c && std::abs(v[1]) <= 1e-10 * c && v[0] != 0 && v[0] != v[1]));
  Scene bars;
  bars.bars[0].material = material::Elastic{1e4, 1.0};
  bars.loads.resize(1);
  bars.body_force = [](double, double) { return 1.0; };
  bars.bars[0].initial_stress = [](double) { return 1.0; };
  const Scene still = at_rest(bars);
  BOOST_TEST((still.loads.empty() && !still.body_force && !still.bars[0].initial_stress));
  BOOST_TEST(std::abs(still.bars[0].initial_velocity(0.3)) <= 1e-10 * material::wave_speed(bars.bars[0].material));
}

// ---- limits ----

BOOST_AUTO_TEST_CASE(limits_of_bars_are_those_of_theory) {
  const StabilityMap map = found(bar_case({"fem", "mpm-musl", "mpm-usl"}, "20, 40"));
  BOOST_REQUIRE(map.limits.size() == 3u);  // one mesh each
  BOOST_TEST(map.limits[0].label == "fem N=20");
  const std::vector<double> expected{1, 2, std::sqrt(0.5)};
  for (std::size_t i = 0; i < 3; ++i) {
    const StabilityLimit& one = map.limits[i];
    BOOST_TEST(*one.theory == expected[i], tt::tolerance(1e-14));
    BOOST_TEST(*one.limit() == expected[i], tt::tolerance(0.01));
    BOOST_TEST(one.agrees(0.01));
    BOOST_TEST(*one.growth_above > *one.growth_below);
    BOOST_TEST(*one.unstable <= 1.0011 * *one.stable);
  }
  BOOST_TEST(map.axis.empty());
  BOOST_TEST(holds(reports::stability_verdict(map, 0.01), "3 limits, 3 with a theory, all within 1 %"));
}

BOOST_AUTO_TEST_CASE(settings_have_the_value_of_the_axis_that_is_asked_for) {
  const StabilityMap map = found(bar_case({"mpm-musl"}, "20"), {"position=0.1,0.25"});
  BOOST_REQUIRE(map.limits.size() == 3u);
  BOOST_TEST(map.axis == "position");
  for (const StabilityLimit& one : map.limits) {
    const double a = 4 * *one.at * (1 - *one.at), q = std::min(1.0, 1 / (2 * a));
    BOOST_TEST(*one.theory == 1 / std::sqrt(q * (1 - a * q)), tt::tolerance(1e-14));
    BOOST_TEST(one.agrees(0.01));
  }
  BOOST_TEST(map.limits[0].setting == "mpm-musl N=20");
  BOOST_TEST(found(bar_case({"fem"}, "20"), {"cells=20,40"}).limits.size() == 2u);
  BOOST_CHECK_EXCEPTION(found(bar_case({"fem"}, "20"), {"courant=0.1,0.2"}), InputError, says({"sought"}));
}

// A panel whose steps are longer than it says, as a wrong mass or modulus would make them.
BOOST_AUTO_TEST_CASE(a_solver_whose_limit_is_two_per_cent_off_is_found_out) {
  runner::Panel off = runner::panel("fem");
  off.id = "fem-off";
  off.bars.run = [run = off.bars.run](const Scene& scene, const BarMesh& mesh, Stepping stepping) {
    stepping.time_step *= 1.02;
    return run(scene, mesh, stepping);
  };
  const AddedPanel added(off);
  const StabilityMap map = found(bar_case({"fem-off"}, "20"));
  BOOST_TEST(!map.limits[0].agrees(0.01));
  BOOST_TEST(map.limits[0].agrees(0.03));
  BOOST_TEST(holds(reports::stability_verdict(map, 0.01), "1 off by more than 1 %"));
  BOOST_TEST(holds(reports::stability_text(map, 0.01), "OFF"));
}

BOOST_AUTO_TEST_CASE(a_plate_with_free_sides_has_the_eigenvalues_of_its_own_mesh) {
  const StabilityMap map = found(plate_case("free"));
  BOOST_TEST(map.limits[0].agrees(2e-3));
  BOOST_TEST(*map.limits[0].theory == 0.5783, tt::tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(where_there_is_no_theory_none_is_said) {
  const auto of = [](const Case& c) { return limit_about_rest(c, leaves(c).front()); };
  BOOST_TEST(of(plate_case("free")).has_value());
  BOOST_TEST(!of(plate_case("fixed")));
  BOOST_TEST(!of(plate_case("roller")));  // 6 × 6 cells
  BOOST_TEST(of(bar_case({"fem"}, "16")).has_value());
  BOOST_TEST(!of(bar_case({"fem"}, "15")));
  // On the right, which is free, the particle stands near the end's node; on the left, which is held, far from it.
  const std::string off_centre = "particles = [[0.75]]\n";
  for (const char* method : {"mpm-usl", "mpm-musl"}) {
    const auto pulled = [&](const std::string& xi) {
      return parse_case(head("s", "robustness", "paper") + pulled_bar + axes({method}, "20", "0.5") +
                            replaced(off_centre, "0.75", xi) + sampled("0.5") +
                            gate("near", "exact", "displacement.L2", "max = 1.0\n"),
                        "s.toml");
    };
    BOOST_TEST(!of(pulled("0.75")));
    BOOST_TEST(of(pulled("0.25")).has_value());
  }
  BOOST_TEST(found(bar_case({"mpm-usl"}, "20"), {"position=0.25"}).limits.back().agrees(0.01));
  // Fixed at both ends: MPM's weak cell at a free end is gone.
  const std::string held =
      replaced(head("s", "robustness", "paper") + pulled_bar, "right = \"free\"", "right = \"fixed\"");
  for (const bool particles : {false, true}) {
    const Case c =
        parse_case(replaced(replaced(held, "[[load]]\nat = \"right\"\nhistory = \"step\"\ntraction = 1.0\n", ""),
                            "[exact]\nsolution = \"bar-wave\"\n", "[initial]\nvelocity = \"sin(pi*x)\"\n") +
                       axes({particles ? "mpm-usl" : "fem"}, "20", "0.5") + sampled("0.5") +
                       gate("closed", "invariant", "energy.closure", "max = 1.0\n"),
                   "s.toml");
    BOOST_TEST(of(c).has_value() != particles);
  }
}

BOOST_AUTO_TEST_CASE(forward_euler_of_diffusion_is_refused_at_its_limit_and_others_have_none) {
  const StabilityMap euler = found(diffusion_case("forward-euler"));
  BOOST_TEST(*euler.limits[0].theory == 0.25, tt::tolerance(1e-14));
  BOOST_TEST(euler.limits[0].agrees(1e-3));
  BOOST_TEST(holds(euler.limits[0].message, "refused"));
  BOOST_TEST(!euler.limits[0].growth_above);
  for (const char* scheme : {"rkl2", "backward-euler", "crank-nicolson"}) {
    const StabilityMap map = found(diffusion_case(scheme));
    BOOST_TEST((map.limits[0].stable && !map.limits[0].unstable), scheme << ": " << map.limits[0].message);
    BOOST_TEST(holds(reports::stability_text(map, 0.01), "none to 64"));
  }
}

// No closed form is known: the trend is what can be judged. A step of MUSL that takes more of its velocities from the
// grid bears less, and one of USL more; what remains of FLIP's own limit is that of none of it.
BOOST_AUTO_TEST_CASE(the_more_of_pic_the_less_bears_musl_and_the_more_usl) {
  const StabilityMap map = found(select_cases({"plate.pic"}).at(0), {"model.pic=1e-6,0.3,0.7,1"});
  BOOST_TEST(map.axis == "model.pic");
  std::map<std::string, std::vector<double>> limits;
  for (const StabilityLimit& one : map.limits) {
    BOOST_REQUIRE_MESSAGE(one.limit().has_value(), one.label << ": " << one.message);
    BOOST_TEST(!one.theory);
    limits[one.method].push_back(*one.limit());
  }
  const auto& usl = limits.at("mpm-usl");
  BOOST_TEST(limits.size() == 3u);
  for (std::size_t i = 1; i < usl.size(); ++i) {
    BOOST_TEST(limits.at("mpm-musl")[i] < 0.99 * limits.at("mpm-musl")[i - 1]);
    BOOST_TEST(limits.at("mpm-usf")[i] < 0.99 * limits.at("mpm-usf")[i - 1]);
    BOOST_TEST(usl[i] > 1.005 * usl[i - 1]);
  }
}

// ---- under loads ----

namespace {

StabilityMap found_of(const Case& c, const std::string& limit_of, const std::vector<std::string>& over = {},
                      const std::string& at_most = "", std::optional<long> steps = {}) {
  StabilityPlan plan;
  plan.over = over;
  plan.steps = steps;
  plan.limit_of = limit_of;
  plan.at_most = at_most;
  return stability_map(c, plan);
}

const StabilityLimit& limit_at(const StabilityMap& map, const std::string& method, double at) {
  for (const StabilityLimit& one : map.limits)
    if (one.method == method && one.at == at) return one;
  throw std::runtime_error("no such limit");
}

Case impact_case() { return select_cases({"impact.speed"}).at(0); }

}  // namespace

BOOST_AUTO_TEST_CASE(numbers_of_any_size_are_bracketed_from_both_ends) {
  for (const double limit : {1.5e-9, 80.0, 6.3e8}) {
    const Bracket found = bracket_between([&](double number) { return number <= limit; }, 1e-9, 1e9);
    BOOST_REQUIRE((found.stable && found.unstable));
    BOOST_TEST((*found.stable <= limit && *found.unstable > limit && *found.unstable <= 1.0011 * *found.stable));
  }
  const Bracket always = bracket_between([](double) { return true; }, 1, 9);
  const Bracket never = bracket_between([](double) { return false; }, 1, 9);
  BOOST_TEST((always.stable == 9 && !always.unstable && !never.stable && never.unstable == 1));
}

// FEM's equations are linear in the reference configuration: at any speed the limit is Courant number 1.
BOOST_AUTO_TEST_CASE(bars_that_meet_stand_the_same_step_with_fem_at_any_speed) {
  const StabilityMap map = found_of(impact_case(), "courant=0.1:3", {"method=fem", "v0=10,30"});
  for (const double v0 : {1.0, 10.0, 30.0, 60.0}) {
    const StabilityLimit& one = limit_at(map, "fem", v0);
    BOOST_REQUIRE_MESSAGE(one.limit().has_value(), one.label << ": " << one.message);
    BOOST_TEST(*one.limit() == 1, tt::tolerance(0.01));
  }
}

// At Courant number 1 FEM carries the exact strain −v/c: at the wave speed it is −1, and the bar is folded.
BOOST_AUTO_TEST_CASE(bars_are_invalid_from_the_speed_on_at_which_they_fold) {
  const StabilityMap map = found_of(impact_case(), "v0=1:300", {"courant=1"});
  std::size_t looked_at = 0;
  for (const StabilityLimit& one : map.limits) {
    if (one.label != "fem N=20 C=1") continue;
    ++looked_at;
    BOOST_REQUIRE_MESSAGE(one.limit().has_value(), one.label << ": " << one.message);
    BOOST_TEST(*one.limit() == 100, tt::tolerance(0.01));
    BOOST_TEST(holds(one.message, "inside out"));
  }
  BOOST_TEST(looked_at == 1u);
}

// Every particle that crosses a cell may be given energy; the faster they cross, the shorter the step must be.
BOOST_AUTO_TEST_CASE(the_faster_bars_meet_the_less_bears_mpm) {
  const StabilityMap map = found_of(impact_case(), "courant=0.01:3", {"v0=10"});
  const auto limit = [&](double v0) { return limit_at(map, "mpm-musl", v0).limit().value_or(0); };
  BOOST_TEST(limit(10) < 0.9 * limit(1));
  BOOST_TEST(limit(60) < 0.9 * limit(10));
}

// What is left of K and G is 1 − D: the limit of the whole plate over √(1 − D).
BOOST_AUTO_TEST_CASE(a_plate_that_is_all_but_damaged_stands_the_longer_step) {
  Case c = select_cases({"plate.stability.damaged"}).at(0);
  std::erase_if(c.axes, [](const Axes& block) { return block.variant[0] != "" && block.variant[0] != "d-0999"; });
  const StabilityMap map = found_of(c, "courant=0.5:60", {}, "", 400);
  BOOST_REQUIRE(map.limits.size() == 4u);
  for (const StabilityLimit& one : map.limits) {
    const double whole = one.method == "fem" ? 0.5879 : 1.732, left = one.scene.empty() ? 1 : 1e-3;
    BOOST_REQUIRE_MESSAGE(one.limit().has_value(), one.label << ": " << one.message);
    BOOST_TEST(*one.limit() == whole / std::sqrt(left), tt::tolerance(0.01));
  }
}

BOOST_AUTO_TEST_CASE(an_elastic_bar_is_stable_at_any_speed_and_too_quick_where_a_probe_says_so) {
  const Case c = parse_case(head("s", "robustness", "paper") + paper_bar +
                                "[parameters]\np = 1.0\n[initial]\nvelocity = \"p*sin(pi*x/2)\"\n"
                                "[model]\nfeatures = [\"elastic\"]\n" +
                                axes({"fem"}, "20", "0.5") +
                                "[sample]\ntimes = { unit = \"L/c\", at = [0.5] }\nprobes = [{ id = \"wall\", field = "
                                "\"stress\", at = { value = 0.5, unit = \"cells\" } }]\n" +
                                gate("closed", "invariant", "energy.closure", "max = 1.0\n"),
                            "s.toml");
  const StabilityLimit any = found_of(c, "p=0.1:1e6").limits.at(0);
  BOOST_TEST((any.stable == 1e6 && !any.unstable), any.message);
  // u = (2p/πc) sin(πx/2) sin(πct/2): at the wall σ = E p/c sin(π/4) after half the time of a wave.
  const StabilityLimit stressed = found_of(c, "p=0.1:1e6", {}, "probe.wall=50").limits.at(0);
  BOOST_TEST(stressed.limit().value_or(0) == 50 / (100 * std::sqrt(0.5)), tt::tolerance(5e-3));
  BOOST_TEST(holds(stressed.message, "probe.wall"));
}

BOOST_AUTO_TEST_CASE(what_is_no_limit_to_look_for_is_refused_in_words) {
  const Case c = impact_case();
  for (const char* text : {"v0", "v0=3", "v0=3:2", "v0=0:2", "v0=a:2"})
    BOOST_CHECK_EXCEPTION(found_of(c, text), InputError, says({"--limit-of", "KEY=LEAST:MOST"}));
  BOOST_CHECK_EXCEPTION(found_of(c, "v1=1:2"), InputError, says({"--limit-of", "\"v0\""}));
  BOOST_CHECK_EXCEPTION(found_of(c, "material.Ee=1:2"), InputError, says({"material.E"}));
  BOOST_CHECK_EXCEPTION(found_of(c, "v0=1:2", {"v0=3"}), InputError, says({"v0 is what is sought"}));
  BOOST_CHECK_EXCEPTION(found_of(c, "v0=1:2", {}, "contact.duratoin=1"), InputError, says({"contact.duration"}));
  BOOST_CHECK_EXCEPTION(found_of(c, "v0=1:2", {}, "contact.duration"), InputError, says({"QUANTITY=NUMBER"}));
  BOOST_CHECK_EXCEPTION(found_of(c, "", {}, "contact.duration=1"), InputError, says({"without --limit-of"}));
}

// ---- words and pictures ----

BOOST_AUTO_TEST_CASE(tables_say_where_there_is_no_limit) {
  StabilityMap map = made_map();
  map.limits[0].unstable = {};
  map.limits[1].stable = {};
  map.limits[1].growth_below = {};
  map.limits[1].growth_above = {};
  map.limits[1].message = "at 0.001 refused: why";
  const std::string text = reports::stability_text(map, 0.01);
  BOOST_TEST(holds_all(text, {"none to 8", "below 0.6", "refused", "why", "OFF", "2000 steps", "10-fold"}), text);
  BOOST_TEST(holds(reports::stability_verdict(map, 0.01), "2 off by more than 1 %"));
  for (StabilityLimit& one : map.limits) one.theory = {};
  BOOST_TEST(reports::stability_verdict(map, 0.01) == "2 limits, 0 with a theory");
  BOOST_TEST(holds(reports::stability_csv(made_map()), "fem N=8,fem,0.3,0.5,0.49975,0.50025,1e-06,0.01,0.5,1,"));
  BOOST_TEST(holds_all(reports::stability_json(made_map(), {}), {"\"type\":\"stability\"", "\"theory\":0.5"}));
}

BOOST_AUTO_TEST_CASE(the_figure_draws_theory_below_the_points_over_what_is_left_of_poissons_ratio) {
  const auto figure = stability_figure(made_map());
  BOOST_REQUIRE(figure.has_value());
  BOOST_TEST(figure->x_powers);
  BOOST_TEST(!figure->y_powers);
  BOOST_TEST(figure->x_label == "1 − 2ν");
  const auto& drawn = figure->panels[0].series;
  BOOST_REQUIRE(drawn.size() == 2u);
  BOOST_TEST((drawn[0].kind == "exact" && drawn[1].kind == "fem"));
  BOOST_TEST(drawn[1].curve.x[0] == std::log10(1 - 2 * 0.3), tt::tolerance(1e-12));
  BOOST_TEST(drawn[1].curve.y[0] == 0.5, tt::tolerance(1e-12));
  StabilityMap two = made_map();
  for (StabilityLimit limit : made_map().limits) {
    limit.scene = "plane-stress";
    limit.setting = "fem N=8 plane-stress";
    limit.theory = {};
    two.limits.push_back(limit);
  }
  const auto panels = stability_figure(two)->panels;
  BOOST_REQUIRE(panels.size() == 2u);
  BOOST_TEST((panels[1].label == "plane-stress" && panels[1].series.size() == 1u));
  BOOST_TEST(panels[1].series[0].label == "fem N=8");  // looks as it does in the first
  StabilityMap one = made_map();
  one.limits.pop_back();
  BOOST_TEST(!stability_figure(one));
}

BOOST_AUTO_TEST_SUITE_END()
