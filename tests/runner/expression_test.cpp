#include "runner/input/expression.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <locale>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "runner/app/case_file.hpp"
#include "tests/messages.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(expression)

using diptych::runner::Expression;
using diptych::runner::InputError;
using namespace diptych::tests;

namespace {

const std::map<std::string, double> constants{{"L", 2}, {"E", 1e4}, {"pi", std::acos(-1.0)}, {"A", 0.1}};

double value(const std::string& formula) { return Expression(formula, {"x", "t"}, constants)(3, 5); }

std::string refused(const std::string& formula) {
  return message_of<InputError>([&] { Expression(formula, {"x", "t"}, constants); });
}

void wrong(const std::string& formula, const std::vector<std::string>& parts) {
  const std::string message = refused(formula);
  BOOST_TEST(!message.empty(), "accepted: " << formula);
  for (const std::string& part : parts) BOOST_TEST(holds(message, part), "wanted " << part << " in: " << message);
}

}  // namespace

BOOST_AUTO_TEST_CASE(values) {
  BOOST_TEST(value("x") == 3);
  BOOST_TEST(value("t") == 5);
  BOOST_TEST(value("A*x + E") == 0.1 * 3 + 1e4);
  BOOST_TEST(value("1/2") == 0.5);  // no integer division
  BOOST_TEST(value("7/2*2") == 7);
  BOOST_TEST(value("-2^2") == -4);
  BOOST_TEST(value("2^3^2") == 512);
  BOOST_TEST(value(".5 + 1.e-1") == 0.6);
  BOOST_TEST(value("x > t ? 1 : 2") == 2);
  BOOST_TEST(value("x == 3 && x <= 3 && x >= 3 && x != 4") == 1);
  BOOST_TEST(value("ln(_e) + log(_e) + log10(100)") == 4);
  BOOST_TEST(value("min(x, t, 1)") == 1);
  BOOST_TEST(value("atan2(1, 0)*2/pi") == 1);
  BOOST_TEST(value("sin(pi*x/L)") == std::sin(std::acos(-1.0) * 3 / 2));
}

BOOST_AUTO_TEST_CASE(one_variable) {
  const Expression f("t^2", {"t"}, {});
  BOOST_TEST(f(3) == 9);
  BOOST_CHECK_THROW(f(3, 4), std::logic_error);
  BOOST_CHECK_THROW(Expression("x", {"x", "t"}, {})(1), std::logic_error);
  BOOST_CHECK_THROW(Expression("x", {"t"}, {}), InputError);
}

BOOST_AUTO_TEST_CASE(mistakes) {
  wrong("", {"empty expression", "x, t"});
  wrong(" \t\n", {"empty expression"});
  wrong("x=3", {"\"x=3\"", "assignment", "position 2", "=="});
  wrong("A = 3", {"assignment", "position 3"});
  wrong("x += 3", {"assignment"});
  wrong("x === 3", {"assignment"});
  wrong("1,2", {"2 values", "one value"});
  wrong("x + 1,5", {"2 values", "decimal point"});
  wrong("min(1;2)", {";"});
  wrong("x +", {"end of expression"});
  wrong("sin(x", {"parenthesis"});
  wrong("x y", {"\"x y\""});
  wrong("2x", {"Unexpected variable", "position 2"});
  wrong("1 + lenght", {"unknown name \"lenght\"", "position 5", "A, E, L, pi"});
  wrong("cosine(x)", {"unknown name \"cosine\"", "allowed"});
  wrong("Sin(x)", {"unknown name \"Sin\"", "did you mean \"sin\"?"});
  wrong("a*x", {"unknown name \"a\"", "did you mean \"A\"?"});
  wrong("sin + 1", {"function \"sin\"", "parentheses"});
  wrong("sin()", {"Too few"});
  wrong("sin(1,2)", {"Too many"});
  wrong("\"abc\"", {"\"abc\""});
  wrong("1e400", {"\"1e400\"", "double"});
  wrong("1/0", {"infinite", "finite"});
  wrong("sqrt(-1)", {"NaN", "finite"});
  wrong("\xce\xbb*x", {"position 1"});
  wrong(std::string("x\0+1", 4), {"zero byte"});
  wrong(std::string(100000, '('), {});
}

BOOST_AUTO_TEST_CASE(copies_are_independent) {
  const Expression first("A*x + t", {"x", "t"}, constants);
  Expression second(first);
  BOOST_TEST(first(1, 2) == 2.1);
  BOOST_TEST(second(10, 20) == 21);
  BOOST_TEST(first(1, 2) == 2.1);
  Expression third("x", {"x", "t"}, {});
  third = second;
  BOOST_TEST(third(20, 1) == 3);
  const Expression moved(std::move(third));
  BOOST_TEST(moved(20, 1) == 3);
  third = first;
  BOOST_TEST(third(10, 1) == 2);

  const auto sum = [](Expression f) {
    double total = 0;
    for (int i = 0; i < 20000; ++i) total += f(i, 0.5 * i);
    return total;
  };
  std::vector<double> totals(4);
  std::vector<std::thread> threads;
  for (double& total : totals) threads.emplace_back([&total, sum, f = first] { total = sum(f); });
  for (std::thread& thread : threads) thread.join();
  for (const double total : totals) BOOST_TEST(total == sum(first));
}

/// A program that speaks German must read the same numbers.
BOOST_AUTO_TEST_CASE(locale_has_no_say) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  BOOST_TEST(value("1.5 + min(1000.25, 2e3)") == 1001.75);
  wrong("1,5", {"2 values"});
  std::locale::global(before);
}

BOOST_AUTO_TEST_CASE(functions) {
  const auto& names = diptych::runner::function_names();
  for (const char* name : {"sin", "cos", "exp", "sqrt", "ln"})
    BOOST_TEST((std::find(names.begin(), names.end(), name) != names.end()));
}

BOOST_AUTO_TEST_CASE(broken_formulas_never_crash) {
  std::mt19937 random(7);
  const std::vector<std::string> scraps{"x",  "t",  "A",  "sin(", "(", ")",   "+",    "-",    "*",  "/",
                                        "^",  "?",  ":",  ",",    "1", ".5",  "min(", "sum(", "\"", "!",
                                        "&&", "==", "<=", "if",   " ", "1e3", ";",    "\\"};
  for (int i = 0; i < 20000; ++i) {
    std::string formula;
    for (auto n = 1 + random() % 9; n > 0; --n) formula += scraps[random() % scraps.size()];
    try {
      const Expression f(formula, {"x", "t"}, constants);
      BOOST_TEST_CONTEXT(formula) f(0.5, 2);
    } catch (const InputError& error) {
      BOOST_TEST(std::string(error.what()).size() > formula.size(), error.what());
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
