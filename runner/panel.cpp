#include "runner/panel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "fem/bar.hpp"
#include "fem/plate.hpp"
#include "mpm/bar.hpp"
#include "mpm/plate.hpp"

namespace diptych::runner {
namespace {

// Colours after Okabe & Ito.
const reports::PanelLook fem_look{
    "fem",
    "FEM",
    false,
    {"lw 1.4 lc rgb '#08306b'", "lw 1.4 lc rgb '#0072b2' dt (8,3)", "lw 1.4 lc rgb '#56b4e9' dt (2,3)"},
    {"lw 0.8 lc rgb '#08306b' dt (14,6)", "lw 0.8 lc rgb '#0072b2' dt (14,6,3,6)", "lw 0.8 lc rgb '#56b4e9' dt (6,10)"},
    "lw 1.8 lc rgb '#08306b'"};
const reports::PanelLook mpm_look{
    "mpm",
    "MPM",
    true,
    {"lc rgb '#d55e00' pt 6 ps 0.55", "lc rgb '#009e73' pt 4 ps 0.5", "lc rgb '#cc79a7' pt 8 ps 0.65"},
    {"lc rgb '#d55e00' pt 2 ps 0.5", "lc rgb '#009e73' pt 1 ps 0.6", "lc rgb '#cc79a7' pt 3 ps 0.6"},
    "lw 2.0 lc rgb '#d55e00' dt (9,5)"};
const reports::PanelLook diffusion_look{"diffusion",
                                        "diffusion",
                                        false,
                                        {"lw 1.2 lc rgb '#000000'"},
                                        {"lw 0.8 lc rgb '#000000'"},
                                        "lw 1.4 lc rgb '#000000'"};

using BarTheory = analytic::Scheme;
using PlateTheory = analytic::PlaneDiscretisation::Method;

Panel fem_panel() {
  Panel p{.id = "fem", .name = "FEM", .look = fem_look, .work = "element-steps", .elements = true};
  p.refuses = {{"boundary-layer"}, {"body-force", "convection"}};
  p.usual = true;
  p.shows_not = {"convection", "pic"};  // its mesh goes with the material, and it maps no velocities
  p.bar_theory = BarTheory::fem;
  p.plate_theory = PlateTheory::fem;
  p.bars.limit = [](const Scene& scene, const BarMesh& mesh) { return fem::critical_time_step(scene, mesh.cells); };
  p.bars.run = [](const Scene& scene, const BarMesh& mesh, const Stepping& stepping) {
    return fem::run(scene, mesh.cells, stepping);
  };
  p.plate.limit = [](const Plate& plate, const PlateMesh& mesh) {
    return fem::critical_time_step(plate, mesh.cells());
  };
  p.plate.run = [](const Plate& plate, const PlateMesh& mesh, const Stepping& stepping) {
    return fem::run(plate, mesh.cells(), stepping);
  };
  return p;
}

Panel mpm_panel(const char* id, const char* name, mpm::Scheme scheme, BarTheory of_bars, PlateTheory of_plates) {
  Panel p{.id = id, .name = name, .look = mpm_look, .work = "particle-steps", .particles = true, .grid_contact = true};
  p.usual = scheme == mpm::Scheme::musl;
  p.half_steps = scheme == mpm::Scheme::usf;
  p.bar_theory = of_bars;
  p.plate_theory = of_plates;
  p.bars.limit = [=](const Scene& scene, const BarMesh& mesh) {
    return mpm::critical_time_step(scene, mesh.cells, mesh.particles, scheme);
  };
  p.bars.run = [=](const Scene& scene, const BarMesh& mesh, const Stepping& stepping) {
    return mpm::run(scene, mesh.cells, mesh.particles, scheme, stepping);
  };
  p.plate.limit = [=](const Plate& plate, const PlateMesh& mesh) {
    return mpm::critical_time_step(plate, mesh.cells(), mesh.particles, scheme);
  };
  p.plate.run = [=](const Plate& plate, const PlateMesh& mesh, const Stepping& stepping) {
    return mpm::run(plate, mesh.cells(), mesh.particles, scheme, stepping);
  };
  return p;
}

Panel diffusion_panel() {
  Panel p{.id = "diffusion", .name = "Diffusion", .look = diffusion_look, .work = "particle-steps"};
  p.diffusion.limit = [](const DiffusionScene& scene, const diffusion::Grid& grid) {
    if (scene.scheme != diffusion::Scheme::forward_euler) return std::numeric_limits<double>::infinity();
    return diffusion::forward_euler_limit(grid, range_of(scene, grid).largest);
  };
  p.diffusion.run = run_diffusion;
  return p;
}

}  // namespace

Registry<Panel>& panels() {
  static Registry<Panel> rows(
      {
          fem_panel(),
          mpm_panel("mpm-usf", "MPM, USF", mpm::Scheme::usf, BarTheory::mpm_usf, PlateTheory::usf),
          mpm_panel("mpm-usl", "MPM, USL", mpm::Scheme::usl, BarTheory::mpm_usl, PlateTheory::usl),
          mpm_panel("mpm-musl", "MPM, MUSL", mpm::Scheme::musl, BarTheory::mpm_musl, PlateTheory::musl),
          diffusion_panel(),
      },
      "a method");
  return rows;
}

bool Panel::takes(SceneKind kind) const {
  switch (kind) {
    case SceneKind::bars: return bool{bars.run};
    case SceneKind::plate: return bool{plate.run};
    case SceneKind::diffusion: return bool{diffusion.run};
  }
  return false;
}

bool Panel::has_theory(SceneKind kind) const {
  return kind == SceneKind::bars ? bar_theory.has_value() : kind == SceneKind::plate && plate_theory.has_value();
}

const Panel& panel(const std::string& id) {
  if (const Panel* found = panels().find(id)) return *found;
  std::string ids;
  for (const Panel& p : panels()) ids += (ids.empty() ? "" : ", ") + p.id;
  throw std::invalid_argument(fmt::format("no method is called '{}'; there are {}", id, ids));
}

const Panel& panel(analytic::Scheme scheme) {
  for (const Panel& p : panels())
    if (p.bar_theory == scheme) return p;
  throw std::invalid_argument("no method is of this scheme");
}

std::vector<std::string> panels_for(SceneKind kind) {
  std::vector<std::string> ids;
  for (const Panel& p : panels())
    if (p.takes(kind)) ids.push_back(p.id);
  return ids;
}

std::vector<reports::PanelLook> looks() {
  std::vector<reports::PanelLook> all;
  for (const Panel& p : panels())
    if (std::none_of(all.begin(), all.end(), [&](const auto& look) { return look.id == p.look.id; }))
      all.push_back(p.look);
  return all;
}

}  // namespace diptych::runner
