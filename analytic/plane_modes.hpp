// Standing modes of an elastic rectangle. Every one of them starts from rest, displaced, u ~ cos ωt, or with a velocity
// and no displacement, u ~ sin ωt.
#pragma once

#include "analytic/plane_exact.hpp"

namespace diptych::analytic {

/// What the modes have in common. Across rollers at x = 0 u_x goes as sin(k_x x) and u_y as cos(k_x x), else the other
/// way round; across rollers at y = 0 u_y goes as sin(k_y y) and u_x as cos(k_y y), else the other way round.
struct PlaneWave {
  std::array<double, 2> wave_number;  ///< k_x, k_y [1/m]
  std::array<double, 2> amplitude;    ///< A_x, A_y [m]
  double frequency;                   ///< ω [1/s]
  std::array<bool, 2> rollers;        ///< at x = 0, at y = 0
  bool from_rest;                     ///< u ~ cos ωt, else sin ωt
};

/// A standing mode; throws std::invalid_argument where a parameter is out of range.
class PlaneMode : public PlaneSolution {
 public:
  bool gives(PlaneQuantity quantity) const override { return quantity != PlaneQuantity::concentration; }
  std::array<double, 3> at(PlaneQuantity, double x, double y, double t) const override;
  double scale(PlaneQuantity) const override;  ///< largest of the amplitudes of its components
  const PlaneMedium& medium() const { return medium_; }
  const PlaneWave& wave() const { return wave_; }
  double width() const { return width_; }    ///< [m]
  double height() const { return height_; }  ///< [m]
  /// What it is the solution of: said anew, so that the mode is judged by something else than itself.
  PlaneProblem problem() const;
  double residual(const PlaneWindow& window) const override { return self_test(*this, problem(), window.to).worst(); }

 protected:
  PlaneMode(const PlaneMedium&, double width, double height, const PlaneWave&);

  /// What its sides are: the rest is posed for all modes alike.
  virtual void pose_sides(PlaneProblem&) const {}

 private:
  PlaneMedium medium_;
  double width_, height_;
  PlaneWave wave_;
};

struct SquareMode {
  PlaneMedium medium;
  double side;       ///< [m], > 0
  int mode;          ///< n ≥ 1; k = nπ/side
  double amplitude;  ///< A [m], ≠ 0
  bool from_rest = true;
};

/// Shear waves on a square with traction-free sides (Lamé): u_x = A cos(kx) sin(ky), u_y = −A sin(kx) cos(ky),
/// ω = √2 k c_s. Isochoric, so λ has no part in it; σ_xy = 0 everywhere.
class LameMode final : public PlaneMode {
 public:
  using Parameters = SquareMode;
  explicit LameMode(const Parameters&);
  std::string name() const override { return "lame-mode"; }
};

/// Pressure waves on a square on rollers: u_x = A sin(kx) cos(ky), u_y = A cos(kx) sin(ky), ω = √2 k c_d. Irrotational.
class RollerMode final : public PlaneMode {
 public:
  using Parameters = SquareMode;
  explicit RollerMode(const Parameters&);
  std::string name() const override { return "roller-mode"; }

 private:
  void pose_sides(PlaneProblem&) const override;
};

struct RectangleMode {
  PlaneMedium medium;
  double width, height;  ///< [m], > 0
  int mode;              ///< n ≥ 1; k = nπ/width
  double amplitude;      ///< A [m], ≠ 0
  bool from_rest = true;
};

/// Pressure waves across a rectangle on rollers: u_x = A sin(kx), ω = k c_d.
class StandingPWave final : public PlaneMode {
 public:
  using Parameters = RectangleMode;
  explicit StandingPWave(const Parameters&);
  std::string name() const override { return "standing-p-wave"; }

 private:
  void pose_sides(PlaneProblem&) const override;
};

/// Shear waves across a rectangle: u_y = A cos(kx), ω = k c_s. The left and right sides may be free or on rollers that
/// let them slide along; the shear stress on the top and bottom is not zero: they are driven.
class StandingSWave final : public PlaneMode {
 public:
  using Parameters = RectangleMode;
  explicit StandingSWave(const Parameters&);
  std::string name() const override { return "standing-s-wave"; }

 private:
  void pose_sides(PlaneProblem&) const override;
};

}  // namespace diptych::analytic
