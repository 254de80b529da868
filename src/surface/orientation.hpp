// SPDX-License-Identifier: BSD-3-Clause
// Do the triangles of a surface face the same way?
#pragma once

#include <vector>

#include "surface/mesh.hpp"

namespace luff::surface {

/// Pieces are made of triangles that are connected by edges of exactly two of them.
struct Orientation {
  std::vector<int> piece;    ///< number of the piece of each triangle
  std::vector<int> flipped;  ///< triangles that face against most of their piece (of an even half: not the first one's)
  int one_sided = -1;        ///< a triangle that can face neither way: the surface has one side only
};

Orientation orientation(const TriangleMesh& mesh);

}  // namespace luff::surface
