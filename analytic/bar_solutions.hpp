// The exact solutions of bars that a case may name: a row each.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "analytic/bar_impact.hpp"
#include "analytic/solution_parameter.hpp"

namespace diptych::analytic {

/// Bars in a row as an exact solution sees them: nothing of how they are solved.
struct BarSetting {
  std::vector<ImpactBar> bars;      ///< left to right, at least one; a yield stress that is infinite: elastic
  std::vector<std::string> laws;    ///< of each bar, as case files call them
  std::vector<std::string> curved;  ///< of these laws, those whose curve of first loading is not straight or bilinear
  BarEnd left, right;               ///< of the first and of the last bar
  double until = 0;                 ///< last time that is asked for [s]
  bool bonded = false;              ///< bars that touch hold together
  SolutionParameters parameters;    ///< those of the row
  bool flies = false;               ///< a bar has a velocity of its own, 0 perhaps
  bool body_force = false;          ///< there is one
  bool starts_otherwise = false;    ///< with fields of stress or velocity
  std::vector<std::string> loads;   ///< their histories: "step", "ramp", "impulse" or "expression"
};

struct BarSolution {
  std::string name;
  std::vector<SolutionParameter> parameters;
  /// Bars meet, and when they do is the run's own: each run has a solution of its own.
  bool of_impact = false;
  /// What of the setting it does not know, each after the solution's name: "together with ...; allowed: ...".
  std::vector<std::string> (*misfits)(const BarSetting&);
  /// Of a setting that fits. Throws std::invalid_argument where a parameter is out of range.
  std::unique_ptr<ExactSolution> (*make)(const BarSetting&);
};

const std::vector<BarSolution>& bar_solutions();

}  // namespace diptych::analytic
