#include "runner/run/doubt.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "analytic/bar_impact.hpp"
#include "analytic/bar_wave.hpp"
#include "analytic/diffusion_exact.hpp"
#include "analytic/diffusion_front.hpp"
#include "analytic/plane_modes.hpp"
#include "analytic/plastic_impact.hpp"
#include "analytic/plate_impact.hpp"
#include "analytic/standing_mode.hpp"
#include "runner/input/build.hpp"
#include "runner/input/plate_build.hpp"
#include "runner/run/outcomes.hpp"

namespace diptych::runner {
namespace {

constexpr double allowed_residual = 1e-4;  // room for the round-off of steep ramps; a wrong solution stands at 1

std::string doubt(double residual) {
  if (residual <= allowed_residual) return {};
  return fmt::format("the exact solution fails its own test: residual {:.3g}, allowed {:g}", residual,
                     allowed_residual);
}

std::string doubt_plane(const Case& c) {
  double worst = 0;
  const PlateExact& e = c.plate->exact;
  const auto exact = make_plane_exact(c);
  if (const auto* mode = dynamic_cast<const analytic::PlaneMode*>(exact.get())) {
    const analytic::SquareMode square{medium_of(*c.plate), c.plate->width, e.mode, e.amplitude, e.from_rest};
    const analytic::RectangleMode strip{square.medium, c.plate->width, c.plate->height,
                                        e.mode,        e.amplitude,    e.from_rest};
    worst = analytic::self_test(*mode,
                                e.solution == "lame-mode"     ? analytic::lame_problem(square)
                                : e.solution == "roller-mode" ? analytic::roller_problem(square)
                                : e.solution == "p-wave"      ? analytic::p_wave_problem(strip)
                                                              : analytic::s_wave_problem(strip),
                                c.times.back())
                .worst();
  }
  if (const auto* source = dynamic_cast<const analytic::CornerSource*>(exact.get())) {
    const double d = source->diffusivity(0, 0), q = c.plate->diffusion->corner_rate;
    analytic::DiffusionProblem problem{};
    problem.width = c.plate->width;
    problem.height = c.plate->height;
    problem.core = e.core;
    problem.diffusivity = [=](double, double) { return d; };
    problem.scale = std::abs(q) / d;
    problem.smooth_length = std::max(e.core, 0.05 * c.plate->width);
    worst = analytic::self_test(*source, problem, c.times.front(), c.times.back()).worst();
  }
  if (const auto* impact = dynamic_cast<const analytic::PlateImpact*>(exact.get()))
    worst = analytic::self_test(*impact, impact->parameters(), c.times.back()).worst();
  if (const auto* front = dynamic_cast<const analytic::FaceFront*>(exact.get())) {
    const auto found = analytic::self_test(*front, front->parameters(), c.times.front(), c.times.back());
    // Differences reach across the edge of a front that has one; its moment and its face tell nevertheless.
    const bool edge = front->parameters().profile == analytic::FrontProfile::rising;
    worst = edge && found.balance < 1 ? std::hypot(found.face, found.moment) : found.worst();
  }
  return doubt(worst);
}

}  // namespace

std::string doubt_exact(const Case& c) {
  if (c.plate) return doubt_plane(c);
  if (c.exact.solution == "impact" || c.exact.solution == "plastic-impact") return {};
  const auto exact = make_exact(c, {});
  // Long enough to see every front and its reflections, however short the runs are.
  double end = instant(c, 1, c.times.back());
  for (const LoadSpec& load : c.loads) {
    double settled = 5 * time_unit(c, "L/c");
    for (const Measured& part : {load.start, load.rise, load.duration}) settled += part.value * time_unit(c, part.unit);
    end = std::max(end, settled);
  }
  double worst = 0;
  if (const auto* bar = dynamic_cast<const analytic::BarWave*>(exact.get()))
    worst = analytic::self_test(*bar, end).worst();
  if (const auto* mode = dynamic_cast<const analytic::StandingMode*>(exact.get())) {
    worst = analytic::self_test(*mode, end).worst();
  }
  return doubt(worst);
}

std::string doubt_own(const analytic::ExactSolution* exact, double end) {
  if (const auto* impact = dynamic_cast<const analytic::BarImpact*>(inner(exact))) return doubt(audit(*impact).worst());
  if (const auto* plastic = dynamic_cast<const analytic::PlasticImpact*>(inner(exact)))
    return doubt(analytic::self_test(*plastic, end).worst());
  return {};
}

}  // namespace diptych::runner
