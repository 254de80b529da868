// SPDX-License-Identifier: BSD-3-Clause
// Linear systems of the shell on its free displacements.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "shell/block_matrix.hpp"

namespace luff::shell {

enum class LinearSolverKind {
  Direct,               ///< sparse LDL'; also for indefinite matrices
  ConjugateGradients,   ///< block-Jacobi preconditioned; positive definite matrices only
  CgIncompleteCholesky  ///< conjugate gradients preconditioned by incomplete Cholesky; positive definite matrices only
};

struct Factorisation {
  /// How many eigenvalues of A are negative, by Sylvester's law the negative pivots of LDL': the number of directions
  /// in which an equilibrium with tangent A is unstable. Unknown to conjugate gradients.
  std::optional<int> negative_pivots;
};

/// Solves A u = b for a symmetric A of a fixed pattern, with u = 0 where held.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// Prepare for solving with A. \throws RunError when A is singular.
  virtual Factorisation factorise(const BlockMatrix& A) = 0;
  /// Solution for the last factorised matrix; held entries of b are ignored, those of the result are zero.
  virtual Eigen::VectorXd solve(const Eigen::VectorXd& b) = 0;
};

/// `held` has 3n flags, 1 = no unknown.
std::unique_ptr<LinearSolver> make_linear_solver(LinearSolverKind kind, const BlockPattern& pattern,
                                                 const std::vector<char>& held);

}  // namespace luff::shell
