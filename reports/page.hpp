// A page of text, tables and pictures: readable without script, well-formed XML.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace diptych::reports {

struct Page {
  std::string title;
  std::vector<std::string> intro;  ///< paragraphs
  struct Row {
    std::string name, description;
    std::vector<std::string> values;  ///< one a column; "" is drawn as a dash
    std::string picture;              ///< an SVG file, relative to the page; empty: none
    std::string caption = {};         ///< of the picture, also for readers who cannot see it
    bool reference = false;           ///< the row that the others are compared with
  };
  /// Heading, text, picture and table, in this order. Without columns and rows there is no table.
  struct Section {
    std::string heading = {};               ///< empty: none
    std::vector<std::string> text = {};     ///< paragraphs
    std::string first = "Choice";           ///< head of the rows' names
    std::vector<std::string> columns = {};  ///< heads of the values, after the name and before the rows' pictures
    std::vector<Row> rows = {};
    std::string picture = {};  ///< an SVG file, relative to the page; empty: none
    std::string caption = {};  ///< of the picture, also for readers who cannot see it; empty: none
  };
  std::vector<Section> sections;
  std::vector<std::string> footer;  ///< provenance, a line each
};

/// The page as XHTML. Throws std::invalid_argument for a row whose values do not fit its section's columns and for a
/// picture that is not a relative path.
std::string page_html(const Page&);

/// Writes it as write_file does.
void write_page(const Page&, const std::filesystem::path& path);

}  // namespace diptych::reports
