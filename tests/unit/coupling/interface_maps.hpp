// SPDX-License-Identifier: BSD-3-Clause
// Small maps d -> S(F(d)) with known fixed points, and how many iterations a method needs on them.
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Dense>

#include "coupling/fixed_point.hpp"

namespace luff::coupling::test {

/// d~ = J d + c
struct LinearMap {
  Eigen::MatrixXd J;
  Eigen::VectorXd c;

  Eigen::VectorXd operator()(const Eigen::VectorXd& d) const { return J * d + c; }
  Eigen::VectorXd fixed_point() const
  {
    return (Eigen::MatrixXd::Identity(J.rows(), J.cols()) - J).partialPivLu().solve(c);
  }
};

inline Eigen::VectorXd random_vector(int n, unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd v(n);
  for (double& x : v)
    x = normal(random);
  return v;
}

inline Eigen::MatrixXd random_matrix(int n, unsigned seed)
{
  return random_vector(n * n, seed).reshaped(n, n);
}

/// A map with the given eigenvalues and a random orthogonal basis of eigenvectors.
inline LinearMap map_with_eigenvalues(const Eigen::VectorXd& eigenvalues, unsigned seed)
{
  const int n = static_cast<int>(eigenvalues.size());
  const Eigen::MatrixXd Q = random_matrix(n, seed).householderQr().householderQ();
  return {Q * eigenvalues.asDiagonal() * Q.transpose(), random_vector(n, seed + 1)};
}

/// A string of n masses in a fluid much heavier than it: the added mass of mode m falls like 1/m, so that
/// the eigenvalues are -ratio/m (causin_2005_added).
inline LinearMap added_mass_map(int n, double ratio, unsigned seed)
{
  Eigen::VectorXd eigenvalues(n);
  for (int m = 0; m < n; ++m)
    eigenvalues[m] = -ratio / (m + 1);
  return map_with_eigenvalues(eigenvalues, seed);
}

inline FixedPointReport solve(const InterfaceMap& map, Eigen::VectorXd& d, Acceleration& acceleration, double tolerance,
                              int max_iterations)
{
  return solve_fixed_point(map, d, acceleration, {tolerance, max_iterations}, displacement_norm(1));
}

}  // namespace luff::coupling::test
