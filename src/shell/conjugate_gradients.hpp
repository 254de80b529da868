// SPDX-License-Identifier: BSD-3-Clause
// Preconditioned conjugate gradients for the shell's tangent.
#pragma once

#include <memory>

#include "shell/linear_solver.hpp"

namespace luff::shell {

/// Approximates A^-1 on full vectors, zero where held.
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  virtual void prepare(const BlockMatrix& A) = 0;
  virtual Eigen::VectorXd apply(const Eigen::VectorXd& r) const = 0;
};

/// Inverses of the 3 x 3 diagonal blocks.
std::unique_ptr<Preconditioner> make_block_jacobi(const BlockPattern& pattern, const std::vector<char>& held);
/// Cholesky's factor without fill-in, with the diagonal raised where pivots would fail [lin_1999_incomplete].
std::unique_ptr<Preconditioner> make_incomplete_cholesky(const BlockPattern& pattern, const std::vector<char>& held);

/// [hestenes_1952_methods], to a residual of 1e-10 of the right-hand side.
class ConjugateGradients : public LinearSolver {
 public:
  ConjugateGradients(std::unique_ptr<Preconditioner> preconditioner, const std::vector<char>& held);

  Factorisation factorise(const BlockMatrix& A) override;
  /// \throws RunError where p'Ap <= 0 for a direction p, or without convergence.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) override;
  /// Of the last solve().
  int iterations() const { return iterations_; }

 private:
  void clear_held(Eigen::VectorXd& v) const;

  std::unique_ptr<Preconditioner> preconditioner_;
  std::vector<char> held_;
  std::unique_ptr<BlockMatrix> matrix_;
  int iterations_ = 0;
};

}  // namespace luff::shell
