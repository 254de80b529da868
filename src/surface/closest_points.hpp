// SPDX-License-Identifier: BSD-3-Clause
// Distance between the smallest pieces of two surfaces: a point and a triangle, an edge and an edge.
#pragma once

#include <array>

#include "core/vec3.hpp"

namespace luff::surface {

/// Four vertices: a point and a triangle's corners, or the ends of one edge and those of another.
using Corners = std::array<Vec3, 4>;

/// Where two pieces are closest. The vector between the closest points is sum_k weight[k] x_k = distance * normal;
/// weight also is the gradient of the distance along the normal, d distance / d x_k = weight[k] normal.
struct Closest {
  std::array<double, 4> weight;  ///< of the corners, their sum is zero
  Vec3 normal;                   ///< unit vector from the second piece to the first; zero when they touch
  double distance = 0;           ///< [L]
};

/// Corner 0 and the triangle of corners 1, 2, 3. Triangles without area count as their edges.
Closest point_triangle(const Corners& x);

/// The edge from corner 0 to 1 and the edge from corner 2 to 3; parallel edges and edges without length are welcome.
Closest edge_edge(const Corners& x);

}  // namespace luff::surface
