// SPDX-License-Identifier: BSD-3-Clause
// Cells inside closed bodies.
#pragma once

#include <span>
#include <vector>

#include "grid/grid.hpp"
#include "immersed/crossings.hpp"

namespace luff::immersed {

/// The part of all sheets' vertices and triangles that bounds one rigid body; its normals point out of the body.
struct ClosedSurface {
  int first_vertex = 0;
  int vertices = 0;
  int first_triangle = 0;
  int triangles = 0;

  [[nodiscard]] bool holds(int triangle) const
  {
    return triangle >= first_triangle && triangle < first_triangle + triangles;
  }
};

/// An owned cell whose centre lies inside a body.
struct InsideCell {
  Index3 cell{};
  int body = 0;  ///< the first that it lies in

  friend bool operator==(const InsideCell&, const InsideCell&) = default;
};

/// Walks along the rows of cells and counts how often each surface is entered and left; surfaces may overlap.  Rows
/// that no surface crosses, and that may lie inside as a whole, learn it from their neighbours.  The count is that of
/// exact arithmetic (see find_crossings): a line that grazes a surface enters it as often as it leaves it.
///
/// crossings: all hits of this rank.  Sorted by k, j, i.  Collective.
[[nodiscard]] std::vector<InsideCell> find_inside(const grid::Grid& grid, std::span<const Crossing> crossings,
                                                  std::span<const ClosedSurface> bodies);

}  // namespace luff::immersed
