#include <stdexcept>

#include "hinge/solid/plate_models.hpp"
#include "mpm/plate_body.hpp"

namespace diptych::mpm {

PlateRecord run_moving(const Setup& setup) {
  return std::visit(
      [&]<class Solid>(const Solid& solid) -> PlateRecord {
        if constexpr (Solid::Model::staggered)
          throw std::logic_error("what changes in cells cannot go with particles that cross them");
        else
          return run_body<Moving>(setup, solid);
      },
      setup.plate.solid);
}

}  // namespace diptych::mpm
