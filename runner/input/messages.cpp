#include "runner/input/messages.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>

#include "reports/text.hpp"

namespace diptych::runner {
namespace {

/// Letters that must change, move or go to turn one word into the other, upper and lower case being alike.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  const auto same = [](char one, char other) {
    return std::tolower(static_cast<unsigned char>(one)) == std::tolower(static_cast<unsigned char>(other));
  };
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      const std::size_t change = same(a[i - 1], b[j - 1]) ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]))
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::string words(double value) {  // not fmt: its shortest has other exponents, and gates.lock holds these
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string words(int value) { return std::to_string(value); }

std::string words(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '\n')
      out += "\\n";
    else if (c == '\t')
      out += "\\t";
    else if (c == '\r')
      out += "\\r";
    else if (c == '"' || c == '\\')
      (out += '\\') += c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return reports::printable(out) + '"';
}

std::string words(const std::vector<double>& values) { return '[' + joined(values) + ']'; }

Names parts_of(const std::string& text, char between) {
  Names parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, between);) parts.push_back(part);
  return parts;
}

std::optional<double> number_in(const std::string& text) {
  double value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string nearest(const std::string& word, const Names& allowed) {
  if (word.empty() || word.size() > 80) return "";
  const std::size_t tolerated = word.size() < 2 ? 0 : word.size() < 5 ? 1 : word.size() < 9 ? 2 : 3;
  const auto same_start = [&](const std::string& name) {
    return std::mismatch(word.begin(), word.end(), name.begin(), name.end()).first - word.begin();
  };
  std::string best;
  std::size_t least = tolerated + 1;
  for (const std::string& name : allowed) {  // of equals, the one that starts alike
    const std::size_t distance = edit_distance(word, name);
    if (distance > tolerated || distance > least) continue;
    if (distance < least || same_start(name) > same_start(best)) best = name;
    least = distance;
  }
  if (!best.empty() || word.size() < 3) return best;
  for (const std::string& name : allowed)  // "musl" for "mpm-musl"
    if (name.find(word) != std::string::npos) return name;
  return "";
}

std::string suggestion(const std::string& word, const Names& allowed) {
  const std::string near = nearest(word, allowed);
  return near.empty() ? "" : "did you mean " + words(near) + "?";
}

std::string hint_of(const std::string& word, const Names& allowed) {
  const std::string hint = suggestion(word, allowed);
  return hint.empty() ? "" : "; " + hint;
}

void require_one_of(const std::string& option, const std::string& found, const Names& allowed) {
  if (!contains(allowed, found))
    throw InputError(
        fmt::format("{}: found {}; allowed: {}{}", option, words(found), joined(allowed), hint_of(found, allowed)));
}

}  // namespace diptych::runner
