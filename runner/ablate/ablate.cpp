#include "runner/ablate/ablate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <utility>

#include "runner/ablate/readings.hpp"
#include "runner/app/case_file.hpp"
#include "runner/input/messages.hpp"
#include "runner/run/runner.hpp"
#include "runner/trade/timing.hpp"
#include "runner/trade/trade.hpp"

namespace diptych::runner {
namespace {

using reports::Ablation;
using reports::AblationStudy;

template <class Value>
Node list_node(const std::vector<Value>& values) {
  Node::List list;
  for (const Value& value : values) {
    if constexpr (std::is_same_v<Value, int>)
      list.push_back({{}, std::int64_t{value}});
    else
      list.push_back({{}, value});
  }
  return {{}, std::move(list)};
}

/// A value as list --declarations writes it, whose lists have spaces between their entries.
Node declared_as(const std::string& text) {
  std::string toml;
  bool quoted = false;
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"' && (i == 0 || text[i - 1] != '\\')) quoted = !quoted;
    if (!quoted && text[i] == '[') ++depth;
    if (!quoted && text[i] == ']') --depth;
    toml += !quoted && depth > 0 && text[i] == ' ' ? ',' : text[i];
  }
  return value_in(toml);
}

/// What the variant changes of the file, which then needs none.
std::vector<Change> variant_as_changes(const Case& c, const std::string& id) {
  std::vector<Change> changes;
  if (!id.empty()) {
    const std::string table = "variant[" + id + "].";
    if (const auto without = c.scene.find(table + "without"); without != c.scene.end()) {
      const Node keys = declared_as(without->second);
      for (const Node& key : *keys.as<Node::List>()) changes.push_back({*key.as<std::string>(), {}});
    }
    const std::string set = table + "set.";
    for (const auto& [key, value] : c.scene)
      if (key.starts_with(set)) changes.push_back({key.substr(set.size()), declared_as(value)});
  }
  if (!c.variants.empty()) changes.push_back({"variant", {}});
  return changes;
}

/// [axes] of one setting on some meshes.
Change axes_of(const Leaf& leaf, const std::vector<int>& meshes) {
  Node::Entries axes;
  axes.push_back({"cells", {}, list_node(meshes)});
  axes.push_back({"courant", {}, list_node(std::vector{leaf.courant})});
  axes.push_back({"method", {}, list_node(std::vector{leaf.method})});
  if (!leaf.parameters.empty()) {
    Node::Entries swept;
    for (const auto& [name, value] : leaf.parameters) swept.push_back({name, {}, Node{{}, value}});
    axes.push_back({"parameters", {}, Node{{}, std::move(swept)}});
  }
  if (!leaf.particles.empty()) axes.push_back({"particles", {}, Node{{}, Node::List{list_node(leaf.particles)}}});
  return {"axes", Node{{}, std::move(axes)}};
}

/// The first line of what is wrong, less the place.
std::string first_line(const std::string& message) { return message.substr(0, message.find('\n')); }

/// A changed scene that is to be run, or why it is not.
struct Trial {
  Ablation ablation;
  std::optional<Case> scene;
  std::size_t setting = 0;
};

double predicted_work(const Case& c, const Leaf& leaf) {
  const auto own = case_of(c, leaf);
  const Outlook ahead = outlook(*own, leaf);
  return describe(*own, leaf).unknowns * ahead.duration / ahead.step.asked;
}

/// Reads the changed scene; without the exact solution where it is not that of the scene or does not take it.
void read_trial(const Case& c, const AblatedSetting& setting, Revision revision, const std::string& name,
                Trial& trial) {
  trial.ablation.says = revision.says;
  if (!revision.impossible.empty()) {
    trial.ablation.status = "kept";
    trial.ablation.message = revision.impossible;
    return;
  }
  const bool has_exact = c.exact.solution != "none" || (c.plate && c.plate->exact.solution != "none");
  const auto read = [&](bool with_exact) {
    Revision one = revision;
    if (has_exact && !with_exact) one.changes.push_back({"exact", {}});
    trial.scene = revised(c, setting.leaf, {setting.meshes.back()}, one, name);
    for (const Leaf& leaf : leaves(*trial.scene)) outlook(*case_of(*trial.scene, leaf), leaf);
  };
  std::vector<bool> ways{!revision.another_exact};
  if (has_exact) ways.push_back(revision.another_exact);
  for (const bool with_exact : ways) {
    try {
      read(with_exact);
      return;
    } catch (const InputError& problem) {
      trial.scene.reset();
      if (trial.ablation.message.empty()) trial.ablation.message = first_line(problem.what());
    }
  }
  trial.ablation.status = "refused";
}

}  // namespace

