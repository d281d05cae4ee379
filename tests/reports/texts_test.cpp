// Any text into any format: what was written is read back by a parser of it, and nothing of it is more than text.
#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "reports/csv.hpp"
#include "reports/figure.hpp"
#include "reports/files.hpp"
#include "reports/page.hpp"
#include "reports/tables.hpp"
#include "reports/text.hpp"
#include "reports/vtu.hpp"
#include "runner/panel.hpp"
#include "tests/drawn.hpp"
#include "tests/folder.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(texts)

namespace {

namespace data = boost::unit_test::data;
using namespace diptych::reports;
using diptych::tests::contents;
using diptych::tests::drawn;
using diptych::tests::Folder;
using diptych::tests::holds;
using diptych::tests::replaced;

/// A text, and what of it can be shown.
struct Text {
  std::string written, shown;
};
std::ostream& operator<<(std::ostream& out, const Text& text) { return out << text.shown; }

const std::vector<Text> all{
    {"plain", "plain"},
    {"σ–ε at 45°, \U0001F600", "σ–ε at 45°, \U0001F600"},
    {"'tis a 'bar'", "'tis a 'bar'"},
    {"''", "''"},
    {"a '' b ''' c''''", "a '' b ''' c''''"},
    {"x'; set output 'y", "x'; set output 'y"},
    {"a \"b\" \\n \\ `date` $x @y %g #z {q}", "a \"b\" \\n \\ `date` $x @y %g #z {q}"},
    {"<b> & &amp; </b> <!-- -->", "<b> & &amp; </b> <!-- -->"},
    {"one ]]> two ]]]>> <![CDATA[", "one ]]> two ]]]>> <![CDATA["},
    {"=1+1, \"two\"", "=1+1, \"two\""},
    {"bell \a, \x1b[31mred\x1b[0m, \x7f", "bell ?, ?[31mred?[0m, ?"},
    {std::string("zero \0 byte", 11), "zero ? byte"},
    {"C1 \u009b31m \u0085", "C1 ?31m ?"},
    {"not characters \ufffe \uffff \U0001fffe", "not characters ? ? ?"},
    {"no UTF-8 \xff \xc3 \xed\xa0\x80 \xc0\xaf \xf5\x80\x80\x80 \xe2\x82", "no UTF-8 ? ? ? ? ? ?"},
};

/// Without the spaces that stand for broken lines, and those of no width that keep a picture's text whole.
std::string squeezed(std::string text) {
  for (const std::string gone : {" ", "\n", "\u200b"})
    for (std::size_t at = 0; (at = text.find(gone)) != std::string::npos;) text.erase(at, gone.size());
  return text;
}

/// What an XML parser takes that keeps to the letter of the standard, which pugixml does not.
void expect_strict(const std::string& xml) {
  BOOST_CHECK_NO_THROW(nlohmann::json(xml).dump());  // throws where it is no UTF-8
  for (const char* no : {"\a", "\x1b", "\x7f", "\u009b", "\u0085", "\ufffe", "\uffff"}) BOOST_TEST(!holds(xml, no));
  BOOST_TEST(xml.find('\0') == std::string::npos);
  std::string rest = xml;
  for (std::size_t at = 0; (at = rest.find("<![CDATA[")) != std::string::npos;) {
    const std::size_t end = rest.find("]]>", at);
    BOOST_TEST_REQUIRE(end != std::string::npos);
    rest.erase(at, end + 3 - at);
  }
  // In the value of an attribute it is like any other text.
  for (std::size_t at = 0; (at = rest.find("=\"", at)) != std::string::npos;) {
    const std::size_t end = rest.find('"', at + 2);
    BOOST_TEST_REQUIRE(end != std::string::npos);
    rest.erase(at, end + 1 - at);
  }
  BOOST_TEST(!holds(rest, "]]>"));
}

void parse(const std::string& xml, pugi::xml_document& document) {
  expect_strict(xml);
  const pugi::xml_parse_result result = document.load_string(xml.c_str(), pugi::parse_default | pugi::parse_doctype);
  BOOST_TEST_REQUIRE(static_cast<bool>(result), result.description());
}

std::string text_of(const pugi::xml_node& node) {
  std::string out = node.value();
  for (const pugi::xml_node& child : node.children()) out += text_of(child);
  return out;
}

Case case_of(const std::string& text) {
  Case one;
  one.id = "bar";
  one.path = text;
  one.title = text;
  one.time_unit = "s";
  one.units = "SI";
  Run run;
  run.case_id = "bar";
  run.method = "fem";
  run.cells = 10;
  run.status = "unstable";
  run.message = text;
  one.runs = {run};
  Gate gate;
  gate.case_id = "bar";
  gate.id = gate.message = gate.reason = text;
  gate.verdict = Verdict::fail;
  one.gates = {gate};
  return one;
}

/// The fields of the records of RFC 4180.
std::vector<std::vector<std::string>> records(const std::string& csv) {
  std::vector<std::vector<std::string>> found{{""}};
  bool quoted = false;
  for (std::size_t i = 0; i < csv.size(); ++i) {
    if (quoted && csv[i] == '"' && csv.substr(i, 2) == "\"\"")
      found.back().back() += csv[i++];
    else if (csv[i] == '"')
      quoted = !quoted;
    else if (!quoted && csv[i] == ',')
      found.back().emplace_back();
    else if (!quoted && csv[i] == '\n')
      found.push_back({""});
    else
      found.back().back() += csv[i];
  }
  return found;
}

bool any_holds(const std::vector<std::vector<std::string>>& all_records, const std::string& field) {
  for (const auto& record : all_records)
    for (const std::string& one : record)
      if (one == field) return true;
  return false;
}

}  // namespace

