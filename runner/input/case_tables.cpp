// Rules and tables that cases of bars and of plates have in common.
#include "runner/input/case_tables.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>

#include "runner/input/expression.hpp"

namespace diptych::runner {

Rule<std::string> formula() { return text("an expression in quotes"); }

Rule<Measured> with_unit(const Names& units, const Rule<double>& number) {
  const std::string allowed =
      fmt::format("a value with its unit, {{ value = ..., unit = {} }}, units {}", words(units.front()), joined(units));
  return {[=](const Place& place) -> std::optional<Measured> {
            if (!place.node->as<Node::Entries>())
              return place.refuse(words(*place.node) + (place.node->is_number() ? " without a unit" : ""), allowed);
            Table t(place, place.label + '.');
            const std::string unit = t.need("unit", one_of(units));
            const auto value = t.must("value", number);
            t.refuse_other_keys();
            return value && !unit.empty() ? std::optional(Measured{*value, unit}) : std::nullopt;
          },
          "; allowed: " + allowed};
}

Rule<std::string> constant_formula() {
  return {[](const Place& place) -> std::optional<std::string> {
    if (place.node->is_number()) {
      const auto value = any_number().read(place);
      return value ? std::optional(words(*value)) : std::nullopt;
    }
    return text("a number, or an expression of parameters in quotes").read(place);
  }};
}

Rule<int> number_of_cells() { return whole(1, 10'000'000); }

Rule<std::vector<double>> particles() {
  return {[](const Place& place) -> std::optional<std::vector<double>> {
    constexpr int most = 1000;
    std::vector<double> xi;
    if (const auto* n = place.node->as<std::int64_t>(); n && *n >= 1 && *n <= most) {
      for (int i = 1; i <= *n; ++i) xi.push_back((2 * i - 1) / (2.0 * static_cast<double>(*n)));
      return xi;
    }
    const auto* list = place.node->as<Node::List>();
    if (!list || list->empty() || list->size() > most)
      return place.refuse_value(
          "a number of particles from 1 to 1000, or a list of natural coordinates in [0, 1], ascending");
    for (const Node& one : *list) {
      const auto value = one.number();
      constexpr double slack = 1e-12;  // a particle 1e-18 outside its cell is on the cell's face
      if (!value || !(*value >= -slack && *value <= 1 + slack))
        return place.entry(xi.size()).refuse_value("natural coordinates of the cell, from 0 to 1");
      xi.push_back(std::clamp(*value, 0.0, 1.0));
    }
    if (ascending(xi)) return xi;
    return place.refuse(words(xi), "natural coordinates in ascending order, each once");
  }};
}

void read_parameters(Table& t, Case& c) {
  Names reserved{"L", "E", "rho", "c", "pi", "x", "t", "_e", "_pi"};
  if (c.plate) reserved.insert(reserved.end(), {"Lx", "Ly", "nu", "c_d", "c_s", "y"});
  reserved.insert(reserved.end(), function_names().begin(), function_names().end());
  for (const auto& [name, at, value] : t.entries()) {
    const bool is_name =
        !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
        name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == std::string::npos;
    const bool is_free = !contains(reserved, name);
    if (!is_name)
      t.place(name).say("found " + words(name) + " as a name; allowed: letters, digits and _, no digit first");
    else if (!is_free)
      t.place(name).say(
          fmt::format("found a name that expressions have already; allowed: other names than {}", listed(reserved)));
    const double number = t.get(name, any_number(), 0.7);
    if (is_name && is_free) c.parameters[name] = number;
  }
}

std::vector<double> read_times(Table& t, const Case& c) {
  const auto times = t.get("times", set_of(any_number()));
  among(t.place("times"), times, c.times, "sample.times.at");
  if (ascending(times)) return times;
  t.place("times").refuse(words(times), "times in ascending order");
  return {};
}

std::map<std::string, std::vector<double>> read_values(Table& t, const Case& c) {
  std::map<std::string, std::vector<double>> values;
  Names known;
  for (const auto& [name, value] : c.parameters) known.push_back(name);
  for (const auto& entry : t.entries()) {
    if (c.parameters.contains(entry.key))
      values[entry.key] = t.get(entry.key, one_or_set_of(any_number()));
    else
      t.place(entry.key).refuse("no such parameter",
                                known.empty() ? "names of [parameters], of which there are none" : joined(known),
                                suggestion(entry.key, known));
  }
  return values;
}

bool among_swept(const Place& place, const std::map<std::string, std::vector<double>>& parameters, const Case& c) {
  if (c.axes.empty()) return true;  // reported already
  const Axes axes = all_axes(c);
  Names names;
  for (const auto& entry : axes.parameters) names.push_back(entry.first);
  bool good = true;
  for (const auto& [name, values] : parameters) {
    const auto swept = axes.parameters.find(name);
    if (swept != axes.parameters.end()) {
      good &= among(place, values, swept->second, "axes.parameters." + name);
      continue;
    }
    place.refuse(words(name) + ", which is not swept", names.empty() ? "no parameters here: no [axes] sweeps one"
                                                                     : "those that [axes] sweep: " + joined(names));
    good = false;
  }
  return good;
}

double read_solution_parameter(Table& t, const analytic::SolutionParameter& parameter) {
  using Rule = analytic::SolutionParameter::Rule;
  switch (parameter.rule) {
    case Rule::whole: return t.need(parameter.key, whole(1, 1000));
    case Rule::positive: return t.need(parameter.key, positive());
    case Rule::not_zero: return t.need(parameter.key, not_zero());
    case Rule::choice: break;
  }
  const std::string word = t.get(parameter.key, one_of(parameter.choices), parameter.choices.front());
  const auto place = std::find(parameter.choices.begin(), parameter.choices.end(), word);
  return static_cast<double>(place - parameter.choices.begin());
}

namespace {

Axes read_axes(Table& t, const Case& c, const Names& known_methods,
               const std::vector<std::vector<double>>& usual_particles) {
  Axes axes;
  axes.particles = usual_particles;
  axes.line = t.place("courant").at.line;
  axes.method = t.need("method", set_of(one_of(known_methods)));
  axes.cells = t.need("cells", set_of(number_of_cells()));
  axes.courant =
      t.need("courant",
             set_of(positive("the time step is courant * cell size / wave speed, and a time step of 0 gets nowhere")));
  axes.particles = t.get("particles", set_of(particles()), axes.particles);
  t.maybe_table("parameters", [&](Table& p) { axes.parameters = read_values(p, c); });
  if (c.plate) axes.variant = t.get("variant", set_of(one_of(variants_of(c))), axes.variant);
  return axes;
}

/// Of all blocks, those that two of them share counted twice: a double, so that no product is too large for it.
double number_of_runs(const std::vector<AxesBlock>& blocks) {
  double all = 0;
  for (const AxesBlock& block : blocks) {
    const Axes& axes = block.axes;
    double runs = 1;
    for (const std::size_t values :
         {axes.method.size(), axes.cells.size(), axes.courant.size(), axes.particles.size(), axes.variant.size()})
      runs *= static_cast<double>(values);
    for (const auto& [name, values] : axes.parameters) runs *= static_cast<double>(values.size());
    all += runs;
  }
  return all;
}

}  // namespace

std::vector<AxesBlock> read_all_axes(Table& file, Case& c, const Names& known_methods,
                                     const std::vector<std::vector<double>>& usual_particles) {
  std::vector<AxesBlock> blocks;
  const std::size_t before = file.mistakes();
  file.one_or_each("axes", [&](Table& t) {
    blocks.push_back({read_axes(t, c, known_methods, usual_particles), t.place("method"), t.place("courant")});
  });
  constexpr double most_runs = 10'000;
  if (const double runs = number_of_runs(blocks); runs > most_runs)
    file.place("axes").say(fmt::format("found {:g} runs; allowed: at most {:g} runs of a case", runs, most_runs));
  if (file.mistakes() == before)  // nothing is compared with axes that are not known
    for (const AxesBlock& block : blocks) c.axes.push_back(block.axes);
  return blocks;
}

}  // namespace diptych::runner
