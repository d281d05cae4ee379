#include "runner/input/plate_build.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runner/input/constants.hpp"
#include "runner/input/expression.hpp"
#include "runner/input/histories.hpp"
#include "runner/input/plate_solids.hpp"

namespace diptych::runner {
namespace {

using analytic::PlaneQuantity;

std::optional<Expression> compiled(const std::string& formula, const std::vector<std::string>& variables,
                                   const Case& c) {
  if (formula.empty()) return {};
  return Expression(formula, variables, expression_constants(c));
}

std::function<Vector(double, double, double)> vector_of_xyt(const Pair& pair, const Case& c) {
  if (pair[0].empty() && pair[1].empty()) return {};
  return [fx = *compiled(pair[0], {"x", "y", "t"}, c), fy = *compiled(pair[1], {"x", "y", "t"}, c)](double x, double y,
                                                                                                    double t) {
    return Vector{finite_value("body_force", fx, x, y, t), finite_value("body_force", fy, x, y, t)};
  };
}

std::function<Vector(double, double)> vector_of_xy(const Pair& pair, const Case& c) {
  if (pair[0].empty() && pair[1].empty()) return {};
  return [fx = *compiled(pair[0], {"x", "y"}, c), fy = *compiled(pair[1], {"x", "y"}, c)](double x, double y) {
    return Vector{finite_value("initial", fx, x, y), finite_value("initial", fy, x, y)};
  };
}

/// An exact solution given as expressions of x, y and t. Its scale is the largest value met on a grid over the plate
/// and the time.
class PlaneExpressions final : public analytic::PlaneSolution {
 public:
  explicit PlaneExpressions(const Case& c) {
    const PlateExact& exact = c.plate->exact;
    add(PlaneQuantity::displacement, {exact.displacement[0], exact.displacement[1]}, c);
    add(PlaneQuantity::velocity, {exact.velocity[0], exact.velocity[1]}, c);
    add(PlaneQuantity::stress, {exact.stress[0], exact.stress[1], exact.stress[2]}, c);
    add(PlaneQuantity::concentration, {exact.concentration}, c);
  }
  std::string name() const override { return "expressions"; }
  bool gives(PlaneQuantity q) const override { return formulas_.count(q) > 0; }
  std::array<double, 3> at(PlaneQuantity q, double x, double y, double t) const override {
    std::array<double, 3> value{};
    const auto& formulas = formulas_.at(q);
    for (std::size_t k = 0; k < formulas.size(); ++k) value[k] = formulas[k](x, y, t);
    return value;
  }
  double scale(PlaneQuantity q) const override { return scales_.at(q); }
  /// One's own expressions are taken at their word: nothing says what they solve.
  double residual(const analytic::PlaneWindow&) const override { return 0; }

