// SPDX-License-Identifier: BSD-3-Clause
// Images of vertices in the mirrors at clamped and symmetry edges.
#pragma once

#include <vector>

#include "core/vec3.hpp"

namespace luff::shell {

/// Affine image y = T x + t of a vertex, made by mirrors at supported edges.
struct Image {
  Mat3 T;
  Vec3 t;
  /// Numbers of the mirrors it is composed of, the last one first, where one of them moves; empty where none does.
  std::vector<int> mirrors{};
};

using Images = std::vector<Image>;

/// Reflection in the plane through a point with this unit normal.
Image reflection(const Vec3& normal, const Vec3& on_plane);
/// The image of an image.
Image compose(const Image& outer, const Image& inner);

}  // namespace luff::shell
