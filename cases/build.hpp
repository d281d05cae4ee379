// From a case to what the solvers and the oracle take.
#pragma once

#include <memory>
#include <string>

#include "analytic/discrete.hpp"
#include "analytic/exact.hpp"
#include "cases/case.hpp"
#include "cases/leaf.hpp"
#include "material/scene.hpp"

namespace diptych::cases {

/// Case units per unit of time as written: 1 for "s", L/c for "L/c" [s].
double time_unit(const Case&, const std::string& unit);
/// A length as written, in case units, on a grid of `cells`.
double length_of(const Case&, const Measured&, int cells);

/// The scene of one run. Holds expressions of its own: make one for each thread.
Scene make_scene(const Case&, int cells);
/// The exact solution, or null where the case names none.
std::unique_ptr<analytic::ExactSolution> make_exact(const Case&);
/// The same scheme and grid as theory sees them.
analytic::Discretisation discretisation(const Case&, const Leaf&, double courant);

/// All lengths, times and stresses multiplied by powers of two: a run must answer with the same bits, scaled.
struct PowersOfTwo {
  double length = 2, modulus = 4, density = 16, stress = 32;  // so that no derived factor is 1
  double time() const;                                        ///< length·√(density/modulus)
  double velocity() const;                                    ///< stress/√(modulus·density)
  double displacement() const { return stress * length / modulus; }
};
Scene scaled(const Scene&, const PowersOfTwo&);
/// The bar seen from behind: x → L − x, velocities reversed.
Scene mirrored(const Scene&);

}  // namespace diptych::cases
