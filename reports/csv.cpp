#include "reports/csv.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "reports/text.hpp"

namespace diptych::reports {

std::string csv_field(const std::string& text) {
  const std::string shown = printable(text);
  if (shown.find_first_of(",\"\n") == std::string::npos) return shown;
  std::string out = "\"";
  for (const char c : shown) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string csv_note(const std::string& key, const std::string& value) {
  std::string line = printable(value);
  std::replace(line.begin(), line.end(), '\n', ' ');
  return "# " + key + ": " + line + "\n";
}

std::string csv_number(double value) { return std::isnan(value) ? std::string("nan") : fmt::format("{}", value); }

std::string csv_line(const std::vector<std::string>& cells) {
  std::string out;
  for (std::size_t i = 0; i < cells.size(); ++i) out += (i == 0 ? "" : ",") + csv_field(cells[i]);
  return out + "\n";
}

}  // namespace diptych::reports
