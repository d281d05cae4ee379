// What is measured on a plate, by hand; and small runs from the case to the verdict.
#include "runner/run/plate_measures.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "runner/app/case_file.hpp"
#include "runner/input/plate_build.hpp"
#include "runner/judge/gates.hpp"
#include "runner/run/doubt.hpp"
#include "runner/run/runner.hpp"
#include "tests/case_text.hpp"
#include "tests/messages.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(plate_measures)

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;
using analytic::PlaneQuantity;
using reports::Verdict;
namespace tt = boost::test_tools;

namespace {

const double nan_value = std::numeric_limits<double>::quiet_NaN();

/// The same values everywhere, or x in the first component.
class Given final : public analytic::PlaneSolution {
 public:
  explicit Given(std::array<double, 3> value, double size = 1, bool slope = false)
      : value_(value), size_(size), slope_(slope) {}
  std::string name() const override { return "given"; }
  double residual(const analytic::PlaneWindow&) const override { return 0; }
  bool gives(PlaneQuantity) const override { return true; }
  std::array<double, 3> at(PlaneQuantity, double x, double, double t) const override {
    return {slope_ ? x + t : value_[0], value_[1], value_[2]};
  }
  double scale(PlaneQuantity) const override { return size_; }

 private:
  std::array<double, 3> value_;
  double size_;
  bool slope_;
};

/// Four points of unequal weights.
PointField points(const std::vector<std::vector<double>>& component) {
  PointField field;
  field.x = {0.0, 1.0, 0.0, 3.0};
  field.y = {0.0, 0.0, 2.0, 4.0};
  field.weight = {1, 2, 4, 9};
  field.component = component;
  return field;
}

/// A tiny sheet of diffusion alone.
const std::string sheet = head("sheet", "code-verification") + plate("1.0", "0.5") + R"toml([diffusion]
diffusivity = 2.0
rate = "3"
scheme = "forward-euler"
[initial]
concentration = "1 + cos(pi*x)"
[model]
features = ["diffusion"]
[[variant]]
id = "still"
says = "no source"
without = ["diffusion.rate"]
[exact]
solution = "expressions"
concentration = "1 + 3*t + cos(pi*x)*exp(-2*pi*pi*t)"
)toml" + axes({"diffusion"}, "4, 8, 16, 32", "0.2") +
                          R"toml(variant = ["", "still"]
[sample]
times = { unit = "s", at = [0.02, 0.05] }
probes = [
  { id = "total", reads = "total" },
  { id = "middle", reads = "concentration", at = [0.5, 0.5] },
]
)toml" + gate("order", "order", "concentration.L2", "where = { variant = \"\" }\nexpect = 2.0\nband = [1.8, 2.2]\n") +
                          R"toml([[gate]]
id = "total"
kind = "exact"
quantity = "probe.total"
where = { variant = "" }
times = [0.05]
expect = 0.575
max = 1e-13
reason = "½ · (1 + 3 · 0.05)"
[[gate]]
id = "balance"
kind = "invariant"
quantity = "concentration.balance"
max = 1e-11
reason = "round-off of 287 232 additions of one sign, at most 3e-11 and mostly far less"
)toml";

/// A tiny plate that is pulled until it cracks.
const std::string cracking = head("cracking", "cross-code") + plate("1.0", "1.5") + rock + reference_damage +
                             R"toml([diffusion]
T_d = 0.01
lambda1 = 500
lambda2 = 0.01
rupture_strain = 0.01
source = "zone"
radius = 0.3
)toml" + supports("roller", "free", "roller", "platen") +
                             R"toml([[load]]
at = "top"
history = "ramp"
traction = 700e6
rise = { value = 50e-6, unit = "s" }
[model]
features = ["damage", "diffusion", "platen"]
[[variant]]
id = "local"
says = "without diffusion"
without = ["diffusion"]
)toml" + axes({"fem", "mpm-musl"}, "4", "0.5") +
                             R"toml(variant = ["", "local"]
[sample]
times = { unit = "s", at = [0.4e-3, 0.6e-3] }
probes = [
  { id = "radius", reads = "radius", level = 0.01, angle = 45 },
  { id = "area", reads = "area", level = 0.01 },
  { id = "largest", reads = "largest" },
  { id = "corner", reads = "concentration", at = [0, 0] },
  { id = "total", reads = "total" },
  { id = "rise", reads = "displacement-y", at = [0.5, 1.5] },
  { id = "bifurcation", reads = "acoustic-ratio" },
]
)toml" + gate("closure", "invariant", "energy.closure", "max = 1e-11\n") +
                             gate("repeat", "invariant", "bits.repeat", "max = 0\n") +
                             gate("threads", "invariant", "bits.threads", "max = 0\n") +
                             gate("whole", "invariant", "area.error", "max = 1e-12\n");

double probe(const reports::Run& run, std::size_t sample, const std::string& id) {
  for (const auto& one : run.samples.at(sample).probes)
    if (one.id == id) return one.value;
  throw std::logic_error("no such probe: " + id);
}

/// A field of two points, of two records that are the same.
PlateRecord record_of(std::vector<double> x, std::vector<double> first) {
  PlateSnapshot s;
  s.displacement.x = std::move(x);
  s.displacement.y = std::vector<double>(s.displacement.x.size(), 0.5);
  s.displacement.component = {std::move(first), {3, 4}};
  PlateRecord record;
  record.snapshots.push_back(s);
  return record;
}

}  // namespace

// ---- norms ----------------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(an_error_that_is_the_same_everywhere_has_one_norm) {
  // (3, 4) off, of a scale of 10: 0.5 in every mean.
  const PointField field = points({{4, 4, 4, 4}, {6, 6, 6, 6}});
  const Norms n = plane_error(field, Given({1, 2, 0}, 10), PlaneQuantity::displacement, 0);
  BOOST_TEST(n.l1 == 0.5, tt::tolerance(1e-15));
  BOOST_TEST(n.l2 == 0.5, tt::tolerance(1e-15));
  BOOST_TEST(n.linf == 0.5, tt::tolerance(1e-15));
  const Norms none = plane_error(field, Given({4, 6, 0}, 10), PlaneQuantity::displacement, 0);
  BOOST_TEST((none.l1 == 0 && none.l2 == 0 && none.linf == 0));
}

