#include "runner/stability/stability.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <mutex>
#include <stdexcept>

#include "analytic/plane_discrete.hpp"
#include "hinge/step/threads.hpp"
#include "runner/input/messages.hpp"
#include "runner/input/plate_build.hpp"
#include "runner/run/built.hpp"
#include "runner/run/run_leaf.hpp"
#include "runner/stability/at_rest.hpp"
#include "runner/stability/bracket.hpp"
#include "runner/trade/over.hpp"

namespace diptych::runner {
namespace {

/// What the books of each step say that motion and strain hold.
template <class S, class R>
std::vector<double> followed_energies(const S&, const R& record) {
  std::vector<double> energies;
  for (const LedgerLine& line : record.ledger) energies.push_back(line.kinetic + std::abs(line.strain));
  return energies;
}

/// What diffuses has no energy; the sum of squares of its deviations from their mean stands for it.
std::vector<double> followed_energies(const DiffusionScene&, const PlateRecord& record) {
  std::vector<double> energies;
  for (const PlateSnapshot& snapshot : record.snapshots) {
    double sum = 0, squares = 0;
    for (const double value : snapshot.concentration) sum += value;
    const double mean = sum / static_cast<double>(snapshot.concentration.size());
    for (const double value : snapshot.concentration) squares += (value - mean) * (value - mean);
    energies.push_back(squares);
  }
  return energies;
}

template <class S>
constexpr bool has_books = !std::is_same_v<S, DiffusionScene>;

template <class S, class M, class R>
Growth followed(const LeafScene<S, M, R>& it, double number, long steps, const std::atomic<bool>* cancelled) {
  constexpr long samples = 200;  // of what has no books
  const long stride = has_books<S> ? 1 : std::max(1L, steps / samples);
  Stepping stepping;
  stepping.time_step = number * it.unit_time_step();
  stepping.gains = 1e30;  // what is looked at is growth without end, not whether a little is gained
  stepping.steps = steps;
  stepping.books = has_books<S> ? Books::lines : Books::off;
  stepping.cancelled = cancelled;
  if (!has_books<S>)
    for (long step = 0; step <= steps; step += stride) stepping.sample_after.push_back(step);
  const S scene = at_rest(it.scene);
  const R record = it.solver.run(scene, it.mesh, stepping);
  if (record.outcome == Outcome::left_grid) throw std::runtime_error(record.message);
  std::vector<double> energies = followed_energies(scene, record);
  std::erase_if(energies, [](double energy) { return !std::isfinite(energy); });
  Growth growth = growth_of(energies, stride, steps);
  // A million times what was put in, or no numbers any more.
  if (record.outcome == Outcome::unstable) growth.unstable = true;
  return growth;
}

// ---- theory ----

// Cells. Where an end is held the shortest wave is a little longer than two of them, by which the limit is higher: half
// a per cent for so many.
constexpr int long_enough = 16;

std::optional<double> theory_of(const BarLeaf& it) {
  const bool free_end = it.scene.left == Support::free || it.scene.right == Support::free;
  for (std::size_t bar = 0; bar < it.scene.bars.size(); ++bar)
    if (cells_of(it.scene, bar, it.mesh.cells) < long_enough) return {};
  if (it.scene.viscosity && it.scene.viscosity->form != material::Viscosity::Form::linear_quadratic) return {};
  // Held ends take the weak cell at a free one away.
  if (!free_end && it.row.particles) return {};
  return it.predicted_limit();
}

std::optional<double> theory_of(const PlateLeaf& it) {
  const auto all = [&](Edge::Support support) {
    return std::all_of(it.scene.edges.begin(), it.scene.edges.end(),
                       [&](const Edge& edge) { return edge.support == support; });
  };
  const bool free = all(Edge::Support::free), rollers = all(Edge::Support::roller);
  if (it.scene.pic > 0 || it.scene.viscosity || !(free || rollers)) return {};
  const auto scheme = plane_discretisation(*it.c.plate, it.leaf, it.asked_time_step());
  if (!scheme) return {};
  const analytic::PlaneMedium medium = medium_of(*it.c.plate);
  constexpr std::size_t most = 100;  // cells; the eigenvalues of more take minutes
  const diffusion::Grid& grid = it.mesh.grid;
  if (rollers && std::min(grid.nx, grid.ny) < long_enough) return {};
  const double limit = rollers                ? analytic::interior_stability_limit(medium, *scheme)
                       : grid.cells() <= most ? analytic::free_stability_limit(medium, *scheme, grid.nx, grid.ny)
                                              : analytic::plane_stability_limit(medium, *scheme);
  return limit / it.unit_time_step();
}

std::optional<double> theory_of(const DiffusionLeaf& it) {
  const DiffusivityRange range = range_of(it.scene, it.mesh);
  const double limit = it.limit();
  if (it.scene.spread || !(range.largest > 0) || !std::isfinite(limit)) return {};
  if (it.scene.reading != diffusion::Reading::isotropic) return {};
  for (int j = 0; j < it.mesh.ny; ++j)
    for (int i = 0; i < it.mesh.nx; ++i)
      if (it.scene.diffusivity((i + 0.5) * it.mesh.hx, (j + 0.5) * it.mesh.hy) != range.largest) return {};
  return limit / it.unit_time_step();
}

// ---- settings ----

struct Setting {
  const Case* whole;
  Leaf leaf;
  reports::StabilityLimit limit;
};

bool asks_for_cells(const std::vector<std::string>& over) {
  return std::any_of(over.begin(), over.end(), [](const std::string& text) { return text.starts_with("cells="); });
}

/// One Courant number of each block, which makes no difference; and, unless cells are asked for, one mesh, the coarsest
/// that is not all border.
void thin_out(Case& c, bool cells) {
  constexpr int enough = 4;
  for (Axes& block : c.axes) {
    block.courant = {1};
    if (cells) continue;
    int chosen = *std::max_element(block.cells.begin(), block.cells.end());
    for (const int count : block.cells)
      if (count >= enough) chosen = std::min(chosen, count);
    block.cells = {chosen};
  }
}

std::vector<std::string> words_between_spaces(const std::string& text) {
  std::vector<std::string> all;
  std::size_t from = 0;
  while (from < text.size()) {
    const std::size_t to = std::min(text.find(' ', from), text.size());
    if (to > from) all.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return all;
}

std::optional<double> number_after(const std::string& text, const std::string& begin) {
  for (const std::string& word : words_between_spaces(text)) {
    if (!word.starts_with(begin)) continue;
    double value = 0;
    const auto [end, problem] = std::from_chars(word.data() + begin.size(), word.data() + word.size(), value);
    if (problem == std::errc() && end == word.data() + word.size()) return value;
  }
  return {};
}

/// The value of an axis that a setting has; nothing where that is no number.
std::optional<double> value_of(const std::string& axis, const Setting& setting) {
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
      const auto value = value_of(axis, setting);
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
  for (const std::string& word : words_between_spaces(label))
    if (axis.empty() || !word.starts_with(named + "=")) kept.push_back(word);
  return listed(kept, " ");
}

void name(const std::string& axis, Setting& setting) {
  const reports::Run run = describe(*setting.whole, setting.leaf);
  Names kept;
  for (const std::string& word : words_between_spaces(run.label()))
    if (!word.starts_with("C=")) kept.push_back(word);
  reports::StabilityLimit& limit = setting.limit;
  limit.label = listed(kept, " ");
  limit.setting = without_axis(limit.label, axis);
  limit.method = run.method;
  limit.scene = without_axis(run.parameters, axis);
  if (!axis.empty()) limit.at = value_of(axis, setting);
}

struct Range {
  double least, most;
};
Range range_tried(const Case& c) {
  // Diffusion numbers to 256 times forward Euler's limit on square cells.
  return kind_of(c) == SceneKind::diffusion ? Range{1e-3, 64} : Range{1e-3, 8};
}

void find_limit(Setting& setting, const StabilityPlan& plan) {
  const auto c = case_of(*setting.whole, setting.leaf);
  reports::StabilityLimit& found = setting.limit;
  const Range range = range_tried(*c);
  built(*c, setting.leaf, [&](const auto& it) {
    found.theory = theory_of(it);
    std::optional<double> least_growing;
    const Bracket bracket = bracket_limit(
        [&](double number) {
          if (plan.cancelled && *plan.cancelled) return false;
          try {
            const Growth growth = followed(it, number, plan.steps, plan.cancelled);
            if (!growth.unstable)
              found.growth_below = growth.rate;  // the brackets' ends only move towards each other
            else
              found.growth_above = growth.rate;
            return !growth.unstable;
          } catch (const std::invalid_argument& refusal) {
            found.growth_above.reset();
            found.message = fmt::format("at {:g} refused: {}", number, refusal.what());
            return false;
          }
        },
        range.least, range.most);
    found.stable = bracket.stable;
    found.unstable = bracket.unstable;
    if (found.growth_above) found.message.clear();  // what is refused lies further up
  });
}

}  // namespace

Growth growth_about_rest(const Case& c, const Leaf& leaf, double number, long steps) {
  return built(c, leaf, [&](const auto& it) { return followed(it, number, steps, nullptr); });
}

std::optional<double> limit_about_rest(const Case& c, const Leaf& leaf) {
  return built(c, leaf, [&](const auto& it) { return theory_of(it); });
}

reports::StabilityMap stability_map(const Case& c, const StabilityPlan& plan) {
  for (const std::string& text : plan.over)
    if (text.starts_with("courant="))
      throw InputError(fmt::format("--over {}: Courant numbers are what is sought; allowed: any other key", text));
  std::vector<Case> cases = with_values(c, plan.over);
  std::vector<Setting> settings;
  for (Case& one : cases) {
    thin_out(one, asks_for_cells(plan.over));
    for (const Leaf& leaf : leaves(one)) settings.push_back({&one, leaf, {}});
  }
  const std::string axis = axis_of(settings, plan.over);
  for (Setting& setting : settings) name(axis, setting);
  std::mutex telling;
  std::size_t done = 0;
  Threads(plan.threads).for_each(settings.size(), [&](std::size_t k) {
    try {
      find_limit(settings[k], plan);
    } catch (const std::exception& problem) {
      settings[k].limit.message = problem.what();
    }
    const std::lock_guard<std::mutex> lock(telling);
    if (plan.progress) plan.progress(++done, settings.size());
  });

  const Range range = range_tried(c);
  reports::StabilityMap map{c.id,  c.title, {}, axis, plan.steps, range.least, range.most, growth_of_instability,
                            false, {}};
  map.number = kind_of(c) == SceneKind::diffusion ? "diffusion number d Δt/h²" : "Courant number c Δt/h";
  map.cancelled = plan.cancelled && *plan.cancelled;
  for (Setting& setting : settings) map.limits.push_back(std::move(setting.limit));
  return map;
}

}  // namespace diptych::runner
