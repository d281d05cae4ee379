// Case files of plates: what is read, and what is said of each mistake.
#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "runner/app/case_file.hpp"
#include "runner/input/constants.hpp"
#include "runner/input/leaf.hpp"
#include "runner/input/plate_build.hpp"
#include "runner/judge/agreement.hpp"
#include "runner/judge/bound.hpp"
#include "runner/judge/order.hpp"
#include "runner/judge/ratio.hpp"
#include "runner/judge/settling.hpp"
#include "tests/broken_text.hpp"
#include "tests/case_figures.hpp"
#include "tests/case_text.hpp"
#include "tests/criteria.hpp"
#include "tests/messages.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(plate_file)

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;
namespace tt = boost::test_tools;

namespace {

diffusion::Spread spread_of(const Case& c, int cells) { return std::get<solid::Failing>(solid_of(c, cells)).spread; }

/// Damage and diffusion: every table, and every key of those that may stand together.
const std::string whole = head("plate", "cross-code") + plate("1.0", "1.5") + R"toml(cell_aspect = 1.25
[material]
model = "tensile-damage"
E = 50e9
nu = 0.3
rho = 2500
plane = "strain"
compression = { strength = 1e8, slope = 0.5 }
K_IC = 2e6
k = 4e22
m = 6.5
beta = 0.5
residual_stiffness = 0.01
volumetric = "trace"
[parameters]
P = 7e8
[damage]
critical_strain = 0.003
shows = "everywhere"
capped = false
rate = "reference"
reference_rate = 200
[diffusion]
T_d = 0.02
lambda1 = 400
lambda2 = 0.03
rupture_strain = 0.04
source = "zone"
radius = 0.2
per_crack_volume = false
saturates = false
clip_strain = false
scheme = "rkl2"
reading = "radial"
drift = 0.1
)toml" + supports("roller", "free", "driven", "platen") +
                          R"toml(velocity = ["0", "-0.1*t*x*(Lx-x)"]
[[load]]
at = "top"
history = "ramp"
traction = "P/2"
rise = { value = 50e-6, unit = "s" }
[[load]]
at = "right"
direction = "shear"
history = "expression"
traction = "P*sin(t)"
[[load]]
at = "right"
direction = "normal"
history = "impulse"
traction = -3
start = { value = 1e-5, unit = "s" }
duration = { value = 2e-5, unit = "s" }
[body_force]
acceleration = ["0", "-9.81*t"]
[initial]
velocity = ["0.1*x", "y"]
displacement = ["0", "1e-9*x*y"]
[model]
displacements = "infinitesimal"
pic = 0.25
features = ["pic", "damage", "diffusion", "compression-plasticity", "platen", "body-force"]
[[variant]]
id = "tracked"
says = "the largest rate met"
set = { "damage.rate" = "tracked", "damage.rate_floor" = 3 }
without = ["damage.reference_rate"]
[exact]
solution = "expressions"
displacement = ["x*t", "y*t"]
velocity = ["x", "y"]
stress = ["E*t", "nu*E*t", "0"]
concentration = "x + y + t"
core = 0.05
[[axes]]
method = ["fem", "mpm-musl"]
cells = [10, 20, 40, 80]
courant = [0.5]
particles = [2, [0.5]]
parameters = { P = [6e8, 7e8] }
variant = ["", "tracked"]
[sample]
times = { unit = "s", at = [1e-4, 2e-4] }
probes = [
  { id = "r", reads = "radius", level = 0.05, angle = 45 },
  { id = "a", reads = "area", level = 0.01 },
  { id = "l", reads = "largest" },
  { id = "t", reads = "total" },
  { id = "c", reads = "concentration", at = [0.5, 1.5] },
  { id = "s", reads = "stress-xy", at = [1.0, 0] },
  { id = "b", reads = "acoustic-ratio" },
  { id = "pl", reads = "platen" },
]
[run]
ledger = true
[[gate]]
id = "balance"
kind = "invariant"
quantity = "concentration.balance"
where = { variant = "tracked", parameters = { P = 7e8 } }
max = 1e-12
reason = "round-off"
[[gate]]
id = "radius"
kind = "agreement"
quantity = "probe.r"
where = { particles = 2, variant = "", parameters = { P = 7e8 } }
max = 1.0
judged = [40, 80]
shrinks = false
times = [1e-4]
reason = "judgement"
[[gate]]
id = "contour"
kind = "agreement"
quantity = "contour.distance"
where = { particles = 2, variant = "", parameters = { P = 7e8 } }
max = 1.5
level = 0.06
judged = [80]
reason = "judgement"
[[gate]]
id = "size"
kind = "exact"
quantity = "probe.t"
expect = 3
max = 0.5
reason = "r"
[[figure]]
id = "fig13"
kind = "contours"
field = "damage"
levels = [0.01, 0.05]
times = [2e-4]
cells = 10
particles = 2
parameters = { P = 7e8 }
range = [0, 1]
[[figure]]
id = "fig12"
kind = "problem"
cells = 10
parameters = { P = 7e8 }
[[figure]]
id = "swept"
kind = "rupture"
over = "P"
probe = "l"
variant = "tracked"
[[figure]]
id = "converged"
kind = "convergence"
times = [2e-4]
probes = ["r", "pl"]
parameters = { P = 7e8 }
)toml";

/// An elastic plate with a mode of its own.
const std::string elastic_mode =
    head("mode", "code-verification") + plate("2.0", "2.0") + elastic("1e4", "0.25", "4", "stress") +
    supports("free", "free", "free", "free") + R"toml([model]
features = ["elastic"]
[exact]
solution = "lame-mode"
mode = 2
amplitude = -1e-3
start = "moving"
)toml" +
    axes({"fem", "mpm-usf", "mpm-usl", "mpm-musl"}, "8, 16, 32, 64", "0.5") + R"toml([sample]
times = { unit = "s", at = [0.01] }
)toml" +
    gate("constant", "constant", "displacement.L2", "predict = \"mode\"\nratio = [0.98, 1.02]\n") +
    gate("order", "order", "stress.L1", "expect = 1\nband = [0.9, 1.1]\nlevels_min = 3\n") +
    gate("limit", "limit", "critical_courant", "predict = \"stability-limit\"\nratio = [0.99, 1.01]\n");

/// Diffusion without a material.
const std::string pure = head("diffusion", "code-verification") + plate("2.0", "1.0") + R"toml([diffusion]
diffusivity = "d*(1 + x*y)"
rate = "x*y*t"
corner_rate = -0.5
scheme = "crank-nicolson"
reading = "radial"
[parameters]
d = 0.5
[initial]
concentration = "1 + cos(pi*x/Lx)*cos(pi*y/Ly)"
[model]
features = ["diffusion"]
[[variant]]
id = "euler"
says = "backward"
set = { "diffusion.scheme" = "backward-euler" }
[exact]
solution = "corner-source"
core = 0.1
)toml" + axes({"diffusion"}, "10", "0.25, 0.5, 1, 2") +
                         R"toml([sample]
times = { unit = "s", at = [0.01] }
probes = [{ id = "p", reads = "concentration", at = [1, 1] }, { id = "t", reads = "total" }]
)toml" + gate("order", "order", "concentration.L2", "over = \"courant\"\nexpect = 2.0\nband = [1.9, 2.1]\n") +
                         gate("balance", "invariant", "concentration.balance", "max = 1e-12\n");

/// A failure wave behind the shock of a flyer.
const std::string struck = head("struck", "cross-code") + R"toml([plate]
width = 42e-3
rows = 2
[material]
model = "failure-wave"
E = 72.8e9
nu = 0.222
rho = 2563
plane = "strain"
threshold = 2.75e9
f_max = 0.5
[diffusion]
d0 = 8.0
profile = "rising"
face_holds = "largest"
scheme = "rkl2"
drift = 0.25
[flyer]
thickness = 18e-3
velocity = 684.0
gap = { value = 2, unit = "cells" }
[viscosity]
form = "york"
c1 = 0.2
c2 = 0.3
bulk = 0.5
length = 2
acts = "always"
)toml" + guided() + R"toml([model]
features = ["viscosity", "diffusion", "failure-wave", "impact"]
)toml" + axes({"fem", "mpm-musl"}, "7, 14, 28, 42", "0.3") +
                           R"toml([sample]
times = { unit = "s", at = [1e-6] }
probes = [{ id = "total", reads = "total" }, { id = "c", reads = "concentration", at = [20e-3, 0] }]
gauges = [
  { id = "near", from_face = 4.5e-3 },
  { id = "far", from_face = 6.5e-3 },
]
)toml" + gate("settles", "settling", "gauge.near.yy", "max = 0.9\n") +
                           gate("front", "constant", "gauge.near.failure",
                                "predict = \"diffusion-front\"\nratio = [0.5, 2]\n") +
                           gate("speed", "exact", "failure.speed", "expect = 1500\nmax = 700\n") +
                           gate("late", "exact", "gauge.far.longitudinal", "expect = 1\nmax = 0.01\n") +
                           gate("ahead", "invariant", "dilatancy.ahead", "max = 0\n") +
                           gate("agree", "agreement", "gauge.far.dilatancy", "max = 1\njudged = [42]\n") +
                           R"toml([[figure]]
id = "fig16"
kind = "gauges"
cells = 42
components = ["lateral"]
time_range = [0, 2e-6]
range = [-1, 4]
bands = [
  { label = "both", speed = [800, 2100], delay = [0.1e-6, 0.7e-6] },
  { label = "one", speed = 2000 },
]
[[figure]]
id = "failure"
kind = "failure"
cells = 42
pictures = ["fig16"]
sections = [{ heading = "h", says = "s", variants = [""] }]
)toml";

/// The same without what fails: the exact solution is known.
const std::string shocked = head("shocked", "code-verification") + strip("42e-3") + glass() + R"toml([flyer]
thickness = 18e-3
velocity = 684.0
)toml" + guided() + R"toml([model]
features = ["elastic", "impact"]
[exact]
solution = "plate-impact"
)toml" + axes({"fem", "mpm-musl"}, "7, 14, 28, 42", "0.3") +
                            R"toml([sample]
times = { unit = "s", at = [1e-6] }
gauges = [{ id = "near", from_face = 4.5e-3 }]
)toml" + gate("lattice", "invariant", "gauge.near.prediction", "max = 1e-9\n") +
                            gate("plateau", "constant", "gauge.near.plateau",
                                 "predict = \"impact-lattice\"\nratio = [0.999, 1.001]\n");

std::string message(const std::string& text) {
  return message_of<InputError>([&] { parse_case(text, "plate.toml"); });
}

/// The same without a variant and without what speaks of one: for mistakes that would be found in the variant too.
std::string alone() {
  std::string text =
      replaced(whole, whole.substr(whole.find("[[variant]]"), whole.find("[exact]") - whole.find("[[variant]]")), "");
  text = replaced(text, "variant = [\"\", \"tracked\"]\n", "");
  text = replaced(text, "variant = \"tracked\", ", "");
  text = replaced(text, "variant = \"\", ", "");
  text = replaced(text, "variant = \"\", ", "");
  return text.substr(0, text.find("[[figure]]\nid = \"swept\""));
}

/// The mode's plate with all of its sides on rollers.
std::string on_rollers() {
  std::string text = elastic_mode;
  for (const char* side : {"left", "right", "bottom", "top"})
    text = replaced(text, std::string(side) + " = \"free\"", std::string(side) + " = \"roller\"");
  return text;
}

/// The one and only message stands at the line that holds `at` and holds all the parts.
void expect_at(const std::string& text, const std::string& at, const std::vector<std::string>& parts) {
  const std::string all = message(text), place = "plate.toml:" + std::to_string(line_of(text, at)) + ':';
  BOOST_TEST(lines(all).size() == 1u, "wanted one line about '" << at << "', have\n" << all);
  BOOST_TEST(all.rfind(place, 0) == 0, "wanted " << place << ", have\n" << all);
  for (const std::string& part : parts) BOOST_TEST(holds(all, part), "wanted '" << part << "' in\n" << all);
  BOOST_TEST(holds(all, "allowed"), "nothing is said of what is allowed:\n" << all);
}

/// `from` becomes `to`, which is the mistake.
void wrong(const std::string& text, const std::string& from, const std::string& to,
           const std::vector<std::string>& parts) {
  expect_at(replaced(text, from, to), to, parts);
}

/// Among the messages is one at the line that holds `at`, with all the parts.
void says(const std::string& text, const std::string& at, const std::vector<std::string>& parts) {
  const std::string all = message(text), place = "plate.toml:" + std::to_string(line_of(text, at)) + ':';
  bool found = false;
  for (const std::string& line : lines(all)) {
    found = found || (line.starts_with(place) && holds_all(line, parts));
  }
  BOOST_TEST(found, "wanted at " << place << " '" << parts.front() << "' and so on, have\n" << all);
}
void wrong_here(const std::string& text, const std::string& from, const std::string& to,
                const std::vector<std::string>& parts) {
  says(replaced(text, from, to), to, parts);
}

/// `from` becomes `to`, and the file is as good as before.
Case good(const std::string& text, const std::string& from, const std::string& to) {
  const std::string changed = replaced(text, from, to);
  BOOST_REQUIRE_EQUAL(message(changed), "");
  return parse_case(changed, "plate.toml");
}

}  // namespace

