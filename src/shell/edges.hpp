// SPDX-License-Identifier: BSD-3-Clause
// Boundary edges between chosen vertices, and what of a total each vertex of them takes.
#pragma once

#include <span>
#include <vector>

#include "surface/mesh.hpp"
#include "surface/topology.hpp"

namespace luff::shell {

/// Boundary edges with both ends among the vertices, ordered by vertex numbers.
std::vector<surface::TriangleEdge> boundary_edges(const surface::TriangleMesh& mesh, const surface::Topology& topology,
                                                  std::span<const int> vertices);

/// Part of a total that each of the vertices takes: half of every boundary edge between two of them, or equal parts
/// where there is no such edge. Adds up to 1.
std::vector<double> shares(const surface::TriangleMesh& mesh, const surface::Topology& topology,
                           std::span<const int> vertices);

}  // namespace luff::shell
