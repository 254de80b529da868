// SPDX-License-Identifier: BSD-3-Clause
// How a made surface is cut into triangles.
#pragma once

#include <functional>
#include <string_view>

#include "surface/layout.hpp"
#include "surface/marked_mesh.hpp"

namespace luff::surface {

enum class Pattern {
  Diagonal,     ///< all quadrilaterals along the same diagonal; the regular mesh of disks and polar caps
  Alternating,  ///< neighbours along opposite diagonals ("union jack"); not for disks and polar caps
  Irregular,    ///< inner vertices moved at random, diagonals at random, then flipped to a Delaunay mesh
  Delaunay      ///< inner vertices anywhere, relaxed to near-equal cells, joined by Delaunay's rule
};

struct Cut {
  Pattern pattern;
  double displacement;  ///< Irregular: largest move of an inner vertex, in spacings, 0 <= d < 0.45
  unsigned seed;        ///< Irregular, Delaunay: same seed, same mesh
};

/// \throws InputError that starts with `shape` for growths that are not positive, or with evenly spread vertices.
void check_grading(std::string_view shape, const std::array<double, 2>& grading, Pattern pattern);

/// A smooth surface x(u, v); u and v count the spacings of a Layout.
struct ParametricSurface {
  std::function<Vec3(double u, double v)> point;
  std::function<Vec3(const Vec3& x)> nearest;  ///< point of the surface nearest to x
  std::function<Vec3(const Vec3& x)> normal;   ///< there; its length is of no account
};

ParametricSurface plane(std::function<Vec3(double u, double v)> point, const Vec3& origin, const Vec3& normal);

/// What a shape calls the sides of its layout: {"u_min", "a_min"}.
using SideNames = std::map<std::string, std::string>;

/// Triangles with normals along the surface's, vertices on it in the order of the layout's nodes; nodes that are not
/// inner ones stay where the layout has them. Named sides become sets of edges (of a vertex where they are a pole), and
/// all edges of the boundary the set `boundary`. \throws InputError that starts with `shape` for a displacement out of
/// range or a pattern that the layout does not allow.
MarkedMesh triangulate(const Layout& layout, const ParametricSurface& surface, const Cut& cut, std::string_view shape,
                       const SideNames& side_names);

}  // namespace luff::surface
