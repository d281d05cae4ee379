#include "runner/stability/about_rest.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "analytic/plane_discrete.hpp"
#include "runner/input/plate_build.hpp"
#include "runner/run/built.hpp"
#include "runner/stability/at_rest.hpp"

namespace diptych::runner {
namespace {

/// What the books of each step say that motion and strain hold.
template <class S, class R>
std::vector<double> followed_energies(const S&, const R& record) {
  std::vector<double> energies;
  for (const LedgerLine& line : record.ledger) energies.push_back(line.kinetic + std::abs(line.strain));
  return energies;
}

/// What diffuses has no energy; the sum of squares of its deviations from their mean stands for it.
std::vector<double> followed_energies(const DiffusionScene&, const PlateRecord& record) {
  std::vector<double> energies;
  for (const PlateSnapshot& snapshot : record.snapshots) {
    double sum = 0, squares = 0;
    for (const double value : snapshot.concentration) sum += value;
    const double mean = sum / static_cast<double>(snapshot.concentration.size());
    for (const double value : snapshot.concentration) squares += (value - mean) * (value - mean);
    energies.push_back(squares);
  }
  return energies;
}

template <class S>
constexpr bool has_books = !std::is_same_v<S, DiffusionScene>;

template <class S, class M, class R>
Growth followed(const LeafScene<S, M, R>& it, double number, long steps, const std::atomic<bool>* cancelled) {
  constexpr long samples = 200;  // of what has no books
  const long stride = has_books<S> ? 1 : std::max(1L, steps / samples);
  Stepping stepping;
  stepping.time_step = number * it.unit_time_step();
  stepping.gains = 1e30;  // what is looked at is growth without end, not whether a little is gained
  stepping.steps = steps;
  stepping.books = has_books<S> ? Books::lines : Books::off;
  stepping.cancelled = cancelled;
  if (!has_books<S>)
    for (long step = 0; step <= steps; step += stride) stepping.sample_after.push_back(step);
  const S scene = at_rest(it.scene);
  const R record = it.solver.run(scene, it.mesh, stepping);
  if (record.outcome == Outcome::left_grid) throw std::runtime_error(record.message);
  std::vector<double> energies = followed_energies(scene, record);
  std::erase_if(energies, [](double energy) { return !std::isfinite(energy); });
  Growth growth = growth_of(energies, stride, steps);
  // A million times what was put in, or no numbers any more.
  if (record.outcome == Outcome::unstable) growth.unstable = true;
  return growth;
}

// ---- theory ----

// Cells. Where an end is held the shortest wave is a little longer than two of them, by which the limit is higher: half
// a per cent for so many.
constexpr int long_enough = 16;

/// Whether the end that stands the least is free, as theory takes it: that whose node gets the lesser part of the mass
/// of the cell beside it.
bool weak_end_is_free(const BarLeaf& it) {
  double mean = 0;
  for (const double xi : it.mesh.particles) mean += xi / static_cast<double>(it.mesh.particles.size());
  const bool left = it.scene.left == Support::free, right = it.scene.right == Support::free;
  const double middle = mean - 0.5, round_off = 1e-12;
  return std::abs(middle) < round_off ? left || right : middle > 0 ? left : right;
}

std::optional<double> theory_of(const BarLeaf& it) {
  for (std::size_t bar = 0; bar < it.scene.bars.size(); ++bar)
    if (cells_of(it.scene, bar, it.mesh.cells) < long_enough) return {};
  if (it.scene.viscosity && it.scene.viscosity->form != material::Viscosity::Form::linear_quadratic) return {};
  if (it.row.particles && !weak_end_is_free(it)) return {};
  return it.predicted_limit();
}

/// Rollers are mirrors of the lattice only where the particles of a cell are.
bool mirrored_in_themselves(const std::vector<double>& particles) {
  constexpr double round_off = 1e-12;
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (std::abs(particles[i] + particles[particles.size() - 1 - i] - 1) > round_off) return false;
  return true;
}

std::optional<double> theory_of(const PlateLeaf& it) {
  const auto all = [&](Edge::Support support) {
    return std::all_of(it.scene.edges.begin(), it.scene.edges.end(),
                       [&](const Edge& edge) { return edge.support == support; });
  };
  const bool free = all(Edge::Support::free), rollers = all(Edge::Support::roller);
  if (it.scene.pic > 0 || it.scene.viscosity || !(free || rollers)) return {};
  const auto scheme = plane_discretisation(*it.c.plate, it.leaf, it.asked_time_step());
  if (!scheme) return {};
  const analytic::PlaneMedium medium = medium_of(*it.c.plate);
  constexpr std::size_t most = 100;  // cells; the eigenvalues of more take minutes
  const diffusion::Grid& grid = it.mesh.grid;
  if (rollers && (std::min(grid.nx, grid.ny) < long_enough || !mirrored_in_themselves(it.mesh.particles))) return {};
  const double limit = rollers                ? analytic::interior_stability_limit(medium, *scheme)
                       : grid.cells() <= most ? analytic::free_stability_limit(medium, *scheme, grid.nx, grid.ny)
                                              : analytic::plane_stability_limit(medium, *scheme);
  return limit / it.unit_time_step();
}

std::optional<double> theory_of(const DiffusionLeaf& it) {
  const DiffusivityRange range = range_of(it.scene, it.mesh);
  const double limit = it.limit();
  if (it.scene.spread || !(range.largest > 0) || !std::isfinite(limit)) return {};
  if (it.scene.reading != diffusion::Reading::isotropic) return {};
  for (int j = 0; j < it.mesh.ny; ++j)
    for (int i = 0; i < it.mesh.nx; ++i)
      if (it.scene.diffusivity((i + 0.5) * it.mesh.hx, (j + 0.5) * it.mesh.hy) != range.largest) return {};
  return limit / it.unit_time_step();
}

}  // namespace

Growth growth_about_rest(const Case& c, const Leaf& leaf, double number, long steps,
                         const std::atomic<bool>* cancelled) {
  return built(c, leaf, [&](const auto& it) { return followed(it, number, steps, cancelled); });
}

std::optional<double> limit_about_rest(const Case& c, const Leaf& leaf) {
  return built(c, leaf, [&](const auto& it) { return theory_of(it); });
}

}  // namespace diptych::runner
