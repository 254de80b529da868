// SPDX-License-Identifier: BSD-3-Clause
// Kirchhoff-Love triangle without rotations.
#include "shell/element.hpp"

#include <Eigen/Geometry>

namespace luff::shell {

Eigen::Matrix<double, 3, max_nodes> curvature_derivative(const Element& e, const ElementKinematics& k)
{
  Eigen::Matrix<double, 3, max_nodes> rho = e.H;
  rho.leftCols<3>().noalias() -= k.a.transpose() * k.G;
  return rho;
}

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
  k.E_membrane = green_lagrange(k.F);
  k.E_bending = e.kappa_0 - k.kappa;
  return k;
}

NodeForces nodal_forces(const Element& e, const ElementKinematics& k, const Resultants& resultants)
{
  const Vec3 q = -e.area * resultants.M;
  Eigen::Matrix<double, 1, max_nodes> r = q.transpose() * e.H;
  r.head<3>().noalias() -= (k.a * q).transpose() * k.G;
  NodeForces f = k.n * r;
  f.leftCols<3>().noalias() += first_piola(k.F, e.area * resultants.N) * e.gradient;
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
    B[i] = membrane_derivative(k.F, e.gradient.col(i));
    DB[i] = e.area * (D.membrane * B[i]);
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      K.membrane(i, j).noalias() = B[i].transpose() * DB[j];
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
  const Mat3 geometric = geometric_membrane(e.gradient, e.area * resultants.N);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      K.membrane(i, j).diagonal().array() += geometric(i, j);
}

}  // namespace luff::shell
