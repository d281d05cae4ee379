// Fields for ParaView: VTK's XML unstructured grid (.vtu) and a collection of them in time (.pvd).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
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

/// {u₁x, u₁y, 0, u₂x, u₂y, 0, ...}: ParaView's arrows need three components.
VtuArray vtu_vector(std::string name, const std::vector<double>& x, const std::vector<double>& y);
/// XX, YY, XY, one each a cell or point.
VtuArray vtu_stress(std::string name, const std::vector<double>& xx, const std::vector<double>& yy,
                    const std::vector<double>& xy, bool on_cells);

/// Float64 and Int64 as inline base64 with a UInt64 size before each array; doubles keep their bits. Throws
/// std::invalid_argument for arrays that do not fit the mesh or that share a name, and std::runtime_error as write_file
/// does.
void write_vtu(const std::filesystem::path& path, const VtuMesh&, const std::vector<VtuArray>&);

/// Time and file of each step, the file relative to the collection's folder.
void write_pvd(const std::filesystem::path& path, const std::vector<std::pair<double, std::string>>& steps);

}  // namespace diptych::reports