// ---- what is read ---------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(every_key_of_a_damaging_plate_is_read) {
  BOOST_REQUIRE_EQUAL(message(whole), "");
  const Case c = parse_case(whole, "plate.toml");
  BOOST_REQUIRE(c.plate.has_value());
  const PlateSpec& plate = *c.plate;
  BOOST_TEST((plate.width == 1.0 && plate.height == 1.5 && plate.cell_aspect == 1.25));
  const material::TensileDamage& law = plate.cracking()->law;
  BOOST_TEST((law.elastic.youngs_modulus == 50e9 && law.elastic.poissons_ratio == 0.3 && law.elastic.density == 2500));
  BOOST_TEST((law.elastic.plane == material::Plane::strain));
  BOOST_TEST((law.fracture_toughness == 2e6 && law.flaw_density == 4e22 && law.exponent == 6.5 && law.beta == 0.5));
  BOOST_TEST((law.residual_stiffness == 0.01 && law.trace));
  const auto& compression = plate.cracking()->compression;
  BOOST_REQUIRE(compression.has_value());
  BOOST_TEST((compression->strength == 1e8 && compression->slope == 0.5));

  const diffusion::Evolution& evolution = plate.cracking()->evolution;
  BOOST_TEST((evolution.critical_strain == 0.003 && evolution.damage_everywhere));
  BOOST_TEST(evolution.cap == std::numeric_limits<double>::infinity());
  BOOST_TEST((evolution.rate == diffusion::Rate::reference && evolution.reference_rate == 200));
  BOOST_REQUIRE(evolution.diffusion.has_value());
  const diffusion::Diffusion& d = *evolution.diffusion;
  BOOST_TEST((d.characteristic_time == 0.02 && d.mobility == 400 && d.crack_volume == 0.03));
  BOOST_TEST((d.rupture_strain == 0.04 && d.source == diffusion::Source::zone && d.radius == 0.2));
  BOOST_TEST((!d.per_crack_volume && !d.saturates && !d.clip_strain));
  BOOST_TEST((d.scheme == diffusion::Scheme::rkl2 && d.reading == diffusion::Reading::radial && d.drift == 0.1));

  using Support = Edge::Support;
  BOOST_TEST((plate.supports == std::array{Support::roller, Support::free, Support::driven, Support::platen}));
  BOOST_TEST((plate.drive == Pair{"0", "-0.1*t*x*(Lx-x)"}));
  BOOST_REQUIRE_EQUAL(plate.loads.size(), 3u);
  const SideLoad &top = plate.loads[0], &shear = plate.loads[1], &normal = plate.loads[2];
  BOOST_TEST((top.side == Side::top && !top.shear && top.history == "ramp" && top.traction == "P/2"));
  BOOST_TEST((top.rise == 50e-6 && top.start == 0 && top.duration == 0));
  BOOST_TEST((shear.side == Side::right && shear.shear && shear.history == "expression"));
  BOOST_TEST(shear.traction == "P*sin(t)");
  BOOST_TEST((normal.side == Side::right && !normal.shear && normal.history == "impulse" && normal.traction == "-3"));
  BOOST_TEST((normal.start == 1e-5 && normal.duration == 2e-5));
  BOOST_TEST((plate.body_force == Pair{"0", "-9.81*t"} && plate.initial_velocity == Pair{"0.1*x", "y"}));
  BOOST_TEST((plate.initial_displacement == Pair{"0", "1e-9*x*y"}));

  BOOST_TEST((!c.convected && plate.pic == 0.25));
  BOOST_TEST((c.features == std::vector<std::string>{"body-force", "compression-plasticity", "damage", "diffusion",
                                                     "pic", "platen"}));
  BOOST_TEST(plate.exact.solution == "expressions");
  BOOST_TEST((plate.exact.displacement == Pair{"x*t", "y*t"} && plate.exact.velocity == Pair{"x", "y"}));
  BOOST_TEST((plate.exact.stress == Triple{"E*t", "nu*E*t", "0"} && plate.exact.concentration == "x + y + t"));
  BOOST_TEST(plate.exact.core() == 0.05);
  BOOST_TEST((c.parameters == Parameters{{"P", 7e8}}));

  BOOST_REQUIRE_EQUAL(c.axes.size(), 1u);
  BOOST_TEST((c.axes[0].method == std::vector<std::string>{"fem", "mpm-musl"}));
  BOOST_TEST((c.axes[0].variant == std::vector<std::string>{"", "tracked"}));
  BOOST_TEST((c.axes[0].particles == std::vector<std::vector<double>>{{0.25, 0.75}, {0.5}}));
  BOOST_TEST((c.time_unit == "s" && c.times == std::vector<double>{1e-4, 2e-4} && c.ledger));
  BOOST_REQUIRE_EQUAL(c.plate_probes.size(), 8u);
  BOOST_TEST((c.plate_probes[0].id == "r" && c.plate_probes[0].reads == "radius"));
  BOOST_TEST((c.plate_probes[0].level == 0.05 && c.plate_probes[0].angle == 45));
  BOOST_TEST((c.plate_probes[1].reads == "area" && c.plate_probes[1].level == 0.01));
  BOOST_TEST((c.plate_probes[4].reads == "concentration" && c.plate_probes[4].x == 0.5 && c.plate_probes[4].y == 1.5));
  BOOST_TEST((c.plate_probes[5].reads == "stress-xy" && c.plate_probes[5].x == 1 && c.plate_probes[5].y == 0));

  BOOST_REQUIRE_EQUAL(c.gates.size(), 4u);
  BOOST_TEST((c.gates[0].where.variant == std::vector<std::string>{"tracked"}));
  const GateSpec& radius = c.gates[1];
  const auto& of_radius = criterion<AgreementCriterion>(radius);
  BOOST_TEST((radius.kind == "agreement" && radius.quantity == "probe.r"));
  BOOST_TEST((of_radius.max == 1.0 && !of_radius.shrinks && of_radius.judged == std::vector<int>{40, 80}));
  BOOST_TEST((radius.times == std::vector<double>{1e-4}));
  BOOST_TEST((radius.where.variant == std::vector<std::string>{""}));
  const auto& of_contour = criterion<AgreementCriterion>(c.gates[2]);
  BOOST_TEST((of_contour.level == 0.06 && of_contour.shrinks));
  const auto& bound = criterion<BoundCriterion>(c.gates[3]);
  BOOST_TEST((bound.expect == 3.0 && bound.max == 0.5));
  BOOST_REQUIRE_EQUAL(c.figures.size(), 4u);
  const reports::Case shown = drawn_case(c);
  const reports::PlateFigure& contours = shown.plate_figures.at(0);
  BOOST_TEST((c.figures[0].kind == "contours" && c.figures[0].cells == 10));
  BOOST_TEST(contours.notes.at(1).ends_with("levels of D: 0.01, 0.05"), contours.notes.at(1));
  BOOST_TEST(c.figures[1].kind == "problem");
  BOOST_REQUIRE_EQUAL(shown.figures.size(), 2u);
  BOOST_TEST((c.figures[3].kind == "convergence" && shown.figures[1].panels.size() == 2u));
  BOOST_TEST(shown.figures[1].panels[0].label == "radius of C_d = 0.05 at 45° [m]");
  BOOST_TEST(shown.figures[1].panels[1].label == "displacement of the platen [m]");
  BOOST_TEST((c.figures[2].kind == "rupture" && c.figures[2].over == "P"));
}

BOOST_AUTO_TEST_CASE(every_key_of_a_mode_and_of_diffusion_alone_is_read) {
  BOOST_REQUIRE_EQUAL(message(elastic_mode), "");
  const Case mode = parse_case(elastic_mode, "plate.toml");
  const auto& elastic = std::get<solid::Elastic>(mode.plate->solid.value()).law;
  BOOST_TEST((elastic.youngs_modulus == 1e4 && elastic.poissons_ratio == 0.25 && elastic.density == 4));
  BOOST_TEST((elastic.plane == material::Plane::stress));
  const PlateExact& exact = mode.plate->exact;
  BOOST_TEST((exact.solution == "lame-mode" &&
              exact.parameters == analytic::SolutionParameters{{"mode", 2}, {"amplitude", -1e-3}, {"start", 1}}));
  const auto& slope = criterion<OrderCriterion>(mode.gates[1]);
  BOOST_TEST((slope.levels_min == 3 && !slope.over_time_step));

  BOOST_REQUIRE_EQUAL(message(pure), "");
  const Case c = parse_case(pure, "plate.toml");
  BOOST_TEST((!c.plate->solid && c.plate->diffusion));
  const PureDiffusion& d = *c.plate->diffusion;
  BOOST_TEST((d.diffusivity == "d*(1 + x*y)" && d.rate == "x*y*t" && d.corner_rate == -0.5));
  BOOST_TEST((d.scheme == diffusion::Scheme::crank_nicolson && d.reading == diffusion::Reading::radial));
  BOOST_TEST(c.plate->initial_concentration == "1 + cos(pi*x/Lx)*cos(pi*y/Ly)");
  BOOST_TEST((c.plate->exact.solution == "corner-source" && c.plate->exact.core() == 0.1));
  BOOST_TEST((c.variants[0].plate.diffusion->scheme == diffusion::Scheme::backward_euler));
  BOOST_TEST(criterion<OrderCriterion>(c.gates[0]).over_time_step);
  BOOST_TEST((c.plate_probes[0].x == 1 && c.plate_probes[0].y == 1 && c.plate_probes[1].reads == "total"));
}

BOOST_AUTO_TEST_CASE(what_is_left_out_is_as_said) {
  const std::vector<std::string> optional{"cell_aspect", "compression =", "beta",          "residual_stiffness",
                                          "volumetric",  "shows =",       "capped",        "per_crack",
                                          "saturates",   "clip_",         "scheme",        "reading",
                                          "drift",       "pic = ",        "displacements", "core",
                                          "ledger",      "shrinks",       "particles = [2"};
  std::string text = without(whole, optional);
  text = replaced(text, R"("pic", "damage", "diffusion", "compression-plasticity")", R"("damage", "diffusion")");
  BOOST_REQUIRE_EQUAL(message(text), "");
  const Case c = parse_case(text, "plate.toml");
  const material::TensileDamage& law = c.plate->cracking()->law;
  BOOST_TEST((c.plate->cell_aspect == 1 && !c.plate->cracking()->compression && c.plate->pic == 0 && !c.convected &&
              c.ledger));
  BOOST_TEST((law.beta == 1 && law.residual_stiffness == 1e-3 && !law.trace));
  const diffusion::Evolution& evolution = c.plate->cracking()->evolution;
  BOOST_TEST((!evolution.damage_everywhere && evolution.cap == 9.0 / 16));
  BOOST_TEST((evolution.diffusion->per_crack_volume && evolution.diffusion->saturates));
  BOOST_TEST((evolution.diffusion->clip_strain && evolution.diffusion->drift == 0));
  BOOST_TEST((evolution.diffusion->scheme == diffusion::Scheme::sub_cycled));
  BOOST_TEST((evolution.diffusion->reading == diffusion::Reading::isotropic));
  BOOST_TEST((c.plate->exact.core() == 0 && criterion<AgreementCriterion>(c.gates[1]).shrinks));
  BOOST_TEST((c.axes[0].particles == std::vector<std::vector<double>>{{0.25, 0.75}}));  // 2 × 2 in a cell

  const Case mode = good(elastic_mode, "start = \"moving\"\n", "");
  BOOST_TEST(
      (mode.plate->exact.parameters.at("start") == 0 && mode.plate->loads.empty() && mode.plate->drive[0].empty()));
  BOOST_TEST((mode.axes[0].variant == std::vector<std::string>{""} && mode.variants.empty()));
  const std::string sourceless =
      replaced(without(pure, {"rate = ", "scheme = \"crank", "reading", "concentration = \""}),
               "\"corner-source\"\ncore = 0.1", "\"expressions\"\nconcentration = \"1\"");
  BOOST_REQUIRE_EQUAL(message(sourceless), "");
  const Case d = parse_case(sourceless, "plate.toml");
  BOOST_TEST((d.plate->diffusion->rate.empty() && d.plate->diffusion->corner_rate == 0));
  BOOST_TEST((d.plate->diffusion->scheme == diffusion::Scheme::forward_euler));
  BOOST_TEST((d.plate->diffusion->reading == diffusion::Reading::isotropic && d.plate->initial_concentration.empty()));
}

BOOST_AUTO_TEST_CASE(each_name_stands_for_its_own_value) {
  using diffusion::Scheme;
  for (const auto& [name, scheme] :
       std::vector<std::pair<std::string, Scheme>>{{"forward-euler", Scheme::forward_euler},
                                                   {"sub-cycled", Scheme::sub_cycled},
                                                   {"backward-euler", Scheme::backward_euler},
                                                   {"crank-nicolson", Scheme::crank_nicolson}})
    BOOST_TEST((good(replaced(whole, "drift = 0.1\n", ""), "\"rkl2\"", '"' + name + '"')
                    .plate->cracking()
                    ->evolution.diffusion->scheme == scheme));
  using diffusion::Source;
  const auto source = [](const std::string& name) {
    return good(whole, "\"zone\"\nradius = 0.2", '"' + name + '"').plate->cracking()->evolution.diffusion->source;
  };
  BOOST_TEST((source("node") == Source::node && source("everywhere") == Source::everywhere));
  BOOST_TEST(good(on_rollers(), "\"lame-mode\"", "\"roller-mode\"").plate->exact.solution == "roller-mode");
  // Running waves know no square.
  const std::string strip = replaced(on_rollers(), "height = 2.0", "height = 0.5");
  BOOST_TEST(good(strip, "lame-mode", "p-wave").plate->exact.solution == "p-wave");
  const std::string no_theory = replaced(strip, "kind = \"constant\"", "kind = \"exact\"\nmax = 1");
  BOOST_TEST(good(replaced(no_theory, "predict = \"mode\"\nratio = [0.98, 1.02]\n", ""), "lame-mode", "s-wave")
                 .plate->exact.solution == "s-wave");
  BOOST_TEST(good(elastic_mode, "[model]", "[model]\ndisplacements = \"infinitesimal\"").convected == false);
  BOOST_TEST(good(elastic_mode, "[model]\nfeatures = [\"elastic\"]",
                  "[model]\ndisplacements = \"finite\"\nfeatures = [\"convection\", \"elastic\"]")
                 .convected);
  const Case tracked = good(alone(), "\"reference\"\nreference_rate = 200", "\"tracked\"\nrate_floor = 5");
  BOOST_TEST((tracked.plate->cracking()->evolution.rate == diffusion::Rate::tracked));
  BOOST_TEST(tracked.plate->cracking()->evolution.rate_floor == 5);
}

