// SPDX-License-Identifier: BSD-3-Clause
// The quadratic through a triangle and its three neighbours, in place of the missing ones the condition of no moment.
#pragma once

#include <array>

#include <Eigen/Core>

#include "core/vec3.hpp"

namespace luff::shell {

using Vec2 = Eigen::Vector2d;

/// Displacement in the plane of a triangle as that of its corners plus edge bubbles, sum_i L_i y_i + sum_k c_k L_a L_b
/// (a, b the corners of edge k), with c_k = sum_i bubble(k, i) y_i from the six vertices of its patch: corners 0..2,
/// then the apices across edges 0..2.
struct PatchQuadratic {
  std::array<Vec2, 3> g{};         ///< gradients of the area coordinates L, in the frame e1 = first side, e2 = N x e1
  std::array<double, 3> height{};  ///< over each edge
  std::array<Vec2, 3> m{};         ///< outward normals of the edges
  Eigen::Matrix<double, 3, 6> bubble{};
  double conic = 0;       ///< q = 1/sigma_min of the fit; 0 where nothing was fitted
  bool replaced = false;  ///< by hinge angles, because nothing determines a quadratic

  /// Weights of the six vertices in the second derivatives (x_,11, x_,22, 2 x_,12) [1/L^2].
  Eigen::Matrix<double, 3, 6> second_derivatives() const;
};

/// (m1^2, m2^2, 2 m1 m2)
Vec3 dyad(const Vec2& m);

/// Edge across which a patch folds back on its triangle by more than 90 degrees; -1: none.
int folded_edge(const std::array<Vec3, 6>& Y);

/// The quadratic through the patch Y. Apices that are `missing` lie beyond free edges, anywhere; what a quadratic then
/// lacks comes from M_nn = 0 at those edges, with the bending moduli C (shape only). Columns of missing apices are
/// zero.
PatchQuadratic patch_quadratic(const std::array<Vec3, 6>& Y, const std::array<bool, 3>& missing, const Mat3& moduli);

/// Hinge angles theta_k written as such a quadratic: curvature sum_k 2 theta_k/(h_k + h'_k) m (x) m, weights by height
/// [grinspun_2006_computing].
PatchQuadratic hinge_angles(const std::array<Vec3, 6>& Y, const std::array<bool, 3>& missing, const Mat3& moduli);

}  // namespace luff::shell
