#include "mpm/plate.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <variant>

#include "hinge/scene/plate_check.hpp"
#include "mpm/plate_kernels.hpp"
#include "mpm/plate_run.hpp"

namespace diptych::mpm {
namespace {

constexpr double longest_flight = 1e7;  // time steps

void refuse(bool wrong, const std::string& message) {
  if (wrong) throw std::invalid_argument("mpm: " + message);
}

void check_impact(const Plate& plate, double time_step) {
  using Support = Edge::Support;
  const Impact& impact = *plate.impact;
  const auto is = [&](Side side, Support s) { return plate.edge(side).support == s; };
  refuse(plate.convected, "flyer and target keep the grid that they have when they meet (impact with convected)");
  for (const Side side : {Side::bottom, Side::top})
    refuse(is(side, Support::driven) || is(side, Support::platen),
           "a driven side or a platen below or above would tie the flyer to the target (with impact)");
  if (impact.gap == 0) return;
  refuse(!is(Side::left, Support::free) || is(Side::bottom, Support::fixed) || is(Side::top, Support::fixed),
         "in front of a gap the flyer flies by itself: its left side is free, and it may slide along rollers only");
  const double steps = impact.gap / (impact.velocity * time_step);
  refuse(!(steps <= longest_flight), "the gap takes the flyer " + std::to_string(steps) +
                                         " time steps, and a flight may have at most " +
                                         std::to_string(longest_flight));
}

void check_convected(const Plate& plate) {
  const std::string name = std::visit([](const auto& solid) { return std::string(solid.name); }, plate.solid);
  refuse(changes_in_cells(plate.solid),
         "what changes in cells stays there, so particles that cross cells cannot have "
         "it (convected with " +
             name + ")");
  refuse(plate.viscosity.has_value(),
         "the artificial viscosity is for particles that keep their places (convected with viscosity)");
  for (const Edge& edge : plate.edges) {
    refuse(edge.support == Edge::Support::driven || edge.support == Edge::Support::platen,
           "a side that moves is not on the grid's nodes (convected with a driven side or a platen)");
    refuse(edge.normal_traction || edge.shear_traction,
           "tractions act on the nodes of a side that stays there (convected with tractions)");
  }
}

/// What MPM alone refuses.
void check_particles(const Plate& plate, const std::vector<double>& positions, double time_step) {
  refuse(positions.empty(), "a plate needs at least one particle a cell");
  refuse(positions.size() > Arrangement::most, "at most 8 × 8 particles a cell");
  refuse(!std::is_sorted(positions.begin(), positions.end()) || positions.front() < 0 || positions.back() > 1,
         "particles stand at ascending natural coordinates in [0, 1]");
  refuse(!(plate.pic >= 0 && plate.pic <= 1), "the part of PIC lies between 0 and 1");
  if (plate.impact) check_impact(plate, time_step);
  if (plate.convected) check_convected(plate);
}

}  // namespace

PlateRecord run(const Plate& plate, const Cells& cells, const std::vector<double>& positions, Scheme scheme,
                const Stepping& stepping) {
  check(plate, cells);
  check_particles(plate, positions, stepping.time_step);
  const Setup setup{plate, cells, positions, scheme, stepping};
  if (plate.convected) return run_moving(setup);
  return std::visit([&](const auto& solid) { return run_standing(setup, solid); }, plate.solid);
}

}  // namespace diptych::mpm
