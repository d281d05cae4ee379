// The schema of case files as the program reads it: one function per table, top to bottom as in cases/README.md.
// A mistake never stops the reading: it is noted with its place, and reading goes on with an empty value that the
// later checks pass over, so that one run shows a user all there is to correct.
#include "cases/case_file.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <system_error>

#include "cases/expression.hpp"
#include "cases/leaf.hpp"

namespace diptych::cases {

namespace {

using Names = std::vector<std::string>;

const Names claims{"code-verification", "solution-verification", "cross-code",
                   "regression",        "robustness",            "performance"};
const Names methods{"fem", "mpm-usf", "mpm-usl", "mpm-musl"};
const Names fields{"stress", "velocity", "displacement"};
const Names norms{"L1", "L2", "Linf"};
const Names invariants{"energy.drift",      "energy.lost", "momentum.drift",
                       "bits.power-of-two", "bits.mirror", "bits.repeat"};
const Names features{"elastic", "plasticity", "body-force", "boundary-layer", "convection"};
const Names time_units{"s", "L/c"};
const Names length_units{"m", "L", "cells"};

constexpr int most_cells = 10'000'000;
constexpr int most_particles = 1000;  // of one cell
constexpr double most_steps = 1e12;

/// What a `constant` gate may be measured against, and where that theory holds.
struct Theory {
  std::string name, solution;
  Names quantities, methods;
};
const std::vector<Theory> theories{
    {"discrete-step", "bar-wave", {"stress.L2", "displacement.L2"}, methods},
    {"airy-step", "bar-wave", {"stress.L2", "displacement.L2", "displacement.Linf"}, {"fem", "mpm-usf", "mpm-musl"}},
    {"end-equilibrium", "", {}, methods},  // the loads' own: probes of stress, whatever the solution
    {"mode", "standing-mode", {"stress.L1", "stress.L2", "stress.Linf", "velocity.L1", "velocity.L2", "velocity.Linf",
                               "displacement.L1", "displacement.L2", "displacement.Linf"}, methods},
};

// ---- words for messages ---------------------------------------------------------------------------------------

std::string words(double value) {  // the shortest that reads back as the same double
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end.ptr};
}
std::string words(int value) { return std::to_string(value); }

std::string words(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '\n') out += "\\n";
    else if (c == '\t') out += "\\t";
    else if (c == '\r') out += "\\r";
    else if (c == '"' || c == '\\') (out += '\\') += c;
    else out += c;
  }
  return out + '"';
}

std::string words(const std::vector<double>& values);

template <class Value>
std::string joined(const std::vector<Value>& values) {
  std::string out;
  for (const Value& value : values) out += (out.empty() ? "" : ", ") + words(value);
  return out;
}
std::string words(const std::vector<double>& values) { return '[' + joined(values) + ']'; }