BOOST_AUTO_TEST_CASE(points_weigh_as_much_as_the_area_they_stand_for) {
  const PointField field = points({{0, 0, 2, 0}});  // 2 on 4 of 16
  const Norms n = plane_error(field, Given({0, 0, 0}), PlaneQuantity::concentration, 0);
  BOOST_TEST(n.l1 == 0.5);
  BOOST_TEST(n.l2 == 1.0);
  BOOST_TEST(n.linf == 2.0);
}

// σ:σ = σxx² + σyy² + 2σxy².
BOOST_AUTO_TEST_CASE(the_length_of_a_stress_is_that_of_the_tensor) {
  const PointField field = points({{1, 1, 1, 1}, {-1, -1, -1, -1}, {1, 1, 1, 1}});
  BOOST_TEST(plane_error(field, Given({0, 0, 0}), PlaneQuantity::stress, 0).linf == 2.0);
  BOOST_TEST(plane_error(field, Given({1, -1, 0}), PlaneQuantity::stress, 0).linf == std::sqrt(2.0));
}

BOOST_AUTO_TEST_CASE(the_solution_is_asked_at_each_point_and_the_fields_own_time) {
  PointField field = points({{7, 8, 7, 10}});
  field.time = 7;
  BOOST_TEST(plane_error(field, Given({}, 1, true), PlaneQuantity::concentration, 0).linf == 0.0);
  field.time = 6;
  const Norms late = plane_error(field, Given({}, 1, true), PlaneQuantity::concentration, 0);
  BOOST_TEST((late.l1 == 1 && late.l2 == 1 && late.linf == 1));
}

BOOST_AUTO_TEST_CASE(nan_anywhere_makes_every_norm_nan) {
  for (std::size_t bad = 0; bad < 4; ++bad) {
    for (std::size_t component = 0; component < 2; ++component) {
      PointField field = points({{1, 2, 3, 4}, {1, 2, 3, 4}});
      field.component[component][bad] = nan_value;
      const Norms n = plane_error(field, Given({0, 0, 0}), PlaneQuantity::velocity, 0);
      BOOST_TEST((std::isnan(n.l1) && std::isnan(n.l2) && std::isnan(n.linf)), "point " << bad);
    }
  }
  PointField weightless = points({{1, 2, 3, 4}});
  weightless.weight[2] = nan_value;
  BOOST_TEST(std::isnan(plane_error(weightless, Given({0, 0, 0}), PlaneQuantity::concentration, 0).l1));
  const Norms nothing = plane_error(PointField{}, Given({0, 0, 0}), PlaneQuantity::velocity, 0);
  BOOST_TEST((std::isnan(nothing.l1) && std::isnan(nothing.l2) && std::isnan(nothing.linf)));
}

BOOST_AUTO_TEST_CASE(the_core_is_left_out) {
  PointField field = points({{1e9, 1e9, 1, 1}});  // at 0, 1, 2 and 5 from the origin
  const auto norms = [&](double core) {
    return plane_error(field, Given({0, 0, 0}), PlaneQuantity::concentration, core);
  };
  BOOST_TEST(norms(1.5).l1 == 1.0);
  BOOST_TEST(norms(1.5).l2 == 1.0);
  BOOST_TEST(norms(1.0).linf == 1e9);  // on its rim a point counts
  BOOST_TEST(norms(0).linf == 1e9);
  field.component[0][0] = nan_value;  // so does not what is not finite in there
  BOOST_TEST(norms(1.5).l1 == 1.0);
  field.component[0][0] = std::numeric_limits<double>::infinity();
  BOOST_TEST(norms(0.5).linf == 1e9);
  BOOST_TEST(std::isnan(norms(6).l1));  // nothing is left
}

BOOST_AUTO_TEST_CASE(areas_of_nodes_add_up_to_the_plate) {
  const diffusion::Grid grid{3, 2, 0.5, 0.25};
  BOOST_TEST(node_area(grid, 0) == 0.125 / 4);   // corner
  BOOST_TEST(node_area(grid, 3) == 0.125 / 4);   // the other
  BOOST_TEST(node_area(grid, 1) == 0.125 / 2);   // bottom
  BOOST_TEST(node_area(grid, 4) == 0.125 / 2);   // left
  BOOST_TEST(node_area(grid, 5) == 0.125);       // inside
  BOOST_TEST(node_area(grid, 7) == 0.125 / 2);   // right
  BOOST_TEST(node_area(grid, 11) == 0.125 / 4);  // top right
  double sum = 0;
  for (std::size_t k = 0; k < grid.nodes(); ++k) sum += node_area(grid, k);
  BOOST_TEST(sum == 0.75);  // 1.5 · 0.5, exact in binary
  const diffusion::Grid strip{1, 1, 2, 3};
  for (std::size_t k = 0; k < 4; ++k) BOOST_TEST(node_area(strip, k) == 1.5);
}

BOOST_AUTO_TEST_CASE(nodes_stand_where_the_grid_has_them) {
  const diffusion::Grid grid{3, 2, 0.5, 0.25};
  std::vector<double> values(grid.nodes());
  std::iota(values.begin(), values.end(), 0.0);
  const PointField field = nodes_as_points(grid, values, 7);
  BOOST_TEST(field.time == 7);
  BOOST_TEST((field.x.size() == 12u && field.y.size() == 12u && field.weight.size() == 12u));
  BOOST_TEST((field.x[5] == 0.5 && field.y[5] == 0.25 && field.x[11] == 1.5 && field.y[11] == 0.5));
  BOOST_TEST(field.component[0] == values, tt::per_element());
  for (std::size_t k = 0; k < 12; ++k) BOOST_TEST(field.weight[k] == node_area(grid, k));
}

