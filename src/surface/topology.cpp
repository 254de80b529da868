// SPDX-License-Identifier: BSD-3-Clause
// Which triangles share which edges.
#include "surface/topology.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace luff::surface {

EdgeKey edge_key(int a, int b)
{
  return {std::min(a, b), std::max(a, b)};
}

std::pair<int, int> edge_vertices(const std::array<int, 3>& triangle, int edge)
{
  return {triangle[(edge + 1) % 3], triangle[(edge + 2) % 3]};
}

std::map<EdgeKey, std::vector<TriangleEdge>> edge_map(const TriangleMesh& mesh)
{
  std::map<EdgeKey, std::vector<TriangleEdge>> edges;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = edge_vertices(mesh.triangles[t], k);
      edges[edge_key(a, b)].push_back({t, k});
    }
  return edges;
}

Topology topology(const TriangleMesh& mesh)
{
  Topology result;
  result.neighbour.assign(mesh.triangles.size(), {-1, -1, -1});
  result.neighbour_edge.assign(mesh.triangles.size(), {-1, -1, -1});
  for (const auto& [key, sides] : edge_map(mesh)) {
    ensure(sides.size() <= 2, "the mesh was validated, so no edge has more than two triangles");
    if (sides.size() == 1) {
      result.boundary.push_back(sides[0]);
      continue;
    }
    for (int s = 0; s < 2; ++s) {
      const auto [triangle, edge] = sides[s];
      result.neighbour[triangle][edge] = sides[1 - s].triangle;
      result.neighbour_edge[triangle][edge] = sides[1 - s].edge;
    }
  }
  return result;
}

}  // namespace luff::surface
