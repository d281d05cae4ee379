// Text that tests read and edit: whether it holds a part, its lines, a part that becomes another.
#pragma once

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace diptych::tests {

inline bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

inline bool holds_all(const std::string& text, const std::vector<std::string>& parts) {
  return std::all_of(parts.begin(), parts.end(), [&](const std::string& part) { return holds(text, part); });
}

inline std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

/// The line, counted from 1, where `part` begins for the first time.
inline int line_of(const std::string& text, const std::string& part) {
  const std::size_t at = text.find(part);
  BOOST_REQUIRE_MESSAGE(at != std::string::npos, "no line holds '" + part + "'");
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

/// The first `from` becomes `to`.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  BOOST_REQUIRE_MESSAGE(at != std::string::npos, "the test speaks of '" + from + "', which the text lacks");
  return text.replace(at, from.size(), to);
}

/// Without the lines that hold one of `parts`.
inline std::string without(const std::string& text, const std::vector<std::string>& parts) {
  std::string out;
  for (const std::string& line : lines(text))
    if (std::none_of(parts.begin(), parts.end(), [&](const std::string& part) { return holds(line, part); }))
      out += line + '\n';
  return out;
}

}  // namespace diptych::tests
