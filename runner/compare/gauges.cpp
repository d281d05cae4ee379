#include "runner/compare/gauges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "analytic/diffusion_front.hpp"
#include "analytic/failure_point.hpp"
#include "analytic/impact_lattice.hpp"
#include "analytic/plate_impact.hpp"
#include "runner/input/plate_build.hpp"

namespace diptych::runner {
namespace {

/// To the larger of the two; NaN wins and stays.
void raise(double& to, double value) {
  if (!std::isnan(to) && !(value <= to)) to = value;
}

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

analytic::PlateImpact impact_of(const PlateSpec& plate) {
  return analytic::PlateImpact(
      {medium_of(plate), plate.width, plate.height, plate.flyer->thickness, plate.flyer->velocity});
}

/// When a history falls below a level after a time.
double first_fall(const History& h, double level, double after) {
  for (std::size_t n = 1; n < h.time.size(); ++n) {
    if (!(h.time[n] > after) || !(h.value[n] < level) || !(h.value[n - 1] >= level)) continue;
    return h.time[n - 1] + (level - h.value[n - 1]) / (h.value[n] - h.value[n - 1]) * (h.time[n] - h.time[n - 1]);
  }
  return nothing;
}

/// Whether the places of particles are the same seen from the right.
bool symmetric(const std::vector<double>& places) {
  for (std::size_t k = 0; k < places.size(); ++k)
    if (std::abs(places[k] + places[places.size() - 1 - k] - 1) > 1e-12) return false;
  return true;
}

/// What one history says; stresses compression positive.
struct StressReading {
  double arrival, rise, overshoot, plateau, release;
};
StressReading read_stress(const History& longitudinal, const ImpactTheory& theory, double end) {
  const double until = std::min(theory.release, end), quarter = (until - theory.arrival) / 4;
  StressReading reading{};
  reading.arrival = first_passage(longitudinal, theory.plateau / 2);
  reading.rise = first_passage(longitudinal, 0.9 * theory.plateau) - first_passage(longitudinal, 0.1 * theory.plateau);
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < longitudinal.time.size() && longitudinal.time[n] <= until; ++n)
    raise(largest, longitudinal.value[n]);
  reading.overshoot = largest / theory.plateau - 1;
  reading.plateau = mean_over(longitudinal, theory.arrival + quarter, until - quarter);
  reading.release = first_fall(longitudinal, theory.plateau / 2, reading.arrival);
  return reading;
}

History negative(const std::vector<double>& time, std::vector<double> stress) {
  for (double& value : stress) value = -value;
  return {time, std::move(stress)};
}

/// A linear viscosity ν spreads a step into ½ erfc((x − ct)/√(2νt)): from a tenth to nine tenths it takes 1.8124
/// √(2νt)/c.
double viscous_rise(const PlateSpec& plate, double cell, double arrival) {
  if (!plate.viscosity || plate.viscosity->c2 != 0 || !plate.viscosity->always) return nothing;
  const double speed = elastic_of(plate).pressure_wave_speed();
  const double nu = plate.viscosity->strength(speed, 0) * speed * cell;
  return 1.8123876 * std::sqrt(2 * nu * arrival) / speed;
}

void measure_failure(const Case& c, reports::Run& run) {
  if (c.gauges.size() < 2) return;
  const GaugeSpec &near = c.gauges.front(), &far = c.gauges.back();
  const auto failure = [&](const GaugeSpec& gauge) { return run.measures.at("gauge." + gauge.id + ".failure"); };
  const double first = failure(near), last = failure(far), speed = (far.from_face - near.from_face) / (last - first);
  if (!std::isfinite(speed)) return;
  run.measures["failure.speed"] = speed;
  run.measures["failure.delay"] = first - near.from_face / speed;
  run.measures["failure.slowing"] = last / first;
}

/// V_d in front of the shock and of the nodes that the cells at its foot touch.
void measure_ahead(const Case& c, const diffusion::Grid& grid, const PlateRecord& record, reports::Run& run) {
  const double face = c.plate->flyer->thickness, speed = elastic_of(*c.plate).pressure_wave_speed();
  double ahead = 0, largest = 0;
  for (const PlateSnapshot& s : record.snapshots) {
    for (std::size_t k = 0; k < s.concentration.size(); ++k) {
      const double x = static_cast<double>(k % (static_cast<std::size_t>(grid.nx) + 1)) * grid.hx;
      raise(largest, s.concentration[k]);
      if (std::abs(x - face) > speed * s.time + 3 * grid.hx) raise(ahead, std::abs(s.concentration[k]));
    }
  }
  if (!(largest <= 0)) run.measures["dilatancy.ahead"] = ahead / largest;
}

}  // namespace

double first_passage(const History& h, double level) {
  for (std::size_t n = 0; n < h.time.size(); ++n) {
    if (!(h.value[n] >= level)) continue;
    if (n == 0) return h.time[0];
    const double part = (level - h.value[n - 1]) / (h.value[n] - h.value[n - 1]);
    return h.time[n - 1] + part * (h.time[n] - h.time[n - 1]);
  }
  return nothing;
}

double mean_over(const History& h, double from, double to) {
  if (h.time.empty() || !(from >= h.time.front()) || !(to <= h.time.back()) || !(from < to)) return nothing;
  const auto at = [&](std::size_t n, double t) {
    return h.value[n] + (t - h.time[n]) / (h.time[n + 1] - h.time[n]) * (h.value[n + 1] - h.value[n]);
  };
  double sum = 0;
  for (std::size_t n = 0; n + 1 < h.time.size(); ++n) {
    const double a = std::max(from, h.time[n]), b = std::min(to, h.time[n + 1]);
    if (a < b) sum += (b - a) * (at(n, a) + at(n, b)) / 2;
  }
  return sum / (to - from);
}

