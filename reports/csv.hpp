// Comma-separated values: one way to write a field, a number and a note.
#pragma once

#include <string>
#include <vector>

namespace diptych::reports {

std::string csv_field(const std::string& text);                          ///< RFC 4180, printable
std::string csv_note(const std::string& key, const std::string& value);  ///< "# key: value", one line
std::string csv_number(double value);                                    ///< as short as gives the same double; "nan"
std::string csv_line(const std::vector<std::string>& cells);             ///< fields and an LF

}  // namespace diptych::reports
