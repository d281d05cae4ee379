#include "runner/app/catalogue.hpp"

#include <fmt/core.h>
#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "runner/app/case_file.hpp"
#include "runner/app/provenance.hpp"

namespace diptych::runner {
namespace {

namespace fs = std::filesystem;

fs::path own_cases() { return source_directory() / "cases"; }

std::map<std::string, std::string> read_lock() {
  std::map<std::string, std::string> lock;
  std::ifstream in(own_cases() / "gates.lock");
  for (std::string line; std::getline(in, line);) {
    const auto space = line.find(' ');
    if (space != std::string::npos) lock[line.substr(0, space)] = line.substr(space + 1);
  }
  return lock;
}

bool comes_with_program(const Case& c) {
  std::error_code ignored;
  const auto relative = fs::relative(c.path, own_cases(), ignored).string();
  return !ignored && !relative.empty() && relative.rfind("..", 0) != 0;
}

/// Keeps one gate of a case.
Case only(Case c, const std::string& gate) {
  std::vector<std::string> ids;
  for (const auto& g : c.gates) ids.push_back(g.id);
  std::erase_if(c.gates, [&](const GateSpec& g) { return g.id != gate; });
  if (c.gates.empty()) {
    const std::string near = nearest(gate, ids);
    throw InputError(fmt::format("case {} has no gate '{}'; it has: {}{}", c.id, gate, listed(ids),
                                 near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near)));
  }
  return c;
}

}  // namespace

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const auto& entry : fs::recursive_directory_iterator(own_cases())) {
    if (entry.path().extension() == ".toml") cases.push_back(read_case(entry.path()));
  }
  std::sort(cases.begin(), cases.end(), [](const Case& a, const Case& b) { return a.id < b.id; });
  const auto twice =
      std::adjacent_find(cases.begin(), cases.end(), [](const Case& a, const Case& b) { return a.id == b.id; });
  if (twice != cases.end()) {
    throw InputError(fmt::format("{}: id: '{}' is also the id of {}; allowed is an id of its own", twice->path.string(),
                                 twice->id, (twice + 1)->path.string()));
  }
  return cases;
}

std::vector<Case> select_cases(const std::vector<std::string>& selectors) {
  if (selectors.empty()) return all_cases();
  std::vector<Case> chosen, known;
  for (const std::string& selector : selectors) {
    if (const auto ending = selector.rfind(".toml"); ending != std::string::npos) {
      const std::string path = selector.substr(0, ending + 5), gate = selector.substr(ending + 5);
      if (gate.empty() || gate[0] == '/') {
        const Case c = read_case(path);
        chosen.push_back(gate.empty() ? c : only(c, gate.substr(1)));
        continue;
      }
    }
    if (known.empty()) known = all_cases();
    const auto slash = selector.find('/');
    const std::string id = selector.substr(0, slash);
    const std::size_t before = chosen.size();
    for (const Case& c : known) {
      if (fnmatch(id.c_str(), c.id.c_str(), 0) != 0) continue;
      chosen.push_back(slash == std::string::npos ? c : only(c, selector.substr(slash + 1)));
    }
    if (chosen.size() == before) {
      std::vector<std::string> ids;
      for (const Case& c : known) ids.push_back(c.id);
      const std::string near = nearest(id, ids);
      throw InputError(
          fmt::format("no case '{}'{}; a case is a path that ends in .toml, an id or a pattern over ids; "
                      "'diptych list' names them",
                      id, near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near)));
    }
  }
  // The same case named twice runs once; two gates of it are kept together.
  std::vector<Case> merged;
  for (Case& c : chosen) {
    const auto same = std::find_if(merged.begin(), merged.end(), [&](const Case& m) { return m.id == c.id; });
    if (same == merged.end()) {
      merged.push_back(std::move(c));
      continue;
    }
    if (same->path != c.path) {
      throw InputError(fmt::format("id '{}' belongs to both {} and {}", c.id, same->path.string(), c.path.string()));
    }
    for (const GateSpec& gate : c.gates) {
      const bool there =
          std::any_of(same->gates.begin(), same->gates.end(), [&](const GateSpec& g) { return g.id == gate.id; });
      if (!there) same->gates.push_back(gate);
    }
  }
  return merged;
}

std::string declarations(const std::vector<Case>& cases) {
  std::vector<std::string> lines;
  for (const Case& c : cases) {
    lines.push_back(fmt::format("{} {}\n", c.id, c.scene));
    for (const GateSpec& gate : c.gates) lines.push_back(fmt::format("{}/{} {}\n", c.id, gate.id, gate.declaration));
  }
  std::sort(lines.begin(), lines.end());
  return listed(lines, "");
}

std::vector<std::string> differences_from_lock(const std::vector<Case>& cases, bool whole) {
  std::vector<std::string> differences;
  const auto lock = read_lock();
  std::map<std::string, bool> declared;
  for (const Case& c : cases) {
    if (!comes_with_program(c)) continue;
    const auto compare = [&](const std::string& name, const std::string& declaration) {
      declared[name] = true;
      const auto locked = lock.find(name);
      if (locked == lock.end()) {
        differences.push_back(name + " is not in cases/gates.lock");
      } else if (locked->second != declaration) {
        differences.push_back(
            fmt::format("{} is declared as\n    {}\n  but locked as\n    {}", name, declaration, locked->second));
      }
    };
    compare(c.id, c.scene);
    for (const GateSpec& gate : c.gates) compare(c.id + "/" + gate.id, gate.declaration);
  }
  if (whole) {
    for (const auto& [name, declaration] : lock) {
      if (!declared.count(name)) differences.push_back(name + " is in cases/gates.lock but no case declares it");
    }
  }
  return differences;
}

}  // namespace diptych::runner
