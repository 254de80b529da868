// SPDX-License-Identifier: BSD-3-Clause
// The quadratic through a triangle and its three neighbours.
#include "shell/patch_quadratic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

namespace luff::shell {

namespace {

using Mat36 = Eigen::Matrix<double, 3, 6>;
/// Up to three columns.
using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 3>;

constexpr double conic_replaced = 50;  // beyond it a fit is not used
/// Of the directions V that the missing apices leave open and D that the moments act on: below it the condition of no
/// moment does not settle V. Random meshes stay above 0.25.
constexpr double cosine_replaced = 0.1;

/// Coordinates in the frame of the triangle, origin at its first corner.
std::array<Vec2, 6> project_on_plane(const std::array<Vec3, 6>& Y)
{
  const Vec3 e1 = (Y[1] - Y[0]).normalized();
  const Vec3 N = (Y[1] - Y[0]).cross(Y[2] - Y[0]).normalized();
  const Vec3 e2 = N.cross(e1);
  std::array<Vec2, 6> xi;
  for (int i = 0; i < 6; ++i)
    xi[i] = {e1.dot(Y[i] - Y[0]), e2.dot(Y[i] - Y[0])};
  return xi;
}

PatchQuadratic geometry(const std::array<Vec2, 6>& xi)
{
  PatchQuadratic p;
  const Vec2 u = xi[1] - xi[0], v = xi[2] - xi[0];
  const double twice_area = u.x() * v.y() - u.y() * v.x();
  for (int k = 0; k < 3; ++k) {
    const Vec2 side = xi[(k + 2) % 3] - xi[(k + 1) % 3];
    p.g[k] = Vec2(-side.y(), side.x()) / twice_area;
    p.height[k] = 1 / p.g[k].norm();
    p.m[k] = -p.height[k] * p.g[k];
  }
  return p;
}

/// L(j, i) = area coordinate i of apex j.
Mat3 area_coordinates_of_apices(const PatchQuadratic& p, const std::array<Vec2, 6>& xi)
{
  Mat3 L;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      L(j, i) = (i == 0 ? 1.0 : 0.0) + p.g[i].dot(xi[3 + j] - xi[0]);
  return L;
}

/// Second derivatives of the three bubbles L_a L_b in Voigt order, (2 a1 b1, 2 a2 b2, 2 (a1 b2 + a2 b1)).
Mat3 bubble_curvatures(const std::array<Vec2, 3>& g)
{
  Mat3 S;
  for (int k = 0; k < 3; ++k) {
    const Vec2 &a = g[(k + 1) % 3], &b = g[(k + 2) % 3];
    S.col(k) << 2 * a.x() * b.x(), 2 * a.y() * b.y(), 2 * (a.x() * b.y() + a.y() * b.x());
  }
  return S;
}

/// Curvatures of hinge angles from the two heights over each edge.
Mat36 hinge_curvatures(const std::array<Vec3, 6>& Y, const PatchQuadratic& p)
{
  Mat36 H = Mat36::Zero();
  for (int k = 0; k < 3; ++k) {
    const int a = (k + 1) % 3, b = (k + 2) % 3;
    const Vec3 along = Y[b] - Y[a];
    const double s = along.dot(Y[k] - Y[a]) / along.squaredNorm();
    const double s_apex = along.dot(Y[3 + k] - Y[a]) / along.squaredNorm();
    const double h = p.height[k], h_apex = (Y[3 + k] - Y[a] - s_apex * along).norm();
    const Vec3 weight = 2 / (h + h_apex) * dyad(p.m[k]);
    H.col(3 + k) += weight / h_apex;
    H.col(k) += weight / h;
    H.col(a) -= weight * ((1 - s_apex) / h_apex + (1 - s) / h);
    H.col(b) -= weight * (s_apex / h_apex + s / h);
  }
  return H;
}

/// Volume of the parallelepiped of one set of columns seen from the other's, in the metric of C; 1: same space.
double cosine(const Columns& D, const Columns& V, const Mat3& C)
{
  const auto gram = [&](const Columns& a, const Columns& b) { return (a.transpose() * C * b).eval().determinant(); };
  return std::abs(gram(D, V)) / std::sqrt(gram(D, D) * gram(V, V));
}

/// No moment across free edges: m_k·M·m_k = D_k·C H y = 0 with D_k = m_k (x) m_k. Where a missing apex goes is free,
/// which changes the curvature along its column V_k of H:
///
///   H <- (I - V (D' C V)^-1 D' C) H.
///
/// The twist, M·(m (x) t), stays what the vertices make it: a plate's corners are full of it. False, with nothing
/// changed, where V does not meet D.
bool apply_natural_condition(const PatchQuadratic& p, const std::array<bool, 3>& missing, const Mat3& C, Mat36& H)
{
  const auto n = std::count(missing.begin(), missing.end(), true);
  if (n == 0)
    return true;
  Columns V(3, n), D(3, n);
  for (int k = 0, column = 0; k < 3; ++k)
    if (missing[k]) {
      V.col(column) = H.col(3 + k);
      D.col(column++) = dyad(p.m[k]);
    }
  if (!(cosine(D, V, C) > cosine_replaced))
    return false;
  H -= (V * (D.transpose() * C * V).inverse() * (D.transpose() * C * H)).eval();
  for (int k = 0; k < 3; ++k)
    if (missing[k])
      H.col(3 + k).setZero();
  return true;
}

PatchQuadratic hinge_angles(PatchQuadratic p, const std::array<Vec3, 6>& Y, const std::array<bool, 3>& missing,
                            const Mat3& moduli)
{
  Mat36 H = hinge_curvatures(Y, p);
  apply_natural_condition(p, missing, moduli, H);
  p.bubble = bubble_curvatures(p.g).inverse() * H;
  return p;
}

}  // namespace

Mat36 PatchQuadratic::second_derivatives() const
{
  return bubble_curvatures(g) * bubble;
}

Vec3 dyad(const Vec2& m)
{
  return {m.x() * m.x(), m.y() * m.y(), 2 * m.x() * m.y()};
}

int folded_edge(const std::array<Vec3, 6>& Y)
{
  const std::array<Vec2, 6> xi = project_on_plane(Y);
  const Mat3 L = area_coordinates_of_apices(geometry(xi), xi);
  for (int k = 0; k < 3; ++k)
    if (!(L(k, k) < 0))
      return k;
  return -1;
}

/// c = M^-1 [-L(apices) | I] y with M_jk = bubble k at apex j.
PatchQuadratic patch_quadratic(const std::array<Vec3, 6>& Y, const std::array<bool, 3>& missing, const Mat3& moduli)
{
  const std::array<Vec2, 6> xi = project_on_plane(Y);
  PatchQuadratic p = geometry(xi);
  const Mat3 L = area_coordinates_of_apices(p, xi);
  Mat3 M;
  for (int j = 0; j < 3; ++j)
    M.row(j) << L(j, 1) * L(j, 2), L(j, 2) * L(j, 0), L(j, 0) * L(j, 1);
  p.conic = 1 / std::max(Eigen::JacobiSVD<Mat3>(M).singularValues()(2), std::numeric_limits<double>::epsilon());
  if (p.conic <= conic_replaced) {
    Mat36 right;
    right << -L, Mat3::Identity();
    Mat36 H = bubble_curvatures(p.g) * (M.inverse() * right);
    if (apply_natural_condition(p, missing, moduli, H)) {
      p.bubble = bubble_curvatures(p.g).inverse() * H;
      return p;
    }
  }
  p.replaced = true;
  return hinge_angles(std::move(p), Y, missing, moduli);
}

PatchQuadratic hinge_angles(const std::array<Vec3, 6>& Y, const std::array<bool, 3>& missing, const Mat3& moduli)
{
  return hinge_angles(geometry(project_on_plane(Y)), Y, missing, moduli);
}

}  // namespace luff::shell