BOOST_AUTO_TEST_CASE(what_the_fields_of_a_run_hold_is_measured) {
  const Case c = parse_case(sheet, "t.toml");
  const diffusion::Grid grid = grid_of(*c.plate, 4);  // 4 × 2 cells, 15 nodes
  PlateSnapshot s;
  s.concentration.assign(15, 2);
  s.concentration[7] = -3;  // in the middle: an area of 1/16
  PlateRecord record;
  record.snapshots = {s};
  record.fed = 0.5;
  reports::Run run;
  measure_fields(c, grid, record, run);
  BOOST_TEST(run.measures.at("numbers.largest") == 3);
  BOOST_TEST(run.measures.at("concentration.least") == -1);  // of the largest magnitude
  BOOST_TEST(run.measures.at("concentration.balance") == (1 - 5.0 / 16) / 0.5 - 1);
  BOOST_TEST(run.finite);
  BOOST_TEST(!run.measures.contains("area.error"));  // no points stand for an area
  record.snapshots[0].concentration[3] = nan_value;
  measure_fields(c, grid, record, run);
  BOOST_TEST(!run.finite);
  BOOST_TEST(std::isnan(run.measures.at("concentration.balance")));

  PlateSnapshot solid;
  solid.displacement.weight = {0.25, 0.125};  // of ½
  solid.displacement.component = {{1, -5}, {0, 0}};
  solid.stress.component = {{7, 0}, {0, 0}, {0, -9}};
  record = PlateRecord{};
  record.snapshots = {solid};
  reports::Run mechanical;
  measure_fields(c, grid, record, mechanical);
  BOOST_TEST(mechanical.measures.at("numbers.largest") == 9);
  BOOST_TEST(mechanical.measures.at("area.error") == -0.25);
  BOOST_TEST(!mechanical.measures.contains("concentration.balance"));
}

// ---- scaled, mirrored, differing ------------------------------------------------------------------------------------

