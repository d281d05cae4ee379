#include "cases/build.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analytic/bar_wave.hpp"
#include "analytic/standing_mode.hpp"
#include "cases/case_file.hpp"
#include "cases/expression.hpp"

namespace diptych::cases {
namespace {

using analytic::Quantity;

/// Mean over [from, to] of f(t) = amplitude for t ≥ start.
double mean_of_step(double amplitude, double start, double from, double to) {
  if (from >= start) return amplitude;
  if (to <= start) return 0;
  return amplitude * ((to - start) / (to - from));
}

/// Mean over [from, to] of a rise from 0 to the amplitude between start and start + rise.
double mean_of_ramp(double amplitude, double start, double rise, double from, double to) {
  if (from >= start + rise) return amplitude;
  const auto integral = [&](double t) {
    const double s = t - start;
    return s <= 0 ? 0 : s < rise ? s * s / (2 * rise) : s - rise / 2;
  };
  return amplitude * ((integral(to) - integral(from)) / (to - from));
}

Load make_load(const Case& c, const LoadSpec& spec, int cells) {
  Load load;
  load.end = spec.end;
  load.transfer = spec.transfer;
  if (spec.transfer == Transfer::boundary_layer) load.layer_thickness = length_of(c, spec.layer_thickness, cells);
  const double start = spec.start.value * time_unit(c, spec.start.unit), traction = spec.traction;
  if (spec.history == "step") {
    load.mean_traction = [=](double from, double to) { return mean_of_step(traction, start, from, to); };
  } else if (spec.history == "ramp") {
    const double rise = spec.rise.value * time_unit(c, spec.rise.unit);
    load.mean_traction = [=](double from, double to) { return mean_of_ramp(traction, start, rise, from, to); };
  } else if (spec.history == "impulse") {
    const double end = start + spec.duration.value * time_unit(c, spec.duration.unit);
    load.mean_traction = [=](double from, double to) {
      return mean_of_step(traction, start, from, to) - mean_of_step(traction, end, from, to);
    };
  } else {
    load.mean_traction = [f = Expression(spec.expression, {"t"}, expression_constants(c))](double from, double to) {
      return (f(from) + 4 * f((from + to) / 2) + f(to)) / 6;  // Simpson: exact for cubics
    };
  }
  return load;
}

/// Initial velocity of a standing mode, as a user would write it: not taken from the oracle that judges the run.
std::function<double(double)> mode_velocity(const Case& c) {
  const bool left = c.left == Support::fixed, right = c.right == Support::fixed;
  const double half_waves = left == right ? c.exact.mode : c.exact.mode - 0.5;
  const double k = half_waves * std::acos(-1.0) / c.length;
  const double amplitude = c.exact.amplitude * k * material::wave_speed(c.material);
  return [=](double x) { return amplitude * (left ? std::sin(k * x) : std::cos(k * x)); };
}

/// An exact solution given as expressions of x and t. Its scale is the largest value met on a grid over the bar and the
/// time.
class ExpressionSolution final : public analytic::ExactSolution {
 public:
  explicit ExpressionSolution(const Case& c) {
    add(Quantity::stress, c.exact.stress, c);
    add(Quantity::velocity, c.exact.velocity, c);
    add(Quantity::displacement, c.exact.displacement, c);
  }
  std::string name() const override { return "expressions"; }
  double at(Quantity q, double x, double t) const override { return formulas_.at(q)(x, t); }
  std::vector<analytic::Front> fronts(double) const override { return {}; }
  double scale(Quantity q) const override { return scales_.count(q) ? scales_.at(q) : 1; }
  bool gives(Quantity q) const override { return formulas_.count(q) > 0; }

 private:
  void add(Quantity q, const std::string& formula, const Case& c) {
    if (formula.empty()) return;
    const Expression& f = formulas_.emplace(q, Expression(formula, {"x", "t"}, expression_constants(c))).first->second;
    const double end = c.times.back() * time_unit(c, c.time_unit);
    double largest = 0;
    for (int i = 0; i <= 64; ++i) {
      for (int j = 0; j <= 64; ++j) largest = std::max(largest, std::abs(f(c.length * i / 64, end * j / 64)));
    }
    scales_[q] = largest > 0 ? largest : 1;
  }

