// What a plate can be made of, as case files write it: one row a model.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hinge/diffusion/concentration.hpp"
#include "hinge/diffusion/dilatancy.hpp"
#include "hinge/material/compression.hpp"
#include "hinge/solid/plate_solid.hpp"
#include "runner/input/case.hpp"
#include "runner/input/toml_table.hpp"

namespace diptych::runner {

/// A material.model. A law that is new to case files is one more of these.
struct PlateModel {
  std::string name;     ///< in case files
  std::string feature;  ///< of its solid
  Names keys;           ///< of [material] that belong to it
  /// Reads these keys; the whole solid and the plasticity in compression are read already.
  PlateSolid (*read)(Table& material, const material::PlaneElastic&, const std::optional<material::Compression>&);
  /// Reads what else of the file belongs to its solid, and refuses what does not.
  void (*read_tables)(Table& file, Case&);
};
const std::vector<PlateModel>& plate_models();

/// [material].
void read_plate_material(Table&, Case&);
/// [damage] and [diffusion] of a plate with a material.
void read_solid_tables(Table& file, Case&);

diffusion::Scheme read_scheme(Table&, diffusion::Scheme usual);
diffusion::Reading read_reading(Table&);
/// How a dilatancy spreads: d0, profile and scheme.
diffusion::Spread read_spread(Table&);

}  // namespace diptych::runner
