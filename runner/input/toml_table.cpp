#include "runner/input/toml_table.hpp"

#include <fmt/core.h>

#include <cmath>
#include <cstddef>

#include "runner/input/messages.hpp"

namespace diptych::runner {
namespace {

/// Keys whose texts are only for reading. (A parameter of that name is a number.)
bool is_prose(const Node::Entry& entry) {
  static const Names prose{"title", "why", "reason", "says"};
  return entry.value.as<std::string>() && contains(prose, entry.key);
}

/// The id of an entry of a list of tables, "" without one.
std::string id_of(const Node& node) {
  const auto* entries = node.as<Node::Entries>();
  for (std::size_t i = 0; entries && i < entries->size(); ++i)
    if (const auto* id = (*entries)[i].value.as<std::string>(); id && (*entries)[i].key == "id") return *id;
  return "";
}

/// A value that has no tables in it.
std::string declared_value(const Node& node) {
  if (const auto number = node.number()) return words(*number);
  const auto* list = node.as<Node::List>();
  if (!list) return words(node);
  Names values;
  for (const Node& one : *list) values.push_back(declared_value(one));
  return '[' + listed(values, " ") + ']';
}

void declare(const std::string& path, const Node& node, Declaration& into);

/// All entries but prose and those that `path` speaks of already.
void declare(const std::string& path, const Node::Entries& entries, const Names& without, Declaration& into) {
  bool any = false;
  for (const Node::Entry& one : entries) {
    if (is_prose(one) || contains(without, one.key)) continue;
    declare(path.empty() ? one.key : path + '.' + one.key, one.value, into);
    any = true;
  }
  if (!any && !path.empty()) into[path] = "{}";
}

void declare(const std::string& path, const Node& node, Declaration& into) {
  if (const auto* entries = node.as<Node::Entries>()) return declare(path, *entries, {}, into);
  const auto is_table = [](const Node& one) { return one.as<Node::Entries>() != nullptr; };
  const auto* list = node.as<Node::List>();
  if (!list || std::none_of(list->begin(), list->end(), is_table)) {
    into[path] = declared_value(node);
    return;
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Node& one = (*list)[i];
    const std::string id = id_of(one);
    if (id.empty())
      declare(fmt::format("{}[{}]", path, i), one, into);
    else
      declare(fmt::format("{}[{}]", path, id), *one.as<Node::Entries>(), {"id"}, into);
  }
}

/// What a key calls an entry of a list of tables: its id, or its number from 0.
std::string called(const Node::List& list, std::size_t i) {
  const std::string id = id_of(list[i]);
  return id.empty() ? std::to_string(i) : id;
}

/// The end where there is none.
Node::List::iterator entry_called(Node::List& list, const std::string& name) {
  std::size_t i = 0;
  while (i < list.size() && name != called(list, i)) ++i;
  return list.begin() + static_cast<std::ptrdiff_t>(i);
}

Names entries_in(const std::string& key, const Node::List& list) {
  Names names;
  for (std::size_t i = 0; i < list.size(); ++i) names.push_back(key + '[' + called(list, i) + ']');
  return names;
}

Names keys_of(const Node::Entries& entries) {
  Names keys;
  for (const Node::Entry& one : entries) keys.push_back(one.key);
  return keys;
}

/// The part of a key up to the next dot outside of brackets, taken off it.
std::string first_part(std::string& key) {
  const std::size_t bracket = key.find('['), dot = key.find('.');
  std::size_t end = dot;
  if (bracket < dot) end = key.find('.', std::min(key.find(']', bracket), key.size()));
  const std::string part = key.substr(0, end);
  key = end == key.npos ? "" : key.substr(end + 1);
  return part;
}

Rule<double> finite(const std::string& range, bool (*within)(double), const std::string& hint = "") {
  const std::string allowed = "a finite number" + range;
  return {[=](const Place& place) -> std::optional<double> {
            const auto value = place.node->number();
            if (value && std::isfinite(*value) && within(*value)) return value;
            return place.refuse_value(allowed, hint);
          },
          "; allowed: " + allowed};
}

Rule<std::string> string_of(const std::string& allowed, bool (*good)(const std::string&)) {
  return {[=](const Place& place) -> std::optional<std::string> {
    if (const auto* text = place.node->as<std::string>(); text && good(*text)) return *text;
    return place.refuse_value(allowed);
  }};
}

}  // namespace

// ---- values and their places ----------------------------------------------------------------------------------------

void apply(const Change& change, Node& root, Position position) {
  Node* at = &root;
  std::string rest = change.key, before;
  const auto refuse = [&](const std::string& part, const Names& known) {
    throw InputError(fmt::format("{}: there is no {}{}; allowed: {}{}", change.key, before, part, listed(known),
                                 hint_of(part, known)));
  };
  while (!rest.empty()) {
    const std::string part = first_part(rest);
    const std::size_t bracket = part.find('[');
    const bool takes_here = !change.value && rest.empty();
    const std::string name = part.substr(0, bracket);
    if (at->value.index() == 0) at->value.emplace<Node::Entries>();  // a table that is not there yet
    auto* entries = std::get_if<Node::Entries>(&at->value);
    if (!entries) refuse(part, {});
    auto entry = std::find_if(entries->begin(), entries->end(), [&](const Node::Entry& e) { return e.key == name; });
    if (entry == entries->end()) {
      if (!change.value || bracket != part.npos) refuse(name, keys_of(*entries));
      const auto place = std::find_if(entries->begin(), entries->end(), [&](const auto& e) { return e.key > name; });
      entry = entries->insert(place, {name, position, {position, {}}});
    }
    if (bracket == part.npos) {
      if (takes_here) return static_cast<void>(entries->erase(entry));
      at = &entry->value;
    } else {
      auto* list = std::get_if<Node::List>(&entry->value.value);
      if (!list) refuse(part, {});
      const auto one = entry_called(*list, part.substr(bracket + 1, part.size() - bracket - 2));
      if (one == list->end()) refuse(part, entries_in(name, *list));
      if (takes_here) return static_cast<void>(list->erase(one));
      at = &*one;
    }
    before += part + '.';
  }
  if (change.value) *at = *change.value;
}

void Place::say(const std::string& message) const { mistakes->push_back({at, label + ": " + message}); }

std::nullopt_t Place::refuse(const std::string& what, const std::string& allowed, const std::string& hint) const {
  say("found " + what + "; allowed: " + allowed + (hint.empty() ? "" : "; " + hint));
  return std::nullopt;
}

std::nullopt_t Place::refuse_value(const std::string& allowed, const std::string& hint) const {
  return refuse(words(*node), allowed, hint);
}

Place Place::entry(std::size_t index) const {
  const Node& one = (*node->as<Node::List>())[index];
  return {mistakes, &one, one.at, fmt::format("{}, entry {}", label, index + 1)};
}

// ---- rules ----------------------------------------------------------------------------------------------------------

Rule<double> any_number(const std::string& hint) {
  return finite(
      "", [](double) { return true; }, hint);
}
Rule<double> positive(const std::string& hint) {
  return finite(
      " > 0", [](double value) { return value > 0; }, hint);
}
Rule<double> not_negative() {
  return finite(" >= 0", [](double value) { return value >= 0; });
}
Rule<double> not_zero() {
  return finite(" other than 0", [](double value) { return value != 0; });
}

Rule<int> whole(int least, int most) {
  return {[=](const Place& place) -> std::optional<int> {
    const auto* value = place.node->as<std::int64_t>();
    if (value && *value >= least && *value <= most) return static_cast<int>(*value);
    return place.refuse_value(fmt::format("a whole number from {} to {}", least, most));
  }};
}

Rule<bool> flag() {
  return {[](const Place& place) -> std::optional<bool> {
    if (const auto* value = place.node->as<bool>()) return *value;
    return place.refuse_value("true or false");
  }};
}

Rule<std::string> text(const std::string& allowed) {
  return string_of(allowed, [](const std::string& value) { return value.find_first_not_of(" \t\r\n") != value.npos; });
}

Rule<std::string> id() {
  return string_of("a name in quotes of at most 80 of a-z, 0-9, \".\" and \"-\" that begins with a letter or a digit",
                   [](const std::string& value) {
                     constexpr const char* inside = "abcdefghijklmnopqrstuvwxyz0123456789.-";
                     return !value.empty() && value.size() <= 80 && value[0] != '.' && value[0] != '-' &&
                            value.find_first_not_of(inside) == value.npos;
                   });
}

Rule<std::string> one_of(const Names& names, const std::string& hint) {
  return {[=](const Place& place) -> std::optional<std::string> {
            const auto* name = place.node->as<std::string>();
            if (name && contains(names, *name)) return *name;
            const std::string near = name ? suggestion(*name, names) : "";
            return place.refuse_value(joined(names), near.empty() ? hint : near);
          },
          "; allowed: " + joined(names)};
}

Rule<std::array<double, 2>> interval(const Rule<double>& bound) {
  return {[=](const Place& place) -> std::optional<std::array<double, 2>> {
    const auto* list = place.node->as<Node::List>();
    if (!list || list->size() != 2) return place.refuse_value("a list of two numbers, [least, most]");
    const auto least = bound.read(place.entry(0)), most = bound.read(place.entry(1));
    if (!least || !most) return {};
    if (*least < *most) return std::array{*least, *most};
    return place.refuse(words(std::vector{*least, *most}), "[least, most] with least < most");
  }};
}

// ---- tables ---------------------------------------------------------------------------------------------------------

Table::Table(const Place& place, const std::string& prefix) : place_(place), prefix_(prefix) {}

Place Table::place(const std::string& key) {
  known_.insert(key);
  const auto one =
      std::find_if(entries().begin(), entries().end(), [&](const Node::Entry& entry) { return entry.key == key; });
  const Node* node = one == entries().end() ? nullptr : &one->value;
  return {place_.mistakes, node, node && node->at.line > 0 ? node->at : place_.at, prefix_ + key};
}

Declaration Table::declaration(const Names& without) const {
  Names not_locked = without;
  not_locked.push_back("id");  // which names the whole
  Declaration all;
  declare("", entries(), not_locked, all);
  return all;
}

bool Table::applies(const std::string& key, const std::string& choice, const std::string& chosen, const Names& owners) {
  const bool there = has(key);
  if (contains(owners, chosen)) return true;
  if (there && !chosen.empty())
    place(key).say(fmt::format("found, but it does not belong to {0} = {1}; allowed: with {0} = {2}", choice,
                               words(chosen), joined(owners)));
  return false;
}

void Table::table(const std::string& key, const Read& read) {
  if (has(key))
    maybe_table(key, read);
  else
    place(key).say("missing; allowed: a table [" + key + "]");
}

void Table::maybe_table(const std::string& key, const Read& read) {
  const Place here = place(key);
  if (!here.node) return;
  if (!here.node->as<Node::Entries>()) {
    here.refuse_value("one table [" + key + "]");
    return;
  }
  Table table(here, here.label + '.');
  read(table);
  table.refuse_other_keys();
}

void Table::each(const std::string& key, const Read& read) {
  const Place here = place(key);
  if (!here.node) return;
  const auto* list = here.node->as<Node::List>();
  if (!list) here.refuse_value("[[" + key + "]] in double brackets, or a list of tables");
  for (std::size_t i = 0; list && i < list->size(); ++i) {
    Place entry = here.entry(i);
    entry.label = fmt::format("{}{} {}", prefix_, key, i + 1);
    if (!entry.node->as<Node::Entries>()) {
      entry.refuse_value("a table of keys");
      continue;
    }
    Table table(entry, entry.label + ": ");
    read(table);
    table.refuse_other_keys();
  }
}

void Table::one_or_each(const std::string& key, const Read& read) {
  const Node* node = place(key).node;
  const auto* list = node ? node->as<Node::List>() : nullptr;
  if (!node || node->as<Node::Entries>() || (list && list->empty()))
    table(key, read);
  else
    each(key, read);
}

void Table::refuse_other_keys() const {
  for (const auto& [key, at, value] : entries()) {
    if (known_.count(key) != 0) continue;
    std::string hint = suggestion(key, {known_.begin(), known_.end()});
    if (key == "time_step" || key == "dt" || key == "timestep")
      hint = "the time step is courant * cell size / wave speed: set axes.courant, > 0";
    const bool nested = value.as<Node::List>() || value.as<Node::Entries>();
    Place{place_.mistakes, &value, at, prefix_ + key}.say(fmt::format("found an unknown key{}; allowed: {}{}{}",
                                                                      nested ? "" : " (= " + words(value) + ")",
                                                                      listed(known_), hint.empty() ? "" : "; ", hint));
  }
}

void read_toml(const std::string& toml, const std::string& name, const Table::Read& read,
               const std::vector<Change>& changes) {
  std::vector<Mistake> mistakes;
  try {
    Node root = tree_of(toml);
    for (const Change& change : changes) apply(change, root);
    Table table({&mistakes, &root, {1, 1}, "file"}, "");
    read(table);
    table.refuse_other_keys();
  } catch (const NotRead& why) {
    mistakes.push_back({why.at, why.what()});
  }
  for (Mistake& one : mistakes) one.at = {std::max(1u, one.at.line), std::max(1u, one.at.column)};
  std::stable_sort(mistakes.begin(), mistakes.end(), [](const Mistake& a, const Mistake& b) { return a.at < b.at; });
  Names lines;
  for (const auto& [at, message] : mistakes)
    lines.push_back(fmt::format("{}:{}:{}: {}", name, at.line, at.column, message));
  if (!lines.empty()) throw InputError(listed(lines, "\n"));
}

}  // namespace diptych::runner
