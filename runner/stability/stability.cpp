#include "runner/stability/stability.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hinge/step/threads.hpp"
#include "runner/input/messages.hpp"
#include "runner/run/run_leaf.hpp"
#include "runner/stability/about_rest.hpp"
#include "runner/stability/at_rest.hpp"
#include "runner/stability/bracket.hpp"
#include "runner/stability/growth.hpp"
#include "runner/stability/limit_of.hpp"
#include "runner/stability/loaded.hpp"
#include "runner/trade/over.hpp"

namespace diptych::runner {
namespace {

struct Setting {
  const Case* whole;
  std::size_t which;  ///< of the cases that --over makes
  Leaf leaf;
  reports::StabilityLimit limit;
};

bool asks_for_cells(const std::vector<std::string>& over) {
  return std::any_of(over.begin(), over.end(), [](const std::string& text) { return text.starts_with("cells="); });
}

/// One mesh of each block, the coarsest that is not all border.
void thin_out(Case& c) {
  constexpr int enough = 4;
  for (Axes& block : c.axes) {
    int chosen = *std::max_element(block.cells.begin(), block.cells.end());
    for (const int count : block.cells)
      if (count >= enough) chosen = std::min(chosen, count);
    block.cells = {chosen};
  }
}

/// The number behind `begin` in one of the words of a label.
std::optional<double> number_after(const std::string& label, const std::string& begin) {
  for (const std::string& word : parts_of(label, ' '))
    if (const auto value = word.starts_with(begin) ? number_in(word.substr(begin.size())) : std::nullopt) return value;
  return {};
}

/// The value of an axis that a setting has; nothing where that is no number.
std::optional<double> axis_value(const std::string& axis, const Setting& setting) {
  const Leaf& leaf = setting.leaf;
  if (axis == "cells") return leaf.cells;
  if (axis == "particles" && !leaf.particles.empty()) return static_cast<double>(leaf.particles.size());
  if (axis == "position" && leaf.particles.size() == 1) return leaf.particles.front();
  const auto swept = leaf.parameters.find(axis);
  if (swept != leaf.parameters.end()) return swept->second;
  return number_after(setting.whole->changed, axis + "=");
}

/// The first axis of which the settings have more than one number: of what was asked for, of the case's parameters, of
/// the places of a cell's particle, of the cells.
std::string axis_of(const std::vector<Setting>& settings, const std::vector<std::string>& over) {
  Names candidates;
  for (const std::string& text : over) candidates.push_back(text.substr(0, text.find('=')));
  for (const Setting& setting : settings)
    for (const auto& [name, value] : setting.leaf.parameters) candidates.push_back(name);
  for (const char* name : {"position", "cells"}) candidates.emplace_back(name);
  for (const std::string& axis : candidates) {
    std::optional<double> first;
    for (const Setting& setting : settings) {
      const auto value = axis_value(axis, setting);
      if (value && first && *value != *first) return axis;
      if (!first) first = value;
    }
  }
  return {};
}

/// The label less the axis's word and the Courant number's.
std::string without_axis(const std::string& label, const std::string& axis) {
  const std::string named = axis == "cells" ? "N" : axis == "particles" || axis == "position" ? "ppc" : axis;
  Names kept;
  for (const std::string& word : parts_of(label, ' '))
    if (axis.empty() || !word.starts_with(named + "=")) kept.push_back(word);
  return listed(kept, " ");
}

void name_setting(const std::string& axis, bool at_courant, Setting& setting) {
  const reports::Run run = describe(*setting.whole, setting.leaf);
  Names kept;
  for (const std::string& word : parts_of(run.label(), ' '))
    if (at_courant || !word.starts_with("C=")) kept.push_back(word);
  reports::StabilityLimit& limit = setting.limit;
  limit.label = listed(kept, " ");
  limit.setting = without_axis(limit.label, axis);
  limit.method = run.method;
  limit.scene = without_axis(run.parameters, axis);
  if (!axis.empty()) limit.at = axis_value(axis, setting);
}

struct Range {
  double least, most;
};
Range range_tried(const Case& c) {
  // Diffusion numbers to 256 times forward Euler's limit on square cells.
  return kind_of(c) == SceneKind::diffusion ? Range{1e-3, 64} : Range{1e-3, 8};
}

constexpr long steps_about_rest = 2000;

void find_limit_about_rest(Setting& setting, const StabilityPlan& plan) {
  const auto c = case_of(*setting.whole, setting.leaf);
  reports::StabilityLimit& found = setting.limit;
  const Range range = range_tried(*c);
  found.theory = limit_about_rest(*c, setting.leaf);
  const auto stable = [&](double number) {
    if (plan.cancelled && *plan.cancelled) return false;
    try {
      const Growth growth =
          growth_about_rest(*c, setting.leaf, number, plan.steps.value_or(steps_about_rest), plan.cancelled);
      // The bracket's ends only move towards each other: what was seen last is of the nearest.
      (growth.unstable ? found.growth_above : found.growth_below) = growth.rate;
      if (growth.unstable) found.message.clear();
      return !growth.unstable;
    } catch (const std::invalid_argument& refusal) {
      found.growth_above.reset();
      found.message = fmt::format("at {:g} refused: {}", number, refusal.what());
      return false;
    }
  };
  const Bracket bracket = bracket_limit(stable, range.least, range.most);
  found.stable = bracket.stable;
  found.unstable = bracket.unstable;
}

void find_limit_of(Setting& setting, const StabilityPlan& plan, const LimitOf& what,
                   const std::optional<Ceiling>& ceiling) {
  reports::StabilityLimit& found = setting.limit;
  const auto stable = [&](double value) {
    if (plan.cancelled && *plan.cancelled) return false;
    const Loaded one = with_value(*setting.whole, setting.leaf, what, value, plan.over, setting.which);
    const LoadedRun run = run_loaded(*one.c, one.leaf, plan.steps, ceiling, plan.cancelled);
    (run.stable ? found.growth_below : found.growth_above) = run.rate;
    if (!run.stable) found.message = fmt::format("at {:.5g}: {}", value, run.why);
    return run.stable;
  };
  const Bracket bracket = bracket_between(stable, what.least, what.most);
  found.stable = bracket.stable;
  found.unstable = bracket.unstable;
}

/// What is said of how the limits were found.
void describe_about_rest(const Case& c, const StabilityPlan& plan, reports::StabilityMap& map) {
  const Range range = range_tried(c);
  map.least = range.least;
  map.most = range.most;
  map.number = kind_of(c) == SceneKind::diffusion ? "diffusion number d Δt/h²" : "Courant number c Δt/h";
  map.look_ahead = fmt::format("{} steps", plan.steps.value_or(steps_about_rest));
  map.followed = "small random motions of all points about rest, without loads";
  map.unstable = fmt::format(
      "their energy, as fitted over the second half of the look-ahead, would grow more than {:g}-fold over all of it",
      growth_of_instability);
}

void describe_limit_of(const Case& c, const StabilityPlan& plan, const LimitOf& what,
                       const std::optional<Ceiling>& ceiling, reports::StabilityMap& map) {
  map.least = what.least;
  map.most = what.most;
  map.number = what.key == "courant" ? "Courant number c Δt/h" : what.key;
  map.look_ahead = plan.steps ? fmt::format("{} steps", *plan.steps)
                              : fmt::format("the time to {:g} {}", c.times.back(), c.time_unit);
  map.followed = fmt::format(
      "the scene under its loads, and what becomes of velocities {:g} of the wave speed, random, on all its points",
      seed);
  map.unstable = fmt::format(
      "more energy than was put in, or (but where particles cross cells) the energy of those velocities, as fitted "
      "over "
      "the second half of the look-ahead, would grow more than {:g}-fold over all of it; invalid: points change places "
      "or leave the grid",
      growth_of_instability);
  if (ceiling) map.unstable += fmt::format("; or {} is more than {:g}", ceiling->quantity, ceiling->most);
}

}  // namespace

reports::StabilityMap stability_map(const Case& c, const StabilityPlan& plan) {
  if (!plan.at_most.empty() && plan.limit_of.empty())
    throw InputError("--at-most without --limit-of; allowed: both, or neither");
  const auto what = plan.limit_of.empty() ? std::nullopt : std::optional(limit_of(c, plan.limit_of));
  const auto ceiling = plan.at_most.empty() ? std::nullopt : std::optional(ceiling_of(c, plan.at_most));
  const std::string sought = what ? what->key : "courant";
  for (const std::string& text : plan.over)
    if (text.starts_with(sought + "="))
      throw InputError(fmt::format("--over {}: {} what is sought; allowed: any other key", text,
                                   sought == "courant" ? "Courant numbers are" : sought + " is"));
  std::vector<Case> cases = with_values(c, plan.over);
  std::vector<Setting> settings;
  for (std::size_t which = 0; which < cases.size(); ++which) {
    Case& one = cases[which];
    if (!asks_for_cells(plan.over)) thin_out(one);
    leave_to(what.value_or(LimitOf{sought}), one);
    for (const Leaf& leaf : leaves(one)) settings.push_back({&one, which, leaf, {}});
  }
  const std::string axis = axis_of(settings, plan.over);
  for (Setting& setting : settings) name_setting(axis, sought != "courant", setting);
  std::mutex telling;
  std::size_t done = 0;
  Threads(plan.threads).for_each(settings.size(), [&](std::size_t k) {
    try {
      if (what)
        find_limit_of(settings[k], plan, *what, ceiling);
      else
        find_limit_about_rest(settings[k], plan);
    } catch (const std::exception& problem) {
      settings[k].limit.message = problem.what();
    }
    const std::lock_guard<std::mutex> lock(telling);
    if (plan.progress) plan.progress(++done, settings.size());
  });

  reports::StabilityMap map;
  map.case_id = c.id;
  map.title = c.title;
  map.axis = axis;
  if (what)
    describe_limit_of(c, plan, *what, ceiling, map);
  else
    describe_about_rest(c, plan, map);
  for (Setting& setting : settings) map.limits.push_back(std::move(setting.limit));
  return map;
}

}  // namespace diptych::runner
