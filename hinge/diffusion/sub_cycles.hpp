// Forward Euler in equal parts of a step.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hinge/diffusion/concentration.hpp"
#include "hinge/diffusion/node_field.hpp"

namespace diptych::diffusion {

/// From a node on, in rows of `up`: what the faces east and north of each node conduct, and time over its volume.
struct Faces {
  std::ptrdiff_t up;
  const double *east, *north, *scale;
};

/// One step of forward Euler: out = u + scale (inflow by the faces).
void euler(const Faces&, std::ptrdiff_t nodes, const double* u, double* out);

/// Takes several parts on one way through the grid: each follows the one before it a row behind, where that one has
/// just left what it needs in the cache. Every node gets the same operations in the same order as part by part, so the
/// same bits. (Wavefront blocking: Wellein, Hager, Zeiser, Wittmann & Fehske, COMPSAC 2009, 579.)
class SubCycles {
 public:
  explicit SubCycles(const Grid&);

  /// What feeds the nodes: these, in order, by source [units of C per s] of the whole grid. Both outlive the parts.
  void feed(std::span<const std::size_t> nodes, std::span<const double> source);

  /// u += scale (inflow by the faces) and += part · source, `parts` times over. The fields' rows begin
  /// NodeField::of_whole_lines apart.
  void take(long parts, const NodeField& east, const NodeField& north, const NodeField& scale, double part);

  NodeField& values() { return u_; }
  const NodeField& values() const { return u_; }
  std::size_t bytes() const;

 private:
  /// Nodes of a row, one beside the other, that the source feeds.
  struct Run {
    std::size_t place, node, count;  ///< the first's in these fields and among the grid's nodes
  };

  void roll(long parts, const NodeField& east, const NodeField& north, const NodeField& scale, double part);

  std::size_t columns_, rows_, pitch_;
  NodeField u_, next_;
  std::vector<Run> runs_;
  std::vector<std::size_t> first_run_;  // of each row, and one past the last
  std::span<const double> source_;
};

}  // namespace diptych::diffusion
