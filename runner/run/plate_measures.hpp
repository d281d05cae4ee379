// What is measured on the fields of a plate.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analytic/plane_exact.hpp"
#include "hinge/diffusion/concentration.hpp"
#include "hinge/scene/plate.hpp"
#include "reports/results.hpp"
#include "runner/compare/norms.hpp"
#include "runner/diffusion_alone.hpp"
#include "runner/input/build.hpp"
#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"

namespace diptych::runner {

/// Mean norms over the points, weighed by the areas they stand for, of the error's length divided by the solution's
/// scale: L1 ≤ L2 ≤ L∞. Points nearer to the origin than `core` are left out. NaN anywhere makes all three NaN.
Norms plane_error(const PointField&, const analytic::PlaneSolution&, analytic::PlaneQuantity, double core);

PointField nodes_as_points(const diffusion::Grid&, const std::vector<double>& values, double time);

reports::PlateFields damage_fields(const Case&, const diffusion::Grid&, const PlateSnapshot&);
reports::ProbeValue read_plate_probe(const Case&, const diffusion::Grid&, const PlateProbe&, const PlateSnapshot&,
                                     const std::optional<reports::PlateFields>&, const reports::Curve& platen);
/// elements: the points are those of triangles, four a cell; else particles.
std::vector<reports::VtuPiece> vtu_fields(const diffusion::Grid&, bool elements, const PlateSnapshot&);

/// "numbers.largest": the largest magnitude of all sampled numbers. "area.error": what the points stand for less the
/// plate's area, as a part of it. "concentration.balance": ∫C dA at the end less what the source has given, of the
/// latter. "concentration.least": the least value of C met at sample times, of the largest.
void measure_fields(const Case&, const diffusion::Grid&, const PlateRecord&, reports::Run&);

/// All lengths, moduli, densities and stresses of an elastic plate multiplied.
Plate scaled(const Plate&, const PowersOfTwo&);
/// The plate seen from behind: x → width − x.
Plate mirrored(const Plate&);
/// Numbers that differ between two records after scaling; a different number of samples counts as one more. NaN where
/// there are only zeros.
double differing(const PlateRecord&, const PlateRecord&, const PowersOfTwo&, bool mirror);

}  // namespace diptych::runner
