// The staggered coupling of wave and diffusion, one routine for both panels: mean strain of each cell in, crack density
// of each cell out.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "hinge/diffusion/concentration.hpp"

namespace diptych::diffusion {

/// ε̇_max of eqs. 23a and 26.
enum class Rate {
  reference,  ///< a fixed one
  tracked     ///< the largest that the cell's mean ε_v has met, at least rate_floor
};

/// Where the source of eq. 26 acts.
enum class Source {
  zone,  ///< within `radius` of the origin: each quarter of a cell by the part of it that lies inside
  node,  ///< at the origin's node alone (the literal reading; it does not converge)
  everywhere
};

/// C_d of eq. 23a, of ε_v > 0 and ε̇_max > 0 [1/s]: how fast cracks come is the material's to say.
using CrackGrowth = std::function<double(double volumetric_strain, double strain_rate)>;

/// Eqs. 25–28 with the choices that the paper leaves open. Where ε_v ≥ ε_v1 the source is Q = C_d(ε_v, ε̇)/T_d, C_d that
/// of CrackGrowth.
struct Diffusion {
  double characteristic_time = 0.01;  ///< T_d [s]
  double mobility = 500;              ///< λ1 [m²/s]
  /// Least part of λ1 that is left of eq. 25, which gives none at all beyond ε_vf: what has ruptured would not spread
  /// any more, damage would stay in one row of cells however fine, and its amount fall with the mesh. 0: eq. 25 as
  /// printed.
  double floor = 0.2;
  double crack_volume = 0.01;    ///< λ2 [m³]
  double rupture_strain = 0.01;  ///< ε_vf
  Source source = Source::zone;
  double radius = 0.1;           ///< of the weak zone [m]
  bool per_crack_volume = true;  ///< Q/λ2, so that C_d grows by eq. 23a in T_d; false: eq. 26 as printed
  bool clip_strain = true;       ///< ε_v in Q at most ε_vf: beyond it the point has ruptured
  bool saturates = true;  ///< Q takes C no further than the cap of C_d: where D = 1 there is nothing left to crack
  Scheme scheme = Scheme::sub_cycled;
  Reading reading = Reading::isotropic;
  double drift = 0;  ///< of the implicit schemes' factorisation, see Concentration
};

struct Evolution {
  double critical_strain = 0.002;  ///< ε_v1: the source acts, and damage shows in the stress, only where it was reached
  bool damage_everywhere = false;  ///< damage shows in the stress without regard to the critical state
  double cap = 9.0 / 16;           ///< largest C_d that is handed out: D = 1; infinite: none
  bool heals = false;  ///< C_d that is handed out falls where C diffuses away, and the solid stiffens under its load
  Rate rate = Rate::reference;
  double reference_rate = 100;  ///< [1/s]
  double rate_floor = 1;        ///< [1/s]
  /// Without: the local model, C_d of eq. 23a from the cell's own strain, never healing.
  std::optional<Diffusion> diffusion;
};

/// Eq. 25, within [floor λ1, λ1].
double diffusivity(const Diffusion&, double volumetric_strain);

/// Area of [x0, x1] × [y0, y1], 0 ≤ x0 ≤ x1 and 0 ≤ y0 ≤ y1, that lies within radius ≥ 0 of the origin. Exact to
/// round-off; the same bits with x and y exchanged.
double area_within(double radius, double x0, double x1, double y0, double y1);

class DamageEvolution {
 public:
  /// Throws std::invalid_argument for a characteristic time, crack volume, rupture strain or rate that is not > 0, or a
  /// mobility, radius or cap that is not ≥ 0.
  DamageEvolution(const Evolution&, CrackGrowth, const Grid&);

  /// From tⁿ⁻¹ to tⁿ = tⁿ⁻¹ + dt: mean volumetric strains of the cells at tⁿ in. The first call has the strains at the
  /// start as those before it were zero. Those at tⁿ give Q and d of the whole step. Throws what Concentration::step
  /// does.
  void advance(std::span<const double> volumetric_strain, double dt);

  std::span<const double> crack_density() const {
    return crack_density_;
  }                                               ///< C_d that each cell's stiffness sees, ≤ cap
  std::span<const double> concentration() const;  ///< C of each node; empty without diffusion
  double total() const;                           ///< ∫C dA
  double fed() const;                             ///< what the source has given since the start: ∫∫Q dA dt
  long node_updates() const;                      ///< of the diffusion; 0 until there is something to diffuse
  std::size_t bytes() const;

 private:
  /// A node that the source feeds: the fed cells around it (bottom left, bottom right, top left, top right; one past
  /// the last for none) and how much of its control volume lies in each of them and in the zone.
  struct FedNode {
    std::size_t node = 0;
    std::array<std::size_t, 4> cell{};
    std::array<double, 4> share{};
  };

  void place_source();
  double source(std::size_t k, double strain, double dt);
  double rate(std::size_t k, double strain, double dt);
  void local(std::span<const double> strain, double dt);
  void diffuse(std::span<const double> strain, double dt);

  Evolution evolution_;
  CrackGrowth growth_;
  Grid grid_;
  std::vector<double> crack_density_;                 // handed out
  std::vector<unsigned char> critical_;               // has been reached; empty with damage_everywhere
  std::vector<double> strain_before_, largest_rate_;  // tracked rate only: of fed cells; local model: of all
  std::vector<double> largest_;                       // local model: C_d that each cell keeps
  std::vector<std::size_t> fed_cells_;
  std::vector<double> q_;  // of each fed cell, and a zero
  std::vector<FedNode> fed_nodes_;
  std::vector<double> source_, diffusivity_;
  std::optional<Concentration> concentration_;
  bool anything_ = false;  // a source has acted: until then C is zero and stays it
};

}  // namespace diptych::diffusion