 private:
  void add(PlaneQuantity q, const std::vector<std::string>& formulas, const Case& c) {
    if (formulas[0].empty()) return;
    for (const std::string& formula : formulas)
      formulas_[q].emplace_back(formula, std::vector<std::string>{"x", "y", "t"}, expression_constants(c));
    constexpr int points = 16;
    double largest = 0;
    for (int i = 0; i <= points; ++i)
      for (int j = 0; j <= points; ++j)
        for (int k = 0; k <= points; ++k) {
          const auto v = at(q, c.plate->width * i / points, c.plate->height * j / points, c.times.back() * k / points);
          largest = std::max(largest, std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
        }
    scales_[q] = largest > 0 ? largest : 1;
  }

  std::map<PlaneQuantity, std::vector<Expression>> formulas_;
  std::map<PlaneQuantity, double> scales_;
};

double diffusivity_at(const Case& c, double x, double y) {
  return (*compiled(c.plate->diffusion->diffusivity, {"x", "y"}, c))(x, y);
}

std::string scaled_words(double value, const char* unit) {
  const std::array<std::pair<double, const char*>, 3> prefixes{{{1e9, "G"}, {1e6, "M"}, {1e3, "k"}}};
  for (const auto& [factor, prefix] : prefixes)
    if (std::abs(value) >= factor) return fmt::format("{:g} {}{}", value / factor, prefix, unit);
  return fmt::format("{:g} {}", value, unit);
}

}  // namespace

Cells cells_of(const PlateSpec& plate, int cells) {
  if (plate.rows > 0) return {cells, plate.rows};
  const double up = plate.height / (plate.width / cells * plate.cell_aspect);
  return {cells, std::max(1, static_cast<int>(std::lround(up)))};
}

diffusion::Grid grid_of(const PlateSpec& plate, int cells) {
  const Cells n = cells_of(plate, cells);
  return {n.x, n.y, plate.width / n.x, plate.height / n.y};
}

PlateSolid solid_of(const Case& c, int cells) {
  const PlateSpec& plate = *c.plate;
  if (!plate.failing()) return *plate.solid;
  solid::Failing failing = *plate.failing();
  diffusion::Spread& spread = failing.spread;
  const auto face = plate.flyer ? std::optional(plate.flyer->thickness) : plate.face;
  if (face) spread.face = static_cast<int>(std::lround(*face * cells / plate.width));
  if (const auto f = compiled(plate.initial_concentration, {"x", "y"}, c)) {
    const diffusion::Grid grid = grid_of(plate, cells);
    for (int j = 0; j <= grid.ny; ++j)
      for (int i = 0; i <= grid.nx; ++i) spread.start.push_back((*f)(i * grid.hx, j * grid.hy));
  }
  return failing;
}

Plate make_plate(const Case& c, int cells) {
  const PlateSpec& spec = *c.plate;
  Plate plate;
  plate.width = spec.width;
  plate.height = spec.height;
  plate.solid = solid_of(c, cells);
  plate.convected = c.convected;
  plate.pic = spec.pic;
  plate.viscosity = spec.viscosity;
  if (spec.flyer) {
    const FlyerSpec& flyer = *spec.flyer;
    const double unit = flyer.gap_unit == "cells" ? spec.width / cells : 1;
    plate.impact = Impact{flyer.thickness, flyer.velocity, flyer.gap * unit};
    for (const GaugeSpec& gauge : c.gauges)
      plate.gauges.push_back({flyer.thickness + gauge.from_face, spec.height / 2});
  }
  for (std::size_t side = 0; side < 4; ++side) {
    plate.edges[side].support = spec.supports[side];
    if (spec.supports[side] == Edge::Support::driven) plate.edges[side].velocity = vector_of_xyt(spec.drive, c);
  }
  for (const SideLoad& load : spec.loads) {
    Edge& edge = plate.edge(load.side);
    auto& traction = load.shear ? edge.shear_traction : edge.normal_traction;
    if (load.history == "expression") {
      traction = mean_over(*compiled(load.traction, {"t"}, c));
    } else {
      traction = mean_over({load.history, (*compiled(load.traction, {}, c))(), load.start, load.rise, load.duration});
    }
  }
  plate.body_force = vector_of_xyt(spec.body_force, c);
  plate.initial_velocity = vector_of_xy(spec.initial_velocity, c);
  plate.initial_displacement = vector_of_xy(spec.initial_displacement, c);
  // A mode sets its own start, as a user would write it: not taken from the oracle that judges the run.
  const std::string& mode = spec.exact.solution;
  const bool lame = mode == "lame-mode", roller = mode == "roller-mode", p = mode == "p-wave", s = mode == "s-wave";
  if (lame || roller || p || s) {
    const material::PlaneElastic elastic = elastic_of(spec);
    const double k = spec.exact.parameters.at("mode") * std::numbers::pi / spec.width,
                 amplitude = spec.exact.parameters.at("amplitude");
    const double speed = lame || s ? elastic.shear_wave_speed() : elastic.pressure_wave_speed();
    const double omega = (lame || roller ? std::numbers::sqrt2 : 1) * k * speed;
    const bool from_rest = spec.exact.parameters.at("start") == 0;
    const double size = from_rest ? amplitude : amplitude * omega;
    const std::function<Vector(double, double)> shape = [=](double x, double y) -> Vector {
      if (lame) return {size * std::cos(k * x) * std::sin(k * y), -size * std::sin(k * x) * std::cos(k * y)};
      if (roller) return {size * std::sin(k * x) * std::cos(k * y), size * std::cos(k * x) * std::sin(k * y)};
      if (p) return {size * std::sin(k * x), 0};
      return {0, size * std::cos(k * x)};
    };
    (from_rest ? plate.initial_displacement : plate.initial_velocity) = shape;
  }
  return plate;
}

analytic::PlaneMedium medium_of(const PlateSpec& plate) {
  const material::PlaneElastic& e = elastic_of(plate);
  return analytic::plane_medium(e.youngs_modulus, e.poissons_ratio, e.density, e.plane == material::Plane::stress);
}

analytic::PlaneSetting plane_setting(const PlateSpec& plate) {
  analytic::PlaneSetting setting;
  setting.width = plate.width;
  setting.height = plate.height;
  for (std::size_t side = 0; side < 4; ++side)
    setting.supports[side] = support_names[static_cast<std::size_t>(plate.supports[side])];
  setting.elastic = plate.solid && std::holds_alternative<solid::Elastic>(*plate.solid);
  if (plate.flyer) setting.strike = {plate.flyer->thickness, plate.flyer->velocity};
  if (plate.diffusion) setting.corner_rate = plate.diffusion->corner_rate;
  setting.parameters = plate.exact.parameters;
  return setting;
}

const analytic::PlaneSolutionRow* plane_solution_of(const PlateSpec& plate) {
  for (const analytic::PlaneSolutionRow& row : analytic::plane_solutions())
    if (row.name == plate.exact.solution) return &row;
  return nullptr;
}

std::unique_ptr<analytic::PlaneSolution> make_plane_exact(const Case& c) {
  const PlateSpec& plate = *c.plate;
  if (plate.exact.solution == "expressions") return std::make_unique<PlaneExpressions>(c);
  const analytic::PlaneSolutionRow* row = plane_solution_of(plate);
  if (!row) return nullptr;
  analytic::PlaneSetting setting = plane_setting(plate);
  if (plate.solid) setting.medium = medium_of(plate);
  if (const auto& diffusion = plate.diffusion) {
    setting.diffusivity = diffusion->spread ? diffusion->spread->diffusivity : diffusivity_at(c, 0, 0);
    if (diffusion->spread) setting.profile = profile_of(diffusion->spread->profile);
  }
  return row->make(setting);
}

analytic::FrontProfile profile_of(diffusion::Profile profile) {
  switch (profile) {
    case diffusion::Profile::falling: return analytic::FrontProfile::falling;
    case diffusion::Profile::constant: return analytic::FrontProfile::constant;
    case diffusion::Profile::rising: return analytic::FrontProfile::rising;
  }
  return analytic::FrontProfile::constant;
}

std::optional<analytic::ImpactLattice::Parameters> impact_lattice(const PlateSpec& plate, const Leaf& leaf,
                                                                  double time_step) {
  const auto scheme = plane_discretisation(plate, leaf, time_step);
  if (!scheme) return {};
  return analytic::ImpactLattice::Parameters{
      medium_of(plate), *scheme, leaf.cells,
      static_cast<int>(std::lround(plate.flyer->thickness * leaf.cells / plate.width)), plate.flyer->velocity};
}

std::optional<analytic::PlaneDiscretisation> plane_discretisation(const PlateSpec& plate, const Leaf& leaf,
                                                                  double time_step) {
  const auto method = panel(leaf.method).plate_theory;
  if (!method) return {};
  const diffusion::Grid grid = grid_of(plate, leaf.cells);
  return analytic::PlaneDiscretisation{*method, grid.hx, grid.hy, time_step, leaf.particles};
}

DiffusionScene make_diffusion(const Case& c) {
  const PureDiffusion& spec = *c.plate->diffusion;
  DiffusionScene scene;
  scene.width = c.plate->width;
  scene.height = c.plate->height;
  scene.corner_rate = spec.corner_rate;
  scene.scheme = spec.scheme;
  scene.reading = spec.reading;
  scene.spread = spec.spread;
  if (spec.spread) {
    scene.diffusivity = [d = spec.spread->diffusivity](double, double) { return d; };
    return scene;
  }
  scene.diffusivity = [f = *compiled(spec.diffusivity, {"x", "y"}, c)](double x, double y) { return f(x, y); };
  if (const auto f = compiled(spec.rate, {"x", "y", "t"}, c))
    scene.rate = [f = *f](double x, double y, double t) { return f(x, y, t); };
  if (const auto f = compiled(c.plate->initial_concentration, {"x", "y"}, c))
    scene.initial = [f = *f](double x, double y) { return f(x, y); };
  return scene;
}

std::string words_of(const PlateSpec& plate) {
  std::string text = plate.rows > 0
                         ? fmt::format("{:g} m, {} row{} of cells", plate.width, plate.rows, plate.rows > 1 ? "s" : "")
                         : fmt::format("{:g} × {:g} m", plate.width, plate.height);
  if (!plate.solid) return text;
  const material::PlaneElastic& e = elastic_of(plate);
  return text + fmt::format(", E = {}, ν = {:g}, ρ = {:g} kg/m³, plane {}", scaled_words(e.youngs_modulus, "Pa"),
                            e.poissons_ratio, e.density, e.plane == material::Plane::stress ? "stress" : "strain");
}

std::map<std::string, std::string> plate_features(const Case& c) {
  std::map<std::string, std::string> used;
  const PlateSpec& plate = *c.plate;
  if (!plate.solid) {
    used["diffusion"] = "[diffusion]";
    return used;
  }
  const std::string feature = feature_of(*plate.solid);
  for (const PlateModel& model : plate_models())
    if (model.feature == feature) used[feature] = "material.model = \"" + model.name + "\"";
  if (diffuses(*plate.solid)) used["diffusion"] = "[diffusion]";
  if (compression_of(*plate.solid)) used["compression-plasticity"] = "material.compression";
  for (const auto support : plate.supports)
    if (support == Edge::Support::platen) used["platen"] = "a platen in [supports]";
  if (!plate.body_force[0].empty()) used["body-force"] = "[body_force]";
  if (c.convected) used["convection"] = "model.displacements = \"finite\"";
  if (plate.pic > 0) used["pic"] = "model.pic";
  if (plate.flyer) used["impact"] = "[flyer]";
  if (plate.viscosity) used["viscosity"] = "[viscosity]";
  return used;
}

}  // namespace diptych::runner