namespace {

/// Nothing about it is symmetric.
Plate askew() {
  Plate plate;
  plate.width = 2;
  plate.height = 3;
  plate.solid = solid::Elastic{{1e4, 0.3, 2.0, material::Plane::strain}};
  plate.edge(Side::left).support = Edge::Support::roller;
  plate.edge(Side::right).normal_traction = [](double from, double to) { return 2 * from + to; };
  plate.edge(Side::right).shear_traction = [](double from, double) { return 5 + from; };
  plate.edge(Side::bottom).support = Edge::Support::driven;
  plate.edge(Side::bottom).velocity = [](double x, double y, double t) { return Vector{x + 10 * y, t + x}; };
  plate.edge(Side::top).shear_traction = [](double, double to) { return 7 * to; };
  plate.body_force = [](double x, double y, double t) { return Vector{x, y + t}; };
  plate.initial_velocity = [](double x, double y) { return Vector{x + 1, x * y}; };
  plate.initial_displacement = [](double x, double y) { return Vector{x * x, y}; };
  return plate;
}

/// The same numbers wherever the two are asked.
void same_plate(const Plate& a, const Plate& b) {
  BOOST_TEST((a.width == b.width && a.height == b.height));
  BOOST_TEST(elastic(a).youngs_modulus == elastic(b).youngs_modulus);
  BOOST_TEST(elastic(a).density == elastic(b).density);
  for (std::size_t side = 0; side < 4; ++side) {
    const Edge &one = a.edges[side], &other = b.edges[side];
    BOOST_TEST((one.support == other.support));
    BOOST_TEST((!one.normal_traction == !other.normal_traction && !one.shear_traction == !other.shear_traction));
    BOOST_TEST(!one.velocity == !other.velocity);
    if (one.normal_traction) BOOST_TEST(one.normal_traction(0.25, 0.5) == other.normal_traction(0.25, 0.5));
    if (one.shear_traction) BOOST_TEST(one.shear_traction(0.25, 0.5) == other.shear_traction(0.25, 0.5));
    if (one.velocity) BOOST_TEST((one.velocity(0.75, 0, 4) == other.velocity(0.75, 0, 4)));
  }
  BOOST_TEST((a.body_force(0.5, 0.25, 8) == b.body_force(0.5, 0.25, 8)));
  BOOST_TEST((a.initial_velocity(0.5, 0.25) == b.initial_velocity(0.5, 0.25)));
  BOOST_TEST((a.initial_displacement(0.5, 0.25) == b.initial_displacement(0.5, 0.25)));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_plate_seen_from_behind) {
  const Plate plate = askew(), behind = mirrored(plate);
  BOOST_TEST((behind.edge(Side::right).support == Edge::Support::roller));
  BOOST_TEST((behind.edge(Side::left).support == Edge::Support::free));
  // Along the outward normal, and up, are the same from behind; to the right is to the left.
  BOOST_TEST(behind.edge(Side::left).normal_traction(1, 2) == 4);
  BOOST_TEST(behind.edge(Side::left).shear_traction(1, 2) == 6);
  BOOST_TEST(!behind.edge(Side::right).normal_traction);
  BOOST_TEST(behind.edge(Side::top).shear_traction(1, 2) == -14);
  BOOST_TEST((behind.edge(Side::bottom).velocity(0.5, 0, 3) == Vector{-1.5, 4.5}));  // at x = 1.5
  BOOST_TEST((behind.body_force(0.5, 1, 3) == Vector{-1.5, 4}));
  BOOST_TEST((behind.initial_velocity(0.5, 2) == Vector{-2.5, 3}));
  BOOST_TEST((behind.initial_displacement(0.5, 2) == Vector{-2.25, 2}));
  same_plate(mirrored(behind), plate);
}

BOOST_AUTO_TEST_CASE(a_plate_in_other_units) {
  const PowersOfTwo by{2, 4, 16, 32};
  BOOST_TEST(by.time() == 4);           // L √(ρ/E)
  BOOST_TEST(by.velocity() == 4);       // σ/√(Eρ)
  BOOST_TEST(by.displacement() == 16);  // σL/E
  BOOST_TEST(by.displacement() == by.velocity() * by.time());
  const Plate plate = askew(), large = scaled(plate, by);
  BOOST_TEST((large.width == 4 && large.height == 6));
  BOOST_TEST((elastic(large).youngs_modulus == 4e4 && elastic(large).density == 32));
  BOOST_TEST(elastic(large).poissons_ratio == 0.3);
  BOOST_TEST(large.edge(Side::right).normal_traction(4, 8) == 32 * 4);  // of 1 to 2
  BOOST_TEST(large.edge(Side::top).shear_traction(4, 8) == 32 * 14);
  BOOST_TEST((large.edge(Side::bottom).velocity(1, 0, 12) == Vector{4 * 0.5, 4 * 3.5}));
  BOOST_TEST((large.body_force(1, 2, 12) == Vector{0.5, 4}));  // σ/(ρL), here 1
  BOOST_TEST((large.initial_velocity(1, 2) == Vector{4 * 1.5, 4 * 0.5}));
  BOOST_TEST((large.initial_displacement(1, 2) == Vector{16 * 0.25, 16 * 1.0}));
  same_plate(scaled(large, {0.5, 0.25, 0.0625, 0.03125}), plate);
  same_plate(scaled(plate, {}), plate);
}

BOOST_AUTO_TEST_CASE(numbers_that_differ_are_counted) {
  const PlateRecord a = record_of({0.25, 0.75}, {1, 2});
  BOOST_TEST(differing(a, a, {}, false) == 0);
  BOOST_TEST(differing(a, record_of({0.25, 0.75}, {1, 5}), {}, false) == 1);
  BOOST_TEST(differing(a, record_of({0.25, 0.75}, {0, 5}), {}, false) == 2);
  BOOST_TEST(differing(a, record_of({0.25, 0.75}, {1, std::nextafter(2.0, 3.0)}), {}, false) == 1);  // the last bit
  BOOST_TEST(differing(a, record_of({0.25, 0.75}, {1, nan_value}), {}, false) == 1);
  const PlateRecord nowhere = record_of({0.25, 0.75}, {1, nan_value});
  BOOST_TEST(differing(nowhere, nowhere, {}, false) == 1);  // not a number is not the same as anything
  // In another order, the same places are compared.
  PlateRecord turned = record_of({0.75, 0.25}, {2, 1});
  turned.snapshots[0].displacement.component[1] = {4, 3};
  BOOST_TEST(differing(a, turned, {}, false) == 0);
}

BOOST_AUTO_TEST_CASE(mirrored_numbers_stand_on_the_other_side_with_the_other_sign) {
  const PlateRecord a = record_of({0.25, 0.75}, {1, 2});
  PlateRecord behind = record_of({0.25, 0.75}, {-2, -1});
  behind.snapshots[0].displacement.component[1] = {4, 3};
  BOOST_TEST(differing(a, behind, {}, true) == 0);
  BOOST_TEST(differing(a, behind, {}, false) == 4);
  BOOST_TEST(differing(a, a, {}, true) == 4);
  // Of a stress the shear turns round.
  PlateRecord b = a;
  PointField& stress = b.snapshots[0].stress;
  stress.x = {0.25, 0.75};
  stress.y = {0.5, 0.5};
  stress.component = {{1, 2}, {3, 4}, {5, 6}};
  behind.snapshots[0].stress = stress;
  behind.snapshots[0].stress.component = {{2, 1}, {4, 3}, {-6, -5}};
  BOOST_TEST(differing(b, behind, {}, true) == 0);
  behind.snapshots[0].stress.component[2] = {6, 5};
  BOOST_TEST(differing(b, behind, {}, true) == 2);
}

BOOST_AUTO_TEST_CASE(scaled_numbers_are_powers_of_two_apart) {
  const PlateRecord a = record_of({0.25, 0.75}, {1, 2});
  PlateRecord large = record_of({0.5, 1.5}, {16, 32});
  large.snapshots[0].displacement.component[1] = {48, 64};
  BOOST_TEST(differing(a, large, {2, 4, 16, 32}, false) == 0);
  BOOST_TEST(differing(a, large, {2, 4, 16, 16}, false) == 4);
}

BOOST_AUTO_TEST_CASE(records_of_other_lengths_or_outcomes_differ) {
  const PlateRecord a = record_of({0.25, 0.75}, {1, 2});
  PlateRecord b = a;
  b.snapshots.push_back(b.snapshots[0]);
  BOOST_TEST(differing(a, b, {}, false) == 1);
  b = a;
  b.outcome = diptych::Outcome::unstable;
  BOOST_TEST(differing(a, b, {}, false) == 1);
  b = a;
  b.snapshots[0].displacement.x.pop_back();
  BOOST_TEST(differing(a, b, {}, false) >= 1);
  // Crack densities and concentrations too.
  PlateRecord cracked = a;
  cracked.snapshots[0].crack_density = {0.1, 0.2};
  cracked.snapshots[0].concentration = {1, 2, 3};
  PlateRecord other = cracked;
  BOOST_TEST(differing(cracked, other, {}, false) == 0);
  other.snapshots[0].crack_density[1] = 0.3;
  other.snapshots[0].concentration[0] = 0;
  BOOST_TEST(differing(cracked, other, {}, false) == 2);
  other.snapshots[0].crack_density.pop_back();
  BOOST_TEST(differing(cracked, other, {}, false) == 2);
}

BOOST_AUTO_TEST_CASE(zeros_compare_with_nothing) {
  PlateRecord still = record_of({0.25, 0.75}, {0, 0});
  still.snapshots[0].displacement.component[1] = {0, 0};
  BOOST_TEST(std::isnan(differing(still, still, {}, false)));
  BOOST_TEST(std::isnan(differing({}, {}, {}, false)));
}

// ---- probes ---------------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(a_probe_at_a_place_reads_the_nearest_point) {
  const Case c = parse_case(cracking, "t.toml");
  PlateSnapshot s;
  s.stress.x = {0.1, 0.9};
  s.stress.y = {0.1, 0.9};
  s.stress.component = {{1, 2}, {3, 4}, {5, 6}};
  s.velocity = s.displacement = s.stress;
  s.velocity.component = {{11, 12}, {13, 14}};
  s.displacement.component = {{21, 22}, {23, 24}};
  const diffusion::Grid grid = grid_of(*c.plate, 4);
  const auto reads = [&](const std::string& what, double x, double y) {
    PlateProbe one;
    one.id = "p";
    one.reads = what;
    one.x = x;
    one.y = y;
    return read_plate_probe(c, grid, one, s, {}, {}).value;
  };
  BOOST_TEST((reads("stress-xx", 0, 0) == 1 && reads("stress-yy", 0, 0) == 3 && reads("stress-xy", 0, 0) == 5));
  BOOST_TEST((reads("stress-xx", 1, 1) == 2 && reads("stress-xy", 1, 1) == 6));
  BOOST_TEST((reads("velocity-x", 0, 0) == 11 && reads("velocity-y", 1, 1) == 14));
  BOOST_TEST((reads("displacement-x", 1, 1) == 22 && reads("displacement-y", 0, 0) == 23));
  s.stress.component[0][0] = nan_value;
  BOOST_TEST(std::isnan(reads("stress-xx", 0, 0)));
  BOOST_TEST(std::isnan(reads("total", 0, 0)));  // there is no concentration
  BOOST_TEST(std::isnan(reads("concentration", 0, 0)));
}

