#include "runner/ablate/features.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "runner/input/build.hpp"
#include "runner/input/messages.hpp"
#include "runner/input/plate_build.hpp"

namespace diptych::runner {
namespace {

/// The tables before `.key` in the file where it has this value: "material" or "bar[1].material" of material.model.
Names tables_with(const Case& c, const std::string& key, const std::string& value) {
  Names tables;
  for (const auto& [path, written] : c.scene)
    if (path.ends_with('.' + key) && written == words(value))
      tables.push_back(path.substr(0, path.size() - key.size() - 1));
  return tables;
}

/// The keys that the file has, of these in this table.
std::vector<Change> taken_out(const Case& c, const std::string& table, const Names& keys) {
  std::vector<Change> changes;
  for (const std::string& key : keys)
    if (c.scene.contains(table + '.' + key)) changes.push_back({table + '.' + key, {}});
  return changes;
}

bool has_table(const Case& c, const std::string& table) {
  return std::any_of(c.scene.begin(), c.scene.end(),
                     [&](const auto& one) { return one.first == table || one.first.starts_with(table + '.'); });
}

/// Takes out the probes that read what is then no longer there.
void drop_probes(const Case& c, const Names& reads, Revision& revision) {
  Names ids;
  for (const PlateProbe& probe : c.plate_probes)
    if (contains(reads, probe.reads)) ids.push_back(probe.id);
  for (const std::string& id : ids) revision.changes.push_back({"sample.probes[" + id + ']', {}});
}

const Names read_of_cracks{"radius", "area", "largest", "acoustic-ratio", "acoustic-angle"};
const Names read_of_diffusion{"concentration", "total"};

// ---- one function a feature
// -------------------------------------------------------------------------------------------

Revision without_elastic(const Case&, const Leaf&) {
  return impossible("it is the law of the material; without it there is no stress");
}

Revision without_plasticity(const Case& c, const Leaf&) {
  Revision r{"the bars are elastic, with the same E", {}, {"plasticity"}, {"elastic"}, true, ""};
  for (const std::string& table : tables_with(c, "model", material::Hardening::model)) {
    r.changes.push_back({table + ".model", value_in(words(material::Elastic::model))});
    for (const Change& one : taken_out(c, table, {"E_t", "yield_stress"})) r.changes.push_back(one);
  }
  return r;
}

Revision without_viscosity(const Case&, const Leaf&) {
  return {"[viscosity] taken out", {{"viscosity", {}}}, {"viscosity"}, {}, false, ""};
}

Revision without_convection(const Case&, const Leaf&) {
  return {
      "displacements are infinitesimal: the material stays in its cells",
      {{"model.displacements", value_in("infinitesimal")}},
      {"convection"},
  };
}

Revision without_body_force(const Case&, const Leaf&) {
  return {"[body_force] taken out", {{"body_force", {}}}, {"body-force"}, {}, true, ""};
}

Revision without_boundary_layer(const Case& c, const Leaf&) {
  Revision r{"the load acts on the end's node", {}, {"boundary-layer"}, {}, false, ""};
  for (const std::string& table : tables_with(c, "transfer", "boundary-layer")) {
    r.changes.push_back({table + ".transfer", value_in("node")});
    r.changes.push_back({table + ".thickness", {}});
  }
  return r;
}

/// The first bar alone: nothing meets it.
Revision without_contact(const Case& c, const Leaf& leaf) {
  Revision r{"the first bar by itself, which nothing meets", {}, {"contact"}, {}, true, ""};
  for (std::size_t b = c.bars.size(); b-- > 1;) r.changes.push_back({fmt::format("bar[{}]", b), {}});
  const material::Material& first = c.first().material;
  for (const std::string& feature : c.features)  // of the other bars' laws
    if ((feature == material::Hardening::feature || feature == material::Elastic::feature) &&
        feature != material::feature(first))
      r.drops.push_back(feature);
  if (!contains(c.features, material::feature(first))) r.adds.push_back(material::feature(first));
  if (has_table(c, "contact")) r.changes.push_back({"contact", {}});
  if (c.scene.contains("supports.right") && c.right == Support::fixed)
    r.changes.push_back({"supports.right", value_in("free")});  // of the last bar, which is gone
  for (std::size_t k = c.loads.size(); k-- > 0;)
    if (c.loads[k].end == End::right) r.changes.push_back({fmt::format("load[{}]", k), {}});
  for (const Probe& probe : c.probes)
    if (length_of(c, probe.at, leaf.cells) > begins_of(c, leaf.cells).front() + c.first().length)
      r.changes.push_back({"sample.probes[" + probe.id + ']', {}});
  if (!c.from_contact) return r;
  Node::List at;
  for (const double time : c.times) at.push_back({{}, instant(c, leaf, time)});
  r.changes.push_back({"sample.times.from", {}});
  r.changes.push_back({"sample.times.unit", value_in("s")});
  r.changes.push_back({"sample.times.at", Node{{}, at}});
  return r;
}

Revision without_damage(const Case& c, const Leaf&) {
  Revision r{"the plate is elastic, with the same E and nu", {}, {"damage"}, {}, true, ""};
  if (contains(features_of(c, {}), "diffusion")) {
    r.says += "; with damage goes its diffusion";
    r.drops.push_back("diffusion");
  }
  r.adds = {"elastic"};
  r.changes = taken_out(c, "material", {"K_IC", "k", "m", "beta", "residual_stiffness", "closure", "volumetric"});
  r.changes.push_back({"material.model", value_in("elastic")});
  for (const char* table : {"damage", "diffusion"})
    if (has_table(c, table)) r.changes.push_back({table, {}});
  Names reads = read_of_cracks;
  reads.insert(reads.end(), read_of_diffusion.begin(), read_of_diffusion.end());
  drop_probes(c, reads, r);
  return r;
}

Revision without_failure_wave(const Case& c, const Leaf&) {
  Revision r{"the glass is elastic, with the same E and nu; with failure goes its diffusion",
             taken_out(c, "material", {"threshold", "f_max"}),
             {"failure-wave", "diffusion"},
             {"elastic"},
             true,
             ""};
  r.changes.push_back({"material.model", value_in("elastic")});
  r.changes.push_back({"diffusion", {}});
  if (c.scene.contains("initial.dilatancy")) r.changes.push_back({"initial.dilatancy", {}});
  drop_probes(c, read_of_diffusion, r);
  return r;
}

Revision without_diffusion(const Case& c, const Leaf&) {
  if (!c.plate->solid) return impossible("the scene is nothing but diffusion");
  if (c.plate->failing())  // its nodes keep their dilatancy, and none of it moves
    return {"d0 = 0: no dilatancy leaves the impact face", {{"diffusion.d0", Node{{}, 0.0}}}, {}, {}, true, ""};
  Revision r{
      "[diffusion] taken out: damage grows where the strain is", {{"diffusion", {}}}, {"diffusion"}, {}, true, ""};
  drop_probes(c, read_of_diffusion, r);
  return r;
}

Revision without_cone(const Case&, const Leaf&) {
  return {"material.compression taken out: nothing flows under pressure",
          {{"material.compression", {}}},
          {"compression-plasticity"},
          {},
          true,
          ""};
}

Revision without_platen(const Case& c, const Leaf&) {
  Revision r{"the side of the platen is free, under the same load", {}, {"platen"}, {}, true, ""};
  for (std::size_t side = 0; side < side_names.size(); ++side)
    if (c.plate->supports[side] == Edge::Support::platen)
      r.changes.push_back({"supports." + side_names[side], value_in("free")});
  drop_probes(c, {"platen"}, r);
  return r;
}

Revision without_pic(const Case&, const Leaf&) {
  return {"pic = 0: velocities are the particles' own (FLIP)", {{"model.pic", Node{{}, 0.0}}}, {"pic"}, {}, false, ""};
}

Revision without_impact(const Case&, const Leaf&) {
  return impossible("the flyer is what sets the scene in motion; without it nothing happens");
}

}  // namespace

Revision impossible(const std::string& why) {
  Revision none;
  none.impossible = why;
  return none;
}

const std::vector<FeatureRow>& feature_rows() {
  static const std::vector<FeatureRow> rows{
      {"elastic", without_elastic},
      {"plasticity", without_plasticity},
      {"viscosity", without_viscosity},
      {"convection", without_convection},
      {"contact", without_contact},
      {"body-force", without_body_force},
      {"boundary-layer", without_boundary_layer},
      {"damage", without_damage},
      {"diffusion", without_diffusion},
      {"failure-wave", without_failure_wave},
      {"compression-plasticity", without_cone},
      {"platen", without_platen},
      {"pic", without_pic},
      {"impact", without_impact},
  };
  return rows;
}

const FeatureRow* find_feature(const std::string& id) {
  for (const FeatureRow& row : feature_rows())
    if (row.id == id) return &row;
  return nullptr;
}

Names features_of(const Case& c, const Leaf& leaf) {
  if (!c.plate) return c.features;
  Names features;
  for (const auto& feature : plate_features(*case_of(c, leaf))) features.push_back(feature.first);
  return features;
}

}  // namespace diptych::runner
