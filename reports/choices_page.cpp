#include "reports/choices_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "reports/files.hpp"

namespace diptych::reports {
namespace {

// No '<', '>' or '&': a browser that reads the page as HTML takes them as they are, as XML they would be escaped.
constexpr const char* looks = R"(
:root { color-scheme: light; }
body { margin: 2rem auto; max-width: 76rem; padding: 0 1.25rem; color: #1a1a1a; background: #ffffff;
       font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 0 0 0.75rem; max-width: 48rem; }
p { max-width: 48rem; margin: 0.5rem 0; }
.scroll { overflow-x: auto; margin: 1.5rem 0; }
table { border-collapse: collapse; width: 100%; font-size: 0.94rem; }
thead th { position: sticky; top: 0; background: #f2f5f8; border-bottom: 2px solid #08306b; text-align: left; }
th, td { padding: 0.7rem 0.8rem; vertical-align: top; }
tbody tr { border-bottom: 1px solid #dcdcdc; break-inside: avoid; }
tbody th { text-align: left; font-weight: normal; min-width: 15rem; max-width: 24rem; }
.name { display: block; font-weight: 600; }
.what { display: block; color: #4a4a4a; margin-top: 0.2rem; }
.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
thead .number { white-space: normal; text-align: right; }
.reference { background: #eef4fb; }
.tag { display: inline-block; margin-left: 0.5rem; padding: 0 0.45rem; border-radius: 0.6rem; background: #08306b;
       color: #ffffff; font-size: 0.75rem; font-weight: 600; vertical-align: 0.1em; }
figure { margin: 0; }
img { display: block; width: 21rem; max-width: 100%; height: auto; border: 1px solid #e4e4e4; background: #ffffff; }
figcaption { font-size: 0.82rem; color: #4a4a4a; max-width: 21rem; margin-top: 0.25rem; }
footer { margin-top: 2rem; padding-top: 0.75rem; border-top: 1px solid #dcdcdc; font-size: 0.82rem; color: #4a4a4a; }
footer p { max-width: none; margin: 0.1rem 0; overflow-wrap: anywhere; }
@media print { body { margin: 0; max-width: none; font-size: 11px; } .scroll { overflow: visible; }
               thead th { position: static; } img { width: 13rem; } a { color: inherit; } }
)";

/// XML 1.0 has no control characters, not even escaped ones.
std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') c = ' ';
  return text;
}

pugi::xml_node add(pugi::xml_node parent, const char* tag, const std::string& text = "", const char* kind = nullptr) {
  pugi::xml_node node = parent.append_child(tag);
  if (kind != nullptr) node.append_attribute("class") = kind;
  if (!text.empty()) node.append_child(pugi::node_pcdata).set_value(printable(text).c_str());
  return node;
}

/// Whether a cell begins as a number does.
bool numeric(const std::string& text) {
  std::string_view rest = text;
  for (const std::string_view sign : {"−", "≈", "±", "<", "-", "+"})
    if (rest.starts_with(sign)) rest.remove_prefix(sign.size());
  while (rest.starts_with(' ')) rest.remove_prefix(1);
  return !rest.empty() && rest[0] >= '0' && rest[0] <= '9';
}

/// A path as a link: what would end the path or begin a query is written as its byte.
std::string link_of(const std::string& path) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~/";
  std::string out;
  for (const char c : path)
    out += plain.find(c) != std::string_view::npos ? std::string(1, c)
                                                   : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return out;
}

void check(const ChoicesPage& page) {
  for (const ChoicesPage::Row& row : page.rows) {
    const auto refuse = [&](const std::string& why) {
      throw std::invalid_argument("choice '" + row.name + "': " + why);
    };
    if (row.values.size() != page.columns.size())
      refuse(fmt::format("{} values for {} columns", row.values.size(), page.columns.size()));
    if (std::filesystem::path(row.picture).is_absolute() || row.picture.find(':') != std::string::npos)
      refuse("'" + row.picture + "' is no path relative to the page");
  }
}

/// Whether some cell of the column is a number: all of it then stands to the right.
bool numbers_in(const ChoicesPage& page, std::size_t column) {
  return std::any_of(page.rows.begin(), page.rows.end(),
                     [&](const ChoicesPage::Row& row) { return numeric(row.values[column]); });
}

void add_row(pugi::xml_node body, const ChoicesPage& page, const ChoicesPage::Row& row, bool pictures) {
  pugi::xml_node line = add(body, "tr", "", row.reference ? "reference" : nullptr);
  pugi::xml_node head = add(line, "th");
  head.append_attribute("scope") = "row";
  pugi::xml_node name = add(head, "span", row.name, "name");
  if (row.reference) add(name, "span", "reference", "tag");
  if (!row.description.empty()) add(head, "span", row.description, "what");
  for (std::size_t i = 0; i < page.columns.size(); ++i)
    add(line, "td", row.values[i].empty() ? "–" : row.values[i], numbers_in(page, i) ? "number" : nullptr);
  if (!pictures) return;
  if (row.picture.empty()) {
    add(line, "td", "–");
    return;
  }
  pugi::xml_node figure = add(add(line, "td"), "figure"), link = add(figure, "a"), picture = add(link, "img");
  link.append_attribute("href") = link_of(row.picture).c_str();
  picture.append_attribute("src") = link_of(row.picture).c_str();
  picture.append_attribute("alt") = printable(row.caption.empty() ? "Contour: " + row.name : row.caption).c_str();
  picture.append_attribute("loading") = "lazy";
  if (!row.caption.empty()) add(figure, "figcaption", row.caption);
}

}  // namespace

std::string choices_html(const ChoicesPage& page) {
  check(page);
  pugi::xml_document document;
  document.append_child(pugi::node_doctype).set_value("html");
  pugi::xml_node root = document.append_child("html");
  root.append_attribute("xmlns") = "http://www.w3.org/1999/xhtml";
  root.append_attribute("lang") = "en";
  pugi::xml_node head = add(root, "head");
  add(head, "meta").append_attribute("charset") = "utf-8";
  pugi::xml_node view = add(head, "meta");
  view.append_attribute("name") = "viewport";
  view.append_attribute("content") = "width=device-width, initial-scale=1";
  add(head, "title", page.title.empty() ? "Choices" : page.title);
  add(head, "style", looks);

  pugi::xml_node body = add(root, "body"), main = add(body, "main");
  add(main, "h1", page.title.empty() ? "Choices" : page.title);
  for (const std::string& paragraph : page.intro) add(main, "p", paragraph.empty() ? " " : paragraph);
  bool pictures = false;
  for (const ChoicesPage::Row& row : page.rows) pictures = pictures || !row.picture.empty();
  pugi::xml_node table = add(add(main, "div", "", "scroll"), "table"), top = add(add(table, "thead"), "tr");
  const auto column = [&](const std::string& text, const char* kind) {
    add(top, "th", text.empty() ? "–" : text, kind).append_attribute("scope") = "col";
  };
  column(page.first, nullptr);
  for (std::size_t i = 0; i < page.columns.size(); ++i)
    column(page.columns[i], numbers_in(page, i) ? "number" : nullptr);
  if (pictures) column("Contour", nullptr);
  pugi::xml_node lines = add(table, "tbody");
  for (const ChoicesPage::Row& row : page.rows) add_row(lines, page, row, pictures);
  if (page.rows.empty()) {
    pugi::xml_node none = add(add(lines, "tr"), "td", "No choices were compared.");
    none.append_attribute("colspan") = static_cast<unsigned long long>(page.columns.size() + 1);
  }
  if (!page.footer.empty()) {
    pugi::xml_node foot = add(body, "footer");
    for (const std::string& line : page.footer) add(foot, "p", line.empty() ? " " : line);
  }
  std::ostringstream out;
  document.save(out, " ", pugi::format_indent | pugi::format_no_declaration);
  return out.str();
}

void write_choices_page(const ChoicesPage& page, const std::filesystem::path& path) {
  write_file(path, choices_html(page));
}

}  // namespace diptych::reports
