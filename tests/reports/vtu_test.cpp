// Files for ParaView: decoded here by other means, every double comes back with its bits.
#include "reports/vtu.hpp"

#include <sys/resource.h>

#include <bit>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <pugixml.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/folder.hpp"

BOOST_AUTO_TEST_SUITE(vtu)

namespace {

namespace fs = std::filesystem;
using diptych::tests::contents;
using diptych::tests::Folder;
using namespace diptych::reports;

/// Base64 by the alphabet of RFC 4648, bit by bit.
std::string decoded(const std::string& text) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  BOOST_TEST_REQUIRE(text.size() % 4 == 0U);
  std::string bytes;
  unsigned held = 0;
  int bits = 0;
  const std::size_t digits = text.find_last_not_of('=') + 1;
  BOOST_TEST_REQUIRE(text.size() - digits <= 2U);
  for (std::size_t i = 0; i < digits; ++i) {
    const std::size_t value = alphabet.find(text[i]);
    BOOST_TEST_REQUIRE(value != std::string::npos);
    held = (held << 6U) | static_cast<unsigned>(value);
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes += static_cast<char>((held >> static_cast<unsigned>(bits)) & 0xFFU);
    }
  }
  BOOST_TEST((held & ((1U << static_cast<unsigned>(bits)) - 1)) == 0U);  // what is left over is zero
  return bytes;
}

template <class T>
std::vector<T> values_of(const pugi::xml_node& array) {
  BOOST_TEST(array.attribute("format").value() == "binary");
  const std::string bytes = decoded(array.child_value());
  std::uint64_t size = 0;
  BOOST_TEST_REQUIRE(bytes.size() >= sizeof size);
  std::memcpy(&size, bytes.data(), sizeof size);
  BOOST_TEST_REQUIRE(bytes.size() == sizeof size + size);
  std::vector<T> values(size / sizeof(T));
  if (size > 0) std::memcpy(values.data(), bytes.data() + sizeof size, size);
  return values;
}

std::vector<std::uint64_t> bits_of(const std::vector<double>& values) {
  std::vector<std::uint64_t> bits;
  for (const double v : values) bits.push_back(std::bit_cast<std::uint64_t>(v));
  return bits;
}

/// One file, read back.
struct File {
  explicit File(const fs::path& path) {
    const pugi::xml_parse_result result = document.load_file(path.c_str());
    BOOST_TEST_REQUIRE(static_cast<bool>(result), result.description());
    root = document.child("VTKFile");
    BOOST_TEST(root.attribute("byte_order").value() == "LittleEndian");
    BOOST_TEST(root.attribute("header_type").value() == "UInt64");
    BOOST_TEST(root.attribute("compressor").empty());
    piece = root.child("UnstructuredGrid").child("Piece");
  }
  pugi::xml_node array(const char* group, const char* name) const {
    return piece.child(group).find_child_by_attribute("DataArray", "Name", name);
  }
  pugi::xml_document document;
  pugi::xml_node root, piece;
};

/// A square of two triangles and its corners.
VtuMesh triangles() { return {{0, 1, 1, 0}, {0, 0, 1, 1}, {0, 1, 2, 0, 2, 3}, 3}; }

const double nan_with_payload = std::bit_cast<double>(std::uint64_t{0x7ff8dead0000beefU});

}  // namespace

