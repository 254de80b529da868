// SPDX-License-Identifier: BSD-3-Clause
// How far a shell has turned about one of its edges.
#pragma once

#include <array>

#include <Eigen/Core>

#include "core/vec3.hpp"
#include "surface/mesh.hpp"
#include "surface/topology.hpp"

namespace luff::shell {

/// Angle theta about the direction that a boundary edge has in the reference, of the direction d = F m that points out
/// of the shell across the edge, in the flat triangle behind it:
///
///   d = sum_i c_i x_i,   theta = atan2(N . d, m . d),
///
/// m and N the outward direction and the normal of the reference. Positive where the edge is raised towards N.
class EdgeTurn {
 public:
  EdgeTurn(const surface::TriangleMesh& reference, surface::TriangleEdge edge);

  const std::array<int, 3>& corner() const { return corner_; }
  /// Of the edge in the reference [L].
  double length() const { return length_; }
  /// In (-pi, pi]; a full turn brings it back to where it was.
  double angle(const Eigen::VectorXd& x) const;
  /// Column i: derivative in the position of corner i. It has no jump.
  Mat3 gradient(const Eigen::VectorXd& x) const;
  /// Second derivative in the positions of corners i and j: weight(i, j) times this.
  Mat3 curvature(const Eigen::VectorXd& x) const;
  double weight(int i, int j) const { return c_[i] * c_[j]; }
  /// The same edge of a mesh whose vertices come after others.
  void renumber(int first_vertex);

 private:
  Vec3 direction(const Eigen::VectorXd& x) const;

  std::array<int, 3> corner_;
  Vec3 c_;  ///< [1/L], adds up to zero
  Vec3 m_;
  Vec3 N_;
  double length_;
};

}  // namespace luff::shell
