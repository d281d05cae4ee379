// What both solvers return: fields at the requested times, the ledger, the work done and the features used.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace diptych {

/// A field along the bar at its own time level (leapfrog fields live at different half-steps). x is the reference
/// coordinate. `value` holds either one value per point, to be read as linear between points and beyond the outer
/// two (velocity, displacement), or, where `edges` is filled, one value per interval [edges[i], edges[i+1]] (stress).
struct Field {
  double time = 0;  ///< [s]
  std::vector<double> x;
  std::vector<double> edges;  ///< empty, or value.size() + 1 ascending coordinates
  std::vector<double> value;
};

struct Snapshot {
  long step = 0;
  Field stress, velocity, displacement;
};

/// One line of the ledger, at one stress update. With σⁿ and vⁿ⁺½ at hand the sum
/// kinetic + strain = ½ Σ m (vⁿ⁺½)² + Σ V (ψⁿ + ½ σⁿ Δεⁿ⁺½) is the leapfrog's own (shadow) energy: for a linear bar its
/// change is exactly the work of the loads, so `lost` is what the scheme itself loses (+) or gains (−).
struct LedgerLine {
  double time = 0;        ///< of the velocity [s]
  double kinetic = 0;     ///< [J]
  double strain = 0;      ///< recoverable [J]
  double dissipated = 0;  ///< by the material before the step that this update ends [J]
  double work = 0;        ///< of tractions and body force, since the start [J]
  double lost = 0;        ///< by the scheme, since the first line [J]
  double momentum = 0;    ///< [kg m/s]
  double impulse = 0;     ///< of loads and supports, since the start [kg m/s]
};

/// The ledger's last line and the largest magnitudes met in all of its lines.
struct LedgerSums {
  long lines = 0;
  LedgerLine last;
  double held = 0;      ///< kinetic + |strain| + dissipated [J]
  double kinetic = 0;   ///< [J]
  double lost = 0;      ///< |lost| [J]
  double momentum = 0;  ///< |momentum − impulse| [kg m/s]
  bool finite = true;   ///< every entry was
};

/// Deterministic cost: the same on every machine.
struct Work {
  long element_steps = 0;
  long particle_steps = 0;
  long node_steps = 0;
  std::size_t bytes = 0;  ///< of the solver's arrays
};

enum class Outcome { completed, unstable, left_grid, cancelled };

struct Record {
  Outcome outcome = Outcome::completed;
  std::string message;  ///< why, where the outcome is not completed
  long steps = 0;       ///< taken
  double time = 0;      ///< reached [s]
  std::vector<Snapshot> snapshots;
  LedgerSums sums;
  std::vector<LedgerLine> ledger;  ///< with Books::lines
  Work work;
  std::vector<std::string> features;  ///< active in this run, sorted
};

}  // namespace diptych
