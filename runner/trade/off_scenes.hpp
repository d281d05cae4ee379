// Pairs of scenes: without a feature, and with it where it is nothing or does nothing.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reports/off_results.hpp"
#include "runner/panel.hpp"

namespace diptych::runner {

struct OffPair {
  std::string feature;
  std::string says;  ///< what stands beside what
  reports::OffRow::Kind kind;
  std::function<Plate(const Cells&)> plate, plate_with = {};  ///< empty: plates have no such thing
  std::function<Scene(int cells)> bars = {}, bars_with = {};  ///< likewise; `cells` are of the first bar
};

const std::vector<OffPair>& off_pairs();

/// Bytes that elastic bars, and a plate that is elastic or cracks, cannot do without, by counting what each point, node
/// and cell has to keep, in such room as arrays of their length take.
double least_bytes(const Panel&, const BarMesh&);
double least_bytes(const Panel&, const PlateMesh&, const PlateSolid&);
/// What rows and columns may take beside it, 80 numbers each: sides, and rows that are worked on.
double rim_bytes(const PlateMesh&);

}  // namespace diptych::runner
