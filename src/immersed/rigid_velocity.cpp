// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/rigid_velocity.hpp"

#include <Eigen/Dense>

namespace luff::immersed {

RigidVelocity nearest_rigid_velocity(std::span<const Vec3> points, std::span<const Vec3> velocities)
{
  RigidVelocity rigid;
  const double share = 1.0 / static_cast<double>(points.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    rigid.centre += share * points[n];
    rigid.velocity += share * velocities[n];
  }
  Mat3 inertia = Mat3::Zero();
  Vec3 moment = Vec3::Zero();
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Vec3 r = points[n] - rigid.centre;
    inertia += r.squaredNorm() * Mat3::Identity() - r * r.transpose();
    moment += r.cross(velocities[n] - rigid.velocity);
  }
  rigid.spin = inertia.ldlt().solve(moment);
  return rigid;
}

}  // namespace luff::immersed
