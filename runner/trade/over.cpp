#include "runner/trade/over.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "runner/app/case_file.hpp"
#include "runner/input/case_tables.hpp"
#include "runner/input/messages.hpp"

namespace diptych::runner {
namespace {

[[noreturn]] void refuse_values(const std::string& key, const std::string& found, const std::string& allowed) {
  throw InputError(fmt::format("--over {}: found {}; allowed: {}", key, words(found), allowed));
}

/// "0.1:0.95:8" or "0.5,0.9".
std::vector<double> numbers_in(const std::string& key, const std::string& text, bool by_ratio) {
  const bool span = text.find(':') != std::string::npos;
  std::vector<double> numbers;
  for (const std::string& part : parts_of(text, span ? ':' : ',')) {
    const auto value = number_in(part);
    if (!value) refuse_values(key, text, "numbers, as in 0.1,0.5 or FROM:TO:HOW-MANY");
    numbers.push_back(*value);
  }
  if (!span && !numbers.empty()) return numbers;
  constexpr double most = 1000;
  if (numbers.size() != 3 || !(numbers[2] >= 2 && numbers[2] <= most) || numbers[2] != std::floor(numbers[2]) ||
      (by_ratio && !(numbers[0] > 0 && numbers[1] > 0)))
    refuse_values(key, text, "numbers, as in 0.1,0.5 or FROM:TO:HOW-MANY with 2 to 1000 of them");
  std::vector<double> values;
  const int count = static_cast<int>(numbers[2]);
  for (int k = 0; k < count; ++k) {
    const double share = static_cast<double>(k) / (count - 1);
    const double value = by_ratio ? numbers[0] * std::pow(numbers[1] / numbers[0], share)
                                  : numbers[0] + (numbers[1] - numbers[0]) * share;
    values.push_back(number_in(fmt::format("{:.12g}", value)).value());  // 0.9, and not 0.9000000000000001
  }
  return values;
}

template <class Value>
void add_to(std::vector<Value>& axis, const std::vector<Value>& more) {
  for (const Value& value : more)
    if (std::find(axis.begin(), axis.end(), value) == axis.end()) axis.push_back(value);
}

void add_one(Case& c, const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string key = text.substr(0, equals);
  const std::string values = equals == std::string::npos ? "" : text.substr(equals + 1);
  Names keys{"cells", "courant", "method", "particles", "position"};
  for (const auto& [name, value] : c.parameters) keys.push_back(name);
  require_one_of("--over", key, keys);
  if (values.empty()) throw InputError(fmt::format("--over {0}: without values; allowed: {0}=VALUES", key));
  const auto each = [&](auto&& act) {
    for (Axes& block : c.axes) act(block);
  };
  if (key == "method") {
    const Names known = methods_of(c), given = parts_of(values, ',');
    for (const std::string& method : given) require_one_of("--over method", method, known);
    each([&](Axes& block) { add_to(block.method, given); });
  } else if (key == "cells") {
    const std::vector<int> given = whole_numbers_in(key, values, true);
    each([&](Axes& block) { add_to(block.cells, given); });
  } else if (key == "particles") {
    std::vector<std::vector<double>> given;
    for (const int count : whole_numbers_in(key, values, false)) {
      if (count > 16) refuse_values(key, values, "1 to 16 particles in each direction of a cell");
      std::vector<double> positions;
      for (int k = 0; k < count; ++k) positions.push_back((k + 0.5) / count);
      given.push_back(positions);
    }
    each([&](Axes& block) { add_to(block.particles, given); });
  } else if (key == "position") {
    std::vector<std::vector<double>> given;
    for (const double xi : numbers_in(key, values, false)) {
      if (!(xi >= 0 && xi <= 1)) refuse_values(key, values, "numbers from 0 to 1, the sides of the cell");
      given.push_back({xi});
    }
    each([&](Axes& block) { add_to(block.particles, given); });
  } else if (key == "courant") {
    const std::vector<double> given = numbers_in(key, values, false);
    for (const double value : given)
      if (!(value > 0)) refuse_values(key, values, "numbers > 0");
    each([&](Axes& block) { add_to(block.courant, given); });
  } else {
    const std::vector<double> given = numbers_in(key, values, false);
    each([&](Axes& block) {
      std::vector<double>& axis = block.parameters[key];
      if (axis.empty()) axis.push_back(c.parameters.at(key));
      add_to(axis, given);
    });
  }
}

}  // namespace

std::vector<int> whole_numbers_in(const std::string& key, const std::string& text, bool by_ratio) {
  std::vector<int> values;
  for (const double value : numbers_in(key, text, by_ratio)) {
    const double whole = by_ratio && text.find(':') != std::string::npos ? std::round(value) : value;
    if (!(whole >= 1 && whole <= 1e6) || whole != std::floor(whole))
      refuse_values(key, text, "whole numbers from 1 to 1000000");
    values.push_back(static_cast<int>(whole));
  }
  return values;
}

std::vector<Case> with_values(const Case& c, const std::vector<std::string>& over) {
  std::vector<std::vector<Change>> combinations{{}};
  std::vector<std::string> of_axes;
  for (const std::string& text : over) {
    const std::string key = text.substr(0, text.find('='));
    if (key.find_first_of(".[") == std::string::npos) {
      of_axes.push_back(text);
      continue;
    }
    const std::string values = text.size() > key.size() ? text.substr(key.size() + 1) : "";
    if (values.empty()) throw InputError(fmt::format("--over {0}: without values; allowed: {0}=VALUES", key));
    std::vector<std::string> given = parts_of(values, ',');
    if (values.find(':') != std::string::npos) {
      given.clear();
      for (const double value : numbers_in(key, values, false)) given.push_back(fmt::format("{}", value));
    }
    std::vector<std::vector<Change>> more;
    for (const std::vector<Change>& changes : combinations) {
      for (const std::string& value : given) {
        more.push_back(changes);
        more.back().push_back({key, value_in(value)});
      }
    }
    combinations = std::move(more);
  }
  std::vector<Case> cases;
  for (std::vector<Change>& changes : combinations) {
    cases.push_back(changes.empty() ? c : changed_case(c.path, changes));
    std::erase_if(changes, [](const Change& change) { return is_numerical(change.key); });
    cases.back().changed_scene = label_of(changes);
    add_values(cases.back(), of_axes);
  }
  return cases;
}

bool is_numerical(const std::string& key) {
  const std::size_t bracket = key.find('['), rest = key.find(']');
  const std::string plain = rest == key.npos ? key : key.substr(0, bracket) + key.substr(rest + 1);
  return plain == "viscosity" || plain.starts_with("viscosity.") ||
         contains({"diffusion.scheme", "diffusion.drift", "load.transfer", "load.thickness", "plate.cell_aspect",
                   "model.pic"},
                  plain);
}

void add_values(Case& c, const std::vector<std::string>& over) {
  for (const std::string& text : over) add_one(c, text);
  if (!over.empty()) c.allow_unstable = true;
}

}  // namespace diptych::runner
