#include "runner/app/case_file.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "runner/input/constants.hpp"
#include "runner/judge/bound.hpp"
#include "runner/judge/limit.hpp"
#include "runner/judge/order.hpp"
#include "runner/judge/ratio.hpp"
#include "tests/broken_text.hpp"
#include "tests/case_figures.hpp"
#include "tests/case_text.hpp"
#include "tests/criteria.hpp"
#include "tests/messages.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(case_file)

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;

namespace {

/// Every table, and every key of those kinds of load, material and solution that may stand together.
const std::string whole = R"toml(schema = 1
id = "bar.step.fixed-free"
title = "Fixed-free bar"
claim = "code-verification"
why = "plane wave and its reflections"
paper = { figures = ["1", "3a"] }
units = "paper"
)toml" + paper_bar + R"toml([[load]]
at = "right"
history = "impulse"
traction = 2
start = { value = 0.25, unit = "L/c" }
duration = { value = 1.0, unit = "s" }
transfer = "node"
[parameters]
A = 0.1
k_2 = -3
[model]
features = ["elastic"]
[exact]
solution = "bar-wave"
[axes]
method = ["fem", "mpm-musl"]
cells = [100, 200, 400, 800]
courant = [0.5, 1]
particles = [[0.5], 2]
[sample]
times = { unit = "L/c", at = [0.5, 1.7] }
probes = [{ id = "end", field = "stress", at = { value = 0.995, unit = "L" } }]
[run]
allow_unstable = true
ledger = true
[[gate]]
id = "magic"
kind = "exact"
quantity = "stress.Linf"
where = { method = "fem", courant = 1.0, cells = [100, 200], particles = [0.25, 0.75] }
times = [0.5]
max = 1e-12
reason = "magic time step"
[[gate]]
id = "slope"
kind = "order"
quantity = "stress.L1"
where = { method = ["fem"] }
expect = 0.5
band = [0.4, 0.55]
levels_min = 3
slow = true
reason = "theory of dispersive fronts"
[[gate]]
id = "theory"
kind = "constant"
quantity = "displacement.L2"
predict = "airy-step"
ratio = [0.98, 1.02]
reason = "Airy front"
[[gate]]
id = "energy"
kind = "invariant"
quantity = "energy.drift"
max = 1e-12
reason = "leapfrog keeps it"
[[gate]]
id = "limit"
kind = "limit"
quantity = "critical_courant"
predict = "stability-limit"
ratio = [0.99, 1.01]
steps = 500
reason = "von Neumann"
[[gate]]
id = "blows-up"
kind = "limit"
quantity = "stable"
outcome = "unstable"
reason = "above the limit"
[[figure]]
id = "fig1"
field = "velocity"
times = [0.5]
captions = ["on its way"]
cells = 200
courant = 0.5
methods = ["mpm-musl"]
particles = [0.5]
range = [-1.5, 1.5]
)toml";

/// A smooth scene of the user's own: expressions throughout, hardening, no named solution.
const std::string own = head("own", "regression") + R"toml([bar]
length = 2
[material]
model = "hardening"
E = 200e9
rho = 7850
E_t = 2e9
yield_stress = 250e6
[supports]
left = "free"
right = "free"
[[load]]
at = "left"
history = "expression"
traction = "sin(3*t)"
transfer = "boundary-layer"
thickness = { value = 1, unit = "cells" }
[[load]]
at = "right"
history = "ramp"
traction = -1
rise = { value = 0.5, unit = "L/c" }
[body_force]
acceleration = "x*t"
[initial]
velocity = "A*sin(pi*x/(2*L))"
stress = "0"
[parameters]
A = 0.1
[model]
displacements = "finite"
features = ["convection", "plasticity", "body-force", "boundary-layer"]
[exact]
solution = "expressions"
stress = "E*A*x*t"
velocity = "A*x"
displacement = "A*x*t"
[axes]
method = ["mpm-usl"]
cells = [10]
courant = [0.25]
[sample]
times = { unit = "s", at = [1e-4] }
[[gate]]
id = "g"
kind = "exact"
quantity = "velocity.L2"
max = 0.01
reason = "r"
)toml";

/// Bars that collide: every key of rows, viscosity, contact, swept parameters and figures of motion.
const std::string row = head("row", "code-verification", "paper") + R"toml([material]
model = "elastic"
E = 1e4
rho = 1
[parameters]
v0 = 1.0
k = 2
[[bar]]
length = 0.5
velocity = "v0"
[[bar]]
gap = { value = 2, unit = "cells" }
length = 0.25
velocity = -0.5
material = { model = "hardening", E = 4e4, rho = 4, E_t = 1e4, yield_stress = 60 }
[[bar]]
length = 1.0
[supports]
left = "free"
right = "fixed"
[viscosity]
form = "york"
c1 = "k/4"
c2 = 0
bulk = 0.7
length = 1.2
acts = "always"
[contact]
fem = "bonded"
[model]
displacements = "finite"
features = ["contact", "convection", "plasticity", "viscosity"]
[exact]
solution = "impact"
[[axes]]
method = ["fem"]
cells = [20, 40, 80]
courant = [0.25, 0.5]
parameters = { v0 = [0.5, 1.0] }
[[axes]]
method = ["mpm-musl"]
cells = [20, 40, 80]
courant = [0.1]
parameters = { v0 = [0.5, 1.0] }
[sample]
times = { unit = "L/c", from = "contact", at = [-1.0, 0.5, 3] }
probes = [{ id = "far", field = "velocity", at = { value = 1.5, unit = "L" } }]
[[gate]]
id = "begin"
kind = "constant"
quantity = "contact.begin"
predict = "impact"
where = { method = "fem", parameters = { v0 = 1.0 } }
ratio = [0.99, 1.01]
reason = "r"
[[gate]]
id = "late"
kind = "order"
quantity = "contact.duration.error"
where = { parameters = { v0 = [0.5, 1] } }
levels_min = 3
expect = 1
band = [0.5, 1.5]
reason = "r"
[[gate]]
id = "rest"
kind = "exact"
quantity = "contact.restitution"
max = 1
reason = "r"
[[gate]]
id = "closure"
kind = "invariant"
quantity = "energy.closure"
max = 1e-12
reason = "r"
[[figure]]
id = "motion"
kind = "motion"
title = "Motion"
cells = 20
courant = { fem = 0.5, mpm-musl = 0.1 }
parameters = { v0 = 1.0 }
zoom = { x = [0.4, 0.6], t = [-1, 3] }
magnify = 10
choices = "all of them"
[[figure]]
id = "profiles"
kind = "profiles"
field = "stress"
times = [0.5]
captions = ["c"]
cells = 20
courant = 0.1
methods = ["mpm-musl"]
parameters = { v0 = 0.5 }
range = [-1, 1]
)toml";

std::string message(const std::string& text) {
  return message_of<InputError>([&] { parse_case(text, "bar.toml"); });
}

/// Some one line of the message holds all the parts, and stands at the line of the file that holds `at`.
void expect(const std::string& text, const std::string& at, const std::vector<std::string>& parts) {
  const std::string all = message(text);
  std::string place = "bar.toml:";
  if (!at.empty()) place += std::to_string(line_of(text, at)) + ':';
  bool found = false;
  for (const std::string& line : lines(all)) {
    found = found || (line.starts_with(place) && holds_all(line, parts));
    BOOST_TEST(line.rfind("bar.toml:", 0) == 0, "a line without its place: " << line);
  }
  std::string wanted = place;
  for (const std::string& part : parts) wanted += " | " + part;
  BOOST_TEST(found, "wanted one line with\n  " << wanted << "\nhave\n" << all);
}

/// The same, and it is the only mistake: no mistake drags others after it.
void expect_alone(const std::string& text, const std::string& at, const std::vector<std::string>& parts) {
  expect(text, at, parts);
  BOOST_TEST(lines(message(text)).size() == 1u, "more than one line:\n" << message(text));
}

/// `from` in the whole case becomes `to`.
void wrong(const std::string& from, const std::string& to, const std::vector<std::string>& parts) {
  expect_alone(replaced(whole, from, to), to.substr(0, to.find('\n')), parts);
}
void wrong_own(const std::string& from, const std::string& to, const std::vector<std::string>& parts) {
  expect_alone(replaced(own, from, to), to.substr(0, to.find('\n')), parts);
}
void wrong_row(const std::string& from, const std::string& to, const std::vector<std::string>& parts) {
  expect_alone(replaced(row, from, to), to.substr(0, to.find('\n')), parts);
}

/// Two equal bars without hardening, for which there is an exact solution of their own.
std::string perfectly_plastic() {
  std::string text = replaced(row, "model = \"elastic\"\nE = 1e4\nrho = 1\n",
                              "model = \"hardening\"\nE = 1e4\nrho = 1\nE_t = 0\nyield_stress = 75\n");
  text = replaced(text, "length = 0.25\n", "length = 0.5\n");
  text = replaced(text, "material = { model = \"hardening\", E = 4e4, rho = 4, E_t = 1e4, yield_stress = 60 }\n", "");
  text = replaced(text, "[[bar]]\nlength = 1.0\n", "");
  text = replaced(text, "right = \"fixed\"", "right = \"free\"");
  text = replaced(text, "[contact]\nfem = \"bonded\"\n", "");
  text = replaced(text, "solution = \"impact\"", "solution = \"plastic-impact\"");
  text = replaced(text, "predict = \"impact\"", "predict = \"plastic-impact\"");
  return text;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_key_is_read) {
  BOOST_REQUIRE_EQUAL(message(whole), "");
  const Case c = parse_case(whole, "bar.toml");
  BOOST_TEST(c.path == "bar.toml");
  BOOST_TEST(c.id == "bar.step.fixed-free");
  BOOST_TEST(c.title == "Fixed-free bar");
  BOOST_TEST(c.claim == "code-verification");
  BOOST_TEST(c.why == "plane wave and its reflections");
  BOOST_TEST((c.paper_figures == std::vector<std::string>{"1", "3a"}));
  BOOST_TEST(c.units == "paper");
  BOOST_REQUIRE_EQUAL(c.bars.size(), 1u);
  BOOST_TEST(c.first().length == 1.0);
  BOOST_TEST(!c.convected);
  BOOST_TEST(std::get<material::Elastic>(c.first().material).youngs_modulus == 1e4);
  BOOST_TEST(std::get<material::Elastic>(c.first().material).density == 1.0);
  BOOST_TEST((c.left == Support::fixed && c.right == Support::free));
  BOOST_REQUIRE_EQUAL(c.loads.size(), 1u);
  const LoadSpec& load = c.loads[0];
  BOOST_TEST((load.end == End::right && load.transfer == Transfer::node));
  BOOST_TEST(load.history == "impulse");
  BOOST_TEST(load.traction == 2.0);
  BOOST_TEST((load.start.value == 0.25 && load.start.unit == "L/c"));
  BOOST_TEST((load.duration.value == 1.0 && load.duration.unit == "s"));
  BOOST_TEST((c.parameters == std::map<std::string, double>{{"A", 0.1}, {"k_2", -3}}));
  BOOST_TEST((c.features == std::vector<std::string>{"elastic"}));
  BOOST_TEST(c.exact.solution == "bar-wave");
  BOOST_REQUIRE_EQUAL(c.axes.size(), 1u);
  BOOST_TEST((c.axes[0].method == std::vector<std::string>{"fem", "mpm-musl"}));
  BOOST_TEST((c.axes[0].cells == std::vector<int>{100, 200, 400, 800}));
  BOOST_TEST((c.axes[0].courant == std::vector<double>{0.5, 1}));
  BOOST_TEST((c.axes[0].particles == std::vector<std::vector<double>>{{0.5}, {0.25, 0.75}}));
  BOOST_TEST(c.time_unit == "L/c");
  BOOST_TEST((c.times == std::vector<double>{0.5, 1.7}));
  BOOST_REQUIRE_EQUAL(c.probes.size(), 1u);
  BOOST_TEST((c.probes[0].id == "end" && c.probes[0].field == "stress"));
  BOOST_TEST((c.probes[0].at.value == 0.995 && c.probes[0].at.unit == "L"));
  BOOST_TEST((c.allow_unstable && c.ledger));

  BOOST_REQUIRE_EQUAL(c.gates.size(), 6u);
  const GateSpec& magic = c.gates[0];
  BOOST_TEST((magic.id == "magic" && magic.kind == "exact" && magic.quantity == "stress.Linf"));
  BOOST_TEST(magic.reason == "magic time step");
  BOOST_TEST((magic.where.method == std::vector<std::string>{"fem"}));
  BOOST_TEST((magic.where.courant == std::vector<double>{1}));
  BOOST_TEST((magic.where.cells == std::vector<int>{100, 200}));
  BOOST_TEST((magic.where.particles == std::vector<std::vector<double>>{{0.25, 0.75}}));
  BOOST_TEST((magic.times == std::vector<double>{0.5}));
  BOOST_TEST(criterion<BoundCriterion>(magic).max == 1e-12);
  BOOST_TEST(!magic.slow);
  BOOST_TEST(magic.line == line_of(whole, "[[gate]]"));
  const GateSpec& slope = c.gates[1];
  const auto& order = criterion<OrderCriterion>(slope);
  BOOST_TEST((order.expect == 0.5 && order.band == std::array<double, 2>{0.4, 0.55} && order.levels_min == 3));
  BOOST_TEST((slope.slow && slope.keeps_time_steps && !magic.keeps_time_steps));
  const auto& theory = criterion<RatioCriterion>(c.gates[2]);
  BOOST_TEST((theory.theory == "airy-step" && theory.ratio == std::array<double, 2>{0.98, 1.02}));
  BOOST_TEST((criterion<RatioCriterion>(c.gates[4]).theory == "stability-limit" && c.gates[4].steps == 500));
  BOOST_TEST((dynamic_cast<const BlowUpCriterion*>(c.gates[5].criterion.get()) && c.gates[5].steps == 2000));

  BOOST_REQUIRE_EQUAL(c.figures.size(), 1u);
  const FigureSpec& figure = c.figures[0];
  const reports::Figure shown = drawn_figure(c, "fig1");
  BOOST_TEST((figure.id == "fig1" && shown.y_label.starts_with("velocity v")), shown.y_label);
  BOOST_TEST((figure.times == std::vector<double>{0.5}));
  BOOST_TEST(shown.panels.at(0).label == "t = 0.5 L/c: on its way");
  BOOST_TEST((figure.cells == 200 && figure.courant == 0.5));
  BOOST_TEST((figure.methods == std::vector<std::string>{"mpm-musl"}));
  BOOST_TEST((figure.particles == std::vector<double>{0.5}));
  BOOST_TEST((figure.range.value() == std::array<double, 2>{-1.5, 1.5}));
}

