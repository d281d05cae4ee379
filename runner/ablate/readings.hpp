// What a run says: its numbers and its fields, how far they are from another run's, and how uncertain they are.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reports/ablation_results.hpp"
#include "reports/results.hpp"
#include "runner/input/case.hpp"

namespace diptych::runner {

/// A field of a run at its points and at one sample time.
struct PointValues {
  std::string name;                            ///< "stress"
  std::vector<double> x, y;                    ///< of bars y is their number
  std::vector<std::vector<double>> component;  ///< a list a component; the off-diagonal one of a stress counts twice
  std::vector<double> weight;                  ///< of each component, in the square of the length
  bool bars = false;

  double length(std::size_t point) const;  ///< of the value there
};

/// All fields that were kept, see Running::keep_fields.
std::vector<PointValues> fields_at(const reports::Sample&);

/// The largest length of each field's values at all sample times.
std::map<std::string, double> largest_lengths(const reports::Run&);

enum class Axis { none, x, y };

/// Mean norm (1/n Σ |a − b|²)^½ over those points of `a` at whose place `b` has some, too: there b's nearest value is
/// taken, and the mean of those that are equally near. NaN where there are none, or other components. With an axis
/// places count as the same wherever they lie along it.
double l2_distance(PointValues a, PointValues b, Axis regardless = Axis::none);

/// All quantities of the run on the finest of these meshes, with how uncertain they are; `meshes` are completed runs of
/// one setting on meshes that differ, from coarse to fine. The changed run's are not yet there.
std::vector<reports::AblatedQuantity> quantities_of(const Case&, const std::vector<const reports::Run*>& meshes);

/// How a run was changed, as against the scene as it stands.
struct ChangedRun {
  const Case* scene = nullptr;
  const reports::Run* run = nullptr;
  bool another_exact = false;  ///< its errors are not those of the same solution
  Axis strip = Axis::none;     ///< it is one cell across
};

/// Fills in what the changed run says of the quantities; those that the scene does not have as it stands come after.
void compare(const Case&, const reports::Run& stands, const ChangedRun&, std::vector<reports::AblatedQuantity>&);

}  // namespace diptych::runner
