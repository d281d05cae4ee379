// Fields on points and cells in the plane as plain data.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace diptych::reports {

/// Points in the plane and cells between them.
struct VtuMesh {
  std::vector<double> x, y;
  /// Point numbers of each cell after one another, anticlockwise; empty: every point is a cell of its own (particles).
  std::vector<std::size_t> connectivity;
  int corners = 0;  ///< of each cell: 3 or 4; ignored without connectivity
};

/// One value a point or a cell; a vector's third component and a stress's other ones are components like all.
struct VtuArray {
  std::string name;                     ///< "velocity"
  std::vector<std::string> components;  ///< {"x", "y", "z"}; empty: one component without a name
  std::vector<double> values;           ///< components of the first, of the second, ...
  bool on_cells = false;
};

}  // namespace diptych::reports
