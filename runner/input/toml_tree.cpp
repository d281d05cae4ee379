#include "runner/input/toml_tree.hpp"

#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "reports/text.hpp"
#include "runner/input/messages.hpp"

namespace diptych::runner {
namespace {

Position position(toml::source_position at) { return {at.line, at.column}; }

std::string shown_text(const std::string& text, Position at) {
  if (text.size() > longest_text)
    throw NotRead(at, fmt::format("found a text of {} bytes; allowed: at most {}", text.size(), longest_text));
  if (reports::printable(text) != text)
    throw NotRead(at, "found " + words(text) +
                          ", with a character that cannot be shown; allowed: texts without "
                          "control characters other than line breaks and tabs, and without U+FFFE and U+FFFF");
  return text;
}

Node copied(const toml::node& node, std::size_t depth = 0) {
  Node copy{position(node.source().begin), {}};
  if (depth > deepest_value)
    throw NotRead(copy.at,
                  fmt::format("found a value within more than {0} others; allowed: at most {0}", deepest_value));
  const auto count = [&](std::size_t entries) {
    if (entries > most_entries)
      throw NotRead(copy.at, fmt::format("found {} entries; allowed: at most {}", entries, most_entries));
  };
  if (const auto* text = node.as_string()) copy.value = shown_text(text->get(), copy.at);
  if (const auto* whole = node.as_integer()) copy.value = whole->get();
  if (const auto* number = node.as_floating_point()) copy.value = number->get();
  if (const auto* flag = node.as_boolean()) copy.value = flag->get();
  if (const auto* array = node.as_array()) {
    count(array->size());
    auto& list = copy.value.emplace<Node::List>();
    for (const toml::node& one : *array) list.push_back(copied(one, depth + 1));
  }
  if (const auto* table = node.as_table()) {
    count(table->size());
    auto& entries = copy.value.emplace<Node::Entries>();
    for (const auto& [key, value] : *table) {  // toml++ keeps tables sorted by key
      const Position at = position(key.source().begin);
      entries.push_back({shown_text(std::string(key.str()), at), at, copied(value, depth + 1)});
    }
  }
  return copy;
}

/// toml++ 3.3 goes one call deeper for each dotted part of a key, so that a long key ends the stack: parts are counted
/// first. Dots of numbers never follow each other, and those of texts and comments are passed over.
void check_keys(std::string_view toml) {
  unsigned line = 1, column = 1;
  std::size_t parts = 1;
  std::string_view within;  // the quotes of the text that the place is in
  bool comment = false;
  for (std::size_t at = 0; at < toml.size();) {
    const std::string_view rest = toml.substr(at);
    std::size_t taken = 1;
    if (rest[0] == '\n') {
      comment = false;
      if (within.size() == 1) within = {};  // its own mistake
      parts = 1;
    } else if (comment) {
    } else if (!within.empty()) {
      if (rest[0] == '\\' && within[0] == '"' && rest.size() > 1 && rest[1] != '\n')
        taken = 2;
      else if (rest.starts_with(within))
        taken = within.size(), within = {};
    } else if (rest[0] == '"' || rest[0] == '\'') {
      const std::string_view three = rest[0] == '"' ? "\"\"\"" : "'''";
      within = rest.starts_with(three) ? three : three.substr(0, 1);
      taken = within.size();
    } else if (rest[0] == '#') {
      comment = true;
    } else if (rest[0] == '.') {
      ++parts;
    } else if (std::string_view("=,[]{}").find(rest[0]) != std::string_view::npos) {
      parts = 1;
    }
    if (parts > most_parts_of_a_key)
      throw NotRead({line, column},
                    fmt::format("found a key of more than {0} parts; allowed: at most {0}", most_parts_of_a_key));
    if (rest[0] == '\n')
      ++line, column = 1;
    else
      column += static_cast<unsigned>(taken);
    at += taken;
  }
}

std::string line_at(const std::string& toml, unsigned line) {
  std::size_t begin = 0;
  for (unsigned i = 1; i < line && begin != std::string::npos; ++i) begin = toml.find('\n', begin) + 1;
  return toml.substr(begin, toml.find('\n', begin) - begin);
}

/// What a user did not mean, where it can be told; else toml++'s own words.
std::string explained(const toml::parse_error& error, const std::string& toml) {
  const std::string words_of_library(error.description());
  const auto speaks = [&](const char* part) { return words_of_library.find(part) != std::string::npos; };
  const std::string line = line_at(toml, error.source().begin.line);
  const std::size_t at = std::min<std::size_t>(error.source().begin.column - 1, line.size());
  const bool at_end = line.find_first_not_of("\r", at) == std::string::npos;
  if (speaks("string") && (speaks("end-of-file") || (speaks("control characters") && at_end)))
    return "found a text whose closing quote is missing; allowed: one more quote at its end, and three of them at both "
           "ends of a text of several lines";
  if (speaks("maximum nested value depth"))
    return fmt::format("found lists or tables within more than {0} others; allowed: at most {0}", deepest_value);
  const bool bare = speaks("could not determine value type") || speaks("parsing boolean");
  std::string value = line.substr(std::min(at, line.size()));
  value.erase(value.find_last_not_of(" \t\r\"'") + 1);
  const auto first = static_cast<unsigned char>(value.empty() ? ' ' : value[0]);
  if (bare && (std::isalpha(first) != 0 || first >= 0x80))
    return fmt::format(
        "found {} without quotes; allowed: texts in quotes, {}\"{}\", numbers, true, false, lists in "
        "brackets and tables in braces",
        value, line.substr(0, at), value);
  if (speaks("expected a comment or whitespace, saw ','"))
    return "found \",\" behind a value; allowed: one value, whose decimal point is \".\", or a list in brackets";
  if (speaks("expected a comment or whitespace") && at > 0 && (line[at - 1] == '"' || line[at] == '"'))
    return "found more behind the end of a text; allowed: one text, in which a quote is written \\\"";
  return words_of_library;
}

}  // namespace

std::optional<double> Node::number() const {
  constexpr std::int64_t largest = std::int64_t{1} << 53;
  if (const auto* one = as<double>()) return *one;
  const auto* whole = as<std::int64_t>();
  if (!whole || *whole < -largest || *whole > largest) return {};
  return static_cast<double>(*whole);
}

std::string words(const Node& node) {
  if (const auto* text = node.as<std::string>()) return words(*text);
  if (const auto* whole = node.as<std::int64_t>()) return std::to_string(*whole);
  if (const auto* flag = node.as<bool>()) return *flag ? "true" : "false";
  if (const auto* number = node.as<double>()) {
    const std::string text = words(*number);
    return text.find_first_not_of("-0123456789") == std::string::npos ? text + ".0" : text;
  }
  if (const auto* list = node.as<Node::List>()) return list->empty() ? "an empty list" : "a list";
  return node.as<Node::Entries>() ? "a table" : "a date or time";
}

Node value_in(const std::string& text) {
  try {
    Node tree = tree_of("value = " + text);
    auto* entries = std::get_if<Node::Entries>(&tree.value);
    if (entries && entries->size() == 1) {
      Node value = std::move(entries->front().value);
      value.at = {};
      return value;
    }
  } catch (const NotRead&) {  // a text without quotes
  }
  return {{}, text};
}

Node tree_of(const std::string& toml) {
  if (toml.size() > most_file_bytes)
    throw NotRead({1, 1}, fmt::format("found {} bytes; allowed: at most {}", toml.size(), most_file_bytes));
  check_keys(toml);
  try {
    return copied(toml::parse(toml));
  } catch (const toml::parse_error& error) {
    throw NotRead(position(error.source().begin), "not TOML: " + explained(error, toml));
  }
}

}  // namespace diptych::runner
