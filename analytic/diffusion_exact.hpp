// Exact solutions of ∂C/∂t = ∇·(d ∇C) + Q without flux through the walls. All of them give the concentration alone.
#pragma once

#include <functional>

#include "analytic/plane_exact.hpp"

namespace diptych::analytic {

/// A solution of a diffusion problem. Outside its domain (x < 0, y < 0, beyond its rectangle, t < 0) it throws
/// std::domain_error.
class DiffusionSolution : public PlaneSolution {
 public:
  bool gives(PlaneQuantity quantity) const override { return quantity == PlaneQuantity::concentration; }
  std::array<double, 3> at(PlaneQuantity, double x, double y, double t) const override;
  double scale(PlaneQuantity) const override;
  virtual double concentration(double x, double y, double t) const = 0;  ///< C
  virtual double diffusivity(double x, double y) const = 0;              ///< d [m²/s]
  virtual double source(double, double, double) const { return 0; }      ///< Q at (x, y, t) [C/s]
  double residual(const PlaneWindow&) const override;

 protected:
  virtual bool walled() const { return false; }  ///< no flux at x = width and y = height either
  virtual bool radial() const { return false; }  ///< the radial reading
  virtual double size() const = 0;               ///< natural size of C
};

/// M units set free at the corner of a quarter plane at t = 0: C = M/(πdt) exp(−r²/4dt). t > 0.
class InstantSource final : public DiffusionSolution {
 public:
  struct Parameters {
    double amount;       ///< M [C·m²], ≠ 0
    double diffusivity;  ///< d [m²/s], > 0
    double time;         ///< at which the largest value is the natural size [s], > 0
    double start = 0;    ///< t is counted from this age of the solution [s], ≥ 0; > 0 if t = 0 is asked for
  };
  explicit InstantSource(const Parameters&);
  std::string name() const override { return "instant-source"; }
  double concentration(double x, double y, double t) const override;
  double diffusivity(double, double) const override { return p_.diffusivity; }

 private:
  double size() const override;
  Parameters p_;
};

/// q units a second from the corner of a quarter plane, from t = 0 on: C = q/(πd) E₁(r²/4dt); infinite at the corner.
class CornerSource final : public DiffusionSolution {
 public:
  struct Parameters {
    double rate;         ///< q [C·m²/s], ≠ 0
    double diffusivity;  ///< d [m²/s], > 0
  };
  explicit CornerSource(const Parameters&);
  std::string name() const override { return "corner-source"; }
  double concentration(double x, double y, double t) const override;
  double diffusivity(double, double) const override { return p_.diffusivity; }

 private:
  double size() const override;  ///< |q|/(πd)
  Parameters p_;
};

/// C = mean + A cos(mπx/a) cos(nπy/b) exp(−d π² (m²/a² + n²/b²) t) on a rectangle a × b.
class CosineMode final : public DiffusionSolution {
 public:
  struct Parameters {
    double width, height;  ///< a, b [m], > 0
    int m, n;              ///< ≥ 0
    double mean;
    double amplitude;    ///< A, ≠ 0
    double diffusivity;  ///< d [m²/s], > 0
  };
  explicit CosineMode(const Parameters&);
  std::string name() const override { return "cosine-mode"; }
  double concentration(double x, double y, double t) const override;
  double diffusivity(double, double) const override { return p_.diffusivity; }
  double decay_rate() const;  ///< d π² (m²/a² + n²/b²) [1/s]

 private:
  bool walled() const override { return true; }
  double size() const override;  ///< |A|
  Parameters p_;
};

/// C = 1 + A cos(πx/a) cos(πy/b) exp(−t/τ) with the diffusivity of eq. 25, d = λ₁ (1 − ε/ε_vf), under the strain
/// ε = ε₀ (1 + cos(πx/a) cos(πy/b))/2, and the source that makes it so.
class ManufacturedVariable final : public DiffusionSolution {
 public:
  struct Parameters {
    double width, height;   ///< a, b [m], > 0
    double amplitude;       ///< A, ≠ 0
    double decay_time;      ///< τ [s], > 0
    double mobility;        ///< λ₁ [m²/s], > 0
    double strain;          ///< ε₀, 0 ≤ ε₀ ≤ ε_vf
    double rupture_strain;  ///< ε_vf, > 0
  };
  explicit ManufacturedVariable(const Parameters&);
  std::string name() const override { return "manufactured-variable"; }
  double concentration(double x, double y, double t) const override;
  double strain(double x, double y) const;  ///< ε
  double diffusivity(double x, double y) const override;
  double source(double x, double y, double t) const override;

 private:
  bool walled() const override { return true; }
  double size() const override;  ///< |A|
  Parameters p_;
};

/// The radial reading of eq. 28, ∂C/∂t = ∂/∂r (d ∂C/∂r) along every ray: C = M/√(πdt) exp(−r²/4dt), M = ∫₀^∞ C dr.
class RadialPulse final : public DiffusionSolution {
 public:
  struct Parameters {
    double amount;       ///< M [C·m], ≠ 0
    double diffusivity;  ///< d [m²/s], > 0
    double time;         ///< at which the largest value is the natural size [s], > 0
    double start = 0;    ///< t is counted from this age of the solution [s], ≥ 0; > 0 if t = 0 is asked for
  };
  explicit RadialPulse(const Parameters&);
  std::string name() const override { return "radial-pulse"; }
  double concentration(double x, double y, double t) const override;
  double diffusivity(double, double) const override { return p_.diffusivity; }

 private:
  bool radial() const override { return true; }
  double size() const override;
  Parameters p_;
};

/// By what one step of forward Euler in time and central differences in space multiplies a cosine mode:
/// 1 − 4 r (s_x² + s_y²) with r = dΔt/h², s = sin(kh/2) given squared.
double ftcs_factor(double r, double sx2, double sy2);

/// Largest violations found at points inside and on the walls, each divided by the natural scale of its terms; the
/// check that found nothing to look at reports infinity, NaN stays NaN.
struct DiffusionResidual {
  double balance = 0;  ///< ∂C/∂t − ∇·(d ∇C) − Q; of the radial reading ∂C/∂t − ∂/∂r (d ∂C/∂r)
  double boundary = 0;  ///< ∂C/∂n on the walls
  double amount = 0;    ///< ∫C dA − ∫∫Q dA dt where it is known
  int points = 0;
  double worst() const;
};

struct DiffusionProblem {
  double width, height;                                        ///< looked at: 0 ≤ x ≤ width, 0 ≤ y ≤ height [m]
  bool right_wall, top_wall;                                   ///< no flux there either (x = 0 and y = 0 are walls)
  bool radial = false;                                         ///< the radial reading
  double core = 0;                                             ///< radius around the corner that is left out [m]
  std::function<double(double x, double y)> diffusivity;       ///< d [m²/s]
  std::function<double(double x, double y, double t)> source;  ///< Q; empty: none
  std::function<double(double t)> amount;  ///< ∫C over the domain (radial: over r); empty: unknown
  double scale;                            ///< of C, > 0
  double smooth_length;                    ///< [m], > 0
};

/// Checks a solution over t_begin ≤ t ≤ t_end, t_begin > 0 [s].
DiffusionResidual self_test(const DiffusionSolution&, const DiffusionProblem&, double t_begin, double t_end);

}  // namespace diptych::analytic
