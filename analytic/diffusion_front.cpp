#include "analytic/diffusion_front.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "analytic/parameters.hpp"
#include "analytic/residual.hpp"

namespace diptych::analytic {
namespace {

void require_front(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(std::string("diffusion front: ") + message);
}

/// The solution for falling diffusivity, over s = √η: dw/ds = 2s q/w, dq/ds = −s³ q/w.
class FallingProfile {
 public:
  static const FallingProfile& get() {
    static const FallingProfile profile;
    return profile;
  }

  double flux() const { return nodes_.front().q; }
  double value(double eta) const {
    const double s = std::sqrt(eta);
    if (s >= step_ * static_cast<double>(nodes_.size() - 1)) return 0;
    const auto i = static_cast<std::size_t>(s / step_);
    return 1 - between(i, s / step_ - static_cast<double>(i));
  }
  /// η of u = 1 − w, bisected between the nodes around it.
  double level(double u) const {
    const double w = 1 - u;
    const auto after = std::upper_bound(nodes_.begin() + 1, nodes_.end() - 1, w,
                                        [](double value, const Node& node) { return value < node.w; });
    const auto i = static_cast<std::size_t>(after - nodes_.begin()) - 1;
    double low = 0, high = 1;
    for (int k = 0; k < 60; ++k) (between(i, (low + high) / 2) < w ? low : high) = (low + high) / 2;
    const double s = step_ * (static_cast<double>(i) + (low + high) / 2);
    return s * s;
  }

 private:
  struct Node {
    double w, q, slope;  ///< slope: dw/ds
  };

  FallingProfile() {
    // From q = 1 at the face, along the unstretched s: w = √2 s and q = 1 − s³/(3√2) near it, but for s³ of either and
    // more, which the first step does not see; q falls off like exp(−s⁴/4w).
    constexpr double root2 = std::numbers::sqrt2;
    constexpr int count = 8000;
    constexpr double end = 5, begin = end / count;
    step_ = begin;
    nodes_.push_back({0, 1, root2});
    const gsl_odeiv2_system system{[](double s, const double y[], double dy[], void*) {
                                     const double rate = s * y[1] / y[0];
                                     dy[0] = 2 * rate;
                                     dy[1] = -s * s * rate;
                                     return static_cast<int>(GSL_SUCCESS);
                                   },
                                   nullptr, 2, nullptr};
    const std::unique_ptr<gsl_odeiv2_driver, void (*)(gsl_odeiv2_driver*)> driver(
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, begin, 1e-15, 1e-15), gsl_odeiv2_driver_free);
    const double cube = begin * begin * begin;
    double s = begin, y[2] = {root2 * begin, 1 - cube / (3 * root2)};
    const auto keep = [&] { nodes_.push_back({y[0], y[1], 2 * s * y[1] / y[0]}); };
    keep();
    for (int i = 2; i <= count; ++i) {
      if (!driver || gsl_odeiv2_driver_apply(driver.get(), &s, begin * i, y) != GSL_SUCCESS)
        throw std::runtime_error("diffusion front: the profile could not be integrated");
      keep();
    }
    // w stretched by 1/w(∞), η by its root, q by that to the third
    const double whole = nodes_.back().w, root = std::sqrt(whole);
    step_ /= std::sqrt(root);
    for (Node& node : nodes_) {
      node.w /= whole;
      node.q /= whole * root;
      node.slope /= whole / std::sqrt(root);
    }
  }

  /// w by the cubic that has values and slopes of both nodes.
  double between(std::size_t i, double part) const {
    const Node &a = nodes_[i], &b = nodes_[i + 1];
    const double rest = 1 - part, rise = b.w - a.w;
    return a.w + part * part * (1 + 2 * rest) * rise + part * rest * step_ * (rest * a.slope - part * b.slope);
  }

  double step_ = 0;
  std::vector<Node> nodes_;
};

/// The solution for rising diffusivity, U over s = 1 − ξ from the edge to the face.
class RisingProfile {
 public:
  static const RisingProfile& get() {
    static const RisingProfile profile;
    return profile;
  }

  double flux() const { return edge_ * edge_ * edge_ * nodes_.back().u * nodes_.back().slope; }
  double value(double eta) const {
    const double s = 1 - eta / edge_;
    if (!(s > 0)) return std::isnan(s) ? s : 0;
    const double place = s / step_;
    const auto i = std::min(static_cast<std::size_t>(place), nodes_.size() - 2);
    return edge_ * edge_ * between(i, place - static_cast<double>(i));
  }
  double level(double u) const {
    double low = 0, high = edge_;
    for (int k = 0; k < 80; ++k) {
      const double middle = (low + high) / 2;
      (value(middle) > u ? low : high) = middle;
    }
    return (low + high) / 2;
  }

