// Fields for ParaView: VTK's XML unstructured grid (.vtu) and a collection of them in time (.pvd).
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "reports/field_results.hpp"

namespace diptych::reports {

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
