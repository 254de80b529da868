// SPDX-License-Identifier: BSD-3-Clause
// Energy of a pair of surface pieces that come close.
#include "shell/contact/barrier.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

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

/// s s' with s = sqrt(area m b'') grad d, symmetric to the last bit
PairHessian pair_hessian(const ContactPair& pair, const Corners& x, double stiffness)
{
  const Closest near = closest(pair.kind, x);
  if (near.distance >= pair.reach)
    return PairHessian::Zero();
  const double curvature = barrier(near.distance, pair.reach, stiffness).curvature;
  const double root = std::sqrt(pair.area * mollifier(pair, x).value * curvature);
  PairGradient s;
  for (int k = 0; k < 4; ++k)
    s.segment<3>(3 * k) = root * near.weight[k] * near.normal;
  return s * s.transpose();
}

}  // namespace luff::shell