BOOST_AUTO_TEST_CASE(a_constant_diffusivity_may_be_a_number) {
  const Case c = good(pure, "\"d*(1 + x*y)\"", "0.125");
  BOOST_TEST(make_diffusion(c).diffusivity(0.3, 0.4) == 0.125);
}

BOOST_AUTO_TEST_CASE(expressions_know_the_plate) {
  const auto names = expression_constants(parse_case(elastic_mode, "plate.toml"));
  BOOST_TEST((names.at("Lx") == 2 && names.at("Ly") == 2 && names.at("E") == 1e4 && names.at("nu") == 0.25));
  BOOST_TEST((names.at("rho") == 4 && names.at("c") == 50));
  BOOST_TEST(names.at("c_s") == std::sqrt(4000.0 / 4), tt::tolerance(1e-15));        // G = E/2.5
  BOOST_TEST(names.at("c_d") == std::sqrt(1e4 / 0.9375 / 4), tt::tolerance(1e-15));  // plane stress: E/(1 − ν²)
  const auto bare = expression_constants(parse_case(pure, "plate.toml"));
  BOOST_TEST((bare.at("Lx") == 2 && bare.at("Ly") == 1 && bare.at("d") == 0.5));
  BOOST_TEST((!bare.contains("E") && !bare.contains("c_d")));
}

// ---- mistakes -------------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(an_unknown_key_names_its_neighbour) {
  wrong(alone(), "cell_aspect = 1.25", "cell_aspct = 1.25", {"plate.cell_aspct", "1.25", "\"cell_aspect\""});
  wrong(alone(), "beta = 0.5", "beeta = 0.5", {"material.beeta", "\"beta\""});
  wrong(alone(), "capped = false", "caped = false", {"damage.caped", "\"capped\""});
  wrong(alone(), "saturates = false", "saturate = false", {"diffusion.saturate", "\"saturates\""});
  wrong(pure, "corner_rate = -0.5", "corner_rates = -0.5\ncorner_rate = -0.5",
        {"diffusion.corner_rates", "\"corner_rate\""});
  wrong(alone(), "acceleration = [", "accelerations = [", {"body_force.accelerations", "\"acceleration\""});
  wrong(alone(), "slope = 0.5 }", "slope = 0.5, slop = 1 }", {"material.compression.slop", "\"slope\""});
  wrong_here(alone(), "[body_force]", "[bodyforce]", {"bodyforce", "\"body_force\""});
  wrong(alone(), "direction = \"normal\"", "directon = \"normal\"", {"load 3: directon", "\"direction\""});
  wrong(alone(), "shrinks = false", "shrink = false", {"gate \"radius\": shrink", "\"shrinks\""});
  // What bars have, plates have not.
  wrong(elastic_mode, "[exact]", "[contact]\nfem = \"bonded\"\n[exact]", {"contact", "unknown key"});
}

BOOST_AUTO_TEST_CASE(numbers_out_of_their_range_are_refused) {
  wrong_here(alone(), "width = 1.0", "width = 0", {"plate.width", "found 0", "> 0"});
  wrong_here(alone(), "height = 1.5", "height = \"1.5\"", {"plate.height", "found \"1.5\"", "> 0"});
  wrong(alone(), "cell_aspect = 1.25", "cell_aspect = inf", {"plate.cell_aspect", "found inf", "finite"});
  wrong(alone(), "nu = 0.3", "nu = 0.5", {"material.nu", "found 0.5", "-1 < nu < 0.5"});
  wrong(alone(), "nu = 0.3", "nu = -1", {"material.nu", "found -1", "-1 < nu < 0.5"});
  wrong(alone(), "nu = 0.3", "nu = nan", {"material.nu", "found nan"});
  wrong(alone(), "rho = 2500", "rho = -2500", {"material.rho", "found -2500", "> 0"});
  wrong(alone(), "strength = 1e8", "strength = -1e8", {"material.compression.strength", "-1", ">= 0"});
  wrong(alone(), "slope = 0.5", "slope = -0.5", {"material.compression.slope", "-0.5", ">= 0"});
  wrong(alone(), "K_IC = 2e6", "K_IC = 0", {"material.K_IC", "found 0", "> 0"});
  wrong(alone(), "m = 6.5", "m = 0", {"material.m", "> 0"});
  wrong(alone(), "beta = 0.5", "beta = -0.5", {"material.beta", ">= 0"});
  wrong(alone(), "residual_stiffness = 0.01", "residual_stiffness = 0", {"material.residual_stiffness", "> 0"});
  wrong(alone(), "critical_strain = 0.003", "critical_strain = 0", {"damage.critical_strain", "> 0"});
  wrong(alone(), "reference_rate = 200", "reference_rate = 0", {"damage.reference_rate", "> 0"});
  wrong(alone(), "T_d = 0.02", "T_d = 0", {"diffusion.T_d", "> 0"});
  wrong(alone(), "lambda1 = 400", "lambda1 = -1", {"diffusion.lambda1", ">= 0"});
  wrong(alone(), "lambda2 = 0.03", "lambda2 = 0", {"diffusion.lambda2", "> 0"});
  wrong(alone(), "rupture_strain = 0.04", "rupture_strain = 0", {"diffusion.rupture_strain", "> 0"});
  wrong(alone(), "radius = 0.2", "radius = 0", {"diffusion.radius", "> 0"});
  wrong(alone(), "drift = 0.1", "drift = -0.1", {"diffusion.drift", ">= 0"});
  wrong(alone(), "saturates = false", "saturates = 0", {"diffusion.saturates", "true or false"});
  wrong(alone(), "pic = 0.25", "pic = 1.25", {"model.pic", "found 1.25", "0 (FLIP) to 1 (PIC)"});
  wrong(alone(), "core = 0.05", "core = 0", {"exact.core", "> 0"});
  wrong(elastic_mode, "mode = 2", "mode = 0", {"exact.mode", "1 to 1000"});
  wrong(elastic_mode, "amplitude = -1e-3", "amplitude = 0", {"exact.amplitude", "other than 0"});
  wrong(pure, "at = [0.01] }", "at = [0] }", {"sample.times.at", "> 0"});
  wrong(alone(), "at = [1e-4, 2e-4]", "at = [2e-4, 1e-4]", {"sample.times.at", "ascending"});
  wrong(alone(), "times = { unit = \"s\"", "times = { unit = \"L/c\"", {"sample.times.unit", "\"s\""});
}

BOOST_AUTO_TEST_CASE(names_that_are_not_known_are_refused_with_the_nearest) {
  wrong_here(alone(), "model = \"tensile-damage\"", "model = \"tensile-damaged\"",
             {"material.model", "\"tensile-damage\"?"});
  wrong(alone(), "plane = \"strain\"", "plane = \"strains\"", {"material.plane", "\"strain\"?"});
  wrong(alone(), "volumetric = \"trace\"", "volumetric = \"tr\"", {"material.volumetric", "\"mean\", \"trace\""});
  wrong(alone(), "shows = \"everywhere\"", "shows = \"everwhere\"", {"damage.shows", "\"everywhere\"?"});
  wrong(alone(), "source = \"zone\"", "source = \"zoned\"", {"diffusion.source", "\"zone\"?"});
  wrong(alone(), "scheme = \"rkl2\"", "scheme = \"rkl\"", {"diffusion.scheme", "\"rkl2\"?"});
  wrong(alone(), "reading = \"radial\"", "reading = \"radian\"", {"diffusion.reading", "\"radial\"?"});
  wrong_here(alone(), "direction = \"shear\"", "direction = \"sheer\"", {"load 2: direction", "\"shear\"?"});
  wrong(alone(), "history = \"ramp\"", "history = \"rampp\"", {"load 1: history", "\"ramp\"?"});
  wrong(elastic_mode, "start = \"moving\"", "start = \"move\"", {"exact.start", "\"displaced\", \"moving\""});
  wrong_here(elastic_mode, "solution = \"lame-mode\"", "solution = \"lamé-mode\"", {"exact.solution", "\"lame-mode\""});
  wrong_here(elastic_mode, "solution = \"lame-mode\"\nmode = 2\namplitude = -1e-3\nstart = \"moving\"",
             "solution = \"corner-source\"", {"exact.solution", "\"corner-source\"", "\"roller-mode\""});
  wrong_here(pure, "solution = \"corner-source\"", "solution = \"lame-mode\"", {"exact.solution", "\"corner-source\""});
  wrong(elastic_mode, "\"mpm-usf\"", "\"diffusion\"", {"axes.method", "\"mpm-usf\""});
  wrong(pure, "method = [\"diffusion\"]", "method = [\"fem\"]", {"axes.method", "found \"fem\"", "\"diffusion\""});
  wrong_here(whole, "variant = [\"\", \"tracked\"]", "variant = [\"\", \"trakced\"]",
             {"axes 1: variant", "\"tracked\"?"});
  wrong(whole, "where = { variant = \"tracked\"", "where = { variant = \"track\"", {"where.variant", "\"tracked\"?"});
}

BOOST_AUTO_TEST_CASE(what_is_missing_is_said) {
  says(without(alone(), {"width"}), "[plate]", {"plate.width", "missing", "> 0"});
  expect_at(without(elastic_mode, {"plane = "}), "[material]", {"material.plane", "missing", "\"strain\", \"stress\""});
  expect_at(without(alone(), {"K_IC"}), "[material]", {"material.K_IC", "missing"});
  expect_at(without(alone(), {"T_d"}), "[diffusion]", {"diffusion.T_d", "missing"});
  expect_at(without(alone(), {"rise = {"}), "[[load]]", {"load 1: rise", "missing", "unit = \"s\""});
  expect_at(without(elastic_mode, {"bottom = "}), "[supports]", {"supports.bottom", "missing", "\"platen\""});
  says(replaced(elastic_mode, "features = [\"elastic\"]\n", ""), "[model]", {"model.features", "missing"});
  // Tables, all of them at the top of the file.
  says(replaced(without(pure, {"diffusivity", "rate = ", "scheme = \"crank", "reading"}), "[diffusion]\n", ""),
       "schema", {"diffusion", "missing", "[diffusion]"});
  expect_at(replaced(without(elastic_mode, {"\"free\""}), "[supports]\n", ""), "schema", {"supports", "missing"});
  expect_at(without(pure, {"[model]", "features"}), "schema", {"model", "missing", "[model]"});
}

BOOST_AUTO_TEST_CASE(sides_have_names) {
  const std::string text = replaced(elastic_mode, "bottom = \"free\"", "botom = \"free\"");
  const std::string said = message(text);
  BOOST_TEST(lines(said).size() == 2u, said);  // one side is missing, the other unknown
  BOOST_TEST(holds(said, "supports.bottom: missing"), said);
  BOOST_TEST(holds(said, "supports.botom: found an unknown key (= \"free\")"), said);
  BOOST_TEST(holds(said, "did you mean \"bottom\"?"), said);
  wrong(elastic_mode, "top = \"free\"", "top = \"fixd\"", {"supports.top", "found \"fixd\"", "\"fixed\"?"});
  wrong(alone(), "at = \"top\"", "at = \"topp\"",
        {"load 1: at", "\"left\", \"right\", \"bottom\", \"top\"", "\"top\"?"});
}

BOOST_AUTO_TEST_CASE(there_is_one_platen) {
  expect_at(replaced(alone(), "left = \"roller\"", "left = \"platen\""), "[supports]",
            {"supports", "two platens", "at most one"});
}

BOOST_AUTO_TEST_CASE(driven_sides_have_a_velocity_and_others_none) {
  expect_at(without(alone(), {"velocity = [\"0\", \"-0.1*t*x*(Lx-x)\"]"}), "[supports]",
            {"supports.velocity", "missing", "two expressions of x, y and t"});
  expect_at(replaced(alone(), "bottom = \"driven\"", "bottom = \"roller\""), "velocity = [\"0\"",
            {"supports.velocity", "without a driven side"});
  wrong(alone(), "velocity = [\"0\", \"-0.1*t*x*(Lx-x)\"]", "velocity = [\"-0.1*t*x*(Lx-x)\"]",
        {"supports.velocity", "a list of 2"});
  wrong(alone(), "velocity = [\"0\", \"-0.1*t*x*(Lx-x)\"]", "velocity = \"-0.1*t*x*(Lx-x)\"",
        {"supports.velocity", "a list of 2"});
  wrong(alone(), "velocity = [\"0\", \"-0.1*t*x*(Lx-x)\"]", "velocity = [0, \"-0.1*t*x*(Lx-x)\"]",
        {"supports.velocity, entry 1", "found 0", "in quotes"});
}