  std::map<Quantity, Expression> formulas_;
  std::map<Quantity, double> scales_;
};

analytic::BarEnd bar_end(const Case& c, End end) {
  analytic::BarEnd out;
  out.fixed = (end == End::left ? c.left : c.right) == Support::fixed;
  for (const LoadSpec& load : c.loads) {
    if (load.end != end) continue;
    const double start = load.start.value * time_unit(c, load.start.unit);
    if (load.history == "step") out.traction = analytic::Traction::step(load.traction, start);
    if (load.history == "ramp") {
      out.traction = analytic::Traction::ramp(load.traction, load.rise.value * time_unit(c, load.rise.unit), start);
    }
    if (load.history == "impulse") {
      out.traction =
          analytic::Traction::impulse(load.traction, load.duration.value * time_unit(c, load.duration.unit), start);
    }
  }
  return out;
}

}  // namespace

double time_unit(const Case& c, const std::string& unit) {
  return unit == "L/c" ? c.length / material::wave_speed(c.material) : 1;
}

double length_of(const Case& c, const Measured& m, int cells) {
  if (m.unit == "cells") return m.value * c.length / cells;
  return m.unit == "L" ? m.value * c.length : m.value;
}

Scene make_scene(const Case& c, int cells) {
  Scene scene;
  scene.length = c.length;
  scene.material = c.material;
  scene.left = c.left;
  scene.right = c.right;
  scene.convected = c.convected;
  for (const LoadSpec& load : c.loads) scene.loads.push_back(make_load(c, load, cells));
  const auto all = expression_constants(c);
  if (!c.body_force.empty()) scene.body_force = Expression(c.body_force, {"x", "t"}, all);
  if (!c.initial_velocity.empty()) scene.initial_velocity = Expression(c.initial_velocity, {"x"}, all);
  if (!c.initial_stress.empty()) scene.initial_stress = Expression(c.initial_stress, {"x"}, all);
  if (c.exact.solution == "standing-mode") scene.initial_velocity = mode_velocity(c);
  return scene;
}

std::unique_ptr<analytic::ExactSolution> make_exact(const Case& c) {
  const double E = material::youngs_modulus(c.material), rho = material::density(c.material);
  const std::string& name = c.exact.solution;
  if (name == "none") return nullptr;
  if (name == "expressions") return std::make_unique<ExpressionSolution>(c);
  if (name == "standing-mode") {
    return std::make_unique<analytic::StandingMode>(analytic::StandingMode::Parameters{
        E, rho, c.length, c.left == Support::fixed, c.right == Support::fixed, c.exact.mode, c.exact.amplitude});
  }
  return std::make_unique<analytic::BarWave>(
      analytic::BarWave::Parameters{E, rho, c.length, bar_end(c, End::left), bar_end(c, End::right)});
}

analytic::Discretisation discretisation(const Case& c, const Leaf& leaf, double courant) {
  using analytic::Scheme;
  const Scheme scheme = leaf.method == "fem"       ? Scheme::fem
                        : leaf.method == "mpm-usf" ? Scheme::mpm_usf
                        : leaf.method == "mpm-usl" ? Scheme::mpm_usl
                                                   : Scheme::mpm_musl;
  return {scheme, c.length / leaf.cells, courant, leaf.particles};
}

double PowersOfTwo::time() const { return length * std::sqrt(density / modulus); }
double PowersOfTwo::velocity() const { return stress / std::sqrt(modulus * density); }

Scene scaled(const Scene& scene, const PowersOfTwo& by) {
  Scene out = scene;
  out.length *= by.length;
  if (auto* elastic = std::get_if<material::Elastic>(&out.material)) {
    elastic->youngs_modulus *= by.modulus;
    elastic->density *= by.density;
  }
  if (auto* hardening = std::get_if<material::Hardening>(&out.material)) {
    hardening->youngs_modulus *= by.modulus;
    hardening->tangent_modulus *= by.modulus;
    hardening->density *= by.density;
    hardening->yield_stress *= by.stress;
  }
  const double T = by.time();
  for (Load& load : out.loads) {
    load.layer_thickness *= by.length;
    load.mean_traction = [=, f = load.mean_traction](double from, double to) {
      return by.stress * f(from / T, to / T);
    };
  }
  if (scene.body_force) {
    out.body_force = [=, f = scene.body_force](double x, double t) {
      return by.velocity() / T * f(x / by.length, t / T);
    };
  }
  if (scene.initial_velocity) {
    out.initial_velocity = [=, f = scene.initial_velocity](double x) { return by.velocity() * f(x / by.length); };
  }
  if (scene.initial_stress) {
    out.initial_stress = [=, f = scene.initial_stress](double x) { return by.stress * f(x / by.length); };
  }
  return out;
}

Scene mirrored(const Scene& scene) {
  Scene out = scene;
  std::swap(out.left, out.right);
  for (Load& load : out.loads) load.end = load.end == End::left ? End::right : End::left;
  const double L = scene.length;
  if (scene.body_force) out.body_force = [=, f = scene.body_force](double x, double t) { return -f(L - x, t); };
  if (scene.initial_velocity) out.initial_velocity = [=, f = scene.initial_velocity](double x) { return -f(L - x); };
  if (scene.initial_stress) out.initial_stress = [=, f = scene.initial_stress](double x) { return f(L - x); };
  return out;
}

}  // namespace diptych::cases
