#include "runner/ablate/ablate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "runner/ablate/lacking.hpp"
#include "runner/ablate/readings.hpp"
#include "runner/ablate/revised.hpp"
#include "runner/ablate/strip.hpp"
#include "runner/input/messages.hpp"
#include "runner/input/plate_build.hpp"
#include "runner/run/runner.hpp"
#include "runner/trade/timing.hpp"
#include "runner/trade/trade.hpp"

namespace diptych::runner {
namespace {

using reports::AblatedQuantity;
using reports::Ablation;
using reports::AblationStudy;

/// A setting as the scene stands, and its runs from coarse to fine.
struct Standing {
  AblatedSetting setting;
  Case scene;
  std::vector<reports::Run> runs;
  const reports::Run& finest() const { return runs.back(); }
};

/// A changed scene that is to be run, or why it is not.
struct Alteration {
  Ablation ablation;
  std::optional<Case> scene;
  std::size_t of = 0;  ///< which setting
  bool another_exact = false;
  Axis strip = Axis::none;
};

bool has_exact(const Case& c) { return (c.plate ? c.plate->exact.solution : c.exact.solution) != "none"; }

/// A named solution of a plate that nothing else sets in motion is what gives it its start.
bool exact_starts_it(const Case& c) {
  return c.plate && c.plate->solid && plane_solution_of(*c.plate) && !c.plate->flyer && c.plate->loads.empty();
}

/// The changed scene at a time step within its limit, by a shorter one where need be.
Case within_limit(const Case& c, const AblatedSetting& setting, Revision& revision, const std::string& name) {
  std::vector<int> meshes{revision.cells > 0 ? revision.cells : setting.meshes.back()};
  if (revision.aid) meshes = setting.meshes;
  const auto read = [&] { return revised(c, setting.leaf, meshes, revision, name); };
  Case scene = read();
  const Leaf leaf = leaves(scene).back();
  const TimeStep step = step_of(*case_of(scene, leaf), leaf);
  if (!(step.asked > step.limit * (1 + round_off))) return scene;
  constexpr double margin = 0.9;  // of a limit that is an estimate with viscosity
  revision.courant *= margin * step.limit / step.asked;
  revision.says += fmt::format(", at {:.2g} times the time step: its limit is lower", revision.courant);
  return read();
}

/// The first line of what is wrong with a file, less its place there: the file on disk has no such line.
std::string first_reason(const std::string& message, const std::string& path) {
  const std::string line = message.substr(0, message.find('\n'));
  return line.starts_with(path + ':') ? line.substr(std::min(line.find(' ') + 1, line.size())) : line;
}

/// Reads the changed scene: with the exact solution where it is still that of the scene, else without.
Alteration alteration_of(const Case& c, const Standing& standing, std::size_t of, const std::string& part, bool added,
                         Revision revision) {
  Alteration trial;
  trial.of = of;
  Ablation& one = trial.ablation;
  one.part = part;
  one.added = added;
  one.aid = revision.aid;
  one.says = revision.says;
  if (!revision.impossible.empty()) {
    one.status = added ? "not tried" : "kept";
    one.message = revision.impossible;
    return trial;
  }
  std::vector<bool> with_exact{true};
  if (has_exact(c) && !exact_starts_it(c))
    with_exact = revision.another_exact ? std::vector{false} : std::vector{true, false};
  for (const bool keeps : with_exact) {
    Revision tried = revision;
    if (!keeps) tried.changes.push_back({"exact", {}});
    try {
      trial.scene = within_limit(c, standing.setting, tried, (added ? "with " : "without ") + part);
      trial.another_exact = revision.another_exact || !keeps;
      one.says = tried.says;
      return trial;
    } catch (const InputError& problem) {
      if (one.message.empty()) one.message = first_reason(problem.what(), c.path.string());
    }
  }
  one.status = "refused";
  return trial;
}

std::vector<const reports::Run*> completed_of(const std::vector<reports::Run>& runs) {
  std::vector<const reports::Run*> completed;
  for (const reports::Run& run : runs)
    if (point_of(run).completed()) completed.push_back(&run);
  return completed;
}

/// Runs the trials that have a scene and fills in what they say.
void run_trials(const std::vector<Standing>& all, const Running& running, std::vector<Alteration>& trials) {
  std::vector<Case> cases;
  std::vector<Alteration*> of_case;
  for (Alteration& trial : trials) {
    trial.ablation.run = all[trial.of].finest().label();
    trial.ablation.stands = point_of(all[trial.of].finest());
    if (!trial.scene) continue;
    if (!trial.ablation.stands.completed()) {
      trial.ablation.status = trial.ablation.stands.status == "cancelled" ? "cancelled" : "nothing to compare";
      trial.ablation.message = "as the scene stands its run is " + trial.ablation.stands.status;
      continue;
    }
    cases.push_back(*trial.scene);
    of_case.push_back(&trial);
  }
  const std::vector<reports::Case> results = run_cases(cases, running);
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Standing& standing = all[of_case[k]->of];
    Ablation& one = of_case[k]->ablation;
    const reports::Run& changed = results[k].runs.back();
    one.changed = point_of(changed);
    one.message.clear();
    one.status = one.changed.status;
    one.message = one.changed.message;
    if (one.message.starts_with("active features") && one.added) {
      one.status = "idle";
      one.message = "it never acts";
    }
    if (!one.completed()) continue;
    one.quantities = quantities_of(standing.scene, completed_of(standing.runs));
    compare(standing.scene, standing.finest(),
            {&*of_case[k]->scene, &changed, of_case[k]->another_exact, of_case[k]->strip}, one.quantities);
    if (!one.aid) continue;
    for (const AblatedQuantity& other : quantities_of(*of_case[k]->scene, completed_of(results[k].runs)))
      for (AblatedQuantity& own : one.quantities)
        if (own.quantity == other.quantity && (own.time == other.time || std::isnan(own.time)))
          own.uncertainty_changed = other.uncertainty * other.scale / own.scale;
  }
}

/// Fewer meshes where all runs together would cost more than they may.
void keep_within(double budget, const Case& c, AblatedSetting& setting, AblationStudy& study) {
  const double tried = static_cast<double>(features_of(c, setting.leaf).size() + lacking_rows().size());
  const auto work_on = [&](std::size_t finest) {
    double work = 0;
    Leaf leaf = setting.leaf;
    for (std::size_t k = 0; k <= finest; ++k) {
      leaf.cells = setting.meshes[k];
      work += updates_ahead(c, leaf) * (k == finest ? tried + 1 : 1);
    }
    return work;
  };
  std::size_t finest = setting.meshes.size() - 1;
  while (finest > 0 && work_on(finest) > budget) --finest;
  if (finest + 1 < setting.meshes.size())
    study.notes.push_back(
        fmt::format("{}: compared on {} cells: finer meshes of its {} would take more than {:.1e} "
                    "updates; --cells {} compares on the finest",
                    setting.leaf.method, setting.meshes[finest], setting.meshes.size(), budget, setting.meshes.back()));
  setting.meshes.resize(finest + 1);
  setting.leaf.cells = setting.meshes.back();
}

std::vector<Standing> standing_of(const Case& c, const AblationPlan& plan, const Running& running,
                                  AblationStudy& study) {
  std::vector<AblatedSetting> settings = settings_of(c, plan.scene, plan.cells);
  Names others;
  for (const Leaf& leaf : leaves(c))
    if (const std::string scene = parameters_label(leaf);
        scene != parameters_label(settings.front().leaf) && !contains(others, words(scene)))
      others.push_back(words(scene));
  if (plan.scene.empty() && !others.empty())
    study.notes.push_back(fmt::format("of its scenes the first, {}; with --scene one of {}",
                                      words(parameters_label(settings.front().leaf)), listed(others)));
  std::vector<Standing> all;
  std::vector<Case> cases;
  for (AblatedSetting& setting : settings) {
    if (plan.cells == 0) keep_within(plan.budget / static_cast<double>(settings.size()), c, setting, study);
    cases.push_back(revised(c, setting.leaf, setting.meshes, {}, ""));
    all.push_back({setting, cases.back(), {}});
  }
  const std::vector<reports::Case> results = run_cases(cases, running);
  for (std::size_t s = 0; s < all.size(); ++s) {
    all[s].runs = results[s].runs;
    const reports::TradePoint point = point_of(all[s].finest());
    if (!point.completed())
      study.notes.push_back(fmt::format("{} is {} as the scene stands{}{}", point.label, point.status,
                                        point.message.empty() ? "" : ": ", point.message));
  }
  return all;
}

/// Of one setting: each feature off, what it lacks, and one cell across where it does not vary.
void add_trials(const Case& c, const Standing& standing, std::size_t of, std::vector<Alteration>& trials) {
  const Leaf& leaf = standing.setting.leaf;
  const Case own = *case_of(c, leaf);
  for (const std::string& feature : features_of(c, leaf)) {
    Revision revision;
    if (const FeatureRow* row = find_feature(feature))
      revision = row->without(own, leaf);
    else
      revision.impossible = "no way to take it off is known";
    trials.push_back(alteration_of(c, standing, of, feature, false, revision));
  }
  for (const Axis axis : {Axis::y, Axis::x}) {
    const reports::Run& run = standing.finest();
    if (!c.plate || !point_of(run).completed()) continue;
    const std::optional<Revision> strip = strip_across(axis, own, leaf);
    if (!strip) continue;
    const std::string name = axis == Axis::y ? "y" : "x";
    const Variation found = variation_along(axis, run);
    Revision revision = *strip;
    constexpr double alike = 0.05;  // of the largest value: whether a strip does is for its run to say
    if (!(found.part <= alike))
      revision.impossible = fmt::format("the fields vary along {}, {} at t = {:g} {} by {:.3g} % of its largest value",
                                        name, found.field, found.time, c.time_unit, 100 * found.part);
    Alteration trial = alteration_of(c, standing, of, "cells along " + name, false, revision);
    trial.strip = axis;
    trials.push_back(std::move(trial));
  }
  for (const LackingRow& row : lacking_rows())
    if (const auto revision = row.with(own, leaf))
      trials.push_back(alteration_of(c, standing, of, row.id, true, *revision));
}

/// All in one go, so that what is compared is timed in the same rounds.
void time_trials(const std::vector<Standing>& all, int rounds, const Running& how, std::vector<Alteration>& trials) {
  std::vector<Case> cases;  // as they stand, then as altered
  for (const Standing& standing : all) cases.push_back(bare(standing.scene));
  std::vector<Alteration*> timed;
  for (Alteration& trial : trials) {
    if (!trial.ablation.completed()) continue;
    cases.push_back(bare(*trial.scene));
    timed.push_back(&trial);
  }
  std::vector<TimedRun> runs;
  for (const Case& c : cases) runs.push_back({&c, leaves(c).back()});
  const std::vector<reports::Timed> times = time_runs(runs, rounds, how.cancelled, how.progress);
  for (std::size_t k = 0; k < timed.size(); ++k) {
    timed[k]->ablation.stands.timed = times[timed[k]->of];
    timed[k]->ablation.changed.timed = times[all.size() + k];
  }
}

}  // namespace

AblationStudy ablate(const Case& c, const AblationPlan& plan, const Running& how) {
  AblationStudy study;
  study.case_id = c.id;
  study.title = c.title;
  study.time_unit = c.time_unit;
  Running running = how;
  running.keep_fields = true;
  running.books = Books::sums;  // the work of flow is theirs
  const std::vector<Standing> all = standing_of(c, plan, running, study);
  std::vector<Alteration> trials;
  for (std::size_t s = 0; s < all.size(); ++s) add_trials(c, all[s], s, trials);
  run_trials(all, running, trials);
  if (plan.rounds > 0) time_trials(all, plan.rounds, how, trials);
  for (Alteration& trial : trials) study.tried.push_back(std::move(trial.ablation));
  return study;
}

}  // namespace diptych::runner
