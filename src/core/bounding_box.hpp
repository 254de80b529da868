// SPDX-License-Identifier: BSD-3-Clause
// Axis-aligned boxes of space.
#pragma once

#include <span>

#include "core/error.hpp"
#include "core/vec3.hpp"

namespace luff {

/// Axis-aligned box.
struct BoundingBox {
  Vec3 low;
  Vec3 high;

  [[nodiscard]] Vec3 extent() const { return high - low; }
  /// Length of the diagonal [L]: the size that every relative tolerance refers to.
  [[nodiscard]] double size() const { return extent().norm(); }
  [[nodiscard]] bool touches(const BoundingBox& other) const
  {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  [[nodiscard]] bool holds(const Vec3& x) const { return touches({x, x}); }
};

/// Smallest box around at least one point.
[[nodiscard]] inline BoundingBox bounding_box(std::span<const Vec3> points)
{
  ensure(!points.empty(), "bounding box of no points");
  BoundingBox box{points.front(), points.front()};
  for (const Vec3& x : points) {
    box.low = box.low.cwiseMin(x);
    box.high = box.high.cwiseMax(x);
  }
  return box;
}

}  // namespace luff
