#include "hinge/solid/plate_models.hpp"

namespace diptych {

bool takes_viscosity(const PlateSolid& solid) {
  return solid::with_model(solid, []<class Model>() { return Model::takes_viscosity; });
}

bool changes_in_cells(const PlateSolid& solid) {
  return solid::with_model(solid, []<class Model>() { return Model::staggered; });
}

}  // namespace diptych
