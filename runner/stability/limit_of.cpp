#include "runner/stability/limit_of.hpp"

#include <fmt/core.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runner/input/messages.hpp"
#include "runner/trade/errors.hpp"
#include "runner/trade/over.hpp"

namespace diptych::runner {
namespace {

std::string written_as(const LimitOf& what, double value) { return fmt::format("{}={}", what.key, value); }

std::vector<std::string> and_one(std::vector<std::string> over, const std::string& more) {
  over.push_back(more);
  return over;
}

}  // namespace

bool LimitOf::of_file() const { return key.find_first_of(".[") != std::string::npos; }

LimitOf limit_of(const Case& c, const std::string& text) {
  const std::size_t equals = text.find('=');
  const Names ends = equals == std::string::npos ? Names{} : parts_of(text.substr(equals + 1), ':');
  const auto least = ends.size() == 2 ? number_in(ends[0]) : std::nullopt;
  const auto most = ends.size() == 2 ? number_in(ends[1]) : std::nullopt;
  if (!least || !most || !(0 < *least && *least < *most))
    throw InputError(fmt::format("--limit-of: found {}; allowed: KEY=LEAST:MOST with 0 < LEAST < MOST", words(text)));
  LimitOf what{text.substr(0, equals), *least, *most};
  if (what.of_file()) {
    with_values(c, {written_as(what, *least)});  // a key that there is not is refused here, once
    return what;
  }
  Names keys{"courant"};
  for (const auto& [name, value] : c.parameters) keys.push_back(name);
  require_one_of("--limit-of", what.key, keys);
  return what;
}

Ceiling ceiling_of(const Case& c, const std::string& text) {
  const std::size_t equals = text.find('=');
  const auto most = equals == std::string::npos ? std::nullopt : number_in(text.substr(equals + 1));
  if (!most)
    throw InputError(fmt::format("--at-most: found {}; allowed: QUANTITY=NUMBER, as in probe.ID=0.5", words(text)));
  const Ceiling ceiling{text.substr(0, equals), *most};
  require_one_of("--at-most", ceiling.quantity, names_of_numbers(c));
  return ceiling;
}

void leave_to(const LimitOf& what, Case& c) {
  for (Axes& block : c.axes) {
    if (what.key == "courant") block.courant = {1};
    block.parameters.erase(what.key);
  }
}

Loaded with_value(const Case& c, const Leaf& leaf, const LimitOf& what, double value,
                  const std::vector<std::string>& over, std::size_t which) {
  Leaf one = leaf;
  if (what.of_file()) {
    const std::vector<Case> made = with_values(c, and_one(over, written_as(what, value)));
    const Case& changed = made.at(which);
    return {std::make_shared<const Case>(with_parameters(changed, one)), one};
  }
  if (what.key == "courant")
    one.courant = value;
  else
    one.parameters[what.key] = value;
  return {std::make_shared<const Case>(with_parameters(c, one)), one};
}

}  // namespace diptych::runner
