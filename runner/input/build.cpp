#include "runner/input/build.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "analytic/grid_contact.hpp"
#include "runner/input/constants.hpp"
#include "runner/input/expression.hpp"
#include "runner/input/histories.hpp"

namespace diptych::runner {
namespace {

using analytic::BarQuantity;

Load make_load(const Case& c, const LoadSpec& spec, int cells) {
  Load load;
  load.end = spec.end;
  load.transfer = spec.transfer;
  if (spec.transfer == Transfer::boundary_layer) load.layer_thickness = length_of(c, spec.layer_thickness, cells);
  if (spec.history == "expression") {
    load.mean_traction = mean_over(Expression(spec.expression, {"t"}, expression_constants(c)));
    return load;
  }
  const auto seconds = [&](const Measured& time) { return time.value * time_unit(c, time.unit); };
  load.mean_traction =
      mean_over({spec.history, spec.traction, seconds(spec.start), spec.history == "ramp" ? seconds(spec.rise) : 0,
                 spec.history == "impulse" ? seconds(spec.duration) : 0});
  return load;
}

/// Initial velocity of a standing mode, as a user would write it: not taken from the oracle that judges the run.
std::function<double(double)> mode_velocity(const Case& c) {
  const bool left = c.left == Support::fixed, right = c.right == Support::fixed;
  const double half_waves = left == right ? c.exact.parameters.at("mode") : c.exact.parameters.at("mode") - 0.5;
  const double k = half_waves * std::acos(-1.0) / c.first().length;
  const double amplitude = c.exact.parameters.at("amplitude") * k * material::wave_speed(c.first().material);
  return [=](double x) { return amplitude * (left ? std::sin(k * x) : std::cos(k * x)); };
}

/// An exact solution given as expressions of x and t. Its scale is the largest value met on a grid over the bar and the
/// time.
class ExpressionSolution final : public analytic::ExactSolution {
 public:
  explicit ExpressionSolution(const Case& c) {
    add(BarQuantity::stress, c.exact.stress, c);
    add(BarQuantity::velocity, c.exact.velocity, c);
    add(BarQuantity::displacement, c.exact.displacement, c);
  }
  std::string name() const override { return "expressions"; }
  double at(BarQuantity q, double x, double t) const override { return formulas_.at(q)(x, t); }
  std::vector<analytic::Front> fronts(double) const override { return {}; }
  double scale(BarQuantity q) const override { return scales_.count(q) ? scales_.at(q) : 1; }
  bool gives(BarQuantity q) const override { return formulas_.count(q) > 0; }
  /// One's own expressions are taken at their word: nothing says what they solve.
  double residual(double) const override { return 0; }

 private:
  void add(BarQuantity q, const std::string& formula, const Case& c) {
    if (formula.empty()) return;
    const Expression& f = formulas_.emplace(q, Expression(formula, {"x", "t"}, expression_constants(c))).first->second;
    const double end = instant(c, 1, c.times.back()), length = begins_of(c, 1).back() + c.bars.back().length;
    double largest = 0;
    for (int i = 0; i <= 64; ++i) {
      for (int j = 0; j <= 64; ++j) largest = std::max(largest, std::abs(f(length * i / 64, end * j / 64)));
    }
    scales_[q] = largest > 0 ? largest : 1;
  }

