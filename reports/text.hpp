// Lengths of text, and breaking it into lines.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace diptych::reports {

std::size_t characters(std::string_view text);  ///< UTF-8 code points

/// Breaks at spaces into lines of at most so many pixels, where words allow.
std::vector<std::string> lines_of(const std::string& text, double pixels, double per_character);

}  // namespace diptych::reports