BOOST_AUTO_TEST_CASE(loads_act_on_what_is_free_to_move) {
  const auto load = [](const std::string& at, const std::string& direction) {
    return "[[load]]\nat = \"" + at + "\"\ndirection = \"" + direction +
           "\"\nhistory = \"step\"\ntraction = 1\n[body_force]";
  };
  const auto refused = [&](const std::string& at, const std::string& direction) {
    expect_at(replaced(alone(), "[body_force]", load(at, direction)), "at = \"" + at + "\"\ndirection = \"" + direction,
              {"load 4: at", "a " + direction + " load on the " + at + " side, which is held so", "free to move"});
  };
  refused("left", "normal");    // roller
  refused("bottom", "normal");  // driven
  refused("bottom", "shear");
  refused("top", "shear");  // platen
  BOOST_TEST(good(alone(), "[body_force]", load("left", "shear")).plate->loads.size() == 4u);
  const std::string fixed = replaced(alone(), "left = \"roller\"", "left = \"fixed\"");
  expect_at(replaced(fixed, "[body_force]", load("left", "shear")), "at = \"left\"", {"load 4: at", "held so"});
  expect_at(replaced(alone(), "[body_force]", load("right", "shear")),
            "at = \"right\"\ndirection = \"shear\"\nhistory = \"step\"",
            {"load 4: at", "a second load of this kind on the right side", "one of each direction"});
}

BOOST_AUTO_TEST_CASE(keys_that_belong_to_another_choice_are_refused) {
  const auto doubled = [](const std::string& text, const std::string& after, const std::string& key,
                          const std::vector<std::string>& parts) {
    expect_at(replaced(text, after, after + '\n' + key), key, parts);
  };
  const std::string plain = alone();
  doubled(plain, "rise = { value = 50e-6, unit = \"s\" }", "duration = { value = 1, unit = \"s\" }",
          {"load 1: duration", "history = \"ramp\"", "with history = \"impulse\""});
  doubled(plain, "traction = \"P*sin(t)\"", "start = { value = 1, unit = \"s\" }",
          {"load 2: start", "history = \"expression\"", "\"step\", \"ramp\", \"impulse\""});
  doubled(plain, "traction = -3", "rise = { value = 1, unit = \"s\" }", {"load 3: rise", "history = \"impulse\""});
  doubled(plain, "reference_rate = 200", "rate_floor = 1", {"damage.rate_floor", "\"reference\"", "\"tracked\""});
  doubled(elastic_mode, "rho = 4", "K_IC = 1e6", {"material.K_IC", "\"elastic\"", "\"tensile-damage\""});
  doubled(elastic_mode, "amplitude = -1e-3", "core = 0.1", {"exact.core", "\"lame-mode\"", "\"corner-source\""});
  doubled(elastic_mode, "amplitude = -1e-3", "velocity = [\"0\", \"0\"]", {"exact.velocity", "\"expressions\""});
  doubled(plain, "core = 0.05", "mode = 1", {"exact.mode", "\"expressions\"", "\"lame-mode\""});
  doubled(pure, "core = 0.1", "concentration = \"1\"", {"exact.concentration", "\"corner-source\""});
  expect_at(replaced(plain, "source = \"zone\"", "source = \"node\""), "radius = 0.2",
            {"diffusion.radius", "source = \"node\"", "\"zone\""});
}

BOOST_AUTO_TEST_CASE(some_choices_do_not_go_together) {
  const std::string plain = alone();
  expect_at(replaced(plain, "plane = \"strain\"", "plane = \"stress\""), "compression = {",
            {"material.compression", "plane stress", "plane = \"strain\""});
  wrong_here(plain, "displacements = \"infinitesimal\"", "displacements = \"finite\"",
             {"model.displacements", "\"finite\" beside damage", "\"infinitesimal\""});
}

BOOST_AUTO_TEST_CASE(a_mistake_of_the_scene_does_not_lose_its_variants) {
  wrong(whole, "beta = 0.5", "beta = -0.5", {"material.beta"});
  wrong(whole, "velocity = [\"0\", \"-0.1*t*x*(Lx-x)\"]", "velocity = [\"0\"]", {"supports.velocity"});
}

BOOST_AUTO_TEST_CASE(a_stale_factorisation_needs_a_scheme_that_damps) {
  expect_at(replaced(alone(), "\"rkl2\"", "\"crank-nicolson\""), "drift = 0.1",
            {"diffusion.drift", "found 0.1 with \"crank-nicolson\"", "0: it does not damp"});
}

