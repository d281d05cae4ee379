#include "hinge/solid/cracking_model.hpp"

#include <algorithm>

#include "hinge/wide.hpp"

namespace diptych::solid {
namespace {

/// Eqs. 23b to 23d of a run of cells. What the law asks of all of them alike is known to the compiler beforehand.
template <material::Plane plane, material::Closure closure>
DIPTYCH_WIDEST void stiffnesses(const material::TensileDamage& damage, std::size_t cells,
                                const double* __restrict crack_density, double* __restrict open_normal,
                                double* __restrict open_cross, double* __restrict open_shear,
                                double* __restrict closed_normal, double* __restrict closed_cross,
                                double* __restrict closed_shear) {
  material::TensileDamage law = damage;
  law.elastic.plane = plane;
  law.closure = closure;
#pragma GCC ivdep
  for (std::size_t i = 0; i < cells; ++i) {
    const material::CrackedStiffness now = law.damaged_stiffness(crack_density[i]);
    open_normal[i] = now.open.normal;
    open_cross[i] = now.open.cross;
    open_shear[i] = now.open.shear;
    closed_normal[i] = now.closed.normal;
    closed_cross[i] = now.closed.cross;
    closed_shear[i] = now.closed.shear;
  }
}

template <material::Plane plane>
auto stiffnesses_of(material::Closure closure) {
  using material::Closure;
  return closure == Closure::whole ? stiffnesses<plane, Closure::whole> : stiffnesses<plane, Closure::volumetric>;
}

}  // namespace

void Cracking::Model::renew(std::size_t first, std::size_t cells) {
  const auto renew_group = law_.elastic.plane == material::Plane::stress
                               ? stiffnesses_of<material::Plane::stress>(law_.closure)
                               : stiffnesses_of<material::Plane::strain>(law_.closure);
  constexpr std::size_t group = 64;  // cells far from the damage do not change from one step to the next
  for (const std::size_t end = first + cells; first < end; first += group) {
    const std::size_t count = std::min(group, end - first);
    const double* now = evolution_.crack_density().data() + first;
    double* standing = crack_density_.data() + first;
    if (std::equal(now, now + count, standing)) continue;
    std::copy_n(now, count, standing);
    renew_group(law_, count, now, &open_.normal[first], &open_.cross[first], &open_.shear[first],
                &closed_.normal[first], &closed_.cross[first], &closed_.shear[first]);
  }
}

}  // namespace diptych::solid
