// Eqs. 19 and 18 of all nodes: forces, kick and drift go by rows of cells, in one sweep from the bottom to the top.
#pragma once

#include <vector>

#include "fem/plate_border.hpp"
#include "fem/plate_mesh.hpp"
#include "fem/plate_stress.hpp"
#include "fem/sweep.hpp"

namespace diptych::fem {

class Sweep {
 public:
  Sweep(Mesh&, Border&, const CellStress&, const Rows&, bool body_force, bool viscous);

  /// (uⁿ, σⁿ, vⁿ⁻½) → (uⁿ⁺¹, vⁿ⁺½) of all nodes that nothing holds, kick [s] long. What the border's platens and drives
  /// hold stays for them.
  void move_nodes(double kick, double dt);
  Index bytes() const;

 private:
  /// Rows of cells that one task looks after.
  struct Band {
    Index begin, end;
    Components below;  ///< force of the last row of cells on the nodes above it [N/m]
    Components first;  ///< of the band's first row of cells on the nodes below it [N/m]
    CornerForces forces;
  };

  void sweep(Band&, double kick, double dt);
  void cell_forces(Index j, Index from, Index cells, const KickAndDrift& middle, CornerForces&);
  static void open_row(Band&, Index from, Index cells);
  void move_left_end(Band&, Index j, double kick, double dt);
  void close_rows(double kick, double dt);

  Mesh& mesh_;
  Border& border_;
  const CellStress& stress_;
  const Rows& rows_;
  Loops loops_;
  std::vector<Band> bands_;
};

}  // namespace diptych::fem
