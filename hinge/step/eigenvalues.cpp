#include "hinge/step/eigenvalues.hpp"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_eigen.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace diptych::material {
namespace {

gsl_matrix_view view(std::vector<double>& values, std::size_t size) {
  return gsl_matrix_view_array(values.data(), size, size);
}

double largest(std::vector<double> a, std::size_t size) {
  std::vector<double> values(size);
  gsl_matrix_view matrix = view(a, size);
  gsl_vector_view found = gsl_vector_view_array(values.data(), size);
  const std::unique_ptr<gsl_eigen_symm_workspace, void (*)(gsl_eigen_symm_workspace*)> space(gsl_eigen_symm_alloc(size),
                                                                                             gsl_eigen_symm_free);
  gsl_eigen_symm(&matrix.matrix, &found.vector, space.get());
  return *std::max_element(values.begin(), values.end());
}

/// V f(λ)^½ of a block, which times its transpose is f(W).
std::vector<double> root_of(const SymmetricMatrix& w, const std::function<double(double)>& f) {
  const std::size_t size = w.size();
  if (size == 0) return {};
  std::vector<double> copy = w.values(), values(size), vectors(size * size);
  gsl_matrix_view matrix = view(copy, size), columns = view(vectors, size);
  gsl_vector_view found = gsl_vector_view_array(values.data(), size);
  const std::unique_ptr<gsl_eigen_symmv_workspace, void (*)(gsl_eigen_symmv_workspace*)> space(
      gsl_eigen_symmv_alloc(size), gsl_eigen_symmv_free);
  gsl_eigen_symmv(&matrix.matrix, &found.vector, &columns.matrix, space.get());
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) vectors[i * size + j] *= std::sqrt(std::max(f(values[j]), 0.0));
  }
  return vectors;
}

}  // namespace

double largest_eigenvalue(const SymmetricMatrix& a) { return largest(a.values(), a.size()); }

double largest_eigenvalue(const std::vector<SymmetricMatrix>& w, const std::function<double(double)>& f,
                          const SymmetricMatrix& a) {
  const std::size_t size = a.size();
  std::vector<double> from = a.values(), half(size * size), both(size * size);
  gsl_matrix_view A = view(from, size), AR = view(half, size), RAR = view(both, size);
  std::vector<std::vector<double>> roots;
  for (const SymmetricMatrix& block : w) roots.push_back(root_of(block, f));
  // What f(W)^½ does to the block's columns of A, and then its transpose to the rows.
  const auto for_blocks = [&](auto&& act) {
    for (std::size_t k = 0, first = 0; k < w.size(); first += w[k].size(), ++k)
      if (w[k].size() > 0) act(view(roots[k], w[k].size()), first, w[k].size());
  };
  for_blocks([&](const gsl_matrix_view& R, std::size_t first, std::size_t n) {
    const gsl_matrix_view columns = gsl_matrix_submatrix(&A.matrix, 0, first, size, n);
    gsl_matrix_view out = gsl_matrix_submatrix(&AR.matrix, 0, first, size, n);
    gsl_blas_dgemm(CblasNoTrans, CblasNoTrans, 1, &columns.matrix, &R.matrix, 0, &out.matrix);
  });
  for_blocks([&](const gsl_matrix_view& R, std::size_t first, std::size_t n) {
    const gsl_matrix_view rows = gsl_matrix_submatrix(&AR.matrix, first, 0, n, size);
    gsl_matrix_view out = gsl_matrix_submatrix(&RAR.matrix, first, 0, n, size);
    gsl_blas_dgemm(CblasTrans, CblasNoTrans, 1, &R.matrix, &rows.matrix, 0, &out.matrix);
  });
  return largest(std::move(both), size);
}

}  // namespace diptych::material