  std::map<BarQuantity, Expression> formulas_;
  std::map<BarQuantity, double> scales_;
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

/// How much nearer to the bar before it a bar of particles may come than its ends allow before the grid makes them
/// touch: the rest of the gap when rigid flight first puts the two on one node. 0 where contact is of ends, and where
/// they do not close in.
double standoff(const Case& c, const Leaf& leaf, std::size_t bar) {
  if (!panel(leaf.method).grid_contact) return 0;
  const double h = c.first().length / leaf.cells, origin = begins_of(c, leaf.cells)[bar - 1];
  const double gap = length_of(c, c.bars[bar].gap, leaf.cells), end = origin + c.bars[bar - 1].length;
  const double before = velocity_of(c, bar - 1), after = velocity_of(c, bar);
  if (!(before > after)) return 0;
  const double time = analytic::grid_contact_time(
      {end - (1 - leaf.particles.back()) * h, end + gap + leaf.particles.front() * h, before, after, h});
  return std::max(0.0, gap - (before - after) * time);
}

}  // namespace

double CloserBars::shift_at(double x) const {
  std::size_t bar = begins_.size() - 1;
  while (bar > 0 && x < begins_[bar]) --bar;
  return shifts_[bar];
}

std::vector<analytic::Front> CloserBars::fronts(double t) const {
  auto found = solution_->fronts(t);
  for (analytic::Front& front : found) {
    std::size_t bar = begins_.size() - 1;
    while (bar > 0 && front.position < begins_[bar] - shifts_[bar]) --bar;
    front.position += shifts_[bar];
  }
  return found;
}

std::string words_of(const BarSpec& bar) {
  std::string text = fmt::format("E = {:g}, ρ = {:g}, L = {:g}", material::youngs_modulus(bar.material),
                                 material::density(bar.material), bar.length);
  for (const material::Parameter& more : material::parameters(bar.material))
    text += fmt::format(", {} {:g}", more.words, more.value);
  return text;
}

std::string words_of(const material::Viscosity& v) {
  const std::string constants = fmt::format("c1 = {:g}, c2 = {:g}", v.c1, v.c2);
  return (v.form == material::Viscosity::Form::york
              ? fmt::format("of eq. 21: {}, λ = {:g}, g = {:g} cells", constants, v.bulk, v.length)
              : "ρ(c1 c h|D| + c2 h²D²): " + constants) +
         (v.always ? ", also in expansion" : "");
}

double velocity_of(const Case& c, std::size_t bar) {
  const std::string& formula = c.bars[bar].velocity;
  return formula.empty() ? 0 : Expression(formula, {}, expression_constants(c))();
}

std::vector<double> begins_of(const Case& c, int cells) {
  std::vector<double> begins{0};
  for (std::size_t b = 1; b < c.bars.size(); ++b)
    begins.push_back(begins.back() + c.bars[b - 1].length + length_of(c, c.bars[b].gap, cells));
  return begins;
}

std::vector<Span> spans_of(const Case& c, int cells) {
  std::vector<Span> spans;
  const std::vector<double> begins = begins_of(c, cells);
  for (std::size_t b = 0; b < begins.size(); ++b) spans.push_back({begins[b], begins[b] + c.bars[b].length});
  return spans;
}

material::Viscosity viscosity_of(const Case& c) {
  material::Viscosity v = c.viscosity->form;
  v.c1 = Expression(c.viscosity->c1, {}, expression_constants(c))();
  v.c2 = Expression(c.viscosity->c2, {}, expression_constants(c))();
  return v;
}

double viscosity_strength(const Case& c) {
  const material::Viscosity v = viscosity_of(c);
  return v.form == material::Viscosity::Form::york ? v.bulk * v.length * (v.c1 + v.c2) : v.c1;
}

namespace {

/// closer: how much nearer than its ends allow a bar touches the one before.
double first_contact(const Case& c, int cells, const std::function<double(std::size_t bar)>& closer) {
  double first = std::numeric_limits<double>::infinity();
  for (std::size_t b = 1; b < c.bars.size(); ++b) {
    const double closing = velocity_of(c, b - 1) - velocity_of(c, b);
    if (closing > 0) first = std::min(first, (length_of(c, c.bars[b].gap, cells) - closer(b)) / closing);
  }
  return first;
}

}  // namespace

double contact_time(const Case& c, int cells) {
  return first_contact(c, cells, [](std::size_t) { return 0.0; });
}

double contact_time(const Case& c, const Leaf& leaf) {
  return first_contact(c, leaf.cells, [&](std::size_t b) { return standoff(c, leaf, b); });
}

double instant(const Case& c, int cells, double at) {
  return (c.from_contact ? contact_time(c, cells) : 0) + at * time_unit(c, c.time_unit);
}

double instant(const Case& c, const Leaf& leaf, double at) {
  return (c.from_contact ? contact_time(c, leaf) : 0) + at * time_unit(c, c.time_unit);
}

double time_unit(const Case& c, const std::string& unit) {
  return unit == "L/c" ? c.first().length / material::wave_speed(c.first().material) : 1;
}

double length_of(const Case& c, const Measured& m, int cells) {
  if (m.unit == "cells") return m.value * c.first().length / cells;
  return m.unit == "L" ? m.value * c.first().length : m.value;
}

Scene make_scene(const Case& c, int cells) {
  Scene scene;
  const std::vector<double> begins = begins_of(c, cells);
  scene.bars.resize(c.bars.size());
  for (std::size_t b = 0; b < c.bars.size(); ++b) {
    Bar& bar = scene.bars[b];
    bar.begin = begins[b];
    bar.length = c.bars[b].length;
    bar.material = c.bars[b].material;
    if (!c.bars[b].velocity.empty()) bar.initial_velocity = [v = velocity_of(c, b)](double) { return v; };
  }
  scene.contact = c.contact;
  if (c.viscosity) scene.viscosity = viscosity_of(c);
  scene.left = c.left;
  scene.right = c.right;
  scene.convected = c.convected;
  for (const LoadSpec& load : c.loads) scene.loads.push_back(make_load(c, load, cells));
  const auto all = expression_constants(c);
  if (!c.body_force.empty())
    scene.body_force = [f = Expression(c.body_force, {"x", "t"}, all)](double x, double t) {
      return finite_value("body_force", f, x, t);
    };
  for (Bar& bar : scene.bars) {
    if (!c.initial_velocity.empty())
      bar.initial_velocity = [f = Expression(c.initial_velocity, {"x"}, all)](double x) {
        return finite_value("initial.velocity", f, x);
      };
    if (!c.initial_stress.empty())
      bar.initial_stress = [f = Expression(c.initial_stress, {"x"}, all)](double x) {
        return finite_value("initial.stress", f, x);
      };
  }
  if (c.exact.solution == "standing-mode") scene.bars[0].initial_velocity = mode_velocity(c);
  return scene;
}

analytic::BarSetting bar_setting(const Case& c, int cells) {
  analytic::BarSetting setting;
  const std::vector<double> begins = begins_of(c, cells);
  for (std::size_t b = 0; b < c.bars.size(); ++b) {
    const material::Material& m = c.bars[b].material;
    analytic::ImpactBar bar{begins[b], c.bars[b].length, material::youngs_modulus(m), material::density(m),
                            velocity_of(c, b)};
    setting.laws.push_back(material::model(m));
    if (const auto curve = material::bilinear(m)) {
      bar.yield_stress = curve->yield_stress;
      bar.tangent_modulus = curve->tangent_modulus;
    } else {
      setting.curved.push_back(setting.laws.back());
    }
    setting.bars.push_back(bar);
    setting.flies = setting.flies || !c.bars[b].velocity.empty();
  }
  setting.left = bar_end(c, End::left);
  setting.right = bar_end(c, End::right);
  setting.bonded = c.contact == Contact::bonded;
  setting.parameters = c.exact.parameters;
  setting.body_force = !c.body_force.empty();
  setting.starts_otherwise = !c.initial_velocity.empty() || !c.initial_stress.empty();
  for (const LoadSpec& load : c.loads) setting.loads.push_back(load.history);
  return setting;
}

const analytic::BarSolution* solution_of(const Case& c) {
  for (const analytic::BarSolution& row : analytic::bar_solutions())
    if (row.name == c.exact.solution) return &row;
  return nullptr;
}

std::unique_ptr<analytic::ExactSolution> make_exact(const Case& c, const Leaf& leaf) {
  if (c.exact.solution == "expressions") return std::make_unique<ExpressionSolution>(c);
  const analytic::BarSolution* row = solution_of(c);
  if (!row) return nullptr;
  analytic::BarSetting setting = bar_setting(c, leaf.cells);
  if (!row->of_impact) return row->make(setting);
  std::vector<double> begins = begins_of(c, leaf.cells), shifts(begins.size());
  for (std::size_t b = 1; b < begins.size(); ++b) shifts[b] = shifts[b - 1] + standoff(c, leaf, b);
  for (std::size_t b = 0; b < begins.size(); ++b) setting.bars[b].begin = begins[b] - shifts[b];
  setting.until = instant(c, leaf, c.times.back());
  setting.bonded = setting.bonded && !panel(leaf.method).grid_contact;
  return std::make_unique<CloserBars>(row->make(setting), std::move(begins), std::move(shifts));
}

std::optional<analytic::Discretisation> discretisation(const Case& c, const Leaf& leaf, double courant) {
  const auto scheme = panel(leaf.method).bar_theory;
  if (!scheme) return {};
  return analytic::Discretisation{*scheme, c.first().length / leaf.cells, courant, leaf.particles};
}

double PowersOfTwo::time() const { return length * std::sqrt(density / modulus); }
double PowersOfTwo::velocity() const { return stress / std::sqrt(modulus * density); }

Scene scaled(const Scene& scene, const PowersOfTwo& by) {
  Scene out = scene;
  for (Bar& bar : out.bars) {
    bar.begin *= by.length;
    bar.length *= by.length;
    bar.material = material::scaled(bar.material, {by.modulus, by.stress, by.density});
    if (bar.initial_velocity) {
      bar.initial_velocity = [=, f = bar.initial_velocity](double x) { return by.velocity() * f(x / by.length); };
    }
    if (bar.initial_stress) {
      bar.initial_stress = [=, f = bar.initial_stress](double x) { return by.stress * f(x / by.length); };
    }
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
  return out;
}

Scene alone(const Scene& scene, std::size_t bar) {
  Scene out = scene;
  const bool first = bar == 0, last = bar + 1 == scene.bars.size();
  out.bars = {scene.bars[bar]};
  if (!first) out.left = Support::free;
  if (!last) out.right = Support::free;
  std::erase_if(out.loads, [&](const Load& load) { return load.end == End::left ? !first : !last; });
  return out;
}

Scene mirrored(const Scene& scene) {
  Scene out = scene;
  std::swap(out.left, out.right);
  for (Load& load : out.loads) load.end = load.end == End::left ? End::right : End::left;
  const double L = scene.begin() + scene.end();
  std::reverse(out.bars.begin(), out.bars.end());
  for (Bar& bar : out.bars) {
    bar.begin = L - bar.end();
    if (bar.initial_velocity) bar.initial_velocity = [=, f = bar.initial_velocity](double x) { return -f(L - x); };
    if (bar.initial_stress) bar.initial_stress = [=, f = bar.initial_stress](double x) { return f(L - x); };
  }
  if (scene.body_force) out.body_force = [=, f = scene.body_force](double x, double t) { return -f(L - x, t); };
  return out;
}

}  // namespace diptych::runner
