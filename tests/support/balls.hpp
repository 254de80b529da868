// SPDX-License-Identifier: BSD-3-Clause
// Closed bodies that move as given.
#pragma once

#include "immersed/cut_links.hpp"
#include "support/surfaces.hpp"

namespace luff::test {

/// A sphere of triangles that moves rigidly.
struct Ball {
  double radius = 0.3;
  int levels = 3;
  Vec3 centre = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  Vec3 spin = Vec3::Zero();

  /// Alone among the sheets.
  [[nodiscard]] immersed::SheetMotion motion() const
  {
    const TriangleMesh mesh = mapped(sphere(levels), [this](const Vec3& x) { return Vec3(centre + radius * x); });
    immersed::SheetMotion sheets;
    sheets.triangles = mesh.triangles;
    sheets.bodies = {{.vertices = mesh.n_vertices(), .triangles = mesh.n_triangles()}};
    for (const Vec3& x : mesh.vertices) {
      sheets.position.push_back(x);
      sheets.velocity.push_back(velocity + spin.cross(x - centre));
      sheets.acceleration.push_back(spin.cross(spin.cross(x - centre)));
    }
    return sheets;
  }
};

}  // namespace luff::test
