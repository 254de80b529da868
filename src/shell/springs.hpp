// SPDX-License-Identifier: BSD-3-Clause
// Elastic supports.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "shell/block_matrix.hpp"
#include "shell/edge_turn.hpp"

namespace luff::shell {

/// Linear springs that are relaxed in the reference X: sum of k_d (x_d - X_d)^2/2 at vertices and of k theta^2/2 on
/// edges, theta as in EdgeTurn.
struct Springs {
  struct OnVertex {
    int vertex;
    Vec3 stiffness;  ///< along x, y, z [M/T^2]
  };
  struct OnEdge {
    EdgeTurn turn;
    double stiffness;  ///< of the whole edge [M L^2/T^2 per rad^2]
  };

  std::vector<OnVertex> on_vertices{};
  std::vector<OnEdge> on_edges{};

  bool empty() const { return on_vertices.empty() && on_edges.empty(); }
  /// Take in the springs of a mesh whose vertices come after `first_vertex` others.
  void append(const Springs& other, int first_vertex);
  double energy(const Eigen::VectorXd& X, const Eigen::VectorXd& x) const;
  /// f += gradient of the energy.
  void add_force(const Eigen::VectorXd& X, const Eigen::VectorXd& x, Eigen::VectorXd& f) const;
  /// K += Hessian of the energy.
  void add_stiffness(const Eigen::VectorXd& x, BlockMatrix& K) const;
};

}  // namespace luff::shell
