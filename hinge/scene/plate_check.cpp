#include "hinge/scene/plate_check.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace diptych {
namespace {

void refuse(bool wrong, const std::string& why) {
  if (wrong) throw std::invalid_argument("plate: " + why);
}

std::string found(double value) { return " (" + std::to_string(value) + ")"; }

void check_impact(const Plate& plate, const Cells& cells) {
  const Impact& impact = *plate.impact;
  const double column = in_cells(impact.face, plate.width / cells.x);
  refuse(plate.initial_velocity || plate.initial_displacement,
         "an impact gives the initial velocity (impact beside an initial velocity or displacement)");
  refuse(!(column > 0 && column < cells.x), "the face of an impact lies inside the plate" + found(impact.face));
  refuse(column != std::round(column), "the face of an impact lies on a column of the cells' nodes, 1 to " +
                                           std::to_string(cells.x - 1) + " cells from the left" + found(column));
  refuse(!(impact.velocity > 0 && std::isfinite(impact.velocity)),
         "the flyer's velocity must be > 0" + found(impact.velocity));
  refuse(!(impact.gap >= 0 && std::isfinite(impact.gap)),
         "the gap in front of the flyer must be >= 0" + found(impact.gap));
}

void check_side(const Plate& plate, const Cells& cells, Side side) {
  using enum Edge::Support;
  const Edge& edge = plate.edge(side);
  const bool normal{edge.normal_traction}, shear{edge.shear_traction};
  refuse(edge.support == driven && !edge.velocity, "a driven side needs its velocity");
  refuse((edge.support == driven || edge.support == fixed) && (normal || shear),
         "a traction on a side that is driven or fixed does nothing");
  refuse(edge.support == roller && normal, "a normal traction on rollers does nothing");
  refuse(edge.support == platen && shear, "a platen is frictionless and passes no shear on");
  const auto held = [&](Side beside) {
    const auto support = plate.edge(beside).support;
    return support == fixed || support == driven;
  };
  const bool upright = across(side) == 0;
  const bool ends_held = upright ? held(Side::bottom) && held(Side::top) : held(Side::left) && held(Side::right);
  refuse(edge.support == platen && ends_held && (upright ? cells.y : cells.x) == 1,
         "a platen whose nodes are all held by the sides beside it");
}

}  // namespace

double in_cells(double place, double cell) {
  const double at = place / cell, near = std::round(2 * at) / 2;
  return std::abs(at - near) <= 1e-9 ? near : at;
}

std::size_t impact_column(const Plate& plate, const Cells& cells) {
  return static_cast<std::size_t>(std::lround(plate.impact->face / (plate.width / cells.x)));
}

void check(const Plate& plate, const Cells& cells) {
  refuse(cells.x < 1 || cells.y < 1, "a plate needs at least one cell each way");
  try {
    std::visit([](const auto& solid) { solid.check(); }, plate.solid);
  } catch (const std::invalid_argument& problem) {
    refuse(true, problem.what());
  }
  refuse(plate.viscosity && plate.viscosity->form != material::Viscosity::Form::york,
         "in a plate the artificial viscosity is that of eq. 21");
  refuse(plate.viscosity && !takes_viscosity(plate.solid),
         "artificial viscosity is for elastic plates and failure waves, not beside tensile damage or plasticity");
  if (plate.impact) check_impact(plate, cells);
  for (const Gauge& gauge : plate.gauges)
    refuse(!(gauge.x >= 0 && gauge.x <= plate.width && gauge.y >= 0 && gauge.y <= plate.height),
           "a gauge stands in the plate" + found(gauge.x) + found(gauge.y));
  for (const Side side : sides) check_side(plate, cells, side);
}

}  // namespace diptych
