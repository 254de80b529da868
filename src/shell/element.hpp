// SPDX-License-Identifier: BSD-3-Clause
// Kirchhoff-Love triangle without rotations: energy, exact force and exact tangent. Symbols: docs/numerics/shell.md.
#pragma once

#include <array>

#include <Eigen/Core>

#include "core/vec3.hpp"
#include "shell/section.hpp"

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
  Fibre fibre = Fibre::UnitX();           ///< direction of the material in the frame of the triangle
};

/// Positions of the nodes relative to node 0 [L].
using NodePositions = Eigen::Matrix<double, 3, max_nodes>;
using NodeForces = Eigen::Matrix<double, 3, max_nodes>;

/// Strains of one triangle and what their derivatives share.
struct ElementKinematics {
  Vec3 n;                         ///< unit normal
  Mat3 G;                         ///< column i: current gradient of area coordinate i, n x d_i / (2 A_c)
  Eigen::Matrix<double, 3, 2> F;  ///< sum_i x_i (x) g_i
  Mat3 a;                         ///< column V: sum_i H_V^i y_i
  Vec3 kappa;                     ///< n . a_V
  Vec3 E_membrane;                ///< (F'F - I)/2 in Voigt order with engineering shear
  Vec3 E_bending;                 ///< -(kappa - kappa_0)
};

ElementKinematics kinematics(const Element& element, const NodePositions& y);

/// Forces that resultants per area of the reference make at the nodes, A (B^m' N + B^b' M).
NodeForces nodal_forces(const Element& element, const ElementKinematics& k, const Resultants& resultants);

/// Hessian of the energy in factored form,
///
///   K_ij = w_ij n n' - [j<3] r_i G_j n' - [i<3] r_j n G_i' - [i<3] c_ij n' - [j<3] n c_ji' + [i,j<3] m_ij,
///
/// with n the normal, G_i the current in-plane gradients; c is zero unless the section couples stretch and bending.
struct ElementTangent {
  Eigen::Matrix<double, max_nodes, max_nodes> w;
  Eigen::Matrix<double, max_nodes, 1> r;
  Mat3 G;  ///< column i: gradient of node i's area coordinate in the current triangle
  Vec3 n;
  std::array<Mat3, 9> m;
  bool coupled = false;
  std::array<Eigen::Matrix<double, 3, max_nodes>, 3> c;  ///< c[i].col(j) is c_ij

  Mat3 block(int i, int j) const
  {
    Mat3 K = w(i, j) * n * n.transpose();
    if (j < 3)
      K.noalias() -= r[i] * G.col(j) * n.transpose();
    if (i < 3)
      K.noalias() -= r[j] * n * G.col(i).transpose();
    if (coupled && i < 3)
      K.noalias() -= c[i].col(j) * n.transpose();
    if (coupled && j < 3)
      K.noalias() -= n * c[j].col(i).transpose();
    if (i < 3 && j < 3)
      K += m[3 * i + j];
    return K;
  }
};

/// The part A B'DB of the tangent: positive semi-definite where D is, no force on rigid motions.
ElementTangent material_tangent(const Element& element, const ElementKinematics& k, const SectionStiffness& D,
                                bool coupled);

/// tangent += the part that the resultants make through the change of the strains' derivatives.
void add_geometric_tangent(const Element& element, const ElementKinematics& k, const Resultants& resultants,
                           ElementTangent& tangent);

}  // namespace luff::shell
