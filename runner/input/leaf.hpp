// One point of a case's sweep.
#pragma once

#include <memory>
#include <string>
#include <vector>

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
  bool operator==(const Leaf&) const = default;
};

SceneKind kind_of(const Case&);
/// Every run of the case once, in the order of its axes.
std::vector<Leaf> leaves(const Case&);
bool matches(const Where&, const Leaf&);
/// The case as this run has it: with the leaf's values of its parameters.
Case with_parameters(Case, const Leaf&);
/// Likewise; where the leaf changes nothing it is the case itself, which must then outlive it.
std::shared_ptr<const Case> case_of(const Case&, const Leaf&);
/// "v0=0.1": the swept parameters.
std::string parameters_label(const Parameters&);
/// The same with the variant's name before them: what tells runs of one method and mesh apart.
std::string parameters_label(const Leaf&);
/// "0.5" or "0.25 0.75": how tables and figures name the particles of a cell.
std::string particles_label(const std::vector<double>&);

}  // namespace diptych::runner
