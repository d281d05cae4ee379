#include "runner/app/catalogue.hpp"

#include <fmt/core.h>
#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <utility>

#include "runner/app/case_file.hpp"
#include "runner/app/provenance.hpp"
#include "runner/run/run_leaf.hpp"

namespace diptych::runner {
namespace {

namespace fs = std::filesystem;

fs::path own_cases() { return source_directory() / "cases"; }

/// What cases and their gates declare, by the id of the case and of the gate; of the case's scene that is "".
using Declarations = std::map<std::pair<std::string, std::string>, Declaration>;

std::string name_of(const Declarations::key_type& id) {
  return id.second.empty() ? id.first : id.first + '/' + id.second;
}

Declarations declared_in(const std::vector<Case>& cases) {
  Declarations all;
  for (const Case& c : cases) {
    all[{c.id, ""}] = c.scene;
    for (const GateSpec& gate : c.gates) all[{c.id, gate.id}] = gate.declaration;
  }
  return all;
}

/// Notes what is not as declarations() writes it: a line that is passed over would lock nothing.
Declarations read_lock(std::vector<std::string>& mistakes) {
  Declarations lock;
  Declaration* section = nullptr;
  std::ifstream in(own_cases() / "gates.lock");
  int number = 0;
  const auto refuse = [&](const std::string& found, const std::string& allowed) {
    mistakes.push_back(fmt::format("cases/gates.lock:{}: found {}; allowed: {}", number, found, allowed));
  };
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.empty()) continue;
    if (line.starts_with('[') && line.ends_with(']')) {
      const std::string name = line.substr(1, line.size() - 2);
      const auto slash = name.find('/');
      const auto [place, is_new] =
          lock.try_emplace({name.substr(0, slash), slash == name.npos ? "" : name.substr(slash + 1)});
      if (!is_new) refuse(line + " twice", "each case and gate once");
      section = &place->second;
      continue;
    }
    const auto equals = line.find(" = ");
    if (!section || equals == line.npos) {
      refuse(words(line), "[case], [case/gate] and below it a key = value a line");
      continue;
    }
    const std::string key = line.substr(0, equals);
    if (!section->emplace(key, line.substr(equals + 3)).second) refuse(words(key) + " twice", "each key once");
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

Case select_one_case(const std::vector<std::string>& selectors) {
  std::vector<Case> cases = select_cases(selectors);
  if (cases.size() != 1) throw InputError(fmt::format("{}: {} cases; allowed: one", listed(selectors), cases.size()));
  return std::move(cases.front());
}

void keep_runs(std::vector<Case>& cases, const std::vector<std::string>& labels) {
  Names known;
  std::vector<bool> met(labels.size());
  for (Case& c : cases) {
    std::vector<Axes> kept;
    for (const Leaf& leaf : leaves(c)) {
      known.push_back(describe(*case_of(c, leaf), leaf).label());
      bool wanted = false;
      for (std::size_t i = 0; i < labels.size(); ++i) {
        if (fnmatch(labels[i].c_str(), known.back().c_str(), 0) != 0) continue;
        wanted = met[i] = true;
      }
      if (!wanted) continue;
      Axes one;
      one.method = {leaf.method};
      one.cells = {leaf.cells};
      one.courant = {leaf.courant};
      if (!leaf.particles.empty()) one.particles = {leaf.particles};
      for (const auto& [name, value] : leaf.parameters) one.parameters[name] = {value};
      one.variant = {leaf.variant};
      kept.push_back(one);
    }
    c.axes = kept;
  }
  std::erase_if(cases, [](const Case& c) { return c.axes.empty(); });
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (met[i]) continue;
    const auto method = [](const std::string& label) { return label.substr(0, label.find(' ')); };
    Names near;
    for (const std::string& label : known)
      if (method(label) == method(labels[i])) near.push_back(label);
    const std::string hint = nearest(labels[i], known);
    throw InputError(fmt::format("--only: no run '{}'{}; there are\n  {}", labels[i],
                                 hint.empty() ? "" : fmt::format(" (did you mean '{}'?)", hint),
                                 listed(near.empty() ? known : near, "\n  ")));
  }
}

std::string declarations(const std::vector<Case>& cases) {
  std::string text;
  for (const auto& [id, declaration] : declared_in(cases)) {
    text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", name_of(id));
    for (const auto& [key, value] : declaration) text += key + " = " + value + '\n';
  }
  return text;
}

std::vector<std::string> differences_from_lock(const std::vector<Case>& cases, bool whole) {
  std::vector<Case> own = cases;
  std::erase_if(own, [](const Case& c) { return !comes_with_program(c); });
  if (own.empty() && !whole) return {};
  std::vector<std::string> differences;
  const Declarations all = declared_in(own), lock = read_lock(differences);
  for (const auto& [id, declared] : all) {
    const std::string name = name_of(id);
    const auto place = lock.find(id);
    if (place == lock.end()) {
      differences.push_back(name + " is not in cases/gates.lock");
      continue;
    }
    const Declaration& locked = place->second;
    for (const auto& [key, value] : declared) {
      const auto old = locked.find(key);
      if (old == locked.end())
        differences.push_back(fmt::format("{}: {} = {} is not in cases/gates.lock", name, key, value));
      else if (old->second != value)
        differences.push_back(fmt::format("{}: {} = {} is locked as {}", name, key, value, old->second));
    }
    for (const auto& [key, value] : locked)
      if (!declared.contains(key))
        differences.push_back(
            fmt::format("{}: {} = {} is in cases/gates.lock but the case does not declare it", name, key, value));
  }
  if (whole) {
    for (const auto& [id, declaration] : lock)
      if (!all.contains(id)) differences.push_back(name_of(id) + " is in cases/gates.lock but no case declares it");
  }
  return differences;
}

}  // namespace diptych::runner