std::string plain(const Names& names) {  // without quotes
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

/// A value as found in the file.
std::string found(const toml::node& node) {
  if (const auto* text = node.as_string()) return words(text->get());
  if (const auto* whole = node.as_integer()) return std::to_string(whole->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (const auto* number = node.as_floating_point()) {
    const std::string text = words(number->get());
    const bool looks_whole = text.find_first_not_of("-0123456789") == std::string::npos;
    return looks_whole ? text + ".0" : text;
  }
  if (const auto* array = node.as_array()) return array->empty() ? "an empty list" : "a list";
  return node.is_table() ? "a table" : "a date or time";
}

std::string suggestion(const std::string& word, const Names& allowed) {
  const std::string near = nearest(word, allowed);
  return near.empty() ? "" : "did you mean " + words(near) + "?";
}

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// ---- mistakes and their places --------------------------------------------------------------------------------

class Mistakes {
 public:
  explicit Mistakes(std::string file) : file_(std::move(file)) {}

  void add(toml::source_position at, const std::string& message) {
    const unsigned line = std::max(1u, static_cast<unsigned>(at.line));
    const unsigned column = std::max(1u, static_cast<unsigned>(at.column));
    all_.push_back({line, column, message});
  }

  std::size_t count() const { return all_.size(); }

  /// In the order of the file.
  void throw_if_any() {
    if (all_.empty()) return;
    std::stable_sort(all_.begin(), all_.end(), [](const Mistake& a, const Mistake& b) {
      return std::pair(a.line, a.column) < std::pair(b.line, b.column);
    });
    std::string text;
    for (const Mistake& m : all_)
      text += (text.empty() ? "" : "\n") + file_ + ':' + std::to_string(m.line) + ':' + std::to_string(m.column) +
              ": " + m.message;
    throw InputError(text);
  }

 private:
  struct Mistake {
    unsigned line, column;
    std::string message;
  };
  std::string file_;
  std::vector<Mistake> all_;
};

/// Where a value stands in the file, and what it is called there.
struct Place {
  Mistakes* mistakes;
  toml::source_position at;
  std::string label;

  void say(const std::string& message) const { mistakes->add(at, label + ": " + message); }

  void refuse(const std::string& what, const std::string& allowed, const std::string& hint = "") const {
    say("found " + what + "; allowed: " + allowed + (hint.empty() ? "" : "; " + hint));
  }

  Place entry(const toml::node& node, std::size_t index) const {
    return {mistakes, node.source().begin, label + ", entry " + std::to_string(index + 1)};
  }
};

// ---- rules: what a value may be. read() gives the value, or notes a mistake and gives nothing ---------------------

struct Number {
  double least = -std::numeric_limits<double>::infinity();
  bool least_itself = true;
  bool zero = true;
  std::string hint = {};
  using Value = double;

  std::string allowed() const {
    std::string text = "a finite number";
    if (std::isfinite(least)) text += (least_itself ? " >= " : " > ") + words(least);
    return zero ? text : text + " other than 0";
  }
  std::optional<double> read(const toml::node& node, const Place& place) const {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    const bool in_range = value && std::isfinite(*value) && (least_itself ? *value >= least : *value > least);
    if (in_range && (zero || *value != 0)) return value;
    place.refuse(found(node), allowed(), hint);
    return {};
  }
};
const Number any_number;
const Number positive{0, false};
const Number not_negative{0, true};
const Number not_zero{-std::numeric_limits<double>::infinity(), true, false};

struct Whole {
  std::int64_t least, most;
  using Value = int;

  std::optional<int> read(const toml::node& node, const Place& place) const {
    const auto* whole = node.as_integer();
    if (whole && whole->get() >= least && whole->get() <= most) return static_cast<int>(whole->get());
    place.refuse(found(node), "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    return {};
  }
};

struct Flag {
  using Value = bool;
  std::optional<bool> read(const toml::node& node, const Place& place) const {
    if (const auto* flag = node.as_boolean()) return flag->get();
    place.refuse(found(node), "true or false");
    return {};
  }
};

struct Text {
  std::string allowed = "a text in quotes that is not empty";
  using Value = std::string;
  std::optional<std::string> read(const toml::node& node, const Place& place) const {
    const auto* text = node.as_string();
    if (text && text->get().find_first_not_of(" \t\r\n") != std::string::npos) return text->get();
    place.refuse(found(node), allowed);
    return {};
  }
};
const Text formula{"an expression in quotes"};

struct Id {
  using Value = std::string;
  std::optional<std::string> read(const toml::node& node, const Place& place) const {
    const auto* text = node.as_string();
    if (text && !text->get().empty() &&
        text->get().find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789.-") == std::string::npos)
      return text->get();
    place.refuse(found(node), "a name in quotes of a-z, 0-9, \".\" and \"-\"");
    return {};
  }
};

struct OneOf {
  Names names;
  std::string hint = {};
  using Value = std::string;
  std::optional<std::string> read(const toml::node& node, const Place& place) const {
    const auto* text = node.as_string();
    if (text && contains(names, text->get())) return text->get();
    const std::string near = text ? suggestion(text->get(), names) : "";
    place.refuse(found(node), joined(names), near.empty() ? hint : near);
    return {};
  }
};

/// A list of values of one rule, all different; where `alone`, a single value stands for a list of one.
template <class Rule>
struct ListOf {
  Rule rule;
  bool alone = false;
  bool distinct = true;
  using Value = std::vector<typename Rule::Value>;

  std::optional<Value> read(const toml::node& node, const Place& place) const {
    Value values;
    const toml::array* array = node.as_array();
    if (!array && alone) {
      if (const auto value = rule.read(node, place)) return Value{*value};
      return {};
    }
    if (!array || array->empty()) {
      place.refuse(found(node), "a list in brackets with at least one entry");
      return {};
    }
    bool good = true;
    for (std::size_t i = 0; i < array->size(); ++i) {
      const Place here = place.entry((*array)[i], i);
      const auto value = rule.read((*array)[i], here);
      if (value && distinct && std::find(values.begin(), values.end(), *value) != values.end()) {
        here.say("found " + words(*value) + " twice; allowed: each value once");
        good = false;
      }
      if (value) values.push_back(*value);
      good = good && value;
    }
    if (!good) return {};
    return values;
  }
};

/// [least, most], least < most.
struct Interval {
  Number bound = any_number;
  using Value = std::array<double, 2>;
  std::optional<Value> read(const toml::node& node, const Place& place) const {
    const toml::array* array = node.as_array();
    if (array && array->size() == 2) {
      const auto first = bound.read((*array)[0], place.entry((*array)[0], 0));
      const auto second = bound.read((*array)[1], place.entry((*array)[1], 1));
      if (!first || !second) return {};
      if (*first < *second) return Value{*first, *second};
      place.refuse(words(std::vector{*first, *second}), "[least, most] with least < most");
      return {};
    }
    place.refuse(found(node), "a list of two numbers, [least, most]");
    return {};
  }
};

/// The particles of one cell: natural coordinates in [0, 1], ascending, or their number n, which puts them at
/// (2i - 1)/(2n).
struct Particles {
  using Value = std::vector<double>;
  static constexpr const char* allowed =
      "a number of particles from 1 to 1000, or a list of natural coordinates in [0, 1], ascending";

  std::optional<Value> read(const toml::node& node, const Place& place) const {
    if (const auto* count = node.as_integer(); count && count->get() >= 1 && count->get() <= most_particles) {
      Value xi;
      for (std::int64_t i = 1; i <= count->get(); ++i)
        xi.push_back(static_cast<double>(2 * i - 1) / static_cast<double>(2 * count->get()));
      return xi;
    }
    const toml::array* array = node.as_array();
    if (!array || array->empty() || array->size() > most_particles) {
      place.refuse(found(node), allowed);
      return {};
    }
    Value xi;
    for (std::size_t i = 0; i < array->size(); ++i) {
      const toml::node& one = (*array)[i];
      const auto value = one.is_number() ? one.value<double>() : std::nullopt;
      if (!value || !(*value >= 0 && *value <= 1)) {
        place.entry(one, i).refuse(found(one), "natural coordinates of the cell, from 0 to 1");
        return {};
      }
      xi.push_back(*value);
    }
    if (std::adjacent_find(xi.begin(), xi.end(), std::greater_equal<>()) == xi.end()) return xi;
    place.refuse(words(xi), "natural coordinates in ascending order, each once");
    return {};
  }
};

// ---- tables -----------------------------------------------------------------------------------------------------

/// One table of the file. It remembers which keys were asked for: the others are unknown, so the schema cannot drift
/// from the reading.
class Table {
 public:
  Table(const toml::table& table, const Place& place, std::string prefix)
      : table_(table), place_(place), prefix_(std::move(prefix)) {}

  /// Here, or where the key stands if it is there.
  Place place(const std::string& key) const {
    const toml::node* node = table_.get(key);
    const bool known = node && node->source().begin.line > 0;
    return {place_.mistakes, known ? node->source().begin : place_.at, prefix_ + key};
  }
  const Place& place() const { return place_; }
  Place& place() { return place_; }
  void rename(std::string prefix) { prefix_ = std::move(prefix); }
  bool has(const std::string& key) const { return table_.contains(key); }
  const toml::node* node(const std::string& key) {
    known_.insert(key);
    return table_.get(key);
  }
  const toml::table& raw() const { return table_; }

  template <class Rule>
  std::optional<typename Rule::Value> maybe(const std::string& key, const Rule& rule) {
    const toml::node* value = node(key);
    if (!value) return {};
    return rule.read(*value, place(key));
  }
  template <class Rule>
  typename Rule::Value get(const std::string& key, const Rule& rule, const typename Rule::Value& otherwise = {}) {
    return maybe(key, rule).value_or(otherwise);
  }
  /// A missing key is a mistake, too.
  template <class Rule>
  std::optional<typename Rule::Value> must(const std::string& key, const Rule& rule) {
    if (!has(key)) missing(key, rule);
    return maybe(key, rule);
  }
  /// An empty value (0, "", {}) where it is missing or wrong.
  template <class Rule>
  typename Rule::Value need(const std::string& key, const Rule& rule) {
    return must(key, rule).value_or(typename Rule::Value{});
  }

  /// Whether `key` belongs to what was `chosen` for `choice`; if it does not but is there, that is a mistake.
  bool applies(const std::string& key, const std::string& choice, const std::string& chosen, const Names& owners) {
    known_.insert(key);
    if (contains(owners, chosen)) return true;
    if (has(key) && !chosen.empty())
      place(key).say("found, but it does not belong to " + choice + " = " + words(chosen) + "; allowed: with " +
                     choice + " = " + joined(owners));
    return false;
  }

  std::optional<Table> sub(const std::string& key, bool needed) {
    const toml::node* value = node(key);
    if (!value) {
      if (needed) place_.mistakes->add(place_.at, prefix_ + key + ": missing; allowed: a table [" + key + "]");
      return {};
    }
    if (value->is_table()) return Table(*value->as_table(), place(key), prefix_ + key + '.');
    place(key).refuse(found(*value), "one table [" + key + "]");
    return {};
  }

  /// The entries of [[key]], numbered from 1 until they have a name; where `alone`, [key] stands for one of them.
  std::vector<Table> each(const std::string& key, bool alone = false) {
    std::vector<Table> entries;
    const toml::node* value = node(key);
    if (!value) return entries;
    if (alone && value->is_table()) {
      entries.emplace_back(*value->as_table(), place(key), prefix_ + key + '.');
      return entries;
    }
    const toml::array* array = value->as_array();
    if (!array) {
      place(key).refuse(found(*value), "[[" + key + "]] in double brackets, or a list of tables");
      return entries;
    }
    for (std::size_t i = 0; i < array->size(); ++i) {
      const toml::node& entry = (*array)[i];
      const std::string name = key + ' ' + std::to_string(i + 1);
      const Place here{place_.mistakes, entry.source().begin, name};
      if (entry.is_table()) entries.emplace_back(*entry.as_table(), here, name + ": ");
      else here.refuse(found(entry), "a table of keys");
    }
    return entries;
  }

  void refuse_other_keys() const {
    Names allowed(known_.begin(), known_.end());
    for (const auto& [key, value] : table_) {
      const std::string name(key.str());
      if (known_.count(name) != 0) continue;
      std::string hint = suggestion(name, allowed);
      if (name == "time_step" || name == "dt" || name == "timestep")
        hint = "the time step is courant * cell size / wave speed: set axes.courant, > 0";
      place_.mistakes->add(key.source().begin, prefix_ + name + ": found an unknown key" +
                                                   (value.is_value() ? " (= " + found(value) + ")" : "") +
                                                   "; allowed: " + plain(allowed) + (hint.empty() ? "" : "; " + hint));
    }
  }

 private:
  template <class Rule>
  void missing(const std::string& key, const Rule& rule) const {
    if constexpr (requires { rule.names; }) place(key).say("missing; allowed: " + joined(rule.names));
    else if constexpr (requires { rule.allowed(); }) place(key).say("missing; allowed: " + rule.allowed());
    else place(key).say("missing, and it is required");
  }

  const toml::table& table_;
  Place place_;
  std::string prefix_;
  std::set<std::string> known_;
};

/// A value with its unit, { value = 0.5, unit = "L/c" }.
struct WithUnit {
  Names units;
  Number number;
  using Value = Measured;

  std::string allowed() const {
    return "a value with its unit, { value = ..., unit = " + words(units.front()) + " }, units " + joined(units);
  }
  std::optional<Measured> read(const toml::node& node, const Place& place) const {
    const toml::table* table = node.as_table();
    if (!table) {
      place.refuse(node.is_number() ? found(node) + " without a unit" : found(node), allowed());
      return {};
    }
    Table t(*table, place, place.label + '.');
    Measured measured;
    measured.unit = t.need("unit", OneOf{units});
    const auto value = t.must("value", number);
    t.refuse_other_keys();
    if (!value || measured.unit.empty()) return {};
    measured.value = *value;
    return measured;
  }
};

/// Notes each of `values` that is not among `all`; an empty `all` has been reported already.
template <class Value>
bool among(const Place& place, const std::vector<Value>& values, const std::vector<Value>& all,
           const std::string& where) {
  bool good = true;
  for (const Value& value : values) {
    if (all.empty() || std::find(all.begin(), all.end(), value) != all.end()) continue;
    place.refuse(words(value), "values of " + where + ": " + joined(all));
    good = false;
  }
  return good;
}

template <class Entry>
void check_unique(std::map<std::string, unsigned>& seen, const Table& t, const Entry& entry) {
  if (entry.id.empty()) return;
  const Place place = t.place("id");
  const auto [first, is_new] = seen.emplace(entry.id, static_cast<unsigned>(place.at.line));
  if (!is_new)
    place.refuse(words(entry.id) + " again",
                 "an id of its own; line " + std::to_string(first->second) + " has this one");
}

template <class Entry, class Read>
std::vector<Entry> read_each(Table& file, const std::string& key, const Case& c, Read read) {
  std::vector<Entry> entries;
  std::map<std::string, unsigned> seen;
  for (Table& t : file.each(key)) {
    entries.push_back(read(t, c));
    if constexpr (requires(Entry e) { e.id; }) check_unique(seen, t, entries.back());
  }
  return entries;
}

// ---- physics of the checks --------------------------------------------------------------------------------------

bool bar_is_known(const Case& c) {
  const double speed = material::wave_speed(c.material);
  return c.length > 0 && std::isfinite(speed) && speed > 0;
}

/// The values of all blocks of axes together; none where the axes hold a mistake.
Axes all_axes(const Case& c) {
  Axes all;
  all.particles.clear();
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  for (const Axes& block : c.axes) {
    append(all.method, block.method);
    append(all.cells, block.cells);
    append(all.courant, block.courant);
    append(all.particles, block.particles);
  }
  const auto unique = [](auto& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
  };
  unique(all.method), unique(all.cells), unique(all.courant), unique(all.particles);
  return all;
}

/// The coarsest grid, 0 where it is not known.
int fewest_cells(const Case& c) {
  const std::vector<int> cells = all_axes(c).cells;
  return cells.empty() ? 0 : cells.front();
}

double seconds(double value, const std::string& unit, const Case& c) {
  return unit == "L/c" ? value * c.length / material::wave_speed(c.material) : value;
}

double end_time(const Case& c) { return c.times.empty() ? 0 : seconds(c.times.back(), c.time_unit, c); }

/// Compiles a formula of `variables` ("x", "t") and tries it at x in {0, L/2, L} and t in {0, the sample times}.
void check_expression(const Place& place, const std::string& text, const Names& variables, const Case& c) {
  if (text.empty()) return;
  const bool known = bar_is_known(c);
  std::map<std::string, double> constants = expression_constants(c);
  if (!known)  // reported already: any values will do to find the mistakes of the formula itself
    for (const char* name : {"L", "E", "rho", "c"}) constants[name] = 0.7;
  try {
    const Expression expression(text, variables, constants);
    if (!known) return;
    std::vector<double> xs{0}, ts{0};
    if (contains(variables, "x")) xs = {0, c.length / 2, c.length};
    if (contains(variables, "t"))
      for (const double time : c.times) ts.push_back(seconds(time, c.time_unit, c));
    for (const double x : xs) {
      for (const double t : ts) {
        const double first = variables.front() == "x" ? x : t;
        const double value = variables.size() == 1 ? expression(first) : expression(x, t);
        if (std::isfinite(value)) continue;
        std::string where;
        if (contains(variables, "x")) where = " x = " + words(x);
        if (contains(variables, "t")) where += (where.empty() ? " t = " : ", t = ") + words(t);
        place.say("found " + words(text) + ", which is " + (std::isnan(value) ? "NaN" : words(value)) + " at" + where +
                  "; allowed: finite values at x in {0, L/2, L} and t in {0, sample times}");
        return;
      }
    }
  } catch (const InputError& error) {
    place.say(error.what());
  }
}

std::string read_expression(Table& t, const std::string& key, const Names& variables, const Case& c) {
  const std::string text = t.get(key, formula);
  check_expression(t.place(key), text, variables, c);
  return text;
}

// ---- one function per table -------------------------------------------------------------------------------------

void read_bar(Table& t, Case& c) {
  c.length = t.need("length", positive);
  c.convected = t.get("displacements", OneOf{{"infinitesimal", "finite"}}) == "finite";
  t.refuse_other_keys();
}

void read_material(Table& t, Case& c) {
  const std::string model = t.need("model", OneOf{{"elastic", "hardening"}});
  const double E = t.need("E", positive);
  const double rho = t.need("rho", positive);
  c.material = material::Elastic{E, rho};
  const bool hardens = t.applies("E_t", "model", model, {"hardening"});
  if (t.applies("yield_stress", "model", model, {"hardening"}) && hardens) {
    const double E_t = t.need("E_t", not_negative);
    const double yield_stress = t.need("yield_stress", positive);
    if (E > 0 && E_t >= E) t.place("E_t").refuse(words(E_t), "0 <= E_t < E = " + words(E));
    c.material = material::Hardening{E, rho, E_t, yield_stress};
  }
  const double speed = material::wave_speed(c.material);
  if (E > 0 && rho > 0 && (!std::isfinite(speed) || speed <= 0))
    t.place("E").say("found E = " + words(E) + " and rho = " + words(rho) + ", whose wave speed sqrt(E/rho) is " +
                     words(speed) + "; allowed: a finite wave speed > 0");
  t.refuse_other_keys();
}

void read_supports(Table& t, Case& c) {
  const OneOf support{{"fixed", "free"}};
  c.left = t.need("left", support) == "fixed" ? Support::fixed : Support::free;
  c.right = t.need("right", support) == "fixed" ? Support::fixed : Support::free;
  t.refuse_other_keys();
}

void read_parameters(Table& t, Case& c) {
  Names reserved{"L", "E", "rho", "c", "pi", "x", "t", "_e", "_pi"};
  reserved.insert(reserved.end(), function_names().begin(), function_names().end());
  for (const auto& [key, value] : t.raw()) {
    const std::string name(key.str());
    const bool is_name = !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
                         name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") ==
                             std::string::npos;
    if (!is_name || contains(reserved, name))
      t.place(name).say(is_name ? "found a name that expressions have already; allowed: other names than " +
                                      plain(reserved)
                                : "found " + words(name) +
                                      " as a name; allowed: letters, digits and _, no digit first");
    const auto number = t.maybe(name, any_number);
    if (is_name && !contains(reserved, name)) c.parameters[name] = number.value_or(0.7);
  }
}

Probe read_probe(Table& t, const Case& c) {
  Probe probe;
  probe.id = t.need("id", Id{});
  probe.field = t.need("field", OneOf{fields});
  probe.at = t.need("at", WithUnit{length_units, not_negative});
  const std::string& unit = probe.at.unit;
  double whole = unit == "m" ? c.length : 1;
  if (unit == "cells") whole = fewest_cells(c);
  if (!unit.empty() && whole > 0 && probe.at.value > whole)
    t.place("at").refuse(words(probe.at.value) + ' ' + unit + ", outside the bar", "0 to " + words(whole) + ' ' + unit);
  t.refuse_other_keys();
  return probe;
}

void read_sample(Table& t, Case& c) {
  const std::string allowed = "times = { unit = \"L/c\", at = [0.5, 1.7] }, units " + joined(time_units);
  const toml::node* times = t.node("times");
  if (!times) t.place("times").say("missing; allowed: " + allowed);
  else if (!times->is_table())
    t.place("times").refuse(times->is_array() || times->is_number() ? "times without a unit" : found(*times), allowed);
  else if (auto s = t.sub("times", true)) {
    c.time_unit = s->need("unit", OneOf{time_units});
    c.times = s->need("at", ListOf<Number>{positive, false, false});
    if (std::adjacent_find(c.times.begin(), c.times.end(), std::greater_equal<>()) != c.times.end()) {
      s->place("at").refuse(words(c.times), "times in ascending order, each once");
      c.times.clear();
    }
    s->refuse_other_keys();
  }
  c.probes = read_each<Probe>(t, "probes", c, read_probe);
  t.refuse_other_keys();
}

Axes read_axes(Table& t) {
  const Number courant{0, false, true,
                       "the time step is courant * cell size / wave speed, and a time step of 0 gets nowhere"};
  Axes axes;
  axes.method = t.need("method", ListOf<OneOf>{{methods}});
  axes.cells = t.need("cells", ListOf<Whole>{{1, most_cells}});
  axes.courant = t.need("courant", ListOf<Number>{courant});
  axes.particles = t.get("particles", ListOf<Particles>{}, axes.particles);
  t.refuse_other_keys();
  return axes;
}

void check_steps(const Table& t, const Axes& axes, const Case& c) {
  if (c.times.empty() || !bar_is_known(c)) return;
  const double end = end_time(c) * material::wave_speed(c.material) / c.length;  // in L/c
  const double courant = *std::min_element(axes.courant.begin(), axes.courant.end());
  const int cells = *std::max_element(axes.cells.begin(), axes.cells.end());
  const double steps = end * cells / courant;
  if (!(steps <= most_steps))
    t.place("courant").say("found " + words(courant) + ", which needs " + words(steps) + " steps on " + words(cells) +
                           " cells; allowed: at most " + words(most_steps) + " steps");
}

LoadSpec read_load(Table& t, const Case& c) {
  LoadSpec load;
  const Names timed{"step", "ramp", "impulse"};
  const std::string at = t.need("at", OneOf{{"left", "right"}});
  load.end = at == "left" ? End::left : End::right;
  const bool fixed = (load.end == End::left ? c.left : c.right) == Support::fixed;
  if (!at.empty() && fixed)
    t.place("at").refuse("a load on the " + at + " end, which is fixed", "loads on free ends");

  load.history = t.need("history", OneOf{{"step", "ramp", "impulse", "expression"}});
  if (load.history == "expression") {
    load.expression = t.need("traction", formula);
    check_expression(t.place("traction"), load.expression, {"t"}, c);
  } else if (!load.history.empty()) {
    Number amplitude = any_number;
    amplitude.hint = "a formula of t needs history = \"expression\"";
    load.traction = t.need("traction", amplitude);
  } else {
    t.node("traction");
  }
  if (t.applies("start", "history", load.history, timed))
    load.start = t.get("start", WithUnit{time_units, not_negative}, load.start);
  if (t.applies("rise", "history", load.history, {"ramp"})) load.rise = t.need("rise", WithUnit{time_units, positive});
  if (t.applies("duration", "history", load.history, {"impulse"}))
    load.duration = t.need("duration", WithUnit{time_units, positive});

  const std::string transfer = t.get("transfer", OneOf{{"node", "boundary-layer"}}, "node");
  if (t.applies("thickness", "transfer", transfer, {"boundary-layer"})) {
    load.transfer = Transfer::boundary_layer;
    load.layer_thickness = t.need("thickness", WithUnit{{"cells", "m", "L"}, positive});
    const Measured& h = load.layer_thickness;
    double whole = h.unit == "m" ? c.length : 1;
    if (h.unit == "cells") whole = fewest_cells(c);
    if (whole > 0 && h.value > whole)
      t.place("thickness").refuse(words(h.value) + ' ' + h.unit, "at most the bar, " + words(whole) + ' ' + h.unit);
  }
  t.refuse_other_keys();
  return load;
}

void read_exact(Table& t, Case& c) {
  ExactSpec& exact = c.exact;
  exact.solution = t.need("solution", OneOf{{"bar-wave", "standing-mode", "expressions"},
                                            "without an exact solution leave out the whole table [exact]"});
  const auto of = [&](const char* key, const char* owner) {
    return t.applies(key, "solution", exact.solution, {owner});
  };
  if (of("mode", "standing-mode")) exact.mode = t.need("mode", Whole{1, 1000});
  if (of("amplitude", "standing-mode")) exact.amplitude = t.need("amplitude", not_zero);
  for (const auto& [key, text] : {std::pair("stress", &exact.stress), std::pair("velocity", &exact.velocity),
                                  std::pair("displacement", &exact.displacement)})
    if (of(key, "expressions")) *text = read_expression(t, key, {"x", "t"}, c);
  if (exact.solution == "expressions" && !t.has("stress") && !t.has("velocity") && !t.has("displacement"))
    t.place("solution").say("found \"expressions\" without one; allowed: at least one of the keys " + plain(fields));
  t.refuse_other_keys();
}

/// What the named solutions leave out, they cannot be compared with.
void check_solution(const Place& place, const Case& c) {
  const std::string& solution = c.exact.solution;
  if (solution != "bar-wave" && solution != "standing-mode") return;
  const auto refuse = [&](bool present, const std::string& what, const std::string& why) {
    if (present)
      place.say("found " + words(solution) + " together with " + what + "; " + why +
                "; allowed: leave that out, or give solution = \"expressions\"");
  };
  refuse(std::holds_alternative<material::Hardening>(c.material), "material.model = \"hardening\"",
         "its waves are elastic");
  refuse(!c.body_force.empty(), "[body_force]", "it knows no body force");
  if (solution == "standing-mode") {
    refuse(!c.loads.empty(), "[[load]]", "its ends carry no traction");
    refuse(!c.initial_velocity.empty() || !c.initial_stress.empty(), "[initial]",
           "the mode itself sets the initial velocity");
    return;
  }
  refuse(!c.initial_velocity.empty() || !c.initial_stress.empty(), "[initial]", "its bar starts from rest");
  bool pulls = false;
  for (const LoadSpec& load : c.loads) {
    refuse(load.history == "expression", "a load of history = \"expression\"", "its loads are step, ramp and impulse");
    pulls = pulls || load.traction != 0 || load.history == "expression";
  }
  if (!pulls)
    place.say("found \"bar-wave\" without a load; allowed: at least one [[load]] with a traction other than 0");
}

/// The keys of a table in sorted order, "key=value key=value", nested ones in brackets.
void declare(const toml::node& node, std::string& out, bool top = false) {
  if (const auto* table = node.as_table()) {
    if (!top) out += '{';
    bool first = true;
    for (const auto& [key, value] : *table) {  // toml++ keeps tables sorted by key
      if (!first) out += ' ';
      first = false;
      out.append(key.str()) += '=';
      declare(value, out);
    }
    if (!top) out += '}';
  } else if (const auto* array = node.as_array()) {
    out += '[';
    for (std::size_t i = 0; i < array->size(); ++i) {
      if (i > 0) out += ' ';
      declare((*array)[i], out);
    }
    out += ']';
  } else if (const auto number = node.is_number() ? node.value<double>() : std::nullopt) {
    out += words(*number);
  } else {
    out += found(node);
  }
}

/// Quantities that a gate of this kind may judge in this case.
Names quantities_of(const std::string& kind, const Case& c) {
  Names names;
  if (kind == "invariant") return invariants;
  if (kind == "limit") return {"critical_courant", "stable"};
  for (const std::string& field : fields)
    for (const std::string& norm : norms) names.push_back(field + '.' + norm);
  if (kind == "exact" || kind == "constant")
    for (const Probe& probe : c.probes) names.push_back("probe." + probe.id);
  return names;
}

void read_quantity(Table& t, GateSpec& gate, const Case& c) {
  const auto quantity = t.has("quantity") ? t.maybe("quantity", Text{}) : std::nullopt;
  if (!t.has("quantity")) t.need("quantity", OneOf{quantities_of(gate.kind, c)});
  if (!quantity || gate.kind.empty()) return;
  const Names allowed = quantities_of(gate.kind, c);
  if (contains(allowed, *quantity)) {
    gate.quantity = *quantity;
    return;
  }
  for (const char* other : {"exact", "order", "invariant", "limit"})
    if (contains(quantities_of(other, c), *quantity)) {
      t.place("quantity").refuse(words(*quantity) + ", which is not for kind = " + words(gate.kind), joined(allowed));
      return;
    }
  const bool probe = quantity->rfind("probe.", 0) == 0;
  t.place("quantity").refuse(words(*quantity), joined(allowed) + (probe ? " (probes are declared in [sample])" : ""),
                             suggestion(*quantity, allowed));
}

Where read_where(Table& t, const Case& c) {
  Where where;
  where.method = t.get("method", ListOf<OneOf>{{methods}, true});
  where.cells = t.get("cells", ListOf<Whole>{{1, most_cells}, true});
  where.courant = t.get("courant", ListOf<Number>{positive, true});
  if (const toml::node* node = t.node("particles")) {
    // [0.25, 0.75] is the one set of these two positions, [[0.25, 0.75], [0.5]] and [2, 1] are two sets.
    const toml::array* array = node->as_array();
    const bool one_set = !array || (!array->empty() && array->front().is_floating_point());
    if (!one_set) where.particles = t.get("particles", ListOf<Particles>{});
    else if (const auto set = t.maybe("particles", Particles{})) where.particles = {*set};
  }
  const Axes axes = all_axes(c);
  among(t.place("method"), where.method, axes.method, "axes.method");
  among(t.place("cells"), where.cells, axes.cells, "axes.cells");
  among(t.place("courant"), where.courant, axes.courant, "axes.courant");
  among(t.place("particles"), where.particles, axes.particles, "axes.particles");
  t.refuse_other_keys();
  return where;
}

/// The times of a gate or figure, all of them sampled.
std::vector<double> read_times(Table& t, const Case& c) {
  const auto times = t.get("times", ListOf<Number>{positive, false});
  among(t.place("times"), times, c.times, "sample.times.at");
  if (std::is_sorted(times.begin(), times.end())) return times;
  t.place("times").refuse(words(times), "times in ascending order");
  return {};
}

/// A norm of an error needs something exact to compare with.
void check_comparable(const Table& t, const GateSpec& gate, const Case& c) {
  if (gate.quantity.empty() || gate.quantity.rfind("probe.", 0) == 0) return;
  const std::string field = gate.quantity.substr(0, gate.quantity.find('.'));
  const ExactSpec& exact = c.exact;
  if (exact.solution == "none")
    t.place("quantity").refuse(words(gate.quantity) + " in a case without an exact solution",
                               joined(invariants) + " (kind invariant), or give [exact]");
  if (exact.solution != "expressions") return;
  const std::string& text = field == "stress"     ? exact.stress
                            : field == "velocity" ? exact.velocity
                                                  : exact.displacement;
  if (text.empty())
    t.place("quantity").refuse(words(gate.quantity), "fields that [exact] gives: exact." + field + " is missing");
}

/// The runs that a gate speaks of.
std::vector<Leaf> runs_of(const GateSpec& gate, const Case& c) {
  std::vector<Leaf> runs;
  for (const Leaf& leaf : leaves(c))
    if (matches(gate.where, leaf)) runs.push_back(leaf);
  return runs;
}

void check_theory(const Table& t, const GateSpec& gate, const Case& c) {
  const auto theory = std::find_if(theories.begin(), theories.end(),
                                   [&](const Theory& one) { return one.name == gate.predict; });
  if (theory == theories.end() || c.exact.solution.empty()) return;
  const Place place = t.place("predict");
  if (!theory->solution.empty() && theory->solution != c.exact.solution) {
    Names possible;
    for (const Theory& one : theories)
      if (one.solution == c.exact.solution) possible.push_back(one.name);
    place.refuse(words(gate.predict) + ", which is a theory of " + words(theory->solution),
                 possible.empty() ? "no such gate: exact.solution = " + words(c.exact.solution) + " has no theory"
                                  : joined(possible) + ", theories of exact.solution = " + words(c.exact.solution));
    return;
  }
  if (!gate.quantity.empty() && !theory->quantities.empty() && !contains(theory->quantities, gate.quantity))
    place.refuse(words(gate.predict) + " for " + words(gate.quantity), "for " + joined(theory->quantities));
  std::set<std::string> others;
  for (const Leaf& run : runs_of(gate, c))
    if (!contains(theory->methods, run.method)) others.insert(run.method);
  for (const std::string& method : others)
    place.refuse(words(gate.predict) + " for method " + words(method), "for " + joined(theory->methods),
                 "say so in where = { method = ... }");
  if (gate.predict != "end-equilibrium") return;
  const bool of_stress = std::any_of(c.probes.begin(), c.probes.end(), [&](const Probe& probe) {
    return gate.quantity == "probe." + probe.id && probe.field == "stress";
  });
  if (!gate.quantity.empty() && !of_stress)
    place.refuse("\"end-equilibrium\" for " + words(gate.quantity), "for probes of stress");
  const bool loaded = std::any_of(c.loads.begin(), c.loads.end(), [](const LoadSpec& load) {
    return load.history.empty() || load.history == "step" || load.history == "ramp";
  });
  if (!loaded) place.refuse("\"end-equilibrium\" without a steady load", "with a [[load]] of history step or ramp");
}

void check_order(const Table& t, const GateSpec& gate, const Case& c) {
  if (gate.band && !(gate.expect >= (*gate.band)[0] && gate.expect <= (*gate.band)[1]) && gate.expect)
    t.place("expect").refuse(words(*gate.expect), "an order within the band, " + words((*gate.band)[0]) + " to " +
                                                      words((*gate.band)[1]));
  std::map<std::string, std::size_t> meshes;  // of each series that differs in nothing else
  for (const Leaf& run : runs_of(gate, c))
    ++meshes[run.method + ", courant = " + words(run.courant) +
             (run.method == "fem" ? "" : ", particles = " + words(run.particles))];
  for (const auto& [series, count] : meshes) {
    if (count >= static_cast<std::size_t>(gate.levels_min)) continue;
    t.place("levels_min").refuse(std::to_string(count) + " values of cells for " + series,
                                 "at least levels_min = " + std::to_string(gate.levels_min));
    return;  // the other series differ in the same way
  }
}

GateSpec read_gate(Table& t, const Case& c) {
  GateSpec gate;
  gate.line = static_cast<int>(t.place().at.line);
  declare(t.raw(), gate.declaration, true);
  gate.id = t.need("id", Id{});
  if (!gate.id.empty()) {
    t.rename("gate " + words(gate.id) + ": ");
    t.place().label = "gate " + words(gate.id);
  }
  gate.kind = t.need("kind", OneOf{{"exact", "constant", "order", "invariant", "limit"}});
  gate.reason = t.need("reason", Text{});
  gate.slow = t.get("slow", Flag{});
  read_quantity(t, gate, c);
  const std::size_t before = t.place().mistakes->count();
  if (auto where = t.sub("where", false)) gate.where = read_where(*where, c);
  const bool where_is_read = t.place().mistakes->count() == before;

  const auto of = [&](const char* key, const Names& kinds) { return t.applies(key, "kind", gate.kind, kinds); };
  if (of("times", {"exact", "constant", "order", "invariant"})) gate.times = read_times(t, c);
  if (of("max", {"exact", "invariant"})) gate.max = t.must("max", not_negative);
  const bool limit = gate.kind == "limit";
  const auto of_limit = [&](const char* key, const char* quantity) {
    return t.applies(key, "quantity", gate.quantity, {quantity});
  };
  if (of("predict", {"constant", "limit"})) {
    if (!limit) {
      Names known;
      for (const Theory& theory : theories) known.push_back(theory.name);
      gate.predict = t.need("predict", OneOf{known});
      check_theory(t, gate, c);
    } else if (of_limit("predict", "critical_courant")) {
      gate.predict = t.need("predict", OneOf{{"stability-limit"}});
    }
  }
  if (of("ratio", {"constant", "limit"}) && (!limit || of_limit("ratio", "critical_courant")))
    gate.ratio = t.must("ratio", Interval{positive});
  if (of("outcome", {"limit"}) && of_limit("outcome", "stable")) gate.outcome = t.need("outcome", OneOf{{"unstable"}});
  if (of("steps", {"limit"})) gate.steps = t.get("steps", Whole{1, 1'000'000'000}, static_cast<int>(gate.steps));
  if (of("expect", {"order"})) gate.expect = t.must("expect", any_number);
  if (of("band", {"order"})) gate.band = t.must("band", Interval{});
  if (of("levels_min", {"order"})) gate.levels_min = t.get("levels_min", Whole{3, 100}, gate.levels_min);
  t.refuse_other_keys();

  if (gate.kind == "exact" || gate.kind == "constant" || gate.kind == "order") check_comparable(t, gate, c);
  const bool of_ledger = gate.quantity.rfind("energy.", 0) == 0 || gate.quantity.rfind("momentum.", 0) == 0;
  if (of_ledger && !c.ledger)
    t.place("quantity").refuse(words(gate.quantity) + " with run.ledger = false", "with the ledger, run.ledger = true");
  if (gate.kind == "order") check_order(t, gate, c);
  if (!c.axes.empty() && where_is_read && runs_of(gate, c).empty())
    t.place("where").say("found a combination of values that no run has; allowed: combinations within one [axes]");
  return gate;
}

FigureSpec read_figure(Table& t, const Case& c) {
  FigureSpec figure;
  figure.id = t.need("id", Id{});
  if (!figure.id.empty()) t.rename("figure " + words(figure.id) + ": ");
  figure.field = t.get("field", OneOf{fields}, figure.field);
  figure.times = read_times(t, c);
  figure.captions = t.get("captions", ListOf<Text>{{}, false, false});
  const std::size_t instants = figure.times.empty() ? c.times.size() : figure.times.size();
  if (!figure.captions.empty() && instants > 0 && figure.captions.size() != instants)
    t.place("captions").refuse(std::to_string(figure.captions.size()) + " captions",
                               "one for each of the " + std::to_string(instants) + " times");

  // An axis with one value need not be named again.
  const Axes axes = all_axes(c);
  const bool one_mesh = axes.cells.size() == 1, one_courant = axes.courant.size() == 1;
  figure.cells = t.has("cells") || !one_mesh ? t.need("cells", Whole{1, most_cells}) : axes.cells[0];
  figure.courant = t.has("courant") || !one_courant ? t.need("courant", positive) : axes.courant[0];
  figure.methods = t.get("methods", ListOf<OneOf>{{methods}}, axes.method);
  if (t.has("particles")) figure.particles = t.get("particles", Particles{});
  else if (axes.particles.size() == 1) figure.particles = axes.particles[0];
  bool good = figure.cells > 0 && figure.courant > 0 && !figure.particles.empty();
  if (figure.cells > 0) good &= among(t.place("cells"), std::vector{figure.cells}, axes.cells, "axes.cells");
  if (figure.courant > 0) good &= among(t.place("courant"), std::vector{figure.courant}, axes.courant, "axes.courant");
  good &= among(t.place("methods"), figure.methods, axes.method, "axes.method");
  if (!figure.particles.empty() && figure.methods != Names{"fem"}) {
    const std::vector<std::vector<double>> one_set{figure.particles};
    good &= among(t.place("particles"), one_set, axes.particles, "axes.particles");
  }
  figure.range = t.maybe("range", Interval{});
  const std::vector<Leaf> runs = leaves(c);
  for (const std::string& method : figure.methods) {
    const Leaf leaf{method, figure.cells, figure.courant, method == "fem" ? std::vector<double>{} : figure.particles};
    if (good && !runs.empty() && std::find(runs.begin(), runs.end(), leaf) == runs.end())
      t.place("methods").refuse(words(method) + " with cells = " + words(leaf.cells) + ", courant = " +
                                    words(leaf.courant) + " and particles = " + words(leaf.particles),
                                "a run of the axes");
  }
  t.refuse_other_keys();
  return figure;
}

// ---- what only the whole file can tell --------------------------------------------------------------------------

/// The features that the scene switches on, each with the key that does it.
std::map<std::string, std::string> features_in_use(const Case& c) {
  std::map<std::string, std::string> used;
  if (std::holds_alternative<material::Elastic>(c.material)) used["elastic"] = "material.model = \"elastic\"";
  else used["plasticity"] = "material.model = \"hardening\"";
  if (!c.body_force.empty()) used["body-force"] = "[body_force]";
  if (c.convected) used["convection"] = "bar.displacements = \"finite\"";
  for (const LoadSpec& load : c.loads)
    if (load.transfer == Transfer::boundary_layer) used["boundary-layer"] = "[[load]] transfer = \"boundary-layer\"";
  return used;
}

void check_features(const Place& place, const Case& c) {
  if (c.features.empty()) return;  // reported already
  const auto used = features_in_use(c);
  for (const auto& [feature, key] : used)
    if (!contains(c.features, feature))
      place.say("missing " + words(feature) + ", which " + key + " switches on; allowed: exactly the features in use");
  for (const std::string& feature : c.features)
    if (used.count(feature) == 0)
      place.say("found " + words(feature) + ", which nothing in the scene switches on; allowed: exactly the features "
                "in use");
}

void check_methods(const Table& t, const Axes& axes, const Case& c) {
  if (!contains(axes.method, "fem")) return;
  const auto used = features_in_use(c);
  for (const char* feature : {"boundary-layer", "convection"})
    if (const auto one = used.find(feature); one != used.end())
      t.place("method").refuse("\"fem\" together with " + one->second, "MPM methods only: mpm-usf, mpm-usl, mpm-musl");
}

/// Bands of slopes alone do not tell a right discontinuous solution from a wrong one.
void check_gates(const Place& place, const Case& c) {
  const auto any = [&](const Names& kinds) {
    return std::any_of(c.gates.begin(), c.gates.end(),
                       [&](const GateSpec& gate) { return gate.kind.empty() || contains(kinds, gate.kind); });
  };
  if (any({"order"}) && !any({"exact", "constant", "invariant"}))
    place.say("found order gates alone, which a wrong solution can pass; allowed: with a gate of kind exact, "
              "constant or invariant beside them");
}

Case read_file(Table& file, Mistakes& mistakes) {
  Case c;
  file.need("schema", Whole{1, 1});
  c.id = file.need("id", Id{});
  c.title = file.need("title", Text{});
  c.claim = file.need("claim", OneOf{claims});
  c.why = file.need("why", Text{});
  c.units = file.need("units", OneOf{{"SI", "paper"}});
  if (auto t = file.sub("paper", false)) {
    c.paper_figures = t->need("figures", ListOf<Text>{});
    t->refuse_other_keys();
  }
  if (auto t = file.sub("bar", true)) read_bar(*t, c);
  if (auto t = file.sub("material", true)) read_material(*t, c);
  if (auto t = file.sub("parameters", false)) read_parameters(*t, c);
  const std::size_t before_axes = mistakes.count();
  std::vector<Table> axes = file.each("axes", true);
  for (Table& t : axes) c.axes.push_back(read_axes(t));
  if (axes.empty() && mistakes.count() == before_axes) file.sub("axes", true);
  const std::vector<Axes> blocks = c.axes;
  if (mistakes.count() > before_axes) c.axes.clear();  // nothing is compared with axes that are not known
  if (auto t = file.sub("sample", true)) read_sample(*t, c);
  if (auto t = file.sub("supports", true)) read_supports(*t, c);

  const std::size_t before = mistakes.count();
  std::set<std::string> loaded;
  for (Table& t : file.each("load")) {
    c.loads.push_back(read_load(t, c));
    const auto end = t.raw().get("at") ? t.raw().get("at")->value<std::string>() : std::nullopt;
    if (end && !loaded.insert(*end).second)
      t.place("at").refuse("a second load on the " + *end + " end", "one load on each end");
  }
  const bool loads_are_read = mistakes.count() == before;
  if (auto t = file.sub("body_force", false)) {
    c.body_force = t->need("acceleration", formula);
    check_expression(t->place("acceleration"), c.body_force, {"x", "t"}, c);
    if (c.body_force.empty()) c.body_force = "0";  // refused already; the scene still asks for one
    t->refuse_other_keys();
  }
  if (auto t = file.sub("initial", false)) {
    c.initial_velocity = read_expression(*t, "velocity", {"x"}, c);
    c.initial_stress = read_expression(*t, "stress", {"x"}, c);
    if (!t->has("velocity") && !t->has("stress")) t->place().say("found no field; allowed: velocity, stress");
    t->refuse_other_keys();
  }
  if (auto t = file.sub("model", true)) {
    c.features = t->need("features", ListOf<OneOf>{{features}});
    std::sort(c.features.begin(), c.features.end());
    t->refuse_other_keys();
    check_features(t->place("features"), c);
  }
  if (auto t = file.sub("exact", false)) {
    read_exact(*t, c);
    if (loads_are_read) check_solution(t->place("solution"), c);
  }
  if (auto t = file.sub("run", false)) {
    c.allow_unstable = t->get("allow_unstable", Flag{}, false);
    c.ledger = t->get("ledger", Flag{}, true);
    t->refuse_other_keys();
  }
  c.gates = read_each<GateSpec>(file, "gate", c, read_gate);
  c.figures = read_each<FigureSpec>(file, "figure", c, read_figure);
  file.refuse_other_keys();

  if (!file.has("gate") || c.gates.empty())
    file.place("gate").say("missing; a case with no gate is an error; allowed: at least one [[gate]]");
  check_gates(file.place("gate"), c);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    check_methods(axes[i], blocks[i], c);
    if (!c.axes.empty()) check_steps(axes[i], blocks[i], c);
  }
  return c;
}

/// Letters that must change, move or go to turn one word into the other, upper and lower case being alike.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  const auto lower = [](char letter) { return std::tolower(static_cast<unsigned char>(letter)); };
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      const std::size_t change = lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& allowed) {
  if (word.empty() || word.size() > 80) return "";
  const std::size_t tolerated = word.size() < 2 ? 0 : word.size() < 5 ? 1 : word.size() < 9 ? 2 : 3;
  const auto same_start = [&](const std::string& name) {
    const auto end = std::mismatch(word.begin(), word.end(), name.begin(), name.end()).first;
    return end - word.begin();
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

std::map<std::string, double> expression_constants(const Case& c) {
  std::map<std::string, double> constants = c.parameters;
  constants["L"] = c.length;
  constants["E"] = material::youngs_modulus(c.material);
  constants["rho"] = material::density(c.material);
  constants["c"] = material::wave_speed(c.material);
  constants["pi"] = std::numbers::pi;
  return constants;
}

Case parse_case(const std::string& text, const std::filesystem::path& name) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw InputError(name.string() + ":1:1: found an empty file; allowed: a case, see cases/README.md");
  Mistakes mistakes(name.string());
  toml::table root;
  try {
    root = toml::parse(text);
  } catch (const toml::parse_error& error) {
    mistakes.add(error.source().begin, "not TOML: " + std::string(error.description()));
    mistakes.throw_if_any();
  }
  Table file(root, Place{&mistakes, {1, 1}, "file"}, "");
  Case c = read_file(file, mistakes);
  mistakes.throw_if_any();
  c.path = name;
  return c;
}

Case read_case(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& reason) {
    throw InputError(path.string() + ": cannot be read: " + reason);
  };
  std::error_code status;
  if (std::filesystem::is_directory(path, status)) fail("it is a directory; allowed: a case file (*.toml)");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(std::generic_category().message(errno));
  std::ostringstream text;
  text << in.rdbuf();
  if (in.bad()) fail(std::generic_category().message(errno));
  return parse_case(text.str(), path);
}

}  // namespace diptych::cases