BOOST_AUTO_TEST_CASE(a_scene_of_expressions_is_read) {
  BOOST_REQUIRE_EQUAL(message(own), "");
  const Case c = parse_case(own, "bar.toml");
  const auto law = std::get<material::Hardening>(c.first().material);
  BOOST_TEST((law.youngs_modulus == 200e9 && law.density == 7850 && law.tangent_modulus == 2e9));
  BOOST_TEST(law.yield_stress == 250e6);
  BOOST_TEST(c.convected);
  BOOST_TEST((c.loads[0].end == End::left && c.loads[0].expression == "sin(3*t)"));
  BOOST_TEST((c.loads[0].transfer == Transfer::boundary_layer && c.loads[0].layer_thickness.unit == "cells"));
  BOOST_TEST(c.loads[0].layer_thickness.value == 1);
  BOOST_TEST((c.loads[1].history == "ramp" && c.loads[1].rise.value == 0.5 && c.loads[1].start.value == 0));
  BOOST_TEST(c.body_force == "x*t");
  BOOST_TEST(c.initial_velocity == "A*sin(pi*x/(2*L))");
  BOOST_TEST(c.initial_stress == "0");
  BOOST_TEST((c.exact.stress == "E*A*x*t" && c.exact.velocity == "A*x" && c.exact.displacement == "A*x*t"));
  BOOST_TEST((c.axes[0].particles == std::vector<std::vector<double>>{{0.5}}));
  BOOST_TEST((!c.allow_unstable && c.ledger && c.time_unit == "s"));
  BOOST_TEST((c.features == std::vector<std::string>{"body-force", "boundary-layer", "convection", "plasticity"}));
  const auto names = expression_constants(c);
  BOOST_TEST((names.at("L") == 2 && names.at("E") == 200e9 && names.at("rho") == 7850 && names.at("A") == 0.1));
  BOOST_TEST(names.at("c") == std::sqrt(200e9 / 7850));
}

BOOST_AUTO_TEST_CASE(a_row_of_bars_is_read) {
  BOOST_REQUIRE_EQUAL(message(row), "");
  const Case c = parse_case(row, "bar.toml");
  BOOST_REQUIRE_EQUAL(c.bars.size(), 3u);
  BOOST_TEST((c.bars[0].length == 0.5 && c.bars[1].length == 0.25 && c.bars[2].length == 1.0));
  BOOST_TEST((c.bars[0].gap.value == 0 && c.bars[2].gap.value == 0 && c.bars[2].gap.unit == "m"));
  BOOST_TEST((c.bars[1].gap.value == 2 && c.bars[1].gap.unit == "cells"));
  BOOST_TEST((c.bars[0].velocity == "v0" && c.bars[1].velocity == "-0.5" && c.bars[2].velocity.empty()));
  for (const std::size_t b : {0, 2}) {  // the common material
    BOOST_TEST(std::get<material::Elastic>(c.bars[b].material).youngs_modulus == 1e4);
    BOOST_TEST(std::get<material::Elastic>(c.bars[b].material).density == 1);
  }
  const auto law = std::get<material::Hardening>(c.bars[1].material);
  BOOST_TEST((law.youngs_modulus == 4e4 && law.density == 4 && law.tangent_modulus == 1e4 && law.yield_stress == 60));
  BOOST_TEST(expression_constants(c).at("L") == 0.5);
  BOOST_TEST(expression_constants(c).at("c") == 100);
  BOOST_TEST((c.left == Support::free && c.right == Support::fixed));

  BOOST_REQUIRE(c.viscosity.has_value());
  BOOST_TEST((c.viscosity->c1 == "k/4" && c.viscosity->c2 == "0"));
  BOOST_TEST((c.viscosity->form.form == material::Viscosity::Form::york));
  BOOST_TEST((c.viscosity->form.bulk == 0.7 && c.viscosity->form.length == 1.2 && c.viscosity->form.always));
  BOOST_TEST((c.contact == Contact::bonded && c.convected));
  BOOST_TEST((c.features == std::vector<std::string>{"contact", "convection", "plasticity", "viscosity"}));
  BOOST_TEST(c.exact.solution == "impact");
  const std::map<std::string, std::vector<double>> swept{{"v0", {0.5, 1}}};
  BOOST_REQUIRE_EQUAL(c.axes.size(), 2u);
  BOOST_TEST((c.axes[0].parameters == swept && c.axes[1].parameters == swept));
  BOOST_TEST((c.parameters == std::map<std::string, double>{{"v0", 1}, {"k", 2}}));
  BOOST_TEST((c.from_contact && c.time_unit == "L/c"));
  BOOST_TEST((c.times == std::vector<double>{-1, 0.5, 3}));
  BOOST_TEST((c.probes[0].at.value == 1.5 && c.probes[0].at.unit == "L"));

  BOOST_REQUIRE_EQUAL(c.gates.size(), 4u);
  BOOST_TEST((c.gates[0].quantity == "contact.begin" && criterion<RatioCriterion>(c.gates[0]).theory == "impact"));
  BOOST_TEST((c.gates[0].where.parameters == std::map<std::string, std::vector<double>>{{"v0", {1}}}));
  BOOST_TEST((c.gates[1].quantity == "contact.duration.error" && c.gates[1].where.parameters == swept));
  BOOST_TEST((c.gates[2].kind == "exact" && c.gates[2].quantity == "contact.restitution"));
  BOOST_TEST((c.gates[3].kind == "invariant" && c.gates[3].quantity == "energy.closure"));

  BOOST_REQUIRE_EQUAL(c.figures.size(), 2u);
  const FigureSpec& motion = c.figures[0];
  BOOST_TEST((motion.kind == "motion" && motion.title == "Motion" && motion.choices == "all of them"));
  BOOST_TEST((motion.courants == std::map<std::string, double>{{"fem", 0.5}, {"mpm-musl", 0.1}}));
  BOOST_TEST((motion.courant_of("fem") == 0.5 && motion.courant_of("mpm-musl") == 0.1));
  BOOST_TEST((motion.parameters == Parameters{{"v0", 1}}));
  const reports::Figure shown = drawn_figure(c, motion.id);
  BOOST_REQUIRE_EQUAL(shown.panels.size(), 2u);
  BOOST_TEST((shown.panels[1].x_range == std::array{0.4, 0.6} && shown.panels[1].y_range == std::array{-1.0, 3.0}));
  BOOST_TEST((motion.recorded.closely == std::array{-1.0, 3.0} && motion.recorded.paths && !motion.recorded.curves));
  BOOST_TEST((std::count(shown.notes.begin(), shown.notes.end(), "Displacements are drawn 10 times as large.") == 1));
  BOOST_TEST((motion.methods == std::vector<std::string>{"fem", "mpm-musl"}));
  const FigureSpec& profiles = c.figures[1];
  BOOST_TEST((profiles.kind == "profiles" && profiles.recorded.curves && profiles.courants.empty()));
  BOOST_TEST((profiles.courant_of("mpm-musl") == 0.1 && profiles.parameters == Parameters{{"v0", 0.5}}));
}

BOOST_AUTO_TEST_CASE(what_is_left_out_is_as_said) {
  const Case c = parse_case(whole, "bar.toml");
  BOOST_TEST((c.first().velocity.empty() && c.first().gap.value == 0));
  BOOST_TEST((!c.viscosity && c.contact == Contact::node_to_node && !c.from_contact && !c.convected));
  BOOST_TEST((c.axes[0].parameters.empty() && c.gates[0].where.parameters.empty()));
  const FigureSpec& figure = c.figures[0];
  BOOST_TEST((figure.kind == "profiles" && figure.title.empty() && figure.choices.empty()));
  BOOST_TEST((figure.courants.empty() && figure.parameters.empty()));
  BOOST_TEST(message(replaced(whole, "[model]", "[model]\ndisplacements = \"infinitesimal\"")) == "");
  BOOST_TEST(message(replaced(whole, "unit = \"L/c\", at = [0.5", "unit = \"L/c\", from = \"start\", at = [0.5")) ==
             "");
  BOOST_TEST(message(replaced(replaced(whole, "[bar]", "[[bar]]"), "[model]", "[model] # one of [[bar]]")) == "");

  const std::string less = replaced(row, "bulk = 0.7\nlength = 1.2\nacts = \"always\"\n", "");
  const Case york = parse_case(less, "bar.toml");
  BOOST_TEST(york.viscosity->form.bulk == 0.75);
  BOOST_TEST(york.viscosity->form.length == std::sqrt(2.0), boost::test_tools::tolerance(1e-15));
  BOOST_TEST(!york.viscosity->form.always);
  const Case linear =
      parse_case(replaced(less, "form = \"york\"", "form = \"linear-quadratic\"\nacts = \"compression\""), "bar.toml");
  BOOST_TEST((linear.viscosity->form.form == material::Viscosity::Form::linear_quadratic));
  BOOST_TEST(!linear.viscosity->form.always);
  const Case parting = parse_case(replaced(row, "fem = \"bonded\"", "fem = \"node-to-node\""), "bar.toml");
  BOOST_TEST((parting.contact == Contact::node_to_node));
  // The only value of a swept parameter need not be named again, a list of one stands for it, and so does a number.
  std::string one = replaced(row, "parameters = { v0 = [0.5, 1.0] }", "parameters = { v0 = 1.0 }");
  one = replaced(one, "parameters = { v0 = [0.5, 1.0] }", "parameters = { v0 = [1.0] }");
  one = replaced(one, "parameters = { v0 = [0.5, 1] }", "parameters = { v0 = 1 }");
  one = replaced(one, "parameters = { v0 = 1.0 }\nzoom", "zoom");
  one = replaced(one, "parameters = { v0 = 0.5 }\nrange", "range");
  BOOST_REQUIRE_EQUAL(message(one), "");
  BOOST_TEST((parse_case(one, "bar.toml").figures[1].parameters == Parameters{{"v0", 1}}));
}

