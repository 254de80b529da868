// SPDX-License-Identifier: BSD-3-Clause
// Boundary edges between chosen vertices, and what of a total each vertex of them takes.
#include "shell/edges.hpp"

namespace luff::shell {

std::vector<surface::TriangleEdge> boundary_edges(const surface::TriangleMesh& mesh, const surface::Topology& topology,
                                                  std::span<const int> vertices)
{
  std::vector<char> selected(mesh.vertices.size(), 0);
  for (const int v : vertices)
    selected[v] = 1;
  std::vector<surface::TriangleEdge> edges;
  for (const surface::TriangleEdge side : topology.boundary) {
    const auto [a, b] = surface::edge_vertices(mesh.triangles[side.triangle], side.edge);
    if (selected[a] && selected[b])
      edges.push_back(side);
  }
  return edges;
}

std::vector<double> shares(const surface::TriangleMesh& mesh, const surface::Topology& topology,
                           std::span<const int> vertices)
{
  std::vector<double> length(mesh.vertices.size(), 0);
  double total = 0;
  for (const surface::TriangleEdge side : boundary_edges(mesh, topology, vertices)) {
    const auto [a, b] = surface::edge_vertices(mesh.triangles[side.triangle], side.edge);
    const double l = (mesh.vertices[b] - mesh.vertices[a]).norm();
    length[a] += l / 2;
    length[b] += l / 2;
    total += l;
  }
  std::vector<double> result;
  for (const int v : vertices)
    result.push_back(total > 0 ? length[v] / total : 1.0 / static_cast<double>(vertices.size()));
  return result;
}

}  // namespace luff::shell