 private:
  struct Node {
    double u, slope;  ///< slope: dU/ds
  };

  RisingProfile() {
    nodes_.push_back({0, 0.5});
    const gsl_odeiv2_system system{[](double s, const double y[], double dy[], void*) {
                                     dy[0] = y[1];
                                     dy[1] = ((1 - s) / 2 * y[1] - y[1] * y[1]) / y[0];
                                     return static_cast<int>(GSL_SUCCESS);
                                   },
                                   nullptr, 2, nullptr};
    const std::unique_ptr<gsl_odeiv2_driver, void (*)(gsl_odeiv2_driver*)> driver(
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, step_, 1e-15, 1e-15), gsl_odeiv2_driver_free);
    double s = step_, y[2] = {s / 2 - s * s / 8 + s * s * s / 144, 0.5 - s / 4 + s * s / 48};
    nodes_.push_back({y[0], y[1]});
    for (int i = 2; i <= count; ++i) {
      if (!driver || gsl_odeiv2_driver_apply(driver.get(), &s, step_ * i, y) != GSL_SUCCESS)
        throw std::runtime_error("diffusion front: the profile could not be integrated");
      nodes_.push_back({y[0], y[1]});
    }
    edge_ = 1 / std::sqrt(nodes_.back().u);
  }

  /// By the cubic that has values and slopes of both nodes.
  double between(std::size_t i, double part) const {
    const Node &a = nodes_[i], &b = nodes_[i + 1];
    const double rest = 1 - part, rise = b.u - a.u;
    return a.u + part * part * (1 + 2 * rest) * rise + part * rest * step_ * (rest * a.slope - part * b.slope);
  }

  static constexpr int count = 8000;
  static constexpr double step_ = 1.0 / count;
  double edge_ = 0;
  std::vector<Node> nodes_;
};

void check_front(const FaceFront::Parameters& p) {
  require_front(positive(p.width) && positive(p.height), "sides must be > 0");
  require_front(positive(p.diffusivity), "diffusivity must be > 0");
  require_front(std::isfinite(p.value) && p.value != 0, "the face's value must be finite and not zero");
}

}  // namespace

DiffusionFront::DiffusionFront(const Parameters& p) : p_(p) {
  require_front(positive(p.diffusivity), "diffusivity must be > 0");
}

double DiffusionFront::value(double x, double t) const {
  if (!(x >= 0 && t >= 0) || !std::isfinite(x) || !std::isfinite(t))
    throw std::domain_error("diffusion front: x and t must be finite and >= 0");
  if (x == 0) return 1;
  const double eta = x / std::sqrt(p_.diffusivity * t);  // infinite at t = 0
  switch (p_.profile) {
    case FrontProfile::falling: return FallingProfile::get().value(eta);
    case FrontProfile::rising: return RisingProfile::get().value(eta);
    case FrontProfile::constant: break;
  }
  return std::erfc(eta / 2);
}

double DiffusionFront::level(double u) const {
  if (!(u >= 1e-9 && u <= 1)) throw std::domain_error("diffusion front: levels lie between 1e-9 and 1");
  if (u == 1) return 0;
  switch (p_.profile) {
    case FrontProfile::falling: return FallingProfile::get().level(u);
    case FrontProfile::rising: return RisingProfile::get().level(u);
    case FrontProfile::constant: break;
  }
  return std::numbers::sqrt2 * gsl_cdf_ugaussian_Qinv(u / 2);
}

double DiffusionFront::face_flux() const {
  switch (p_.profile) {
    case FrontProfile::falling: return FallingProfile::get().flux();
    case FrontProfile::rising: return RisingProfile::get().flux();
    case FrontProfile::constant: break;
  }
  return std::numbers::inv_sqrtpi;
}

double DiffusionFront::reach(double t, double u) const {
  if (!(t >= 0) || !std::isfinite(t)) throw std::domain_error("diffusion front: t must be finite and >= 0");
  return level(u) * std::sqrt(p_.diffusivity * t);
}

double DiffusionFront::arrival(double x, double u) const {
  if (!(x >= 0) || !std::isfinite(x)) throw std::domain_error("diffusion front: x must be finite and >= 0");
  if (u == 1 && x > 0) return infinity;
  const double root = x == 0 ? 0 : x / level(u);
  return root * root / p_.diffusivity;
}

FaceFront::FaceFront(const Parameters& p) : p_(p), front_({p.diffusivity, p.profile}) { check_front(p); }

std::array<double, 3> FaceFront::at(PlaneQuantity quantity, double x, double y, double t) const {
  if (!(x >= -1e-9 * p_.width && x <= (1 + 1e-9) * p_.width && y >= -1e-9 * p_.height && y <= (1 + 1e-9) * p_.height &&
        t >= 0) ||
      !std::isfinite(t))
    throw std::domain_error(name() + ": the point must lie in the rectangle and t be finite and >= 0");
  if (!gives(quantity)) throw std::invalid_argument(name() + ": this quantity is not given");
  return {p_.value * front_.value(std::max(x, 0.0), t), 0, 0};
}