BOOST_AUTO_TEST_CASE(a_standing_mode_is_read) {
  std::string text =
      replaced(own, own.substr(own.find("[[load]]"), own.find("[body_force]") - own.find("[[load]]")), "");
  text = replaced(text, "[body_force]\nacceleration = \"x*t\"\n", "");
  const std::string initial = "[initial]\nvelocity = \"A*sin(pi*x/(2*L))\"\nstress = \"0\"\n";
  text = replaced(text, "\"hardening\"", "\"elastic\"");
  text = replaced(text, "E_t = 2e9\nyield_stress = 250e6\n", "");
  text = replaced(text, "\"convection\", \"plasticity\", \"body-force\", \"boundary-layer\"",
                  "\"elastic\", \"convection\"");
  text =
      replaced(text, "solution = \"expressions\"\nstress = \"E*A*x*t\"\nvelocity = \"A*x\"\ndisplacement = \"A*x*t\"",
               "solution = \"standing-mode\"\nmode = 2\namplitude = -1e-3");
  expect_alone(text, "standing-mode", {"exact.solution", "[initial]", "the mode itself sets the initial velocity"});
  text = replaced(text, initial, "");
  BOOST_REQUIRE_EQUAL(message(text), "");
  const Case c = parse_case(text, "bar.toml");
  BOOST_TEST((c.exact.parameters == analytic::SolutionParameters{{"mode", 2}, {"amplitude", -1e-3}}));
  expect_alone(replaced(text, "-1e-3", "0"), "amplitude", {"exact.amplitude", "found 0", "other than 0"});
  expect_alone(replaced(text, "mode = 2", "mode = 0"), "mode = 0", {"exact.mode", "found 0", "from 1"});
  expect(replaced(text, "[axes]", "[[load]]\nat = \"left\"\nhistory = \"step\"\ntraction = 1\n[axes]"), "standing-mode",
         {"[[load]]", "no traction"});
  expect_alone(
      replaced(
          text, "id = \"g\"\nkind = \"exact\"\nquantity = \"velocity.L2\"\nmax = 0.01",
          "id = \"g\"\nkind = \"constant\"\nquantity = \"stress.L2\"\npredict = \"airy-step\"\nratio = [0.9, 1.1]"),
      "predict", {"\"airy-step\"", "theory of \"bar-wave\"", "\"mode\""});
}

BOOST_AUTO_TEST_CASE(axes_may_be_several_blocks) {
  const std::string text =
      replaced(whole, "[axes]", "[[axes]]\nmethod = [\"mpm-usl\"]\ncells = [50]\ncourant = [0.1]\n[[axes]]");
  // The gate "theory" then speaks of mpm-usl, too.
  expect_alone(text, "predict = \"airy-step\"", {"\"airy-step\" for method \"mpm-usl\"", "mpm-musl", "where"});
  const std::string good = replaced(text, "predict = \"airy-step\"",
                                    "where = { method = [\"fem\", \"mpm-musl\"] }\npredict = \"airy-step\"");
  BOOST_REQUIRE_EQUAL(message(good), "");
  BOOST_TEST(parse_case(good, "bar.toml").axes.size() == 2u);
  expect_alone(replaced(good, "{ method = \"fem\", courant = 1.0, cells = [100, 200], particles = [0.25, 0.75] }",
                        "{ method = \"mpm-usl\", cells = 100 }"),
               "mpm-usl\", cells = 100", {"gate \"magic\": where", "no run has"});
  expect_alone(replaced(good, "cells = [50]", "cells = [0]"), "cells = [0]", {"axes 1: cells, entry 1", "found 0"});
  expect_alone(replaced(good, "cells = 200\n", "cells = 50\n"), "methods =", {"figure \"fig1\"", "a run of the axes"});
}

BOOST_AUTO_TEST_CASE(a_declaration_is_canonical) {
  const Case c = parse_case(whole, "bar.toml");
  const Declaration magic{{"kind", "\"exact\""},           {"max", "1e-12"},
                          {"quantity", "\"stress.Linf\""}, {"times", "[0.5]"},
                          {"where.cells", "[100 200]"},    {"where.courant", "1"},
                          {"where.method", "\"fem\""},     {"where.particles", "[0.25 0.75]"}};
  BOOST_TEST((c.gates[0].declaration == magic));
  BOOST_TEST(words(c.gates[1].declaration) ==
             "band=[0.4 0.55] expect=0.5 kind=\"order\" levels_min=3 quantity=\"stress.L1\" slow=true "
             "where.method=[\"fem\"]");
  // The order of keys, spaces, comments and reasons do not matter; the last digit of a tolerance does.
  const Case same = parse_case(
      replaced(whole, "max = 1e-12\nreason = \"magic time step\"", "reason = \"two\\nlines\" # why\nmax =    0.1e-11"),
      "bar.toml");
  BOOST_TEST((same.gates[0].declaration == c.gates[0].declaration));
  const Case other = parse_case(replaced(whole, "max = 1e-12", "max = 1.0000000000000002e-12"), "bar.toml");
  BOOST_TEST(other.gates[0].declaration.at("max") == "1.0000000000000002e-12");
  Case swept = parse_case(row, "bar.toml");
  BOOST_TEST(swept.gates[0].declaration["where.parameters.v0"] == "1");
  BOOST_TEST(swept.scene["contact.fem"] == "\"bonded\"");
  BOOST_TEST(swept.scene["sample.times.at"] == "[-1 0.5 3]");
  BOOST_TEST(swept.scene["axes[1].parameters.v0"] == "[0.5 1]");
  BOOST_TEST(swept.scene["sample.probes[far].field"] == "\"velocity\"");
  for (const char* key : {"id", "title", "claim", "why"}) BOOST_TEST(!swept.scene.contains(key));
}

BOOST_AUTO_TEST_CASE(unknown_keys) {
  wrong("length = 1.0", "lenght = 1.0\nlength = 1.0",
        {"bar.lenght", "unknown key", "1.0", "length", "did you mean \"length\"?"});
  wrong("rho = 1.0", "rh0 = 2\nrho = 1.0", {"material.rh0", "= 2", "E, ", "did you mean \"rho\"?"});
  wrong("[run]", "[runs]\n[run]", {"runs", "unknown key", "did you mean \"run\"?"});
  wrong("{ value = 0.25, unit = \"L/c\" }", "{ value = 0.25, unit = \"L/c\", units = 1 }",
        {"load 1: start.units", "did you mean \"unit\"?"});
  wrong("where = { method = [\"fem\"] }", "where = { method = [\"fem\"], cell = 100 }",
        {"gate \"slope\": where.cell", "did you mean \"cells\"?"});
  wrong("slow = true", "slowly = false\nslow = true", {"gate \"slope\": slowly", "did you mean \"slow\"?"});
  wrong("range = [-1.5, 1.5]", "courants = 1\nrange = [-1.5, 1.5]", {"figure \"fig1\": courants", "\"courant\""});
  wrong("field = \"stress\"", "field = \"stress\", feld = \"x\"", {"feld", "\"field\""});
  wrong("ledger = true", "time_step = 0\nledger = true", {"run.time_step", "unknown key (= 0)", "axes.courant"});
  wrong("courant = [0.5, 1]", "dt = 0.0\ncourant = [0.5, 1]", {"axes.dt", "axes.courant"});
  wrong("unit = \"L/c\", at = [0.5, 1.7]", "unit = \"L/c\", every = 2, at = [0.5, 1.7]", {"sample.times.every"});
}

BOOST_AUTO_TEST_CASE(missing_keys) {
  for (const char* key : {"schema = 1", "id = \"bar", "title = ", "claim = ", "why = ", "units = "}) {
    const std::size_t at = whole.find(key);
    const std::string text = whole.substr(0, at) + "# " + whole.substr(at);
    expect_alone(text, "", {std::string(key).substr(0, std::string(key).find(' ')) + ": missing"});
  }
  wrong("rho = 1.0\n", "", {"material.rho: missing", "a finite number > 0"});
  expect_alone(replaced(whole, "rho = 1.0\n", ""), "[material]", {"material.rho: missing"});
  expect_alone(replaced(whole, "left = \"fixed\"", ""), "[supports]",
               {"supports.left: missing", "\"fixed\", \"free\""});
  expect_alone(replaced(whole, "history = \"impulse\"\n", ""), "[[load]]", {"load 1: history: missing", "\"impulse\""});
  expect_alone(replaced(whole, "duration = { value = 1.0, unit = \"s\" }\n", ""), "[[load]]",
               {"duration: missing", "\"s\""});
  expect_alone(replaced(whole, "features = [\"elastic\"]", ""), "[model]", {"model.features: missing"});
  expect_alone(replaced(whole, "cells = [100, 200, 400, 800]", ""), "[axes]", {"axes.cells: missing"});
  expect_alone(replaced(whole, "times = { unit = \"L/c\", at = [0.5, 1.7] }", ""), "[sample]",
               {"sample.times: missing", "unit"});
  expect_alone(replaced(whole, "max = 1e-12", ""), "[[gate]]", {"gate \"magic\": max: missing", ">= 0"});
  expect_alone(replaced(whole, "reason = \"magic time step\"", ""), "[[gate]]", {"gate \"magic\": reason: missing"});
  expect_alone(replaced(whole, "quantity = \"stress.Linf\"", ""), "[[gate]]", {"quantity: missing", "\"stress.Linf\""});
  expect_alone(replaced(whole, "ratio = [0.98, 1.02]", ""), "", {"gate \"theory\": ratio: missing"});
  expect_alone(replaced(whole, "predict = \"airy-step\"", ""), "",
               {"gate \"theory\": predict: missing", "\"airy-step\""});
  expect_alone(replaced(whole, "band = [0.4, 0.55]", ""), "", {"gate \"slope\": band: missing"});
  expect_alone(replaced(whole, "expect = 0.5", ""), "", {"gate \"slope\": expect: missing"});
  expect_alone(replaced(whole, "outcome = \"unstable\"", ""), "",
               {"gate \"blows-up\": outcome: missing", "\"unstable\""});
  expect_alone(replaced(whole, "{ value = 0.995, unit = \"L\" }", "{ value = 0.995 }"),
               "probes =", {"at.unit: missing", "\"m\""});
  expect(replaced(whole, "[bar]\nlength = 1.0\n", ""), "", {"bar: missing", "[bar]"});
  expect_alone(replaced(own, "yield_stress = 250e6\n", ""), "[material]", {"material.yield_stress: missing"});
  expect_alone(replaced(own, "thickness = { value = 1, unit = \"cells\" }\n", ""), "",
               {"load 1: thickness: missing", "cells"});
}

BOOST_AUTO_TEST_CASE(wrong_types_and_names) {
  wrong("length = 1.0", "length = \"one\"", {"bar.length", "found \"one\"", "a finite number > 0"});
  wrong("length = 1.0", "length = true", {"bar.length", "found true"});
  wrong("length = 1.0", "length = [1]", {"bar.length", "found a list"});
  wrong("length = 1.0", "length = 1979-05-27", {"bar.length", "found a date"});
  wrong("cells = [100, 200, 400, 800]", "cells = [100.0, 200, 400, 800]",
        {"axes.cells, entry 1", "found 100.0", "whole number"});
  wrong("cells = [100, 200, 400, 800]", "cells = 100", {"axes.cells", "found 100", "list"});
  wrong("ledger = true", "ledger = 1", {"run.ledger", "found 1", "true or false"});
  wrong("schema = 1", "schema = 2", {"schema", "found 2", "1 to 1"});
  wrong("claim = \"code-verification\"", "claim = \"code-verificaton\"",
        {"claim", "\"code-verificaton\"", "\"robustness\"", "did you mean \"code-verification\"?"});
  wrong("\"fem\", \"mpm-musl\"]\ncells", "\"fem\", \"musl\"]\ncells",
        {"axes.method, entry 2", "\"musl\"", "did you mean \"mpm-musl\"?"});
  wrong("left = \"fixed\"", "left = \"Fixed\"", {"supports.left", "did you mean \"fixed\"?"});
  wrong("model = \"elastic\"", "model = \"plastic\"", {"material.model", "\"hardening\"", "did you mean \"elastic\"?"});
  wrong("id = \"bar.step.fixed-free\"", "id = \"Bar 1\"", {"id", "\"Bar 1\"", "a-z"});
  wrong("title = \"Fixed-free bar\"", "title = \"  \"", {"title", "not empty"});
  wrong("units = \"paper\"", "units = \"cgs\"", {"units", "\"SI\", \"paper\""});
  wrong("history = \"impulse\"", "history = \"implse\"", {"load 1: history", "did you mean \"impulse\"?"});
  wrong("kind = \"invariant\"", "kind = \"invarient\"", {"gate \"energy\": kind", "did you mean \"invariant\"?"});
  wrong("solution = \"bar-wave\"", "solution = \"bar-waves\"", {"exact.solution", "did you mean \"bar-wave\"?"});
  expect(replaced(whole, "[exact]\nsolution = \"bar-wave\"", "exact = 1"), "", {"exact", "found"});
  expect_alone(replaced(whole, "[run]\nallow_unstable = true\nledger = true", "[[run]]\nledger = true"), "[[run]]",
               {"run", "a list", "one table [run]"});
  const std::size_t load = whole.find("[[load]]");
  std::string single = whole;
  expect(single.replace(load, 8, "[load]"), "[load]", {"load", "found a table", "[[load]]"});
}

