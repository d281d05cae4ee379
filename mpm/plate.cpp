#include "mpm/plate.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "mpm/plate_body.hpp"

namespace diptych::mpm {
namespace {

constexpr double longest_flight = 1e7;  // time steps

void refuse(bool wrong, const char* message) {
  if (wrong) throw std::invalid_argument(std::string("mpm: ") + message);
}

void check_impact(const Plate& plate, const Cells& cells, double time_step) {
  using Support = Edge::Support;
  const Impact& impact = *plate.impact;
  const auto is = [&](Side side, Support s) { return plate.edge(side).support == s; };
  const double column = impact.face / (plate.width / cells.x), nearest = std::round(column);
  refuse(plate.convected, "flyer and target keep the grid that they have when they meet (impact with convected)");
  refuse(plate.initial_velocity || plate.initial_displacement,
         "an impact gives the initial velocity (impact beside an initial velocity or displacement)");
  refuse(!(nearest >= 1 && nearest <= cells.x - 1), "the face of an impact lies inside the plate");
  refuse(!(std::abs(column - nearest) <= 1e-9), "the face of an impact lies on a column of the cells' nodes");
  refuse(!(impact.velocity > 0 && std::isfinite(impact.velocity)), "the flyer's velocity must be > 0");
  refuse(!(impact.gap >= 0 && std::isfinite(impact.gap)), "the gap in front of the flyer must be >= 0");
  for (const Side side : {Side::bottom, Side::top})
    refuse(is(side, Support::driven) || is(side, Support::platen),
           "a driven side or a platen below or above would tie the flyer to the target (with impact)");
  if (impact.gap == 0) return;
  refuse(!is(Side::left, Support::free) || is(Side::bottom, Support::fixed) || is(Side::top, Support::fixed),
         "in front of a gap the flyer flies by itself: its left side is free, and it may slide along rollers only");
  const double steps = impact.gap / (impact.velocity * time_step);
  if (!(steps <= longest_flight))
    throw std::invalid_argument("mpm: the gap takes the flyer " + std::to_string(steps) +
                                " time steps, and a flight may have at most " + std::to_string(longest_flight));
}

void check(const Plate& plate, const Cells& cells, const std::vector<double>& positions,
           const std::optional<diffusion::Evolution>& evolution, const std::optional<diffusion::Spread>& spread,
           double time_step) {
  const auto* failure = std::get_if<material::FailureWave>(&plate.material);
  const bool damaging = std::holds_alternative<material::TensileDamage>(plate.material);
  refuse(cells.x < 1 || cells.y < 1 || positions.empty(), "a plate needs at least one cell and one particle");
  refuse(positions.size() > Arrangement::most, "at most 8 × 8 particles a cell");
  refuse(!std::is_sorted(positions.begin(), positions.end()) || positions.front() < 0 || positions.back() > 1,
         "particles stand at ascending natural coordinates in [0, 1]");
  refuse(damaging && !evolution, "tensile damage needs an evolution of its crack density");
  refuse(!damaging && evolution, "an evolution of the crack density needs a material with tensile damage");
  refuse(failure && !spread, "a failure wave needs the spread of its dilatancy");
  refuse(!failure && spread, "the spread of a dilatancy needs a material with a failure wave");
  refuse(failure && failure->elastic.plane == material::Plane::stress, "a failure wave is for plane strain only");
  refuse(failure && plate.compression, "a failure wave has no plasticity in compression beside it");
  refuse(failure && !(failure->threshold >= 0), "the threshold of a failure wave must be >= 0");
  refuse(failure && !(failure->most_converted >= 0 && failure->most_converted <= 1),
         "the part of the shear energy that a failure wave converts lies between 0 and 1");
  refuse(plate.convected && failure,
         "dilatancy stays in its cells, so particles that cross cells cannot have it (convected with a failure wave)");
  refuse(plate.viscosity && plate.viscosity->form != material::Viscosity::Form::york,
         "in a plate the artificial viscosity is that of eq. 21");
  refuse(plate.viscosity && (evolution || plate.compression),
         "artificial viscosity is for elastic plates and failure waves, not beside tensile damage or plasticity");
  refuse(plate.convected && plate.viscosity,
         "the artificial viscosity is for particles that keep their places (convected with viscosity)");
  for (const Gauge& gauge : plate.gauges)
    refuse(!(gauge.x >= 0 && gauge.x <= plate.width && gauge.y >= 0 && gauge.y <= plate.height),
           "a gauge stands in the plate");
  if (plate.impact) check_impact(plate, cells, time_step);
  refuse(plate.compression && elastic(plate).plane == material::Plane::stress,
         "plasticity in compression is for plane strain only");
  refuse(!(plate.pic >= 0 && plate.pic <= 1), "the part of PIC lies between 0 and 1");
  refuse(plate.convected && damaging,
         "damage stays in its cells, so particles that cross cells cannot have it (convected with tensile damage)");
  for (const Side side : sides) {
    const Edge& edge_of_plate = plate.edge(side);
    const auto is = [&](Edge::Support s) { return edge_of_plate.support == s; };
    refuse(is(Edge::Support::driven) && !edge_of_plate.velocity, "a driven side needs its velocity");
    refuse(plate.convected && (is(Edge::Support::driven) || is(Edge::Support::platen)),
           "a side that moves is not on the grid's nodes (convected with a driven side or a platen)");
    refuse(plate.convected && (edge_of_plate.normal_traction || edge_of_plate.shear_traction),
           "tractions act on the nodes of a side that stays there (convected with tractions)");
    const bool normal{edge_of_plate.normal_traction}, shear{edge_of_plate.shear_traction};
    refuse((is(Edge::Support::driven) || is(Edge::Support::fixed)) && (normal || shear),
           "a traction on a side that is driven or fixed does nothing");
    refuse(is(Edge::Support::roller) && normal, "a normal traction on rollers does nothing");
    refuse(is(Edge::Support::platen) && shear, "a platen is frictionless and passes no shear on");
    const auto held = [&](Side beside) {
      const auto support = plate.edge(beside).support;
      return support == Edge::Support::fixed || support == Edge::Support::driven;
    };
    refuse(is(Edge::Support::platen) && (across(side) ? cells.y == 1 && held(Side::bottom) && held(Side::top)
                                                      : cells.x == 1 && held(Side::left) && held(Side::right)),
           "a platen whose nodes are all held by the sides beside it");
  }
}

}  // namespace

PlateRecord run(const Plate& plate, const Cells& cells, const std::vector<double>& positions, Scheme scheme,
                const std::optional<diffusion::Evolution>& evolution, const Stepping& stepping,
                const std::optional<diffusion::Spread>& spread) {
  check(plate, cells, positions, evolution, spread, stepping.time_step);
  const Setup setup{plate, cells, positions, scheme, evolution, stepping, spread};
  const bool yields = plate.compression.has_value();
  if (plate.convected) return yields ? run_body<Moving, Yielding>(setup) : run_body<Moving, Whole>(setup);
  if (spread) return run_body<Standing, Failing>(setup);
  if (evolution) return yields ? run_body<Standing, CrackedYielding>(setup) : run_body<Standing, Cracked>(setup);
  return yields ? run_body<Standing, Yielding>(setup) : run_body<Standing, Whole>(setup);
}

}  // namespace diptych::mpm
