// SPDX-License-Identifier: BSD-3-Clause
// Linear systems of the shell on its free displacements.
#include "shell/linear_solver.hpp"

#include <cmath>

#include <Eigen/Dense>
#include <cholmod.h>

#include "core/error.hpp"

namespace luff::shell {

namespace {

/// Owns CHOLMOD's workspace.
class CholmodCommon {
 public:
  CholmodCommon()
  {
    cholmod_start(&common_);
    common_.print = 0;
    // Columns one by one: LDL' without square roots, so that indefinite tangents factorise too, and the same bits
    // whichever BLAS is installed.
    common_.supernodal = CHOLMOD_SIMPLICIAL;
    common_.final_ll = 0;
    // Minimum degree; measured no worse than nested dissection on these sizes and without its set-up.
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_AMD;
    common_.postorder = 1;
  }
  ~CholmodCommon() { cholmod_finish(&common_); }
  CholmodCommon(const CholmodCommon&) = delete;
  CholmodCommon& operator=(const CholmodCommon&) = delete;

  cholmod_common* get() { return &common_; }

 private:
  cholmod_common common_;
};

/// Analysed once, factorised numerically as often as needed.
class SparseCholesky : public LinearSolver {
 public:
  SparseCholesky(const BlockPattern& pattern, const std::vector<char>& held)
  {
    number_unknowns(held);
    make_upper_triangle(pattern);
    factor_ = cholmod_analyze(matrix_, common_.get());
    ensure(factor_ != nullptr, "CHOLMOD's analysis failed");
    right_ = cholmod_allocate_dense(n_free(), 1, n_free(), CHOLMOD_REAL, common_.get());
  }

  ~SparseCholesky() override
  {
    cholmod_free_dense(&right_, common_.get());
    cholmod_free_dense(&solution_, common_.get());
    cholmod_free_dense(&work_y_, common_.get());
    cholmod_free_dense(&work_e_, common_.get());
    cholmod_free_factor(&factor_, common_.get());
    cholmod_free_sparse(&matrix_, common_.get());
  }
  SparseCholesky(const SparseCholesky&) = delete;
  SparseCholesky& operator=(const SparseCholesky&) = delete;

  void factorise(const BlockMatrix& A) override
  {
    auto* values = static_cast<double*>(matrix_->x);
    for (std::size_t s = 0; s < source_.size(); ++s)
      values[s] = A.values()[source_[s]];
    if (n_free() == 0)
      return;
    cholmod_factorize(matrix_, factor_, common_.get());
    if (common_.get()->status != CHOLMOD_OK || factor_->minor < factor_->n)
      fail_run(
          "the shell's stiffness is singular: it can move without resistance; add a support or mass, or take "
          "smaller steps");
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) override
  {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(b.size());
    if (n_free() == 0)
      return u;
    auto* right = static_cast<double*>(right_->x);
    for (int i = 0; i < n_free(); ++i)
      right[i] = b[free_[i]];
    cholmod_solve2(CHOLMOD_A, factor_, right_, nullptr, &solution_, nullptr, &work_y_, &work_e_, common_.get());
    const auto* x = static_cast<const double*>(solution_->x);
    for (int i = 0; i < n_free(); ++i)
      u[free_[i]] = x[i];
    return u;
  }

 private:
  int n_free() const { return static_cast<int>(free_.size()); }

  void number_unknowns(const std::vector<char>& held)
  {
    unknown_.assign(held.size(), -1);
    for (std::size_t i = 0; i < held.size(); ++i)
      if (!held[i]) {
        unknown_[i] = n_free();
        free_.push_back(static_cast<int>(i));
      }
  }