BOOST_AUTO_TEST_CASE(values_out_of_range) {
  for (const char* bad : {"-1", "0", "0.0", "nan", "inf", "-inf", "-1e-300"}) {
    wrong("rho = 1.0", std::string("rho = ") + bad,
          {"material.rho", std::string("found ") + bad, "a finite number > 0"});
    wrong("E = 1e4", std::string("E = ") + bad, {"material.E", "a finite number > 0"});
    wrong("length = 1.0", std::string("length = ") + bad, {"bar.length", "a finite number > 0"});
    wrong("courant = [0.5, 1]", "courant = [0.5, " + std::string(bad) + "]",
          {"axes.courant, entry 2", std::string("found ") + bad, "> 0", "time step of 0"});
  }
  wrong("cells = [100,", "cells = [0,", {"axes.cells, entry 1", "found 0", "from 1"});
  wrong("cells = [100,", "cells = [-4,", {"axes.cells, entry 1", "found -4"});
  wrong("cells = [100,", "cells = [5000000000,", {"axes.cells, entry 1", "found 5000000000"});
  wrong("cells = [100, 200, 400, 800]", "cells = []", {"axes.cells", "an empty list"});
  wrong("courant = [0.5, 1]", "courant = [0.5, 1, 1e-300]", {"axes.courant", "steps", "at most"});
  wrong("traction = 2", "traction = nan", {"load 1: traction", "found nan"});
  wrong("traction = 2", "traction = \"sin(t)\"", {"load 1: traction", "history = \"expression\""});
  expect_alone(replaced(whole, "traction = 2", "traction = 0"), "bar-wave", {"exact.solution", "without a load"});
  wrong("start = { value = 0.25", "start = { value = -0.25", {"load 1: start.value", "found -0.25", ">= 0"});
  wrong("duration = { value = 1.0", "duration = { value = 0", {"load 1: duration.value", "found 0", "> 0"});
  expect_alone(replaced(whole, "E = 1e4\nrho = 1.0", "E = 1e308\nrho = 1e-308"), "E = 1e308",
               {"material.E", "wave speed", "inf", "finite"});
  wrong_own("E_t = 2e9", "E_t = 200e9", {"material.E_t", "found 2e+11", "0 <= E_t < E"});
  wrong_own("E_t = 2e9", "E_t = -1", {"material.E_t", "found -1", ">= 0"});
  wrong_own("yield_stress = 250e6", "yield_stress = 0", {"material.yield_stress", "> 0"});
  wrong_own("thickness = { value = 1,", "thickness = { value = 11,", {"load 1: thickness", "11 cells", "10 cells"});
}

BOOST_AUTO_TEST_CASE(units_and_times) {
  wrong("duration = { value = 1.0, unit = \"s\" }", "duration = 1.0",
        {"load 1: duration", "1.0 without a unit", "\"s\", \"L/c\""});
  wrong("{ value = 1.0, unit = \"s\" }", "{ value = 1.0, unit = \"ms\" }",
        {"load 1: duration.unit", "\"ms\"", "\"s\", \"L/c\""});
  wrong("times = { unit = \"L/c\", at = [0.5, 1.7] }", "times = [0.5, 1.7]", {"sample.times", "without a unit", "L/c"});
  wrong("at = [0.5, 1.7]", "at = [0.5, 1.7, 1.0]", {"sample.times.at", "[0.5, 1.7, 1]", "ascending"});
  wrong("at = [0.5, 1.7]", "at = [0.5, 0.5, 1.7]", {"sample.times.at", "ascending", "each once"});
  wrong("at = [0.5, 1.7]", "at = [0.5, 0]", {"sample.times.at, entry 2", "found 0", "> 0"});
  wrong("at = [0.5, 1.7]", "at = []", {"sample.times.at", "empty list"});
  wrong("unit = \"L/c\", at = [0.5", "unit = \"c/L\", at = [0.5", {"sample.times.unit", "\"c/L\""});
  wrong("at = { value = 0.995, unit = \"L\" }", "at = 0.995", {"probes 1: at", "0.995 without a unit", "\"cells\""});
  wrong("at = { value = 0.995,", "at = { value = 1.5,", {"at", "1.5 L, outside the bar", "0 to 1 L"});
  wrong("at = { value = 0.995, unit = \"L\" }", "at = { value = 101, unit = \"cells\" }",
        {"outside", "0 to 100 cells"});
  wrong("at = { value = 0.995,", "at = { value = -0.1,", {"at.value", "found -0.1"});
}

BOOST_AUTO_TEST_CASE(axes_values) {
  wrong("cells = [100, 200, 400, 800]", "cells = [100, 200, 400, 800, 100]", {"axes.cells, entry 5", "100 twice"});
  wrong("courant = [0.5, 1]", "courant = [0.5, 1, 1.0]", {"axes.courant, entry 3", "1 twice"});
  wrong("method = [\"fem\", \"mpm-musl\"]", "method = [\"fem\", \"mpm-musl\", \"fem\"]",
        {"axes.method", "\"fem\" twice"});
  wrong("particles = [[0.5], 2]", "particles = [[0.5], 2, 1]", {"axes.particles, entry 3", "[0.5] twice"});
  wrong("particles = [[0.5], 2]", "particles = [[0.5], 2, []]", {"axes.particles, entry 3", "empty", "[0, 1]"});
  wrong("particles = [[0.5], 2]", "particles = [[0.5], 2, [0.7, 0.2]]", {"entry 3", "[0.7, 0.2]", "ascending"});
  wrong("particles = [[0.5], 2]", "particles = [[0.5], 2, [0.5, 1.5]]", {"entry 3, entry 2", "found 1.5", "0 to 1"});
  wrong("particles = [[0.5], 2]", "particles = [[0.5], 2, [nan]]", {"entry 3, entry 1", "found nan"});
  wrong("particles = [[0.5], 2]", "particles = [[0.5], 2, 0]", {"axes.particles, entry 3", "found 0", "from 1"});
  wrong("particles = [[0.5], 2]", "particles = [[0.5], 2, \"3\"]", {"axes.particles, entry 3", "found \"3\""});
}

BOOST_AUTO_TEST_CASE(expressions) {
  wrong_own("acceleration = \"x*t\"", "acceleration = \"x*\"",
            {"body_force.acceleration", "\"x*\"", "end of expression"});
  wrong_own("acceleration = \"x*t\"", "acceleration = \"\"",
            {"body_force.acceleration", "found \"\"", "an expression"});
  wrong_own("acceleration = \"x*t\"", "acceleration = 3", {"body_force.acceleration", "found 3", "in quotes"});
  wrong_own("velocity = \"A*sin", "velocity = \"A*sinn",
            {"initial.velocity", "\"sinn\"", "position 3", "did you mean \"sin\"?"});
  wrong_own("pi*x/", "pi*X/", {"initial.velocity", "unknown name \"X\"", "A, E, L, c, pi, rho", "did you mean \"x\"?"});
  wrong_own("velocity = \"A*sin(pi*x/(2*L))\"", "velocity = \"A*t\"", {"initial.velocity", "unknown name \"t\""});
  wrong_own("stress = \"0\"", "stress = \"x=3\"", {"initial.stress", "assignment", "position 2"});
  wrong_own("stress = \"0\"", "stress = \"1,2\"", {"initial.stress", "2 values"});
  wrong_own("stress = \"0\"", "stress = \"log(x)\"", {"initial.stress", "-inf at x = 0", "{0, L/2, L}"});
  wrong_own("stress = \"0\"", "stress = \"sqrt(1.5-x)\"", {"initial.stress", "NaN at x = 2"});
  wrong_own("stress = \"0\"", "stress = \"1/(x-1)\"", {"initial.stress", "inf at x = 1"});
  wrong_own("stress = \"E*A*x*t\"", "stress = \"x/t\"", {"exact.stress", "NaN at x = 0, t = 0"});
  wrong_own("traction = \"sin(3*t)\"", "traction = \"x\"", {"load 1: traction", "unknown name \"x\""});
  wrong_own("traction = \"sin(3*t)\"", "traction = \"sqrt(5e-5-t)\"", {"load 1: traction", "NaN at t = 1e-04"});
  wrong_own("traction = \"sin(3*t)\"", "traction = 3", {"load 1: traction", "found 3", "an expression"});
  expect_alone(replaced(own, "velocity = \"A*sin(pi*x/(2*L))\"\nstress = \"0\"", ""), "[initial]",
               {"no field", "velocity"});

  for (const char* name : {"L", "E", "rho", "c", "pi", "x", "t", "sin", "_e"})
    wrong("k_2 = -3", std::string(name) + " = 3", {std::string("parameters.") + name, "have already"});
  wrong("k_2 = -3", "2k = 3", {"parameters.2k", "no digit first"});
  wrong("k_2 = -3", "k-2 = 3", {"parameters.k-2", "letters, digits and _"});
  wrong("k_2 = -3", "k_2 = nan", {"parameters.k_2", "found nan"});
  // Mistakes elsewhere do not hide those of a formula, nor bring up false ones.
  const std::string both =
      replaced(replaced(own, "rho = 7850", "rho = 0"), "acceleration = \"x*t\"", "acceleration = \"y\"");
  expect(both, "rho = 0", {"material.rho"});
  expect(both, "acceleration", {"unknown name \"y\""});
  BOOST_TEST(lines(message(both)).size() == 2u, message(both));
}

BOOST_AUTO_TEST_CASE(loads) {
  wrong("at = \"right\"", "at = \"left\"", {"load 1: at", "left end, which is fixed", "free ends"});
  expect_alone(replaced(own, "at = \"right\"", "at = \"left\" # again"), "at = \"left\" # again",
               {"load 2: at", "second load on the left end"});
  wrong("transfer = \"node\"", "rise = { value = 1, unit = \"s\" }",
        {"load 1: rise", "history = \"impulse\"", "\"ramp\""});
  wrong("transfer = \"node\"", "thickness = { value = 1, unit = \"cells\" }",
        {"thickness", "\"node\"", "\"boundary-layer\""});
  const std::string text = replaced(own, "rise =", "duration =");
  expect(text, "duration =", {"load 2: duration", "history = \"ramp\"", "\"impulse\""});
  expect(text, "", {"load 2: rise: missing"});
}

BOOST_AUTO_TEST_CASE(scene_and_methods_agree) {
  const std::string both = replaced(own, "[\"mpm-usl\"]", "[\"mpm-usl\", \"fem\"]");
  expect(both, "method =", {"axes.method", "\"fem\" together with", "[body_force]", "mpm-musl"});
  expect(both, "method =", {"axes.method", "\"fem\" together with", "transfer = \"boundary-layer\""});
  BOOST_TEST(lines(message(both)).size() == 2u, message(both));
  wrong("features = [\"elastic\"]", "features = [\"elastic\", \"convection\"]",
        {"model.features", "\"convection\"", "nothing"});
  wrong("features = [\"elastic\"]", "features = [\"elastc\"]",
        {"model.features, entry 1", "did you mean \"elastic\"?"});
  wrong_own("\"convection\", \"plasticity\"", "\"plasticity\"", {"model.features", "missing \"convection\"", "finite"});
  wrong_own("\"plasticity\"", "\"elastic\", \"plasticity\"", {"model.features", "found \"elastic\""});
}

BOOST_AUTO_TEST_CASE(bars_of_a_row) {
  wrong_row("velocity = \"v0\"", "velocty = \"v0\" #", {"bar 1: velocty", "unknown key", "did you mean \"velocity\"?"});
  wrong_row("velocity = \"v0\"", "velocity = nan", {"bar 1: velocity", "found nan", "a finite number"});
  wrong_row("velocity = \"v0\"", "velocity = true", {"bar 1: velocity", "found true", "a number, or an expression"});
  wrong_row("velocity = \"v0\"", "velocity = \"\"", {"bar 1: velocity", "found \"\"", "a number, or an expression"});
  wrong_row("velocity = \"v0\"", "velocity = [1]", {"bar 1: velocity", "found a list"});
  expect(replaced(whole, "length = 1.0", "length = 1.0\nvelocity = \"A*t\""), "velocity = \"A*t\"",
         {"bar.velocity", "unknown name \"t\"", "A, E, L, c, k_2"});
  expect(replaced(whole, "length = 1.0", "length = 1.0\nvelocity = \"1/0\""), "velocity = \"1/0\"",
         {"bar.velocity", "an infinite value", "a finite value"});
  expect(replaced(row, "gap = { value = 2,", "gapp = { value = 2,"),
         "gapp =", {"bar 2: gapp", "unknown key", "did you mean \"gap\"?"});
  wrong_row("velocity = \"v0\"", "gap = { value = 1, unit = \"m\" }", {"bar 1: gap", "before the first bar"});
  wrong("length = 1.0", "gap = { value = 1, unit = \"m\" }\nlength = 1.0", {"bar.gap", "before the first bar"});
  expect(replaced(row, "gap = { value = 2, unit = \"cells\" }", "gap = 2"), "gap = 2",
         {"bar 2: gap", "2 without a unit", "\"m\", \"L\", \"cells\""});
  expect(replaced(row, "gap = { value = 2,", "gap = { value = -2,"), "gap =", {"bar 2: gap.value", "found -2", ">= 0"});
  expect(replaced(row, "unit = \"cells\"", "unit = \"cell\""),
         "gap =", {"bar 2: gap.unit", "\"cell\"", "did you mean \"cells\"?"});
  expect(replaced(row, "length = 0.25", "length = 0 # none"), "length = 0 #", {"bar 2: length", "found 0", "> 0"});
  expect_alone(replaced(row, "length = 0.5\n", "length = -1\n"), "length = -1", {"bar 1: length", "found -1", "> 0"});
  expect(replaced(row, "length = 0.25\n", ""), "", {"bar 2: length: missing"});
  expect_alone(replaced(row, "length = 0.25", "length = 0.26"), "[[bar]]",
               {"bar", "bar 2 of length 0.26", "10.4 cells where the first bar has 20", "whole numbers of cells"});
  expect_alone(replaced(row, "cells = [20, 40, 80]", "cells = [20, 25, 80]"), "[[bar]]",
               {"bar 2", "12.5 cells", "first bar has 25"});
  wrong("length = 1.0", "displacements = \"finite\"\nlength = 1.0",
        {"bar.displacements", "found it in [bar]", "in [model]"});
  const std::string one = replaced(row, "[[bar]]\nlength = 0.5", "[bar]\nlength = 0.5");
  expect(one, "", {"not TOML"});
  expect(replaced(whole, "[bar]\nlength = 1.0\n", "bar = 3\n"), "", {"bar"});
  expect("bar = []\n", "bar", {"bar", "an empty list", "[bar]"});
}

