// SPDX-License-Identifier: BSD-3-Clause
// Small linear problems of a shell at its reference configuration.
#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "shell/linear_solver.hpp"
#include "shell/shell.hpp"

namespace luff::test {

/// Displacement under small nodal forces, K(X) u = f.
inline Eigen::VectorXd linear_displacement(const shell::Shell& shell, const Eigen::VectorXd& f)
{
  shell::BlockMatrix K(shell.pattern());
  shell.add_tangent(shell.reference_positions(), K);
  const auto solver = shell::make_linear_solver(shell::LinearSolverKind::Direct, *shell.pattern(), shell.held());
  solver->factorise(K);
  return solver->solve(f);
}

/// Angular frequencies of all free vibrations about the reference, ascending (dense; small meshes).
inline Eigen::VectorXd natural_frequencies(const shell::Shell& shell)
{
  shell::BlockMatrix K(shell.pattern()), M(shell.pattern());
  shell.add_tangent(shell.reference_positions(), K);
  shell.add_mass(1, M);
  std::vector<int> free;
  for (int i = 0; i < 3 * shell.n_vertices(); ++i)
    if (!shell.held()[i])
      free.push_back(i);
  const Eigen::MatrixXd K_free = K.dense()(free, free), M_free = M.dense()(free, free);
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(K_free, M_free, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .cwiseMax(0)
      .cwiseSqrt();
}

/// Exponent p of error ~ h^p between two meshes, the second twice as fine.
inline double observed_order(double coarse_error, double fine_error)
{
  return std::log2(std::abs(coarse_error / fine_error));
}

}  // namespace luff::test
