#include "runner/app/provenance.hpp"

#include <fmt/core.h>
#include <gsl/gsl_version.h>
#include <muParser.h>
#include <sys/utsname.h>
#include <tbb/version.h>
#include <toml++/impl/version.h>

#include <fstream>
#include <string>

#include "diptych_version.hpp"

namespace diptych::runner {
namespace {

std::string value_of(const char* file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(key, 0) != 0) continue;
    const auto begin = line.find_first_of(":=");
    std::string value = line.substr(begin + 1);
    value.erase(0, value.find_first_not_of(" \"\t"));
    value.erase(value.find_last_not_of(" \"\t") + 1);
    return value;
  }
  return "unknown";
}

}  // namespace

reports::Provenance provenance() {
  reports::Provenance p;
  p.version = DIPTYCH_VERSION;
  p.commit = DIPTYCH_COMMIT;
  p.dirty = DIPTYCH_DIRTY;
  p.compiler = DIPTYCH_COMPILER;
  p.flags = DIPTYCH_FLAGS;
  p.libraries = fmt::format("GSL {}, TBB {}, muParser {}, toml++ {}.{}.{}", gsl_version, TBB_runtime_version(),
                            mu::Parser().GetVersion(mu::pviBRIEF), TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH);
  p.cpu = value_of("/proc/cpuinfo", "model name");
  utsname name{};
  p.os = value_of("/etc/os-release", "PRETTY_NAME") + (uname(&name) == 0 ? std::string(", ") + name.machine : "");
  return p;
}

std::filesystem::path source_directory() { return DIPTYCH_SOURCE_DIR; }
std::filesystem::path build_directory() { return DIPTYCH_BINARY_DIR; }

}  // namespace diptych::runner
