#include "hinge/solid/cracking_model.hpp"

#include <algorithm>

#include "hinge/wide.hpp"

namespace diptych::solid {
namespace {

/// Eqs. 23b to 23d of a run of cells.
DIPTYCH_WIDEST void stiffnesses(const material::TensileDamage& damage, std::size_t cells,
                                const double* __restrict crack_density, double* __restrict open_normal,
                                double* __restrict open_cross, double* __restrict open_shear,
                                double* __restrict closed_normal, double* __restrict closed_cross,
                                double* __restrict closed_shear) {
  const material::TensileDamage law = damage;
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

}  // namespace

void Cracking::Model::renew(std::size_t first, std::size_t cells) {
  constexpr std::size_t group = 16;  // cells far from the damage do not change from one step to the next
  for (const std::size_t end = first + cells; first < end; first += group) {
    const std::size_t count = std::min(group, end - first);
    const double* now = evolution_.crack_density().data() + first;
    double* standing = crack_density_.data() + first;
    if (std::equal(now, now + count, standing)) continue;
    std::copy_n(now, count, standing);
    stiffnesses(law_, count, now, &open_.normal[first], &open_.cross[first], &open_.shear[first],
                &closed_.normal[first], &closed_.cross[first], &closed_.shear[first]);
  }
}

}  // namespace diptych::solid