BOOST_AUTO_TEST_CASE(a_probe_of_the_concentration_reads_the_nearest_node) {
  const Case c = parse_case(sheet, "t.toml");
  PlateSnapshot s;
  s.concentration.resize(15);
  std::iota(s.concentration.begin(), s.concentration.end(), 0.0);  // five a row
  PlateProbe one;
  one.reads = "concentration";
  const auto at = [&](double x, double y) {
    one.x = x;
    one.y = y;
    return read_plate_probe(c, grid_of(*c.plate, 4), one, s, {}, {}).value;
  };
  BOOST_TEST((at(0, 0) == 0 && at(1, 0) == 4 && at(0, 0.5) == 10 && at(1, 0.5) == 14));
  BOOST_TEST((at(0.37, 0.26) == 6 && at(0.38, 0.13) == 7 && at(0.38, 0.12) == 2));
  one.reads = "total";
  BOOST_TEST(read_plate_probe(c, grid_of(*c.plate, 4), one, s, {}, {}).value == 3.5);  // 7 on an area of ½
}

// At the time on its label, between two steps.
BOOST_AUTO_TEST_CASE(a_probe_of_the_platen_reads_its_history) {
  const Case c = parse_case(sheet, "t.toml");
  PlateSnapshot s;
  s.time = 0.25;
  PlateProbe one;
  one.reads = "platen";
  const diffusion::Grid grid = grid_of(*c.plate, 4);
  BOOST_TEST(read_plate_probe(c, grid, one, s, {}, {{0.1, 0.2, 0.3}, {1, 2, 4}}).value == 3, tt::tolerance(1e-12));
  BOOST_TEST(std::isnan(read_plate_probe(c, grid, one, s, {}, {}).value));
}

BOOST_AUTO_TEST_CASE(damage_is_shown_on_the_nodes) {
  Case c = parse_case(cracking, "t.toml");
  const diffusion::Grid grid = grid_of(*c.plate, 2);  // 2 × 3 cells
  PlateSnapshot s;
  s.concentration.assign(12, 0);
  s.concentration[0] = 20;   // eq. 27: C_d = λ2 C = 0.2
  s.concentration[1] = -5;   // an overshoot is no damage
  s.concentration[4] = 200;  // D is that of C_d = 9/16, the cap; C_d is as it is
  const auto shown = damage_fields(c, grid, s);
  BOOST_TEST((shown.nx == 2 && shown.ny == 3 && shown.width == 1 && shown.height == 1.5));
  BOOST_TEST(shown.crack_density[0] == 0.2);
  BOOST_TEST(shown.crack_density[4] == 2.0);
  const material::TensileDamage& law = c.plate->cracking()->law;
  BOOST_TEST(shown.damage[0] == law.damage(0.2));
  BOOST_TEST(shown.damage[4] == law.damage(9.0 / 16));
  BOOST_TEST((shown.crack_density[1] == -0.05 && shown.damage[1] == 0 && shown.damage.size() == 12u));
  // Without diffusion each node has the mean of the cells around it.
  c = with_parameters(c, {"fem", 2, 0.5, {}, {}, "local"});
  s.crack_density = {0.1, 0.2, 0.3, 0.4, 0, 0};
  const auto local = damage_fields(c, grid, s);
  BOOST_TEST(local.crack_density[0] == 0.1);
  BOOST_TEST(local.crack_density[1] == 0.15, tt::tolerance(1e-15));
  BOOST_TEST(local.crack_density[3] == 0.2, tt::tolerance(1e-15));   // left, between the first rows
  BOOST_TEST(local.crack_density[4] == 0.25, tt::tolerance(1e-15));  // in the middle of four
  BOOST_TEST(local.crack_density[11] == 0);
}

// ---- whole runs -----------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(a_tiny_run_of_diffusion_alone) {
  const Case c = parse_case(sheet, "t.toml");
  std::vector<reports::Run> runs;
  for (const Leaf& leaf : leaves(c)) runs.push_back(run_leaf(c, leaf));
  BOOST_REQUIRE_EQUAL(runs.size(), 8u);
  for (const auto& run : runs) {
    BOOST_TEST((run.status == "completed" && run.invalid.empty() && run.finite), run.label() << ": " << run.invalid);
    BOOST_TEST((run.features == std::vector<std::string>{"diffusion"}));
    BOOST_REQUIRE_EQUAL(run.samples.size(), 2u);
    BOOST_TEST((run.samples[0].asked == 0.02 && run.samples[1].asked == 0.05));
    BOOST_TEST(run.samples[1].time == 0.05, tt::tolerance(1e-14));
    BOOST_REQUIRE_EQUAL(run.samples[1].errors.size(), 1u);
    BOOST_TEST(run.samples[1].errors[0].field == "concentration");
    BOOST_TEST(run.samples[1].errors[0].scale == 2.15, tt::tolerance(0.2));
    BOOST_TEST(std::abs(run.measures.at("concentration.balance")) < 1e-11);
    BOOST_TEST(run.node_steps > 0);
  }
  // 4 × 2 cells of ¼ with d = 2: Δt = 0.2 · h²/d = 0.00625 of which eight make 0.05.
  BOOST_TEST((runs[0].cells == 4 && runs[0].steps == 8 && runs[0].unknowns == 15));
  BOOST_TEST(runs[0].time_step == 0.00625, tt::tolerance(1e-14));
  BOOST_TEST(runs[0].courant == 0.2, tt::tolerance(1e-14));
  BOOST_TEST(runs[0].time_step_limit == 0.25 * 0.0625 / 2, tt::tolerance(1e-14));  // h²/4d
  BOOST_TEST(runs[0].cell_size == 0.25);
  // The source fills the sheet evenly, and by symmetry its middle stays at the mean.
  for (const auto& run : runs) {
    const double mean = run.parameters == "still" ? 1 : 1 + 3 * 0.05;
    BOOST_TEST(probe(run, 1, "total") == mean / 2, tt::tolerance(1e-13));  // 512 steps, half an ulp each at most
    BOOST_TEST(probe(run, 1, "middle") == mean, tt::tolerance(1e-13));
  }
  BOOST_TEST((runs[1].parameters == "still" || runs[4].parameters == "still"));
  for (const GateSpec& gate : c.gates) {
    const auto judged = judge(c, gate, runs);
    BOOST_TEST((judged.verdict == Verdict::pass), gate.id << ": " << judged.message);
  }
}