ImpactTheory impact_theory(const PlateSpec& plate, double from_face) {
  const analytic::PlateImpact exact = impact_of(plate);
  const double x = plate.flyer->thickness + from_face;
  ImpactTheory theory{-exact.plateau(), exact.lateral_ratio(), exact.arrival(x), exact.release(x), nothing, nothing};
  const solid::Failing* failure = plate.failing();
  if (!failure || !(failure->law.most_converted > 0)) return theory;
  const material::PlaneElastic& solid = failure->law.elastic;
  const double strain = theory.plateau / solid.stiffness().normal;
  // What stops below the threshold never fails.
  if (!(2 * solid.stiffness().shear * strain > failure->law.threshold)) return theory;
  const analytic::UniaxialFailure point(solid.bulk_modulus(), solid.stiffness().shear);
  const double elastic = theory.lateral_ratio * theory.plateau;
  theory.failed_lateral = elastic * point.lateral(failure->law.most_converted);
  if (!(failure->spread.diffusivity > 0)) return theory;
  // The part of V_d,max at which the lateral stress is half-way, by halving: it rises with V_d.
  const double half_way = (elastic + theory.failed_lateral) / 2;
  double low = 0, high = failure->law.most_converted;
  while (high - low > 1e-14 * high) {
    const double f = (low + high) / 2;
    (elastic * point.lateral(f) < half_way ? low : high) = f;
  }
  const double level = point.dilatancy(low) / point.dilatancy(failure->law.most_converted);
  theory.failure = analytic::DiffusionFront({failure->spread.diffusivity, profile_of(failure->spread.profile)})
                       .arrival(from_face, level);
  return theory;
}

void measure_gauges(const Case& c, const Leaf& leaf, const diffusion::Grid& grid, const PlateRecord& record,
                    double time_step, reports::Run& run) {
  const PlateSpec& plate = *c.plate;
  if (!plate.flyer) return;
  if (plate.flyer->gap > 0 && panel(leaf.method).grid_contact)
    run.measures["impact.left-over"] = record.left_over / run.cell_size;
  if (plate.failing()) measure_ahead(c, grid, record, run);
  using Support = Edge::Support;
  const std::array strip{Support::free, Support::free, Support::roller, Support::roller};
  const bool by_waves = std::holds_alternative<solid::Elastic>(*plate.solid) && !compression_of(*plate.solid) &&
                        !plate.viscosity && plate.pic == 0 && plate.loads.empty() && plate.body_force[0].empty() &&
                        plate.supports == strip && symmetric(leaf.particles);
  std::optional<analytic::ImpactLattice> lattice;
  if (by_waves && !c.gauges.empty())
    if (const auto known = impact_lattice(plate, leaf, time_step)) lattice.emplace(*known);
  for (std::size_t g = 0; g < c.gauges.size(); ++g) {
    const GaugeSpec& gauge = c.gauges[g];
    const GaugeRecord& seen = record.gauges.at(g);
    run.gauges.push_back({gauge.id, gauge.from_face, seen.time, seen.xx, seen.yy, seen.dilatancy});
    const ImpactTheory theory = impact_theory(plate, gauge.from_face);
    const History longitudinal = negative(seen.time, seen.xx), lateral = negative(seen.time, seen.yy);
    const double end = seen.time.empty() ? 0 : seen.time.back();
    const auto put = [&](const char* what, double value, double exact) {
      const std::string name = "gauge." + gauge.id + "." + what;
      run.measures[name] = value;
      if (std::isfinite(exact)) run.measures[name + ".exact"] = exact;
    };
    const StressReading reading = read_stress(longitudinal, theory, end);
    const double until = std::min(theory.release, end), span = until - theory.arrival;
    const double elastic = theory.lateral_ratio * theory.plateau;
    put("arrival", reading.arrival, theory.arrival);
    put("rise", reading.rise, viscous_rise(plate, run.cell_size, theory.arrival));
    put("overshoot", reading.overshoot, nothing);
    put("plateau", reading.plateau, theory.plateau);
    put("release", reading.release, theory.release);
    put("ratio", mean_over(lateral, theory.arrival + span / 4, until - span / 4) / reading.plateau,
        theory.lateral_ratio);
    put("longitudinal", mean_over(longitudinal, until - 0.3 * span, until - 0.2 * span) / theory.plateau, nothing);
    put("lateral", mean_over(lateral, until - 0.3 * span, until - 0.2 * span) / elastic, nothing);
    put("failure",
        std::isfinite(theory.failed_lateral) ? first_passage(lateral, (elastic + theory.failed_lateral) / 2) : nothing,
        theory.failure);
    if (!lattice) continue;
    History expected{seen.time,
                     lattice->history(gauge.from_face + plate.flyer->thickness, static_cast<long>(seen.xx.size()))};
    double apart = 0;
    for (std::size_t n = 0; n < seen.xx.size(); ++n) {
      raise(apart, std::abs(expected.value[n] - seen.xx[n]) / theory.plateau);
    }
    run.measures["gauge." + gauge.id + ".prediction"] = apart;
    const StressReading predicted = read_stress(negative(expected.time, expected.value), theory, end);
    const auto predict = [&](const char* what, double value) {
      run.measures["gauge." + gauge.id + "." + what + ".predicted"] = value;
    };
    predict("arrival", predicted.arrival);
    predict("rise", predicted.rise);
    predict("overshoot", predicted.overshoot);
    predict("plateau", predicted.plateau);
    predict("release", predicted.release);
  }
  if (plate.failing()) measure_failure(c, run);
}

}  // namespace diptych::runner
