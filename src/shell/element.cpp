// SPDX-License-Identifier: BSD-3-Clause
// Kirchhoff-Love triangle without rotations.
#include "shell/element.hpp"

#include <Eigen/Geometry>

namespace luff::shell {

namespace {

/// Derivative of the membrane strain in the position of corner i: g_i1 F_1', g_i2 F_2', g_i1 F_2' + g_i2 F_1'.
Mat3 membrane_derivative(const Element& e, const ElementKinematics& k, int i)
{
  const double g1 = e.gradient(0, i), g2 = e.gradient(1, i);
  Mat3 B;
  B.row(0) = g1 * k.F.col(0).transpose();
  B.row(1) = g2 * k.F.col(1).transpose();
  B.row(2) = (g1 * k.F.col(1) + g2 * k.F.col(0)).transpose();
  return B;
}

/// rho_i^V = H_V^i - [i<3] a_V . G_i, so that the variation of kappa_V is sum_i rho_i^V n . (variation of y_i).
Eigen::Matrix<double, 3, max_nodes> curvature_derivative(const Element& e, const ElementKinematics& k)
{
  Eigen::Matrix<double, 3, max_nodes> rho = e.H;
  rho.leftCols<3>().noalias() -= k.a.transpose() * k.G;
  return rho;
}

}  // namespace

ElementKinematics kinematics(const Element& e, const NodePositions& y)
{
  ElementKinematics k;
  const Vec3 d1 = y.col(2) - y.col(1), d2 = y.col(0) - y.col(2), d3 = y.col(1) - y.col(0);
  const Vec3 c = d2.cross(d3);
  const double twice_area = c.norm();
  k.n = c / twice_area;
  const Vec3 scaled = k.n / twice_area;
  k.G << scaled.cross(d1), scaled.cross(d2), scaled.cross(d3);
  k.F.noalias() = d3 * e.gradient.col(1).transpose() - d2 * e.gradient.col(2).transpose();
  k.a.noalias() = y * e.H.transpose();
  k.kappa.noalias() = k.a.transpose() * k.n;
  k.E_membrane << 0.5 * (k.F.col(0).squaredNorm() - 1), 0.5 * (k.F.col(1).squaredNorm() - 1),
      k.F.col(0).dot(k.F.col(1));
  k.E_bending = e.kappa_0 - k.kappa;
  return k;
}

NodeForces nodal_forces(const Element& e, const ElementKinematics& k, const Resultants& resultants)
{
  const Vec3 q = -e.area * resultants.M;
  Eigen::Matrix<double, 1, max_nodes> r = q.transpose() * e.H;
  r.head<3>().noalias() -= (k.a * q).transpose() * k.G;
  NodeForces f = k.n * r;
  const Vec3 N = e.area * resultants.N;
  Eigen::Matrix<double, 3, 2> stress;
  stress << N[0] * k.F.col(0) + N[2] * k.F.col(1), N[1] * k.F.col(1) + N[2] * k.F.col(0);
  f.leftCols<3>().noalias() += stress * e.gradient;
  return f;
}

ElementTangent material_tangent(const Element& e, const ElementKinematics& k, const SectionStiffness& D, bool coupled)
{
  ElementTangent K;
  K.n = k.n;
  K.G = k.G;
  const Eigen::Matrix<double, 3, max_nodes> rho = curvature_derivative(e, k);
  const Eigen::Matrix<double, 3, max_nodes> D_rho = e.area * (D.bending * rho);
  K.w.noalias() = rho.transpose() * D_rho;
  K.r.setZero();
  std::array<Mat3, 3> B, DB;
  for (int i = 0; i < 3; ++i) {
    B[i] = membrane_derivative(e, k, i);
    DB[i] = e.area * (D.membrane * B[i]);
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      K.m[3 * i + j].noalias() = B[i].transpose() * DB[j];
  K.coupled = coupled;
  if (coupled)
    for (int i = 0; i < 3; ++i)
      K.c[i].noalias() = e.area * (D.coupling * B[i]).transpose() * rho;
  return K;
}

void add_geometric_tangent(const Element& e, const ElementKinematics& k, const Resultants& resultants,
                           ElementTangent& K)
{
  const Vec3 q = -e.area * resultants.M;
  K.r.noalias() = e.H.transpose() * q;
  K.r.head<3>().noalias() -= k.G.transpose() * (k.a * q);
  K.w.topLeftCorner<3, 3>().noalias() -= q.dot(k.kappa) * (k.G.transpose() * k.G);
  const Vec3 N = e.area * resultants.N;
  Eigen::Matrix2d stress;
  stress << N[0], N[2], N[2], N[1];
  const Mat3 geometric = e.gradient.transpose() * stress * e.gradient;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      K.m[3 * i + j].diagonal().array() += geometric(i, j);
}

}  // namespace luff::shell