BOOST_DATA_TEST_CASE(shown_is_what_can_be_shown, data::make(all), text) {
  BOOST_TEST(printable(text.written) == text.shown);
  BOOST_TEST(printable(text.shown) == text.shown);
  BOOST_TEST(printable("a\nb\tc") == "a\nb\tc");
}

BOOST_DATA_TEST_CASE(terminal, data::make(all), text) {
  const std::string table = text_table(case_of(text.written));
  BOOST_TEST(holds(table, "bar: " + text.shown + "\n"));
  expect_strict(squeezed(replaced(replaced(table, text.shown, ""), text.shown, "")));
}

BOOST_DATA_TEST_CASE(csv, data::make(all), text) {
  BOOST_TEST(any_holds(records(csv_table(case_of(text.written))), text.shown));
  BOOST_TEST(csv_note("title", "a\n" + text.written) == "# title: a " + text.shown + "\n");
}

BOOST_DATA_TEST_CASE(json_lines, data::make(all), text) {
  const std::string out = results_jsonl({case_of(text.written)}, {});
  const std::vector<std::string> lines = diptych::tests::lines(out);
  BOOST_TEST_REQUIRE(lines.size() == 2U);
  BOOST_TEST(!holds(out, "\x1b"));
  const auto run = nlohmann::json::parse(lines[0]), gate = nlohmann::json::parse(lines[1]);
  // JSON can escape what XML cannot hold: all that is UTF-8 comes back as it was.
  if (!holds(text.written, "\xff")) {
    BOOST_TEST(run["message"].get<std::string>() == text.written);
    BOOST_TEST(gate["id"].get<std::string>() == text.written);
  }
}

BOOST_DATA_TEST_CASE(junit, data::make(all), text) {
  pugi::xml_document document;
  parse(junit_xml({case_of(text.written)}), document);
  const auto test = document.child("testsuites").child("testsuite").child("testcase");
  BOOST_TEST(test.attribute("name").value() == text.shown);
  BOOST_TEST(test.attribute("file").value() == text.shown);
  BOOST_TEST(test.child("failure").attribute("message").value() == text.shown);
  BOOST_TEST(holds(test.child("failure").text().get(), "reason: " + text.shown));
}

BOOST_DATA_TEST_CASE(page, data::make(all), text) {
  Page given;
  given.title = text.written;
  given.intro = {text.written};
  given.sections = {
      {.heading = text.written, .columns = {text.written}, .rows = {{text.written, "", {text.written}, ""}}}};
  pugi::xml_document document;
  parse(page_html(given), document);
  for (const char* place : {"//title", "//h1", "//main/p", "//h2", "//tbody//span", "//td"})
    BOOST_TEST(text_of(document.select_node(place).node()) == text.shown, place);
}

BOOST_DATA_TEST_CASE(vtu, data::make(all), text) {
  const Folder folder;
  write_vtu(folder.path / "a.vtu", {{0, 1}, {0, 0}, {}, 1}, {{text.written, {text.written}, {1, 2}, false}});
  pugi::xml_document document;
  parse(contents(folder.path / "a.vtu"), document);
  const auto array = document.select_node("//PointData/DataArray").node();
  BOOST_TEST(array.attribute("Name").value() == text.shown);
  BOOST_TEST(array.attribute("ComponentName0").value() == text.shown);
  write_pvd(folder.path / "a.pvd", {{0.5, text.written}});
  pugi::xml_document collection;
  parse(contents(folder.path / "a.pvd"), collection);
  BOOST_TEST(collection.select_node("//DataSet").node().attribute("file").value() == text.shown);
}

BOOST_DATA_TEST_CASE(picture, data::make(all), text) {
  const Folder folder;
  Figure figure;
  figure.looks = diptych::runner::looks();
  figure.id = "fig";
  figure.title = figure.x_label = figure.y_label = text.written;
  figure.notes = {text.written};
  figure.panels = {{text.written, {{text.written, "fem", {{0, 1}, {0, 1}}}}}};
  if (!drawn(figure, folder.path)) return;
  pugi::xml_document document;
  const std::string svg = contents(folder.path / "fig.svg");
  parse(svg, document);
  const std::string words = squeezed(text_of(document)), part = squeezed(text.shown);
  std::size_t found = 0;
  for (std::size_t at = 0; (at = words.find(part, at)) != std::string::npos; at += part.size()) ++found;
  BOOST_TEST(found >= 6U, words);  // title, note, both axes, panel, legend
  BOOST_TEST(any_holds(records(contents(folder.path / "fig.csv")), text.shown));
}

BOOST_AUTO_TEST_SUITE_END()