BOOST_AUTO_TEST_CASE(every_bit_comes_back) {
  const Folder folder;
  const std::vector<double> odd{-0.0, std::numeric_limits<double>::denorm_min(), nan_with_payload,
                                -std::numeric_limits<double>::infinity()};
  const std::vector<double> other{0.1, 1.0 / 3, -1e308, 0.1 + 0.2};
  const VtuArray stress = vtu_stress("stress", {1, 2}, {3, 4}, {-5, nan_with_payload}, true);
  write_vtu(folder.path / "plate.vtu", triangles(),
            {vtu_vector("displacement", odd, other), {"temperature & <x>", {}, other, false}, stress});
  const File file(folder.path / "plate.vtu");
  BOOST_TEST(file.root.attribute("type").value() == "UnstructuredGrid");
  BOOST_TEST(file.piece.attribute("NumberOfPoints").as_int() == 4);
  BOOST_TEST(file.piece.attribute("NumberOfCells").as_int() == 2);

  const pugi::xml_node u = file.array("PointData", "displacement");
  BOOST_TEST(u.attribute("type").value() == "Float64");
  BOOST_TEST(u.attribute("NumberOfComponents").as_int() == 3);
  std::vector<double> woven;
  for (std::size_t i = 0; i < 4; ++i) woven.insert(woven.end(), {odd[i], other[i], 0.0});
  BOOST_TEST(bits_of(values_of<double>(u)) == bits_of(woven), boost::test_tools::per_element());

  const pugi::xml_node scalar = file.array("PointData", "temperature & <x>");
  BOOST_TEST(scalar.attribute("NumberOfComponents").as_int() == 1);
  BOOST_TEST(bits_of(values_of<double>(scalar)) == bits_of(other), boost::test_tools::per_element());

  const pugi::xml_node s = file.array("CellData", "stress");
  BOOST_TEST(s.attribute("ComponentName0").value() == "XX");
  BOOST_TEST(s.attribute("ComponentName1").value() == "YY");
  BOOST_TEST(s.attribute("ComponentName2").value() == "XY");
  BOOST_TEST(bits_of(values_of<double>(s)) == bits_of({1, 3, -5, 2, 4, nan_with_payload}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(cells_of_each_kind) {
  const Folder folder;
  const auto look = [&](const VtuMesh& mesh, int type, const std::vector<std::int64_t>& nodes,
                        const std::vector<std::int64_t>& offsets) {
    write_vtu(folder.path / "cells.vtu", mesh, {});
    const File file(folder.path / "cells.vtu");
    const std::vector<std::uint8_t> types = values_of<std::uint8_t>(file.array("Cells", "types"));
    BOOST_TEST(types.size() == offsets.size());
    for (const std::uint8_t t : types) BOOST_TEST(static_cast<int>(t) == type);
    BOOST_TEST(values_of<std::int64_t>(file.array("Cells", "connectivity")) == nodes, boost::test_tools::per_element());
    BOOST_TEST(values_of<std::int64_t>(file.array("Cells", "offsets")) == offsets, boost::test_tools::per_element());
    std::vector<double> points;
    for (std::size_t i = 0; i < mesh.x.size(); ++i) points.insert(points.end(), {mesh.x[i], mesh.y[i], 0.0});
    BOOST_TEST(bits_of(values_of<double>(file.array("Points", "Points"))) == bits_of(points),
               boost::test_tools::per_element());
  };
  look(triangles(), 5, {0, 1, 2, 0, 2, 3}, {3, 6});
  look({{0, 1, 1, 0}, {0, 0, 1, 1}, {0, 1, 2, 3}, 4}, 9, {0, 1, 2, 3}, {4});
  look({{0.25, 0.75, 0.5}, {0.1, 0.2, 0.3}, {}, 0}, 1, {0, 1, 2}, {1, 2, 3});
  look({}, 1, {}, {});  // nothing at all is a file, too
}

BOOST_AUTO_TEST_CASE(every_length_of_the_last_digits) {
  const Folder folder;
  for (std::size_t n = 1; n <= 7; ++n) {
    VtuMesh mesh;
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) {
      mesh.x.push_back(static_cast<double>(i));
      values.push_back(1 / (1.0 + static_cast<double>(i)));
    }
    mesh.y = mesh.x;
    write_vtu(folder.path / "n.vtu", mesh, {{"a", {}, values, false}, {"b", {}, values, true}});
    const File file(folder.path / "n.vtu");
    for (const auto& array : {file.array("PointData", "a"), file.array("CellData", "b")})
      BOOST_TEST(bits_of(values_of<double>(array)) == bits_of(values), boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_is_refused) {
  const Folder folder;
  const fs::path path = folder.path / "no.vtu";
  const auto refused = [&](const VtuMesh& mesh, const std::vector<VtuArray>& arrays) {
    BOOST_CHECK_THROW(write_vtu(path, mesh, arrays), std::invalid_argument);
  };
  refused({{0, 1}, {0}, {}, 0}, {});
  refused({{0, 1, 1}, {0, 0, 1}, {0, 1, 3}, 3}, {});
  refused({{0, 1, 1}, {0, 0, 1}, {0, 1}, 3}, {});
  refused({{0, 1, 1}, {0, 0, 1}, {0, 1, 2}, 5}, {});
  refused({{0, 1, 1}, {0, 0, 1}, {0, 1, 2}, 0}, {});
  refused(triangles(), {{"a", {}, {1, 2, 3}, false}});
  refused(triangles(), {{"a", {}, {1, 2, 3, 4}, true}});
  refused(triangles(), {{"a", {"x", "y"}, {1, 2, 3, 4}, false}});
  refused(triangles(), {{"", {}, {1, 2, 3, 4}, false}});
  refused(triangles(), {{"a", {}, {1, 2, 3, 4}, false}, {"a", {}, {1, 2, 3, 4}, false}});
  write_vtu(path, triangles(), {{"a", {}, {1, 2, 3, 4}, false}, {"a", {}, {1, 2}, true}});
  BOOST_CHECK_THROW(vtu_vector("u", {1, 2}, {1}), std::invalid_argument);
  BOOST_CHECK_THROW(vtu_vector("u", {}, {1}), std::invalid_argument);
  BOOST_CHECK_THROW(vtu_stress("s", {1, 2}, {1, 2}, {1}, true), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(times_and_files_of_a_collection) {
  const Folder folder;
  const std::vector<std::pair<double, std::string>> steps{{0.0, "fem/fem_0000.vtu"}, {0.1 + 0.2, "a&b<.vtu"}};
  write_pvd(folder.path / "fem.pvd", steps);
  const File file(folder.path / "fem.pvd");
  BOOST_TEST(file.root.attribute("type").value() == "Collection");
  std::size_t n = 0;
  for (const pugi::xml_node& step : file.root.child("Collection").children("DataSet")) {
    BOOST_TEST_REQUIRE(n < steps.size());
    BOOST_TEST(std::strtod(step.attribute("timestep").value(), nullptr) == steps[n].first);
    BOOST_TEST(step.attribute("file").value() == steps[n].second);
    ++n;
  }
  BOOST_TEST(n == 2U);
  for (const char* name : {"", "/tmp/x.vtu"})
    BOOST_CHECK_THROW(write_pvd(folder.path / "no.pvd", {{0, name}}), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(a_full_disk_leaves_the_old_file) {
  const Folder folder;
  const fs::path path = folder.path / "plate.vtu";
  write_vtu(path, triangles(), {});
  const auto size = fs::file_size(path);
  VtuMesh large;
  large.x = large.y = std::vector<double>(10000, 0.5);
  {
    // No file may grow beyond 64 kB: the write fails as it does on a full disk.
    rlimit before{};
    ::getrlimit(RLIMIT_FSIZE, &before);
    rlimit limit = before;
    limit.rlim_cur = 65536;
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &limit);
    BOOST_CHECK_THROW(write_vtu(path, large, {}), std::runtime_error);
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
  }
  BOOST_TEST(fs::file_size(path) == size);
  BOOST_TEST(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()) == 1);
  write_vtu(path, large, {});
  BOOST_TEST(fs::file_size(path) > 65536U);
}

BOOST_AUTO_TEST_SUITE_END()