BOOST_AUTO_TEST_CASE(mpm_refuses_what_it_cannot_take) {
  says(replaced(elastic_mode, "courant = [0.5]", "courant = [0.5]\nparticles = [9]"), "method = [",
       {"method", "9 × 9 particles in a cell", "at most 8 × 8"});
  const std::string finite = replaced(elastic_mode, "[model]\nfeatures = [",
                                      "[model]\ndisplacements = \"finite\"\nfeatures = [\"convection\", ");
  const std::string loaded = replaced(replaced(finite, "solution = \"lame-mode\"", "solution = \"s-wave\""), "[model]",
                                      "[[load]]\nat = \"top\"\nhistory = \"step\"\ntraction = 1\n[model]");
  says(loaded, "method = [", {"method", "finite displacements and a load", "allowed: free sides"});
  BOOST_TEST(message(replaced(loaded, "\"fem\", \"mpm-usf\", \"mpm-usl\", \"mpm-musl\"", "\"fem\"")).find("finite") ==
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(damage_and_what_drives_it_go_with_its_material) {
  wrong(elastic_mode, "[supports]", "[damage]\ncritical_strain = 1\nrate = \"tracked\"\n[supports]",
        {"damage", "beside an elastic material", "material.model = \"tensile-damage\""});
  const std::string driven =
      "[diffusion]\nT_d = 1\nlambda1 = 1\nlambda2 = 1\nrupture_strain = 1\nsource = \"node\"\n[supports]";
  wrong(elastic_mode, "[supports]", driven,
        {"diffusion", "beside a material without damage", "material.model = \"tensile-damage\" and [damage]"});
  const std::string plain = alone();
  const std::size_t from = plain.find("[damage]"), to = plain.find("[diffusion]");
  says(replaced(plain, plain.substr(from, to - from), ""), "schema", {"damage: missing", "[damage]"});
}

BOOST_AUTO_TEST_CASE(what_needs_a_material_is_refused_without) {
  const auto refused = [](const std::string& table, const std::string& keys) {
    expect_at(replaced(pure, "[model]", table + '\n' + keys + "\n[model]"), table,
              {"in a scene without [material]", "allowed: with one"});
  };
  refused("[supports]", "left = \"free\"\nright = \"free\"\nbottom = \"free\"\ntop = \"free\"");
  refused("[damage]", "critical_strain = 1");
  refused("[[load]]", "at = \"top\"");
  refused("[body_force]", "acceleration = [\"0\", \"1\"]");
  wrong(pure, "concentration = \"1 + cos", "velocity = [\"0\", \"0\"]\nconcentration = \"1 + cos",
        {"initial.velocity", "unknown key", "allowed: concentration"});
}

BOOST_AUTO_TEST_CASE(expressions_must_be_formulas_of_what_is_known_there) {
  const std::string plain = alone();
  wrong(plain, "traction = \"P/2\"", "traction = \"P*t\"", {"load 1: traction", "\"t\""});
  wrong(plain, "traction = \"P*sin(t)\"", "traction = \"P*sin(x)\"", {"load 2: traction", "\"x\""});
  wrong(plain, "velocity = [\"0.1*x\", \"y\"]", "velocity = [\"0.1*x\", \"y*t\"]",
        {"initial.velocity, entry 2", "\"t\""});
  wrong(plain, "velocity = [\"0\", \"-0.1*t*x*(Lx-x)\"]", "velocity = [\"z\", \"-0.1*t*x*(Lx-x)\"]",
        {"supports.velocity, entry 1", "\"z\""});
  wrong(plain, "\"-9.81*t\"", "\"-9.81*tt\"", {"body_force.acceleration, entry 2", "tt"});
  wrong(plain, "\"x + y + t\"", "\"x + L\"", {"exact.concentration", "\"L\""});  // a bar's
  wrong(plain, "\"nu*E*t\"", "\"nu*EE*t\"", {"exact.stress, entry 2", "EE"});
  wrong(plain, "stress = [\"E*t\", \"nu*E*t\", \"0\"]", "stress = [\"E*t\", \"nu*E*t\"]",
        {"exact.stress", "a list of 3"});
  wrong(pure, "\"d*(1 + x*y)\"", "\"d*(1 + t)\"", {"diffusion.diffusivity", "\"t\""});
  wrong(pure, "\"d*(1 + x*y)\"", "\"E*x\"", {"diffusion.diffusivity", "\"E\""});  // without a material
  wrong(pure, "concentration = \"1 + cos(pi*x/Lx)*cos(pi*y/Ly)\"", "concentration = \"t\"",
        {"initial.concentration", "\"t\""});
  wrong(pure, "d = 0.5", "c_d = 1\nd = 0.5", {"parameters.c_d", "a name that expressions have already"});
  wrong(pure, "d = 0.5", "y = 1\nd = 0.5", {"parameters.y", "a name that expressions have already"});
}

BOOST_AUTO_TEST_CASE(expressions_must_be_finite) {
  const std::string plain = alone();
  wrong(plain, "\"x + y + t\"", "\"1/(x - Lx)\"",
        {"exact.concentration", "which is inf at x = 1, y = 0, t = 0", "the corners and the middle"});
  wrong(plain, "\"x + y + t\"", "\"sqrt(y - Ly)\"", {"exact.concentration", "which is NaN at x = 0, y = 0"});
  wrong(plain, "traction = \"P*sin(t)\"", "traction = \"P/t\"", {"load 2: traction", "at t = 0"});
  wrong(plain, "traction = \"P/2\"", "traction = \"P/0\"", {"load 1: traction"});
  wrong(pure, "\"d*(1 + x*y)\"", "\"d/y\"", {"diffusion.diffusivity", "at x = 0, y = 0"});
}

BOOST_AUTO_TEST_CASE(a_solution_needs_its_plate) {
  for (const auto& [mode, plate] : {std::pair{"lame-mode", elastic_mode}, std::pair{"roller-mode", on_rollers()}}) {
    const std::string text = replaced(plate, "lame-mode", mode);
    expect_at(replaced(text, "height = 2.0", "height = 1.0"), "solution = ",
              {"exact.solution", '"' + std::string(mode) + "\" of a rectangle", "on a square: width = height"});
  }
  // Its supports are part of a mode.
  expect_at(replaced(elastic_mode, "left = \"free\"", "left = \"fixed\""),
            "solution = ", {"exact.solution", "\"lame-mode\" of a plate that is held", "four free sides"});
  for (const char* mode : {"roller-mode", "p-wave"})
    expect_at(replaced(replaced(on_rollers(), "lame-mode", mode), "top = \"roller\"", "top = \"free\""), "solution = ",
              {"exact.solution", '"' + std::string(mode) + "\" of a plate held otherwise", "four sides on rollers"});
  // At its corner the source's concentration is infinite.
  says(without(pure, {"core"}), "[exact]", {"exact.core", "missing", "> 0"});
  expect_at(without(pure, {"corner_rate"}),
            "solution = ", {"exact.solution", "\"corner-source\" without one", "diffusion.corner_rate other than 0"});
  expect_at(replaced(pure, "corner_rate = -0.5", "corner_rate = 0"), "solution = ", {"exact.solution"});
}

BOOST_AUTO_TEST_CASE(probes_read_what_the_plate_has) {
  const auto probe = [](const std::string& text, const std::string& keys, const std::vector<std::string>& parts) {
    const std::string list = "probes = [\n";
    std::string with = text;
    if (!holds(text, list))
      with = replaced(text, "at = [0.01] }\n", "at = [0.01] }\nprobes = [\n{ id = \"new\", " + keys + " },\n]\n");
    else
      with = replaced(text, list, list + "{ id = \"new\", " + keys + " },\n");
    expect_at(with, "{ id = \"new\"", parts);
  };
  const std::string plain = alone();
  probe(plain, R"(reads = "radius", level = 0.05)", {"probes 1: angle", "missing"});
  probe(plain, R"(reads = "radius", angle = 45)", {"probes 1: level", "missing"});
  probe(plain, R"(reads = "radius", level = 0.05, angle = 91)", {"probes 1: angle", "91", "0 to 90 degrees"});
  probe(plain, R"(reads = "radius", level = 0, angle = 0)", {"probes 1: level", "> 0"});
  probe(plain, R"(reads = "area", level = 0.05, angle = 0)", {"probes 1: angle", "\"area\"", "\"radius\""});
  probe(plain, R"(reads = "largest", level = 0.05)", {"probes 1: level", "\"largest\"", "\"radius\", \"area\""});
  probe(plain, R"(reads = "total", at = [0, 0])", {"probes 1: at", "\"total\"", "\"concentration\""});
  probe(plain, R"(reads = "acoustic-angle", at = [0, 0])", {"probes 1: at", "\"acoustic-angle\""});
  probe(plain, R"(reads = "velocity-z", at = [0, 0])", {"probes 1: reads", "\"velocity-x\"?"});
  probe(plain, R"(reads = "stress-xx", at = [1.1, 0])", {"probes 1: at", "[1.1, 0]", "in the plate"});
  probe(plain, R"(reads = "stress-xx", at = [0, 1.6])", {"probes 1: at", "[0, 1.6]", "in the plate"});
  probe(plain, R"(reads = "stress-xx", at = [0.5])", {"probes 1: at", "[x, y] in the plate"});
  probe(plain, R"(reads = "stress-xx", at = [-0.1, 0])", {"probes 1: at, entry 1", ">= 0"});
  const std::string elastic_reads =
      R"("displacement-x", "displacement-y", "velocity-x", "velocity-y", "stress-xx", "stress-yy", "stress-xy")";
  probe(elastic_mode, R"(reads = "radius", level = 0.05, angle = 0)", {"probes 1: reads", elastic_reads});
  probe(elastic_mode, R"(reads = "concentration", at = [0, 0])", {"probes 1: reads", elastic_reads});
  // With damage alone there is no concentration.
  const std::size_t from = plain.find("[diffusion]"), to = plain.find("[supports]");
  const std::string local =
      replaced(replaced(plain, plain.substr(from, to - from), ""), "\"damage\", \"diffusion\"", "\"damage\"");
  says(local, "{ id = \"t\"", {"probes 4: reads", "found \"total\"", "\"largest\""});
  says(local, "{ id = \"c\"", {"probes 5: reads", "found \"concentration\""});
  says(replaced(plain, "{ id = \"s\", reads = \"stress-xy\", at = [1.0, 0] }", "{ id = \"s\", reads = \"stress-xy\" }"),
       "{ id = \"s\"", {"probes 6: at", "missing"});
  wrong(pure, "reads = \"total\"", "reads = \"stress-xx\"", {"probes 2: reads", "\"concentration\", \"total\""});
  wrong(pure, "{ id = \"t\"", "{ id = \"p\"", {"probes 2: id", "\"p\" again", "an id of its own"});
}

BOOST_AUTO_TEST_CASE(a_variant_is_the_scene_with_some_keys_set_otherwise) {
  const Case c = parse_case(whole, "plate.toml");
  BOOST_REQUIRE_EQUAL(c.variants.size(), 1u);
  const PlateVariant& tracked = c.variants[0];
  BOOST_TEST((tracked.id == "tracked" && tracked.says == "the largest rate met"));
  BOOST_TEST((tracked.plate.cracking()->evolution.rate == diffusion::Rate::tracked &&
              tracked.plate.cracking()->evolution.rate_floor == 3));
  BOOST_TEST((c.plate->cracking()->evolution.rate == diffusion::Rate::reference));  // the scene itself stays
  // All else is the same.
  BOOST_TEST((tracked.plate.width == 1 && tracked.plate.cell_aspect == 1.25 && tracked.plate.pic == 0.25));
  BOOST_TEST((tracked.plate.supports == c.plate->supports && tracked.plate.loads.size() == 3u));
  BOOST_TEST(tracked.plate.cracking()->evolution.diffusion->radius == 0.2);
  BOOST_TEST(tracked.plate.exact.concentration == "x + y + t");

  const auto changed = [](const std::string& set) {
    return good(whole,
                "set = { \"damage.rate\" = \"tracked\", \"damage.rate_floor\" = 3 }\nwithout = "
                "[\"damage.reference_rate\"]",
                set)
        .variants[0]
        .plate;
  };
  const PlateSpec pulled = changed("set = { load = [{ at = \"top\", history = \"step\", traction = 1 }] }");
  BOOST_REQUIRE_EQUAL(pulled.loads.size(), 1u);  // the whole list is another
  BOOST_TEST((pulled.loads[0].history == "step" && pulled.loads[0].traction == "1"));
  const PlateSpec local = changed("without = [\"diffusion\"]");
  BOOST_TEST((local.cracking() && !local.cracking()->evolution.diffusion));
  BOOST_TEST(changed("without = [\"load\", \"body_force\", \"initial\"]").loads.empty());
  BOOST_TEST(!changed("without = [\"material.compression\"]").cracking()->compression);
  BOOST_TEST(changed("set = { \"plate.height\" = 1.6 }").height == 1.6);
  BOOST_TEST(changed("set = { \"material.compression.slope\" = 2 }").cracking()->compression->slope ==
             2);  // of a table in a table
  BOOST_TEST(changed("set = { \"material.compression.slope\" = 2 }").cracking()->compression->strength == 1e8);
  const PlateSpec held = changed("set = { \"supports.left\" = \"fixed\" }");
  BOOST_TEST((held.supports[0] == Edge::Support::fixed && held.supports[1] == Edge::Support::free));
  // A key that the scene lacks is made, its table too.
  const std::string bare = replaced(without(whole, {"compression = ", "acceleration"}), "[body_force]\n", "");
  const std::string features = replaced(bare, "\"compression-plasticity\", \"platen\", \"body-force\"", "\"platen\"");
  const Case made = good(features, "set = {", "set = { \"body_force.acceleration\" = [\"1\", \"0\"], ");
  BOOST_TEST((made.variants[0].plate.body_force == Pair{"1", "0"} && made.plate->body_force[0].empty()));

  const Leaf leaf{"fem", 10, 0.5, {}, {{"P", 6e8}}, "tracked"};
  const Case run = with_parameters(c, leaf);
  BOOST_TEST((run.plate->cracking()->evolution.rate == diffusion::Rate::tracked && run.parameters.at("P") == 6e8));
  BOOST_TEST((with_parameters(c, {"fem", 10, 0.5, {}, {}, ""}).plate->cracking()->evolution.rate ==
              diffusion::Rate::reference));
  BOOST_TEST(parameters_label(leaf) == "tracked P=600000000");
  // Each combination is a run: FEM 4 meshes · 2 parameters · 2 variants, MPM the same for each of 2 arrangements.
  BOOST_TEST(leaves(c).size() == 48u);
}

BOOST_AUTO_TEST_CASE(mistakes_of_variants_are_reported) {
  const std::string floor = "\"damage.rate_floor\" = 3 }", rate = "without = [\"damage.reference_rate\"]";
  const auto also = [&](const std::string& set, const std::vector<std::string>& parts) {
    wrong(whole, floor, "\"damage.rate_floor\" = 3, " + set + " }", parts);
  };
  // Keys of what is no part of the scene.
  also("\"damages.rate\" = \"tracked\"",
       {"variant 1: set.damages.rate", "found \"damages.rate\"", "\"damage\", \"diffusion\", \"supports\""});
  also("\"sample.times\" = 1", {"found \"sample.times\"", "keys of the scene's tables"});
  also("\"parameters.P\" = 1", {"found \"parameters.P\"", "keys of the scene's tables"});
  wrong(whole, rate, "without = [\"damage.reference_rate\", \"axes\"]", {"variant 1: without", "found \"axes\""});
  // What would be a mistake in the file is one in the variant, which is named.
  const auto wrongly = [&](const std::string& set, const std::vector<std::string>& parts) {
    std::vector<std::string> all{"variant \"tracked\": "};
    all.insert(all.end(), parts.begin(), parts.end());
    also(set, all);
  };
  wrongly("\"plate.width\" = \"wide\"", {"plate.width", "found \"wide\"", "> 0"});
  wrongly("\"diffusion.schem\" = \"rkl2\"", {"diffusion.schem", "unknown key", "did you mean \"scheme\"?"});
  wrongly("\"damage.shows\" = \"everwhere\"", {"damage.shows", "\"everywhere\"?"});
  wrongly("\"material.compression.slop\" = 2", {"material.compression.slop", "\"slope\"?"});
  also("\"supports.right\" = \"fixed\", \"load\" = [{ at = \"right\", history = \"step\", traction = 1 }]",
       {"load 1: at", "held so"});
  wrongly("\"initial.velocity\" = [\"1/x\", \"0\"]", {"initial.velocity, entry 1", "at x = 0"});
  wrongly("\"diffusion\" = 3", {"diffusion", "found 3", "one table [diffusion]"});
  says(replaced(whole, rate, ""), "reference_rate = 200",
       {"variant \"tracked\": damage.reference_rate", "does not belong to rate = \"tracked\""});
  const std::string set = "set = { \"damage.rate\" = \"tracked\", " + floor;
  says(replaced(whole, set, ""), "[damage]", {"variant \"tracked\": damage.reference_rate", "missing"});
  // The solution is that of the file, on another plate.
  const std::string mode = replaced(
      elastic_mode, "[exact]", "[[variant]]\nid = \"flat\"\nsays = \"t\"\nset = { \"plate.height\" = 1 }\n[exact]");
  expect_at(mode, "solution = ", {"variant \"flat\": exact.solution", "of a rectangle"});

  expect_at(replaced(replaced(whole, set, ""), rate, ""), "[[variant]]", {"variant 1", "no change", "set or without"});
  const std::string variant = "[[variant]]\nid = \"tracked\"\nsays = \"again\"\nwithout = [\"initial\"]\n[exact]";
  expect_at(replaced(whole, "[exact]", variant), "id = \"tracked\"\nsays = \"again\"",
            {"variant 2: id", "\"tracked\" again", "an id of its own"});
  says(without(whole, {"says = "}), "[[variant]]", {"variant 1: says", "missing"});
  wrong(whole, "says = ", "say = \"x\"\nsays = ", {"variant 1: say", "\"says\"?"});
}

BOOST_AUTO_TEST_CASE(features_are_exactly_those_in_use) {
  wrong(elastic_mode, "features = [\"elastic\"]", "features = [\"elastic\", \"platen\"]",
        {"model.features", "found \"platen\"", "exactly the features in use"});
  wrong(elastic_mode, "features = [\"elastic\"]", "features = [\"elasticity\"]",
        {"model.features, entry 1", "\"elastic\"?"});
  const std::string plain = alone();
  for (const auto& [feature, key] :
       std::vector<std::pair<std::string, std::string>>{{"\"pic\", ", "model.pic"},
                                                        {"\"damage\", ", "material.model = \"tensile-damage\""},
                                                        {"\"diffusion\", ", "[diffusion]"},
                                                        {"\"compression-plasticity\", ", "material.compression"},
                                                        {"\"platen\", ", "a platen in [supports]"}}) {
    const std::string name = feature.substr(0, feature.size() - 2);
    std::string text = plain;
    text.erase(text.find(feature, text.find("features = ")), feature.size());
    expect_at(text, "features = ", {"model.features", "missing " + name, key});
  }
  expect_at(replaced(plain, ", \"body-force\"]", "]"), "features = ", {"missing \"body-force\"", "[body_force]"});
  // A mode sets its own start.
  expect_at(replaced(elastic_mode, "features = [\"elastic\"]\n",
                     "features = [\"body-force\", \"elastic\"]\n[body_force]\nacceleration = [\"0\", \"1\"]\n"),
            "[body_force]", {"body_force", "sets its own start"});
  // What a variant switches on is not declared.
  BOOST_TEST((plate_features(with_parameters(parse_case(whole, "plate.toml"), {})).size() == 6u));
}

BOOST_AUTO_TEST_CASE(meshes_have_the_aspect_that_is_asked_for) {
  // 1.5 up in cells of 1.25/10: 12 of them fit to the bit.
  BOOST_TEST((cells_of(*parse_case(whole, "plate.toml").plate, 10).y == 12));
  BOOST_TEST(grid_of(*parse_case(whole, "plate.toml").plate, 10).hy == 0.125);
  // Rounded to whole cells: 1.95 up in cells of 1 makes 2.
  const auto plate = [](const std::string& height, const std::string& cells) {
    return replaced(replaced(pure, "height = 1.0", "height = " + height), "cells = [10]", "cells = [" + cells + "]");
  };
  const std::string low = replaced(plate("1.95", "2"), "at = [1, 1]", "at = [0, 0]");
  BOOST_TEST(message(low) == "");
  BOOST_TEST((cells_of(*parse_case(low, "plate.toml").plate, 2).y == 2));
  BOOST_TEST((cells_of(*parse_case(low, "plate.toml").plate, 20).y == 20));
  // So many cells that no machine holds them.
  expect_at(plate("1.0", "20000"), "[axes]", {"axes", "found 20000 × 10000 cells", "at most 1e+08"});
}

BOOST_AUTO_TEST_CASE(gates_judge_what_plates_have) {
  // Quantities of another kind.
  wrong(
      whole, "quantity = \"concentration.balance\"", "quantity = \"contour.distance\"",
      {"gate \"balance\": quantity", "\"contour.distance\", which is not for kind = \"invariant\"", "\"area.error\""});
  wrong(whole, "quantity = \"probe.r\"", "quantity = \"stress.L2\"",
        {"gate \"radius\": quantity", "not for kind = \"agreement\"", "\"contour.distance\", \"platen.history\""});
  wrong_here(whole, "quantity = \"probe.t\"", "quantity = \"platen.history\"",
             {"gate \"size\": quantity", "not for kind = \"exact\""});
  wrong(whole, "quantity = \"probe.r\"", "quantity = \"probe.radius\"",
        {"gate \"radius\": quantity", "found \"probe.radius\"", "probes are declared in [sample]"});
  wrong(elastic_mode, "quantity = \"critical_courant\"", "quantity = \"critical_courants\"",
        {"gate \"limit\": quantity", "\"critical_courant\"?"});
  wrong(pure, "quantity = \"concentration.balance\"", "quantity = \"concentration.balanc\"",
        {"gate \"balance\": quantity", "\"concentration.balance\"?"});
  // What bars have.
  wrong(whole, "quantity = \"concentration.balance\"", "quantity = \"bits.alone\"", {"found \"bits.alone\""});
  wrong(elastic_mode, "kind = \"limit\"", "kind = \"limits\"", {"gate \"limit\": kind", "\"agreement\""});
  // What [exact] does not give.
  wrong(elastic_mode, "quantity = \"stress.L1\"", "quantity = \"concentration.L1\"",
        {"gate \"order\": quantity", "where [exact] does not give it"});
  wrong(pure, "quantity = \"concentration.L2\"", "quantity = \"stress.L2\"", {"where [exact] does not give it"});
  const std::string some = replaced(alone(), "stress = [\"E*t\", \"nu*E*t\", \"0\"]\n", "");
  const auto also = [&](const std::string& text, const std::string& gate) {
    return replaced(text, "[[figure]]", "[[gate]]\nid = \"new\"\nreason = \"r\"\n" + gate + "\n[[figure]]");
  };
  const std::string stress = "kind = \"exact\"\nmax = 1\nquantity = \"stress.L2\"";
  BOOST_TEST(message(also(alone(), stress)) == "");
  expect_at(also(some, stress), "quantity = \"stress.L2\"",
            {"gate \"new\": quantity", "where [exact] does not give it"});
  // A prediction is of modes alone.
  wrong(elastic_mode, "predict = \"mode\"", "predict = \"discrete-step\"", {"gate \"constant\": predict", "\"mode\""});
  // Nothing is free of units where strain rates are measured in 1/s.
  expect_at(also(alone(), "kind = \"invariant\"\nmax = 0\nquantity = \"bits.power-of-two\""), "\"bits.power-of-two\"",
            {"gate \"new\": quantity", "of a plate with damage", "elastic"});
  expect_at(also(replaced(alone(), "ledger = true", "ledger = false"),
                 "kind = \"invariant\"\nmax = 0\nquantity = \"energy.drift\""),
            "\"energy.drift\"", {"with run.ledger = false", "run.ledger = true"});
}

BOOST_AUTO_TEST_CASE(gates_need_what_they_are_about) {
  const auto gate = [](const std::string& text, const std::string& keys, const std::string& what) {
    const std::string quantity = keys.substr(keys.find("quantity"));
    const std::string new_gate = "[[gate]]\nid = \"new\"\nreason = \"r\"\n" + keys + "\n";
    says(text + new_gate, quantity, {"gate \"new\": quantity", "without " + what, "allowed: with it"});
  };
  const std::string invariant = "kind = \"invariant\"\nmax = 0\n",
                    agreement = "kind = \"agreement\"\nmax = 1\njudged = [8]\n";
  gate(elastic_mode, invariant + "quantity = \"bits.undamaged\"", "damage");
  gate(elastic_mode, invariant + "quantity = \"cross.forward-euler\"", "damage that diffuses");
  gate(elastic_mode, invariant + "quantity = \"concentration.balance\"", "diffusion");
  gate(elastic_mode, agreement + "quantity = \"platen.history\"", "a platen");
  gate(elastic_mode, agreement + "level = 0.1\nquantity = \"contour.distance\"", "damage");
  gate(pure, invariant + "quantity = \"energy.drift\"", "a material");
  gate(pure, invariant + "quantity = \"bits.repeat\"", "a material");
}

BOOST_AUTO_TEST_CASE(an_agreement_is_of_two_methods_on_the_same_four_meshes) {
  const std::string one = "where = { particles = 2, variant = \"\", parameters = { P = 7e8 } }\nmax = 1.0";
  const auto where = [&](const std::string& keys, const std::vector<std::string>& parts) {
    const std::string other = "where = { " + keys + " }";
    says(replaced(whole, one, other + "\nmax = 1.0"), other, parts);
  };
  where("variant = \"\", parameters = { P = 7e8 }, method = \"fem\"", {"gate \"radius\": where", "1 methods", "two"});
  where("variant = \"\", parameters = { P = 7e8 }, cells = [20, 40, 80]", {"where", "3 meshes", "at least 4"});
  where("particles = 2, variant = \"\"", {"where", "more than method and mesh", "P=600000000", "one of them"});
  where("particles = 2, parameters = { P = 7e8 }", {"where", "more than method and mesh", "tracked"});
}

BOOST_AUTO_TEST_CASE(an_agreement_says_where_it_is_judged) {
  says(without(whole, {"judged = [40, 80]"}), "[[gate]]\nid = \"radius\"", {"gate \"radius\": judged", "missing"});
  wrong(whole, "judged = [40, 80]", "judged = [40, 160]", {"gate \"radius\": judged", "found 160", "10, 20, 40, 80"});
  wrong(whole, "judged = [40, 80]", "judged = [40, 40]", {"gate \"radius\": judged, entry 2", "each value once"});
  says(without(whole, {"max = 1.0"}), "[[gate]]\nid = \"radius\"", {"gate \"radius\": max", "missing"});
  wrong(whole, "shrinks = false\ntimes", "level = 0.05\nshrinks = false\ntimes",
        {"gate \"radius\": level", "quantity = \"probe.r\"", "\"contour.distance\""});
  says(without(whole, {"level = 0.06"}), "[[gate]]\nid = \"contour\"", {"gate \"contour\": level", "missing", "> 0"});
  wrong(elastic_mode, "levels_min = 3", "judged = [8]\nlevels_min = 3", {"gate \"order\": judged", "\"agreement\""});
  wrong(elastic_mode, "levels_min = 3", "shrinks = true\nlevels_min = 3", {"gate \"order\": shrinks", "\"agreement\""});
}

BOOST_AUTO_TEST_CASE(an_order_over_the_time_step_needs_time_steps) {
  expect_at(replaced(pure, "courant = [0.25, 0.5, 1, 2]", "courant = [0.25, 0.5, 1]"), "[[gate]]\nid = \"order\"",
            {"gate \"order\": levels_min", "3 values of courant for diffusion, cells = 10", "at least levels_min = 4"});
  // Over the mesh there is but one.
  expect_at(without(pure, {"over = "}), "[[gate]]\nid = \"order\"",
            {"levels_min", "1 values of cells", "courant = 0.25"});
  wrong_here(pure, "over = \"courant\"", "over = \"time\"", {"gate \"order\": over", "\"cells\", \"courant\""});
  expect_at(replaced(pure, "max = 1e-12", "max = 1e-12\nover = \"cells\""), "over = \"cells\"",
            {"gate \"balance\": over", "kind = \"invariant\"", "\"order\""});
}

BOOST_AUTO_TEST_CASE(broken_files_never_crash) {
  std::mt19937 random(20020917);
  const std::vector<std::string> scraps{"0",  "-1",   "nan", "1e400", "\"\"",    "[]",   "{}",  "[[]]",
                                        "[[", "]]",   "\n",  "=",     "\"",      ".",    "inf", "true",
                                        "# ", "\xc3", ",",   "{",     "\"x*t\"", "9e18", "[{}]"};
  const auto survives = [](const std::string& text) {
    const std::string said = message(text);
    if (!said.empty() && said.rfind("plate.toml:", 0) != 0) BOOST_ERROR("without its place: " + said);
  };
  for (const std::string& base : {whole, elastic_mode, pure, struck, shocked}) {
    read_broken(base, scraps, 29, 200, random, survives);
  }
}

// ---- plates that a flyer strikes ------------------------------------------------------------------------------------

namespace {

/// `line` is put after `place`, and is the mistake.
void added(const std::string& text, const std::string& place, const std::string& line,
           const std::vector<std::string>& parts) {
  const std::string with = replaced(text, place + '\n', place + '\n' + line + '\n');
  const std::string marked = replaced(text, place + '\n', place + "\n#" + line + '\n');  // the line may stand elsewhere
  const std::string all = message(with);
  const std::string at = "plate.toml:" + std::to_string(line_of(marked, '#' + line)) + ':';
  BOOST_TEST(lines(all).size() == 1u, "wanted one line about '" << line << "', have\n" << all);
  BOOST_TEST(all.rfind(at, 0) == 0, "wanted " << at << ", have\n" << all);
  for (const std::string& part : parts) BOOST_TEST(holds(all, part), "wanted '" << part << "' in\n" << all);
  BOOST_TEST(holds(all, "allowed"), "nothing is said of what is allowed:\n" << all);
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_key_of_a_failure_wave_is_read) {
  BOOST_REQUIRE_EQUAL(message(struck), "");
  const Case c = parse_case(struck, "plate.toml");
  const PlateSpec& plate = *c.plate;
  BOOST_TEST((plate.width == 42e-3 && plate.rows == 2 && plate.cell_aspect == 1));
  const material::FailureWave& law = plate.failing()->law;
  BOOST_TEST((law.elastic.youngs_modulus == 72.8e9 && law.elastic.poissons_ratio == 0.222));
  BOOST_TEST((law.elastic.density == 2563 && law.elastic.plane == material::Plane::strain));
  BOOST_TEST((law.threshold == 2.75e9 && law.most_converted == 0.5));
  BOOST_TEST((!plate.diffusion && !plate.face));
  BOOST_REQUIRE(plate.failing());
  BOOST_TEST(
      (plate.failing()->spread.diffusivity == 8 && plate.failing()->spread.profile == diffusion::Profile::rising));
  BOOST_TEST((plate.failing()->spread.scheme == diffusion::Scheme::rkl2 && plate.failing()->spread.drift == 0.25));
  BOOST_TEST(plate.failing()->spread.keeps_largest);
  BOOST_REQUIRE(plate.flyer.has_value());
  BOOST_TEST((plate.flyer->thickness == 18e-3 && plate.flyer->velocity == 684));
  BOOST_TEST((plate.flyer->gap == 2 && plate.flyer->gap_unit == "cells"));
  BOOST_REQUIRE(plate.viscosity.has_value());
  BOOST_TEST((plate.viscosity->c1 == 0.2 && plate.viscosity->c2 == 0.3 && plate.viscosity->bulk == 0.5));
  BOOST_TEST((plate.viscosity->length == 2 && plate.viscosity->always));
  BOOST_TEST((plate.viscosity->form == material::Viscosity::Form::york));
  BOOST_TEST((c.features == std::vector<std::string>{"diffusion", "failure-wave", "impact", "viscosity"}));
  BOOST_REQUIRE_EQUAL(c.gauges.size(), 2u);
  BOOST_TEST((c.gauges[0].id == "near" && c.gauges[0].from_face == 4.5e-3 && c.gauges[1].id == "far"));
  BOOST_REQUIRE_EQUAL(c.gates.size(), 6u);
  BOOST_TEST((c.gates[0].kind == "settling" && c.gates[0].quantity == "gauge.near.yy"));
  BOOST_TEST(criterion<SettlingCriterion>(c.gates[0]).max == 0.9);
  BOOST_TEST(criterion<RatioCriterion>(c.gates[1]).theory == "diffusion-front");
  BOOST_TEST(criterion<BoundCriterion>(c.gates[2]).expect.value() == 1500);
  BOOST_TEST(criterion<BoundCriterion>(c.gates[3]).expect.value() == 1);
  BOOST_REQUIRE_EQUAL(c.figures.size(), 2u);
  BOOST_TEST((c.figures[0].kind == "gauges" && c.figures[1].kind == "failure"));
  BOOST_TEST((c.figures[1].pictures == std::vector<std::string>{"fig16"}));
  const reports::Case shown = drawn_case(c);
  const reports::Figure& figure = shown.figures.at(0);
  BOOST_REQUIRE_EQUAL(figure.panels.size(), 2u);  // all gauges of the case as it stands
  BOOST_TEST(figure.y_label == "−σ_y [GPa]");
  BOOST_TEST((figure.x_min == 0 && figure.x_max == 2 && figure.y_min == -1 && figure.y_max == 4));
  const auto& spans = figure.panels[0].spans;
  BOOST_REQUIRE_EQUAL(spans.size(), 2u);
  BOOST_TEST((spans[0].label == "both" && spans[1].label == "one"));
  BOOST_TEST(spans[0].from == 4.5e-3 / 2100 * 1e6 + 0.1, tt::tolerance(1e-12));
  BOOST_TEST(spans[0].to == 4.5e-3 / 800 * 1e6 + 0.7, tt::tolerance(1e-12));
  BOOST_TEST(spans[1].from == 4.5e-3 / 2000 * 1e6, tt::tolerance(1e-12));
  BOOST_TEST(spans[1].to == spans[1].from);
  const reports::Page& page = shown.pages.at(0).second;
  BOOST_REQUIRE_EQUAL(page.sections.size(), 2u);  // nothing is said of the model
  BOOST_TEST((page.sections[1].heading == "h" && page.sections[1].text.at(0) == "s"));
  BOOST_TEST(page.sections[1].rows.size() == 2u);  // a row for each method
}

BOOST_AUTO_TEST_CASE(keys_of_a_struck_plate_have_usual_values) {
  const Case c = parse_case(
      without(struck, {"scheme = ", "drift = ", "face_holds", "gap = ", "bulk = ", "length = ", "acts = "}), "t");
  BOOST_TEST(
      (c.plate->failing()->spread.scheme == diffusion::Spread{}.scheme && c.plate->failing()->spread.drift == 0));
  BOOST_TEST(!c.plate->failing()->spread.keeps_largest);
  BOOST_TEST((c.plate->flyer->gap == 0 && c.plate->flyer->gap_unit == "m"));
  BOOST_TEST((c.plate->viscosity->bulk == 0.75 && !c.plate->viscosity->always));
  BOOST_TEST(c.plate->viscosity->length == std::sqrt(2.0), tt::tolerance(1e-15));
  for (const auto& [name, profile] :
       {std::pair{"falling", diffusion::Profile::falling}, std::pair{"constant", diffusion::Profile::constant}})
    BOOST_TEST((good(struck, "\"rising\"", '"' + std::string(name) + '"').plate->failing()->spread.profile == profile));
  BOOST_TEST((good(struck, "value = 2, unit = \"cells\"", "value = 1e-4, unit = \"m\"").plate->flyer->gap == 1e-4));
  // An impact face without a flyer, and what is there at the start.
  std::string alone = without(struck, {"gap = ", "thickness = ", "velocity = ", "from_face", "gauges = ["});
  alone = replaced(alone.substr(0, alone.find("[[gate]]")), "[flyer]\n", "");
  alone = replaced(alone, "]\n]\n", "]\n");
  alone = replaced(alone, ", \"impact\"", "");
  alone = replaced(alone, "drift = 0.25", "face = 6e-3\n[initial]\ndilatancy = \"x*y\"");
  alone += "[[gate]]\nid = \"g\"\nkind = \"invariant\"\nquantity = \"concentration.least\"\nmax = 0\nreason = \"r\"\n";
  BOOST_REQUIRE_EQUAL(message(alone), "");
  const Case held = parse_case(alone, "t");
  BOOST_TEST((held.plate->face == 6e-3 && held.plate->initial_concentration == "x*y" && !held.plate->flyer));
  BOOST_TEST((spread_of(held, 14).face == 2 && spread_of(held, 14).start.size() == 15u * 3));
  expect_at(replaced(alone, "face = 6e-3", "face = 7e-3"), "[diffusion]",
            {"diffusion", "the impact face at 1.16667 cells of the mesh of 7 cells", "a column of nodes"});
  wrong(alone, "face = 6e-3", "face = 43e-3", {"diffusion.face", "found 0.043", "0 to 0.042 m"});
  wrong(alone, "dilatancy = \"x*y\"", "dilatancys = \"x*y\"", {"initial.dilatancys", "\"dilatancy\"?"});
  wrong(alone, "dilatancy = \"x*y\"", "dilatancy = \"x*t\"", {"initial.dilatancy"});
  // Along x the two sides are not alike.
  wrong(alone, "quantity = \"concentration.least\"", "quantity = \"bits.mirror\"", {"gate \"g\": quantity", "face"});
}

BOOST_AUTO_TEST_CASE(mistakes_in_a_failing_material_are_told) {
  for (const auto& [from, to, key] :
       std::vector<std::array<std::string, 3>>{{"rows = 2", "row = 2", "\"rows\"?"},
                                               {"threshold = ", "treshold = ", "\"threshold\"?"},
                                               {"f_max = ", "fmax = ", "\"f_max\"?"},
                                               {"d0 = 8.0", "d00 = 8.0", "\"d0\"?"},
                                               {"profile = ", "profil = ", "\"profile\"?"},
                                               {"drift = ", "drif = ", "\"drift\"?"},
                                               {"thickness = ", "thicknes = ", "\"thickness\"?"},
                                               {"gap = ", "gaps = ", "\"gap\"?"},
                                               {"c2 = 0.3", "c3 = 0.3", "c1, c2"},
                                               {"acts = ", "act = ", "\"acts\"?"},
                                               {"from_face = 4.5e-3", "from_fac = 4.5e-3", "\"from_face\"?"},
                                               {"gauges = [", "gauge = [", "\"gauges\"?"},
                                               {"[flyer]", "[flier]", "\"flyer\"?"},
                                               {"components = ", "component = ", "\"components\"?"},
                                               {"time_range = ", "time_rang = ", "\"time_range\"?"},
                                               {"delay = [", "delays = [", "\"delay\"?"},
                                               {"pictures = ", "picture = ", "\"pictures\"?"},
                                               {"says = \"s\"", "say = \"s\"", "\"says\"?"}})
    says(replaced(struck, from, to), to, {key});
  says(replaced(struck, "model = \"failure-wave\"", "model = \"failure\""), "model = \"failure\"",
       {"material.model", "\"failure-wave\"?"});
}

BOOST_AUTO_TEST_CASE(numbers_of_a_failure_wave_have_their_ranges) {
  wrong(struck, "d0 = 8.0", "d0 = -8.0", {"diffusion.d0", "found -8", ">= 0"});
  BOOST_TEST(message(replaced(struck, "d0 = 8.0", "d0 = 0")) == "");
  wrong(struck, "f_max = 0.5", "f_max = 1.0001", {"material.f_max", "found 1.0001", "0 to 1"});
  wrong(struck, "f_max = 0.5", "f_max = -0.5", {"material.f_max", "found -0.5", ">= 0"});
  BOOST_TEST(message(replaced(struck, "f_max = 0.5", "f_max = 1")) == "");
  BOOST_TEST(message(replaced(struck, "f_max = 0.5", "f_max = 0")) == "");
  wrong(struck, "threshold = 2.75e9", "threshold = -1", {"material.threshold", "found -1", ">= 0"});
  wrong(struck, "\"rising\"", "\"rises\"", {"diffusion.profile", "\"falling\", \"constant\", \"rising\""});
  wrong(struck, "\"largest\"", "\"all\"", {"diffusion.face_holds", "\"present\", \"largest\""});
  wrong(struck, "\"rkl2\"", "\"rkl3\"", {"diffusion.scheme", "\"rkl2\"?"});
  wrong(struck, "drift = 0.25", "drift = -1", {"diffusion.drift", "found -1"});
  says(replaced(struck, "\"rkl2\"", "\"crank-nicolson\""), "drift",
       {"diffusion.drift", "0.25 with \"crank-nicolson\""});
  wrong(struck, "plane = \"strain\"", "plane = \"stress\"", {"material.plane", "\"stress\" of a failure wave"});
  added(struck, "f_max = 0.5", "compression = { strength = 1e8, slope = 0 }",
        {"material.compression", "beside a failure wave"});
  for (const char* key : {"threshold", "f_max", "d0", "profile"})
    says(without(struck, {std::string(key) + " = "}),
         key == std::string("d0") || key == std::string("profile") ? "[diffusion]" : "[material]",
         {"." + std::string(key), "missing"});
  // Keys of other materials, and this one's with them.
  added(struck, "f_max = 0.5", "K_IC = 1e6", {"material.K_IC", "model = \"failure-wave\""});
  added(shocked, "plane = \"strain\"", "f_max = 0.5", {"material.f_max", "model = \"elastic\"", "\"failure-wave\""});
  added(struck, "d0 = 8.0", "T_d = 1", {"diffusion.T_d"});
  expect_at(replaced(struck, "[flyer]", "[damage]\ncritical_strain = 1\n[flyer]"), "[damage]",
            {"damage", "found beside"});
}

BOOST_AUTO_TEST_CASE(rows_stand_for_a_height) {
  added(struck, "rows = 2", "height = 1.0", {"plate.height", "found beside rows"});
  added(struck, "rows = 2", "cell_aspect = 2", {"plate.cell_aspect", "found beside rows"});
  wrong(struck, "rows = 2", "rows = 0", {"plate.rows", "found 0"});
  wrong(struck, "rows = 2", "rows = 1.5", {"plate.rows", "found 1.5"});
  const std::string tall = replaced(struck, "rows = 2", "height = 12e-3");
  BOOST_TEST(message(tall) == "");
  BOOST_TEST((cells_of(*parse_case(tall, "t").plate, 7).y == 2));
  BOOST_TEST((cells_of(*parse_case(struck, "t").plate, 42).y == 2));
  expect_at(replaced(replaced(struck, "rows = 2", "rows = 10000"), "28, 42]", "28, 42, 42000]"), "[axes]",
            {"axes", "42000 × 10000 cells", "at most 1e+08"});
}

BOOST_AUTO_TEST_CASE(a_flyer_strikes_a_target_on_every_mesh) {
  wrong(struck, "thickness = 18e-3", "thickness = 42e-3",
        {"flyer.thickness", "found 0.042", "less than the plate's width"});
  wrong(struck, "thickness = 18e-3", "thickness = 0", {"flyer.thickness", "found 0", "> 0"});
  wrong(struck, "velocity = 684.0", "velocity = -684.0", {"flyer.velocity", "found -684", "> 0"});
  wrong(struck, "value = 2, unit = \"cells\"", "value = -2, unit = \"cells\"", {"flyer.gap", "found -2", ">= 0"});
  wrong(struck, "value = 2, unit = \"cells\"", "value = 2, unit = \"mm\"", {"flyer.gap", "\"m\""});
  says(without(struck, {"velocity = "}), "[flyer]", {"flyer.velocity", "missing"});
  expect_at(replaced(struck, "thickness = 18e-3", "thickness = 15e-3"), "[flyer]",
            {"flyer", "the impact face at 2.5 cells of the mesh of 7 cells", "a column of nodes on every mesh"});
  BOOST_TEST(message(replaced(struck, "thickness = 18e-3", "thickness = 12e-3")) == "");
  expect_at(replaced(replaced(struck, "left = \"free\"", "left = \"driven\""), "top = \"roller\"",
                     "top = \"roller\"\nvelocity = [\"0\", \"0\"]"),
            "[flyer]", {"flyer", "beside a driven side or a platen"});
  expect_at(replaced(struck, "right = \"free\"", "right = \"platen\""), "[flyer]",
            {"beside a driven side or a platen"});
  expect_at(replaced(struck, "[model]", "[initial]\nvelocity = [\"0*x\", \"0*y\"]\n[model]"), "[initial]",
            {"initial", "beside [flyer]"});
  expect_at(replaced(struck, "d0 = 8.0", "d0 = 8.0\nface = 18e-3"), "[flyer]", {"flyer", "beside diffusion.face"});
}

BOOST_AUTO_TEST_CASE(finite_displacements_are_not_of_struck_particles) {
  // The message is about MPM, at the methods; FEM's mesh goes with the plate.
  const std::string finite = replaced(replaced(shocked, "[model]\n", "[model]\ndisplacements = \"finite\"\n"),
                                      "\"impact\"]", "\"impact\", \"convection\"]");
  expect_at(finite, "method = [\"fem\", \"mpm-musl\"]",
            {"axes.method", "MPM together with finite displacements and a flyer", "\"infinitesimal\""});
  BOOST_TEST(message(replaced(finite, "\"fem\", \"mpm-musl\"", "\"fem\"")) == "");
}

BOOST_AUTO_TEST_CASE(the_viscosity_of_a_plate_is_eq_21) {
  wrong(struck, "form = \"york\"", "form = \"linear-quadratic\"", {"viscosity.form", "\"york\""});
  says(without(struck, {"form = "}), "[viscosity]", {"viscosity.form", "missing", "\"york\""});
  wrong(struck, "c1 = 0.2", "c1 = -0.2", {"viscosity.c1", "found -0.2", ">= 0"});
  says(without(struck, {"c2 = "}), "[viscosity]", {"viscosity.c2", "missing"});
  wrong(struck, "bulk = 0.5", "bulk = 0", {"viscosity.bulk", "found 0", "> 0"});
  wrong(struck, "length = 2", "length = -2", {"viscosity.length", "found -2", "> 0"});
  wrong(struck, "\"always\"", "\"never\"", {"viscosity.acts", "\"compression\", \"always\""});
}

BOOST_AUTO_TEST_CASE(gauges_lie_in_the_target) {
  wrong(struck, "from_face = 6.5e-3", "from_face = 24.1e-3", {"from_face", "found 0.0241", "in the target", "0.024 m"});
  BOOST_TEST(message(replaced(struck, "from_face = 6.5e-3", "from_face = 24e-3")) == "");
  wrong(struck, "from_face = 6.5e-3", "from_face = 0", {"from_face", "found 0", "> 0"});
  wrong(struck, "  { id = \"far\", from_face = 6.5e-3 },",
        "  { id = \"far\", from_face = 6.5e-3 }, { id = \"near\", from_face = 1e-3 },",
        {"sample.gauges", "id", "\"near\" again"});
  added(elastic_mode, "[sample]", "gauges = [{ id = \"a\", from_face = 0.1 }]",
        {"sample.gauges", "from_face", "without [flyer]"});
}

BOOST_AUTO_TEST_CASE(features_of_struck_plates_are_declared) {
  expect_at(replaced(struck, "\"viscosity\", ", ""), "features", {"missing \"viscosity\"", "[viscosity] switches on"});
  expect_at(replaced(struck, ", \"impact\"", ""), "features", {"missing \"impact\"", "[flyer] switches on"});
  expect_at(replaced(struck, ", \"failure-wave\"", ""), "features", {"missing \"failure-wave\""});
  expect_at(replaced(shocked, "\"impact\"", "\"impact\", \"failure-wave\""), "features", {"found \"failure-wave\""});
}

BOOST_AUTO_TEST_CASE(an_impact_is_exact_for_elastic_plates_between_rollers) {
  BOOST_REQUIRE_EQUAL(message(shocked), "");
  BOOST_TEST(parse_case(shocked, "t").plate->exact.solution == "plate-impact");
  BOOST_TEST(make_plane_exact(parse_case(shocked, "t"))->name() == "plate-impact");
  const std::string place = "solution = \"plate-impact\"";
  std::string alone = without(shocked, {"thickness = ", "velocity = ", "gauges = "});
  alone = replaced(alone.substr(0, alone.find("[[gate]]")), "[flyer]\n", "");
  alone = replaced(alone, ", \"impact\"", "") +
          "[[gate]]\nid = \"g\"\nkind = \"exact\"\nquantity = \"stress.L1\"\nmax = 1\nreason = \"r\"\n";
  expect_at(alone, place, {"exact.solution", "\"plate-impact\" without a flyer", "[flyer]"});
  expect_at(replaced(struck, "[axes]", "[exact]\n" + place + "\n[axes]"), place,
            {"exact.solution", "of a solid that fails", "elastic"});
  for (const char* side : {"left", "right"})
    expect_at(replaced(shocked, std::string(side) + " = \"free\"", std::string(side) + " = \"roller\""), place,
              {"exact.solution", "held otherwise", "left and right sides free"});
  for (const char* side : {"bottom", "top"})
    expect_at(replaced(shocked, std::string(side) + " = \"roller\"", std::string(side) + " = \"free\""), place,
              {"exact.solution", "held otherwise"});
  added(shocked, place, "mode = 1", {"exact.mode", "solution = \"plate-impact\""});
  wrong(shocked, place, "solution = \"plate-inpact\"", {"exact.solution", "\"plate-impact\"?"});
}

BOOST_AUTO_TEST_CASE(dilatancy_may_diffuse_alone) {
  std::string alone =
      replaced(pure, pure.substr(pure.find("diffusivity"), pure.find("[model]") - pure.find("diffusivity")),
               "law = \"dilatancy\"\nd0 = 8.0\nprofile = \"falling\"\nscheme = \"forward-euler\"\n");
  alone = replaced(alone, "solution = \"corner-source\"\ncore = 0.1", "solution = \"face-front\"");
  alone = replaced(alone, "courant = [0.25, 0.5, 1, 2]", "courant = [0.03, 0.06, 0.12, 0.24]");
  BOOST_REQUIRE_EQUAL(message(alone), "");
  const Case c = parse_case(alone, "t");
  BOOST_REQUIRE(c.plate->diffusion->spread.has_value());
  BOOST_TEST((c.plate->diffusion->spread->diffusivity == 8 && !c.plate->failing()));
  BOOST_TEST((c.plate->diffusion->spread->profile == diffusion::Profile::falling));
  BOOST_TEST(make_plane_exact(c)->name() == "face-front");
  says(replaced(alone, "d0 = 8.0", "d0 = 8.0\ndiffusivity = 1"), "diffusivity = 1",
       {"diffusion.diffusivity", "with law = \"dilatancy\""});
  says(replaced(alone, "d0 = 8.0", "d0 = -8.0"), "d0 = -8.0", {"diffusion.d0", "found -8"});
  added(pure, "corner_rate = -0.5", "d0 = 1", {"diffusion.d0", "without law = \"dilatancy\""});
  added(pure, "corner_rate = -0.5", "law = \"dilatency\"", {"diffusion.law", "\"dilatancy\"?"});
  wrong(alone, "solution = \"face-front\"", "solution = \"corner-source\"", {"exact.solution", "\"face-front\""});
  wrong(pure, "solution = \"corner-source\"", "solution = \"face-front\"", {"exact.solution", "\"corner-source\""});
  says(replaced(pure, "[model]", "[flyer]\nthickness = 1.0\nvelocity = 1\n[model]"), "[flyer]",
       {"flyer", "without [material]"});
  says(replaced(pure, "[model]", "[viscosity]\nform = \"york\"\nc1 = 1\nc2 = 1\n[model]"), "[viscosity]",
       {"viscosity", "without [material]"});
}

BOOST_AUTO_TEST_CASE(gates_of_gauges_name_what_is_there) {
  wrong(struck, "quantity = \"gauge.near.yy\"", "quantity = \"gauge.neer.yy\"",
        {"gate \"settles\": quantity", "\"gauge.near.yy\"?"});
  wrong(struck, "quantity = \"gauge.near.yy\"", "quantity = \"gauge.near.plateau\"",
        {"gate \"settles\": quantity", "not for kind = \"settling\""});
  wrong_here(struck, "quantity = \"failure.speed\"", "quantity = \"failure.sped\"",
             {"gate \"speed\": quantity", "\"failure.speed\"?"});
  wrong(struck, "quantity = \"dilatancy.ahead\"", "quantity = \"gauge.near.arrival\"",
        {"gate \"ahead\": quantity", "not for kind = \"invariant\""});
  // A speed is of two gauges.
  says(replaced(without(struck, {"id = \"far\""}), "quantity = \"failure.speed\"", "quantity = \"failure.delay\""),
       "quantity = \"failure.delay\"", {"gate \"speed\": quantity"});
  // Theories of gauges are not of fields, nor that of modes of gauges.
  wrong(struck, "predict = \"diffusion-front\"", "predict = \"mode\"",
        {"gate \"front\": predict", "\"mode\" for \"gauge.near.failure\"", "\"diffusion-front\""});
  wrong(elastic_mode, "predict = \"mode\"", "predict = \"plate-impact\"",
        {"gate \"constant\": predict", "\"plate-impact\" for \"displacement.L2\"", "\"mode\""});
  wrong(struck, "predict = \"diffusion-front\"", "predict = \"diffusion-fron\"", {"predict", "\"diffusion-front\"?"});
  says(without(struck, {"expect = 1500"}), "[[gate]]\nid = \"speed\"", {"gate \"speed\": expect", "missing"});
  const auto also = [](const std::string& text, const std::string& quantity) {
    return text + "[[gate]]\nid = \"new\"\nreason = \"r\"\nkind = \"invariant\"\nmax = 0\nquantity = \"" + quantity +
           "\"\n";
  };
  expect_at(also(struck, "bits.mirror"), "quantity = \"bits.mirror\"",
            {"gate \"new\": quantity", "of a flyer, which comes from the left", "without [flyer]"});
  expect_at(also(struck, "bits.power-of-two"), "quantity = \"bits.power-of-two\"", {"of a plate with damage"});
  for (const char* quantity : {"bits.undamaged", "cross.forward-euler", "concentration.balance", "concentration.least",
                               "energy.dissipated", "impact.left-over", "bits.threads"})
    BOOST_TEST(message(also(struck, quantity)) == "", quantity);
  for (const char* quantity : {"bits.power-of-two", "impact.left-over", "energy.dissipated"})
    BOOST_TEST(message(also(shocked, quantity)) == "", quantity);
  for (const char* quantity : {"impact.left-over", "dilatancy.ahead"})
    says(also(elastic_mode, quantity), "quantity = \"" + std::string(quantity) + '"', {"without a flyer", "with it"});
  for (const char* quantity : {"bits.undamaged", "cross.forward-euler", "concentration.balance"})
    says(also(shocked, quantity), "quantity = \"" + std::string(quantity) + '"', {"without", "allowed: with it"});
}

BOOST_AUTO_TEST_CASE(settling_is_of_four_meshes_of_one_or_two_methods) {
  const auto where = [](const std::string& text, const std::string& keys, const std::vector<std::string>& parts) {
    const std::string other = "where = { " + keys + " }";
    says(replaced(text, "max = 0.9", other + "\nmax = 0.9"), other, parts);
  };
  where(struck, "cells = [7, 14, 28]", {"gate \"settles\": where", "found 3 meshes of fem", "at least 4"});
  BOOST_TEST(message(replaced(struck, "max = 0.9", "max = 0.9\nwhere = { method = \"fem\" }")) == "");
  const std::string three = replaced(struck, "\"fem\", \"mpm-musl\"", "\"fem\", \"mpm-musl\", \"mpm-usf\"");
  says(three, "[[gate]]\nid = \"settles\"", {"gate \"settles\": where", "found 3 methods", "one or two"});
  const std::string steps = replaced(struck, "courant = [0.3]", "courant = [0.3, 0.2]");
  where(steps, "method = \"fem\"", {"gate \"settles\": where", "more than the mesh", "courant = 0.2", "one of them"});
  const std::string grains = replaced(struck, "courant = [0.3]", "courant = [0.3]\nparticles = [2, [0.5]]");
  where(grains, "method = \"mpm-musl\"", {"gate \"settles\": where", "more than the mesh", "one of them"});
  says(without(struck, {"max = 0.9"}), "[[gate]]\nid = \"settles\"", {"gate \"settles\": max", "missing"});
  added(struck, "max = 0.9", "judged = [42]", {"gate \"settles\": judged", "kind = \"settling\"", "\"agreement\""});
}

// A page's prose takes the numbers of its own case, by names that the case has.
BOOST_AUTO_TEST_CASE(prose_of_a_page_asks_for_numbers_of_the_case) {
  const auto statement = [](const std::string& says) {
    return "statements = [{ says = \"" + says + "\", standing = \"choice\", source = \"ours\" }]";
  };
  const std::string at = "pictures = [\"fig16\"]", numbers = statement("E = {E} GPa, σ_x = {threshold_stress} GPa");
  const auto stated = [&](const std::string& text) {
    return drawn_case(parse_case(text, "t")).pages.at(0).second.sections.at(0).rows.at(0).name;
  };
  const std::string glass = replaced(struck, at, at + '\n' + numbers);
  BOOST_TEST(stated(glass) == "E = 72.8 GPa, σ_x = 3.85 GPa");
  BOOST_TEST(stated(replaced(replaced(glass, "E = 72.8e9", "E = 60e9"), "threshold = 2.75e9", "threshold = 2e9")) ==
             "E = 60 GPa, σ_x = 2.8 GPa");
  added(struck, at, statement("{treshold} GPa"),
        {"says", "found \"{treshold}\"", "f_max", "did you mean \"threshold\"?"});
  added(struck, at, statement("{} GPa"), {"says", "found \"{}\"", "\"E\", "});
  added(struck, at, statement("{E GPa"), {"says", "found \"{\"", "\"E\", "});
  added(struck, at, statement("E} GPa"), {"says", "found \"}\"", "\"E\", "});
  added(struck, at, "statements = [{ says = \"s\", standing = \"sure\", source = \"ours\" }]",
        {"standing", "\"certain\", \"reconstruction\", \"choice\""});
  const std::string unsourced = "statements = [{ says = \"s\", standing = \"choice\" }]";
  BOOST_TEST(holds(message(replaced(struck, at, at + '\n' + unsourced)), "source: missing"));
}

BOOST_AUTO_TEST_CASE(figures_of_gauges_draw_what_is_there) {
  wrong(struck, "components = [\"lateral\"]", "components = [\"across\"]",
        {"figure", "components", "\"longitudinal\", \"lateral\""});
  says(without(struck, {"components = "}), "[[figure]]\nid = \"fig16\"", {"components", "missing"});
  added(struck, "components = [\"lateral\"]", "gauges = [\"neer\"]", {"gauges", "\"near\"?"});
  added(struck, "components = [\"lateral\"]", "variants = [\"weak\"]", {"variants", "found \"weak\""});
  wrong(struck, "speed = 2000", "speed = [2000, 1000]", {"speed", "one speed, or [least, most]"});
  wrong(struck, "speed = 2000", "speed = [1000, 2000, 3000]", {"speed", "one speed, or [least, most]"});
  wrong(struck, "speed = 2000", "speed = 0", {"speed", "found 0", "> 0"});
  wrong(struck, "delay = [0.1e-6, 0.7e-6]", "delay = [0.7e-6, 0.1e-6]", {"delay"});
  wrong(struck, "delay = [0.1e-6, 0.7e-6]", "delay = [-1, 0.1e-6]", {"delay", ">= 0"});
  wrong(struck, "time_range = [0, 2e-6]", "time_range = [2e-6, 0]", {"time_range"});
  added(struck, "pictures = [\"fig16\"]", "components = [\"lateral\"]",
        {"components", "kind = \"failure\"", "\"gauges\""});
  wrong(struck, "variants = [\"\"] }", "variants = [\"weak\"] }", {"variants", "found \"weak\""});
  expect_at(replaced(struck, "pictures = [\"fig16\"]", "pictures = [\"fig17\"]"), "[[figure]]",
            {"figure", "\"fig17\"", "\"failure\""});
  // Without gauges there is nothing to draw.
  std::string none = without(shocked, {"gauges = "});
  none = none.substr(0, none.find("[[gate]]")) +
         "[[gate]]\nid = \"g\"\nkind = \"exact\"\nquantity = \"stress.L1\"\nmax = 1\nreason = \"r\"\n"
         "[[figure]]\nid = \"f\"\ncells = 42\n";
  says(none + "kind = \"gauges\"\ncomponents = [\"lateral\"]\n", "kind = \"gauges\"",
       {"figure", "without a gauge", "sample.gauges"});
  says(none + "kind = \"failure\"\n", "kind = \"failure\"", {"figure", "without a gauge", "sample.gauges"});
}

// What a variant changes is checked as what it changes.
BOOST_AUTO_TEST_CASE(variants_of_struck_plates_are_checked) {
  const auto with = [](const std::string& change, const std::string& more = "") {
    return replaced(replaced(struck, "[axes]", "[[variant]]\nid = \"v\"\nsays = \"s\"\n" + change + "\n[axes]"),
                    "courant = [0.3]\n", "courant = [0.3]\nvariant = [\"\", \"v\"]\n" + more);
  };
  std::string one = with("set = { \"flyer.thickness\" = 12e-3 }");
  for (const char* gate : {"settles", "agree"})
    one = replaced(one, "[[gate]]\nid = \"" + std::string(gate) + '"',
                   "[[gate]]\nwhere = { variant = \"\" }\nid = \"" + std::string(gate) + '"');
  BOOST_REQUIRE_EQUAL(message(one), "");
  BOOST_TEST(parse_case(one, "t").variants.at(0).plate.flyer->thickness == 12e-3);
  const auto other = [&](const std::string& change) {
    return replaced(one, "set = { \"flyer.thickness\" = 12e-3 }", change);
  };
  BOOST_TEST(message(other("without = [\"viscosity\"]")) == "");
  BOOST_TEST(!parse_case(other("without = [\"viscosity\"]"), "t").variants.at(0).plate.viscosity);
  const auto told = [&](const std::string& change, const std::string& part) {
    const std::string all = message(other(change));
    BOOST_TEST(holds(all, part), "wanted '" << part << "' for " << change << ", have\n" << all);
  };
  told("set = { \"material.f_max\" = 2 }", "variant \"v\": material.f_max");
  told("set = { \"flyer.thickness\" = 15e-3 }", "a column of nodes");
  told("set = { \"flyer.thickness\" = 36e-3 }", "in the target");
  // Gauges of a scene that nothing strikes: neither measured nor drawn.
  std::string still = other("without = [\"flyer\"]");
  BOOST_TEST(message(still) == "");
  still = replaced(still, "components = [\"lateral\"]", "components = [\"lateral\"]\nvariants = [\"\", \"v\"]");
  says(still, "variants = [\"\", \"v\"]", {"figure", "variants", "flyer"});
}

BOOST_AUTO_TEST_SUITE_END()
