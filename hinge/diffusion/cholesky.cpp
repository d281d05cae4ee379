#include "hinge/diffusion/cholesky.hpp"

#include <cholmod.h>

#include <new>
#include <stdexcept>
#include <utility>

namespace diptych::diffusion {

struct Cholesky::Parts {
  std::vector<int> starts, rows;
  std::vector<double> entries;
  cholmod_common common{};
  cholmod_sparse matrix{};
  cholmod_factor* factor = nullptr;
  cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr;  // solution and workspace, kept from call to call

  ~Parts() {
    for (cholmod_dense** dense : {&x, &y, &e}) cholmod_free_dense(dense, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
};

Cholesky::Cholesky(std::vector<int> starts, std::vector<int> rows) : parts_(std::make_unique<Parts>()) {
  Parts& p = *parts_;
  cholmod_start(&p.common);
  p.common.print = 0;
  // L Lᵀ, not L D Lᵀ: the latter takes an indefinite matrix without a word. Simplicial beats supernodal at these sizes.
  p.common.supernodal = CHOLMOD_SIMPLICIAL;
  p.common.final_ll = 1;
  p.starts = std::move(starts);
  p.rows = std::move(rows);
  p.entries.assign(p.rows.size(), 0);
  p.matrix.nrow = p.matrix.ncol = p.starts.size() - 1;
  p.matrix.nzmax = p.rows.size();
  p.matrix.p = p.starts.data();
  p.matrix.i = p.rows.data();
  p.matrix.x = p.entries.data();
  p.matrix.stype = -1;
  p.matrix.itype = CHOLMOD_INT;
  p.matrix.xtype = CHOLMOD_REAL;
  p.matrix.dtype = CHOLMOD_DOUBLE;
  p.matrix.sorted = p.matrix.packed = 1;
  p.factor = cholmod_analyze(&p.matrix, &p.common);
  if (p.factor == nullptr) throw std::bad_alloc();
}

Cholesky::~Cholesky() = default;

std::span<double> Cholesky::entries() { return parts_->entries; }

void Cholesky::factorise() {
  Parts& p = *parts_;
  cholmod_factorize(&p.matrix, p.factor, &p.common);
  if (p.common.status == CHOLMOD_NOT_POSDEF) throw std::runtime_error("CHOLMOD: the matrix is not positive definite");
  if (p.common.status < 0) throw std::runtime_error("CHOLMOD: the factorisation failed");
}

std::span<const double> Cholesky::solve(std::span<const double> right) {
  Parts& p = *parts_;
  cholmod_dense b{};
  b.nrow = b.nzmax = b.d = right.size();
  b.ncol = 1;
  b.x = const_cast<double*>(right.data());  // CHOLMOD only reads it
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;
  if (!cholmod_solve2(CHOLMOD_A, p.factor, &b, nullptr, &p.x, nullptr, &p.y, &p.e, &p.common)) throw std::bad_alloc();
  return {static_cast<const double*>(p.x->x), right.size()};
}

std::size_t Cholesky::bytes() const {
  return parts_->common.memory_inuse + (parts_->starts.size() + parts_->rows.size()) * sizeof(int) +
         parts_->entries.size() * sizeof(double);
}

}  // namespace diptych::diffusion
