// What features cost where they are off: bits and bytes of every pair, and what is made of ratios.
#include "runner/trade/off.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "reports/off_table.hpp"
#include "runner/panel.hpp"
#include "runner/trade/off_scenes.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(off)

namespace tt = boost::test_tools;
using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;
using reports::OffRow;
using Kind = OffRow::Kind;
using Time = OffRow::Time;

namespace {

const std::vector<std::string> every_method{"fem", "mpm-usf", "mpm-usl", "mpm-musl"};

std::vector<OffRow> untimed(const std::vector<std::string>& features, double points) {
  return runner::off({features, every_method, {points}, 0}, nullptr, {});
}

OffRow good() {
  OffRow row;
  row.feature = "viscosity";
  row.scene = "plate";
  row.method = "fem";
  row.points = 1000;
  row.same_bits = true;
  row.bytes = 17;
  row.least = 16;
  row.rim = 1.5;
  row.ratio = {5, 1.01, 0.005};
  return row;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_scene_without_a_feature_has_its_bits_and_holds_what_it_needs_and_no_more) {
  std::vector<std::string> all;
  for (const OffPair& pair : off_pairs()) all.push_back(pair.feature);
  const std::vector<OffRow> rows = untimed(all, 40000);
  BOOST_TEST(rows.size() == 4U * (6 + 4));  // plates and bars
  for (const OffRow& row : rows) {
    BOOST_TEST_CONTEXT(row.feature << ' ' << row.scene << ' ' << row.method) {
      BOOST_TEST(row.trouble == "");
      BOOST_TEST(row.same_bits);
      BOOST_TEST(row.bytes >= row.least);
      BOOST_TEST(row.bytes <= row.least + row.rim);
      BOOST_TEST(row.rim < 8);  // so that one number a point more is seen
      BOOST_TEST(row.exact());
      if (row.kind == Kind::zero) BOOST_TEST(row.more == 0);
      if (row.kind == Kind::idle) BOOST_TEST(row.more > 0);  // it is there
    }
  }
}

BOOST_AUTO_TEST_CASE(bars_hold_the_numbers_that_they_are_counted_to_hold) {
  for (const OffRow& row : untimed({"viscosity"}, 800)) {
    if (row.scene != "bar") continue;
    const bool fem = row.method == "fem";
    const double cells = fem ? 800 : 400;
    BOOST_TEST(row.points == 800U);
    BOOST_TEST(row.bytes * 800 == 8 * (fem ? cells + 4 * (cells + 1) : 4 * 800 + 5 * (cells + 1)),
               tt::tolerance(1e-14));
    BOOST_TEST(row.rim == 0);
  }
}

BOOST_AUTO_TEST_CASE(each_pair_and_solver_is_timed_where_rounds_are_asked_for) {
  const std::vector<OffRow> rows = runner::off({{"contact"}, {"fem", "mpm-musl"}, {800}, 1}, nullptr, {});
  BOOST_REQUIRE(rows.size() == 2U);
  for (const OffRow& row : rows) {
    BOOST_TEST(row.trouble == "");
    BOOST_TEST((row.ratio.rounds == 1 && row.ratio.seconds > 0));
  }
}

BOOST_AUTO_TEST_CASE(bits_bytes_and_times_are_judged_each_by_itself) {
  BOOST_TEST((good().exact() && good().time() == Time::quick));
  OffRow other = good();
  other.same_bits = false;
  BOOST_TEST(!other.exact());
  OffRow fat = good();
  fat.bytes = 17.6;
  BOOST_TEST(!fat.exact());
  OffRow costs = good();
  costs.more = 8;
  BOOST_TEST(!costs.exact());
  costs.kind = Kind::idle;
  BOOST_TEST(costs.exact());
  OffRow slow = good();
  slow.ratio = {5, 1.04, 0.005};
  BOOST_TEST((slow.exact() && slow.time() == Time::slow));
  slow.ratio.spread = 0.03;
  BOOST_TEST((slow.time() == Time::unsure));
  OffRow restless = good();
  restless.ratio.spread = 0.1;
  BOOST_TEST((restless.time() == Time::unsure));
  OffRow none = good();
  none.trouble = "particle 7 left the grid";
  BOOST_TEST(!none.exact());
}

BOOST_AUTO_TEST_CASE(what_a_scene_without_it_pays_is_the_ratio_of_zero_and_a_glance_of_the_books) {
  OffRow row = good();
  BOOST_TEST(row.off_ratio() == 1.01);
  row.kind = Kind::books;
  row.ratio = {5, 1.63, 0};
  BOOST_TEST(row.off_ratio() == 1.01, tt::tolerance(1e-14));
  BOOST_TEST((row.time() == Time::quick));
  row.ratio = {5, 4.15, 0.1};  // 1.05, give or take 0.0063
  BOOST_TEST(row.off_spread() == 0.1 * 4.15 / 63 / 1.05, tt::tolerance(1e-14));
  BOOST_TEST((row.time() == Time::slow));
  row.kind = Kind::idle;
  BOOST_TEST(std::isnan(row.off_ratio()));
  BOOST_TEST((row.time() == Time::quick));
}

BOOST_AUTO_TEST_CASE(text_and_json_tell_all_of_it) {
  OffRow idle = good(), none = good(), other = good(), fat = good(), costs = good(), slow = good();
  idle.kind = Kind::idle;
  idle.more = 8.25;
  none.trouble = "particle 7 left the grid";
  other.same_bits = false;
  fat.bytes = 30;
  costs.more = 8;
  slow.ratio = {5, 1.04, 0.001};
  const std::string text = reports::off_text({good(), idle, none, other, fat, costs, slow});
  BOOST_TEST(holds_all(text, {"viscosity", "plate", "fem", "1000", "17.0", "1.010", "0.5 %", "+1.0 %", "PASS", "8.25",
                              "particle 7 left the grid", "FAIL: other bits",
                              "FAIL: bytes that the scene does not need", "FAIL: bytes for nothing", "SLOW"}));
  const std::string json = reports::off_json({good(), none}, {});
  BOOST_TEST(
      holds_all(json, {R"("feature":"viscosity")", R"("second":"zero")", R"("same_bits":true)", R"("off_ratio":1.01)",
                       R"("trouble":"particle 7 left the grid")", R"("type":"provenance")"}));
}

BOOST_AUTO_TEST_SUITE_END()
