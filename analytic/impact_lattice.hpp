// What each scheme makes of the impact of two plates: exactly, wave by wave.
#pragma once

#include <vector>

#include "analytic/plane_discrete.hpp"

namespace diptych::analytic {

/// The strip of plate_impact.hpp on cells hx × hy, any number of them up the strip: its motion is along x alone and the
/// same in every row of cells, so one row stands for all. Nodes left of the face start at v, those on it at v/2: so
/// particles of MPM that start at v or at rest are mapped, and FEM is to be given it.
///
/// Reflected evenly at its free ends the row is part of an unbounded lattice whose waves are cosines of θ = kπ/N,
/// N cells. With s = sin(θ/2), C = c_dΔt/hx:
///   MPM   Q = 4C²s², filtered by 1 − a s², a the mean of 4ξ(1−ξ): the modal displacement after n steps is
///         Δt v̂ U_n,   U_n = sin nΩ/sin Ω, sin²(Ω/2) = Q(1 − a s²)/4 (MUSL); ½ sin((n−½)Ω)/sin(Ω/2), the same Ω (USF);
///         (z₊ⁿ − z₋ⁿ)/(z₊ − z₋), z² − (2 − Q) z + 1 − a s² Q = 0 (USL)
///   FEM   as MUSL without filter, two branches of it: with κ = (λ+2μ)/hx and g = μ hx/hy², the stiffness of corners
///         (mass ⅔ρhx) 2κ(1+s²) + 2g(1−s²), of cell middles (⅓ρhx) 2(κ+g), between the two −2(κ+g) cos(θ/2). A middle
///         that is not at its corners' mean shears the lower and the upper triangle: hence g, and hy.
class ImpactLattice {
 public:
  struct Parameters {
    PlaneMedium medium;
    PlaneDiscretisation scheme;
    int cells;        ///< N across, ≥ 2
    int face;         ///< column of nodes, 1 to N − 1
    double velocity;  ///< v [m/s], > 0
  };
  /// Throws std::invalid_argument where a parameter is out of range, particles do not lie symmetrically in their cells,
  /// and where the time step lets a wave grow.
  explicit ImpactLattice(const Parameters&);

  double stress_time(long n) const;            ///< of the stress after n ≥ 1 steps: nΔt, with USF (n − ½)Δt [s]
  double cell_stress(int cell, long n) const;  ///< mean σ_xx of a cell after n ≥ 1 steps [Pa]; σ_yy is λ/(λ+2μ) of it
  /// On the line between the middles of the two cells beside x, beyond the outermost middles their value [Pa]. Both
  /// throw std::domain_error outside the strip and for n < 1.
  double gauge(double x, long n) const;
  std::vector<double> history(double x, long steps) const;  ///< gauge after 1, 2, … steps, the same bits
  double phase(int k) const;  ///< Ω of the k-th (FEM: acoustic) wave, k = 1 to N − 1; of USL's overdamped ones 0 or π
  const Parameters& parameters() const { return p_; }

 private:
  /// One wave: weight · sin((i+½)θ) · U_n is its part of the stress of cell i.
  struct Wave {
    int k;
    double weight;
    double angle;        ///< Ω, or π − Ω where base < 0; NaN where z₊ and z₋ are real
    double base;         ///< ±√(z₊z₋), or the larger in magnitude of the two
    double small_share;  ///< the smaller of the two divided by the larger
  };
  double grown(const Wave&, long n) const;                         ///< U_n
  double sine(long m) const;                                       ///< sin(mπ/2N), m ≥ 0
  static Wave leapfrog(int k, double weight, double half_square);  ///< of sin²(Ω/2)
  std::vector<double> at(double x, long first, long last) const;
  void add_mpm();
  void add_fem();

  Parameters p_;
  double courant_;
  std::vector<double> sine_;  ///< m = 0 to 4N − 1
  std::vector<Wave> waves_;
};

/// By how much long waves are too slow, ω_h = ck (1 − D k²hx²/24 + …): D = 1 + 3a − C². Crossed triangles have
/// a = −(1 + 3γ)/(9(1 + γ)), γ = μ hx²/((λ+2μ) hy²): the row bears C up to 2/(3√(1 + γ)), where D is still
/// 2/(9(1 + γ)). D < 0 only above a stability limit. Throws std::invalid_argument for USL, which damps short waves
/// besides.
double impact_dispersion(const PlaneMedium&, const PlaneDiscretisation&);

/// w = [|D| c t hx²/8]^⅓ [m]: the front that has travelled ct is the Airy integral S(ξ) = ∫_ξ^∞ Ai, ξ = (x − ct)/w.
/// To leading order in h its half level is late by 0.409603 w/c, from a tenth to nine tenths it takes 2.167643 w/c, and
/// it overshoots by 27.435 %, on every mesh; after 400 cells that is so within 2, 1 and 3 %. With one particle a cell
/// neighbouring cells have it half a cell early and late by turns, and their mean in time.
double front_width(const PlaneMedium&, const PlaneDiscretisation&, double travelled);

}  // namespace diptych::analytic
