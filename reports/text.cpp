#include "reports/text.hpp"

#include <algorithm>
#include <utility>

namespace diptych::reports {
namespace {

/// Bytes of the first character, 0 where it is none that XML 1.0 (2.2 and its note) can hold and a terminal only shows:
/// the first of a byte sequence that is no UTF-8 (Unicode 15, table 3-7), a control character but for a line's end and
/// a tab, or U+FFFE and U+FFFF, which no text may have.
std::size_t length_of_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned lead = byte(0);
  if (lead < 0x80) return (lead >= 0x20 && lead != 0x7F) || lead == '\n' || lead == '\t' ? 1 : 0;
  const std::size_t length = lead < 0xC2 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF5 ? 4 : 0;
  if (length == 0) return 0;
  unsigned point = lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
    point = (point << 6U) | (byte(i) & 0x3FU);
  }
  const bool too_long = (length == 3 && point < 0x800) || (length == 4 && point < 0x10000);
  const bool surrogate = point >= 0xD800 && point <= 0xDFFF;
  const bool control = point < 0xA0, none = (point & 0xFFFEU) == 0xFFFE || point > 0x10FFFF;
  return too_long || surrogate || control || none ? 0 : length;
}

}  // namespace

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

std::string printable(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = length_of_character(std::string_view(text).substr(at));
    if (length > 0)
      out += text.substr(at, length);
    else
      out += '?';
    at += std::max<std::size_t>(length, 1);
    while (length == 0 && at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U) ++at;
  }
  return out;
}

}  // namespace diptych::reports
