// Features that a case may declare, and what a case file is without each of them.
#pragma once

#include <string>
#include <vector>

#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"
#include "runner/input/toml_table.hpp"

namespace diptych::runner {

/// Keys of a case's file set otherwise, and what is then no longer, or newly, declared.
struct Revision {
  std::string says = {};             ///< "[viscosity] taken out", for people
  std::vector<Change> changes = {};  ///< but for model.features, which follows from the next two
  Names drops = {}, adds = {};       ///< features
  bool another_exact = false;        ///< the case's exact solution is not that of this scene
  std::string impossible = {};       ///< why there is no such scene; then the rest means nothing
  bool aid = false;                  ///< of the numbers alone: run on all meshes, to see how uncertain they are with it
  double courant = 1;                ///< times the setting's
  int cells = 0;                     ///< 0: the setting's
};

/// Of a scene that there is not.
Revision impossible(const std::string& why);

/// How a feature is taken off.
struct FeatureRow {
  std::string id;  ///< as model.features names it
  /// Of a case that declares it, as the leaf has it: no variants.
  Revision (*without)(const Case&, const Leaf&);
};
const std::vector<FeatureRow>& feature_rows();
/// Nothing where no row has the id.
const FeatureRow* find_feature(const std::string& id);

/// The features of the scene that a leaf has, sorted.
Names features_of(const Case&, const Leaf&);

}  // namespace diptych::runner
