#include "reports/page.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "reports/files.hpp"
#include "reports/text.hpp"

namespace diptych::reports {
namespace {

// No '<', '>' or '&': a browser that reads the page as HTML takes them as they are, as XML they would be escaped.
constexpr const char* style_sheet = R"(
:root { color-scheme: light; }
body { margin: 2rem auto; max-width: 76rem; padding: 0 1.25rem; color: #1a1a1a; background: #ffffff;
       font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 0 0 0.75rem; max-width: 48rem; }
h2 { font-size: 1.25rem; line-height: 1.3; margin: 2.25rem 0 0.5rem; max-width: 48rem; break-after: avoid; }
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
.wide { margin: 1rem 0; max-width: 57rem; overflow-x: auto; break-inside: avoid; }
.wide img { width: 100%; min-width: 48rem; max-width: none; }
.wide figcaption { max-width: 48rem; }
footer { margin-top: 2rem; padding-top: 0.75rem; border-top: 1px solid #dcdcdc; font-size: 0.82rem; color: #4a4a4a; }
footer p { max-width: none; margin: 0.1rem 0; overflow-wrap: anywhere; }
@media print { body { margin: 0; max-width: none; font-size: 11px; } .scroll { overflow: visible; }
               thead th { position: static; } img { width: 13rem; }
               .wide img { width: 100%; min-width: 0; } a { color: inherit; } }
)";

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

void check_picture(const std::string& path, const std::string& of) {
  if (std::filesystem::path(path).is_absolute() || path.find(':') != std::string::npos)
    throw std::invalid_argument(of + ": '" + path + "' is no path relative to the page");
}

void check_page(const Page& page) {
  for (const Page::Section& section : page.sections) {
    check_picture(section.picture, "section '" + section.heading + "'");
    for (const Page::Row& row : section.rows) {
      check_picture(row.picture, "row '" + row.name + "'");
      if (row.values.size() != section.columns.size())
        throw std::invalid_argument(
            fmt::format("row '{}': {} values for {} columns", row.name, row.values.size(), section.columns.size()));
    }
  }
}

/// Whether some cell of the column is a number: all of it then stands to the right.
bool numbers_in(const Page::Section& section, std::size_t column) {
  return std::any_of(section.rows.begin(), section.rows.end(),
                     [&](const Page::Row& row) { return numeric(row.values[column]); });
}

/// A picture that leads to its file, where it can be seen larger.
void add_picture(pugi::xml_node figure, const std::string& path, const std::string& words, const std::string& caption) {
  pugi::xml_node link = add(figure, "a"), picture = add(link, "img");
  link.append_attribute("href") = link_of(path).c_str();
  picture.append_attribute("src") = link_of(path).c_str();
  picture.append_attribute("alt") = printable(caption.empty() ? words : caption).c_str();
  picture.append_attribute("loading") = "lazy";
  if (!caption.empty()) add(figure, "figcaption", caption);
}

void add_row(pugi::xml_node body, const Page::Section& section, const Page::Row& row, bool pictures) {
  pugi::xml_node line = add(body, "tr", "", row.reference ? "reference" : nullptr);
  pugi::xml_node head = add(line, "th");
  head.append_attribute("scope") = "row";
  pugi::xml_node name = add(head, "span", row.name, "name");
  if (row.reference) add(name, "span", "reference", "tag");
  if (!row.description.empty()) add(head, "span", row.description, "what");
  for (std::size_t i = 0; i < section.columns.size(); ++i)
    add(line, "td", row.values[i].empty() ? "–" : row.values[i], numbers_in(section, i) ? "number" : nullptr);
  if (!pictures) return;
  if (row.picture.empty())
    add(line, "td", "–");
  else
    add_picture(add(add(line, "td"), "figure"), row.picture, "Contour: " + row.name, row.caption);
}

void add_table(pugi::xml_node main, const Page::Section& section) {
  const bool pictures =
      std::any_of(section.rows.begin(), section.rows.end(), [](const Page::Row& row) { return !row.picture.empty(); });
  pugi::xml_node table = add(add(main, "div", "", "scroll"), "table"), top = add(add(table, "thead"), "tr");
  const auto column = [&](const std::string& text, const char* kind) {
    add(top, "th", text.empty() ? "–" : text, kind).append_attribute("scope") = "col";
  };
  column(section.first, nullptr);
  for (std::size_t i = 0; i < section.columns.size(); ++i)
    column(section.columns[i], numbers_in(section, i) ? "number" : nullptr);
  if (pictures) column("Contour", nullptr);
  pugi::xml_node lines = add(table, "tbody");
  for (const Page::Row& row : section.rows) add_row(lines, section, row, pictures);
  if (section.rows.empty()) {
    pugi::xml_node none = add(add(lines, "tr"), "td", "Nothing was compared.");
    none.append_attribute("colspan") = static_cast<unsigned long long>(section.columns.size() + 1);
  }
}

void add_paragraphs(pugi::xml_node parent, const std::vector<std::string>& paragraphs) {
  for (const std::string& paragraph : paragraphs) add(parent, "p", paragraph.empty() ? " " : paragraph);
}

void add_section(pugi::xml_node main, const Page::Section& section, const std::string& title) {
  if (!section.heading.empty()) add(main, "h2", section.heading);
  add_paragraphs(main, section.text);
  if (!section.picture.empty())
    add_picture(add(main, "figure", "", "wide"), section.picture, section.heading.empty() ? title : section.heading,
                section.caption);
  if (!section.columns.empty() || !section.rows.empty()) add_table(main, section);
}

}  // namespace

std::string page_html(const Page& page) {
  check_page(page);
  const std::string title = page.title.empty() ? "Results" : page.title;
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
  add(head, "title", title);
  add(head, "style", style_sheet);

  pugi::xml_node body = add(root, "body"), main = add(body, "main");
  add(main, "h1", title);
  add_paragraphs(main, page.intro);
  for (const Page::Section& section : page.sections) add_section(main, section, title);
  if (!page.footer.empty()) add_paragraphs(add(body, "footer"), page.footer);
  std::ostringstream out;
  document.save(out, " ", pugi::format_indent | pugi::format_no_declaration);
  return out.str();
}

void write_page(const Page& page, const std::filesystem::path& path) { write_file(path, page_html(page)); }

}  // namespace diptych::reports
