#include "runner/input/plate_corners.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "hinge/scene/plate.hpp"
#include "runner/input/case_checks.hpp"
#include "runner/input/constants.hpp"
#include "runner/input/expression.hpp"
#include "runner/input/leaf.hpp"
#include "runner/input/messages.hpp"
#include "runner/input/plate_spec.hpp"

namespace diptych::runner {
namespace {

using EdgeSupport = Edge::Support;

/// Where two sides meet, upright one first.
struct Corner {
  std::size_t upright, level;
  double x, y;
};

std::vector<Corner> corners_of(const PlateSpec& plate) {
  std::vector<Corner> corners;
  for (const Side upright : {Side::left, Side::right})
    for (const Side level : {Side::bottom, Side::top})
      corners.push_back({static_cast<std::size_t>(upright), static_cast<std::size_t>(level),
                         upright == Side::left ? 0 : plate.width, level == Side::bottom ? 0 : plate.height});
  return corners;
}

/// Whether the side lets its nodes move so.
bool lets_move(EdgeSupport support, bool upright, double vx, double vy, double speed) {
  const double slack = 1e-9 * speed;
  if (support == EdgeSupport::fixed) return std::abs(vx) <= slack && std::abs(vy) <= slack;
  if (support == EdgeSupport::roller) return std::abs(upright ? vx : vy) <= slack;
  return true;
}

/// What the case that a run or a variant has says twice of one node; empty where nothing.
std::string contradiction_in(const Case& c) {
  const PlateSpec& plate = *c.plate;
  if (plate.drive[0].empty() || plate.drive[1].empty()) return "";
  const auto constants = expression_constants(c);
  const Expression along_x(plate.drive[0], {"x", "y", "t"}, constants),
      along_y(plate.drive[1], {"x", "y", "t"}, constants);
  std::vector<double> instants{0};
  for (const double time : c.times) instants.insert(instants.end(), {time / 2, time});
  const std::vector<Corner> corners = corners_of(plate);
  double speed = 0;
  for (const double t : instants)
    for (const Corner& at : corners)
      speed = std::max({speed, std::abs(along_x(at.x, at.y, t)), std::abs(along_y(at.x, at.y, t))});
  for (const Corner& at : corners) {
    for (const bool drives_upright : {true, false}) {
      const std::size_t driven = drives_upright ? at.upright : at.level, other = drives_upright ? at.level : at.upright;
      if (plate.supports[driven] != EdgeSupport::driven) continue;
      for (const double t : instants) {
        const double vx = along_x(at.x, at.y, t), vy = along_y(at.x, at.y, t);
        if (lets_move(plate.supports[other], !drives_upright, vx, vy, speed)) continue;
        return fmt::format(
            "found the {} side driven at ({:g}, {:g}) m/s at its corner with the {} side, which is {}, at t "
            "= {:g} s; allowed: a velocity that is 0 there in the direction that the other side holds",
            side_names[driven], vx, vy, side_names[other],
            support_names[static_cast<std::size_t>(plate.supports[other])], t);
      }
    }
  }
  return "";
}

}  // namespace

void check_corners(const Place& supports, const Case& c) {
  for (const Case& one : cases_of_runs(c)) {
    std::string found = contradiction_in(one);
    for (const PlateVariant& variant : c.variants) {
      if (!found.empty()) break;
      Case other = one;
      other.plate = variant.plate;
      found = contradiction_in(other);
    }
    if (found.empty()) continue;
    supports.say(found);
    return;
  }
}

}  // namespace diptych::runner