/// A law that no case file can name would never run.
BOOST_AUTO_TEST_CASE(every_law_of_a_bar_can_be_named) {
  const std::string models = message(replaced(whole, "model = \"elastic\"", "model = \"none\""));
  const std::string features = message(replaced(whole, "features = [\"elastic\"]", "features = [\"none\"]"));
  material::for_each_law([&]<class Law>() {
    BOOST_TEST(holds(models, '"' + std::string(Law::model) + '"'), models);
    BOOST_TEST(holds(features, '"' + std::string(Law::feature) + '"'), features);
  });
}

BOOST_AUTO_TEST_CASE(materials_of_bars) {
  const std::string own_material =
      "material = { model = \"hardening\", E = 4e4, rho = 4, E_t = 1e4, yield_stress = 60 }";
  wrong_row("rho = 4,", "rho = 0,", {"bar 2: material.rho", "found 0", "> 0"});
  wrong_row("E = 4e4,", "E = nan,", {"bar 2: material.E", "found nan"});
  wrong_row("E_t = 1e4,", "E_t = 5e4,", {"bar 2: material.E_t", "found 50000", "0 <= E_t < E = 40000"});
  wrong_row("rho = 4,", "roh = 4, rho = 4,", {"bar 2: material.roh", "did you mean \"rho\"?"});
  expect_alone(replaced(row, "rho = 4, ", ""), "material = {", {"bar 2: material.rho: missing"});
  expect_alone(replaced(row, ", yield_stress = 60", ""), "material = {", {"bar 2: material.yield_stress: missing"});
  expect(replaced(row, "E_t = 1e4, ", ""), "material = {", {"bar 2: material.E_t: missing"});
  expect(replaced(row, "model = \"hardening\"", "model = \"hardning\""), "hardning",
         {"bar 2: material.model", "did you mean \"hardening\"?"});
  expect(replaced(row, own_material, "material = \"steel\""), "steel", {"bar 2: material", "found \"steel\"", "a"});
  wrong_row("E_t = 1e4, yield_stress = 60 }\n", "E_t = 1e4, yield_stress = 60, L = 1 }\n", {"bar 2: material.L"});
  // Without the common one each bar needs its own.
  const std::string none = replaced(row, "[material]\nmodel = \"elastic\"\nE = 1e4\nrho = 1\n", "");
  expect(none, "[[bar]]", {"bar 1: material: missing", "one [material] for all bars without"});
  expect(none, "", {"bar 3: material: missing"});
  BOOST_TEST(lines(message(none)).size() == 2u, message(none));
  const std::string elastic = "length = 0.5\nmaterial = { model = \"elastic\", E = 1e4, rho = 1 }\n";
  std::string each = replaced(none, "length = 0.5\n", elastic);
  each = replaced(each, "length = 1.0\n", "length = 1.0\nmaterial = { model = \"elastic\", E = 2e4, rho = 1 }\n");
  BOOST_REQUIRE_EQUAL(message(each), "");
  BOOST_TEST(material::youngs_modulus(parse_case(each, "bar.toml").bars[2].material) == 2e4);
  expect_alone(replaced(whole, "[material]\nmodel = \"elastic\"\nE = 1e4\nrho = 1.0\n", ""), "[bar]",
               {"bar.material: missing"});
}

BOOST_AUTO_TEST_CASE(artificial_viscosity) {
  wrong_row("form = \"york\"", "form = \"yorc\"",
            {"viscosity.form", "\"york\", \"linear-quadratic\"", "did you mean \"york\"?"});
  expect_alone(replaced(row, "form = \"york\"\n", ""), "[viscosity]", {"viscosity.form: missing", "\"york\""});
  const std::string linear = replaced(row, "form = \"york\"", "form = \"linear-quadratic\"");
  expect(linear, "bulk =", {"viscosity.bulk", "form = \"linear-quadratic\"", "with form = \"york\""});
  expect(linear, "length = 1.2", {"viscosity.length", "form = \"linear-quadratic\"", "with form = \"york\""});
  BOOST_TEST(lines(message(linear)).size() == 2u, message(linear));
  wrong_row("c1 = \"k/4\"", "c1 = -0.5", {"viscosity.c1", "found -0.5", ">= 0"});
  wrong_row("c1 = \"k/4\"", "c1 = \"k-3\"", {"viscosity.c1", "found -1", ">= 0"});
  wrong_row("c1 = \"k/4\"", "c1 = \"v0-0.7\"", {"viscosity.c1", ">= 0"});  // for one of the swept values
  wrong_row("c1 = \"k/4\"", "c1 = \"kk/4\"", {"viscosity.c1", "unknown name \"kk\"", "did you mean \"k\"?"});
  wrong_row("c1 = \"k/4\"", "c1 = inf", {"viscosity.c1", "found inf"});
  wrong_row("c2 = 0", "c2 = nan", {"viscosity.c2", "found nan"});
  wrong_row("c2 = 0", "c2 = true", {"viscosity.c2", "found true", "a number"});
  expect_alone(replaced(row, "c1 = \"k/4\"\n", ""), "[viscosity]", {"viscosity.c1: missing"});
  expect_alone(replaced(row, "c2 = 0\n", ""), "[viscosity]", {"viscosity.c2: missing"});
  wrong_row("bulk = 0.7", "bulk = 0", {"viscosity.bulk", "found 0", "> 0"});
  wrong_row("length = 1.2", "length = -1.2", {"viscosity.length", "found -1.2", "> 0"});
  wrong_row("length = 1.2", "lenght = 1.2", {"viscosity.lenght", "did you mean \"length\"?"});
  wrong_row("acts = \"always\"", "acts = \"alway\"",
            {"viscosity.acts", "\"compression\", \"always\"", "did you mean \"always\"?"});
  wrong_row("acts = \"always\"", "acts = true", {"viscosity.acts", "found true", "\"always\""});
  wrong_row("\"plasticity\", \"viscosity\"", "\"plasticity\"",
            {"model.features", "missing \"viscosity\"", "[viscosity]"});
  expect(replaced(row, "[viscosity]", "[viscsity]"), "[viscsity]", {"viscsity", "did you mean \"viscosity\"?"});
  expect(replaced(row, "[viscosity]", "[[viscosity]]"), "[[viscosity]]", {"viscosity", "one table [viscosity]"});
  wrong("features = [\"elastic\"]", "features = [\"elastic\", \"viscosity\"]",
        {"\"viscosity\"", "nothing in the scene"});
}

BOOST_AUTO_TEST_CASE(contact_of_bars) {
  wrong_row("fem = \"bonded\"", "fem = \"glued\"", {"contact.fem", "\"glued\"", "\"node-to-node\", \"bonded\""});
  wrong_row("fem = \"bonded\"", "fem = \"node-to-nod\"", {"contact.fem", "did you mean \"node-to-node\"?"});
  expect_alone(replaced(row, "fem = \"bonded\"\n", ""), "[contact]", {"contact.fem: missing", "\"bonded\""});
  const std::string mpm = replaced(row, "fem = \"bonded\"", "mpm = \"bonded\"");
  expect(mpm, "mpm = \"bonded\"", {"contact.mpm", "unknown key", "allowed: fem"});
  expect(mpm, "[contact]", {"contact.fem: missing"});
  wrong_row("[\"contact\", \"convection\"", "[\"convection\"",
            {"model.features", "missing \"contact\"", "a second [[bar]]"});
  expect_alone(replaced(whole, "[model]", "[contact]\nfem = \"node-to-node\"\n[model]"), "[contact]",
               {"contact", "one bar", "two bars or more"});
  wrong("features = [\"elastic\"]", "features = [\"elastic\", \"contact\"]", {"\"contact\"", "nothing in the scene"});
}

BOOST_AUTO_TEST_CASE(displacements_belong_to_the_model) {
  expect(replaced(row, "displacements = \"finite\"", "displacements = \"finit\""), "displacements",
         {"model.displacements", "\"infinitesimal\", \"finite\"", "did you mean \"finite\"?"});
  expect(replaced(row, "displacements = \"finite\"", "displacement = \"finite\""), "displacement",
         {"model.displacement", "unknown key", "did you mean \"displacements\"?"});
  expect(replaced(row, "displacements = \"finite\"\n", ""), "features =", {"\"convection\"", "nothing"});
  wrong_row("\"contact\", \"convection\"", "\"contact\"",
            {"model.features", "missing \"convection\"", "model.displacements = \"finite\""});
  // A mesh goes with its bar, but not into a body force that stands in space.
  const std::string moving = replaced(own, "[\"mpm-usl\"]", "[\"fem\", \"mpm-usl\"]");
  const std::string layer = "transfer = \"boundary-layer\"\nthickness = { value = 1, unit = \"cells\" }\n";
  std::string text = replaced(replaced(moving, layer, ""), ", \"boundary-layer\"", "");
  expect_alone(text, "method =", {"axes.method", "\"fem\" together with", "[body_force]", "MPM methods only"});
  const std::string still = replaced(replaced(text, "displacements = \"finite\"\n", ""), "\"convection\", ", "");
  BOOST_TEST(message(still) == "");
  text = replaced(replaced(text, "[body_force]\nacceleration = \"x*t\"\n", ""), ", \"body-force\"", "");
  BOOST_TEST(message(text) == "");
}

BOOST_AUTO_TEST_CASE(times_from_contact) {
  const std::string at = "at = [-1.0, 0.5, 3]";
  expect(replaced(row, "from = \"contact\"", "from = \"contac\""),
         "from =", {"sample.times.from", "\"start\", \"contact\"", "did you mean \"contact\"?"});
  expect(replaced(row, "from = \"contact\"", "form = \"contact\""), "form = \"contact\"",
         {"sample.times.form", "unknown key", "did you mean \"from\"?"});
  expect(replaced(row, "from = \"contact\"", "from = 3"), "from = 3", {"sample.times.from", "found 3"});
  wrong_row("from = \"contact\"", "from = \"start\"", {"sample.times.at, entry 1", "found -1.0", "> 0"});
  wrong_row(at, "at = [-100.0, 0.5, 3]", {"sample.times.at", "-100", "before the start in some run"});
  wrong_row(at, "at = [nan, 0.5, 3]", {"sample.times.at, entry 1", "found nan"});
  wrong_row(at, "at = [-1.0, 0.5, 0.5]", {"sample.times.at", "[-1, 0.5, 0.5]", "ascending", "each once"});
  BOOST_TEST(message(replaced(row, at, "at = [0, 0.5, 3]")) == "");
  // The faster bars meet last on 80 cells, FEM's at 5/3 L/c, MPM's on a node of the grid at 5/4 L/c.
  const std::string soon = replaced(row, at, "at = [-1.4, 0.5, 3]");
  expect_alone(soon, "at = [-1.4", {"sample.times.at", "-1.4", "before the start in some run"});
  const std::string mpm = "[\"mpm-musl\"]\ncells = [20, 40, ";
  BOOST_TEST(message(replaced(soon, mpm + "80]", mpm + "60]")) == "");
  expect_alone(replaced(replaced(row, at, "at = [-1.7, 0.5, 3]"), mpm + "80]", mpm + "60]"), "at = [-1.7", {"-1.7"});
  expect(replaced(whole, "unit = \"L/c\", at = [0.5", "unit = \"L/c\", from = \"contact\", at = [0.5"),
         "from =", {"sample.times.from", "no two bars close in", "velocities make them meet"});
  expect(replaced(replaced(row, "velocity = \"v0\"", "velocity = \"v0-1\""), "[[bar]]\nlength = 1.0\n", ""),
         "from =", {"sample.times.from", "no two bars close in"});  // for one of the swept values
  // Gates and figures name these times, negative ones, too.
  const std::string gate = "quantity = \"contact.restitution\"";
  BOOST_TEST(message(replaced(row, gate, "times = [-1]\nquantity = \"velocity.L1\"")) == "");
  BOOST_TEST(message(replaced(row, "times = [0.5]\ncaptions", "times = [-1.0]\ncaptions")) == "");
  wrong_row(gate, "times = [-2] # no such\nquantity = \"velocity.L1\"",
            {"gate \"rest\": times", "found -2", "-1, 0.5, 3"});
}

