// SPDX-License-Identifier: BSD-3-Clause
// Direct solution on the coarsest level.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "poisson/level.hpp"

namespace luff::poisson {

/// Solves A u = f by the pseudo-inverse of A, whose null vectors are the constants on every connected component that no
/// Dirichlet side touches: f loses its mean and u has zero mean on each of them.
class CoarsestSolver {
 public:
  /// Factorises; `level` is whole on every rank.
  void factorise(const Level& level, const Cuts& cuts);
  void solve(Level& level) const;

  /// Connected component of every unknown, cells first, then extras.
  [[nodiscard]] const std::vector<int>& component() const { return component_; }
  /// Whether a component touches no Dirichlet side, so that its pressure is known up to a constant.
  [[nodiscard]] const std::vector<char>& floating() const { return floating_; }

 private:
  void assemble(const Level& level, const Cuts& cuts, Eigen::MatrixXd& A, std::vector<char>& grounded);
  void label(const Eigen::MatrixXd& A, const std::vector<char>& grounded);
  [[nodiscard]] std::vector<std::vector<int>> floating_members() const;

  std::vector<std::ptrdiff_t> place_;
  std::vector<int> component_;
  std::vector<char> floating_;
  Eigen::MatrixXf inverse_;
  mutable Eigen::VectorXf f_, u_;
};

}  // namespace luff::poisson
