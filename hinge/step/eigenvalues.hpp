// Eigenvalues that time steps are limited by; GSL stays behind them, in one source.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace diptych::material {

/// A symmetric matrix, all of it stored.
class SymmetricMatrix {
 public:
  explicit SymmetricMatrix(std::size_t size) : size_(size), values_(size * size) {}
  std::size_t size() const { return size_; }
  double& operator()(std::size_t i, std::size_t j) { return values_[i * size_ + j]; }
  double operator()(std::size_t i, std::size_t j) const { return values_[i * size_ + j]; }
  const std::vector<double>& values() const { return values_; }

 private:
  std::size_t size_;
  std::vector<double> values_;
};

/// The largest eigenvalue.
double largest_eigenvalue(const SymmetricMatrix& a);

/// The largest eigenvalue of f(W) A, f taken of W's eigenvalues, where what is below zero counts as zero: that of the
/// symmetric matrix f(W)^½ A f(W)^½. W is given by its blocks along the diagonal.
double largest_eigenvalue(const std::vector<SymmetricMatrix>& w, const std::function<double(double)>& f,
                          const SymmetricMatrix& a);

}  // namespace diptych::material
