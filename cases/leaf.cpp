#include "cases/leaf.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::cases {
namespace {

template <class T>
bool allowed(const std::vector<T>& list, const T& value) {
  return list.empty() || std::find(list.begin(), list.end(), value) != list.end();
}

}  // namespace

std::vector<Leaf> leaves(const Case& c) {
  std::vector<Leaf> all;
  const auto add = [&](Leaf leaf) {
    if (std::find(all.begin(), all.end(), leaf) == all.end()) all.push_back(std::move(leaf));
  };
  for (const Axes& block : c.axes) {
    for (const auto& method : block.method) {
      for (const auto& particles : block.particles) {
        for (const double courant : block.courant) {
          for (const int cells : block.cells) {
            add({method, cells, courant, method == "fem" ? std::vector<double>{} : particles});
          }
        }
      }
    }
  }
  return all;
}

bool matches(const Where& where, const Leaf& leaf) {
  return allowed(where.method, leaf.method) && allowed(where.cells, leaf.cells) &&
         allowed(where.courant, leaf.courant) && (leaf.method == "fem" || allowed(where.particles, leaf.particles));
}

std::string particles_label(const std::vector<double>& positions) {
  return fmt::format("{}", fmt::join(positions, " "));
}

}  // namespace diptych::cases