BOOST_AUTO_TEST_CASE(a_tiny_run_of_damage_by_both_methods) {
  const Case c = parse_case(cracking, "t.toml");
  std::vector<reports::Run> runs;
  for (const Leaf& leaf : leaves(c)) runs.push_back(run_leaf(c, leaf));
  BOOST_REQUIRE_EQUAL(runs.size(), 4u);
  for (const auto& run : runs) {
    const bool local = run.parameters == "local";
    BOOST_TEST((run.status == "completed" && run.invalid.empty()), run.label() << ": " << run.message << run.invalid);
    const std::vector<std::string> declared{"damage", "diffusion", "platen"}, less{"damage", "platen"};
    BOOST_TEST((run.features == (local ? less : declared)), run.label());
    BOOST_REQUIRE_EQUAL(run.samples.size(), 2u);
    for (const auto& sample : run.samples) {
      BOOST_TEST(sample.errors.empty());  // nothing exact is known
      BOOST_REQUIRE(sample.plate.has_value());
      BOOST_TEST((sample.plate->nx == 4 && sample.plate->ny == 6 && sample.plate->crack_density.size() == 35u));
      BOOST_TEST((sample.files.empty() && sample.probes.size() == 7u));
    }
    // The platen's displacement after each step; its last is that of the top.
    BOOST_TEST(run.platen.x.size() == static_cast<std::size_t>(run.steps));
    BOOST_TEST(run.platen.x.back() == 0.6e-3, tt::tolerance(1e-13));
    BOOST_TEST(run.platen.y.back() > 0);
    if (run.method == "fem") BOOST_TEST(probe(run, 1, "rise") == run.platen.y.back(), tt::tolerance(1e-12));
    BOOST_TEST(probe(run, 1, "largest") > 0.01);
    BOOST_TEST((probe(run, 1, "area") > 0 && probe(run, 1, "area") >= probe(run, 0, "area")));
    BOOST_TEST((probe(run, 1, "bifurcation") < 1 && probe(run, 1, "bifurcation") > -10));
    BOOST_TEST(std::isnan(probe(run, 1, "total")) == local);
    BOOST_TEST(std::isnan(probe(run, 1, "corner")) == local);
    if (!local) {
      BOOST_TEST(probe(run, 1, "corner") * 0.01 == run.samples[1].plate->crack_density[0]);  // eq. 27
      BOOST_TEST(std::abs(run.measures.at("concentration.balance")) < 1e-12);
    }
    BOOST_TEST(run.measures.contains("concentration.balance") == !local);
    BOOST_TEST((run.measures.contains("energy.drift") && run.measures.contains("momentum.drift")));
    BOOST_TEST((run.ledger.empty() && run.time_step_limit > run.time_step));
  }
  BOOST_TEST((runs[0].method == "fem" && runs[0].unknowns == 2 * (35 + 24)));
  for (const GateSpec& gate : c.gates) {
    const auto judged = judge(c, gate, runs);
    BOOST_TEST((judged.verdict == Verdict::pass), gate.id << ": " << judged.message);
    BOOST_TEST(judged.checks.size() == 4u);
  }
  Running keep;
  keep.books = Books::lines;
  keep.keep_fields = true;
  Case once = c;
  once.gates.clear();
  const auto kept = run_leaf(once, leaves(c)[0], keep);
  BOOST_TEST(kept.ledger.size() == static_cast<std::size_t>(kept.steps));
  BOOST_REQUIRE_EQUAL(kept.samples[0].files.size(), 2u);
  BOOST_TEST((kept.samples[0].files[0].name == "mesh" && kept.samples[0].files[1].name == "cells"));
  BOOST_TEST(!kept.measures.contains("bits.repeat"));  // nobody asks
}

// Of a rate that is linear in time the middle of the step gives all of it.
BOOST_AUTO_TEST_CASE(sources_give_what_they_say) {
  Case c = parse_case(sheet, "t.toml");
  const Leaf leaf = leaves(c)[0];
  c.plate->diffusion->rate = "6*t";
  BOOST_TEST(probe(run_leaf(c, leaf), 1, "total") == 0.5 * (1 + 3 * 0.05 * 0.05), tt::tolerance(1e-13));
  c.plate->diffusion->rate = "";
  c.plate->diffusion->corner_rate = 4;  // of the quarter plane, whatever the cell
  for (const Leaf& each : {leaves(c)[0], leaves(c).at(2)}) {
    const auto run = run_leaf(c, each);
    BOOST_TEST(probe(run, 1, "total") == 0.5 + 4 * 0.05, tt::tolerance(1e-13));
    BOOST_TEST(std::abs(run.measures.at("concentration.balance")) < 1e-11);
  }
}

