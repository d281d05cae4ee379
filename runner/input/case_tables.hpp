// Readers of tables that cases of bars and of plates have in common.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "runner/input/case.hpp"
#include "runner/input/case_checks.hpp"
#include "runner/input/toml_table.hpp"

namespace diptych::runner {

/// A value with its unit, { value = 0.5, unit = "L/c" }.
Rule<Measured> with_unit(const Names& units, const Rule<double>& number);
/// A formula in quotes.
Rule<std::string> formula();
/// A number, or a formula of parameters.
Rule<std::string> constant_formula();

/// Cells along a bar or across a plate.
Rule<int> number_of_cells();
/// The particles of one cell: natural coordinates in [0, 1], ascending, or their number n, which puts them at
/// (2i - 1)/(2n).
Rule<std::vector<double>> particles();

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

void read_parameters(Table&, Case&);
/// The times of a gate or figure, all of them sampled.
std::vector<double> read_times(Table&, const Case&);
/// Values of parameters, { v0 = [0.1, 1.0] } or { v0 = 1.0 }.
std::map<std::string, std::vector<double>> read_values(Table&, const Case&);
/// Notes each parameter that is not swept and each value that no run has.
bool among_swept(const Place&, const std::map<std::string, std::vector<double>>& parameters, const Case&);

/// The value of a solution's key; 0 where it is missing or wrong.
double read_solution_parameter(Table&, const analytic::SolutionParameter&);
/// Keys of [exact] that belong to some solution of the rows: read for the one that was chosen, refused for the others.
/// One's own expressions may have those of `optional`.
template <class Rows>
analytic::SolutionParameters read_solution_parameters(Table& t, const std::string& chosen, const Rows& rows,
                                                      const Names& optional = {}) {
  std::vector<std::pair<analytic::SolutionParameter, Names>> keys;  // each with the solutions that have it
  for (const auto& row : rows) {
    for (const analytic::SolutionParameter& parameter : row.parameters) {
      const auto known =
          std::find_if(keys.begin(), keys.end(), [&](const auto& k) { return k.first.key == parameter.key; });
      (known == keys.end() ? keys.emplace_back(parameter, Names{}) : *known).second.push_back(row.name);
    }
  }
  analytic::SolutionParameters values;
  for (auto& [parameter, owners] : keys) {
    if (contains(optional, parameter.key)) owners.push_back("expressions");
    if (t.applies(parameter.key, "solution", chosen, owners) && (chosen != "expressions" || t.has(parameter.key)))
      values[parameter.key] = read_solution_parameter(t, parameter);
  }
  return values;
}

/// [axes] or each [[axes]]: into the case where none holds a mistake. `particles`: where none are given.
struct AxesBlock {
  Axes axes;
  Place method, courant;
};
std::vector<AxesBlock> read_all_axes(Table& file, Case&, const Names& methods,
                                     const std::vector<std::vector<double>>& particles);

/// Entries that each have an id of their own.
template <class Entry>
std::vector<Entry> read_each(Table& parent, const std::string& key, const Case& c, Entry (*read)(Table&, const Case&)) {
  std::vector<Entry> entries;
  std::map<std::string, unsigned> lines;
  parent.each(key, [&](Table& t) {
    entries.push_back(read(t, c));
    const std::string name = entries.back().id;
    const Place place = t.place("id");
    const auto [first, is_new] = lines.emplace(name, place.at.line);
    if (!is_new && !name.empty())
      place.refuse(words(name) + " again", "an id of its own; line " + std::to_string(first->second) + " has this one");
  });
  return entries;
}

/// A case of bars or of a plate: all that stands between the first tables of read_file and [run].
void read_bar_case(Table& file, Case&);
void read_plate_case(Table& file, Case&);

}  // namespace diptych::runner
