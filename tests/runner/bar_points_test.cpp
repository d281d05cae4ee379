// Fields of bars, point by point, beside the exact ones.
#include "runner/run/bar_points.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "reports/results.hpp"
#include "runner/app/catalogue.hpp"
#include "runner/run/run_leaf.hpp"

BOOST_AUTO_TEST_SUITE(bar_points)

using namespace diptych;
using namespace diptych::runner;
namespace tt = boost::test_tools;

namespace {

reports::Run run_of(const std::string& id, const std::string& label, bool keep_fields = true) {
  std::vector<Case> cases = select_cases({id});
  keep_runs(cases, {label});
  Running running;
  running.keep_fields = keep_fields;
  return run_leaf(cases.at(0), leaves(cases.at(0)).at(0), running);
}

}  // namespace

BOOST_AUTO_TEST_CASE(particles_carry_all_three_fields) {
  const auto run = run_of("bar.convection.rigid", "mpm-musl N=50 C=0.5 ppc=2");
  BOOST_REQUIRE(run.samples.size() == 2U);
  const auto& points = run.samples[1].bar_points.at(0);
  BOOST_TEST(run.samples[1].bar_points.size() == 1U);
  BOOST_TEST(points.kind == "particles");
  BOOST_TEST(points.x.size() == 100U);
  BOOST_TEST(points.x[1] == 0.75 / 50, tt::tolerance(1e-14));  // reference coordinates, wherever the bar has flown to
  for (const char* field : {"displacement", "velocity", "stress"}) {
    BOOST_TEST(points.fields.at(field).size() == points.x.size());
    BOOST_TEST(points.exact.at(field).size() == points.x.size());
  }
  BOOST_TEST(points.exact.at("displacement")[7] == 3.3 * 2 / 100, tt::tolerance(1e-12));  // V t, at t = 2 L/c
  BOOST_TEST(points.fields.at("displacement")[7] == points.exact.at("displacement")[7], tt::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(a_mesh_has_nodes_and_elements) {
  const auto run = run_of("impact.elastic", "fem *");
  const auto& sample = run.samples.at(0);
  BOOST_REQUIRE(sample.bar_points.size() == 2U);
  const auto &nodes = sample.bar_points[0], &elements = sample.bar_points[1];
  BOOST_TEST(nodes.kind == "nodes");
  BOOST_TEST(elements.kind == "elements");
  BOOST_TEST(nodes.x.size() == elements.x.size() + 2);  // two bars of n elements and n + 1 nodes
  BOOST_TEST(nodes.bar.front() == 1);
  BOOST_TEST(nodes.bar.back() == 2);
  BOOST_TEST(nodes.bar[nodes.x.size() / 2 - 1] == 1);
  BOOST_TEST(nodes.bar[nodes.x.size() / 2] == 2);
  BOOST_TEST((nodes.fields.contains("velocity") && nodes.fields.contains("displacement")));
  BOOST_TEST((elements.fields.contains("stress") && !elements.fields.contains("velocity")));
  // Ends that touch have exact values, each of its own bar.
  for (const auto& points : sample.bar_points)
    for (const auto& [field, values] : points.exact)
      for (const double value : values) BOOST_TEST(std::isfinite(value), field);
}

BOOST_AUTO_TEST_CASE(they_are_kept_where_they_are_asked_for) {
  BOOST_TEST(run_of("bar.energy", "fem *", false).samples.at(0).bar_points.empty());
  const auto points = run_of("bar.energy", "fem *").samples.at(0).bar_points.at(0);
  BOOST_TEST(points.exact.empty());  // no exact solution
}

BOOST_AUTO_TEST_SUITE_END()
