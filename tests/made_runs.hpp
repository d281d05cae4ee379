// Runs made by hand, for tests of what judges and draws them.
#pragma once

#include <string>

#include "reports/results.hpp"

namespace diptych::tests {

/// A run that has completed, with cells of 1/cells and two particles in each where it has particles.
inline reports::Run made_run(const std::string& method, int cells, double courant) {
  reports::Run run;
  run.method = method;
  run.cells = cells;
  run.courant_asked = courant;
  run.particles = method.starts_with("mpm") ? "0.25 0.75" : "";
  run.cell_size = 1.0 / cells;
  run.status = "completed";
  return run;
}

}  // namespace diptych::tests
