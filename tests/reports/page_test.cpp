// Pages of text, tables and pictures: well-formed, complete, and what they are given stays text.
#include "reports/page.hpp"

#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <pugixml.hpp>
#include <stdexcept>
#include <string>

BOOST_AUTO_TEST_SUITE(page)

namespace {

namespace fs = std::filesystem;
using namespace diptych::reports;

const std::string nasty = "ε_v < 0.01 & \"λ₁\" > 'x' ]]> <script>alert(1)</script> &amp;";

Page example() {
  Page page;
  page.title = "What each choice does: " + nasty;
  page.intro = {"First paragraph.", nasty};
  Page::Section& table = page.sections.emplace_back();
  table.columns = {"radius, FEM [m]", "radius, MPM [m]", "outcome"};
  table.rows = {{"reference",
                 "all choices as in the case",
                 {"0.61", "0.60", "completed"},
                 "figures/fig 13#a?.svg",
                 "FEM beside MPM",
                 true},
                {nasty, nasty, {"0", "", nasty}, "", ""},
                {"tracked rate", "", {"−0.7", "12 of 24", ""}, "fig2.svg"}};
  page.footer = {"commit 0123456789abcdef", nasty};
  return page;
}

/// Sections of every kind: a picture and a table, words alone, another table.
Page report() {
  Page page;
  page.title = "Report";
  page.intro = {"Opening."};
  page.sections = {{.heading = nasty,
                    .text = {"One.", nasty},
                    .first = "Quantity",
                    .columns = {"exact", nasty},
                    .rows = {{"HEL", "", {"5.95", "–"}, ""}, {"spall", nasty, {"1", "2"}, ""}},
                    .picture = "figures/fig 1#b.svg",
                    .caption = nasty},
                   {.text = {"Words alone."}},
                   {.heading = "Last", .columns = {"value"}, .picture = "fig2.svg"}};
  return page;
}

/// Parses the page as the XML it claims to be; entities and bad nesting would fail.
void parse(const std::string& text, pugi::xml_document& document) {
  const pugi::xml_parse_result result = document.load_string(text.c_str(), pugi::parse_default | pugi::parse_doctype);
  BOOST_TEST_REQUIRE(static_cast<bool>(result), result.description());
}

std::string text_of(const pugi::xml_node& node) {
  std::string out = node.value();
  for (const pugi::xml_node& child : node.children()) out += text_of(child);
  return out;
}

}  // namespace

