// What both solvers return: fields at the requested times, the ledger, the work done and the features used.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace diptych {

/// A field along the bars at its own time level (leapfrog fields live at different half-steps). x is the reference
/// coordinate. `value` holds either one value per point, to be read as linear between points and beyond the outer
/// two of a bar (velocity, displacement), or, where `edges` is filled, one value per interval between two edges of a
/// bar (stress).
struct Field {
  double time = 0;  ///< [s]
  std::vector<double> x;
  std::vector<double> edges;  ///< empty, or for each bar one more ascending coordinate than it has values
  std::vector<double> value;
  std::vector<std::size_t> first{0};  ///< of each bar: its first value

  /// One bar's part.
  Field of_bar(std::size_t bar) const {
    const auto from = static_cast<std::ptrdiff_t>(first[bar]);
    const auto to = static_cast<std::ptrdiff_t>(bar + 1 < first.size() ? first[bar + 1] : value.size());
    const auto part = [](const std::vector<double>& v, std::ptrdiff_t begin, std::ptrdiff_t end) {
      return v.empty() ? v : std::vector<double>(v.begin() + begin, v.begin() + end);
    };
    const auto edges_before = static_cast<std::ptrdiff_t>(bar);
    return {
        time, part(x, from, to), part(edges, from + edges_before, to + edges_before + 1), part(value, from, to), {0}};
  }
};

struct Snapshot {
  long step = 0;
  Field stress, velocity, displacement;
};

/// One line of the ledger, at one stress update. With σⁿ and vⁿ⁺½ at hand the sum
/// kinetic + strain = ½ Σ m (vⁿ⁺½)² + Σ V (ψⁿ + ½ σⁿ Δεⁿ⁺½) is the leapfrog's own (shadow) energy: for a linear bar its
/// change is exactly the work of the loads. What else takes energy has a line of its own, each found from its own
/// forces and velocities, so `lost` is what nobody can account for: round-off.
struct LedgerLine {
  double time = 0;        ///< of the velocity [s]
  double kinetic = 0;     ///< [J]
  double strain = 0;      ///< recoverable [J]
  double dissipated = 0;  ///< by the material before the step that this update ends [J]
  double viscous = 0;     ///< by the artificial viscosity, likewise [J]
  double contact = 0;     ///< by the impact of end nodes, since the start [J]; FEM
  double scheme = 0;      ///< by the scheme since the first line [J]: mapping, crossing of cells, yield within a step
  double work = 0;        ///< of tractions and body force, since the start [J]
  double lost = 0;        ///< imbalance of all these, since the first line [J]
  double momentum = 0;    ///< [kg m/s]
  double impulse = 0;     ///< of loads and supports, since the start [kg m/s]
};

/// The ledger's last line and the largest magnitudes met in all of its lines.
struct LedgerSums {
  long lines = 0;
  LedgerLine last;
  double held = 0;        ///< kinetic + |strain| + dissipated + |viscous| [J]
  double kinetic = 0;     ///< [J]
  double taken = 0;       ///< |contact + scheme + lost|: what the continuous bar would have kept [J]
  double lost = 0;        ///< |lost| [J]
  double momentum = 0;    ///< |momentum − impulse| [kg m/s]
  double given_back = 0;  ///< largest fall of `dissipated` below what it was before [J]
  double excess = 0;      ///< of kinetic + strain + what damage has taken over what was put in [J]
  double put_in = 0;      ///< the most that had been put in at any line: at the start and by work [J]
  bool finite = true;     ///< every entry was
};

/// Deterministic cost: the same on every machine.
struct Work {
  long element_steps = 0;
  long particle_steps = 0;
  long node_steps = 0;
  std::size_t bytes = 0;  ///< of the solver's arrays
};

/// Bars `left` and `left` + 1 acted on each other from one time to another. FEM: their ends pushed, the beginning found
/// where the gap closes within the step. MPM: they shared a node of the grid.
struct Touch {
  std::size_t left = 0;
  double from = 0;                                      ///< [s]
  double to = std::numeric_limits<double>::infinity();  ///< infinite if they still did at the end [s]
};

enum class Outcome { completed, unstable, left_grid, cancelled };

template <class Snapshot>
struct BasicRecord {
  static constexpr const char* energy_unit = "J";  ///< bars of unit cross-section
  Outcome outcome = Outcome::completed;
  std::string message;  ///< why, where the outcome is not completed
  long steps = 0;       ///< taken
  double time = 0;      ///< reached [s]
  std::vector<Snapshot> snapshots;
  std::vector<Touch> touches;  ///< in the order of their beginning
  LedgerSums sums;
  std::vector<LedgerLine> ledger;  ///< with Books::lines
  Work work;
  std::vector<std::string> features;  ///< active in this run, sorted
};

using Record = BasicRecord<Snapshot>;

}  // namespace diptych
