// SPDX-License-Identifier: BSD-3-Clause
// Surfaces made from a few numbers.
#pragma once

#include <array>

#include "surface/mesh.hpp"

namespace luff::surface {

/// How the quadrilaterals of a structured sheet are cut in two.
enum class Pattern {
  Diagonal,     ///< all along the same diagonal
  Alternating,  ///< neighbours along opposite diagonals ("union jack")
  Irregular     ///< inner vertices moved at random, diagonals at random, then flipped to a Delaunay mesh
};

/// Parallelogram origin + s a + t b, 0 <= s, t <= 1; its normal is along a x b.
struct Rectangle {
  Vec3 origin = Vec3::Zero();  ///< [L]
  Vec3 a = Vec3::UnitX();      ///< first side [L]
  Vec3 b = Vec3::UnitY();      ///< second side [L]
  std::array<int, 2> divisions{1, 1};
  Pattern pattern = Pattern::Diagonal;
  double displacement = 0.28;  ///< Irregular: largest move of an inner vertex, in spacings, 0 <= d < 0.45
  unsigned seed = 1;           ///< Irregular: same seed, same mesh
};

/// Vertex (i, j) of the sheet has number i (divisions[1] + 1) + j.
/// \throws InputError for divisions below 1, sides that are zero, not finite or parallel, a displacement out of range.
TriangleMesh rectangle(const Rectangle& shape);

/// Turn by `degrees` about the line through `about` along `axis` (right-hand rule).
void rotate(TriangleMesh& mesh, const Vec3& axis, double degrees, const Vec3& about = Vec3::Zero());
void translate(TriangleMesh& mesh, const Vec3& shift);
/// Stretch about the origin by a factor per axis, all positive.
void scale(TriangleMesh& mesh, const Vec3& factors);

}  // namespace luff::surface
