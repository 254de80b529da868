// SPDX-License-Identifier: BSD-3-Clause
// Kirchhoff-Love triangle without rotations: energy, exact force and exact tangent. Symbols: docs/numerics/shell.md.
#pragma once

#include <array>

#include <Eigen/Core>

#include "core/vec3.hpp"

namespace luff::shell {

/// Corners, apices and second apices of an averaged-quadratics stencil.
inline constexpr int max_nodes = 12;

/// What the reference configuration leaves behind in one triangle. Entries from n_nodes on repeat node 0, weight zero.
struct Element {
  int n_nodes = 0;
  bool has_images = false;
  std::array<int, max_nodes> vertex{};
  std::array<int, max_nodes> image{};     ///< index of an affine image, or -1
  Eigen::Matrix<double, 3, max_nodes> H;  ///< curvature weights [1/L^2], row V = 11, 22, 2.12
  Eigen::Matrix<double, 2, 3> gradient;   ///< of the area coordinates [1/L]
  Vec3 kappa_0;                           ///< curvature of the reference [1/L]
  double area = 0;                        ///< of the reference [L^2]
};

/// Plane-stress stiffness integrated over the thickness: N = membrane E^m, M = bending E^b.
struct Rigidity {
  Mat3 membrane;  ///< h C [M/T^2]
  Mat3 bending;   ///< h^3/12 C [M L^2/T^2]
};

/// Positions of the nodes relative to node 0 [L].
using NodePositions = Eigen::Matrix<double, 3, max_nodes>;
using NodeForces = Eigen::Matrix<double, 3, max_nodes>;

/// Curvature kappa_V = n . sum_i H_V^i y_i.
Vec3 curvature(const Element& element, const NodePositions& y);

/// Stored energy A (E^m N + E^b M)/2 [M L^2/T^2].
double energy(const Element& element, const Rigidity& rigidity, const NodePositions& y);

/// Gradient of the energy in the nodes' positions.
NodeForces force(const Element& element, const Rigidity& rigidity, const NodePositions& y);

/// Hessian of the energy in factored form,
///
///   K_ij = w_ij n n' - [j<3] r_i G_j n' - [i<3] r_j n G_i' + [i,j<3] m_ij,
///
/// with n the normal, G_i the current in-plane gradients.
struct ElementTangent {
  Eigen::Matrix<double, max_nodes, max_nodes> w;
  Eigen::Matrix<double, max_nodes, 1> r;
  Mat3 G;  ///< column i: gradient of node i's area coordinate in the current triangle
  Vec3 n;
  std::array<Mat3, 9> m;

  Mat3 block(int i, int j) const
  {
    Mat3 K = w(i, j) * n * n.transpose();
    if (j < 3)
      K.noalias() -= r[i] * G.col(j) * n.transpose();
    if (i < 3)
      K.noalias() -= r[j] * n * G.col(i).transpose();
    if (i < 3 && j < 3)
      K += m[3 * i + j];
    return K;
  }
};

ElementTangent tangent(const Element& element, const Rigidity& rigidity, const NodePositions& y);

/// The part A B'DB of the tangent: positive semi-definite, no force on rigid motions.
ElementTangent material_tangent(const Element& element, const Rigidity& rigidity, const NodePositions& y);

}  // namespace luff::shell
