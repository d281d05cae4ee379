#include "reports/text.hpp"

#include <algorithm>
#include <utility>

namespace diptych::reports {

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string to_right(const std::string& text, std::size_t width) {
  return std::string(width - std::min(width, characters(text)), ' ') + text;
}

std::string to_left(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, characters(text)), ' ');
}

std::vector<std::string> lines_of(const std::string& text, double pixels, double per_character) {
  const auto limit = static_cast<std::size_t>(pixels / per_character);
  std::vector<std::string> lines;
  std::string line;
  std::size_t used = 0;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n\r\t", at), text.size());
    const std::string word = text.substr(at, end - at);
    const std::size_t length = characters(word);
    if (used > 0 && used + 1 + length > limit) {
      lines.push_back(std::exchange(line, ""));
      used = 0;
    }
    if (used > 0 && length > 0) line += ' ', ++used;
    line += word;
    used += length;
    at = end + 1;
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') c = '?';
  return text;
}

}  // namespace diptych::reports
