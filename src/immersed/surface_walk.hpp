// SPDX-License-Identifier: BSD-3-Clause
// The point of a surface closest to a place near it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "immersed/cut_links.hpp"

namespace luff::immersed {

/// Walks over a triangulated surface towards the point closest to a place: from a triangle known to be near to
/// whichever of the triangles around its vertices comes nearer, until none does.  What lies on another sheet, or behind
/// a fold that the way there leads away from, is not found; nor is it wanted by a node that sees one side of one sheet.
class SurfaceWalk {
 public:
  /// The surface must outlive the walk.
  SurfaceWalk(std::span<const Vec3> positions, std::span<const std::array<int, 3>> triangles);

  [[nodiscard]] SurfacePoint closest(const Vec3& x, int near_triangle) const;
  /// The triangles that a point of the surface lies on: its own, those at its edge, or those around its vertex.
  [[nodiscard]] std::vector<int> triangles_at(const SurfacePoint& point) const;

 private:
  struct Reached {
    SurfacePoint point;
    double distance = 0.0;
  };
  [[nodiscard]] Reached on_triangle(const Vec3& x, int triangle) const;

  std::span<const Vec3> positions_;
  std::span<const std::array<int, 3>> triangles_;
  std::vector<int> first_;   ///< of each vertex, in around_
  std::vector<int> around_;  ///< triangles, vertex by vertex
};

}  // namespace luff::immersed
