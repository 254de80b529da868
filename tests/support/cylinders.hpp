// SPDX-License-Identifier: BSD-3-Clause
// A circular cylinder of diameter 1 in a slab of fluid one cell wide.
#pragma once

#include <numbers>

#include "support/plates.hpp"

namespace luff::test {

struct SlabCylinder {
  Vec3 centre = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  Vec3 acceleration = Vec3::Zero();

  [[nodiscard]] static double volume(double depth) { return 0.25 * std::numbers::pi * depth; }
  /// Its edges lie on the sides of the slab.
  [[nodiscard]] immersed::SheetMotion motion(double depth) const
  {
    const surface::TriangleMesh mesh =
        surface::cylinder({.frame = {.centre = centre}, .radius = 0.5, .length = depth, .divisions = {96, 1}});
    const std::size_t n = mesh.vertices.size();
    return {.position = mesh.vertices,
            .velocity = std::vector<Vec3>(n, velocity),
            .acceleration = std::vector<Vec3>(n, acceleration),
            .triangles = mesh.triangles,
            .bodies = {{.vertices = mesh.n_vertices(), .triangles = mesh.n_triangles()}}};
  }
};

}  // namespace luff::test
