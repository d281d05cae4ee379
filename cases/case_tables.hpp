// Readers of tables that cases of bars and of plates have in common.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "cases/case_checks.hpp"
#include "cases/toml_table.hpp"

namespace diptych::cases {

/// A value with its unit, { value = 0.5, unit = "L/c" }.
Rule<Measured> with_unit(const Names& units, const Rule<double>& number);
/// A formula in quotes.
Rule<std::string> formula();
/// A number, or a formula of parameters.
Rule<std::string> constant_formula();

void read_parameters(Table&, Case&);
/// [axes] or each [[axes]]: into the case where none holds a mistake. `particles`: where none are given.
struct AxesBlock {
  Axes axes;
  Place method, courant;
};
std::vector<AxesBlock> read_all_axes(Table& file, Case&, const Names& methods,
                                     const std::vector<std::vector<double>>& particles);
/// [run], [[gate]] and [[figure]], and what they need of each other.
void read_judgement(Table& file, Case&);

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

/// A case of a plate: all but what stands above it in read_file.
void read_plate_case(Table& file, Case&);

}  // namespace diptych::cases