BOOST_AUTO_TEST_CASE(probes_of_a_row) {
  const std::string at = "{ value = 1.5, unit = \"L\" }";
  for (const char* bad :
       {"{ value = 9, unit = \"L\" }", "{ value = 0.51, unit = \"m\" }", "{ value = 21, unit = \"cells\" }"})
    expect_alone(replaced(row, at, bad), "probes =", {"probes 1: at", "in no bar", "from the first one's left end"});
  for (const char* good :
       {"{ value = 0, unit = \"m\" }", "{ value = 0.5, unit = \"m\" }", "{ value = 23, unit = \"cells\" }"})
    BOOST_TEST(message(replaced(row, at, good)) == "");
}

BOOST_AUTO_TEST_CASE(swept_parameters) {
  const std::string axis = "parameters = { v0 = [0.5, 1.0] }";
  const auto wrong_axis = [&](const std::string& to, const std::vector<std::string>& parts) {
    expect(replaced(row, axis, to), to, parts);
  };
  wrong_axis("parameters = { v1 = [0.5, 1.0] }",
             {"axes 1: parameters.v1", "no such parameter", "\"k\", \"v0\"", "did you mean \"v0\"?"});
  wrong_axis("parameters = { v0 = [0.5, \"a\"] }", {"axes 1: parameters.v0, entry 2", "found \"a\""});
  wrong_axis("parameters = { v0 = [0.5, nan] }", {"axes 1: parameters.v0, entry 2", "found nan"});
  wrong_axis("parameters = { v0 = [0.5, 0.5] }", {"axes 1: parameters.v0, entry 2", "0.5 twice"});
  wrong_axis("parameters = { v0 = [] }", {"axes 1: parameters.v0", "an empty list"});
  wrong_axis("parameters = 3", {"axes 1: parameters", "found 3", "one table [parameters]"});
  wrong_axis("parameter = { v0 = [0.5, 1.0] }", {"axes 1: parameter:", "unknown key", "did you mean \"parameters\"?"});
  wrong("courant = [0.5, 1]", "parameters = { c = 1 }\ncourant = [0.5, 1]",
        {"axes.parameters.c", "no such parameter", "\"A\", \"k_2\""});
  expect(replaced(own, "courant = [0.25]", "courant = [0.25]\nparameters = { B = 1 }"), "parameters = {",
         {"axes.parameters.B", "\"A\""});
  std::string none = replaced(whole, "[parameters]\nA = 0.1\nk_2 = -3\n", "");
  none = replaced(none, "courant = [0.5, 1]", "courant = [0.5, 1]\nparameters = { B = 1 }");
  expect_alone(none, "parameters = {", {"axes.parameters.B", "[parameters], of which there are none"});

  const std::string where = "parameters = { v0 = 1.0 } }\nratio";
  const auto wrong_where = [&](const std::string& to, const std::vector<std::string>& parts) {
    expect_alone(replaced(row, where, to + " }\nratio"), to, parts);
  };
  wrong_where("parameters = { v0 = 2.0 }",
              {"gate \"begin\": where.parameters", "found 2", "axes.parameters.v0: 0.5, 1"});
  wrong_where("parameters = { k = 2.0 }", {"gate \"begin\": where.parameters", "\"k\", which is not swept"});
  wrong_where("parameters = { v = 2.0 }", {"gate \"begin\": where.parameters.v", "no such parameter", "\"k\", \"v0\""});
  wrong_where("parameters = { v0 = \"a\" }", {"gate \"begin\": where.parameters.v0", "found \"a\""});
  wrong_where("parameters = 1", {"gate \"begin\": where.parameters", "found 1", "one table"});
  wrong_where("paramters = { v0 = 1.0 }", {"gate \"begin\": where.paramters", "did you mean \"parameters\"?"});
  // Where one block alone sweeps a parameter, a value of it belongs to that block.
  const std::string one_block = replaced(row, axis, "");
  expect(one_block, "where = { method = \"fem\"", {"gate \"begin\": where", "no run has"});

  const std::string figure = "parameters = { v0 = 1.0 }\nzoom";
  expect(replaced(row, figure, "zoom"), "", {"figure \"motion\": parameters", "missing \"v0\"", "swept", "0.5, 1"});
  expect(replaced(row, figure, "parameters = { v = 1.0 }\nzoom"), "parameters = { v = 1.0 }",
         {"figure \"motion\": parameters.v", "no such parameter", "\"k\", \"v0\""});
  expect(replaced(row, figure, "parameters = 3\nzoom"), "parameters = 3", {"figure \"motion\": parameters", "found 3"});
  expect(replaced(row, figure, "parameters = { v0 = \"a\" }\nzoom"), "parameters = { v0 = \"a\" }",
         {"figure \"motion\": parameters.v0", "found \"a\""});
  expect(replaced(row, figure, "parameters = { v0 = 3.0 }\nzoom"), "", {"figure \"motion\"", "allowed"});
}

BOOST_AUTO_TEST_CASE(solutions_of_impacts) {
  expect_alone(replaced(row, "solution = \"impact\"", "solution = \"impact\"\nmode = 2"), "mode = 2",
               {"exact.mode", "\"impact\"", "\"standing-mode\""});
  expect(replaced(row, "solution = \"impact\"", "solution = \"impct\""), "impct",
         {"exact.solution", "\"plastic-impact\"", "did you mean \"impact\"?"});
  expect_alone(replaced(row, "E_t = 1e4,", "E_t = 0,"),
               "solution =", {"exact.solution", "E_t = 0", "\"plastic-impact\""});
  const std::string free = replaced(row, "right = \"fixed\"", "right = \"free\"");
  const auto loaded = [&](const std::string& text, const std::string& history) {
    return replaced(text, "[viscosity]", "[[load]]\nat = \"right\"\n" + history + "\n[viscosity]");
  };
  BOOST_TEST(message(loaded(free, "history = \"step\"\ntraction = 1")) == "");
  BOOST_TEST(message(loaded(free, "history = \"impulse\"\ntraction = 1\nduration = { value = 1, unit = \"L/c\" }")) ==
             "");
  expect_alone(loaded(free, "history = \"ramp\"\ntraction = 1\nrise = { value = 1, unit = \"L/c\" }"),
               "solution =", {"\"impact\"", "history = \"ramp\"", "steps and impulses"});
  expect_alone(loaded(free, "history = \"expression\"\ntraction = \"t\""),
               "solution =", {"\"impact\"", "history = \"expression\"", "steps and impulses"});
  expect_alone(replaced(row, "[exact]", "[initial]\nstress = \"x\"\n[exact]"),
               "solution =", {"\"impact\"", "[initial]", "one velocity each"});
  const std::string forced = replaced(row, "[exact]", "[body_force]\nacceleration = \"1\"\n[exact]");
  expect(forced, "solution =", {"\"impact\"", "[body_force]", "no body force"});

  const std::string plastic = perfectly_plastic();
  BOOST_REQUIRE_EQUAL(message(plastic), "");
  BOOST_TEST(parse_case(plastic, "bar.toml").exact.solution == "plastic-impact");
  const auto wrong_plastic = [&](const std::string& text, const std::string& found, const std::string& allowed) {
    expect_alone(text, "solution =", {"exact.solution", "\"plastic-impact\" together with " + found, allowed});
  };
  wrong_plastic(replaced(plastic, "E_t = 0", "E_t = 1"), "other bars", "two equal bars with E_t = 0");
  wrong_plastic(replaced(plastic, "velocity = -0.5\n", "velocity = -0.5\n[[bar]]\nlength = 0.5\n"), "other bars",
                "two");
  wrong_plastic(replaced(plastic, "length = 0.5\nvelocity = -0.5", "length = 0.25\nvelocity = -0.5"), "other bars",
                "equal");
  for (const char* other :
       {"E = 2e4, rho = 1, E_t = 0, yield_stress = 75", "E = 1e4, rho = 2, E_t = 0, yield_stress = 75",
        "E = 1e4, rho = 1, E_t = 0, yield_stress = 70", "E = 1e4, rho = 1, E_t = 1, yield_stress = 75"})
    wrong_plastic(replaced(plastic, "velocity = -0.5\n",
                           "velocity = -0.5\nmaterial = { model = \"hardening\", " + std::string(other) + " }\n"),
                  "other bars", "two equal bars");
  wrong_plastic(replaced(plastic, "left = \"free\"", "left = \"fixed\""), "loads or supports", "free ends");
  wrong_plastic(loaded(plastic, "history = \"step\"\ntraction = 1"), "loads or supports", "free ends");
  wrong_plastic(replaced(plastic, "[exact]", "[initial]\nstress = \"x\"\n[exact]"), "[initial]", "one velocity each");

  // The solutions of one bar at rest know neither a second one nor a velocity.
  expect_alone(replaced(whole, "length = 1.0", "length = 1.0\nvelocity = 1"),
               "solution =", {"\"bar-wave\"", "a bar with a velocity", "\"impact\" knows the others"});
  const std::string two = replaced(replaced(replaced(whole, "[bar]\nlength", "[[bar]]\nlength = 1.0\n[[bar]]\nlength"),
                                            "[\"elastic\"]", "[\"contact\", \"elastic\"]"),
                                   "at = { value = 0.995", "at = { value = 0.5");
  expect_alone(two, "solution =", {"\"bar-wave\"", "several bars"});
}

BOOST_AUTO_TEST_CASE(quantities_of_impacts) {
  for (const char* name :
       {"contact.begin", "contact.early", "contact.end", "contact.duration", "contact.restitution"}) {
    const std::string judged = "quantity = \"" + std::string(name) + '"';
    BOOST_TEST(
        message(replaced(replaced(row, "quantity = \"contact.begin\"", judged), "{ method = \"fem\", p", "{ p")) == "");
    BOOST_TEST(message(replaced(row, "quantity = \"contact.restitution\"", judged)) == "");
    wrong_row("quantity = \"energy.closure\"", judged + " # no invariant", {"which is not for kind = \"invariant\""});
  }
  for (const char* name :
       {"contact.begin.error", "contact.end.error", "contact.restitution.error", "plastic.work.error"})
    BOOST_TEST(message(replaced(row, "contact.duration.error", name)) == "");
  BOOST_TEST(message(replaced(row, "quantity = \"contact.restitution\"", "quantity = \"plastic.work\"")) == "");
  for (const char* name : {"bits.alone", "bits.inviscid", "energy.drift", "energy.lost"})
    BOOST_TEST(message(replaced(row, "energy.closure", name)) == "");
  wrong_row("quantity = \"contact.begin\"", "quantity = \"contact.begn\"", {"did you mean \"contact.begin\"?"});
  wrong_row("quantity = \"contact.begin\"", "quantity = \"contact.begin.error\"",
            {"gate \"begin\": quantity", "not for kind = \"constant\"", "\"contact.begin\""});
  wrong_row("quantity = \"contact.duration.error\"", "quantity = \"contact.duration\"",
            {"gate \"late\": quantity", "not for kind = \"order\"", "\"contact.duration.error\""});
  wrong_row("quantity = \"energy.closure\"", "quantity = \"energy.clsure\"", {"did you mean \"energy.closure\"?"});
  wrong_row("quantity = \"energy.closure\"", "quantity = \"bits.alon\"", {"did you mean \"bits.alone\"?"});
  wrong_row("quantity = \"contact.restitution\"", "quantity = \"energy.closure\" # no norm",
            {"gate \"rest\": quantity", "not for kind = \"exact\""});
  expect_alone(replaced(row, "[[gate]]", "[run]\nledger = false\n[[gate]]"), "quantity = \"energy.closure\"",
               {"energy.closure", "run.ledger"});

  wrong_row("predict = \"impact\"", "predict = \"plastic-impact\"",
            {"gate \"begin\": predict", "theory of \"plastic-impact\"", "\"impact\""});
  wrong_row("predict = \"impact\"", "predict = \"viscous-front\"", {"theory of \"bar-wave\"", "\"impact\""});
  wrong_row("predict = \"impact\"", "predict = \"imact\"", {"gate \"begin\": predict", "did you mean \"impact\"?"});
  expect_alone(replaced(row, "quantity = \"contact.begin\"", "quantity = \"stress.L2\""), "predict = \"impact\"",
               {"\"impact\" for \"stress.L2\"", "\"contact.begin\"", "\"plastic.work\""});
  std::string viscous = replaced(whole, "[model]\nfeatures = [\"elastic\"]",
                                 "[viscosity]\nform = \"linear-quadratic\"\nc1 = 1\nc2 = 0\n[model]\n"
                                 "features = [\"elastic\", \"viscosity\"]");
  viscous =
      replaced(viscous, "displacement.L2\"\npredict = \"airy-step\"", "velocity.L1\"\npredict = \"viscous-front\"");
  BOOST_TEST(message(viscous) == "");
  expect_alone(replaced(viscous, "\"velocity.L1\"\n", "\"displacement.L1\"\n"), "predict = \"viscous-front\"",
               {"\"viscous-front\" for \"displacement.L1\"", "\"stress.L1\"", "\"velocity.L2\""});
  // Without an exact solution there is nothing to be off from.
  const std::string bare = replaced(row, "[exact]\nsolution = \"impact\"\n", "");
  expect(bare, "contact.duration.error", {"gate \"late\": quantity", "without an exact solution", "[exact]"});
  expect(bare, "predict = \"impact\"", {"gate \"begin\": predict", "\"none\" has no theory"});
  BOOST_TEST(lines(message(bare)).size() == 2u, message(bare));
}