namespace {

/// The roller mode, whose error on any mesh is known to round-off.
Case roller() {
  return parse_case(
      head("roller", "code-verification") + plate("1.0", "1.0") + elastic("1e4", "0.3", "1.0") +
          supports("roller", "roller", "roller", "roller") + R"toml([model]
features = ["elastic"]
[exact]
solution = "roller-mode"
mode = 1
amplitude = 1e-3
start = "moving"
)toml" + axes({"fem", "mpm-usf"}, "8", "0.5") +
          R"toml([sample]
times = { unit = "s", at = [0.005] }
)toml" + gate("constant", "constant", "displacement.L2", "predict = \"mode\"\nratio = [0.999999, 1.000001]\n") +
          gate("limit", "limit", "critical_courant",
               "predict = \"stability-limit\"\nratio = [0.98, 1.02]\nsteps = 4000\nwhere = { method = \"fem\" }\n") +
          gate("mirror", "invariant", "bits.mirror", "max = 0\n") +
          gate("power-of-two", "invariant", "bits.power-of-two", "max = 0\n"),
      "t.toml");
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_tiny_run_of_a_mode_is_compared_with_its_solution_and_its_theory) {
  const Case c = roller();
  BOOST_TEST(doubt_exact(c) == "");
  std::vector<reports::Run> runs;
  for (const Leaf& leaf : leaves(c)) runs.push_back(run_leaf(c, leaf));
  for (const auto& run : runs) {
    BOOST_TEST((run.status == "completed" && run.invalid.empty()), run.label() << ": " << run.invalid);
    BOOST_REQUIRE_EQUAL(run.samples.at(0).errors.size(), 3u);
    for (const auto& error : run.samples[0].errors) {
      BOOST_TEST((error.l1 > 0 && error.l1 <= error.l2 && error.l2 <= error.linf));
      BOOST_TEST(error.predicted_l2.has_value());
    }
  }
  const auto& displacement = runs[0].samples[0].errors[2];
  BOOST_TEST((displacement.field == "displacement" && displacement.scale == 1e-3));
  BOOST_TEST((runs[0].measures.contains("critical_courant") && !runs[1].measures.contains("critical_courant")));
  for (const GateSpec& gate : c.gates) {
    const auto judged = judge(c, gate, runs);
    BOOST_TEST((judged.verdict == Verdict::pass), gate.id << ": " << judged.message);
    BOOST_TEST(judged.checks.size() == (gate.id == "limit" ? 1u : 2u));
  }
}

BOOST_AUTO_TEST_CASE(a_solution_that_the_runs_do_not_follow_is_seen) {
  Case c = roller();
  c.plate->supports[0] = Edge::Support::free;  // the mode's own plate has rollers all round
  const auto gate = judge(c, c.gates[0], {run_leaf(c, leaves(c)[0]), run_leaf(c, leaves(c)[1])});
  BOOST_TEST((gate.verdict == Verdict::fail));
}

// Undamaged, and with diffusion beside it stepped by forward Euler: runs that must be those without.
BOOST_AUTO_TEST_CASE(a_run_is_compared_with_others_where_a_gate_asks_for_it) {
  Case c = parse_case(cracking, "t.toml");
  c.axes[0].variant = {""};
  c.plate->cracking()->evolution.critical_strain = 1;  // never reached
  c.gates.resize(2);
  c.gates[0].quantity = "bits.undamaged";
  c.gates[1].quantity = "cross.forward-euler";
  for (const Leaf& leaf : leaves(c)) {
    auto run = run_leaf(c, leaf);
    BOOST_TEST(run.measures.at("bits.undamaged") == 0);
    BOOST_TEST(!run.measures.contains("cross.forward-euler"));  // of zeros
    Case cracked = c;
    cracked.plate->cracking()->evolution.critical_strain = 0.002;
    cracked.plate->cracking()->evolution.diffusion->scheme = diffusion::Scheme::crank_nicolson;
    run = run_leaf(cracked, leaf);
    BOOST_TEST(run.measures.at("bits.undamaged") > 0);
    // Two schemes of unlike order on one staggering: once resolved, their difference goes with the time step.
    const auto apart = [&](double courant) {
      Leaf shorter = leaf;
      shorter.courant = courant;
      return run_leaf(cracked, shorter).measures.at("cross.forward-euler");
    };
    const double coarse = apart(1.0 / 16), fine = apart(1.0 / 64);
    BOOST_TEST((fine > 0 && fine < coarse / 3), coarse << " and " << fine);
  }
}

BOOST_AUTO_TEST_CASE(the_scene_is_as_the_case_says) {
  const Case c = parse_case(cracking, "t.toml");
  const Plate plate = make_plate(c, 8);
  BOOST_TEST((plate.width == 1 && plate.height == 1.5 && !plate.convected && plate.pic == 0 && !plate.body_force));
  BOOST_TEST((plate.edge(Side::top).support == Edge::Support::platen));
  BOOST_TEST((plate.edge(Side::left).support == Edge::Support::roller));
  BOOST_TEST((plate.edge(Side::right).support == Edge::Support::free));
  const auto& pull = plate.edge(Side::top).normal_traction;
  BOOST_TEST(pull(0, 50e-6) == 350e6, tt::tolerance(1e-14));  // the mean of the rise
  BOOST_TEST(pull(50e-6, 70e-6) == 700e6, tt::tolerance(1e-14));
  BOOST_TEST((!plate.edge(Side::top).shear_traction && !plate.edge(Side::left).normal_traction));
  BOOST_TEST((!plate.initial_velocity && !plate.initial_displacement));
  BOOST_TEST(!make_plane_exact(c));

  // In motion: amplitude times frequency, √2 π c_d of the first roller mode.
  Case mode = roller();
  const double omega = std::sqrt(2.0) * std::acos(-1.0) * std::sqrt(1e4 * 0.7 / (1.3 * 0.4));
  const Plate moving = make_plate(mode, 8);
  BOOST_TEST((moving.initial_velocity && !moving.initial_displacement));
  BOOST_TEST(moving.initial_velocity(0.5, 0)[0] == 1e-3 * omega, tt::tolerance(1e-13));
  BOOST_TEST(moving.initial_velocity(0, 0.5)[1] == 1e-3 * omega, tt::tolerance(1e-13));
  mode.plate->exact.parameters["start"] = 0;
  const Plate displaced = make_plate(mode, 8);
  BOOST_TEST((displaced.initial_displacement && !displaced.initial_velocity));
  BOOST_TEST(displaced.initial_displacement(0.5, 0)[0] == 1e-3, tt::tolerance(1e-14));
  // Lamé's mode has no divergence, waves go one way.
  mode.plate->exact.solution = "lame-mode";
  const Plate lame = make_plate(mode, 8);
  BOOST_TEST(lame.initial_displacement(0, 0.5)[0] == 1e-3, tt::tolerance(1e-14));
  BOOST_TEST(lame.initial_displacement(0.5, 0)[1] == -1e-3, tt::tolerance(1e-14));
  mode.plate->exact.solution = "s-wave";
  BOOST_TEST((make_plate(mode, 8).initial_displacement(0, 0.3) == Vector{0, 1e-3}));
  mode.plate->exact.solution = "p-wave";
  BOOST_TEST((make_plate(mode, 8).initial_displacement(0.5, 0.3) == Vector{1e-3, 0}));
}

