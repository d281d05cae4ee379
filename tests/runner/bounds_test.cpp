// Input without a bound: its length, depth, number and magnitude are looked at before any work, and refused in words.
#include <sys/stat.h>

#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "reports/results.hpp"
#include "runner/app/case_file.hpp"
#include "runner/input/leaf.hpp"
#include "runner/input/messages.hpp"
#include "runner/input/toml_tree.hpp"
#include "runner/run/run_leaf.hpp"
#include "tests/case_text.hpp"
#include "tests/folder.hpp"
#include "tests/messages.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(bounds)

using namespace diptych::runner;
using namespace diptych::tests;

namespace {

const std::string plain = head("x", "robustness", "paper") + pulled_bar + axes({"fem"}, "10", "0.5") + sampled("0.5") +
                          gate("closed", "invariant", "energy.closure", "max = 1.0\n");

const std::string two_bars = head("x", "robustness", "paper") + R"toml([material]
model = "elastic"
E = 1e4
rho = 1.0
[parameters]
v0 = 1.0
[[bar]]
length = 1.0
velocity = "v0"
[[bar]]
gap = { value = 1.0, unit = "m" }
length = 1.0
velocity = "-v0"
[supports]
left = "free"
right = "free"
[model]
displacements = "finite"
features = ["contact", "convection", "elastic"]
)toml" + axes({"fem", "mpm-musl"}, "10", "0.5") +
                             sampled("0.5") + gate("closed", "invariant", "energy.closure", "max = 1.0\n");

std::string repeated(const std::string& part, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += part;
  return all;
}

std::string refusal(const std::string& text) {
  return message_of<InputError>([&] { parse_case(text, "x.toml"); });
}

void expect_refused(const std::string& text, const std::vector<std::string>& parts) {
  const std::string message = refusal(text);
  BOOST_TEST(holds_all(message, parts), message.substr(0, 1000));
  BOOST_TEST(message.size() < 2000U);
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_cases_without_what_is_too_much_are_read) {
  BOOST_TEST(refusal(plain) == "");
  BOOST_TEST(refusal(two_bars) == "");
}

BOOST_AUTO_TEST_CASE(keys_of_many_parts) {
  for (const int parts : {17, 18'000, 100'000}) {
    const std::string key = "a" + repeated(".a", parts - 1), quoted = "\"a\"" + repeated(" . 'a'", parts - 1);
    for (const std::string& line :
         {key + " = 1\n", "[" + key + "]\n", "[[" + quoted + "]]\n", "x = {" + key + " = 1}\n"})
      expect_refused(line + plain, {"x.toml:1:", "more than 16 parts", "allowed: at most 16"});
  }
  // Dots of numbers, texts and comments are none of keys.
  const std::string dots = repeated("0.5, ", 100), points = repeated("a.", 100);
  for (const std::string& line : {"# " + points, "x = [" + dots + "]", "x = \"" + points + "\\\"" + points + "\"",
                                  "x = '''\n" + points + "'\n'''", "x = \"\"\"" + points + "\"\n" + points + "\"\"\""})
    BOOST_TEST(!holds(refusal(plain + line + "\n"), "parts"), line);
}

