// SPDX-License-Identifier: BSD-3-Clause
// The space that a closed surface bounds.
#pragma once

#include "surface/mesh.hpp"

namespace luff::surface {

/// Volume and its moments, as of a body of density 1.
struct Solid {
  double volume = 0.0;           ///< [L^3]; negative when the normals point into it
  Vec3 centroid = Vec3::Zero();  ///< [L]
  Mat3 inertia = Mat3::Zero();   ///< about the centroid, int (r^2 - r r^T) dV [L^5]
};

/// A plane normal to a coordinate axis.
struct AxisPlane {
  int axis = 0;
  double at = 0.0;  ///< [L]
};

/// Of the space between a surface and nothing else, or between it and planes along the coordinate axes that its edges
/// lie on: any number normal to the other two axes, and `plane` itself.  By the divergence theorem along plane.axis,
///
///   int f dV = sum over triangles of int (int_plane^x f dx) n_x dA,
///
/// with polynomials of third degree at most, which the quadrature of the triangles integrates exactly.
[[nodiscard]] Solid solid(const TriangleMesh& mesh, const AxisPlane& plane);

/// Of a surface without edges.
[[nodiscard]] Solid solid(const TriangleMesh& mesh);

/// The same surface with its normals on the other side.
void reverse(TriangleMesh& mesh);

}  // namespace luff::surface
