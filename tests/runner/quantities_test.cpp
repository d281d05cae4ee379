// What gates can judge is one table: names are found in it, what a case lacks is told, and what runs make stands in it.
#include "runner/compare/quantities.hpp"

#include <boost/test/unit_test.hpp>
#include <set>
#include <string>
#include <vector>

#include "runner/app/case_file.hpp"
#include "runner/run/runner.hpp"
#include "tests/case_text.hpp"
#include "tests/messages.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(quantities)

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;
using Sort = Quantity::Sort;

namespace {

const std::string bars = head("t", "cross-code") + R"toml([[bar]]
length = 1.0
velocity = 1.0
[[bar]]
length = 1.0
velocity = -1.0
[material]
model = "elastic"
E = 1e4
rho = 1.0
[supports]
left = "free"
right = "free"
[model]
displacements = "finite"
features = ["contact", "convection", "elastic"]
[exact]
solution = "impact"
[axes]
method = ["fem", "mpm-musl"]
cells = [10]
courant = [0.5]
[sample]
times = { unit = "L/c", from = "contact", at = [0.5, 3.0] }
probes = [{ id = "middle", field = "stress", at = { value = 0.5, unit = "L" } }]
)toml" + gate("books", "invariant", "energy.closure", "max = 1e-9\n");

const std::string elastic_plate = head("t", "cross-code") + plate("1.0", "0.5") + elastic("1e4", "0.25", "1.0") +
                                  supports("roller", "roller", "roller", "roller") + R"toml([model]
features = ["elastic"]
[exact]
solution = "p-wave"
mode = 1
amplitude = 1e-3
)toml" + axes({"fem", "mpm-usl"}, "4", "0.3") +
                                  R"toml([sample]
times = { unit = "s", at = [0.01] }
probes = [{ id = "middle", reads = "displacement-x", at = [0.5, 0.25] }]
)toml" + gate("books", "invariant", "energy.closure", "max = 1e-9\n");

Case parsed(const std::string& text) { return parse_case(text, "t.toml"); }

}  // namespace

BOOST_AUTO_TEST_CASE(a_name_stands_once_and_tells_its_unit) {
  std::set<std::string> names;
  for (const Quantity& row : runner::quantities()) BOOST_TEST(names.insert(row.name).second, row.name);
  const Case c = parsed(bars), p = parsed(elastic_plate);
  BOOST_TEST(find_quantity("contact.duration", c)->unit == "s");
  BOOST_TEST(find_quantity("stress.L2", c)->unit == "");
  BOOST_TEST((find_quantity("probe.middle", c) == find_quantity("probe.middle", p)));
  BOOST_TEST(!find_quantity("probe.other", c));
  BOOST_TEST(!find_quantity("probe.ID", c));
  // Each scene has its own.
  BOOST_TEST((!find_quantity("contact.begin", p) && !find_quantity("area.error", c)));
  BOOST_TEST((find_quantity("area.error", p) && !find_quantity("failure.speed", p)));
  BOOST_TEST((quantity_names(c, {Sort::limit}) == Names{"critical_courant", "stable"}));
  BOOST_TEST((quantity_names(p, {Sort::probe, Sort::history}) == Names{"probe.middle"}));
}

// What a run measures a gate can name, but for what is predicted of it and what is shown in a table alone.
BOOST_AUTO_TEST_CASE(what_runs_make_stands_in_the_table) {
  for (const std::string& text : {bars, elastic_plate}) {
    const Case c = parsed(text);
    std::set<std::string> made;
    const auto results = run_cases({c}, {});
    for (const reports::Run& run : results[0].runs)
      for (const auto& [name, value] : run.measures) made.insert(name);
    BOOST_TEST(made.contains("energy.closure"));
    BOOST_TEST(made.contains("contact.duration.error") == !c.plate.has_value());
    BOOST_TEST(made.contains("area.error") == c.plate.has_value());
    for (const std::string& name : made)
      BOOST_TEST((find_quantity(name, c) || name.ends_with(".predicted") || name == "energy.dissipated"), name);
  }
}

BOOST_AUTO_TEST_CASE(what_the_books_make_needs_them) {
  for (const Quantity& row : runner::quantities())
    if (row.from_books) BOOST_TEST(row.of_books, row.name);
  LedgerSums sums;
  sums.held = 4;
  sums.taken = 1;
  sums.momentum = 3;
  sums.kinetic = 2;
  const Case c = parsed(bars);
  BOOST_TEST(find_quantity("energy.drift", c)->from_books(sums, 1) == 0.25);
  BOOST_TEST(find_quantity("momentum.drift", c)->from_books(sums, 4) == 0.75);  // √(2·4·2) = 4
  BOOST_TEST(find_quantity("energy.excess", c)->from_books(sums, 1) == 0);      // of nothing that was put in
}

BOOST_AUTO_TEST_CASE(what_a_case_lacks_is_told) {
  const auto refused = [](const std::string& text, const std::string& kind, const std::string& quantity,
                          const std::vector<std::string>& parts) {
    const std::string said = message_of<InputError>([&] { parsed(text + gate("other", kind, quantity, "max = 1\n")); });
    BOOST_TEST(holds_all(said, parts), said);
  };
  refused(replaced(bars, "[sample]", "[run]\nledger = false\n[sample]"), "invariant", "energy.drift",
          {"found \"energy.drift\" with run.ledger = false; allowed: with the ledger, run.ledger = true"});
  refused(bars, "exact", "plastic.work",
          {"found \"plastic.work\" of elastic bars; allowed: with a bar of model = \"hardening\""});
  refused(elastic_plate, "invariant", "bits.undamaged", {"found \"bits.undamaged\" without damage; allowed: with it"});
  refused(elastic_plate, "invariant", "impact.left-over", {"without a flyer"});
  refused(elastic_plate, "exact", "concentration.L2", {"where [exact] does not give it"});
  refused(bars, "invariant", "energy.drit", {"did you mean \"energy.drift\"?"});
}

BOOST_AUTO_TEST_SUITE_END()
