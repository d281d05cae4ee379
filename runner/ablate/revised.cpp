#include "runner/ablate/revised.hpp"

#include <algorithm>
#include <type_traits>

#include "runner/app/case_file.hpp"
#include "runner/input/messages.hpp"
#include "runner/run/run_leaf.hpp"

namespace diptych::runner {
namespace {

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

/// What the variant changes of the file, which then needs none.
std::vector<Change> variant_as_changes(const Case& c, const std::string& id) {
  std::vector<Change> changes;
  for (const PlateVariant& variant : c.variants)
    if (variant.id == id) changes = variant.changes;
  if (!c.variants.empty()) changes.push_back({"variant"});
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

}  // namespace

std::vector<AblatedSetting> settings_of(const Case& c, const std::string& wanted, int finest) {
  const std::vector<Leaf> all = leaves(c);
  Names scenes;
  for (const Leaf& leaf : all)
    if (const std::string name = parameters_label(leaf); !contains(scenes, name)) scenes.push_back(name);
  if (!wanted.empty()) require_one_of("--scene", wanted, scenes);
  const std::string scene = wanted.empty() ? scenes.front() : wanted;

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
    if (finest > 0) {
      std::erase_if(one.meshes, [&](int cells) { return cells >= finest; });
      one.meshes.push_back(finest);
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
  Leaf own = leaf;
  own.courant *= revision.courant;
  changes.push_back(axes_of(own, meshes));
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

}  // namespace diptych::runner