double FaceFront::scale(PlaneQuantity quantity) const {
  if (!gives(quantity)) throw std::invalid_argument(name() + ": this quantity is not given");
  return std::abs(p_.value);
}

// --- self-test -------------------------------------------------------------------------------------------------------

namespace {

class FrontSelfTest {
 public:
  FrontSelfTest(const PlaneSolution& s, const FaceFront::Parameters& p, double t_begin, double t_end)
      : s_(s), p_(p), begin_(t_begin), end_(t_end) {}

  FrontResidual run() {
    balance();
    face();
    moments();
    return r_;
  }

 private:
  double at(double x, double y, double t) const { return s_.at(PlaneQuantity::concentration, x, y, t)[0] / p_.value; }
  double time(double part) const { return begin_ * std::pow(end_ / begin_, part); }
  /// ∫ d du
  double potential(double u) const {
    switch (p_.profile) {
      case FrontProfile::falling: return p_.diffusivity * (u - u * u / 2);
      case FrontProfile::rising: return p_.diffusivity * (u * u / 2);
      case FrontProfile::constant: break;
    }
    return p_.diffusivity * u;
  }

  void balance() {
    for (int i = 1; i <= 2000; ++i) {
      const double t = time(std::fmod(i * 0.5497004779019703, 1)), length = std::sqrt(p_.diffusivity * t);
      const double x = 6 * length * std::fmod(i * 0.8191725133961645, 1);
      const double y = p_.height * std::fmod(i * 0.6710436067037893, 1);
      const double d = 2e-2 * std::min(length, x), tau = 1e-2 * t * std::min(1.0, x / length);
      if (x < 1e-2 * length || x + 3 * d > p_.width) continue;  // at the face it is not smooth
      const auto bent = [&](double z) { return potential(at(z, y, t)); };
      const double spread = (270 * (bent(x + d) + bent(x - d)) - 27 * (bent(x + 2 * d) + bent(x - 2 * d)) +
                             2 * (bent(x + 3 * d) + bent(x - 3 * d)) - 490 * bent(x)) /
                            (180 * d * d);
      const double rate = derivative([&](double z) { return at(x, y, z); }, t, tau);
      note(r_.balance, (rate - spread) * t);
      note(r_.balance, at(x, y, t) - at(x, 0, t));
      ++r_.points;
    }
    if (r_.points == 0) r_.balance = infinity;
  }

  void face() {
    for (int i = 1; i <= 50; ++i) {
      const double part = i / 50.0;
      note(r_.face, at(0, p_.height * part, time(part)) - 1);
      note(r_.face, at(p_.width * part, 0, 0));
    }
  }

  /// ∫ u x dx grows by ∫ x ∂²(∫d du)/∂x² dx = (∫d du) at the face.
  void moments() {
    for (const double part : {0.0, 0.3, 0.7, 1.0}) {
      const double t = time(part), expected = t * (potential(1) - potential(0));
      double found = 0;
      constexpr int parts = 2000;
      const double off = std::sqrt(0.15);
      for (int i = 0; i < parts; ++i) {  // x = z² width, so that the face's root is smooth
        for (const auto& [to, weight] : {std::pair{0.5 - off, 5.0 / 18}, {0.5, 8.0 / 18}, {0.5 + off, 5.0 / 18}}) {
          const double z = (i + to) / parts, x = z * z * p_.width;
          found += weight / parts * 2 * z * p_.width * x * at(x, p_.height / 2, t);
        }
      }
      note(r_.moment, (found - expected) / expected);
    }
  }

  const PlaneSolution& s_;
  const FaceFront::Parameters& p_;
  const double begin_, end_;
  FrontResidual r_;
};

}  // namespace

double FrontResidual::worst() const {
  if (points == 0) return infinity;
  double worst = 0;
  for (const double r : {balance, face, moment}) note(worst, r);
  return worst;
}

FrontResidual self_test(const PlaneSolution& solution, const FaceFront::Parameters& p, double t_begin, double t_end) {
  check_front(p);
  require_front(t_begin > 0 && t_end >= t_begin && std::isfinite(t_end), "times must be > 0, finite and in order");
  return FrontSelfTest(solution, p, t_begin, t_end).run();
}

double FaceFront::residual(const PlaneWindow& window) const {
  const FrontResidual found = self_test(*this, p_, window.from, window.to);
  const bool edge = p_.profile == FrontProfile::rising;
  return edge && found.balance < 1 ? std::hypot(found.face, found.moment) : found.worst();
}

}  // namespace diptych::analytic