std::vector<AblatedSetting> settings_of(const Case& c, const AblationPlan& plan) {
  const std::vector<Leaf> all = leaves(c);
  Names scenes;
  for (const Leaf& leaf : all)
    if (const std::string name = parameters_label(leaf); !contains(scenes, name)) scenes.push_back(name);
  if (!plan.scene.empty()) require_one_of("--scene", plan.scene, scenes);
  const std::string scene = plan.scene.empty() ? scenes.front() : plan.scene;

  std::vector<AblatedSetting> settings;  // all of the scene
  for (const Leaf& leaf : all) {
    if (parameters_label(leaf) != scene) continue;
    const auto own = std::find_if(settings.begin(), settings.end(), [&](const AblatedSetting& one) {
      Leaf same = one.leaf;
      same.cells = leaf.cells;
      return same == leaf;
    });
    if (own == settings.end())
      settings.push_back({leaf, {leaf.cells}});
    else
      own->meshes.push_back(leaf.cells);
  }
  std::vector<AblatedSetting> chosen;  // one a method
  for (AblatedSetting& one : settings) {
    std::sort(one.meshes.begin(), one.meshes.end());
    const auto of_method = std::find_if(chosen.begin(), chosen.end(), [&](const AblatedSetting& other) {
      return other.leaf.method == one.leaf.method;
    });
    if (of_method == chosen.end())
      chosen.push_back(one);
    else if (one.meshes.size() > of_method->meshes.size())
      *of_method = one;
  }
  for (AblatedSetting& one : chosen) {
    if (plan.cells > 0) {
      std::erase_if(one.meshes, [&](int cells) { return cells >= plan.cells; });
      one.meshes.push_back(plan.cells);
    }
    one.leaf.cells = one.meshes.back();
    if (one.meshes.size() > 1 || one.meshes.back() < 2) continue;
    try {  // what it says about uncertainty is little, and more than nothing
      const int half = one.meshes.back() / 2;
      const Case coarse = revised(c, one.leaf, {half}, {}, "");
      for (const Leaf& leaf : leaves(coarse)) outlook(*case_of(coarse, leaf), leaf);
      one.meshes.insert(one.meshes.begin(), half);
    } catch (const InputError&) {
    }
  }
  return chosen;
}

Case revised(const Case& c, const Leaf& leaf, const std::vector<int>& meshes, const Revision& revision,
             const std::string& name) {
  std::vector<Change> changes = variant_as_changes(c, leaf.variant);
  changes.push_back(axes_of(leaf, meshes));
  changes.insert(changes.end(), revision.changes.begin(), revision.changes.end());
  Names features = features_of(c, leaf);
  std::erase_if(features, [&](const std::string& one) { return contains(revision.drops, one); });
  for (const std::string& one : revision.adds)
    if (!contains(features, one)) features.push_back(one);
  changes.push_back({"model.features", list_node(features)});
  Case scene = changed_case(c.path, changes);
  scene.changed = name;
  if (!leaf.variant.empty()) scene.changed = leaf.variant + (name.empty() ? "" : " " + name);
  return scene;
}

