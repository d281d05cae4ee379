// Exact solutions in the plane that are wrong in a way of the test's choice, for self-tests to find.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "analytic/plane_exact.hpp"

namespace diptych::tests {

/// Any values in the plane.
class SpoiledPlane final : public analytic::PlaneSolution {
 public:
  using At = std::function<std::array<double, 3>(analytic::PlaneQuantity, double, double, double)>;
  explicit SpoiledPlane(At at) : at_(std::move(at)) {}
  std::string name() const override { return "spoiled"; }
  double residual(const analytic::PlaneWindow&) const override { return std::nan(""); }
  bool gives(analytic::PlaneQuantity) const override { return true; }
  std::array<double, 3> at(analytic::PlaneQuantity q, double x, double y, double t) const override {
    return at_(q, x, y, t);
  }
  double scale(analytic::PlaneQuantity) const override { return 1; }

 private:
  At at_;
};

}  // namespace diptych::tests
