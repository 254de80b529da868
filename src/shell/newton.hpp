// SPDX-License-Identifier: BSD-3-Clause
// Newton's method for the equilibrium of a shell, with a tangent kept while it serves.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "shell/linear_solver.hpp"
#include "shell/shell.hpp"

namespace luff::shell {

/// When to stop and when to renew the tangent; lengths relative to Shell::size().
struct NewtonPolicy {
  double tolerance = 1e-12;  ///< largest increment of a converged solution
  double round_off = 1e-8;   ///< increments below this may stop shrinking: round-off of the membrane (see report)
  double slow = 0.2;         ///< renew the tangent where an increment is more than this part of the last; 0: always
  int max_iterations = 40;
  double max_increment = 1.0;  ///< longer increments are shortened
};

struct NewtonReport {
  int iterations = 0;
  int factorisations = 0;
  double increment = 0;  ///< last one, relative to the size
  double residual = 0;   ///< Euclidean norm of the last out-of-balance force evaluated [M L/T^2]
  bool stopped_at_round_off = false;
  /// Of the last tangent: directions in which the equilibrium is unstable; unknown to conjugate gradients.
  std::optional<int> negative_pivots;
  std::vector<double> residuals;  ///< of every iteration
  std::vector<double> increments;
  Eigen::VectorXd rounding;  ///< what the last increment adds to x beyond the digits of x
};

struct Equilibrium {
  std::function<Eigen::VectorXd(const Eigen::VectorXd& x)> residual;      ///< external minus internal forces
  std::function<void(const Eigen::VectorXd& x, BlockMatrix& K)> tangent;  ///< sets K = -d residual / d x
  /// Increment of x from the residual r and the factorised tangent; K^-1 r when absent. With a load factor among the
  /// unknowns it finds and applies the factor's increment too.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& x, const Eigen::VectorXd& r, LinearSolver& solver)> increment{};
};

/// A linear solver with the tangent it was given last.
struct KeptTangent {
  KeptTangent(const Shell& shell, LinearSolverKind kind)
      : K(shell.pattern()), solver(make_linear_solver(kind, *shell.pattern(), shell.held()))
  {
  }
  BlockMatrix K;
  std::unique_ptr<LinearSolver> solver;
  Factorisation factorisation;  ///< of K
  bool valid = false;           ///< may be used as it is
};

/// Move the free displacements of x into equilibrium.
/// \throws RunError that starts with `when` and gives the place and size of the last increment.
NewtonReport newton(const Shell& shell, const Equilibrium& equilibrium, const NewtonPolicy& policy,
                    KeptTangent& tangent, Eigen::VectorXd& x, const std::string& when);

}  // namespace luff::shell
