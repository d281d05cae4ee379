#include "runner/diffusion_alone.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "hinge/step/stepping.hpp"

namespace diptych::runner {
namespace {

/// What take_steps asks of a body that has no mechanics: it holds no energy and meets no trouble.
class NoMechanics {
 public:
  double first_ledger_time() const { return 0; }
  double energy() const { return 0; }
  double momentum() const { return 0; }
  double free_mass() const { return 0; }
  double gives_back() const { return 0; }
  std::string trouble() const { return {}; }
  std::vector<std::string> features() const { return {"diffusion"}; }
};

PlateSnapshot of_nodes(std::span<const double> values, long step, double time_step) {
  PlateSnapshot snapshot;
  snapshot.step = step;
  snapshot.time = static_cast<double>(step) * time_step;
  snapshot.concentration.assign(values.begin(), values.end());
  return snapshot;
}

Work work_of(const auto& field) {
  Work work;
  work.node_steps = field.node_updates();
  work.bytes = field.bytes();
  return work;
}

class Concentrating : public NoMechanics {
 public:
  Concentrating(const DiffusionScene& scene, const diffusion::Grid& grid, double time_step)
      : scene_(scene), grid_(grid), dt_(time_step), field_(grid, scene.scheme, scene.reading), source_(grid.nodes()) {
    for (std::size_t k = 0; k < source_.size(); ++k) area_.push_back(node_area(grid, k));
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i)
        diffusivity_.push_back(scene.diffusivity((x(i) + x(i + 1)) / 2, (y(j) + y(j + 1)) / 2));
    if (scene.initial) at_nodes(field_.values(), scene.initial);
    start_ = field_.total();
  }

  void step(long n, Ledger&) {
    const double middle = (static_cast<double>(n) + 0.5) * dt_;
    if (scene_.rate) at_nodes(source_, [&](double px, double py) { return scene_.rate(px, py, middle); });
    if (scene_.corner_rate != 0)
      source_[0] = scene_.corner_rate / (grid_.hx * grid_.hy / 4);  // of the corner's quarter
    const std::size_t fed = scene_.rate ? source_.size() : scene_.corner_rate != 0 ? 1 : 0;
    for (std::size_t k = 0; k < fed; ++k) fed_ += source_[k] * area_[k] * dt_;
    field_.step(diffusivity_, source_, dt_);
  }
  PlateSnapshot sample(long step) const { return of_nodes(field_.values(), step, dt_); }
  Work work(long) const { return work_of(field_); }
  void complete(PlateRecord& record) const { record.fed = fed_ + start_; }

 private:
  double x(int i) const { return scene_.width * i / grid_.nx; }
  double y(int j) const { return scene_.height * j / grid_.ny; }
  void at_nodes(std::span<double> values, auto&& value) const {
    for (int j = 0, k = 0; j <= grid_.ny; ++j)
      for (int i = 0; i <= grid_.nx; ++i, ++k) values[static_cast<std::size_t>(k)] = value(x(i), y(j));
  }

  const DiffusionScene& scene_;
  diffusion::Grid grid_;
  double dt_;
  diffusion::Concentration field_;
  std::vector<double> diffusivity_, area_, source_;
  double start_ = 0, fed_ = 0;
};

diffusion::Spread held_on_the_left(diffusion::Spread spread) {
  spread.face = 0;
  return spread;
}

class Spreading : public NoMechanics {
 public:
  Spreading(const diffusion::Spread& spread, const diffusion::Grid& grid, double time_step)
      : dt_(time_step), field_(held_on_the_left(spread), grid), ceiling_(grid.cells(), 1) {}

  void step(long, Ledger&) { field_.advance(ceiling_, dt_); }
  PlateSnapshot sample(long step) const { return of_nodes(field_.of_nodes(), step, dt_); }
  Work work(long) const { return work_of(field_); }
  void complete(PlateRecord& record) const { record.fed = field_.fed(); }

 private:
  double dt_;
  diffusion::Dilatancy field_;
  std::vector<double> ceiling_;
};

}  // namespace

double node_area(const diffusion::Grid& grid, std::size_t node) {
  const auto across = static_cast<std::size_t>(grid.nx) + 1;
  const std::size_t i = node % across, j = node / across;
  const bool side = i == 0 || i == across - 1, end = j == 0 || j == static_cast<std::size_t>(grid.ny);
  return grid.hx * grid.hy * (side ? 0.5 : 1) * (end ? 0.5 : 1);
}

DiffusivityRange range_of(const DiffusionScene& scene, const diffusion::Grid& grid) {
  DiffusivityRange range;
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      const double d = scene.diffusivity((i + 0.5) * grid.hx, (j + 0.5) * grid.hy);
      if (!(d >= 0) && !range.wrong) range.wrong = d;
      range.largest = std::max(range.largest, d);
    }
  }
  return range;
}

PlateRecord run_diffusion(const DiffusionScene& scene, const diffusion::Grid& grid, const Stepping& stepping) {
  if (scene.spread) {
    Spreading body(*scene.spread, grid, stepping.time_step);
    return take_steps<PlateRecord>(body, stepping);
  }
  Concentrating body(scene, grid, stepping.time_step);
  return take_steps<PlateRecord>(body, stepping);
}

}  // namespace diptych::runner
