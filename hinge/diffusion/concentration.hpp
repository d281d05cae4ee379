// The concentration of microcracks on the nodes of a grid of cells: eqs. 24, 25 and 28 by central differences.
#pragma once

#include <memory>
#include <span>
#include <vector>

namespace diptych::diffusion {

/// Rectangular cells from the origin; nodes and cells are numbered row by row from the bottom, each row from the left.
struct Grid {
  int nx = 1, ny = 1;     ///< cells across and up, ≥ 1
  double hx = 1, hy = 1;  ///< of a cell [m]

  std::size_t cells() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
  std::size_t nodes() const { return static_cast<std::size_t>(nx + 1) * static_cast<std::size_t>(ny + 1); }
};

enum class Scheme {
  forward_euler,  ///< one step of the wave's; its limit is forward_euler_limit
  sub_cycled,     ///< forward Euler in as many equal parts as its limit asks for
  rkl2,  ///< second-order Runge–Kutta–Legendre super-time-stepping, with as many stages as the step asks for
  backward_euler,  ///< implicit, by CHOLMOD
  crank_nicolson   ///< implicit, by CHOLMOD
};

/// How ∂/∂n of eqs. 24 and 28 is read.
enum class Reading {
  isotropic,  ///< ∇·(d ∇C)
  radial      ///< ∂/∂r (d ∂C/∂r), r from the origin: one-dimensional along every ray
};

/// Largest stable step of forward Euler for the largest diffusivity [s]: 1/(2 d (1/hx² + 1/hy²)); infinite for d = 0.
double forward_euler_limit(const Grid&, double largest_diffusivity);

/// C on the nodes, no flux through the walls. Every node stands for the cells' quarters around it (half of them on a
/// wall, one at a corner), so that ∫C dA changes by exactly what the source gives.
class Concentration {
 public:
  /// drift: largest change of any cell's diffusivity, relative to the largest diffusivity, at which backward Euler
  /// keeps its factorisation (0: refactorises whenever any changes). The step then errs by dt (K − K_f) δ, K_f the
  /// factorised operator and δ the increment: first order in dt, as the scheme. Crank–Nicolson takes no drift.
  Concentration(const Grid&, Scheme, Reading = Reading::isotropic, double drift = 0);
  ~Concentration();
  Concentration(Concentration&&) noexcept;

  std::span<double> values();  ///< of nodes
  std::span<const double> values() const;

  /// From now on these nodes, and no others, keep what values() says, which the caller may change between steps; with
  /// their neighbours they exchange as before. A source there does nothing. Throws std::invalid_argument for a node
  /// that is not in the grid.
  void hold(std::vector<std::size_t> nodes);

  /// One step of dt [s]. diffusivity: of each cell, ≥ 0 [m²/s]. source: of each node, the mean over its control volume
  /// [units of C per s]. Throws std::invalid_argument where forward Euler is unstable, naming both numbers: dt above
  /// forward_euler_limit for the largest diffusivity given, below which it is also positive (radial: above the least
  /// volume / Σ faces of a node for that diffusivity); std::runtime_error where CHOLMOD refuses the matrix.
  void step(std::span<const double> diffusivity, std::span<const double> source, double dt);

  /// ∫C dA [units of C · m²]. Radial: ∫C dA/r, which is what that reading conserves [units of C · m].
  double total() const;
  double fed() const;    ///< what source and held nodes have given the others since the start, measured as total() is
  double drawn() const;  ///< of it, what has flowed out of held nodes; to the round-off of dt d/h² times their content
  long node_updates() const;    ///< deterministic work: operator applications or back-substitutions, times nodes
  long factorisations() const;  ///< of the implicit schemes
  std::size_t bytes() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace diptych::diffusion