BOOST_AUTO_TEST_CASE(features_other_than_declared_make_a_run_invalid) {
  Case c = parse_case(sheet, "t.toml");
  c.features = {"diffusion", "elastic"};
  BOOST_TEST(holds(run_leaf(c, leaves(c)[0]).invalid, "elastic"));
}

BOOST_AUTO_TEST_CASE(two_sample_times_on_one_step_are_two) {
  Case c = parse_case(sheet, "t.toml");
  c.times = {0.05, 0.0501};
  const auto run = run_leaf(c, leaves(c)[0]);
  BOOST_TEST((run.invalid.empty() && run.status == "completed"), run.invalid);
  BOOST_TEST(run.samples.size() == 2U);
}

BOOST_AUTO_TEST_CASE(a_step_above_the_limit_is_refused_with_both_numbers) {
  const auto refusal = [](const Case& c) { return message_of<InputError>([&] { run_cases({c}, {}); }); };
  Case c = parse_case(sheet, "t.toml");
  c.axes[0].courant = {0.3};
  const std::string said = refusal(c);
  BOOST_TEST(holds(said, "0.3 for diffusion with 4 cells"), said);
  BOOST_TEST(holds(said, "a time step of 0.009375"), said);  // 0.3 h²/d
  BOOST_TEST(holds(said, "the limit 0.0078125 (Courant 0.25)"), said);
  BOOST_TEST(holds(said, "allow_unstable"), said);
  c.allow_unstable = true;
  BOOST_TEST(refusal(c) == "");
  c.allow_unstable = false;
  c.axes[0].courant = {0.25};
  BOOST_TEST(refusal(c) == "");  // at the limit

  Case solid = parse_case(cracking, "t.toml");
  solid.axes[0].method = {"fem"};
  solid.axes[0].courant = {2.0};
  const TimeStep step = step_of(solid, leaves(solid)[0]);
  BOOST_TEST((step.limit > 0 && step.limit < step.asked));
  BOOST_TEST(step.asked == 2 * step.unit);
  const std::string refused = refusal(solid);
  BOOST_TEST(holds(refused, "2 for fem with 4 cells"), refused);
  BOOST_TEST(holds(refused, "above the limit"), refused);
}

BOOST_AUTO_TEST_CASE(a_run_above_the_limit_is_seen_to_blow_up) {
  Case c = parse_case(cracking, "t.toml");
  c.allow_unstable = true;
  c.axes[0].method = {"fem"};
  c.axes[0].courant = {3.0};
  c.axes[0].variant = {""};
  c.times = {0.4e-3, 0.1};
  c.gates.resize(1);
  const auto runs = run_cases({c}, {}).at(0).runs;
  BOOST_REQUIRE_EQUAL(runs.size(), 1u);
  BOOST_TEST(runs[0].status == "unstable");
  BOOST_TEST((!runs[0].message.empty() && runs[0].samples.empty()));
  BOOST_TEST((judge(c, c.gates[0], runs).verdict == Verdict::unstable));

  // Forward Euler of diffusion never gets to the end above its limit.
  Case d = parse_case(sheet, "t.toml");
  d.allow_unstable = true;
  d.axes[0].courant = {1.0};
  for (const auto& run : run_cases({d}, {}).at(0).runs)
    BOOST_TEST((run.status != "completed" && !run.message.empty()), run.label() << ": " << run.status);
}

BOOST_AUTO_TEST_CASE(an_implicit_scheme_has_no_limit) {
  Case c = parse_case(sheet, "t.toml");
  for (const auto scheme :
       {diffusion::Scheme::backward_euler, diffusion::Scheme::rkl2, diffusion::Scheme::sub_cycled}) {
    c.plate->diffusion->scheme = scheme;
    BOOST_TEST(step_of(c, leaves(c)[0]).limit == std::numeric_limits<double>::infinity());
  }
  c.plate->diffusion->scheme = diffusion::Scheme::forward_euler;
  BOOST_TEST(step_of(c, leaves(c)[0]).limit == 0.0078125);
}

// Forward Euler beside the wave: one step that satisfies both.
BOOST_AUTO_TEST_CASE(forward_euler_beside_the_wave_shortens_the_step) {
  Case c = parse_case(cracking, "t.toml");
  const Leaf leaf = leaves(c)[0];
  const TimeStep before = step_of(c, leaf);
  BOOST_TEST(before.asked == 0.5 * before.unit);
  c.plate->cracking()->evolution.diffusion->scheme = diffusion::Scheme::forward_euler;
  const TimeStep same = step_of(c, leaf);
  BOOST_TEST(same.asked == std::min(before.asked, 0.0625 / (4 * 500)), tt::tolerance(1e-14));
  c.plate->cracking()->evolution.diffusion->mobility = 1e6;
  BOOST_TEST(step_of(c, leaf).asked == 0.0625 / 4e6, tt::tolerance(1e-14));
  BOOST_TEST(step_of(c, leaf).limit == before.limit);
}

BOOST_AUTO_TEST_CASE(a_run_that_is_asked_to_stop_stops) {
  const std::atomic<bool> cancelled{true};
  Running running;
  running.cancelled = &cancelled;
  const Case c = parse_case(sheet, "t.toml"), solid = parse_case(cracking, "t.toml");
  BOOST_TEST(run_leaf(c, leaves(c)[0], running).status == "cancelled");
  BOOST_TEST(run_leaf(solid, leaves(solid)[0], running).status == "cancelled");
}

BOOST_AUTO_TEST_CASE(a_run_is_described_before_it_is_run) {
  const Case c = parse_case(cracking, "t.toml");
  const Leaf leaf = leaves(c).back();
  const auto run = describe(*case_of(c, leaf), leaf);
  BOOST_TEST((run.method == "mpm-musl" && run.parameters == "local" && run.particles == "0.25 0.75"));
  BOOST_TEST((run.status == "cancelled" && run.cell_size == 0.25 && run.unknowns == 2 * 4 * 24));
}

BOOST_AUTO_TEST_SUITE_END()
