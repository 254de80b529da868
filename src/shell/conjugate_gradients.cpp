// SPDX-License-Identifier: BSD-3-Clause
// Preconditioned conjugate gradients for the shell's tangent.
#include "shell/conjugate_gradients.hpp"

#include <Eigen/Dense>
#include <Eigen/IterativeLinearSolvers>

#include "core/error.hpp"
#include "shell/free_unknowns.hpp"

namespace luff::shell {

namespace {

class BlockJacobi : public Preconditioner {
 public:
  BlockJacobi(const BlockPattern& pattern, const std::vector<char>& held) : held_(held), inverse_(pattern.n_rows()) {}

  void prepare(const BlockMatrix& A) override
  {
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

  Eigen::VectorXd apply(const Eigen::VectorXd& r) const override
  {
    Eigen::VectorXd z(r.size());
    for (std::size_t row = 0; row < inverse_.size(); ++row)
      z.segment<3>(3 * row) = inverse_[row] * r.segment<3>(3 * row);
    return z;
  }

 private:
  std::vector<char> held_;
  std::vector<Mat3> inverse_;
};

class IncompleteCholesky : public Preconditioner {
 public:
  IncompleteCholesky(const BlockPattern& pattern, const std::vector<char>& held)
      : unknowns_(held), triangle_(pattern, unknowns_)
  {
  }

  void prepare(const BlockMatrix& A) override
  {
    const UpperTriangle& U = triangle_.pattern();
    if (U.size() == 0)  // Eigen's factorisation of nothing is an assertion
      return;
    // Upper columns of a symmetric matrix are its lower rows.
    const Eigen::Map<const Eigen::SparseMatrix<double>> upper(U.size(), U.size(),
                                                              static_cast<Eigen::Index>(U.row.size()), U.start.data(),
                                                              U.row.data(), triangle_.values(A).data());
    factor_.compute(upper);
    if (factor_.info() != Eigen::Success)
      fail_run(
          "conjugate gradients: the shell's stiffness has no incomplete Cholesky factor, it is far from positive "
          "definite; use the direct solver or smaller steps");
  }

  Eigen::VectorXd apply(const Eigen::VectorXd& r) const override
  {
    if (triangle_.pattern().size() == 0)
      return Eigen::VectorXd::Zero(r.size());
    return unknowns_.expanded(factor_.solve(unknowns_.restricted(r)));
  }

 private:
  FreeUnknowns unknowns_;
  FreeTriangle triangle_;
  Eigen::IncompleteCholesky<double, Eigen::Upper> factor_;
};

}  // namespace

std::unique_ptr<Preconditioner> make_block_jacobi(const BlockPattern& pattern, const std::vector<char>& held)
{
  return std::make_unique<BlockJacobi>(pattern, held);
}

std::unique_ptr<Preconditioner> make_incomplete_cholesky(const BlockPattern& pattern, const std::vector<char>& held)
{
  return std::make_unique<IncompleteCholesky>(pattern, held);
}

ConjugateGradients::ConjugateGradients(std::unique_ptr<Preconditioner> preconditioner, const std::vector<char>& held)
    : preconditioner_(std::move(preconditioner)), held_(held)
{
}

Factorisation ConjugateGradients::factorise(const BlockMatrix& A)
{
  matrix_ = std::make_unique<BlockMatrix>(A);
  preconditioner_->prepare(A);
  return {};
}

Eigen::VectorXd ConjugateGradients::solve(const Eigen::VectorXd& b)
{
  constexpr double relative_tolerance = 1e-10;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(b.size()), r = b;
  clear_held(r);
  const double target = relative_tolerance * r.norm();
  Eigen::VectorXd z = preconditioner_->apply(r), p = z;
  double rz = r.dot(z);
  const int limit = 20 * static_cast<int>(b.size());
  for (iterations_ = 0; r.norm() > target; ++iterations_) {
    if (iterations_ == limit)
      fail_run(
          "conjugate gradients: no convergence in {} iterations, residual {:.1e} of the load; use the direct solver",
          limit, r.norm() / target * relative_tolerance);
    Eigen::VectorXd Ap = *matrix_ * p;
    clear_held(Ap);
    const double curvature = p.dot(Ap);
    if (!(curvature > 0))
      fail_run(
          "conjugate gradients: the shell's stiffness is not positive definite (p'Ap = {:.3e} in iteration {}): "
          "it buckles; use the direct solver or smaller steps",
          curvature, iterations_ + 1);
    const double alpha = rz / curvature;
    u += alpha * p;
    r -= alpha * Ap;
    z = preconditioner_->apply(r);
    const double rz_new = r.dot(z);
    p = z + rz_new / rz * p;
    rz = rz_new;
  }
  return u;
}

void ConjugateGradients::clear_held(Eigen::VectorXd& v) const
{
  for (std::size_t i = 0; i < held_.size(); ++i)
    if (held_[i])
      v[static_cast<Eigen::Index>(i)] = 0;
}

}  // namespace luff::shell
