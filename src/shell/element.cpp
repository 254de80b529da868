// SPDX-License-Identifier: BSD-3-Clause
// Kirchhoff-Love triangle without rotations.
#include "shell/element.hpp"

#include <Eigen/Geometry>

namespace luff::shell {

namespace {

/// Turns of the surface over the edges, whose half sines are sigma: half of asin(2 sigma) to third order.
Vec3 half_turns(const Vec3& sigma)
{
  return sigma.array() + 2.0 / 3 * sigma.array().cube();
}

Vec3 half_turns_derivative(const Vec3& sigma)
{
  return 1 + 2 * sigma.array().square();
}

Vec3 half_turns_second_derivative(const Vec3& sigma)
{
  return 4 * sigma;
}

/// Derivative of n . a_V in the positions of the nodes along n, H_V^i - [i<3] a_V . G_i.
Eigen::Matrix<double, 3, max_nodes> chord_derivative(const Element& e, const ElementKinematics& k)
{
  Eigen::Matrix<double, 3, max_nodes> rho = e.H;
  rho.leftCols<3>().noalias() -= k.a.transpose() * k.G;
  return rho;
}

/// Moments that work on n . a_V, times minus the area.
Vec3 chord_moments(const Element& e, const ElementKinematics& k, const Vec3& M)
{
  const Vec3 over_edges = half_turns_derivative(k.sines).cwiseProduct(e.turning.transpose() * M);
  return -e.area * (e.turns.transpose() * over_edges);
}

}  // namespace

Eigen::Matrix<double, 3, max_nodes> curvature_derivative(const Element& e, const ElementKinematics& k)
{
  const Mat3 d_kappa = e.turning * half_turns_derivative(k.sines).asDiagonal() * e.turns;
  return d_kappa * chord_derivative(e, k);
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
  k.sines.noalias() = e.turns * (k.a.transpose() * k.n);
  k.kappa.noalias() = e.turning * half_turns(k.sines);
  k.E_membrane = green_lagrange(k.F);
  k.E_bending = e.kappa_0 - k.kappa;
  return k;
}

NodeForces nodal_forces(const Element& e, const ElementKinematics& k, const Resultants& resultants)
{
  const Vec3 q = chord_moments(e, k, resultants.M);
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
  const Vec3 q = chord_moments(e, k, resultants.M);
  K.r.noalias() = e.H.transpose() * q;
  K.r.head<3>().noalias() -= k.G.transpose() * (k.a * q);
  K.w.topLeftCorner<3, 3>().noalias() -= q.dot(k.a.transpose() * k.n) * (k.G.transpose() * k.G);
  const Eigen::Matrix<double, 3, max_nodes> d_sines = e.turns * chord_derivative(e, k);
  const Vec3 bent = -e.area * half_turns_second_derivative(k.sines).cwiseProduct(e.turning.transpose() * resultants.M);
  K.w.noalias() += d_sines.transpose() * bent.asDiagonal() * d_sines;
  const Mat3 geometric = geometric_membrane(e.gradient, e.area * resultants.N);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      K.membrane(i, j).diagonal().array() += geometric(i, j);
}

}  // namespace luff::shell