AblationStudy ablate(const Case& c, const AblationPlan& plan, const Running& how) {
  AblationStudy study;
  study.case_id = c.id;
  study.title = c.title;
  study.time_unit = c.time_unit;
  std::vector<AblatedSetting> settings = settings_of(c, plan);
  std::vector<Case> scenes;  // as they stand, one a setting; then changed
  std::vector<Trial> trials;
  for (std::size_t s = 0; s < settings.size(); ++s) {
    AblatedSetting& setting = settings[s];
    const Names features = features_of(c, setting.leaf);
    const auto work_on = [&](std::size_t finest) {
      double work = 0;
      Leaf leaf = setting.leaf;
      for (std::size_t k = 0; k <= finest; ++k) {
        leaf.cells = setting.meshes[k];
        work += predicted_work(c, leaf) * (k == finest ? static_cast<double>(features.size()) + 3 : 1);
      }
      return work;
    };
    std::size_t finest = setting.meshes.size() - 1;
    if (plan.cells == 0)
      while (finest > 0 && work_on(finest) > plan.budget / static_cast<double>(settings.size())) --finest;
    if (finest + 1 < setting.meshes.size())
      study.notes.push_back(fmt::format(
          "{}: on {} cells, the finest of {} that all runs together take about {:.0e} "
          "updates on; --cells {} compares on the finest",
          setting.leaf.method, setting.meshes[finest], setting.meshes.size(), plan.budget, setting.meshes.back()));
    setting.meshes.resize(finest + 1);
    setting.leaf.cells = setting.meshes.back();
    scenes.push_back(revised(c, setting.leaf, setting.meshes, {}, ""));
    for (const std::string& feature : features) {
      Trial trial;
      trial.setting = s;
      trial.ablation.part = feature;
      const FeatureRow* row = find_feature(feature);
      const Revision revision = row ? row->without(*case_of(c, setting.leaf), setting.leaf)
                                    : Revision{"", {}, {}, {}, false, "no way to take it off is known"};
      read_trial(c, setting, revision, "without " + feature, trial);
      trials.push_back(std::move(trial));
    }
  }

  std::vector<Case> cases = scenes;
  std::vector<std::size_t> of_case;  // the trial of each case after the scenes
  for (std::size_t t = 0; t < trials.size(); ++t) {
    if (!trials[t].scene) continue;
    cases.push_back(*trials[t].scene);
    of_case.push_back(t);
  }
  Running running = how;
  running.keep_fields = true;
  running.books = Books::sums;
  const std::vector<reports::Case> results = run_cases(cases, running);

  for (Trial& trial : trials) {
    Ablation& one = trial.ablation;
    const reports::Case& stands = results[trial.setting];
    one.run = stands.runs.back().label();
    one.stands = point_of(stands.runs.back());
  }
  for (std::size_t k = 0; k < of_case.size(); ++k) {
    Trial& trial = trials[of_case[k]];
    Ablation& one = trial.ablation;
    const reports::Run& changed = results[scenes.size() + k].runs.back();
    one.changed = point_of(changed);
    one.message.clear();
    const auto& runs = results[trial.setting].runs;
    std::vector<const reports::Run*> meshes;
    for (const reports::Run& run : runs)
      if (point_of(run).completed()) meshes.push_back(&run);
    if (!one.stands.completed()) {
      one.status = "nothing to compare";
      one.message = fmt::format("as the scene stands its run is {}: {}", one.stands.status, one.stands.message);
      continue;
    }
    one.status = one.changed.status;
    one.message = one.changed.message;
    if (!one.completed()) continue;
    one.quantities = quantities_of(scenes[trial.setting], meshes);
    compare(scenes[trial.setting], runs.back(), cases[scenes.size() + k], changed, one.quantities);
  }
  if (plan.rounds > 0) {
    for (Trial& trial : trials) {
      if (!trial.ablation.completed()) continue;
      const Leaf leaf = leaves(scenes[trial.setting]).back();
      trial.ablation.stands.timed =
          time_runs(bare(scenes[trial.setting]), {leaf}, plan.rounds, how.cancelled, {}).front();
      trial.ablation.changed.timed =
          time_runs(bare(*trial.scene), {leaves(*trial.scene).back()}, plan.rounds, how.cancelled, {}).front();
    }
  }
  for (Trial& trial : trials) study.tried.push_back(std::move(trial.ablation));
  return study;
}

}  // namespace diptych::runner
