// SPDX-License-Identifier: BSD-3-Clause
// Motion that is prescribed: where points go, how fast, and how directions turn.
#pragma once

#include <functional>
#include <optional>

#include "core/vec3.hpp"

namespace luff::shell {

/// Velocity and acceleration of a point.
struct Rates {
  Vec3 velocity;
  Vec3 acceleration;
};

/// x = R(t) (X - about) + about + translation(X, t): a rotation about a fixed axis, then a displacement, which may
/// differ from point to point but turns nothing. A factor other than 1 takes that part of the angle and of the
/// displacement.
struct Motion {
  struct Rotation {
    Vec3 axis = Vec3::UnitZ();  ///< of any length but zero
    Vec3 about = Vec3::Zero();
    std::function<double(double t)> angle;  ///< right-handed about the axis [rad]
  };

  std::function<Vec3(const Vec3& X, double t)> translation{};  ///< none: zero
  std::optional<Rotation> rotation{};

  Vec3 position(const Vec3& X, double t, double factor = 1) const;
  /// R(t)
  Mat3 turn(double t, double factor = 1) const;
  /// By central differences of fourth order over two tenths of dt on each side: whatever steps of dt resolve, these
  /// do, with a round-off near 1e-13 of the velocity.
  Rates rates(const Vec3& X, double t, double dt) const;
};

}  // namespace luff::shell
