// Lengths of text, breaking it into lines, and what of it files and terminals can hold.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace diptych::reports {

std::size_t characters(std::string_view text);  ///< UTF-8 code points

/// With spaces before it, or behind it, so that it takes so many columns at least.
std::string to_right(const std::string& text, std::size_t width);
std::string to_left(const std::string& text, std::size_t width);

/// Breaks at spaces into lines of at most so many pixels, where words allow.
std::vector<std::string> lines_of(const std::string& text, double pixels, double per_character);

/// What any reader of XML takes and a terminal only shows: each character that XML 1.0 cannot hold even escaped, each
/// control character but a line's end and a tab, and each sequence of bytes that is no UTF-8 becomes a question mark.
std::string printable(const std::string& text);

}  // namespace diptych::reports
