#include "runner/app/failed_gates.hpp"

#include <fstream>
#include <set>

#include "reports/files.hpp"
#include "runner/app/provenance.hpp"

namespace diptych::runner {
namespace {

std::filesystem::path file_of_failed(const std::filesystem::path& store) { return store / "failed-gates.txt"; }

/// How the user would ask for the gate again.
std::string selector_of(const reports::Case& data, const reports::Gate& gate) {
  const auto cases = (source_directory() / "cases").string() + '/';
  const std::string path = std::filesystem::absolute(data.path).lexically_normal().string();
  return (path.starts_with(cases) ? data.id : path) + '/' + gate.id;
}

}  // namespace

std::vector<std::string> failed_gates(const std::filesystem::path& store) {
  std::ifstream file(file_of_failed(store));
  std::set<std::string> gates;
  for (std::string line; std::getline(file, line);)
    if (!line.empty()) gates.insert(line);
  return {gates.begin(), gates.end()};
}

void note_failed_gates(const std::filesystem::path& store, const std::vector<reports::Case>& cases) {
  const auto before = failed_gates(store);
  std::set<std::string> failed(before.begin(), before.end());
  for (const reports::Case& data : cases) {
    for (const reports::Gate& gate : data.gates) {
      if (gate.verdict == reports::Verdict::pass)
        failed.erase(selector_of(data, gate));
      else
        failed.insert(selector_of(data, gate));
    }
  }
  if (std::vector<std::string>(failed.begin(), failed.end()) == before) return;
  std::string text;
  for (const std::string& gate : failed) text += gate + '\n';
  reports::write_file(file_of_failed(store), text);
}

}  // namespace diptych::runner
