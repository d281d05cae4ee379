#include "runner/run/diffusion_leaf.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "runner/input/messages.hpp"
#include "runner/input/plate_build.hpp"
#include "runner/run/plate_leaf.hpp"
#include "runner/run/plate_measures.hpp"

namespace diptych::runner {

DiffusionLeaf::DiffusionLeaf(const Case& case_of_leaf, const Leaf& one)
    : LeafScene(case_of_leaf, one, panel(one.method), panel(one.method).diffusion, make_diffusion(case_of_leaf),
                grid_of(*case_of_leaf.plate, one.cells)),
      exact_([&case_of_leaf] { return make_plane_exact(case_of_leaf); }) {
  const DiffusivityRange range = range_of(scene, mesh);
  if (range.wrong)
    throw InputError(fmt::format("{}: diffusion.diffusivity: found {:g} at the middle of some cell; allowed: >= 0",
                                 c.path.string(), *range.wrong));
  largest_diffusivity_ = range.largest;
}

double DiffusionLeaf::unit_time_step() const {
  const double h = std::min(mesh.hx, mesh.hy);
  return largest_diffusivity_ > 0 ? h * h / largest_diffusivity_ : c.times.back();
}

reports::Sample DiffusionLeaf::sample(const PlateSnapshot& own, const PlateSnapshot& at, double asked, bool keep_fields,
                                      const reports::Run& run) const {
  return measure_plane_sample(c, leaf, mesh, own, at, asked, keep_fields, exact_.get(), run);
}

void DiffusionLeaf::measure(const PlateRecord& record, const Stepping&, reports::Run& run) const {
  measure_plane_record(c, mesh, record, run);
}

double DiffusionLeaf::differing(const PlateRecord& a, const PlateRecord& b, const PowersOfTwo& by, bool mirror) const {
  return runner::differing(a, b, by, mirror);
}

void describe_diffusion(const Case& c, const Leaf& leaf, reports::Run& run) {
  const diffusion::Grid grid = grid_of(*c.plate, leaf.cells);
  run.cell_size = grid.hx;
  run.unknowns = static_cast<int>(grid.nodes());
}

}  // namespace diptych::runner
