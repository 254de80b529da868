// SPDX-License-Identifier: BSD-3-Clause
// How far a shell has turned about one of its edges.
#include "shell/edge_turn.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace luff::shell {

EdgeTurn::EdgeTurn(const surface::TriangleMesh& reference, surface::TriangleEdge edge)
    : corner_(reference.triangles[edge.triangle]), N_(surface::unit_normal(reference, edge.triangle))
{
  const auto [a, b] = surface::edge_vertices(corner_, edge.edge);
  const Vec3 along = reference.vertices[b] - reference.vertices[a];
  length_ = along.norm();
  m_ = along.cross(N_) / length_;
  // c_i = m . (gradient of area coordinate i), N x (the side opposite corner i) over twice the area.
  const Vec3 scaled = N_ / (2 * surface::area(reference, edge.triangle));
  for (int i = 0; i < 3; ++i) {
    const Vec3 side = reference.vertices[corner_[(i + 2) % 3]] - reference.vertices[corner_[(i + 1) % 3]];
    c_[i] = m_.dot(scaled.cross(side));
  }
}

Vec3 EdgeTurn::direction(const Eigen::VectorXd& x) const
{
  const Vec3 origin = x.segment<3>(3 * corner_[0]);
  return c_[1] * (x.segment<3>(3 * corner_[1]) - origin) + c_[2] * (x.segment<3>(3 * corner_[2]) - origin);
}

double EdgeTurn::angle(const Eigen::VectorXd& x) const
{
  const Vec3 d = direction(x);
  return std::atan2(N_.dot(d), m_.dot(d));
}

/// d theta / d d = (m.d N - N.d m)/r^2 with r^2 = (m.d)^2 + (N.d)^2
Mat3 EdgeTurn::gradient(const Eigen::VectorXd& x) const
{
  const Vec3 d = direction(x);
  const double out = m_.dot(d), up = N_.dot(d);
  return (out * N_ - up * m_) / (out * out + up * up) * c_.transpose();
}

/// [2 m.d N.d (m m' - N N') + ((N.d)^2 - (m.d)^2) (m N' + N m')]/r^4
Mat3 EdgeTurn::curvature(const Eigen::VectorXd& x) const
{
  const Vec3 d = direction(x);
  const double out = m_.dot(d), up = N_.dot(d), r2 = out * out + up * up;
  const Mat3 mN = m_ * N_.transpose();
  return (2 * out * up * (m_ * m_.transpose() - N_ * N_.transpose()) + (up * up - out * out) * (mN + mN.transpose())) /
         (r2 * r2);
}

void EdgeTurn::renumber(int first_vertex)
{
  for (int& v : corner_)
    v += first_vertex;
}

}  // namespace luff::shell
