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

/// Distance between the centres beside the low face of a cell, of the area given, as its gradient flux has it:
/// |S_f|/a_f on curvilinear grids, a_f from G_aa(P) and G_aa(N) in series.
[[nodiscard]] inline double distance_across(const grid::Grid& grid, int axis, const Index3& face, double area)
{
  const grid::Curvilinear* const m = curvilinear_metric(grid);
  if (m == nullptr)
    return grid.distance(axis, face[axis]);
  return area / grid::in_series(m->G[axis](stepped(face, axis, -1)), m->G[axis](face));
}

[[nodiscard]] inline double distance_across(const grid::Grid& grid, int axis, const Index3& face)
{
  return distance_across(grid, axis, face, grid.area(axis, face[0], face[1], face[2]));
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

/// What stencils see of a cell along one axis; pairs are of its low and its high face.
struct CellAxis {
  std::array<double, 2> distance{};    ///< across the faces
  std::array<double, 2> area{};        ///< |S| of the faces
  std::array<double, 2> area_ratio{};  ///< |S| at the centre over |S| of the faces
  std::array<Vec3, 2> normal{};        ///< of the faces
  Vec3 centre_normal = Vec3::Zero();   ///< S/|S| at the centre
  double width = 0.0;                  ///< width_across()
};

[[nodiscard]] inline CellAxis cell_axis(const grid::Grid& grid, int axis, const Index3& cell)
{
  CellAxis result;
  const Vec3 centre = centre_area_vector(grid, axis, cell);
  const double at_centre = centre.norm();
  for (int side = 0; side < 2; ++side) {
    const Index3 face = stepped(cell, axis, side);
    const Vec3 S = grid.area_vector(axis, face[0], face[1], face[2]);
    result.area[side] = S.norm();
    result.area_ratio[side] = at_centre / result.area[side];
    result.normal[side] = S / result.area[side];
    result.distance[side] = distance_across(grid, axis, face, result.area[side]);
  }
  result.centre_normal = centre / at_centre;
  result.width = width_across(grid, axis, cell);
  return result;
}

}  // namespace luff::immersed
