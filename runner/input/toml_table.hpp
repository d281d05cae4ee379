// Reading tables of a TOML file by rules . Every mistake becomes a message that names the
// place, the key, what was found and what is allowed. None stops the reading, which goes on with an empty value that
// later checks pass over: one run shows a user all there is to correct.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "runner/input/declaration.hpp"
#include "runner/input/messages.hpp"
#include "runner/input/toml_tree.hpp"

namespace diptych::runner {

struct Mistake {
  Position at;
  std::string message;
};

/// A key of a file, as list --declarations writes it, with the value that it is to have instead of what it has; without
/// a value the key is taken out.
struct Change {
  std::string key;  ///< "material.nu", "load[0].traction", "sample.probes[tip].at"
  std::optional<Node> value = {};
};
/// Changes a tree of tables; tables on the way to a value are made where they are missing, where `at` says. Throws
/// InputError where what is to be taken out, or an entry of a list on the way, is not there, with what there is.
void apply(const Change&, Node& root, Position at = {});

/// Where a value stands in the file, and what it is called there.
struct Place {
  std::vector<Mistake>* mistakes;
  const Node* node;  ///< null where the key is missing
  Position at;
  std::string label;

  void say(const std::string& message) const;
  /// "found ...; allowed: ...; hint". Returns nothing, for a rule to return in turn.
  std::nullopt_t refuse(const std::string& what, const std::string& allowed, const std::string& hint = "") const;
  std::nullopt_t refuse_value(const std::string& allowed, const std::string& hint = "") const;
  Place entry(std::size_t index) const;  ///< of a list
};

// ---- rules: what a value may be -----------------------------------------------------------------------------------

template <class Value>
struct Rule {
  std::function<std::optional<Value>(const Place&)> read;  ///< gives the value, or notes a mistake and gives nothing
  std::string missing = ", and it is required";            ///< what to say after "missing"
};

Rule<double> any_number(const std::string& hint = "");
Rule<double> positive(const std::string& hint = "");
Rule<double> not_negative();
Rule<double> not_zero();
Rule<int> whole(int least, int most);
Rule<bool> flag();
Rule<std::string> text(const std::string& allowed = "a text in quotes that is not empty");
Rule<std::string> id();
Rule<std::string> one_of(const Names&, const std::string& hint = "");
Rule<std::array<double, 2>> interval(const Rule<double>& bound = any_number());  ///< [least, most], least < most

/// At least one value.
template <class Value>
Rule<std::vector<Value>> list_of(const Rule<Value>& rule, bool distinct = false) {
  return {[=](const Place& place) -> std::optional<std::vector<Value>> {
    const auto* list = place.node->as<Node::List>();
    if (!list || list->empty()) return place.refuse_value("a list in brackets with at least one entry");
    std::vector<Value> values;
    bool good = true;
    for (std::size_t i = 0; i < list->size(); ++i) {
      const auto value = rule.read(place.entry(i));
      const bool twice = value && distinct && std::find(values.begin(), values.end(), *value) != values.end();
      if (twice) place.entry(i).say("found " + words(*value) + " twice; allowed: each value once");
      if (value) values.push_back(*value);
      good = good && value && !twice;
    }
    return good ? std::optional(values) : std::nullopt;
  }};
}

/// The same, all different.
template <class Value>
Rule<std::vector<Value>> set_of(const Rule<Value>& rule) {
  return list_of(rule, true);
}

/// A single value stands for a set of one.
template <class Value>
Rule<std::vector<Value>> one_or_set_of(const Rule<Value>& rule) {
  return {[=](const Place& place) -> std::optional<std::vector<Value>> {
    if (place.node->as<Node::List>()) return set_of(rule).read(place);
    const auto value = rule.read(place);
    return value ? std::optional(std::vector<Value>{*value}) : std::nullopt;
  }};
}

// ---- tables ---------------------------------------------------------------------------------------------------------

/// One table of the file. It remembers which keys were asked for: the others are unknown, so the schema cannot drift
/// from the reading.
class Table {
 public:
  using Read = std::function<void(Table&)>;

  /// `prefix` stands before the names of keys in messages.
  Table(const Place&, const std::string& prefix);
  void rename(const std::string& prefix) { prefix_ = prefix; }

  /// Where the key stands, or this table where it does not.
  Place place(const std::string& key);
  bool has(const std::string& key) { return place(key).node; }
  const Node::Entries& entries() const { return *place_.node->as<Node::Entries>(); }
  const Place& itself() const { return place_; }
  void say(const std::string& message) const { place_.say(message); }
  unsigned line() const { return place_.at.line; }
  std::size_t mistakes() const { return place_.mistakes->size(); }  ///< so far, in the whole file
  /// Its keys and values for gates.lock, less its own id and some more of its own keys.
  Declaration declaration(const Names& without = {}) const;

  template <class Value>
  std::optional<Value> maybe(const std::string& key, const Rule<Value>& rule) {
    const Place here = place(key);
    return here.node ? rule.read(here) : std::nullopt;
  }
  template <class Value>
  Value get(const std::string& key, const Rule<Value>& rule, const std::type_identity_t<Value>& otherwise = {}) {
    return maybe(key, rule).value_or(otherwise);
  }
  /// A missing key is a mistake, too.
  template <class Value>
  std::optional<Value> must(const std::string& key, const Rule<Value>& rule) {
    if (!has(key)) place(key).say("missing" + rule.missing);
    return maybe(key, rule);
  }
  /// An empty value (0, "", {}) where it is missing or wrong.
  template <class Value>
  Value need(const std::string& key, const Rule<Value>& rule) {
    return must(key, rule).value_or(Value{});
  }

  /// Whether `key` belongs to what was `chosen` for `choice`; if it does not but is there, that is a mistake.
  bool applies(const std::string& key, const std::string& choice, const std::string& chosen, const Names& owners);

  /// Reads the table [key]; a missing one is a mistake.
  void table(const std::string& key, const Read&);
  void maybe_table(const std::string& key, const Read&);
  /// Reads each entry of [[key]], numbered from 1 until it has a name.
  void each(const std::string& key, const Read&);
  /// The same, at least one; [key] stands for one of them.
  void one_or_each(const std::string& key, const Read&);

  void refuse_other_keys() const;

 private:
  Place place_;
  std::string prefix_;
  std::set<std::string> known_;
};

/// Reads the top table of a file, called `name` in messages, after some changes. Throws InputError listing every
/// mistake in the order of the file, one a line.
void read_toml(const std::string& toml, const std::string& name, const Table::Read&,
               const std::vector<Change>& changes = {});

}  // namespace diptych::runner
