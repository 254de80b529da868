// SPDX-License-Identifier: BSD-3-Clause
// The velocity field of a rigid body.
#pragma once

#include <span>

#include "core/vec3.hpp"

namespace luff::immersed {

/// u(x) = velocity + spin x (x - centre)
struct RigidVelocity {
  Vec3 centre = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();  ///< of the centre [L/T]
  Vec3 spin = Vec3::Zero();      ///< [1/T]

  [[nodiscard]] Vec3 at(const Vec3& x) const { return velocity + spin.cross(x - centre); }
};

/// The rigid motion nearest to the velocities of some points, not all of them on a line: least squares about their
/// mean place,  sum r x v = [sum (r^2 - r r^T)] spin.  Of accelerations it gives the part that is one, without what
/// pulls towards the axis.
[[nodiscard]] RigidVelocity nearest_rigid_velocity(std::span<const Vec3> points, std::span<const Vec3> velocities);

}  // namespace luff::immersed
