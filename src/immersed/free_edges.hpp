// SPDX-License-Identifier: BSD-3-Clause
// How sheets fade out on the grid beyond their free edges.
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "grid/locate.hpp"
#include "immersed/crossings.hpp"

namespace luff::immersed {

/// An edge of one triangle only, in the order of that triangle's corners.
struct FreeEdge {
  int from = 0;
  int to = 0;
  int triangle = 0;
};

/// By triangle.
[[nodiscard]] std::vector<FreeEdge> free_edges(std::span<const std::array<int, 3>> triangles);

/// The part of its face that a link covers which a sheet would hit if it went on for `t` cells beyond its edge,
///
///   c = 1 - t,  between 0 and 1:
///
/// that of a row of faces under a sheet that ends half a cell later, without which the edge acts too short by as much
/// (docs/numerics/immersed.md).  Above 0.95 it is taken for 1, below 0.001 for 0.
[[nodiscard]] double cover_beyond_edge(double t);

/// Sheets at one instant, and the strips that continue them beyond their free edges.
class FadingSheets {
 public:
  /// Edges in a side of the domain are not free.  Collective.
  FadingSheets(const grid::Grid& grid, std::span<const Vec3> positions, std::span<const std::array<int, 3>> triangles,
               std::span<const FreeEdge> edges);

  /// The sheets and, after them, two triangles beyond each free edge, in the plane of its triangle.
  [[nodiscard]] const std::vector<Vec3>& positions() const { return positions_; }
  [[nodiscard]] const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }

  /// Turns hits of the strips among sorted hits of positions() and triangles() into hits of the edge's triangle, at the
  /// point of the edge nearest to them, and returns what all cover of their faces: hits of a sheet cover them whole.
  /// Those of strips that cover nothing are dropped, also where another surface is hit on the link.
  [[nodiscard]] std::vector<double> settle(std::vector<Crossing>& hits) const;

 private:
  void keep_free(std::span<const FreeEdge> edges);
  [[nodiscard]] Vec3 outwards(const FreeEdge& edge) const;
  void add_strips();
  [[nodiscard]] bool is_of_strip(const Crossing& hit) const { return hit.triangle >= sheet_triangles_; }
  [[nodiscard]] double cells_beyond(const FreeEdge& edge, double part, const Vec3& x) const;
  [[nodiscard]] double fade_out(Crossing& hit) const;

  const grid::Grid& grid_;
  int sheet_triangles_ = 0;
  std::vector<FreeEdge> edges_;
  std::map<int, grid::CellShape> cell_at_;  ///< around the vertices of edges_
  std::vector<Vec3> positions_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<int> edge_of_strip_;  ///< of triangles_ beyond the sheets'
};

}  // namespace luff::immersed
