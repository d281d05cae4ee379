// Artificial viscosity of the plate's triangles, eqs. 21 and 22.
#pragma once

#include <array>
#include <vector>

#include "fem/plate_mesh.hpp"
#include "fem/plate_stress.hpp"
#include "hinge/material/viscosity.hpp"
#include "hinge/scene/plate.hpp"

namespace diptych::fem {

class ArtificialViscosity {
 public:
  ArtificialViscosity(const Plate&, const Mesh&, CellStress&, const Rows&);

  /// q of each triangle, of its rate of dilation. A whole cell that it acts in has its stress kept.
  void update();
  /// ½ Σ A q tr Δεⁿ⁺½ [J/m]: with the old q of the kick before this strain increment, with the new one of the kick
  /// after it.
  double work(double dt);
  bool acted() const;  ///< at any time
  Index bytes() const { return rows_of_.capacity() * sizeof(Row); }

 private:
  struct Row {
    double largest = 0;  ///< |D| where it acts [1/s]
    bool acted = false;
    double work = 0;  ///< [J/m]
  };
  std::array<double, 4> dilation(CellAt) const;
  double largest_rate();

  material::Viscosity viscosity_;
  double density_, speed_, length_;  // [kg/m³], c_d [m/s], √(h_x h_y) [m]
  const Mesh& mesh_;
  CellStress& stress_;
  const Rows& rows_;
  std::vector<Row> rows_of_;
};

}  // namespace diptych::fem