BOOST_AUTO_TEST_CASE(figures_of_motion) {
  expect(replaced(row, "kind = \"motion\"", "kind = \"moton\""), "moton",
         {"figure \"motion\": kind", "\"profiles\", \"motion\"", "did you mean \"motion\"?"});
  const std::string profiles = replaced(row, "kind = \"motion\"", "kind = \"profiles\"");
  expect(profiles, "zoom =", {"figure \"motion\": zoom", "kind = \"profiles\"", "with kind = \"motion\""});
  expect(profiles, "magnify =", {"figure \"motion\": magnify", "kind = \"profiles\"", "with kind = \"motion\""});
  BOOST_TEST(lines(message(profiles)).size() == 2u, message(profiles));
  const std::string motion = replaced(row, "kind = \"profiles\"", "kind = \"motion\"");
  for (const char* key : {"field = \"stress\"", "times = [0.5]", "captions = ", "range = "})
    expect(motion, key, {"figure \"profiles\": ", "kind = \"motion\"", "with kind = \"profiles\""});
  BOOST_TEST(lines(message(motion)).size() == 4u, message(motion));

  const std::string zoom = "zoom = { x = [0.4, 0.6], t = [-1, 3] }";
  wrong_row(zoom, "zoom = { x = [0.6, 0.4], t = [-1, 3] }",
            {"figure \"motion\": zoom.x", "[0.6, 0.4]", "least < most"});
  wrong_row(zoom, "zoom = { x = [0.4, 0.6], t = 3 }", {"figure \"motion\": zoom.t", "found 3", "two numbers"});
  wrong_row(zoom, "zoom = { x = [0.4, 0.6] }", {"figure \"motion\": zoom.t: missing"});
  wrong_row(zoom, "zoom = { t = [-1, 3] }", {"figure \"motion\": zoom.x: missing"});
  wrong_row(zoom, "zoom = { x = [0.4, 0.6], t = [-1, 3], y = 1 }",
            {"figure \"motion\": zoom.y", "unknown key", "t, x"});
  wrong_row(zoom, "zoom = [0.4, 0.6]", {"figure \"motion\": zoom", "found a list", "one table [zoom]"});
  wrong_row(zoom, "zom = { x = [0.4, 0.6], t = [-1, 3] }", {"figure \"motion\": zom", "did you mean \"zoom\"?"});
  wrong_row("magnify = 10", "magnify = 0", {"figure \"motion\": magnify", "found 0", "> 0"});
  wrong_row("magnify = 10", "magnfy = 10", {"figure \"motion\": magnfy", "did you mean \"magnify\"?"});
  wrong_row("title = \"Motion\"", "title = \" \"", {"figure \"motion\": title", "not empty"});
  wrong_row("choices = \"all of them\"", "choices = [\"a\"]", {"figure \"motion\": choices", "found a list"});
  wrong_row("choices = \"all of them\"", "choice = \"all\"",
            {"figure \"motion\": choice", "did you mean \"choices\"?"});

  const std::string each = "courant = { fem = 0.5, mpm-musl = 0.1 }";
  wrong_row(each, "courant = { fem = 0.5, mpm-musl = 0.3 }",
            {"figure \"motion\": courant", "found 0.3", "axes.courant: 0.1, 0.25, 0.5"});
  wrong_row(each, "courant = { fem = 0.5, mpm-musl = 0 }", {"figure \"motion\": courant.mpm-musl", "found 0", "> 0"});
  expect(replaced(row, each, "courant = { fem = \"a\", mpm-musl = 0.1 }"), "courant = { fem = \"a\"",
         {"figure \"motion\": courant.fem", "found \"a\"", "> 0"});
  expect(replaced(row, each, "courant = { fem = 0.5, mpm-mus = 0.1 }"), "courant = { fem = 0.5, mpm-mus",
         {"figure \"motion\": courant.mpm-mus:", "\"fem\"", "did you mean \"mpm-musl\"?"});
  expect(replaced(row, each, "courant = { fem = 0.1, mpm-musl = 0.1 }"), "",
         {"figure \"motion\"", "\"fem\"", "courant = 0.1", "a run of the axes"});
  expect(replaced(row, each, "courant = 0.1"), "", {"figure \"motion\"", "\"fem\"", "a run of the axes"});
  expect_alone(replaced(row, each + "\n", ""), "[[figure]]", {"figure \"motion\": courant: missing"});
}

/// One mistake of a bar, axis or figure brings up no others that are none, and hides none.
BOOST_AUTO_TEST_CASE(mistakes_of_rows_stand_alone) {
  wrong_row("velocity = \"v0\"", "velocity = \"v1\"",
            {"bar 1: velocity", "unknown name \"v1\"", "did you mean \"v0\"?"});
  wrong_row("velocity = \"v0\"", "velocity = \"x\"", {"bar 1: velocity", "unknown name \"x\""});
  wrong_row("velocity = -0.5", "velocity = \"1/0\"", {"bar 2: velocity", "an infinite value"});
  wrong_row("velocity = \"v0\"", "velocity = \"1/(v0-0.5)\"",
            {"bar 1: velocity", "an infinite value"});  // a swept value
  wrong_row("c1 = \"k/4\"", "c1 = \"1/(v0-0.5)\"", {"viscosity.c1", "an infinite value"});
  BOOST_TEST(message(replaced(row, "v0 = 1.0\n", "v0 = -9\n")) == "");  // no run has that one
  wrong_row("gap = { value = 2,", "gap = { value = -2,", {"bar 2: gap.value", "found -2"});
  wrong_row("gap = { value = 2,", "gapp = { value = 2,", {"bar 2: gapp"});
  wrong_row("length = 0.25", "length = 0 # none", {"bar 2: length", "found 0"});
  expect_alone(replaced(row, "E_t = 1e4, ", ""), "material = {", {"bar 2: material.E_t: missing"});
  wrong_row("model = \"hardening\"", "model = \"hardning\"", {"bar 2: material.model"});
  expect_alone(replaced(row, "cells = [20, 40, 80]", "cells = [20, 40, 0]"), "cells =", {"axes 1: cells", "found 0"});
  wrong_row("parameters = { v0 = 1.0 } }\nratio", "parameters = { k = 2.0 } }\nratio",
            {"where.parameters", "\"k\", which is not swept", "sweep: \"v0\""});

  const std::string each = "courant = { fem = 0.5, mpm-musl = 0.1 }";
  expect_alone(replaced(row, each, "courant = { fem = 0.5 }"), "courant = { fem = 0.5 }",
               {"figure \"motion\": courant.mpm-musl: missing"});
  expect(replaced(row, each, "courant = {}"), "courant = {}", {"figure \"motion\": courant.fem: missing"});
  wrong_row(each, "courant = { fem = 0.5, mpm-musl = 0.1, mpm-usl = 0.7 }", {"courant.mpm-usl", "not drawn"});
  wrong_row(each, "courant = { fem = \"a\", mpm-musl = 0.1 }", {"figure \"motion\": courant.fem", "found \"a\""});
  const std::string chosen = "parameters = { v0 = 1.0 }\nzoom";
  wrong_row(chosen, "parameters = { v0 = [0.5, 1.0] } # two\nzoom",
            {"figure \"motion\": parameters.v0", "[0.5, 1]", "one value"});
  wrong_row(chosen, "parameters = { v0 = 3.0 }\nzoom", {"figure \"motion\": parameters", "found 3", "0.5, 1"});
  wrong_row(chosen, "parameters = { v0 = 1.0, k = 2 }\nzoom",
            {"figure \"motion\": parameters", "\"k\", which is not swept"});
  expect_alone(replaced(row, chosen, "zoom"), "", {"figure \"motion\": parameters", "missing \"v0\""});

  expect(replaced(own, "length = 2\n", "length = 2\nvelocity = 1\n"), "velocity = \"A*sin",
         {"initial.velocity", "bar.velocity"});
  const std::string apart = replaced(perfectly_plastic(), "velocity = -0.5", "velocity = 2");
  expect(replaced(replaced(apart, "from = \"contact\", ", ""), "[-1.0, 0.5, 3]", "[0.5, 3]"),
         "solution =", {"\"plastic-impact\"", "do not close in"});
}

BOOST_AUTO_TEST_CASE(particles_outside_by_round_off_are_on_the_face) {
  const std::string text = replaced(whole, "particles = [[0.5]", "particles = [[-1e-18, 1.0000000000000002], [0.5]");
  const Case c = parse_case(text, "bar.toml");
  BOOST_TEST(c.axes[0].particles[0] == (std::vector<double>{0, 1}), boost::test_tools::per_element());
  BOOST_TEST(message(replaced(whole, "particles = [[0.5]", "particles = [[-1e-6], [0.5]")) != "");
}

BOOST_AUTO_TEST_CASE(solutions_hold_for_the_scene) {
  std::string text = replaced(own,
                              "solution = \"expressions\"\nstress = \"E*A*x*t\"\nvelocity = \"A*x\"\n"
                              "displacement = \"A*x*t\"",
                              "solution = \"bar-wave\"");
  for (const char* why : {"material.model = \"hardening\"", "[body_force]", "[initial]", "history = \"expression\""})
    expect(text, "bar-wave", {"exact.solution", why, "allowed"});
  BOOST_TEST(lines(message(text)).size() == 4u, message(text));
  wrong("solution = \"bar-wave\"", "mode = 3\nsolution = \"bar-wave\"", {"exact.mode", "\"standing-mode\""});
  wrong("solution = \"bar-wave\"", "stress = \"1\"\nsolution = \"bar-wave\"", {"exact.stress", "\"expressions\""});
  text = replaced(own, "stress = \"E*A*x*t\"\nvelocity = \"A*x\"\ndisplacement = \"A*x*t\"\n", "");
  expect(text, "solution =", {"exact.solution", "at least one"});
  // A boundary layer is one way to bring in a traction: the solution is the same.
  text = replaced(whole, "transfer = \"node\"",
                  "transfer = \"boundary-layer\"\nthickness = { value = 0.1, unit = \"L\" }");
  text = replaced(text, "method = [\"fem\", \"mpm-musl\"]", "method = [\"mpm-musl\"]");
  text = replaced(text, "method = \"fem\", courant", "courant");
  text = replaced(text, "where = { method = [\"fem\"] }", "");
  text = replaced(text, "history = \"impulse\"", "history = \"step\"");
  text = replaced(text, "duration = { value = 1.0, unit = \"s\" }\n", "");
  text = replaced(text, "[\"elastic\"]", "[\"elastic\", \"boundary-layer\"]");
  BOOST_TEST(message(text) == "");
  BOOST_TEST(message(replaced(text, "displacement.L2\"\npredict = \"airy-step\"",
                              "probe.end\"\npredict = \"end-equilibrium\"")) == "");
  expect_alone(
      replaced(text, "displacement.L2\"\npredict = \"airy-step\"", "stress.L2\"\npredict = \"end-equilibrium\""),
      "predict = \"end-eq", {"\"stress.L2\"", "probes of stress"});
}

