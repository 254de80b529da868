// SPDX-License-Identifier: BSD-3-Clause
// Motion that is prescribed: where points go, how fast, and how directions turn.
#include "shell/motion.hpp"

#include <Eigen/Geometry>

namespace luff::shell {

Mat3 Motion::turn(double t, double factor) const
{
  if (!rotation)
    return Mat3::Identity();
  return Eigen::AngleAxisd(factor * rotation->angle(t), rotation->axis.normalized()).toRotationMatrix();
}

Vec3 Motion::position(const Vec3& X, double t, double factor) const
{
  Vec3 x = X;
  if (rotation)
    x = turn(t, factor) * (X - rotation->about) + rotation->about;
  if (translation)
    x += factor * translation(X, t);
  return x;
}

Rates Motion::rates(const Vec3& X, double t, double dt) const
{
  const double e = 0.1 * dt;
  const auto x = [&](int n) { return position(X, t + n * e); };
  const Vec3 here = x(0), before = x(-1), after = x(1), long_before = x(-2), long_after = x(2);
  return {(8 * (after - before) - (long_after - long_before)) / (12 * e),
          (16 * (after - 2 * here + before) - (long_after - 2 * here + long_before)) / (12 * e * e)};
}

}  // namespace luff::shell
