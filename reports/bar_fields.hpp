// The fields of bars as numbers, for a table of one's own or a figure made elsewhere.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace diptych::reports {

struct Case;
struct Run;

/// Fields of all bars at their points of one kind and at one time, [case units].
struct BarPoints {
  using Fields = std::map<std::string, std::vector<double>>;  ///< "displacement", "velocity", "stress": a value a point

  std::string kind;       ///< "nodes", "elements", "particles"
  std::vector<int> bar;   ///< of each point, from 1
  std::vector<double> x;  ///< reference coordinate
  Fields fields;
  Fields exact;  ///< of the same points; without those that the exact solution does not give
};

/// The run's fields at its points of one kind and all sample times, a line a point and time: "t [L/c],bar,x [m],
/// displacement [m],exact displacement [m],...".
std::string bar_fields_csv(const Case&, const Run&, const std::string& kind);

}  // namespace diptych::reports
