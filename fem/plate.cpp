#include "fem/plate.hpp"

#include <variant>

#include "hinge/scene/plate_check.hpp"

namespace diptych::fem {

// In plate_solid.cpp.in, for each solid.
template <class Solid>
PlateRecord run_solid(const Plate&, const Solid&, const Cells&, const Stepping&);

PlateRecord run(const Plate& plate, const Cells& cells, const Stepping& stepping) {
  check(plate, cells);
  return std::visit([&](const auto& solid) { return run_solid(plate, solid, cells, stepping); }, plate.solid);
}

}  // namespace diptych::fem