BOOST_AUTO_TEST_CASE(gates) {
  wrong("id = \"slope\"", "id = \"magic\" # two",
        {"gate \"magic\": id", "again", "line " + std::to_string(line_of(whole, "[[gate]]") + 1)});
  wrong("courant = 1.0, cells", "courant = 0.9, cells", {"gate \"magic\": where.courant", "found 0.9", "0.5, 1"});
  wrong("cells = [100, 200], p", "cells = [100, 300], p",
        {"gate \"magic\": where.cells", "found 300", "100, 200, 400, 800"});
  wrong("where = { method = \"fem\"", "where = { method = \"mpm-usl\"", {"where.method", "\"mpm-usl\"", "axes.method"});
  wrong("where = { method = \"fem\"", "where = { method = \"fme\"", {"where.method", "did you mean \"fem\"?"});
  wrong("particles = [0.25, 0.75]", "particles = 3", {"where.particles", "axes.particles: [0.25, 0.75], [0.5]"});
  wrong("times = [0.5]\nmax", "times = [0.6]\nmax", {"gate \"magic\": times", "found 0.6", "0.5, 1.7"});
  wrong("max = 1e-12\nreason = \"magic", "band = [1, 2]\nmax = 1e-12\nreason = \"magic",
        {"gate \"magic\": band", "kind = \"exact\"", "kind = \"order\""});
  wrong("max = 1e-12\nreason = \"magic", "steps = 3\nmax = 1e-12\nreason = \"magic", {"steps", "\"limit\""});
  wrong("expect = 0.5", "max = 3\nexpect = 0.5", {"gate \"slope\": max", "\"order\"", "\"exact\", \"invariant\""});
  wrong("outcome = \"unstable\"", "ratio = [1, 2]\noutcome = \"unstable\"",
        {"ratio", "\"stable\"", "\"critical_courant\""});
  wrong("steps = 500", "outcome = \"unstable\" #", {"gate \"limit\": outcome", "\"critical_courant\"", "\"stable\""});
  wrong("steps = 500", "times = [0.5] #", {"gate \"limit\": times", "\"limit\""});
  wrong("outcome = \"unstable\"", "outcome = \"stable\"",
        {"outcome", "found \"stable\"", "did you mean \"unstable\"?"});
  wrong("quantity = \"stress.Linf\"", "quantity = \"stress.Lin\"", {"\"stress.Lin\"", "did you mean \"stress.Linf\"?"});
  wrong("quantity = \"stress.Linf\"", "quantity = \"probe.mid\"", {"\"probe.mid\"", "probe.end", "[sample]"});
  wrong("quantity = \"stress.Linf\"", "quantity = \"energy.lost\"",
        {"\"energy.lost\", which is not for kind = \"exact\""});
  wrong("quantity = \"energy.drift\"", "quantity = \"bits.miror\"", {"did you mean \"bits.mirror\"?"});
  wrong("max = 1e-12\nreason = \"magic", "max = nan\nreason = \"magic", {"gate \"magic\": max", "found nan"});
  wrong("max = 1e-12\nreason = \"magic", "max = inf\nreason = \"magic", {"gate \"magic\": max", "found inf"});
  wrong("max = 1e-12\nreason = \"magic", "max = -1\nreason = \"magic", {"gate \"magic\": max", ">= 0"});
  wrong("ratio = [0.98, 1.02]", "ratio = [1.02, 0.98]", {"gate \"theory\": ratio", "[1.02, 0.98]", "least < most"});
  wrong("ratio = [0.98, 1.02]", "ratio = [0.98, nan]", {"gate \"theory\": ratio, entry 2", "found nan"});
  wrong("ratio = [0.98, 1.02]", "ratio = [0.98]", {"gate \"theory\": ratio", "two numbers"});
  wrong("ratio = [0.98, 1.02]", "ratio = 1", {"gate \"theory\": ratio", "found 1", "two numbers"});
  wrong("ratio = [0.98, 1.02]", "ratio = [0, 1.02]", {"gate \"theory\": ratio, entry 1", "> 0"});
  wrong("band = [0.4, 0.55]", "band = [0.55, 0.4]", {"gate \"slope\": band", "least < most"});
  wrong("expect = 0.5", "expect = 1", {"gate \"slope\": expect", "found 1", "0.4 to 0.55"});
  wrong("levels_min = 3", "levels_min = 2", {"gate \"slope\": levels_min", "found 2", "from 3"});
  wrong("levels_min = 3", "levels_min = 5",
        {"gate \"slope\": levels_min", "4 values of cells for fem", "levels_min = 5"});
  const std::string fewer = replaced(whole, "{ method = [\"fem\"] }", "{ cells = [100, 200, 400] }");
  BOOST_TEST(message(fewer) == "");
  expect_alone(replaced(fewer, "levels_min = 3\n", ""), "",
               {"gate \"slope\": levels_min", "3 values", "levels_min = 4"});
}

BOOST_AUTO_TEST_CASE(gates_of_a_case) {
  const std::size_t first = whole.find("[[gate]]"), figure = whole.find("[[figure]]");
  const std::string none = whole.substr(0, first) + whole.substr(figure);
  expect_alone(none, "", {"gate: missing", "a case with no gate is an error"});
  expect_alone("gate = []\n" + none, "gate", {"a case with no gate is an error"});
  const std::size_t slope = whole.find("[[gate]]\nid = \"slope\""), theory = whole.find("[[gate]]\nid = \"theory\"");
  const std::string alone = whole.substr(0, first) + whole.substr(slope, theory - slope) + whole.substr(figure);
  expect_alone(alone, "[[gate]]", {"order gates alone", "exact, constant or invariant"});
  // What is measured against an exact solution needs one.
  const std::string bare = replaced(whole, "[exact]\nsolution = \"bar-wave\"\n", "");
  expect(bare, "stress.Linf", {"gate \"magic\": quantity", "without an exact solution", "[exact]"});
  expect(bare, "predict", {"\"airy-step\"", "\"none\" has no theory"});
  expect_alone(replaced(own, "velocity = \"A*x\"\n", ""), "velocity.L2", {"exact.velocity is missing"});
  expect_alone(replaced(whole, "ledger = true", "ledger = false"), "energy.drift", {"energy.drift", "run.ledger"});
  expect_alone(replaced(whole, "displacement.L2", "velocity.L2"),
               "predict =", {"\"airy-step\" for \"velocity.L2\"", "\"stress.L2\""});
}

BOOST_AUTO_TEST_CASE(figures) {
  wrong("cells = 200\n", "cells = 300\n", {"figure \"fig1\": cells", "found 300", "100, 200, 400, 800"});
  wrong("courant = 0.5\n", "courant = 0.7\n", {"figure \"fig1\": courant", "found 0.7", "0.5, 1"});
  wrong("methods = [\"mpm-musl\"]", "methods = [\"mpm-usl\"]",
        {"figure \"fig1\": methods", "\"mpm-usl\"", "axes.method"});
  wrong("particles = [0.5]\n", "particles = [0.6]\n", {"figure \"fig1\": particles", "[0.6]", "[0.25, 0.75], [0.5]"});
  wrong("captions = [\"on its way\"]", "captions = [\"a\", \"b\"]",
        {"figure \"fig1\": captions", "2 captions", "1 times"});
  wrong("range = [-1.5, 1.5]", "range = [1.5, 1.5]", {"figure \"fig1\": range", "least < most"});
  wrong("field = \"velocity\"", "field = \"speed\"", {"figure \"fig1\": field", "\"velocity\""});
  wrong("times = [0.5]\ncaptions", "times = [0.4]\ncaptions", {"figure \"fig1\": times", "found 0.4"});
  expect_alone(whole + "[[figure]]\nid = \"fig1\"\ncells = 100\ncourant = 1\nparticles = 1\n", "", {"\"fig1\" again"});
}

BOOST_AUTO_TEST_CASE(all_mistakes_at_once_in_order) {
  std::string text = replaced(whole, "length = 1.0", "length = -1");
  text = replaced(text, "rho = 1.0", "rho = nan");
  text = replaced(text, "cells = [100,", "cells = [0,");
  text = replaced(text, "max = 1e-12", "max = \"small\"");
  text = replaced(text, "id = \"slope\"", "id = \"magic\"");
  const auto all = lines(message(text));
  BOOST_REQUIRE_EQUAL(all.size(), 5u);
  const std::vector<std::string> parts{"bar.length", "material.rho", "axes.cells", "max", "again"};
  for (std::size_t i = 0; i < all.size(); ++i) BOOST_TEST(holds(all[i], parts[i]), all[i]);
  BOOST_TEST(all[0] == "bar.toml:9:10: bar.length: found -1; allowed: a finite number > 0");
}

BOOST_AUTO_TEST_CASE(files) {
  namespace fs = std::filesystem;
  expect("", "", {"empty file"});
  expect(" \n\n", "", {"empty file"});
  expect("# nothing\n", "", {"bar: missing"});
  expect("schema = 1\nid = [\n", "", {"not TOML"});
  expect_alone(replaced(whole, "rho = 1.0", "rho = 1.0\nrho = 2.0"), "rho = 2.0", {"not TOML", "rho"});
  expect_alone(replaced(whole, "E = 1e4", "E = 1,5"), "E = 1,5", {"not TOML"});
  expect("title = \"\xff\xfe\"\n", "", {"not TOML"});

  const auto refused = [](const fs::path& path) { return message_of<InputError>([&] { read_case(path); }); };
  char pattern[] = "/tmp/diptych-case-XXXXXX";
  BOOST_REQUIRE(::mkdtemp(pattern) != nullptr);
  const fs::path folder = pattern, file = folder / "bar.toml";
  BOOST_TEST(holds(refused(folder / "none.toml"), "none.toml: cannot be read: No such file"));
  BOOST_TEST(holds(refused(folder), "directory"));
  std::ofstream(file) << whole;
  BOOST_TEST(read_case(file).id == "bar.step.fixed-free");
  BOOST_TEST(read_case(file).path == file);
  std::ofstream(file) << replaced(whole, "rho = 1.0", "rho = 0");
  BOOST_TEST(refused(file).rfind(file.string() + ":13:7: material.rho: found 0", 0) == 0u, refused(file));
  fs::remove_all(folder);
}

/// The published schema must hold what the program reads: its examples are cases, and it names every gate quantity.
BOOST_AUTO_TEST_CASE(examples_of_the_readme) {
  const std::filesystem::path readme =
      std::filesystem::path(__FILE__).parent_path().parent_path().parent_path() / "cases/README.md";
  std::ifstream in(readme);
  BOOST_REQUIRE_MESSAGE(in.good(), "cannot read " << readme);
  std::string line, text;
  int examples = 0;
  bool inside = false;
  while (std::getline(in, line)) {
    if (line == "```toml") {
      inside = true;
      text.clear();
    } else if (line == "```" && inside) {
      inside = false;
      if (text.rfind("schema = 1", 0) != 0) continue;  // an excerpt
      BOOST_TEST(message(text) == "");
      ++examples;
    } else if (inside) {
      text += line + "\n";
    }
  }
  BOOST_TEST(examples == 4);
}

BOOST_AUTO_TEST_CASE(nearest_names) {
  const std::vector<std::string> names{"E", "rho", "mpm-usl", "mpm-musl"};
  BOOST_TEST(nearest("RHO", names) == "rho");
  BOOST_TEST(nearest("roh", names) == "rho");
  BOOST_TEST(nearest("e", names) == "E");
  BOOST_TEST(nearest("k", names) == "");
  BOOST_TEST(nearest("mpm-mus", names) == "mpm-musl");
  BOOST_TEST(nearest("musl", names) == "mpm-musl");
  BOOST_TEST(nearest("something else", names) == "");
  BOOST_TEST(nearest("", names) == "");
  BOOST_TEST(nearest("rho", {}) == "");
}

/// Whatever stands in the file: a case, or a message that names its place.
BOOST_AUTO_TEST_CASE(broken_files_never_crash) {
  std::mt19937 random(20240917);
  const std::vector<std::string> scraps{"0",  "-1",   "nan", "1e400", "\"\"",    "[]",  "{}",   "[[",
                                        "]]", "\n",   "=",   "\"",    ".",       "inf", "true", "-0.0",
                                        "# ", "\xc3", ",",   "{",     "\"x*t\"", "9e18"};
  const auto survives = [](const std::string& text) {
    try {
      parse_case(text, "bar.toml");
    } catch (const InputError& error) {
      BOOST_TEST(std::string(error.what()).rfind("bar.toml:", 0) == 0u, error.what());
    }
  };
  for (const std::string& base : {whole, own, row}) {
    read_broken(base, scraps, 3, 2000, random, survives);
  }
}

BOOST_AUTO_TEST_SUITE_END()
