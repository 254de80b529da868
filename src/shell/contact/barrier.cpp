// SPDX-License-Identifier: BSD-3-Clause
// Energy of a pair of surface pieces that come close.
#include "shell/contact/barrier.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cstdlib>

namespace luff::shell {

namespace {

/// m(y) and the derivatives of |a x b|^2 that its gradient needs.
struct Mollifier {
  double value = 1;
  double slope = 0;  ///< d m / d |a x b|^2
};

double parallelogram_squared(const Corners& x)
{
  return (x[1] - x[0]).cross(x[3] - x[2]).squaredNorm();
}

Mollifier mollifier(const ContactPair& pair, const Corners& x)
{
  if (pair.kind == PairKind::PointTriangle)
    return {};
  const double y = parallelogram_squared(x) / pair.parallel;
  return y < 1 ? Mollifier{y * (2 - y), (2 - 2 * y) / pair.parallel} : Mollifier{};
}

}  // namespace

/// B' = -2 (x - 1) ln x - (x - 1)^2 / x,   B'' = -2 ln x - 4 (x - 1)/x + (x - 1)^2 / x^2
BarrierValue barrier(double distance, double reach, double stiffness)
{
  const double x = distance / reach;
  if (x >= 1)
    return {0, 0, 0};
  if (!(x > 0)) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {infinity, -infinity, infinity};
  }
  const double y = x - 1, log_x = std::log(x);
  return {-stiffness * reach * y * y * log_x, -stiffness * (2 * y * log_x + y * y / x),
          stiffness / reach * (-2 * log_x - 4 * y / x + y * y / (x * x))};
}

Closest closest(PairKind kind, const Corners& x)
{
  return kind == PairKind::PointTriangle ? point_triangle(x) : edge_edge(x);
}

double pair_energy(const ContactPair& pair, const Corners& x, double stiffness)
{
  const double distance = closest(pair.kind, x).distance;
  if (distance >= pair.reach)
    return 0;
  if (distance == 0)
    return std::numeric_limits<double>::infinity();
  return pair.area * mollifier(pair, x).value * barrier(distance, pair.reach, stiffness).energy;
}

/// m b' grad d + b m' grad |a x b|^2; the first by the envelope theorem: weights that minimise the distance don't
/// contribute to its derivative. With c = |a x b|^2: dc/da = 2 (a b^2 - b (a.b)).
PairGradient pair_gradient(const ContactPair& pair, const Corners& x, double stiffness)
{
  PairGradient gradient = PairGradient::Zero();
  const Closest near = closest(pair.kind, x);
  if (near.distance >= pair.reach)
    return gradient;
  const BarrierValue b = barrier(near.distance, pair.reach, stiffness);
  const Mollifier m = mollifier(pair, x);
  for (int k = 0; k < 4; ++k)
    gradient.segment<3>(3 * k) = pair.area * m.value * b.slope * near.weight[k] * near.normal;
  if (m.slope > 0) {
    const Vec3 e = x[1] - x[0], f = x[3] - x[2];
    const double factor = 2 * pair.area * b.energy * m.slope;
    const Vec3 by_e = factor * (f.squaredNorm() * e - e.dot(f) * f);
    const Vec3 by_f = factor * (e.squaredNorm() * f - e.dot(f) * e);
    gradient.segment<3>(0) -= by_e;
    gradient.segment<3>(3) += by_e;
    gradient.segment<3>(6) -= by_f;
    gradient.segment<3>(9) += by_f;
  }
  return gradient;
}

namespace {

/// Ways in which the closest points slide on their pieces: differences of the weights of corners `to` and `from`.
struct Slides {
  int n = 0;
  std::array<int, 2> from{}, to{};

