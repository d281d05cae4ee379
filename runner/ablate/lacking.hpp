// What a scene may lack, and what its case file is with it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runner/ablate/features.hpp"

namespace diptych::runner {

struct LackingRow {
  std::string id;  ///< "viscosity"
  /// Of a case as the leaf has it. Nothing where the question does not arise: the scene has it, or is of another kind.
  std::optional<Revision> (*with)(const Case&, const Leaf&);
};
const std::vector<LackingRow>& lacking_rows();

}  // namespace diptych::runner
