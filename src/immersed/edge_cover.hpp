// SPDX-License-Identifier: BSD-3-Clause
// How much of the faces that the end of a sheet reaches it covers.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "grid/grid.hpp"
#include "immersed/crossings.hpp"

namespace luff::immersed {

/// An edge of one triangle only.
struct FreeEdge {
  int from = 0;
  int to = 0;
  int triangle = 0;

  friend auto operator<=>(const FreeEdge&, const FreeEdge&) = default;
};

/// Sorted.
[[nodiscard]] std::vector<FreeEdge> free_edges(std::span<const std::array<int, 3>> triangles);

/// The part of a face that the end of a sheet covers.  Where the line of centres misses the sheet, `hit` is no crossing
/// but stands for what the sheet covers: the centroid of the largest piece of it.
struct EdgeCover {
  Crossing hit;
  bool on_line = true;  ///< `hit` is a crossing
  double part = 1.0;    ///< covered area over that of the face, projected along the link
};

/// The faces among owned().faces(axis) that the free edges of sheets leave open in part: those whose column along the
/// axis an edge runs through.  Every triangle is cut to the column; the pieces around the plane of a crossing, or of
/// the piece that the edge itself bounds, make up the covered area,
///
///   part = |sum of n_a dS|/A_f,
///
/// whole above 0.95, none below 0.001.  Ends of sheets that meet on a link add up.  Edges in a side of the domain are
/// none. Each face once, sorted by axis, then k, j, i.  Uniform and rectilinear grids.  Local to the rank; the same
/// face gives the same bits on every rank.
[[nodiscard]] std::vector<EdgeCover> edge_covers(const grid::Grid& grid, std::span<const Vec3> positions,
                                                 std::span<const std::array<int, 3>> triangles,
                                                 std::span<const FreeEdge> edges);

}  // namespace luff::immersed
