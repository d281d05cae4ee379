// Exact solutions of bars that are wrong in a way of the test's choice, for self-tests to find.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "analytic/exact.hpp"

namespace diptych::tests {

/// A solution of bars with other values, and with other fronts where `spoil_fronts` is given. Its own test is not
/// asked.
template <class Solution>
class Spoiled final : public analytic::ExactSolution {
 public:
  using At = std::function<double(analytic::BarQuantity, double, double)>;
  Spoiled(Solution solution, At at) : solution_(std::move(solution)), at_(std::move(at)) {}
  std::string name() const override { return "spoiled"; }
  double residual(double) const override { return std::nan(""); }
  double at(analytic::BarQuantity quantity, double x, double t) const override { return at_(quantity, x, t); }
  std::vector<analytic::Front> fronts(double t) const override {
    return spoil_fronts ? spoil_fronts(solution_.fronts(t)) : solution_.fronts(t);
  }
  double scale(analytic::BarQuantity quantity) const override { return solution_.scale(quantity); }

  std::function<std::vector<analytic::Front>(std::vector<analytic::Front>)> spoil_fronts;

 private:
  Solution solution_;
  At at_;
};

}  // namespace diptych::tests
