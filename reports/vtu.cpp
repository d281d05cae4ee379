#include "reports/vtu.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cstdint>
#include <cstring>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "reports/files.hpp"
#include "reports/text.hpp"

namespace diptych::reports {
namespace {

static_assert(sizeof(double) == 8 && std::endian::native == std::endian::little, "the file says Float64, LittleEndian");

constexpr std::uint8_t vertex = 1, triangle = 5, quad = 9;  // VTK's cell types

std::string base64(const std::string& bytes) {
  namespace it = boost::archive::iterators;
  using Digits = it::base64_from_binary<it::transform_width<std::string::const_iterator, 6, 8>>;
  // The last digits would be read from beyond the end: zeros there, and their digits become '='.
  const std::size_t missing = (3 - bytes.size() % 3) % 3;
  const std::string padded = bytes + std::string(missing, '\0');
  std::string text(Digits(padded.begin()), Digits(padded.end()));
  return text.replace(text.size() - missing, missing, missing, '=');
}

/// Size and bytes, as VTK has it with header_type UInt64 and no compressor.
template <class T>
std::string encoded(const std::vector<T>& values) {
  const std::uint64_t size = values.size() * sizeof(T);
  std::string bytes(sizeof size + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
  return base64(bytes);
}

template <class T>
pugi::xml_node add_array(pugi::xml_node parent, const char* type, const std::string& name,
                         const std::vector<T>& values) {
  pugi::xml_node array = parent.append_child("DataArray");
  array.append_attribute("type") = type;
  array.append_attribute("Name") = printable(name).c_str();
  array.append_attribute("format") = "binary";
  array.append_child(pugi::node_pcdata).set_value(encoded(values).c_str());
  return array;
}

pugi::xml_node begin_file(pugi::xml_document& document, const char* type) {
  document.append_child(pugi::node_declaration).append_attribute("version") = "1.0";
  pugi::xml_node root = document.append_child("VTKFile");
  root.append_attribute("type") = type;
  root.append_attribute("version") = "1.0";
  root.append_attribute("byte_order") = "LittleEndian";
  root.append_attribute("header_type") = "UInt64";
  return root;
}

std::string xml_of(const pugi::xml_document& document) {
  std::ostringstream out;
  document.save(out, " ");
  return out.str();
}

std::size_t width_of(const VtuArray& array) { return std::max<std::size_t>(1, array.components.size()); }

void check_mesh(const VtuMesh& mesh, std::size_t cells, const std::vector<VtuArray>& arrays) {
  const auto refuse = [](const std::string& why) { throw std::invalid_argument("vtu: " + why); };
  const std::size_t points = mesh.x.size();
  if (mesh.y.size() != points) refuse(fmt::format("{} x but {} y", points, mesh.y.size()));
  if (!mesh.connectivity.empty()) {
    if (mesh.corners != 3 && mesh.corners != 4) refuse(fmt::format("cells with {} corners", mesh.corners));
    if (mesh.connectivity.size() % static_cast<std::size_t>(mesh.corners) != 0)
      refuse(fmt::format("{} point numbers for cells of {}", mesh.connectivity.size(), mesh.corners));
    const std::size_t last = *std::max_element(mesh.connectivity.begin(), mesh.connectivity.end());
    if (last >= points) refuse(fmt::format("a cell needs point {} of {}", last, points));
  }
  std::set<std::pair<bool, std::string>> names;
  for (const VtuArray& array : arrays) {
    const std::size_t needed = (array.on_cells ? cells : points) * width_of(array);
    if (array.values.size() != needed)
      refuse(fmt::format("array '{}' has {} values, the mesh takes {}", array.name, array.values.size(), needed));
    if (array.name.empty()) refuse("an array without a name");
    if (!names.emplace(array.on_cells, array.name).second) refuse("two arrays are called '" + array.name + "'");
  }
}

/// Several lists woven into one: first of each, second of each, ...
std::vector<double> woven(const std::string& name, const std::vector<const std::vector<double>*>& lists) {
  std::vector<double> out;
  const std::size_t count = lists[0]->size();
  for (const auto* list : lists)
    if (list->size() != count) throw std::invalid_argument("vtu: components of '" + name + "' differ in length");
  out.reserve(count * lists.size());
  for (std::size_t i = 0; i < count; ++i)
    for (const auto* list : lists) out.push_back((*list)[i]);
  return out;
}

}  // namespace

VtuArray vtu_vector(std::string name, const std::vector<double>& x, const std::vector<double>& y) {
  const std::vector<double> zero(x.size(), 0.0);
  std::vector<double> values = woven(name, {&x, &y, &zero});
  return {std::move(name), {"x", "y", "z"}, std::move(values), false};
}

VtuArray vtu_stress(std::string name, const std::vector<double>& xx, const std::vector<double>& yy,
                    const std::vector<double>& xy, bool on_cells) {
  std::vector<double> values = woven(name, {&xx, &yy, &xy});
  return {std::move(name), {"XX", "YY", "XY"}, std::move(values), on_cells};
}

void write_vtu(const std::filesystem::path& path, const VtuMesh& mesh, const std::vector<VtuArray>& arrays) {
  const bool particles = mesh.connectivity.empty();
  const std::size_t points = mesh.x.size();
  const std::size_t corners = particles ? 1 : static_cast<std::size_t>(std::max(1, mesh.corners));
  const std::size_t cells = particles ? points : mesh.connectivity.size() / corners;
  check_mesh(mesh, cells, arrays);

  std::vector<std::int64_t> connectivity, offsets;
  for (std::size_t i = 0; i < cells * corners; ++i)
    connectivity.push_back(static_cast<std::int64_t>(particles ? i : mesh.connectivity[i]));
  for (std::size_t i = 1; i <= cells; ++i) offsets.push_back(static_cast<std::int64_t>(i * corners));
  const std::vector<std::uint8_t> types(cells, particles ? vertex : corners == 3 ? triangle : quad);

  pugi::xml_document document;
  pugi::xml_node piece =
      begin_file(document, "UnstructuredGrid").append_child("UnstructuredGrid").append_child("Piece");
  piece.append_attribute("NumberOfPoints") = static_cast<unsigned long long>(points);
  piece.append_attribute("NumberOfCells") = static_cast<unsigned long long>(cells);
  const std::vector<double> flat(points, 0.0);
  add_array(piece.append_child("Points"), "Float64", "Points", woven("Points", {&mesh.x, &mesh.y, &flat}))
      .append_attribute("NumberOfComponents") = 3;
  pugi::xml_node cell = piece.append_child("Cells");
  add_array(cell, "Int64", "connectivity", connectivity);
  add_array(cell, "Int64", "offsets", offsets);
  add_array(cell, "UInt8", "types", types);
  pugi::xml_node on_points = piece.append_child("PointData"), on_cells = piece.append_child("CellData");
  for (const VtuArray& array : arrays) {
    pugi::xml_node node = add_array(array.on_cells ? on_cells : on_points, "Float64", array.name, array.values);
    node.append_attribute("NumberOfComponents") = static_cast<unsigned long long>(width_of(array));
    for (std::size_t c = 0; c < array.components.size(); ++c)
      node.append_attribute(fmt::format("ComponentName{}", c).c_str()) = printable(array.components[c]).c_str();
  }
  write_file(path, xml_of(document));
}

void write_pvd(const std::filesystem::path& path, const std::vector<std::pair<double, std::string>>& steps) {
  pugi::xml_document document;
  pugi::xml_node collection = begin_file(document, "Collection").append_child("Collection");
  for (const auto& [time, file] : steps) {
    if (file.empty() || std::filesystem::path(file).is_absolute())
      throw std::invalid_argument("pvd: '" + file + "' is no path relative to the collection");
    pugi::xml_node step = collection.append_child("DataSet");
    step.append_attribute("timestep") = fmt::format("{}", time).c_str();
    step.append_attribute("part") = 0;
    step.append_attribute("file") = printable(file).c_str();
  }
  write_file(path, xml_of(document));
}

}  // namespace diptych::reports
