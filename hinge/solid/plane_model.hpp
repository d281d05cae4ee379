// What a plate's solid does in a run. Both panels are compiled once for every model and name none of them: a new law is
// a header beside this one, an entry of PlateSolid and a reader.
//
// Cells are numbered row by row from the bottom, each row from the left. How many points a cell has and where they
// stand in memory is the panel's business: FEM has the four triangles of each cell side by side, MPM has the particles
// of one place in each row of cells side by side.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hinge/diffusion/concentration.hpp"
#include "hinge/material/plane.hpp"

namespace diptych::solid {

/// What changes in a solid's cells, to be sampled and measured. Empty where there is no such thing.
struct Fields {
  std::span<const double> crack_density;  ///< C_d of each cell
  std::span<const double> dilatancy;      ///< V_d of each cell
  std::span<const double> concentration;  ///< C [1/m³], or V_d, of each node of the cells, row by row
};

/// The model of a solid, made as M(solid, grid, points) for the grid of cells and as many points as the panel stores.
///
/// Each model also has the constants
///   linear             every point is whole for ever: a panel need not ask
///   staggered          something changes in cells, between strain and stress: see driver
///   stands_at_start    ... and follows the strains at the start, before any time has passed
///   only_takes         ... and what it takes is gone: the ledger counts it as spent
///   yields             points have plastic strains
///   takes_viscosity    artificial viscosity may stand beside it
///   gives_back         largest part of the energy put in that a run may see given by the material
template <class M>
concept PlaneModel = requires(M m, const M k, const material::Tensor& strain, std::size_t cell, std::size_t point,
                              std::span<const double> drivers, double dt, double& dissipated,
                              std::vector<std::string>& active) {
  requires std::same_as<decltype(M::staggered), const bool> && std::same_as<decltype(M::stands_at_start), const bool>;
  requires std::same_as<decltype(M::only_takes), const bool> && std::same_as<decltype(M::yields), const bool>;
  requires std::same_as<decltype(M::takes_viscosity), const bool> && std::same_as<decltype(M::linear), const bool>;
  requires std::same_as<decltype(M::gives_back), const double>;
  /// The law of a row of cells from `cell` on whose points stand from `point` on: plain addresses, for a loop. Its
  /// stress(strain, cell, point) [Pa], counted from these, brings the point's plastic strain up to the strain;
  /// `dissipated` is then what flowed, σ : Δε_p [J/m³].
  { m.row(cell, point).stress(strain, cell, point) } -> std::same_as<material::Tensor>;
  { m.row(cell, point).stress(strain, cell, point, dissipated) } -> std::same_as<material::Tensor>;
  /// The stress that stands, for books, gauges and samples; changes nothing [Pa].
  { k.standing(strain, cell, point) } -> std::same_as<material::Tensor>;
  /// Recoverable energy [J/m³].
  { k.stored(strain, cell, point) } -> std::same_as<double>;
  /// Whether the point's stress and energy are, to the bit, those of a whole solid that has never flowed.
  { k.whole(cell, point) } -> std::same_as<bool>;
  /// Whether the stress of cells that do not change is the derivative of `stored`.
  { k.has_potential() } -> std::same_as<bool>;
  /// What a cell's mean strain shows to what changes in cells, as a value that a loop calls; NaN of NaN.
  { k.driver()(strain) } -> std::same_as<double>;
  /// All cells' drivers in, at the end of a step of dt [s]. Cells take up what follows by `renew`, which is told the
  /// first of a run of cells and how many: before it `outdated` is true and the cell has its old law.
  {m.advance(drivers, dt)};
  { k.outdated(cell) } -> std::same_as<bool>;
  {m.renew(cell, cell)};
  { k.fields() } -> std::same_as<Fields>;
  /// ε_v of a mean strain, as the solid reads it.
  { k.volumetric(strain) } -> std::same_as<double>;
  { k.fed() } -> std::same_as<double>;         ///< see PlateRecord
  { k.node_updates() } -> std::same_as<long>;  ///< of the diffusion
  {k.name_features(active)};                   ///< told by what has been built up
  { k.bytes() } -> std::same_as<std::size_t>;
};

/// A law that stays what it is, in all cells and for ever. What remains for the model is its stress and its energy.
class Unchanging {
 public:
  static constexpr bool linear = false, staggered = false, stands_at_start = false, only_takes = false, yields = false;
  static constexpr bool takes_viscosity = true;
  static constexpr double gives_back = 0;

  explicit Unchanging(const material::PlaneElastic& elastic) : elastic_(elastic) {}
  bool has_potential() const { return true; }
  static auto driver() {
    return [](const material::Tensor&) { return 0.0; };
  }
  void advance(std::span<const double>, double) {}
  bool outdated(std::size_t) const { return false; }
  void renew(std::size_t, std::size_t) {}
  Fields fields() const { return {}; }
  double volumetric(const material::Tensor& mean) const { return elastic_.volumetric(mean); }
  double fed() const { return 0; }
  long node_updates() const { return 0; }
  std::size_t bytes() const { return 0; }

 private:
  material::PlaneElastic elastic_;
};

/// From the first of these cells that is outdated to past the last: from = to where none is.
struct CellSpan {
  std::size_t from, to;
};
template <class Model>
CellSpan outdated_in(const Model& model, CellSpan cells) {
  while (cells.from < cells.to && !model.outdated(cells.from)) ++cells.from;
  while (cells.from < cells.to && !model.outdated(cells.to - 1)) --cells.to;
  return cells;
}

}  // namespace diptych::solid
