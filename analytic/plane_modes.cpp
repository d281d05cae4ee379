#include "analytic/plane_modes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "analytic/parameters.hpp"

namespace diptych::analytic {
namespace {

using std::numbers::pi;

void require_mode(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(std::string("plane mode: ") + message);
}

PlaneWave lame(const SquareMode& p) {
  const double k = p.mode * pi / p.side;
  return {{k, k},
          {p.amplitude, -p.amplitude},
          std::numbers::sqrt2 * k * p.medium.shear_speed(),
          {false, false},
          p.from_rest};
}

PlaneWave roller(const SquareMode& p) {
  const double k = p.mode * pi / p.side;
  return {{k, k},
          {p.amplitude, p.amplitude},
          std::numbers::sqrt2 * k * p.medium.pressure_speed(),
          {true, true},
          p.from_rest};
}

PlaneWave pressure(const RectangleMode& p) {
  const double k = p.mode * pi / p.width;
  return {{k, 0}, {p.amplitude, 0}, k * p.medium.pressure_speed(), {true, true}, p.from_rest};
}

PlaneWave shear(const RectangleMode& p) {
  const double k = p.mode * pi / p.width;
  return {{k, 0}, {0, p.amplitude}, k * p.medium.shear_speed(), {true, false}, p.from_rest};
}

}  // namespace

PlaneMode::PlaneMode(const PlaneMedium& medium, double width, double height, const PlaneWave& wave)
    : medium_(medium), width_(width), height_(height), wave_(wave) {
  require_mode(positive(medium.mu), "mu must be > 0");
  require_mode(std::isfinite(medium.lambda) && medium.lambda + medium.mu > 0, "lambda + mu must be > 0");
  require_mode(positive(medium.density), "density must be > 0");
  require_mode(positive(width) && positive(height), "sides must be > 0");
  require_mode(wave.wave_number[0] > 0, "mode must be >= 1");
  const double amplitude = std::hypot(wave.amplitude[0], wave.amplitude[1]);
  require_mode(positive(amplitude), "amplitude must be finite and not zero");
}

std::array<double, 3> PlaneMode::at(PlaneQuantity quantity, double x, double y, double t) const {
  if (!(x >= -1e-9 * width_ && x <= (1 + 1e-9) * width_ && y >= -1e-9 * height_ && y <= (1 + 1e-9) * height_) ||
      !std::isfinite(t))
    throw std::domain_error(name() + ": the point must lie in the rectangle and t be finite");
  if (!gives(quantity)) throw std::invalid_argument(name() + ": this quantity is not given");
  const auto [kx, ky] = wave_.wave_number;
  const auto [ax, ay] = wave_.amplitude;
  const auto [roller_x, roller_y] = wave_.rollers;
  const double sx = std::sin(kx * x), cx = std::cos(kx * x), sy = std::sin(ky * y), cy = std::cos(ky * y);
  const double phase = wave_.frequency * t,
               rate = wave_.from_rest ? -wave_.frequency * std::sin(phase) : wave_.frequency * std::cos(phase);
  const double now = wave_.from_rest ? std::cos(phase) : std::sin(phase);
  // factors of u_x and of u_y along x and along y, and their derivatives by kx and ky
  const double ux_x = roller_x ? sx : cx, dux_x = roller_x ? cx : -sx;
  const double uy_x = roller_x ? cx : sx, duy_x = roller_x ? -sx : cx;
  const double ux_y = roller_y ? cy : sy, dux_y = roller_y ? -sy : cy;
  const double uy_y = roller_y ? sy : cy, duy_y = roller_y ? cy : -sy;
  if (quantity == PlaneQuantity::displacement) return {now * ax * ux_x * ux_y, now * ay * uy_x * uy_y, 0};
  if (quantity == PlaneQuantity::velocity) return {rate * ax * ux_x * ux_y, rate * ay * uy_x * uy_y, 0};
  const double xx = kx * ax * (dux_x * ux_y), yy = ky * ay * (uy_x * duy_y);
  const double shear = ky * ax * (ux_x * dux_y) + kx * ay * (duy_x * uy_y);  // Lamé's is 0 to the last bit
  const double trace = medium_.lambda * (xx + yy);
  return {now * (trace + 2 * medium_.mu * xx), now * (trace + 2 * medium_.mu * yy), now * medium_.mu * shear};
}

double PlaneMode::scale(PlaneQuantity quantity) const {
  const auto [kx, ky] = wave_.wave_number;
  const auto [ax, ay] = wave_.amplitude;
  const double amplitude = std::max(std::abs(ax), std::abs(ay));
  // xx and yy go together; their products of sines and cosines are the same, and so is that of xy's two terms, with the
  // sign that rollers give it
  const double xx = kx * ax * (wave_.rollers[0] ? 1 : -1), yy = ky * ay * (wave_.rollers[1] ? 1 : -1);
  const double shear = ky * ax * (wave_.rollers[1] ? -1 : 1) + kx * ay * (wave_.rollers[0] ? -1 : 1);
  const double lambda = medium_.lambda, mu = medium_.mu;
  switch (quantity) {
    case PlaneQuantity::displacement: return amplitude;
    case PlaneQuantity::velocity: return amplitude * wave_.frequency;
    case PlaneQuantity::stress:
      return std::max({std::abs(lambda * (xx + yy) + 2 * mu * xx), std::abs(lambda * (xx + yy) + 2 * mu * yy),
                       std::abs(mu * shear)});
    case PlaneQuantity::concentration: break;
  }
  throw std::invalid_argument(name() + ": this quantity is not given");
}

PlaneProblem PlaneMode::problem() const {
  const auto field = [mode = wave_](bool velocity) {
    // said again here, so that the mode is judged by something else than itself
    return [=](double x, double y) {
      const auto [kx, ky] = mode.wave_number;
      const double ux = mode.amplitude[0] * (mode.rollers[0] ? std::sin(kx * x) : std::cos(kx * x)) *
                        (mode.rollers[1] ? std::cos(ky * y) : std::sin(ky * y));
      const double uy = mode.amplitude[1] * (mode.rollers[0] ? std::cos(kx * x) : std::sin(kx * x)) *
                        (mode.rollers[1] ? std::sin(ky * y) : std::cos(ky * y));
      const double factor = velocity ? mode.frequency : 1;
      return std::array<double, 2>{factor * ux, factor * uy};
    };
  };
  PlaneProblem p{};
  p.medium = medium_;
  p.width = width_;
  p.height = height_;
  if (wave_.from_rest) {
    p.initial_displacement = field(false);
  } else {
    p.initial_velocity = field(true);
  }
  p.displacement_scale = scale(PlaneQuantity::displacement);
  p.smooth_length = 1 / std::max(wave_.wave_number[0], wave_.wave_number[1]);
  pose_sides(p);
  return p;
}

LameMode::LameMode(const Parameters& p) : PlaneMode(p.medium, p.side, p.side, lame(p)) {}
RollerMode::RollerMode(const Parameters& p) : PlaneMode(p.medium, p.side, p.side, roller(p)) {}
StandingPWave::StandingPWave(const Parameters& p) : PlaneMode(p.medium, p.width, p.height, pressure(p)) {}
StandingSWave::StandingSWave(const Parameters& p) : PlaneMode(p.medium, p.width, p.height, shear(p)) {}

void RollerMode::pose_sides(PlaneProblem& p) const {
  p.left.support = p.right.support = p.bottom.support = p.top.support = PlaneProblem::Support::roller;
}

void StandingPWave::pose_sides(PlaneProblem& p) const {
  p.left.support = p.right.support = p.bottom.support = p.top.support = PlaneProblem::Support::roller;
}

void StandingSWave::pose_sides(PlaneProblem& p) const {
  p.left.support = p.right.support = PlaneProblem::Support::roller;
  const double k = wave().wave_number[0], omega = k * medium().shear_speed(), amplitude = wave().amplitude[1];
  const bool from_rest = wave().from_rest;
  p.bottom.support = p.top.support = PlaneProblem::Support::driven;
  p.bottom.velocity = p.top.velocity = [=](double x, double, double t) {
    const double rate = from_rest ? -std::sin(omega * t) : std::cos(omega * t);
    return std::array<double, 2>{0, amplitude * omega * rate * std::cos(k * x)};
  };
}

}  // namespace diptych::analytic
