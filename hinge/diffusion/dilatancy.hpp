// How the dilatancy of a failure wave spreads: nonlinear diffusion on the nodes of the cells, from the impact face into
// what the shock has passed.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "hinge/diffusion/concentration.hpp"

namespace diptych::diffusion {

enum class Profile {
  falling,   ///< d = d0 (1 − V_d/V_d,max), in the manner of eq. 25, our choice
  constant,  ///< d = d0
  rising     ///< d = d0 V_d/V_d,max: where cracks are, they let others through; the front has an end
};

struct Spread {
  double diffusivity = 8;  ///< d0 [m²/s], ≥ 0
  Profile profile = Profile::falling;
  bool ahead = false;  ///< also where the ceiling is not positive: ahead of the shock; for tests of the diffusion alone
  Scheme scheme = Scheme::sub_cycled;
  double drift = 0;                ///< of the implicit schemes' factorisation, see Concentration
  std::vector<double> start = {};  ///< V_d of nodes at the start; empty: none
  /// The face keeps the largest ceiling that it has met; false: it follows the ceiling of the present strain. With
  /// true the overshoot of a front that rings is kept for ever, and it is as large on every mesh: the damage then
  /// spreads from what no mesh gets rid of, and each method has a front of its own.
  bool keeps_largest = false;
  std::optional<int> face = {};  ///< column of nodes at the impact face, 0 to nx; none: nothing sets the damage off
};

/// ∂V_d/∂t = ∇·(d ∇V_d), no flux through the walls. The face's nodes hold the mean ceiling of the cells beside them
/// from the moment that one of these has one; where none has one any more, behind a release, they keep what they hold.
/// The face has fed what its nodes were raised by and what has flowed out of them.
class Dilatancy {
 public:
  /// Throws std::invalid_argument for a diffusivity that is not finite and ≥ 0, a face that is not in the grid and a
  /// start that is not one value a node.
  Dilatancy(const Spread&, const Grid&);

  /// From tⁿ⁻¹ to tⁿ = tⁿ⁻¹ + dt: V_d,max of the cells at tⁿ in, 0 where the shear stress is below the threshold. With
  /// these and the cells' V_d at tⁿ⁻¹ the face is set and d found, for the whole step. A ceiling that is NaN makes all
  /// NaN. Throws std::invalid_argument for a ceiling that is negative, and what Concentration::step does.
  void advance(std::span<const double> ceiling, double dt);

  std::span<const double> of_cells() const { return of_cells_; }  ///< mean of each cell's four nodes
  std::span<const double> of_nodes() const;
  double total() const;       ///< ∫V_d dA [m²]
  double fed() const;         ///< what the start and the face have given [m²]: total(), by the fluxes
  long node_updates() const;  ///< 0 until there is something to diffuse
  std::size_t bytes() const;

 private:
  double face_ceiling(std::span<const double> ceiling, std::size_t j) const;
  void set_face(std::span<const double> ceiling);
  double diffusivity(double ceiling, double dilatancy) const;
  void find_of_cells();

  Spread spread_;
  Grid grid_;
  Concentration field_;
  std::vector<double> of_cells_, diffusivity_, no_source_;
  std::vector<unsigned char> set_off_;  // each node of the face; empty without one
  double raised_ = 0;                   // fed by the start and by raising the face's nodes
  bool anything_ = false;               // until then V_d is zero and stays it
};

}  // namespace diptych::diffusion
