#include "runner/input/leaf.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "runner/input/messages.hpp"

namespace diptych::runner {
namespace {

template <class T>
bool allowed(const std::vector<T>& list, const T& value) {
  return list.empty() || std::find(list.begin(), list.end(), value) != list.end();
}

/// Every combination of one value for each name; the last name varies fastest.
std::vector<Parameters> combinations(const std::map<std::string, std::vector<double>>& axes) {
  std::vector<Parameters> all{{}};
  for (const auto& [name, values] : axes) {
    std::vector<Parameters> longer;
    for (const Parameters& one : all) {
      for (const double value : values) {
        longer.push_back(one);
        longer.back()[name] = value;
      }
    }
    all = std::move(longer);
  }
  return all;
}

std::string labels_of(const std::string& method, int cells, double courant, const std::string& particles,
                      const std::string& parameters) {
  return fmt::format("{}|{}|{}|{}|{}", method, cells, courant, particles, parameters);
}

}  // namespace

SceneKind kind_of(const Case& c) {
  return !c.plate ? SceneKind::bars : c.plate->solid ? SceneKind::plate : SceneKind::diffusion;
}

std::vector<Leaf> leaves(const Case& c) {
  std::vector<Leaf> all;
  std::set<Leaf> known;
  const auto add = [&](const Leaf& leaf) {
    if (known.insert(leaf).second) all.push_back(leaf);
  };
  for (const Axes& block : c.axes) {
    for (const auto& method : block.method) {
      for (const auto& particles : block.particles) {
        for (const double courant : block.courant) {
          for (const Parameters& parameters : combinations(block.parameters)) {
            for (const std::string& variant : block.variant) {
              for (const int cells : block.cells)
                add({method, cells, courant, panel(method).particles ? particles : std::vector<double>{}, parameters,
                     variant});
            }
          }
        }
      }
    }
  }
  return all;
}

bool matches(const Where& where, const Leaf& leaf) {
  for (const auto& [name, values] : where.parameters) {
    const auto own = leaf.parameters.find(name);
    if (own == leaf.parameters.end() || !allowed(values, own->second)) return false;
  }
  return allowed(where.method, leaf.method) && allowed(where.cells, leaf.cells) &&
         allowed(where.courant, leaf.courant) && allowed(where.variant, leaf.variant) &&
         (!panel(leaf.method).particles || allowed(where.particles, leaf.particles));
}

Case with_parameters(Case c, const Leaf& leaf) {
  for (const auto& [name, value] : leaf.parameters) c.parameters[name] = value;
  for (const PlateVariant& variant : c.variants)
    if (variant.id == leaf.variant) c.plate = variant.plate;
  if (c.plate && c.plate->rows > 0) c.plate->height = c.plate->rows * (c.plate->width / leaf.cells);
  return c;
}

std::shared_ptr<const Case> case_of(const Case& c, const Leaf& leaf) {
  const bool itself = leaf.parameters.empty() && leaf.variant.empty() && !(c.plate && c.plate->rows > 0);
  if (itself) return {std::shared_ptr<const Case>(), &c};
  return std::make_shared<const Case>(with_parameters(without_axes(c), leaf));
}

Case without_axes(const Case& c) {
  Case bare = c;
  bare.axes.clear();
  std::erase_if(bare.scene, [](const auto& declared) { return declared.first.starts_with("axes"); });
  for (GateSpec& gate : bare.gates) gate.declaration.clear();
  return bare;
}

std::string parameters_label(const Parameters& parameters) {
  std::string label;
  for (const auto& [name, value] : parameters) label += fmt::format("{}{}={}", label.empty() ? "" : " ", name, value);
  return label;
}

std::string parameters_label(const Leaf& leaf) {
  const std::string parameters = parameters_label(leaf.parameters);
  return leaf.variant + (leaf.variant.empty() || parameters.empty() ? "" : " ") + parameters;
}

std::string particles_label(const std::vector<double>& positions) { return listed(positions, " "); }

Leaves::Leaves(const Case& c) : all_(leaves(c)) {
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const Leaf& one = all_[i];
    by_label_.try_emplace(
        labels_of(one.method, one.cells, one.courant, particles_label(one.particles), parameters_label(one)), i);
  }
}

const Leaf* Leaves::of(const reports::Run& run) const {
  const auto found = by_label_.find(labels_of(run.method, run.cells, run.courant_asked, run.particles, run.parameters));
  return found == by_label_.end() ? nullptr : &all_[found->second];
}

}  // namespace diptych::runner
