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
/// Those that can be in the membrane: corners and apices, which come first.
inline constexpr int max_membrane_nodes = 6;

/// What the reference configuration leaves behind in one triangle. Entries from n_nodes on repeat node 0, weight zero.
struct Element {
  int n_nodes = 0;
  bool has_images = false;
  std::array<int, max_nodes> vertex{};
  std::array<int, max_nodes> image{};     ///< index of an affine image, or -1
  Eigen::Matrix<double, 3, max_nodes> H;  ///< curvature weights [1/L^2], row V = 11, 22, 2.12
  Eigen::Matrix<double, 2, 3> gradient;   ///< of the area coordinates [1/L]
  int smoothed = -1;                      ///< index of a SmoothedMembrane, or -1: constant membrane strain
  Mat3 turning;                           ///< column k: 2/h_k m_k (x) m_k, curvature by the turn over edge k [1/L]
  Mat3 turns;                             ///< its inverse [L]
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
  Vec3 sines;                     ///< sigma_k, half the sine of the turn over edge k that n . a_V means
  Vec3 kappa;                     ///< that of the turns themselves
  Vec3 E_membrane;                ///< (F'F - I)/2 in Voigt order with engineering shear
  Vec3 E_bending;                 ///< -(kappa - kappa_0)
};

/// (F'F - I)/2 in Voigt order with engineering shear.
inline Vec3 green_lagrange(const Eigen::Matrix<double, 3, 2>& F)
{
  return {0.5 * (F.col(0).squaredNorm() - 1), 0.5 * (F.col(1).squaredNorm() - 1), F.col(0).dot(F.col(1))};
}

/// F S of a symmetric S in Voigt order.
inline Eigen::Matrix<double, 3, 2> first_piola(const Eigen::Matrix<double, 3, 2>& F, const Vec3& S)
{
  Eigen::Matrix<double, 3, 2> P;
  P << S[0] * F.col(0) + S[2] * F.col(1), S[1] * F.col(1) + S[2] * F.col(0);
  return P;
}

/// Derivative of green_lagrange(F) in the position of a corner whose area coordinate has the gradient g,
/// rows g_1 F_1', g_2 F_2', g_1 F_2' + g_2 F_1'.
inline Mat3 membrane_derivative(const Eigen::Matrix<double, 3, 2>& F, const Eigen::Vector2d& g)
{
  Mat3 B;
  B.row(0) = g[0] * F.col(0).transpose();
  B.row(1) = g[1] * F.col(1).transpose();
  B.row(2) = (g[0] * F.col(1) + g[1] * F.col(0)).transpose();
  return B;
}

/// g_i . S g_j, which multiplies the identity in the membrane's geometric tangent.
inline Mat3 geometric_membrane(const Eigen::Matrix<double, 2, 3>& gradient, const Vec3& S)
{
  Eigen::Matrix2d stress;
  stress << S[0], S[2], S[2], S[1];
  return gradient.transpose() * stress * gradient;
}

ElementKinematics kinematics(const Element& element, const NodePositions& y);

/// rho_i^V, so that the variation of kappa_V is sum_i rho_i^V n . (variation of y_i): d kappa/d(n . a) times
/// H_V^i - [i<3] a_V . G_i.
Eigen::Matrix<double, 3, max_nodes> curvature_derivative(const Element& element, const ElementKinematics& k);

/// Forces that resultants per area of the reference make at the nodes, A (B^m' N + B^b' M).
NodeForces nodal_forces(const Element& element, const ElementKinematics& k, const Resultants& resultants);

/// Hessian of the energy in factored form,
///
///   K_ij = w_ij n n' - [j<3] r_i G_j n' - [i<3] r_j n G_i' - [i<s] c_ij n' - [j<s] n c_ji' + [i,j<s] m_ij,
///
/// with n the normal, G_i the current in-plane gradients and s the nodes in the membrane strain, 3 or, smoothed, 6; c
/// is zero unless the section couples stretch and bending.
struct ElementTangent {
  Eigen::Matrix<double, max_nodes, max_nodes> w;
  Eigen::Matrix<double, max_nodes, 1> r;
  Mat3 G;  ///< column i: gradient of node i's area coordinate in the current triangle
  Vec3 n;
  int n_membrane = 3;
  std::array<Mat3, max_membrane_nodes * max_membrane_nodes> m;
  bool coupled = false;
  std::array<Eigen::Matrix<double, 3, max_nodes>, max_membrane_nodes> c;  ///< c[i].col(j) is c_ij

  Mat3& membrane(int i, int j) { return m[max_membrane_nodes * i + j]; }
  const Mat3& membrane(int i, int j) const { return m[max_membrane_nodes * i + j]; }

  Mat3 block(int i, int j) const
  {
    Mat3 K = w(i, j) * n * n.transpose();
    if (j < 3)
      K.noalias() -= r[i] * G.col(j) * n.transpose();
    if (i < 3)
      K.noalias() -= r[j] * n * G.col(i).transpose();
    if (coupled && i < n_membrane)
      K.noalias() -= c[i].col(j) * n.transpose();
    if (coupled && j < n_membrane)
      K.noalias() -= n * c[j].col(i).transpose();
    if (i < n_membrane && j < n_membrane)
      K += membrane(i, j);
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
