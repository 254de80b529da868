// SPDX-License-Identifier: BSD-3-Clause
// Where in a grid a point lies.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "grid/grid.hpp"

namespace luff::grid {

/// A point among the centres of cells: trilinear between the eight from `base` to `base` + 1,
///
///   x = sum over corners of prod_a (weight_a or 1 - weight_a) centre(base + corner).
///
/// Between the centres of the outermost cells and a side that is not periodic, weights lie outside [0, 1]: what is
/// interpolated is continued from within.
struct Location {
  bool mine = false;  ///< whether this rank owns the cell that holds the point; only there is the rest of use
  Index3 base{};      ///< the eight are owned or one layer from what is
  Vec3 weight = Vec3::Zero();
};

/// The location of a point; the same rank's whenever asked.  None, on every rank, where it lies outside the grid.
/// Collective.
[[nodiscard]] std::optional<Location> locate(const Grid& grid, const Vec3& x);

/// Index along an axis of the cells that hold x, of the nearest ones where none do.  Uniform and rectilinear grids.
[[nodiscard]] int cell_at(const Grid& grid, int axis, double x);

/// Widths of the cell around a place, of the nearest one where there is none.  Uniform and rectilinear grids.
[[nodiscard]] Vec3 widths_at(const Grid& grid, const Vec3& x);

/// The cell around a place: the unit normals of its faces, in rows, and the widths across them [L].
struct CellShape {
  Mat3 normals = Mat3::Identity();
  Vec3 widths = Vec3::Ones();

  /// A vector in cells: the change of the three indices along it.
  [[nodiscard]] Vec3 in_cells(const Vec3& v) const { return (normals * v).cwiseQuotient(widths); }
};

/// Where a point stands: in the grid or outside, on which sides, [axis][end], to 1e-6 of a cell, and in which cell, the
/// nearest one outside.  A seam at which a ring closes is no side.
struct Standing {
  bool inside = false;
  std::array<std::array<bool, 2>, 3> on_side{};
  CellShape cell;
};

/// Of many points, the same on every rank.  Collective.
[[nodiscard]] std::vector<Standing> standings(const Grid& grid, std::span<const Vec3> points);

}  // namespace luff::grid
