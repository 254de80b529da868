// SPDX-License-Identifier: BSD-3-Clause
// Lengths across faces and cells that the stencils beside a sheet see, on grids of any kind.
#pragma once

#include "grid/grid.hpp"

namespace luff::immersed {

/// The metric of a curvilinear grid; null for the other kinds.
[[nodiscard]] inline const grid::Curvilinear* curvilinear_metric(const grid::Grid& grid)
{
  return grid.visit([](const auto& m) -> const grid::Curvilinear* {
    if constexpr (grid::is_curvilinear<std::remove_cvref_t<decltype(m)>>)
      return &m;
    else
      return nullptr;
  });
}

/// Area vector of a cell at its centre: the mean of those of its two faces normal to an axis.
[[nodiscard]] inline Vec3 centre_area_vector(const grid::Grid& grid, int axis, const Index3& cell)
{
  const auto S = [&](const Index3& c) { return grid.area_vector(axis, c[0], c[1], c[2]); };
  return 0.5 * (S(cell) + S(stepped(cell, axis, 1)));
}

/// Distance between the centres beside the low face of a cell, as its gradient flux has it: |S_f|/a_f on curvilinear
/// grids, a_f from G_aa(P) and G_aa(N) in series.
[[nodiscard]] inline double distance_across(const grid::Grid& grid, int axis, const Index3& face)
{
  const grid::Curvilinear* const m = curvilinear_metric(grid);
  if (m == nullptr)
    return grid.distance(axis, face[axis]);
  const auto [i, j, k] = face;
  return grid.area(axis, i, j, k) / grid::in_series(m->G[axis](stepped(face, axis, -1)), m->G[axis](face));
}

/// From the centre below the low face of a cell to that above.
[[nodiscard]] inline Vec3 link_vector(const grid::Grid& grid, int axis, const Index3& face)
{
  if (grid.kind() != grid::Kind::Curvilinear)
    return grid.distance(axis, face[axis]) * Vec3::Unit(axis);
  return grid.centre(face) - grid.centre(stepped(face, axis, -1));
}

/// Width of a cell across its faces normal to an axis: V/|S_a| on curvilinear grids, S_a at the centre.
[[nodiscard]] inline double width_across(const grid::Grid& grid, int axis, const Index3& cell)
{
  if (grid.kind() != grid::Kind::Curvilinear)
    return grid.width(axis, cell[axis]);
  const auto [i, j, k] = cell;
  return grid.volume(i, j, k) / centre_area_vector(grid, axis, cell).norm();
}

/// Unit normal of the low face of a cell, towards increasing index.
[[nodiscard]] inline Vec3 face_normal(const grid::Grid& grid, int axis, const Index3& cell)
{
  const auto [i, j, k] = cell;
  return grid.area_vector(axis, i, j, k) / grid.area(axis, i, j, k);
}

}  // namespace luff::immersed
