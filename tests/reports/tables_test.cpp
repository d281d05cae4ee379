// Convergence tables against numbers worked out by hand.
#include "reports/tables.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(tables)

namespace {

namespace tt = boost::test_tools;
using namespace diptych::reports;
using diptych::tests::holds;
using diptych::tests::lines;

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double inf = std::numeric_limits<double>::infinity();

/// Stress error 0.5 h² in L1, h in L2 and 0.2 in L∞; the displacement grows as h shrinks.
Run run(int cells) {
  Run run;
  run.case_id = "bar";
  run.method = "fem";
  run.work_unit = "element-steps";
  run.cells = cells;
  run.courant_asked = 0.5;
  run.courant = 0.49875;
  run.status = "completed";
  run.cell_size = 1.0 / cells;
  run.unknowns = cells;
  run.steps = 2 * cells;
  run.element_steps = 2L * cells * cells;
  run.node_steps = 2L * cells * (cells + 1);
  run.bytes = 1000;
  run.wall_seconds = 0.25;
  const double h = run.cell_size;
  FieldError stress{"stress", 0.5, 2.0, 0.5 * h * h, h, 0.2, {}, 1.25 * h, {}};
  FieldError displacement{"displacement", 0.5, 1.0, 1 / h, 1 / h, 1 / h, {}, {}, {}};
  run.samples.push_back({0.5, 0.5, {stress, displacement}, {}, {}, {}});
  return run;
}

Case example() {
  Case data;
  data.id = "bar";
  data.title = "a bar, \"stepped\"";
  data.time_unit = "L/c";
  data.units = "SI";
  data.runs = {run(20), run(10), run(40)};  // not in order of the mesh
  return data;
}

std::size_t length(const std::string& text) {  // in code points
  std::size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  return count;
}

/// First row for so many cells in the table whose title starts with `title`.
std::string row(const std::string& table, const std::string& title, const std::string& cells) {
  bool inside = false;
  for (const std::string& line : lines(table)) {
    if (line.starts_with("  " + title)) inside = true;
    std::istringstream in(line);
    std::string first;
    if (inside && in >> first && first == cells) return line;
  }
  return "";
}

std::vector<std::string> words(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> found;
  for (std::string word; in >> word;) found.push_back(word);
  return found;
}

/// Fields of one CSV record without quoted commas.
std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> found(1);
  for (const char c : line)
    if (c == ',')
      found.emplace_back();
    else
      found.back() += c;
  return found;
}

}  // namespace

BOOST_AUTO_TEST_CASE(fit_of_exact_powers) {
  const Fit second = fit_order({0.1, 0.05, 0.025}, {3e-2, 7.5e-3, 1.875e-3});
  BOOST_TEST(second.order == 2.0, tt::tolerance(1e-12));
  BOOST_TEST(second.standard_error < 1e-12);
  BOOST_TEST(second.levels == 3);
  const Fit growing = fit_order({0.1, 0.05, 0.025}, {1.0, 2.0, 4.0});
  BOOST_TEST(growing.order == -1.0, tt::tolerance(1e-12));  // the sign says that it diverges
}

