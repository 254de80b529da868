// SPDX-License-Identifier: BSD-3-Clause
// Energy of a pair of surface pieces that come close.
#include "shell/contact/barrier.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace luff::shell {

namespace {

/// m(y) and its derivatives with respect to |a x b|^2.
struct Mollifier {
  double value = 1;
  double slope = 0;
  double curvature = 0;
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
  return y < 1 ? Mollifier{y * (2 - y), (2 - 2 * y) / pair.parallel, -2 / (pair.parallel * pair.parallel)}
               : Mollifier{};
}

/// With c = |a x b|^2: dc/da = 2 (a b^2 - b (a.b)).
PairGradient parallelogram_gradient(const Corners& x)
{
  const Vec3 a = x[1] - x[0], b = x[3] - x[2];
  const Vec3 by_a = 2 * (b.squaredNorm() * a - a.dot(b) * b);
  const Vec3 by_b = 2 * (a.squaredNorm() * b - a.dot(b) * a);
  PairGradient gradient;
  gradient << -by_a, by_a, -by_b, by_b;
  return gradient;
}

/// d2c/da2 = 2 (b^2 I - b b'),   d2c/da db = 2 (2 a b' - b a' - (a.b) I)
PairHessian parallelogram_hessian(const Corners& x)
{
  const Vec3 a = x[1] - x[0], b = x[3] - x[2];
  const Mat3 I = Mat3::Identity();
  const Mat3 aa = 2 * (b.squaredNorm() * I - b * b.transpose()), bb = 2 * (a.squaredNorm() * I - a * a.transpose());
  const Mat3 ab = 2 * (2 * a * b.transpose() - b * a.transpose() - a.dot(b) * I);
  PairHessian H;
  H << aa, -aa, ab, -ab, -aa, aa, -ab, ab, ab.transpose(), -ab.transpose(), bb, -bb, -ab.transpose(), ab.transpose(),
      -bb, bb;
  return H;
}

PairGradient distance_gradient(const Closest& near)
{
  PairGradient gradient;
  for (int k = 0; k < 4; ++k)
    gradient.segment<3>(3 * k) = near.weight[k] * near.normal;
  return gradient;
}

/// How the weights change as the closest points slide, one column per direction in which they may: along the first
/// edge and the second; from one corner of the triangle to others. A weight of zero is at a bound and stays.
Eigen::Matrix<double, 4, Eigen::Dynamic> slides(PairKind kind, const Closest& near)
{
  Eigen::Matrix<double, 4, Eigen::Dynamic> directions(4, 0);
  const auto add = [&](int from, int to) {
    directions.conservativeResize(4, directions.cols() + 1);
    directions.rightCols<1>().setZero();
    directions(from, directions.cols() - 1) = -1;
    directions(to, directions.cols() - 1) = 1;
  };
  const auto& w = near.weight;
  if (kind == PairKind::EdgeEdge) {
    if (w[0] != 0 && w[1] != 0)
      add(0, 1);
    if (w[2] != 0 && w[3] != 0)
      add(2, 3);
    return directions;
  }
  const int first = w[1] != 0 ? 1 : w[2] != 0 ? 2 : 3;
  for (int k = first + 1; k < 4; ++k)
    if (w[k] != 0)
      add(first, k);
  return directions;
}

/// Of half the square of the distance, min over s of |v|^2/2, v = sum_k w_k(s) x_k, W = dw/ds and V = dv/ds:
///
///   d2/dx_k dx_l = w_k w_l I - C_k (V'V)^-1 C_l',       C_k = d2/dx_k ds = w_k V + v W_k.
///
/// From it that of the distance, (this - grad d grad d')/d.
PairHessian distance_hessian(PairKind kind, const Corners& x, const Closest& near)
{
  const auto W = slides(kind, near);
  Eigen::Matrix<double, 3, 4> X;
  X << x[0], x[1], x[2], x[3];
  const Eigen::Matrix<double, 3, Eigen::Dynamic> V = X * W;
  const Vec3 v = near.distance * near.normal;
  Eigen::Matrix<double, 12, Eigen::Dynamic> C(12, W.cols());
  PairHessian H;
  for (int k = 0; k < 4; ++k) {
    C.middleRows<3>(3 * k) = near.weight[k] * V + v * W.row(k);
    for (int l = 0; l < 4; ++l)
      H.block<3, 3>(3 * k, 3 * l) = near.weight[k] * near.weight[l] * Mat3::Identity();
  }
  if (W.cols() > 0)
    H -= C * (V.transpose() * V).inverse() * C.transpose();
  const PairGradient d = distance_gradient(near);
  return (H - d * d.transpose()) / near.distance;
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

/// m b' grad d + b m' grad c, c = |a x b|^2; the first by the envelope theorem: weights that minimise the distance
/// don't contribute to its derivative.
PairGradient pair_gradient(const ContactPair& pair, const Corners& x, double stiffness)
{
  const Closest near = closest(pair.kind, x);
  if (near.distance >= pair.reach)
    return PairGradient::Zero();
  const BarrierValue b = barrier(near.distance, pair.reach, stiffness);
  const Mollifier m = mollifier(pair, x);
  PairGradient gradient = pair.area * m.value * b.slope * distance_gradient(near);
  if (m.slope > 0)
    gradient += pair.area * b.energy * m.slope * parallelogram_gradient(x);
  return gradient;
}

/// s s' with s = sqrt(area m b'') grad d, symmetric to the last bit
PairHessian pair_hessian(const ContactPair& pair, const Corners& x, double stiffness)
{
  const Closest near = closest(pair.kind, x);
  if (near.distance >= pair.reach)
    return PairHessian::Zero();
  const double curvature = barrier(near.distance, pair.reach, stiffness).curvature;
  const PairGradient s = std::sqrt(pair.area * mollifier(pair, x).value * curvature) * distance_gradient(near);
  return s * s.transpose();
}

/// m (b'' grad d grad d' + b' H_d) + m' b' (grad c grad d' + grad d grad c') + b (m'' grad c grad c' + m' H_c)
PairHessian exact_pair_hessian(const ContactPair& pair, const Corners& x, double stiffness)
{
  const Closest near = closest(pair.kind, x);
  const Mollifier m = mollifier(pair, x);
  PairHessian H = PairHessian::Zero();
  if (near.distance >= pair.reach)
    return H;
  const BarrierValue b = barrier(near.distance, pair.reach, stiffness);
  const PairGradient d = distance_gradient(near);
  if (m.value > 0)
    H = m.value * (b.curvature * d * d.transpose() + b.slope * distance_hessian(pair.kind, x, near));
  if (m.slope > 0) {
    const PairGradient c = parallelogram_gradient(x);
    H += m.slope * b.slope * (c * d.transpose() + d * c.transpose());
    H += b.energy * (m.curvature * c * c.transpose() + m.slope * parallelogram_hessian(x));
  }
  return pair.area * H;
}

}  // namespace luff::shell
