// What tests of files share: a folder for as long as a test runs, another PATH, a file's contents.
#pragma once

#include <sys/stat.h>

#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace diptych::tests {

struct Folder {
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "diptych's test-XXXXXX").string();  // blanks, quotes
    BOOST_TEST_REQUIRE(::mkdtemp(name.data()) != nullptr);
    path = name;
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(path), std::filesystem::directory_iterator()));
  }
  std::filesystem::path path;
};

/// Another PATH for as long as it lives. There may be none before.
struct Path {
  explicit Path(const std::string& value) {
    if (const char* path = std::getenv("PATH")) before = path;
    ::setenv("PATH", value.c_str(), 1);
  }
  ~Path() { before.empty() ? ::unsetenv("PATH") : ::setenv("PATH", before.c_str(), 1); }
  std::string before;
};

inline std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace diptych::tests
