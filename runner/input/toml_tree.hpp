// The values of a TOML file as a tree (toml++ behind a plain header), bounded in size and depth before they are read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace diptych::runner {

struct Position {
  unsigned line = 0, column = 0;  ///< from 1; 0 where it is not known
  auto operator<=>(const Position&) const = default;
};

/// A value of the file.
struct Node {
  struct Entry;
  using List = std::vector<Node>;
  using Entries = std::vector<Entry>;  ///< of a table, sorted by key
  using DateOrTime = std::monostate;
  Position at;
  std::variant<DateOrTime, bool, std::int64_t, double, std::string, List, Entries> value;

  template <class Value>
  const Value* as() const {
    return std::get_if<Value>(&value);
  }
  bool is_number() const { return as<double>() || as<std::int64_t>(); }
  std::optional<double> number() const;  ///< none where a whole number is too large for a double to be exact
};
struct Node::Entry {
  std::string key;
  Position at;  ///< of the key
  Node value;
};

/// A value as found in the file.
std::string words(const Node&);
/// A value as it would be read from a file, where quotes around a text may be left out: 0.3, 5, true, rkl2.
Node value_in(const std::string& text);

constexpr std::size_t most_file_bytes = 1'000'000;
constexpr std::size_t most_parts_of_a_key = 16, deepest_value = 32, longest_text = 10'000, most_entries = 10'000;

/// What keeps a file from being a tree of values, and where.
struct NotRead : std::runtime_error {
  NotRead(Position where, const std::string& what) : std::runtime_error(what), at(where) {}
  Position at;
};
/// All values of the file. Throws NotRead where it is no TOML, larger or deeper than the bounds above, or holds texts
/// with characters that cannot be shown.
Node tree_of(const std::string& toml);

}  // namespace diptych::runner