BOOST_AUTO_TEST_CASE(values_within_values) {
  for (const int depth : {40, 300, 50'000}) {
    expect_refused("x = " + repeated("[", depth) + repeated("]", depth) + "\n" + plain, {"x.toml:1:", "at most 32"});
    expect_refused("x = " + repeated("{a=", depth) + "1" + repeated("}", depth) + "\n" + plain,
                   {"x.toml:1:", "at most 32"});
  }
}

BOOST_AUTO_TEST_CASE(many_entries_and_long_texts) {
  expect_refused("title = \"" + repeated("x", 20'000) + "\"\n", {"x.toml:1:9", "20000 bytes", "at most 10000"});
  expect_refused("x = [" + repeated("1,", 20'000) + "]\n", {"20000 entries", "at most 10000"});
  expect_refused(repeated("# comment\n", 200'000), {"2000000 bytes", "at most 1000000"});
  expect_refused(replaced(replaced(plain, "traction = 1.0",
                                   "traction = \"" + repeated("(", 4'000) + "t" + repeated(")", 4'000) + "\""),
                          "\"step\"", "\"expression\""),
                 {"exact.solution"});
}

BOOST_AUTO_TEST_CASE(more_runs_than_anyone_waits_for) {
  std::string values;
  for (int i = 1; i <= 101; ++i) values += (i > 1 ? ", " : "") + std::to_string(i);
  const std::string text = replaced(replaced(plain, "cells = [10]", "cells = [" + values + "]"), "courant = [0.5]",
                                    "courant = [" + values + "]");
  expect_refused(text, {"axes: found 10201 runs", "at most 10000"});
}

BOOST_AUTO_TEST_CASE(bars_too_far_apart_or_too_slow) {
  expect_refused(replaced(two_bars, "gap = { value = 1.0", "gap = { value = 1e30"),
                 {"bar: found bars and gaps of 1e+31 cells", "at most 1e+07"});
  const std::string tiny =
      replaced(replaced(two_bars, "length = 1.0", "length = 1e-300"), "length = 1.0", "length = 1e-300");
  expect_refused(tiny, {"bar: found bars and gaps of 1e+301 cells"});
  for (const char* slow : {"5e-324", "1e-300", "1e-11"})
    expect_refused(replaced(two_bars, "v0 = 1.0", std::string("v0 = ") + slow),
                   {"bar: found bars 1 and 2 that close in at", "1e-12 of the wave speed"});
  // Quickly one behind the other, the faces that they cross are many before the two are next to each other.
  const std::string behind = replaced(replaced(two_bars, "\"v0\"", "\"1 + 1e-9\""), "\"-v0\"", "\"1.0\"");
  expect_refused(behind, {"that close in at 1e-09", "1e-6 of what they move at"});
  BOOST_TEST(refusal(replaced(two_bars, "v0 = 1.0", "v0 = 1e-6")) == "");
}

BOOST_AUTO_TEST_CASE(what_is_no_file_of_text) {
  const Folder folder;
  const auto read = [&](const char* name) { return message_of<InputError>([&] { read_case(folder.path / name); }); };
  std::filesystem::create_directory(folder.path / "folder.toml");
  std::filesystem::create_symlink("/dev/zero", folder.path / "endless.toml");
  BOOST_TEST_REQUIRE(::mkfifo((folder.path / "pipe.toml").c_str(), 0600) == 0);
  std::ofstream(folder.path / "large.toml") << repeated(std::string(1000, '#') + "\n", 1001);
  BOOST_TEST(holds(read("folder.toml"), "it is a directory"));
  BOOST_TEST(holds(read("endless.toml"), "it is a device, a pipe or a socket"));
  BOOST_TEST(holds(read("pipe.toml"), "it is a device, a pipe or a socket"));
  BOOST_TEST(holds(read("large.toml"), "larger than 1000000 bytes"));
  BOOST_TEST(holds(read("none.toml"), "No such file"));
}

BOOST_AUTO_TEST_CASE(ids_that_are_no_names_of_files) {
  for (const std::string& bad : {std::string(".."), std::string("."), std::string(".x"), std::string("-x"),
                                 std::string("a/b"), std::string(81, 'a'), std::string(260, 'a')})
    for (const char* key : {"id = \"x\"", "id = \"closed\""})
      expect_refused(replaced(plain, key, "id = \"" + bad + "\""), {"id: found", "at most 80", "begins with a letter"});
  BOOST_TEST(refusal(replaced(plain, "id = \"x\"", "id = \"" + std::string(80, 'a') + "\"")) == "");
}

BOOST_AUTO_TEST_CASE(characters_that_cannot_be_shown) {
  for (const char* bad : {"\\u001b[31m", "\\u0000", "\\u0007", "\\u007f", "\\u009b", "\\uFFFE", "\\uFFFF", "\\r"}) {
    const std::string message = refusal(replaced(plain, "title = \"t\"", std::string("title = \"a ") + bad + "\""));
    BOOST_TEST(holds_all(message, {"x.toml:3:9: found \"a ", "a character that cannot be shown"}), message);
    BOOST_TEST(message.find_first_of("\x1b\a\x7f\r") == message.npos);
    const std::string key = refusal(std::string("\"a ") + bad + "\" = 1\n" + plain);
    BOOST_TEST(holds(key, "a character that cannot be shown"), key);
  }
  BOOST_TEST(refusal(replaced(plain, "title = \"t\"", "title = \"a\\n\\tb ε \\U0001F600\"")) == "");
  BOOST_TEST(refusal(replaced(plain, "title = \"t\"", "title = \"\"\"a\r\nb\"\"\"")) == "");
}

// Each run knows its place in the sweep by its labels, once looked for among all others.
BOOST_AUTO_TEST_CASE(leaves_are_found_by_the_labels_of_their_runs) {
  const Case c = parse_case(replaced(plain, "courant = [0.5]", "courant = [0.25, 0.5, 0.75]"), "x.toml");
  const Leaves by_label(c);
  for (const Leaf& leaf : leaves(c)) {
    const Leaf* found = by_label.of(describe(c, leaf));
    BOOST_TEST_REQUIRE(found != nullptr);
    BOOST_TEST((*found == leaf));
  }
  diptych::reports::Run other = describe(c, leaves(c)[0]);
  other.courant_asked = 0.3;
  BOOST_TEST(by_label.of(other) == nullptr);
}

BOOST_AUTO_TEST_CASE(every_run_stands_once_in_the_order_of_the_axes) {
  const std::string more = "[[axes]]\nmethod = [\"fem\"]\ncells = [10, 20]\ncourant = [0.5]\n";
  const Case c = parse_case(replaced(plain, "[axes]\n", "[[axes]]\n") + more, "x.toml");
  const std::vector<Leaf> all = leaves(c);
  BOOST_TEST_REQUIRE(all.size() == 2U);
  BOOST_TEST(all[0].cells == 10);
  BOOST_TEST(all[1].cells == 20);
}

BOOST_AUTO_TEST_SUITE_END()
