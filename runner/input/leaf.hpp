// One point of a case's sweep.
#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "reports/results.hpp"
#include "runner/input/case.hpp"
#include "runner/panel.hpp"

namespace diptych::runner {

struct Leaf {
  std::string method;
  int cells = 0;
  double courant = 0;
  std::vector<double> particles;  ///< empty for panels without any
  Parameters parameters = {};     ///< swept ones with their values
  std::string variant = {};       ///< of a plate
  auto operator<=>(const Leaf&) const = default;
};

SceneKind kind_of(const Case&);
/// Every run of the case once, in the order of its axes.
std::vector<Leaf> leaves(const Case&);
bool matches(const Where&, const Leaf&);
/// The case as this run has it: with the leaf's values of its parameters.
Case with_parameters(Case, const Leaf&);
/// Likewise; where the leaf changes nothing it is the case itself, which must then outlive it.
std::shared_ptr<const Case> case_of(const Case&, const Leaf&);
/// The case without its axes and what its gates declare, which grow with the number of runs and no run needs.
Case without_axes(const Case&);
/// "v0=0.1": the swept parameters.
std::string parameters_label(const Parameters&);
/// The same with the variant's name before them: what tells runs of one method and mesh apart.
std::string parameters_label(const Leaf&);
/// "0.5" or "0.25 0.75": how tables and figures name the particles of a cell.
std::string particles_label(const std::vector<double>&);

/// The leaves of a case by the labels of their runs, which are all that a run knows of its place in the sweep.
class Leaves {
 public:
  explicit Leaves(const Case&);
  const Leaf* of(const reports::Run&) const;  ///< null where it is none of the case's

 private:
  std::vector<Leaf> all_;
  std::map<std::string, std::size_t> by_label_;
};

}  // namespace diptych::runner