  /// Columns of the free unknowns with rows above the diagonal, and where their values come from. By symmetry, column j
  /// is read from row j of the blocks.
  void make_upper_triangle(const BlockPattern& pattern)
  {
    std::vector<int> start{0}, row;
    for (int j = 0; j < static_cast<int>(unknown_.size()); ++j) {
      if (unknown_[j] < 0)
        continue;
      for (int s = pattern.row_start[j / 3]; s < pattern.row_start[j / 3 + 1]; ++s)
        for (int d = 0; d < 3; ++d) {
          const int i = 3 * pattern.column[s] + d;
          if (i > j || unknown_[i] < 0)
            continue;
          row.push_back(unknown_[i]);
          source_.push_back(9 * static_cast<std::size_t>(s) + 3 * (j % 3) + d);
        }
      start.push_back(static_cast<int>(row.size()));
    }
    matrix_ = cholmod_allocate_sparse(n_free(), n_free(), row.size(), 1, 1, 1, CHOLMOD_REAL, common_.get());
    std::copy(start.begin(), start.end(), static_cast<int*>(matrix_->p));
    std::copy(row.begin(), row.end(), static_cast<int*>(matrix_->i));
  }

  CholmodCommon common_;
  std::vector<int> free_;     ///< entry of the full vector of each unknown
  std::vector<int> unknown_;  ///< unknown of each entry, or -1
  std::vector<std::size_t> source_;
  cholmod_sparse* matrix_ = nullptr;
  cholmod_factor* factor_ = nullptr;
  cholmod_dense* right_ = nullptr;
  cholmod_dense* solution_ = nullptr;
  cholmod_dense* work_y_ = nullptr;
  cholmod_dense* work_e_ = nullptr;
};

/// Conjugate gradients with the inverse 3 x 3 diagonal blocks [hestenes_1952_methods].
class BlockJacobiCg : public LinearSolver {
 public:
  BlockJacobiCg(const BlockPattern& pattern, const std::vector<char>& held) : held_(held), inverse_(pattern.n_rows()) {}

  void factorise(const BlockMatrix& A) override
  {
    matrix_ = std::make_unique<BlockMatrix>(A);
    for (int row = 0; row < A.pattern().n_rows(); ++row) {
      Mat3 D = A.block(A.pattern().slot(row, row));
      for (int d = 0; d < 3; ++d)
        if (held_[3 * row + d]) {
          D.row(d).setZero();
          D.col(d).setZero();
          D(d, d) = 1;
        }
      inverse_[row] = D.inverse();
    }
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) override
  {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(b.size()), r = b;
    clear_held(r);
    const double target = relative_tolerance * r.norm();
    Eigen::VectorXd z = precondition(r), p = z;
    double rz = r.dot(z);
    const int limit = 20 * static_cast<int>(b.size());
    for (int iteration = 0; r.norm() > target; ++iteration) {
      Eigen::VectorXd Ap = *matrix_ * p;
      clear_held(Ap);
      const double curvature = p.dot(Ap);
      if (!(curvature > 0) || iteration == limit)
        fail_run(
            "conjugate gradients: the shell's stiffness is not positive definite (p'Ap = {:.3e} in iteration {}): "
            "it buckles; use the direct solver or smaller steps",
            curvature, iteration);
      const double alpha = rz / curvature;
      u += alpha * p;
      r -= alpha * Ap;
      z = precondition(r);
      const double rz_new = r.dot(z);
      p = z + rz_new / rz * p;
      rz = rz_new;
    }
    return u;
  }

 private:
  static constexpr double relative_tolerance = 1e-10;

  void clear_held(Eigen::VectorXd& v) const
  {
    for (std::size_t i = 0; i < held_.size(); ++i)
      if (held_[i])
        v[static_cast<Eigen::Index>(i)] = 0;
  }

  Eigen::VectorXd precondition(const Eigen::VectorXd& r) const
  {
    Eigen::VectorXd z(r.size());
    for (std::size_t row = 0; row < inverse_.size(); ++row)
      z.segment<3>(3 * row) = inverse_[row] * r.segment<3>(3 * row);
    return z;
  }

  std::vector<char> held_;
  std::vector<Mat3> inverse_;
  std::unique_ptr<BlockMatrix> matrix_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_linear_solver(LinearSolverKind kind, const BlockPattern& pattern,
                                                 const std::vector<char>& held)
{
  if (kind == LinearSolverKind::Direct)
    return std::make_unique<SparseCholesky>(pattern, held);
  return std::make_unique<BlockJacobiCg>(pattern, held);
}

}  // namespace luff::shell