BOOST_AUTO_TEST_CASE(fit_by_hand) {
  // ln h = 0, 1, 2 and ln e = 0, 2, 1: slope 1/2, residuals -1/2, 1, -1/2, squares 3/2, Sxx 2, error √(1.5/1/2).
  const Fit fit = fit_order({1.0, std::exp(1.0), std::exp(2.0)}, {1.0, std::exp(2.0), std::exp(1.0)});
  BOOST_TEST(fit.order == 0.5, tt::tolerance(1e-12));
  BOOST_TEST(fit.standard_error == std::sqrt(0.75), tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(fit_of_two_levels_has_no_spread) {
  const Fit fit = fit_order({0.2, 0.1}, {0.4, 0.2});
  BOOST_TEST(fit.order == 1.0, tt::tolerance(1e-12));
  BOOST_TEST(std::isnan(fit.standard_error));
}

BOOST_AUTO_TEST_CASE(fit_refuses_what_has_no_slope) {
  BOOST_CHECK_THROW(fit_order({}, {}), std::invalid_argument);
  BOOST_CHECK_THROW(fit_order({0.1}, {0.1}), std::invalid_argument);
  BOOST_CHECK_THROW(fit_order({0.1, 0.1}, {0.1, 0.2}), std::invalid_argument);
  BOOST_CHECK_THROW(fit_order({0.2, 0.1}, {0.1}), std::invalid_argument);
  BOOST_CHECK_THROW(fit_order({0.2, 0.1}, {0.1, 0.0}), std::invalid_argument);
  BOOST_CHECK_THROW(fit_order({0.2, 0.1}, {0.1, not_a_number}), std::invalid_argument);
  BOOST_CHECK_THROW(fit_order({0.2, 0.1}, {inf, 0.1}), std::invalid_argument);
  BOOST_CHECK_THROW(fit_order({0.2, -0.1}, {0.1, 0.1}), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(text_shows_orders_predictions_and_scale) {
  const std::string table = text_table(example());
  BOOST_TEST_INFO(table);
  // cells, h, t, L1, order, L2, order, predicted, ratio, Linf, order
  const auto coarse = words(row(table, "stress at t = 0.5 L/c", "10"));
  const auto fine = words(row(table, "stress at t = 0.5 L/c", "20"));
  BOOST_TEST_REQUIRE(coarse.size() == 11U);
  BOOST_TEST_REQUIRE(fine.size() == 11U);
  BOOST_TEST(coarse[3] == "5.000e-03");
  BOOST_TEST(coarse[4] == "-");
  BOOST_TEST(fine[3] == "1.250e-03");
  BOOST_TEST(fine[4] == "2.000");
  BOOST_TEST(fine[6] == "1.000");
  BOOST_TEST(fine[7] == "6.250e-02");
  BOOST_TEST(fine[8] == "0.800");
  BOOST_TEST(fine[10] == "0.000");
  BOOST_TEST(words(row(table, "displacement at t", "20"))[4] == "-1.000");
  BOOST_TEST(holds(table, "least-squares order:  L1 2.000 ± "));
  BOOST_TEST(holds(table, "errors divided by 2 Pa"));
  BOOST_TEST(holds(table, "bar: a bar, \"stepped\""));
  BOOST_TEST(words(row(table, "Cost", "40"))[5] == "3200");                                     // element-steps
  BOOST_TEST(table.find(row(table, "stress", "10")) < table.find(row(table, "stress", "20")));  // coarse to fine
  BOOST_TEST(table.find(row(table, "stress", "20")) < table.find(row(table, "stress", "40")));
}

BOOST_AUTO_TEST_CASE(text_stays_in_the_page) {
  Case data = example();
  for (Run& r : data.runs) {
    r.particles = "0.2113248654051871, 0.7886751345948129";
    r.courant_asked = 0.70710678118654757;
    r.cell_size /= 3;
    for (FieldError& e : r.samples[0].errors) {
      e.time = 0.4998749999 / r.cells;
      e.predicted_l1 = e.predicted_l2 = e.predicted_linf = 1.23456e-5;
    }
  }
  data.runs[0].status = "unstable";
  for (int i = 0; i < 60; ++i) data.runs[0].message += "long words ";
  for (const std::string& line : lines(text_table(data))) BOOST_TEST(length(line) <= 150U, line);
}

BOOST_AUTO_TEST_CASE(nan_is_seen_and_never_zero) {
  Case data = example();
  data.runs[0].samples[0].errors[0].l1 = -not_a_number;
  data.runs[0].samples[0].errors[0].linf = inf;
  const std::string table = text_table(data);
  const auto middle = words(row(table, "stress", "20")), fine = words(row(table, "stress", "40"));
  BOOST_TEST(middle[3] == "nan");
  BOOST_TEST(middle[4] == "nan");
  BOOST_TEST(middle[9] == "inf");
  BOOST_TEST(fine[4] == "nan");
  BOOST_TEST(fine[6] == "1.000");
  BOOST_TEST(holds(table, "L1 -  L2 1.000"));  // no fit through a NaN
  BOOST_TEST(holds(csv_table(data), ",nan,nan,"));
  BOOST_TEST(holds(latex_table(data), "nan & nan"));
}

BOOST_AUTO_TEST_CASE(zero_error_has_no_order) {
  Case data = example();
  for (Run& r : data.runs) r.samples[0].errors[0].l1 = 0;
  const std::string table = text_table(data);
  BOOST_TEST(words(row(table, "stress", "20"))[3] == "0.000e+00");
  BOOST_TEST(words(row(table, "stress", "20"))[4] == "-");
  BOOST_TEST(holds(table, "L1 -  L2 1.000"));
}

BOOST_AUTO_TEST_CASE(runs_without_numbers_say_why) {
  Case data = example();
  data.runs[1].status = "refused";
  data.runs[1].message = "time step 0.2 s above the limit 0.1 s";
  data.runs[2].invalid = "no exact solution at t = 0.5";
  data.runs.push_back(run(80));
  data.runs.push_back(run(160));
  data.runs.back().samples.clear();
  const std::string table = text_table(data);
  BOOST_TEST(holds(row(table, "stress", "10"), "refused: time step 0.2 s above the limit 0.1 s"));
  BOOST_TEST(holds(row(table, "Cost", "10"), "refused: time step"));
  BOOST_TEST(holds(row(table, "stress", "40"), "invalid: no exact solution"));
  BOOST_TEST(words(row(table, "stress", "80"))[4] == "-");  // the row above has no numbers
  BOOST_TEST(holds(row(table, "stress", "160"), "no sample"));
  BOOST_TEST(holds(table, "(2 of 5 runs)"));
  BOOST_TEST(holds(table, "± n/a"));
  const std::string csv = csv_table(data);
  BOOST_TEST(holds(csv, "refused,time step 0.2 s above the limit 0.1 s,,,,"));
  BOOST_TEST(holds(csv, "invalid,no exact solution at t = 0.5,,,,"));
  for (Run& r : data.runs) r.status = "cancelled";
  BOOST_TEST(holds(text_table(data), "cancelled"));
}

BOOST_AUTO_TEST_CASE(groups_and_own_time_levels) {
  Case data = example();
  for (int cells : {10, 20}) {
    Run r = run(cells);
    r.method = "mpm-usf";
    r.particles = "[0.5]";
    r.work_unit = "particle-steps";
    r.element_steps = 0;
    r.particle_steps = 77;
    r.samples[0].errors[0].time = 0.5 - 0.25 / cells;
    data.runs.push_back(r);
  }
  const std::string table = text_table(data);
  BOOST_TEST(holds(table, "== fem, Courant number 0.5 asked =="));
  BOOST_TEST(holds(table, "== mpm-usf, particles at [0.5] in the cell, Courant number 0.5 asked =="));
  BOOST_TEST(holds(table, ", stress at its own level 0.475 to 0.4875;"));
  BOOST_TEST(holds(table, "particle-steps"));
}

// Runs with another value of a swept parameter are no refinement of each other.
BOOST_AUTO_TEST_CASE(swept_parameters_have_tables_of_their_own) {
  Case data = example();
  for (Run& r : data.runs) r.parameters = "v0=1";
  for (int cells : {10, 20}) {
    Run r = run(cells);
    r.parameters = "v0=2";
    for (FieldError& e : r.samples[0].errors) e.l1 *= 3;
    data.runs.push_back(r);
  }
  const std::string table = text_table(data);
  const std::string heading = "== fem, v0=1, Courant number 0.5 asked ==",
                    other = "== fem, v0=2, Courant number 0.5 asked ==";
  BOOST_REQUIRE(holds(table, heading));
  BOOST_REQUIRE(holds(table, other));
  BOOST_TEST(words(row(table, "stress", "20"))[4] == "2.000");
  BOOST_TEST(words(row(table.substr(table.find(other)), "stress", "20"))[4] == "2.000");
  const auto rows = lines(csv_table(data));
  BOOST_TEST_REQUIRE(rows.size() == 11U);
  BOOST_TEST(cells(rows[1])[3] == "v0=1");
  BOOST_TEST(cells(rows[10])[3] == "v0=2");
}

BOOST_AUTO_TEST_CASE(every_entry_of_the_ledger_has_a_column) {
  Run r = run(10);
  r.ledger = {{0.5, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, {1.5, 0.1 + 0.2, 0, 0, 0, 0, 0, 0, 0, 0, -1}};
  const auto rows = lines(ledger_csv(r));
  BOOST_TEST_REQUIRE(rows.size() == 3U);
  BOOST_TEST(rows[0] == "time,kinetic,strain,dissipated,viscous,contact,scheme,work,lost,momentum,impulse");
  BOOST_TEST(rows[1] == "0.5,1,2,3,4,5,6,7,8,9,10");
  BOOST_TEST(rows[2] == "1.5,0.30000000000000004,0,0,0,0,0,0,0,0,-1");
}

BOOST_AUTO_TEST_CASE(csv_is_long_and_exact) {
  Case data = example();
  data.runs[0].samples[0].errors[0].l1 = 0.1 + 0.2;
  data.runs[0].message = "said \"a, b\"";
  const auto rows = lines(csv_table(data));
  BOOST_TEST_REQUIRE(rows.size() == 7U);  // header, 3 runs × 2 fields
  const auto head = cells(rows[0]), first = cells(rows[1]);
  BOOST_TEST(head.size() == first.size());
  BOOST_TEST(head[3] == "parameters");
  BOOST_TEST(first[3].empty());
  BOOST_TEST(head[5] == "h [m]");
  BOOST_TEST(holds(rows[0], "time asked [L/c],time reached [L/c]"));
  BOOST_TEST(holds(rows[3], "\"said \"\"a, b\"\"\""));
  BOOST_TEST(holds(rows[3], "0.30000000000000004"));
  std::size_t l2_order = 0;
  while (head[l2_order] != "L2 order [-]") ++l2_order;
  BOOST_TEST(first[l2_order].empty());
  BOOST_TEST(std::stod(cells(rows[5])[l2_order]) == 1.0, tt::tolerance(1e-12));
  BOOST_TEST(cells(rows[5])[l2_order + 2] == "0.8");
}

BOOST_AUTO_TEST_CASE(latex_escapes) {
  Case data = example();
  data.id = "bar_1";
  data.title = "50 % of σ & {more} #1 \\ a^b ~ $x 漢";
  const std::string table = latex_table(data);
  BOOST_TEST(holds(table, R"(bar\_1: 50 \% of $\sigma$ \& \{more\} \#1 \textbackslash{} a\textasciicircum{}b)"));
  BOOST_TEST(holds(table, R"(\textasciitilde{} \$x [U+6F22])"));
  BOOST_TEST(holds(table, "\\toprule"));
  BOOST_TEST(holds(table, "\\bottomrule"));
  BOOST_TEST(holds(table, "1.250e$-$03 & 2.000"));
}

BOOST_AUTO_TEST_CASE(labels_verdicts_and_headroom) {
  Run r = run(200);
  BOOST_TEST(r.label() == "fem N=200 C=0.5");
  r.method = "mpm-musl";
  r.particles = "[0.25, 0.75]";
  BOOST_TEST(r.label() == "mpm-musl N=200 C=0.5 ppc=2");
  r.particles = "0.3";
  BOOST_TEST(r.label() == "mpm-musl N=200 C=0.5 ppc=1@0.3");
  r.parameters = "v0=0.1";
  BOOST_TEST(r.label() == "mpm-musl N=200 C=0.5 ppc=1@0.3 v0=0.1");
  r.particles = "";
  r.method = "fem";
  BOOST_TEST(r.label() == "fem N=200 C=0.5 v0=0.1");
  BOOST_TEST(to_string(Verdict::unstable) == "UNSTABLE");

  const auto headroom = [](double judged, double low, double high, bool passed) {
    Gate gate;
    gate.checks = {{"other", 1, {}, 0, 2, 1, true}, {"this", judged, {}, low, high, judged, passed}};
    return gate.headroom();
  };
  BOOST_TEST(headroom(1.0, 0.0, 2.0, true) == 1.0);
  BOOST_TEST(headroom(1.5, 0.0, 2.0, true) == 0.5);
  BOOST_TEST(headroom(2.0, 0.0, 2.0, true) == 0.0);
  BOOST_TEST(headroom(3.0, 0.0, 2.0, false) == -1.0);
  BOOST_TEST(headroom(not_a_number, 0.0, 2.0, false) < 0.0);
  BOOST_TEST(headroom(1.0, 0.0, 2.0, false) < 0.0);  // failed for another reason
  BOOST_TEST(headroom(0.0, 0.0, 0.0, true) == 0.0);
  BOOST_TEST(headroom(1e-9, 0.0, 0.0, false) < 0.0);
  BOOST_TEST(headroom(1.0, -inf, 4.0, true) == 0.75);
  BOOST_TEST(std::isnan(Gate{}.headroom()));
}

BOOST_AUTO_TEST_SUITE_END()
