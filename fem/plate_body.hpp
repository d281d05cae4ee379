// The plate and its step, for one model of its solid: what plate_solid.cpp.in compiles.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fem/plate_books.hpp"
#include "fem/plate_border.hpp"
#include "fem/plate_material.hpp"
#include "fem/plate_mesh.hpp"
#include "fem/plate_sampling.hpp"
#include "fem/plate_stress.hpp"
#include "fem/plate_sweep.hpp"
#include "fem/plate_viscosity.hpp"
#include "hinge/scene/gauges.hpp"
#include "hinge/solid/cone.hpp"
#include "hinge/step/stepping.hpp"

namespace diptych::fem {

/// An elastic plate has displacements and velocities of nodes and nothing else.
template <solid::PlaneModel Model>
class PlateBody {
 public:
  template <class Solid>
  PlateBody(const Plate& plate, const Solid& solid, const Cells& cells, const Stepping& stepping)
      : dt_(stepping.time_step),
        impact_(plate.impact.has_value()),
        mesh_(plate, cells),
        rows_(mesh_.ny, stepping.threads),
        border_(plate, mesh_),
        stress_(solid.elastic().stiffness(), mesh_.h),
        material_(solid, mesh_, rows_, stress_, material::acting(plate.viscosity) != nullptr,
                  stepping.books != Books::off),
        sweep_(mesh_, border_, stress_, rows_, static_cast<bool>(plate.body_force),
               material::acting(plate.viscosity) != nullptr),
        books_(mesh_, rows_, border_, stress_, material_, viscosity_, dt_, stepping.books != Books::off),
        gauges_(plate, cells, stepping.steps, !material_.model().fields().dilatancy.empty()) {
    if (border_.has_platen()) platen_.reserve(static_cast<Index>(stepping.steps));
    if (material::acting(plate.viscosity)) viscosity_.emplace(plate, mesh_, stress_, rows_);
    // A plate at rest has no strains that cracks could grow by.
    if (Model::stands_at_start && plate.initial_displacement) material_.advance(dt_);
    if (!Model::linear) material_.update_stress(dt_, false);
  }

  // Central differences: (uⁿ, σⁿ, vⁿ⁻½) → (uⁿ⁺¹, σⁿ⁺¹, vⁿ⁺½).
  void step(long n, Ledger& ledger) {
    const Kick kick = kick_around(n, dt_);
    border_.external_force(kick);  // eqs. 17b, 20
    border_.note_velocities();
    sweep_.move_nodes(kick.length, dt_);  // eqs. 19, 18
    border_.move_platens(kick.length, dt_);
    border_.drive_supports((static_cast<double>(n) + 0.5) * dt_, dt_);
    books_.keep_work(kick.length, ledger);
    if (ledger.due()) books_.measure_energies(ledger);
    if (Model::staggered) material_.advance(dt_);  // eqs. 23 to 28, staggered
    if (!Model::linear || viscosity_) material_.update_stress(dt_, ledger.keeps());
    if (viscosity_) viscosity_->update();  // eqs. 21, 22
    if (ledger.due()) books_.close(ledger);
    if (border_.has_platen()) platen_.push_back(border_.platen_displacement());
    if (!gauges_.empty()) read_gauges(n + 1);
  }

  PlateSnapshot sample(long n) const {
    PlateSnapshot s = sample_mesh(mesh_, stress_, n, dt_);
    const solid::Fields fields = material_.model().fields();
    mesh_.for_cells([&](CellAt at) {
      const material::Tensor mean = mesh_.mean_strain(at);
      s.volumetric_strain.push_back(material_.model().volumetric(mean));
      if (!fields.crack_density.empty()) s.strain.push_back(mean);
    });
    s.take(fields);
    return s;
  }

  static std::string trouble() { return {}; }
  static double gives_back() { return Model::gives_back; }
  double first_ledger_time() const { return dt_ / 2; }
  double energy() const { return books_.energy(); }
  double momentum() const { return along_diagonal(mesh_.motion().momentum); }
  double free_mass() const { return border_.free() ? mesh_.density * mesh_.width * mesh_.height : 0; }
  /// Told by what this run has built up, not by what the scene asks for.
  std::vector<std::string> features() const {
    std::vector<std::string> active;
    material_.model().name_features(active);
    if (!mesh_.corners.body.x.empty()) active.emplace_back("body-force");
    if (impact_) active.emplace_back("impact");
    if (border_.has_platen()) active.emplace_back("platen");
    if (viscosity_ && viscosity_->acted()) active.emplace_back("viscosity");
    std::sort(active.begin(), active.end());
    return active;
  }
  Work work(long steps) const {
    Work sum;
    sum.element_steps = static_cast<long>(4 * mesh_.cells()) * steps;
    sum.node_steps = static_cast<long>((mesh_.nx + 1) * (mesh_.ny + 1) + mesh_.cells()) * steps;
    sum.bytes = mesh_.corners.bytes() + mesh_.middles.bytes() + border_.bytes() + stress_.bytes() + sweep_.bytes() +
                material_.bytes() + books_.bytes() + gauges_.bytes() + (viscosity_ ? viscosity_->bytes() : 0);
    return sum;
  }
  void complete(PlateRecord& record) {
    record.platen = std::move(platen_);
    record.gauges = gauges_.records();
    record.fed = material_.model().fed();
    record.diffusion_updates = material_.model().node_updates();
  }

 private:
  void read_gauges(long n) {
    const auto of_cell = [&](Index i, Index j) { return mean_stress(mesh_, stress_, {j * mesh_.nx + i, j}); };
    gauges_.read(static_cast<double>(n) * dt_, of_cell, material_.model().fields().dilatancy);
  }

  double dt_;
  bool impact_;
  Mesh mesh_;
  Rows rows_;
  Border border_;
  CellStress stress_;
  PlateMaterial<Model> material_;
  std::optional<ArtificialViscosity> viscosity_;
  Sweep sweep_;
  PlateBooks<Model> books_;
  Gauges gauges_;
  std::vector<double> platen_;  // displacement of the first one after each step
};

/// Runs a plate that has been checked and is of this solid.
template <class Solid>
PlateRecord run_solid(const Plate& plate, const Solid& solid, const Cells& cells, const Stepping& stepping) {
  return solid::with_model(solid, [&]<class Model>() {
    PlateBody<Model> body(plate, solid, cells, stepping);
    return take_steps<PlateRecord>(body, stepping);
  });
}

}  // namespace diptych::fem
