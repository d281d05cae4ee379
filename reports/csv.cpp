#include "reports/csv.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace diptych::reports {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string csv_note(const std::string& key, std::string value) {
  std::replace_if(
      value.begin(), value.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return "# " + key + ": " + value + "\n";
}

std::string csv_number(double value) { return std::isnan(value) ? std::string("nan") : fmt::format("{}", value); }

std::string csv_line(const std::vector<std::string>& cells) {
  std::string out;
  for (std::size_t i = 0; i < cells.size(); ++i) out += (i == 0 ? "" : ",") + csv_field(cells[i]);
  return out + "\n";
}

}  // namespace diptych::reports