  void add(int a, int b)
  {
    from[n] = a;
    to[n++] = b;
  }
};

Slides slides(PairKind kind, const Closest& near)
{
  Slides s;
  const auto add_between = [&](int a, int b) {
    if (near.weight[a] != 0 && near.weight[b] != 0)
      s.add(a, b);
  };
  if (kind == PairKind::EdgeEdge) {
    add_between(0, 1);
    add_between(2, 3);
    return s;
  }
  add_between(1, 2);
  if (s.n == 1)
    add_between(2, 3);
  else
    near.weight[1] != 0 ? add_between(1, 3) : add_between(2, 3);
  return s;
}

/// Hessian of D = d^2/2 where the closest points slide freely: D_xx - D_xs (D_ss)^-1 D_sx with r = sum_k c_k x_k,
/// D_x_k = c_k r, D_s = r . dr/ds = 0.
PairHessian half_square_hessian(PairKind kind, const Closest& near, const Corners& x)
{
  PairHessian H;
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < 4; ++l)
      H.block<3, 3>(3 * k, 3 * l) = near.weight[k] * near.weight[l] * Mat3::Identity();
  const Slides s = slides(kind, near);
  const Vec3 r = near.distance * near.normal;
  Eigen::Matrix<double, 12, 2> mixed = Eigen::Matrix<double, 12, 2>::Zero();
  Eigen::Matrix<double, 3, 2> tangent = Eigen::Matrix<double, 3, 2>::Zero();
  for (int i = 0; i < s.n; ++i) {
    tangent.col(i) = x[s.to[i]] - x[s.from[i]];
    for (int k = 0; k < 4; ++k)
      mixed.block<3, 1>(3 * k, i) = near.weight[k] * tangent.col(i);
    mixed.block<3, 1>(3 * s.to[i], i) += r;
    mixed.block<3, 1>(3 * s.from[i], i) -= r;
  }
  if (s.n == 1)
    H -= mixed.col(0) * mixed.col(0).transpose() / tangent.col(0).squaredNorm();
  if (s.n == 2)
    H -= mixed * (tangent.transpose() * tangent).inverse() * mixed.transpose();
  return H;
}

/// Hessian of c = |e x f|^2 in the corners, e = x1 - x0, f = x3 - x2.
PairHessian parallelogram_hessian(const Vec3& e, const Vec3& f)
{
  const Mat3 I = Mat3::Identity();
  const Mat3 ee = 2 * (f.squaredNorm() * I - f * f.transpose()), ff = 2 * (e.squaredNorm() * I - e * e.transpose());
  const Mat3 ef = 4 * e * f.transpose() - 2 * f * e.transpose() - 2 * e.dot(f) * I;
  PairHessian H;
  H << ee, -ee, ef, -ef, -ee, ee, -ef, ef, ef.transpose(), -ef.transpose(), ff, -ff, -ef.transpose(), ef.transpose(),
      -ff, ff;
  return H;
}

}  // namespace

PairHessian pair_hessian(const ContactPair& pair, const Corners& x, double stiffness)
{
  const Closest near = closest(pair.kind, x);
  if (near.distance >= pair.reach)
    return PairHessian::Zero();
  const BarrierValue b = barrier(near.distance, pair.reach, stiffness);
  const Mollifier m = mollifier(pair, x);
  PairGradient g;
  for (int k = 0; k < 4; ++k)
    g.segment<3>(3 * k) = near.weight[k] * near.normal;
  static const int mode = getenv("CMODE") ? atoi(getenv("CMODE")) : 0;
  if (mode == 0 || (mode == 1 && m.slope == 0))
    return pair.area * m.value * b.curvature * g * g.transpose();
  PairHessian H = m.value * (b.curvature - b.slope / near.distance) * g * g.transpose() +
                  m.value * b.slope / near.distance * half_square_hessian(pair.kind, near, x);
  if (m.slope > 0) {
    const Vec3 e = x[1] - x[0], f = x[3] - x[2];
    const Vec3 by_e = 2 * (f.squaredNorm() * e - e.dot(f) * f);
    const Vec3 by_f = 2 * (e.squaredNorm() * f - e.dot(f) * e);
    PairGradient q;
    q << -by_e, by_e, -by_f, by_f;
    H += m.slope * b.slope * (g * q.transpose() + q * g.transpose()) -
         2 / (pair.parallel * pair.parallel) * b.energy * q * q.transpose() +
         b.energy * m.slope * parallelogram_hessian(e, f);
  }
  const Eigen::SelfAdjointEigenSolver<PairHessian> eigen(pair.area * H);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace luff::shell
