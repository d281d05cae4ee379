// A page on what each modelling choice does to the contour: readable without script, well-formed XML.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace diptych::reports {

struct ChoicesPage {
  std::string title;
  std::vector<std::string> intro;    ///< paragraphs
  std::string first = "Choice";      ///< head of the rows' names
  std::vector<std::string> columns;  ///< heads of the values, after the choice and before the picture
  struct Row {
    std::string name, description;
    std::vector<std::string> values;  ///< one a column; "" is drawn as a dash
    std::string picture;              ///< an SVG file, relative to the page; empty: none
    std::string caption = {};         ///< of the picture, also for readers who cannot see it
    bool reference = false;           ///< the row that the others are compared with
  };
  std::vector<Row> rows;
  std::vector<std::string> footer;  ///< provenance, a line each
};

/// The page as XHTML. Throws std::invalid_argument for a row whose values do not fit the columns or whose picture is
/// not a relative path.
std::string choices_html(const ChoicesPage&);

/// Writes it as write_file does.
void write_choices_page(const ChoicesPage&, const std::filesystem::path& path);

}  // namespace diptych::reports
