// SPDX-License-Identifier: BSD-3-Clause
// Which triangles share which edges.
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "surface/mesh.hpp"

namespace luff::surface {

/// One side of one triangle. Edge k is opposite to corner k and runs from corner k+1 to corner k+2.
struct TriangleEdge {
  int triangle;
  int edge;
};

/// The two vertices of an edge, the smaller number first.
using EdgeKey = std::pair<int, int>;

EdgeKey edge_key(int a, int b);

/// Start and end of edge k of a triangle, in the triangle's sense of rotation.
std::pair<int, int> edge_vertices(const std::array<int, 3>& triangle, int edge);

/// Every edge with the triangles on it, in the order of the triangles.
std::map<EdgeKey, std::vector<TriangleEdge>> edge_map(const TriangleMesh& mesh);

/// Neighbours of the triangles of a valid mesh (see validation.hpp).
struct Topology {
  /// Triangle across edge k, or -1 at the boundary.
  std::vector<std::array<int, 3>> neighbour;
  /// Number of the shared edge within that neighbour, or -1.
  std::vector<std::array<int, 3>> neighbour_edge;
  /// Edges with one triangle only, ordered by vertex numbers.
  std::vector<TriangleEdge> boundary;
};

Topology topology(const TriangleMesh& mesh);

}  // namespace luff::surface