BOOST_AUTO_TEST_CASE(page_holds_what_it_was_given) {
  const Page page = example();
  const Page::Section& section = page.sections[0];
  const std::string html = page_html(page);
  BOOST_TEST(html.starts_with("<!DOCTYPE html>\n"));  // or a browser falls back to its quirks
  pugi::xml_document document;
  parse(html, document);
  const pugi::xml_node body = document.child("html").child("body"), main = body.child("main");
  BOOST_TEST(text_of(main.child("h1")) == page.title);
  BOOST_TEST(text_of(document.child("html").child("head").child("title")) == page.title);
  std::vector<std::string> paragraphs;
  for (const pugi::xml_node& p : main.children("p")) paragraphs.push_back(text_of(p));
  BOOST_TEST(paragraphs == page.intro, boost::test_tools::per_element());

  const pugi::xml_node table = main.child("div").child("table"), head = table.child("thead").child("tr");
  std::vector<std::string> heads;
  for (const pugi::xml_node& th : head.children("th")) heads.push_back(text_of(th));
  const std::vector<std::string> expected{"Choice", section.columns[0], section.columns[1], section.columns[2],
                                          "Contour"};
  BOOST_TEST(heads == expected, boost::test_tools::per_element());

  std::size_t n = 0;
  for (const pugi::xml_node& row : table.child("tbody").children("tr")) {
    BOOST_TEST_REQUIRE(n < section.rows.size());
    const Page::Row& given = section.rows[n++];
    std::vector<std::string> cells;
    for (const pugi::xml_node& td : row.children("td")) cells.push_back(text_of(td));
    BOOST_TEST_REQUIRE(cells.size() == 4U);
    for (std::size_t i = 0; i < 3; ++i) BOOST_TEST(cells[i] == (given.values[i].empty() ? "–" : given.values[i]));
    const pugi::xml_node name = row.child("th").child("span");
    BOOST_TEST(name.child_value() == given.name);
    BOOST_TEST(text_of(name.next_sibling("span")) == given.description);
    BOOST_TEST((row.attribute("class").value() == std::string("reference")) == given.reference);
  }
  BOOST_TEST(n == 3U);
  std::vector<std::string> lines;
  for (const pugi::xml_node& p : body.child("footer").children("p")) lines.push_back(text_of(p));
  BOOST_TEST(lines == page.footer, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(pictures_are_links_with_words) {
  pugi::xml_document document;
  parse(page_html(example()), document);
  const auto pictures = document.select_nodes("//img");
  BOOST_TEST_REQUIRE(pictures.size() == 2U);
  const pugi::xml_node first = pictures[0].node(), second = pictures[1].node();
  BOOST_TEST(first.attribute("src").value() == "figures/fig%2013%23a%3F.svg");  // '#' and '?' would end the path
  BOOST_TEST(first.attribute("alt").value() == "FEM beside MPM");
  BOOST_TEST(first.parent().attribute("href").value() == first.attribute("src").value());
  BOOST_TEST(second.attribute("alt").value() == "Contour: tracked rate");
  // Without any picture there is no column for them.
  Page bare = example();
  for (Page::Row& row : bare.sections[0].rows) row.picture.clear();
  pugi::xml_document other;
  parse(page_html(bare), other);
  BOOST_TEST(other.select_nodes("//thead/tr/th").size() == 4U);
  BOOST_TEST(other.select_nodes("//tbody/tr[1]/td").size() == 3U);
}

BOOST_AUTO_TEST_CASE(readable_alone_as_html_and_as_xml) {
  for (const Page& page : {example(), report()}) {
    const std::string html = page_html(page);
    pugi::xml_document document;
    parse(html, document);
    BOOST_TEST(document.select_nodes("//script").empty());
    BOOST_TEST(document.select_nodes("//link").empty());
    // HTML takes a style as it is, XML reads entities: without any the two agree.
    const std::string start = "<style>", end = "</style>";
    const std::size_t from = html.find(start) + start.size();
    BOOST_TEST(html.substr(from, html.find(end) - from).find_first_of("<>&") == std::string::npos);
    // HTML reads <td/> or <p/> as an opening tag.
    for (const pugi::xpath_node& node : document.select_nodes("//*[not(node())]")) {
      const std::string name = node.node().name();
      BOOST_TEST((name == "meta" || name == "img"), name);
    }
  }
}

BOOST_AUTO_TEST_CASE(sections_follow_in_their_order) {
  const Page page = report();
  pugi::xml_document document;
  parse(page_html(page), document);
  std::vector<std::string> flow;
  const pugi::xml_node main = document.child("html").child("body").child("main");
  for (const pugi::xml_node& node : main.children()) {
    const std::string name = node.name();
    flow.push_back(name + (name == "p" || name == "h2" ? " " + text_of(node) : ""));
  }
  const std::vector<std::string> expected{"h1",  "p Opening.",     "h2 " + nasty, "p One.", "p " + nasty, "figure",
                                          "div", "p Words alone.", "h2 Last",     "figure", "div"};
  BOOST_TEST(flow == expected, boost::test_tools::per_element());

  // Every table has its own columns and the head of its names.
  const auto heads = [&](int table) {
    std::vector<std::string> all;
    for (const pugi::xpath_node& th :
         document.select_nodes(("(//table)[" + std::to_string(table) + "]/thead/tr/th[@scope='col']").c_str()))
      all.push_back(text_of(th.node()));
    return all;
  };
  BOOST_TEST((heads(1) == std::vector<std::string>{"Quantity", "exact", nasty}));
  BOOST_TEST((heads(2) == std::vector<std::string>{"Choice", "value"}));
  BOOST_TEST((heads(3).empty()));
  BOOST_TEST(text_of(document.select_node("(//table)[1]/tbody/tr[2]").node()) == "spall" + nasty + "12");
  BOOST_TEST(document.select_nodes("//th[@scope='row']").size() == 2U);
  BOOST_TEST(text_of(document.select_node("(//table)[2]/tbody/tr").node()) == "Nothing was compared.");

  const pugi::xpath_node_set pictures = document.select_nodes("/html/body/main/figure");
  BOOST_TEST_REQUIRE(pictures.size() == 2U);
  const pugi::xml_node first = pictures[0].node(), second = pictures[1].node();
  BOOST_TEST(first.child("a").attribute("href").value() == "figures/fig%201%23b.svg");
  BOOST_TEST(first.child("a").child("img").attribute("src").value() == "figures/fig%201%23b.svg");
  BOOST_TEST(first.child("a").child("img").attribute("alt").value() == nasty);
  BOOST_TEST(text_of(first.child("figcaption")) == nasty);
  BOOST_TEST(second.child("a").child("img").attribute("alt").value() == "Last");  // never without words
  BOOST_TEST(second.child("figcaption").empty());
}

BOOST_AUTO_TEST_CASE(columns_of_numbers_stand_to_the_right_in_their_own_table) {
  Page page = report();
  page.sections[2].rows = {{"status", "", {"completed"}, ""}};
  pugi::xml_document document;
  parse(page_html(page), document);
  BOOST_TEST(document.select_nodes("(//table)[1]/tbody/tr/td[@class='number']").size() == 4U);
  BOOST_TEST(document.select_nodes("(//table)[2]//*[@class='number']").size() == 0U);
}

BOOST_AUTO_TEST_CASE(empty_page_and_control_characters) {
  Page page;
  page.intro = {"", std::string("bell \a and tab \t")};
  page.sections = {{}, {.text = {""}}};
  page.footer = {""};
  pugi::xml_document document;
  parse(page_html(page), document);
  BOOST_TEST(document.select_node("//table").node().empty());
  BOOST_TEST(document.select_node("//h2").node().empty());
  BOOST_TEST(document.select_nodes("//main/p").size() == 3U);
  BOOST_TEST(page_html(page).find('\a') == std::string::npos);
  BOOST_TEST(!text_of(document.select_node("//title").node()).empty());
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_is_refused) {
  Page page = example();
  page.sections[0].rows[1].values.pop_back();
  BOOST_CHECK_THROW(page_html(page), std::invalid_argument);
  page = report();
  page.sections[0].rows[1].values.push_back("3");
  BOOST_CHECK_THROW(page_html(page), std::invalid_argument);
  page = report();
  page.sections[2].rows = {{"name", "", {}, ""}};
  BOOST_CHECK_THROW(page_html(page), std::invalid_argument);
  for (const char* path : {"/tmp/fig.svg", "https://example.org/fig.svg"}) {
    page = example();
    page.sections[0].rows[0].picture = path;
    BOOST_CHECK_THROW(page_html(page), std::invalid_argument);
    page = report();
    page.sections[2].picture = path;
    BOOST_CHECK_THROW(page_html(page), std::invalid_argument);
  }
}

BOOST_AUTO_TEST_CASE(written_to_a_file) {
  std::string name = (fs::temp_directory_path() / "diptych-page-XXXXXX").string();
  BOOST_TEST_REQUIRE(::mkdtemp(name.data()) != nullptr);
  const fs::path path = fs::path(name) / "new" / "page.html";
  write_page(example(), path);
  std::ifstream file(path, std::ios::binary);
  BOOST_TEST((std::string(std::istreambuf_iterator<char>(file), {}) == page_html(example())));
  fs::remove_all(name);
}

BOOST_AUTO_TEST_SUITE_END()
