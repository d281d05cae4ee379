// Sparse Cholesky factors by CHOLMOD (Chen, Davis, Hager & Rajamanickam, ACM TOMS 35:22, 2008).
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace diptych::diffusion {

/// L Lᵀ of a symmetric positive definite matrix whose pattern stays while its entries change.
class Cholesky {
 public:
  /// The lower triangle by columns: where each of the n columns starts and where the last one ends; rows ascending.
  Cholesky(std::vector<int> starts, std::vector<int> rows);
  ~Cholesky();

  std::span<double> entries();  ///< of the lower triangle, in the pattern's order
  /// Throws std::runtime_error where the matrix is not positive definite.
  void factorise();
  /// x of A x = right, both of length n; x stays until the next call.
  std::span<const double> solve(std::span<const double> right);
  std::size_t bytes() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace diptych::diffusion
