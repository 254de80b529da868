// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/cut_cells.hpp"

#include "parallel/vector_field.hpp"

#include <algorithm>

namespace luff::immersed {

namespace {

/// The two links of a cell along one axis: side 0 below, side 1 above.
struct AxisLinks {
  std::array<int, 2> hit{open_link, open_link};  ///< the hit that this cell sees on each link
  std::array<double, 2> length{};                ///< distance to the neighbour or to the sheet, clipped by theta_min
  double span = 0.0;                             ///< H_d

  [[nodiscard]] bool cut(int side) const { return hit[side] != open_link; }
  /// v_k = nu/(h_k H_d)
  [[nodiscard]] double exchange(int side, double viscosity) const { return viscosity / (length[side] * span); }
};

/// Relative distance of the sheet from the cell's centre on one of its links.
double theta_from_cell(const CutLinks& links, const CutFace& face, int side)
{
  return side == 1 ? links.crossings()[face.first].theta : 1.0 - links.crossings()[face.last].theta;
}

AxisLinks axis_links(const grid::Grid& grid, const CutLinks& links, const CutCell& cut, int axis)
{
  AxisLinks result;
  for (int side = 0; side < 2; ++side) {
    result.length[side] = grid.distance(axis, cut.cell[axis] + side);
    const int f = cut.face[2 * axis + side];
    if (f == open_link)
      continue;
    const CutFace& face = links.faces()[f];
    result.hit[side] = side == 1 ? face.first : face.last;
    result.length[side] *= std::max(theta_from_cell(links, face, side), theta_min);
  }
  const bool any = result.cut(0) || result.cut(1);
  result.span = any ? 0.5 * (result.length[0] + result.length[1]) : grid.width(axis, cut.cell[axis]);
  return result;
}

}  // namespace

CutCellTerms momentum_terms(const grid::Grid& grid, const CutLinks& links, const CutCell& cut,
                            const View3<const double>& u, double viscosity, const StageTime& now, const StageTime& then)
{
  CutCellTerms terms{Vec3::Zero(), Vec3::Zero(), 0.0};
  const Vec3 u_here = at(u, cut.cell);
  for (int axis = 0; axis < 3; ++axis) {
    const AxisLinks axis_link = axis_links(grid, links, cut, axis);
    std::array<Vec3, 2> u_beside;
    for (int side = 0; side < 2; ++side) {
      const double v = axis_link.exchange(side, viscosity);
      if (axis_link.cut(side)) {
        u_beside[side] = links.velocity(axis_link.hit[side], now);
        terms.wall_rate += v;
        terms.wall_source += v * links.velocity(axis_link.hit[side], then);
      } else {
        u_beside[side] = at(u, stepped(cut.cell, axis, side == 0 ? -1 : 1));
        terms.explicit_rate += v * (u_beside[side] - u_here);
      }
    }
    terms.explicit_rate -= u_here[axis] / (axis_link.length[0] + axis_link.length[1]) * (u_beside[1] - u_beside[0]);
  }
  return terms;
}

Vec3 wall_source(const grid::Grid& grid, const CutLinks& links, const CutCell& cut, double viscosity,
                 const StageTime& then)
{
  Vec3 source = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const AxisLinks axis_link = axis_links(grid, links, cut, axis);
    for (int side = 0; side < 2; ++side)
      if (axis_link.cut(side))
        source += axis_link.exchange(side, viscosity) * links.velocity(axis_link.hit[side], then);
  }
  return source;
}

Vec3 pressure_gradient(const grid::Grid& grid, const CutCell& cut, const View<const double>& p)
{
  Vec3 gradient = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const std::array<bool, 2> open{cut.face[2 * axis] == open_link, cut.face[2 * axis + 1] == open_link};
    const std::array<double, 2> d{grid.distance(axis, cut.cell[axis]), grid.distance(axis, cut.cell[axis] + 1)};
    const double p_here = p(cut.cell);
    const double low = open[0] ? (p_here - p(stepped(cut.cell, axis, -1))) / d[0] : 0.0;
    const double high = open[1] ? (p(stepped(cut.cell, axis, 1)) - p_here) / d[1] : 0.0;
    if (open[0] && open[1])
      gradient[axis] = (d[1] * low + d[0] * high) / (d[0] + d[1]);
    else
      gradient[axis] = low + high;
  }
  return gradient;
}

void recover_velocity(const grid::Grid& grid, const CutLinks& links, const View3<const double>& U,
                      const StageTime& time, const View3<double>& u)
{
  for (const CutCell& cut : links.cells())
    for (int axis = 0; axis < 3; ++axis) {
      std::array<double, 2> value{};
      std::array<double, 2> distance{};
      for (int side = 0; side < 2; ++side) {
        const Index3 face_cell = stepped(cut.cell, axis, side);
        const int f = cut.face[2 * axis + side];
        if (f == open_link) {
          value[side] = U[axis](face_cell) / grid.area(axis, cut.cell[0], cut.cell[1], cut.cell[2]);
          distance[side] = 0.5 * grid.width(axis, cut.cell[axis]);
        } else {
          const CutFace& face = links.faces()[f];
          value[side] = links.velocity(side == 1 ? face.first : face.last, time)[axis];
          distance[side] = theta_from_cell(links, face, side) * grid.distance(axis, face_cell[axis]);
        }
      }
      const double span = distance[0] + distance[1];
      u[axis](cut.cell) =
          span > 0.0 ? (value[0] * distance[1] + value[1] * distance[0]) / span : 0.5 * (value[0] + value[1]);
    }
}

}  // namespace luff::immersed
