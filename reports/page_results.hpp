// A page of text, tables and pictures as plain data.
#pragma once

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

}  // namespace diptych::reports
